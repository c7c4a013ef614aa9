#include "ui/panels/thumbnail.h"

#include "engine/layers/surface_layer.h"

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr int kOversampling = 2;

QRgb display(const Rgb& linear, float alpha = 1.0F) {
    const auto byte = [](float v) { return int(std::lround(255.0F * linear_to_srgb(std::clamp(v, 0.0F, 1.0F)))); };
    return qRgba(byte(linear.r), byte(linear.g), byte(linear.b), int(std::lround(255.0F * alpha)));
}

Rgb shaded(const Material& material, const dvec3& normal) {
    if (material.emits()) {
        const Rgb light = material.emitted_radiance();
        return glm::mix(light / max_component(light), Rgb(1.0F), 0.4F);
    }
    static const dvec3 kKey = glm::normalize(dvec3(0.5, 0.9, 0.7));
    const double lit = 0.35 + 0.6 * std::max(0.0, glm::dot(normal, kKey)) + 0.15 * std::max(0.0, normal.y);
    return material.base_color * float(lit);
}

/// What a ray into the little world of the material balls meets when nothing is in its way.
Rgb surroundings(const dvec3& from, const dvec3& direction) {
    if (direction.y < -1e-6) {
        const dvec3 p = from + direction * ((-1.0 - from.y) / direction.y);
        const bool odd = ((int(std::floor(p.x * 1.6)) + int(std::floor(p.z * 1.6))) & 1) != 0;
        const double far = std::exp(-0.12 * glm::length(p));
        return glm::mix(Rgb(0.45F), odd ? Rgb(0.75F) : Rgb(0.2F), float(far));
    }
    const bool window = direction.y > 0.45 && direction.y < 0.8 && direction.x < -0.15 && direction.x > -0.6;
    return window ? Rgb(2.5F) : Rgb(0.45F + 0.3F * float(direction.y));
}

Rgb ball(const Material& material, const dvec3& eye, const dvec3& ray, const dvec3& point) {
    const dvec3& n = point; // unit ball about the origin
    const double cosine = std::max(0.0, -glm::dot(n, ray));
    const dvec3 mirrored = ray + n * (2.0 * cosine);
    const float edge = std::pow(1.0F - float(cosine), 5.0F);
    const float blur = std::clamp(material.roughness * 2.0F, 0.0F, 1.0F);
    const Rgb seen = glm::mix(surroundings(point, mirrored), Rgb(0.55F), blur);
    if (material.metallic > 0.5F) {
        const Rgb f = material.base_color + (Rgb(1.0F) - material.base_color) * edge;
        return f * glm::mix(seen, Rgb(float(0.3 + 0.8 * std::max(0.0, glm::dot(n, glm::normalize(dvec3(-0.4, 0.8, 0.6)))))),
                            blur * 0.6F);
    }
    const float fresnel = 0.04F + 0.96F * edge;
    Rgb body = shaded(material, n) * (1.0F - material.transmission);
    if (material.transmission > 0.0F) {
        // A pane goes straight on; a solid ball turns the picture upside down.
        const dvec3 on = material.thickness > 0.0F ? glm::normalize(ray - n * 0.75 * cosine - point * 0.4) : ray;
        body += material.transmission * material.base_color * glm::mix(surroundings(eye, on), Rgb(0.6F), blur);
    }
    return body + fresnel * seen * (1.0F - 0.7F * blur);
}

QImage smoothed(const QImage& image, int size) {
    return image.scaled(size, size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

} // namespace

QImage material_thumbnail(const Material& material, int size) {
    const int side = size * kOversampling;
    QImage image(side, side, QImage::Format_ARGB32);
    const dvec3 eye(0.0, 0.9, 5.0);
    const dvec3 forward = glm::normalize(-eye);
    const dvec3 right(1, 0, 0);
    const dvec3 up = glm::cross(right, forward);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double u = (x + 0.5) / side * 2 - 1;
            const double v = 1 - (y + 0.5) / side * 2;
            const dvec3 ray = glm::normalize(forward + 0.235 * (u * right + v * up));
            const double b = glm::dot(eye, ray);
            const double c = glm::dot(eye, eye) - 1.0;
            const double d = b * b - c;
            image.setPixel(
                x, y, display(d > 0 ? ball(material, eye, ray, eye + ray * (-b - std::sqrt(d))) : surroundings(eye, ray)));
        }
    }
    return smoothed(image, size);
}

QImage object_thumbnail(const Scene& scene, int size) {
    const int side = size * kOversampling;
    QImage image(side, side, QImage::Format_ARGB32);
    image.fill(Qt::transparent);
    const DBox3 bounds = scene.bounds();
    if (bounds.empty()) {
        return smoothed(image, size);
    }
    const dvec3 towards = glm::normalize(dvec3(0.55, 0.5, 1.0)); // from the object to the eye
    const dvec3 right = glm::normalize(glm::cross(dvec3(0, 1, 0), towards));
    const dvec3 up = glm::cross(towards, right);
    const dvec3 half = 0.5 * (bounds.max - bounds.min);
    const double reach = std::max({glm::dot(half, glm::abs(right)), glm::dot(half, glm::abs(up)), 1e-6}) * 1.08;
    std::vector<double> depth(std::size_t(side) * side, -std::numeric_limits<double>::infinity());
    for (const NodeId id : scene.in_tree_order()) {
        const Node* node = scene.nodes.find(id);
        const Shape* shape = scene.shapes.find(node->shape);
        if (shape == nullptr || !scene.shown(id)) {
            continue;
        }
        const dmat4 world = scene.world_matrix(id);
        for (std::size_t part = 0; part < part_count(*shape); ++part) {
            const Material* own = scene.material_of(*node, part);
            const Material& material = own == nullptr ? default_material() : *own;
            const DisplayMesh mesh = make_display_mesh(*shape, part);
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
                dvec3 p[3];
                dvec3 s[3];
                for (int k = 0; k < 3; ++k) {
                    p[k] = dvec3(world * dvec4(dvec3(mesh.positions[mesh.indices[i + std::size_t(k)]]), 1.0));
                    const dvec3 from = p[k] - bounds.centre();
                    s[k] = dvec3((glm::dot(from, right) / reach + 1) * 0.5 * side,
                                 (1 - glm::dot(from, up) / reach) * 0.5 * side, glm::dot(from, towards));
                }
                dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
                const double length = glm::length(normal);
                if (!(length > 0)) {
                    continue;
                }
                normal = glm::dot(normal, towards) < 0 ? -normal / length : normal / length;
                const QRgb color = display(shaded(material, normal), 1.0F - 0.6F * material.transmission);
                const double area = (s[1].x - s[0].x) * (s[2].y - s[0].y) - (s[2].x - s[0].x) * (s[1].y - s[0].y);
                if (!(std::abs(area) > 1e-9)) {
                    continue;
                }
                const int x0 = std::max(0, int(std::floor(std::min({s[0].x, s[1].x, s[2].x}))));
                const int x1 = std::min(side - 1, int(std::ceil(std::max({s[0].x, s[1].x, s[2].x}))));
                const int y0 = std::max(0, int(std::floor(std::min({s[0].y, s[1].y, s[2].y}))));
                const int y1 = std::min(side - 1, int(std::ceil(std::max({s[0].y, s[1].y, s[2].y}))));
                for (int y = y0; y <= y1; ++y) {
                    for (int x = x0; x <= x1; ++x) {
                        const double px = x + 0.5;
                        const double py = y + 0.5;
                        const double a = ((s[1].x - px) * (s[2].y - py) - (s[2].x - px) * (s[1].y - py)) / area;
                        const double b = ((s[2].x - px) * (s[0].y - py) - (s[0].x - px) * (s[2].y - py)) / area;
                        const double c = 1 - a - b;
                        double& z = depth[std::size_t(y) * side + std::size_t(x)];
                        const double here = a * s[0].z + b * s[1].z + c * s[2].z;
                        if (a >= -1e-9 && b >= -1e-9 && c >= -1e-9 && here > z) {
                            z = here;
                            image.setPixel(x, y, color);
                        }
                    }
                }
            }
        }
    }
    return smoothed(image, size);
}

} // namespace atrium::ui
