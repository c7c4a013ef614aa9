#include "engine/measure/light_range.h"

#include <algorithm>
#include <cmath>

namespace atrium {
namespace {

constexpr std::size_t kPoints = 16384;
constexpr double kDark = 0.05; ///< of the area, left out at the lower end
constexpr double kBright = 0.01;
constexpr double kHidden = 0.05; ///< of the median: what gets less lies inside or behind things

struct Side {
    const SurfaceLayer* layer;
    bool back;
    double reflectance; ///< of luminance
    double emitted;     ///< cd/m2
    dmat3 to_world;
};

/// Points evenly spread over the unit square: M. Roberts' R2 sequence (2018).
vec2 spread(std::size_t i) {
    const double x = 0.5 + 0.7548776662466927 * double(i);
    const double y = 0.5 + 0.5698402909980532 * double(i);
    return {float(x - std::floor(x)), float(y - std::floor(y))};
}

double triangle_area(const Side& side, std::size_t first) {
    const DisplayMesh& mesh = *side.layer->mesh;
    const vec3 &a = mesh.positions[mesh.indices[first]], &b = mesh.positions[mesh.indices[first + 1]],
               &c = mesh.positions[mesh.indices[first + 2]];
    return 0.5 * glm::length(glm::cross(side.to_world * dvec3(b - a), side.to_world * dvec3(c - a)));
}

double amount_at(const Side& side, std::size_t first, vec2 at, LightQuantity quantity, const LightShares& shares) {
    if (at.x + at.y > 1.0F) {
        at = vec2(1.0F) - at;
    }
    const std::uint32_t* v = &side.layer->mesh->indices[first];
    const double illuminance =
        std::max(double(luminance(irradiance_at(*side.layer, {v[0], v[1], v[2]}, vec3(1.0F - at.x - at.y, at.x, at.y),
                                                side.back, shares))),
                 0.0);
    return quantity == LightQuantity::Illuminance ? illuminance : side.emitted + side.reflectance * illuminance / kPiD;
}

} // namespace

std::vector<double> light_amounts(const Scene& scene, const Solution& solution, LightQuantity quantity,
                                  const LightShares& shares, const std::unordered_set<NodeId>* of) {
    std::vector<Side> sides;
    for (const auto& layer : solution.surfaces) {
        const Node* node = scene.nodes.find(layer->node);
        if ((of != nullptr && !of->contains(layer->node)) || node == nullptr ||
            layer->irradiance_front.size() < layer->mesh->positions.size()) {
            continue;
        }
        const Material* of_node = scene.material_of(*node, layer->part);
        const Material& material = of_node != nullptr ? *of_node : default_material();
        if (classify(material) != MaterialKind::Diffuse) {
            continue;
        }
        const double reflectance = double(luminance(diffuse_reflectance(material)));
        const double emitted = shares.direct ? double(luminance(material.emitted_radiance())) : 0.0;
        const dmat3 to_world(scene.world_matrix(layer->node));
        sides.push_back({layer.get(), false, reflectance, emitted, to_world});
        if (layer->has_back() && material.double_sided) {
            sides.push_back({layer.get(), true, reflectance, emitted, to_world});
        }
    }
    double area = 0.0;
    for (const Side& side : sides) {
        for (std::size_t t = 0; t + 2 < side.layer->mesh->indices.size(); t += 3) {
            area += triangle_area(side, t);
        }
    }
    if (!(area > 0.0)) {
        return {};
    }
    std::vector<double> amounts;
    amounts.reserve(kPoints);
    double passed = 0.0; // in points
    for (const Side& side : sides) {
        for (std::size_t t = 0; t + 2 < side.layer->mesh->indices.size(); t += 3) {
            passed += triangle_area(side, t) / area * double(kPoints);
            while (double(amounts.size()) + 0.5 < passed && amounts.size() < kPoints) {
                amounts.push_back(amount_at(side, t, spread(amounts.size()), quantity, shares));
            }
        }
    }
    std::sort(amounts.begin(), amounts.end());
    return amounts;
}

std::vector<float> light_bars(const FalseColor& scale, std::span<const double> amounts, std::size_t bars) {
    std::vector<float> out(amounts.empty() ? 0 : bars, 0.0F);
    for (const double amount : amounts) {
        ++out[std::min(std::size_t(std::max(scale_place(scale, amount), 0.0F) * float(bars)), bars - 1)];
    }
    const float most = out.empty() ? 1.0F : *std::max_element(out.begin(), out.end());
    for (float& bar : out) {
        bar /= most;
    }
    return out;
}

LightRange light_range(const Scene& scene, const Solution& solution, LightQuantity quantity, const LightShares& shares) {
    const std::vector<double> amounts = light_amounts(scene, solution, quantity, shares, nullptr);
    if (amounts.empty()) {
        return {};
    }
    const auto at = [&](double share) { return amounts[std::size_t(share * double(amounts.size() - 1))]; };
    return {std::max(at(kDark), kHidden * at(0.5)), at(1.0 - kBright)};
}

FalseColor fitted_scale(FalseColor scale, const LightRange& range) {
    if (!(range.high > 0.0)) {
        return valid_scale(scale);
    }
    scale.maximum = round_up(range.high);
    scale.minimum = scale.logarithmic ? round_down(std::clamp(range.low, 1e-3 * scale.maximum, 0.1 * scale.maximum)) : 0.0;
    return valid_scale(scale);
}

} // namespace atrium
