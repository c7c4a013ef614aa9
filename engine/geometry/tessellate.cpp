#include "engine/geometry/tessellate.h"

#include "engine/geometry/polygon_triangulation.h"

#include <algorithm>
#include <array>

namespace atrium {
namespace {

/// Collects vertices and triangles of one part.
class Builder {
public:
    std::uint32_t vertex(const vec3& p, const vec3& n, const vec2& uv) {
        data_->positions.push_back(p);
        data_->normals.push_back(n);
        data_->texcoords0.push_back(uv);
        return std::uint32_t(data_->positions.size() - 1);
    }
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const vec3& p = data_->positions[a];
        const vec3 area = glm::cross(data_->positions[b] - p, data_->positions[c] - p);
        if (glm::dot(area, area) > 0.0F) {
            data_->indices.insert(data_->indices.end(), {a, b, c});
        }
    }
    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }
    std::shared_ptr<const MeshData> finish() {
        data_->parts = {{0, std::uint32_t(data_->indices.size())}};
        return data_;
    }

private:
    std::shared_ptr<MeshData> data_ = std::make_shared<MeshData>();
};

vec2 circle(int i, int segments) {
    // The last point is the first, exactly, so that seams close.
    const float angle = 2.0F * kPi * float(i % segments) / float(segments);
    return {std::cos(angle), std::sin(angle)};
}

void polygon(Builder& out, const Polygon& shape) {
    const PolygonTriangles triangles = triangulate(shape);
    Box3 box;
    for (const vec2& p : triangles.points) {
        box.add(vec3(p, 0.0F));
    }
    const vec3 size = glm::max(box.size(), vec3(1e-30F));
    for (const vec2& p : triangles.points) {
        out.vertex(vec3(p, 0.0F), vec3(0, 0, 1), (p - vec2(box.min)) / vec2(size));
    }
    for (std::size_t i = 0; i + 2 < triangles.indices.size(); i += 3) {
        out.triangle(triangles.indices[i], triangles.indices[i + 1], triangles.indices[i + 2]);
    }
}

void box(Builder& out, const Box& shape) {
    const vec3 h = shape.size * 0.5F;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0F, 1.0F}) {
            vec3 n(0.0F);
            n[axis] = sign;
            vec3 u(0.0F);
            u[(axis + 1) % 3] = sign;
            const vec3 v = glm::cross(n, u);
            std::array<std::uint32_t, 4> corner{};
            for (int c = 0; c < 4; ++c) {
                const float s = (c == 1 || c == 2) ? 1.0F : -1.0F;
                const float t = c >= 2 ? 1.0F : -1.0F;
                corner[std::size_t(c)] = out.vertex((n + s * u + t * v) * h, n, {0.5F + 0.5F * s, 0.5F + 0.5F * t});
            }
            out.quad(corner[0], corner[1], corner[2], corner[3]);
        }
    }
}

void sphere(Builder& out, const Sphere& shape, int segments) {
    const int rings = std::max(segments / 2, 4);
    for (int j = 0; j <= rings; ++j) {
        // Poles and equator exact, both hemispheres mirror images.
        const float polar = kPi * float(j) / float(rings);
        const float r = j == 0 || j == rings ? 0.0F : std::sin(polar);
        const float y = j == 0 ? 1.0F : (j == rings ? -1.0F : std::cos(polar));
        for (int i = 0; i <= segments; ++i) {
            const vec2 c = circle(i, segments);
            const vec3 n(c.y * r, y, c.x * r);
            out.vertex(n * shape.radius, n, {float(i) / float(segments), 1.0F - float(j) / float(rings)});
        }
    }
    const auto at = [&](int j, int i) { return std::uint32_t(j * (segments + 1) + i); };
    for (int j = 0; j < rings; ++j) {
        for (int i = 0; i < segments; ++i) {
            out.quad(at(j, i), at(j + 1, i), at(j + 1, i + 1), at(j, i + 1));
        }
    }
}

// Front side along u x v, or against it when `turned`: a cap shares its rim with the side wall bit for bit only if both
// compute it from the same cosines and sines, so both caps of a solid go round the same way.
void disc_at(Builder& out, const vec3& centre, const vec3& u, const vec3& v, float radius, int segments,
             bool turned = false) {
    const vec3 n = turned ? glm::cross(v, u) : glm::cross(u, v);
    const std::uint32_t middle = out.vertex(centre, n, {0.5F, 0.5F});
    std::uint32_t previous = 0;
    for (int i = 0; i <= segments; ++i) {
        const vec2 c = circle(i, segments);
        const vec2 uv = 0.5F + 0.5F * (turned ? vec2(c.y, c.x) : c);
        const std::uint32_t rim = out.vertex(centre + radius * (c.x * u + c.y * v), n, uv);
        if (i > 0) {
            turned ? out.triangle(middle, rim, previous) : out.triangle(middle, previous, rim);
        }
        previous = rim;
    }
}

void frustum(Builder& out, float base, float top, float height, bool capped, int segments) {
    // Normal of the slanted side: along (height, base - top) in the (radius, y) plane.
    const vec2 slope = glm::normalize(vec2(height, base - top) + vec2(height == 0.0F && base == top ? 1.0F : 0.0F, 0.0F));
    for (int j = 0; j <= 1; ++j) {
        const float r = j == 0 ? base : top;
        for (int i = 0; i <= segments; ++i) {
            const vec2 c = circle(i, segments);
            out.vertex({c.y * r, (float(j) - 0.5F) * height, c.x * r}, {c.y * slope.x, slope.y, c.x * slope.x},
                       {float(i) / float(segments), float(j)});
        }
    }
    const std::uint32_t row = std::uint32_t(segments) + 1;
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
        out.quad(i, i + 1, row + i + 1, row + i);
    }
    if (capped) {
        if (base > 0.0F) {
            disc_at(out, {0, -0.5F * height, 0}, {0, 0, 1}, {1, 0, 0}, base, segments, true);
        }
        if (top > 0.0F) {
            disc_at(out, {0, 0.5F * height, 0}, {0, 0, 1}, {1, 0, 0}, top, segments);
        }
    }
}

} // namespace

std::shared_ptr<const MeshData> tessellate(const Geometry& geometry, const TessellationOptions& options) {
    const int segments = std::max(options.segments, 8);
    Builder out;
    if (const auto* mesh = std::get_if<Mesh>(&geometry)) {
        return mesh->data;
    }
    if (const auto* p = std::get_if<Polygon>(&geometry)) {
        polygon(out, *p);
    } else if (const auto* b = std::get_if<Box>(&geometry)) {
        box(out, *b);
    } else if (const auto* s = std::get_if<Sphere>(&geometry)) {
        sphere(out, *s, segments);
    } else if (const auto* y = std::get_if<Cylinder>(&geometry)) {
        frustum(out, y->radius, y->radius, y->height, y->capped, segments);
    } else if (const auto* c = std::get_if<Cone>(&geometry)) {
        frustum(out, c->base_radius, c->top_radius, c->height, c->capped, segments);
    } else if (const auto* d = std::get_if<Disc>(&geometry)) {
        disc_at(out, vec3(0.0F), {1, 0, 0}, {0, 1, 0}, d->radius, segments);
    }
    return out.finish();
}

} // namespace atrium
