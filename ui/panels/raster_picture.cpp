#include "ui/panels/raster_picture.h"

#include "engine/layers/surface_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace atrium::ui {
namespace {

constexpr int kOversampling = 2;
constexpr double kNear = 0.02;          // metres
constexpr float kSeeThroughFrom = 0.5F; ///< transmission: drawn after everything else

class Canvas {
public:
    Canvas(const RasterCamera& camera, QSize size, QRgb background)
        : width_(size.width()), height_(size.height()), perspective_(camera.perspective),
          pixels_(camera.pixels * kOversampling), image_(size, QImage::Format_ARGB32_Premultiplied),
          depth_(std::size_t(width_) * std::size_t(height_), -std::numeric_limits<float>::infinity()) {
        image_.fill(background);
    }

    /// One triangle in the camera's axes; with perspective it is cut at the near plane.
    void triangle(const std::array<dvec3, 3>& corners, QRgb color) {
        std::array<dvec3, 4> clipped{corners[0], corners[1], corners[2], {}};
        int count = 3;
        if (perspective_) {
            count = 0;
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
        }
        for (int t = 1; t + 1 < count; ++t) {
            fill({on_screen(clipped[0]), on_screen(clipped[std::size_t(t)]), on_screen(clipped[std::size_t(t) + 1])}, color);
        }
    }

    [[nodiscard]] QImage scaled(QSize size) const {
        return image_.scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    }

private:
    /// Pixels, and a depth that is linear on the screen and larger where it is nearer.
    [[nodiscard]] dvec3 on_screen(const dvec3& p) const {
        const double scale = perspective_ ? pixels_ / -p.z : pixels_;
        return {0.5 * width_ + scale * p.x, 0.5 * height_ - scale * p.y, perspective_ ? -1.0 / p.z : p.z};
    }

    void fill(const std::array<dvec3, 3>& s, QRgb color) {
        const double area = (s[1].x - s[0].x) * (s[2].y - s[0].y) - (s[2].x - s[0].x) * (s[1].y - s[0].y);
        if (!(std::abs(area) > 1e-9)) {
            return;
        }
        const QRgb over = qPremultiply(color);
        const bool opaque = qAlpha(color) == 255;
        const auto pixel = [](double v, int most) { return int(std::clamp(v, 0.0, double(most))); };
        const int x0 = pixel(std::floor(std::min({s[0].x, s[1].x, s[2].x})), width_ - 1);
        const int x1 = pixel(std::ceil(std::max({s[0].x, s[1].x, s[2].x})), width_ - 1);
        const int y0 = pixel(std::floor(std::min({s[0].y, s[1].y, s[2].y})), height_ - 1);
        const int y1 = pixel(std::ceil(std::max({s[0].y, s[1].y, s[2].y})), height_ - 1);
        for (int y = y0; y <= y1; ++y) {
            auto* line = reinterpret_cast<QRgb*>(image_.scanLine(y));
            for (int x = x0; x <= x1; ++x) {
                const double px = x + 0.5;
                const double py = y + 0.5;
                const double a = ((s[1].x - px) * (s[2].y - py) - (s[2].x - px) * (s[1].y - py)) / area;
                const double b = ((s[2].x - px) * (s[0].y - py) - (s[0].x - px) * (s[2].y - py)) / area;
                const double c = 1 - a - b;
                if (a < -1e-9 || b < -1e-9 || c < -1e-9) {
                    continue;
                }
                float& z = depth_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
                const auto here = float(a * s[0].z + b * s[1].z + c * s[2].z);
                if (here <= z) {
                    continue;
                }
                if (opaque) {
                    z = here;
                    line[x] = color;
                } else {
                    line[x] = blend(over, line[x]);
                }
            }
        }
    }

    /// Both premultiplied.
    static QRgb blend(QRgb over, QRgb under) {
        const int rest = 255 - qAlpha(over);
        const auto mix = [rest](int a, int b) { return a + (b * rest + 127) / 255; };
        return qRgba(mix(qRed(over), qRed(under)), mix(qGreen(over), qGreen(under)), mix(qBlue(over), qBlue(under)),
                     mix(qAlpha(over), qAlpha(under)));
    }

    int width_;
    int height_;
    bool perspective_;
    double pixels_;
    QImage image_;
    std::vector<float> depth_;
};

/// The faces of one part of a node.
void draw_part(Canvas& canvas, const DisplayMesh& mesh, const dmat4& world, const Material& material,
               const RasterCamera& camera, const FaceShader& shader) {
    const dmat4 to_world = glm::inverse(camera.to_view);
    const dvec3 eye(to_world[3]);
    const dvec3 backwards(glm::normalize(dvec3(to_world[2])));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<dvec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = dvec3(world * dvec4(dvec3(mesh.positions[mesh.indices[i + k]]), 1.0));
        }
        const dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(normal);
        const dvec3 to_eye = camera.perspective ? eye - p[0] : backwards;
        const double distance = glm::length(to_eye);
        if (!(length > 0) || !(distance > 0)) {
            continue;
        }
        const QRgb color = shader(material, normal / length, to_eye / distance);
        for (dvec3& corner : p) {
            corner = dvec3(camera.to_view * dvec4(corner, 1.0));
        }
        canvas.triangle(p, color);
    }
}

} // namespace

QRgb display_rgb(const Rgb& linear, float alpha) {
    const auto byte = [](float v) { return int(std::lround(255.0F * linear_to_srgb(std::clamp(v, 0.0F, 1.0F)))); };
    return qRgba(byte(linear.r), byte(linear.g), byte(linear.b), int(std::lround(255.0F * alpha)));
}

QImage raster_picture(const Scene& scene, const RasterCamera& camera, QSize size, QRgb background,
                      const FaceShader& shader) {
    Canvas canvas(camera, size * kOversampling, background);
    for (const bool see_through : {false, true}) { // panes last: what is behind them must be there
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
                if ((material.transmission > kSeeThroughFrom) == see_through) {
                    draw_part(canvas, make_display_mesh(*shape, part), world, material, camera, shader);
                }
            }
        }
    }
    return canvas.scaled(size);
}

} // namespace atrium::ui
