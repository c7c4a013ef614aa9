#include "ui/viewport/markers.h"

#include "engine/scene/photometric_web.h"

#include <algorithm>
#include <array>

namespace atrium::ui {
namespace {

constexpr double kPickRadius = 12.0; ///< logical pixels
constexpr double kFigure = 34.0;     ///< length of cones, arrows and frusta, logical pixels

const vec4 kSelected(1.0F, 0.60F, 0.10F, 1.0F);
const vec4 kHovered(0.45F, 0.75F, 1.0F, 1.0F);
const vec4 kDark(0.05F, 0.05F, 0.05F, 1.0F);

/// Line figures of one marker in its own axes, one unit long.
std::vector<std::pair<dvec3, dvec3>> figure_of(const Marker& marker) {
    std::vector<std::pair<dvec3, dvec3>> lines;
    const auto direction = -marker.axes[2];
    switch (marker.kind) {
    case Marker::Kind::Point: break;
    case Marker::Kind::Spot: {
        const double angle = std::clamp(marker.angle, 0.05, 1.4);
        constexpr int kSides = 16;
        const auto rim = [&](int k) {
            const double a = 2.0 * kPiD * k / kSides;
            return direction * std::cos(angle) +
                   (marker.axes[0] * std::cos(a) + marker.axes[1] * std::sin(a)) * std::sin(angle);
        };
        for (int k = 0; k < kSides; ++k) {
            lines.emplace_back(rim(k), rim(k + 1));
            if (k % 4 == 0) {
                lines.emplace_back(dvec3(0.0), rim(k));
            }
        }
        break;
    }
    case Marker::Kind::Sun:
        for (int k = 0; k < 3; ++k) {
            const double a = 2.0 * kPiD * k / 3;
            const dvec3 side = (marker.axes[0] * std::cos(a) + marker.axes[1] * std::sin(a)) * 0.3;
            lines.emplace_back(side, side + direction * 1.4);
        }
        lines.emplace_back(dvec3(0.0), direction * 1.8);
        break;
    case Marker::Kind::Camera: {
        const double h = std::tan(std::clamp(marker.angle, 0.05, 1.2)) * 0.9;
        std::array<dvec3, 4> corners{};
        for (std::size_t k = 0; k < 4; ++k) {
            const double x = k == 0 || k == 3 ? -1.0 : 1.0;
            const double y = k < 2 ? -1.0 : 1.0;
            corners[k] = direction * 0.9 + marker.axes[0] * (x * h * 1.4) + marker.axes[1] * (y * h);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            lines.emplace_back(dvec3(0.0), corners[k]);
            lines.emplace_back(corners[k], corners[(k + 1) % 4]);
        }
        const dvec3 top = direction * 0.9 + marker.axes[1] * (h * 1.5);
        lines.emplace_back(corners[2], top);
        lines.emplace_back(corners[3], top);
        break;
    }
    }
    return lines;
}

constexpr double kWeb = 110.0; ///< length of a web's greatest intensity, logical pixels

/// A photometric web as meridians and rings, its peak one unit long.
std::vector<std::pair<dvec3, dvec3>> web_of(const Marker& marker) {
    constexpr int kPlanes = 8, kSteps = 36, kRound = 32;
    const PhotometricWeb& web = *marker.photometry.web;
    const auto at = [&](double v, double h) {
        const dvec3 d = photometric_direction(PhotometryType::C, v, h); // in the light's own axes
        return (marker.axes * d) * double(web.relative(vec3(d)));
    };
    std::vector<std::pair<dvec3, dvec3>> lines;
    const auto add = [&](const dvec3& a, const dvec3& b) {
        if (glm::dot(a, a) + glm::dot(b, b) > 1e-6) {
            lines.emplace_back(a, b);
        }
    };
    for (int plane = 0; plane < kPlanes; ++plane) {
        for (int k = 0; k < kSteps; ++k) {
            add(at(180.0 * k / kSteps, 360.0 * plane / kPlanes), at(180.0 * (k + 1) / kSteps, 360.0 * plane / kPlanes));
        }
    }
    for (int v = 15; v < 180; v += 15) {
        for (int k = 0; k < kRound; ++k) {
            add(at(v, 360.0 * k / kRound), at(v, 360.0 * (k + 1) / kRound));
        }
    }
    return lines;
}

} // namespace

std::vector<Marker> find_markers(const Scene& scene) {
    std::vector<Marker> out;
    scene.nodes.for_each([&](NodeId id, const Node& node) {
        if ((!node.light && !node.camera) || !scene.shown(id)) {
            return;
        }
        const dmat4 world = scene.world_matrix(id);
        Marker marker;
        marker.node = id;
        marker.position = dvec3(world[3]);
        marker.axes = glm::mat3_cast(decompose(world).rotation);
        if (const Light* light = scene.lights.find(node.light)) {
            marker.kind = light->kind == Light::Kind::Point
                              ? Marker::Kind::Point
                              : (light->kind == Light::Kind::Spot ? Marker::Kind::Spot : Marker::Kind::Sun);
            marker.angle = double(light->outer_cone);
            marker.enabled = light->enabled;
            marker.photometry.web = light_distribution(*light) != nullptr ? light->photometry.web : nullptr;
            const float most = max_component(light->color);
            marker.color = most > 0 ? light->color / most : vec3(1.0F);
        } else if (const Camera* camera = scene.cameras.find(node.camera)) {
            marker.kind = Marker::Kind::Camera;
            marker.angle = camera->perspective ? 0.5 * double(camera->yfov) : 0.3;
        } else {
            return;
        }
        if (is_finite(marker.position)) {
            out.push_back(marker);
        }
    });
    return out;
}

void find_hidden(std::vector<Marker>& markers, const ViewScene& view, const CameraController& camera) {
    for (Marker& marker : markers) {
        const dvec3 d = marker.position - camera.eye();
        const double distance = glm::length(d);
        // A lamp sits in or on its fitting: what is within 5 cm of it does not hide it.
        marker.hidden_behind = distance > 0.05 && view.pick({camera.eye(), d / distance}, distance - 0.05).has_value();
    }
}

const Marker* marker_at(const std::vector<Marker>& markers, const CameraController& camera, const dvec2& point,
                        const std::function<bool(NodeId)>& selected) {
    const Marker* best = nullptr;
    double nearest = kPickRadius;
    for (const Marker& marker : markers) {
        const auto at = camera.project(marker.position);
        if (!at || (marker.hidden_behind && !selected(marker.node))) {
            continue;
        }
        const double distance = glm::length(*at - point);
        if (distance < nearest) {
            nearest = distance;
            best = &marker;
        }
    }
    return best;
}

void draw_markers(OverlayBatch& batch, const std::vector<Marker>& markers, const CameraController& camera,
                  const std::function<bool(NodeId)>& selected, NodeId hovered) {
    for (const Marker& marker : markers) {
        const auto at = camera.project(marker.position);
        if (!at || glm::length(camera.eye() - marker.position) < 0.1) {
            continue;
        }
        const bool chosen = selected(marker.node);
        if (marker.hidden_behind && !chosen) {
            continue;
        }
        vec4 color = marker.enabled ? vec4(0.4F + 0.6F * marker.color.r, 0.35F + 0.6F * marker.color.g,
                                           0.15F + 0.6F * marker.color.b, 1.0F)
                                    : vec4(0.55F, 0.55F, 0.55F, 1.0F);
        if (marker.kind == Marker::Kind::Camera) {
            color = vec4(0.80F, 0.84F, 0.90F, 1.0F);
        }
        if (chosen) {
            color = kSelected;
        } else if (marker.node == hovered) {
            color = kHovered;
        }
        const bool as_web = chosen && marker.photometry;
        const double length = (as_web ? kWeb : kFigure) * camera.pixel_size(marker.position);
        const auto lines = as_web ? web_of(marker) : figure_of(marker);
        const double width = as_web ? 1.1 : 1.6;
        for (const auto& [a, b] : lines) {
            batch.line3(camera, marker.position + a * length, marker.position + b * length, width + 1.8,
                        vec4(0.0F, 0.0F, 0.0F, as_web ? 0.25F : 0.45F));
        }
        for (const auto& [a, b] : lines) {
            batch.line3(camera, marker.position + a * length, marker.position + b * length, width, color);
        }
        if (marker.kind == Marker::Kind::Point || marker.kind == Marker::Kind::Sun) {
            for (int k = 0; k < 8; ++k) {
                const double a = kPiD * k / 4;
                const dvec2 u(std::cos(a), std::sin(a));
                batch.line(*at + u * 8.0, *at + u * 13.0, 3.2, vec4(0.0F, 0.0F, 0.0F, 0.45F));
                batch.line(*at + u * 8.5, *at + u * 12.5, 1.6, color);
            }
        }
        batch.disc(*at, 6.0, kDark);
        batch.disc(*at, 4.5, color);
    }
}

void draw_axes(OverlayBatch& batch, const CameraController& camera) {
    const dvec2 centre(44.0, camera.height() - 44.0);
    constexpr double kLength = 26.0;
    const std::array<vec4, 3> colors{
        {{0.90F, 0.23F, 0.25F, 1.0F}, {0.33F, 0.70F, 0.18F, 1.0F}, {0.20F, 0.47F, 0.95F, 1.0F}}};
    batch.disc(centre, 36.0, vec4(0.1F, 0.1F, 0.1F, 0.25F));
    std::array<int, 3> order{0, 1, 2};
    const dmat3 turn(camera.rotation());
    std::sort(order.begin(), order.end(), [&](int a, int b) { return turn[a].z < turn[b].z; });
    // Letters as strokes in a unit cell, y down.
    static const std::array<std::vector<std::pair<dvec2, dvec2>>, 3> kLetters{
        {{{{-1, -1}, {1, 1}}, {{1, -1}, {-1, 1}}},
         {{{-1, -1}, {0, 0}}, {{1, -1}, {0, 0}}, {{0, 0}, {0, 1}}},
         {{{-1, -1}, {1, -1}}, {{1, -1}, {-1, 1}}, {{-1, 1}, {1, 1}}}}};
    for (const int i : order) {
        const dvec2 d(turn[i].x, -turn[i].y);
        const vec4& color = colors[std::size_t(i)];
        batch.line(centre, centre + d * kLength, 2.4, color);
        const dvec2 end = centre + d * kLength;
        batch.disc(end, 7.0, color);
        for (const auto& [a, b] : kLetters[std::size_t(i)]) {
            batch.line(end + a * 2.8, end + b * 2.8, 1.4, vec4(1.0F));
        }
    }
}

void draw_grid(OverlayBatch& batch, const CameraController& camera) {
    constexpr int kHalf = 10;
    for (int i = -kHalf; i <= kHalf; ++i) {
        const float alpha = i == 0 ? 0.55F : (i % 5 == 0 ? 0.4F : 0.2F);
        const vec4 color(0.75F, 0.75F, 0.75F, alpha);
        batch.line3(camera, dvec3(i, 0, -kHalf), dvec3(i, 0, kHalf), 1.2, color);
        batch.line3(camera, dvec3(-kHalf, 0, i), dvec3(kHalf, 0, i), 1.2, color);
    }
}

} // namespace atrium::ui
