#include "ui/panels/room_picture.h"

#include "engine/layers/surface_layer.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace atrium::ui {
namespace {

constexpr int kOversampling = 2;
constexpr double kNear = 0.02; // metres
constexpr float kSeeThrough = 0.5F;

struct Canvas {
    QImage image;
    std::vector<float> depth; ///< 1 / distance along the view; larger is nearer
    int width = 0;
    int height = 0;
};

Rgb face_color(const Material& material, const dvec3& normal, const dvec3& to_eye) {
    if (material.emits()) {
        const Rgb light = material.emitted_radiance();
        return glm::mix(light / max_component(light), Rgb(1.0F), 0.5F);
    }
    static const dvec3 kKey = glm::normalize(dvec3(0.45, 0.8, 0.6));
    const double lit = 0.42 + 0.22 * std::abs(glm::dot(normal, kKey)) + 0.26 * std::abs(glm::dot(normal, to_eye)) +
                       0.1 * std::max(0.0, normal.y);
    return material.base_color * float(lit);
}

/// One triangle in view space (looking along -z), cut at the near plane, with perspective-correct depth.
void draw_triangle(Canvas& canvas, const std::array<dvec3, 3>& corners, double focal, QRgb color, bool see_through) {
    std::array<dvec3, 4> clipped;
    int count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const dvec3& a = corners[i];
        const dvec3& b = corners[(i + 1) % 3];
        const bool a_in = a.z < -kNear;
        if (a_in) {
            clipped[std::size_t(count++)] = a;
        }
        if (a_in != (b.z < -kNear)) {
            clipped[std::size_t(count++)] = a + (b - a) * ((-kNear - a.z) / (b.z - a.z));
        }
    }
    for (int t = 1; t + 1 < count; ++t) {
        std::array<dvec3, 3> s; // pixels and 1 / distance
        for (int k = 0; k < 3; ++k) {
            const dvec3& p = clipped[std::size_t(k == 0 ? 0 : t + k - 1)];
            s[std::size_t(k)] = {0.5 * canvas.width + focal * p.x / -p.z, 0.5 * canvas.height - focal * p.y / -p.z,
                                 -1 / p.z};
        }
        const double area = (s[1].x - s[0].x) * (s[2].y - s[0].y) - (s[2].x - s[0].x) * (s[1].y - s[0].y);
        if (!(std::abs(area) > 1e-9)) {
            continue;
        }
        const auto pixel = [](double v, int most) { return int(std::clamp(v, 0.0, double(most))); };
        const int x0 = pixel(std::floor(std::min({s[0].x, s[1].x, s[2].x})), canvas.width - 1);
        const int x1 = pixel(std::ceil(std::max({s[0].x, s[1].x, s[2].x})), canvas.width - 1);
        const int y0 = pixel(std::floor(std::min({s[0].y, s[1].y, s[2].y})), canvas.height - 1);
        const int y1 = pixel(std::ceil(std::max({s[0].y, s[1].y, s[2].y})), canvas.height - 1);
        for (int y = y0; y <= y1; ++y) {
            auto* line = reinterpret_cast<QRgb*>(canvas.image.scanLine(y));
            for (int x = x0; x <= x1; ++x) {
                const double px = x + 0.5;
                const double py = y + 0.5;
                const double a = ((s[1].x - px) * (s[2].y - py) - (s[2].x - px) * (s[1].y - py)) / area;
                const double b = ((s[2].x - px) * (s[0].y - py) - (s[0].x - px) * (s[2].y - py)) / area;
                const double c = 1 - a - b;
                if (a < -1e-9 || b < -1e-9 || c < -1e-9) {
                    continue;
                }
                float& z = canvas.depth[std::size_t(y) * std::size_t(canvas.width) + std::size_t(x)];
                const auto here = float(a * s[0].z + b * s[1].z + c * s[2].z);
                if (here <= z) {
                    continue;
                }
                if (see_through) {
                    const auto mix = [](int over, int under) {
                        return int(kSeeThrough * float(over) + (1 - kSeeThrough) * float(under));
                    };
                    line[x] = qRgb(mix(qRed(color), qRed(line[x])), mix(qGreen(color), qGreen(line[x])),
                                   mix(qBlue(color), qBlue(line[x])));
                } else {
                    z = here;
                    line[x] = color;
                }
            }
        }
    }
}

} // namespace

QImage room_picture(const Scene& scene, const ViewCamera& camera, QSize size) {
    Canvas canvas;
    canvas.width = size.width() * kOversampling;
    canvas.height = size.height() * kOversampling;
    canvas.image = QImage(canvas.width, canvas.height, QImage::Format_RGB32);
    canvas.image.fill(qRgb(206, 214, 224)); // out of the window
    canvas.depth.assign(std::size_t(canvas.width) * std::size_t(canvas.height), 0.0F);
    const dmat4 to_view = glm::inverse(camera.to_world);
    const dvec3 eye(camera.to_world[3]);
    const double focal = 0.5 * canvas.height / std::tan(0.5 * double(camera.lens.yfov));
    // Panes last: what is behind them must be there.
    for (const bool see_through : {false, true}) {
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
                if ((material.transmission > 0.5F) != see_through) {
                    continue;
                }
                const DisplayMesh mesh = make_display_mesh(*shape, part);
                for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
                    std::array<dvec3, 3> p;
                    for (std::size_t k = 0; k < 3; ++k) {
                        p[k] = dvec3(world * dvec4(dvec3(mesh.positions[mesh.indices[i + k]]), 1.0));
                    }
                    const dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
                    const double length = glm::length(normal);
                    const dvec3 from = eye - p[0];
                    const double distance = glm::length(from);
                    if (!(length > 0) || !(distance > 0)) {
                        continue;
                    }
                    const Rgb linear = face_color(material, normal / length, from / distance);
                    const auto byte = [](float v) {
                        return int(std::lround(255.0F * linear_to_srgb(std::clamp(v, 0.0F, 1.0F))));
                    };
                    const QRgb color = qRgb(byte(linear.r), byte(linear.g), byte(linear.b));
                    for (dvec3& corner : p) {
                        corner = dvec3(to_view * dvec4(corner, 1.0));
                    }
                    draw_triangle(canvas, p, focal, color, see_through);
                }
            }
        }
    }
    return canvas.image.scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

} // namespace atrium::ui
