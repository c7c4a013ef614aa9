#include "engine/particles/area_sources.h"

#include "engine/base/rng.h"

#include <algorithm>

namespace atrium {
namespace {

// Mean over a ball of directions, as seen from a leaf, of the cosine above the leaf's horizon, about: `slack` is what the
// ball's size and the leaf's curvature add to the cosine of its middle.
double facing(double cosine, double slack) {
    if (cosine >= slack) {
        return cosine;
    }
    return cosine > -slack ? (cosine + slack) * (cosine + slack) / (4.0 * slack) : 0.0;
}

LeafShape shape_of(const Hierarchy& emitters, const RayScene& rays, std::uint32_t leaf) {
    constexpr std::uint32_t kPoints = 16;
    std::array<dvec3, kPoints> at;
    dvec3 mean(0.0), normal(0.0);
    for (std::uint32_t k = 0; k < kPoints; ++k) {
        const vec2 u = sobol_owen2(k, 0, std::uint32_t(emitters.elements[leaf].path));
        const SurfacePoint p = sample_point(emitters, rays, leaf, u, false);
        at[k] = dvec3(p.position);
        mean += at[k] / double(kPoints);
        normal += dvec3(p.normal) / double(kPoints);
    }
    dmat3 spread(0.0);
    for (const dvec3& p : at) {
        spread += glm::outerProduct(p - mean, p - mean) / double(kPoints);
    }
    return {vec3(mean), vec3(normal), mat3(spread)};
}

// Neighbours in the streams' numbers are neighbours on the source: leaves along a curve that fills space (Morton order).
void sort_leaves(const Hierarchy& emitters, bool matt, ParticleSource& source) {
    Box3 bounds;
    for (const LeafShape& leaf : source.shape) {
        bounds.add(leaf.at);
    }
    const vec3 scale = vec3(1023.0F) / glm::max(bounds.size(), vec3(1e-12F));
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order; // code, place
    for (std::uint32_t i = 0; i < source.leaves.size(); ++i) {
        const vec3 at = (source.shape[i].at - bounds.min) * scale;
        std::uint32_t code = 0;
        for (unsigned bit = 0; bit < 10; ++bit) {
            for (int k = 0; k < 3; ++k) {
                code |= ((std::uint32_t(at[k]) >> bit) & 1U) << (3U * bit + unsigned(k));
            }
        }
        order.emplace_back(code, i);
    }
    std::sort(order.begin(), order.end());
    const std::vector<std::uint32_t> leaves = std::move(source.leaves);
    const std::vector<LeafShape> shape = std::move(source.shape);
    source.leaves.clear();
    source.shape.clear();
    for (const auto& [code, i] : order) {
        const Element& e = emitters.elements[leaves[i]];
        source.leaves.push_back(leaves[i]);
        source.shape.push_back(shape[i]);
        const Rgb& exitance = matt ? e.radiosity : e.emitted;
        source.power.push_back(double(e.area) * luminance(exitance) + (source.power.empty() ? 0.0 : source.power.back()));
        if (matt) {
            source.radiosity.push_back(exitance);
        }
    }
    source.first_radiosity = source.radiosity;
}

vec3 centre_of(const ParticleSource& source) {
    dvec3 centre(0.0);
    for (std::size_t i = 0; i < source.leaves.size(); ++i) {
        centre += dvec3(source.shape[i].at) * (source.power[i] - (i > 0 ? source.power[i - 1] : 0.0));
    }
    return vec3(centre / source.power.back());
}

} // namespace

ParticleSource area_source(const Hierarchy& emitters, const RayScene& rays, std::uint32_t surface,
                           std::vector<std::uint32_t> leaves, bool matt) {
    ParticleSource source;
    source.leaves = std::move(leaves);
    for (const std::uint32_t leaf : source.leaves) {
        source.shape.push_back(shape_of(emitters, rays, leaf));
    }
    sort_leaves(emitters, matt, source);
    source.centre = centre_of(source);
    source.has_size = true;
    source.surface = surface;
    source.key = hash_combine(matt ? 0x3A77ULL : 0xA4EAULL, surface);
    return source;
}

ParticleSource followed(ParticleSource source, const Hierarchy& emitters, const RayScene& rays) {
    for (std::size_t i = 0; i < source.leaves.size(); ++i) {
        source.shape[i] = shape_of(emitters, rays, source.leaves[i]);
    }
    source.centre = centre_of(source);
    return source;
}

void aim_leaves(const ParticleSource& source, const SpecularTarget& target, ParticleAim& aim) {
    constexpr double kLeast = 0.02; // of a leaf that faces the target
    const dvec3 centre(target.bounds.centre());
    const double radius = 0.5 * double(target.bounds.diagonal());
    const double away = std::max(glm::length(centre - dvec3(source.centre)), radius);
    auto weights = std::make_shared<std::vector<double>>();
    weights->reserve(source.leaves.size());
    double total = 0.0;
    dvec3 middle(0.0);
    for (std::size_t i = 0; i < source.leaves.size(); ++i) {
        const LeafShape& leaf = source.shape[i];
        const dvec3 there = centre - dvec3(leaf.at);
        const double distance = std::max(glm::length(there), 1e-9);
        const double slack = std::min(radius / distance, 1.0) + 1.0 - double(glm::length(leaf.normal));
        const double seen = facing(glm::dot(dvec3(leaf.normal), there) / distance, slack);
        const double nearer = away / std::max(distance, radius);
        const double power = source.power[i] - (i > 0 ? source.power[i - 1] : 0.0);
        const double weight = power * std::max(seen, kLeast) * nearer * nearer;
        total += weight;
        weights->push_back(total);
        middle += dvec3(leaf.at) * weight;
    }
    middle /= total;
    // Spread of the light across the way to the target.
    vec3 t;
    vec3 b;
    const dvec3 to_centre = centre - middle;
    const double distance = glm::length(to_centre);
    make_frame(distance > 0.0 ? vec3(to_centre / distance) : vec3(0.0F, 0.0F, 1.0F), t, b);
    const dvec3 x(t), y(b);
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (std::size_t i = 0; i < source.leaves.size(); ++i) {
        const double w = ((*weights)[i] - (i > 0 ? (*weights)[i - 1] : 0.0)) / total;
        const dmat3 spread(source.shape[i].spread);
        const dvec3 d = dvec3(source.shape[i].at) - middle;
        const double dx = glm::dot(d, x), dy = glm::dot(d, y);
        xx += w * (glm::dot(x, spread * x) + dx * dx);
        xy += w * (glm::dot(x, spread * y) + dx * dy);
        yy += w * (glm::dot(y, spread * y) + dy * dy);
    }
    // A root of 12 times the covariance, by its Cholesky factor: any conjugate axes will do.
    const double first = std::sqrt(std::max(xx, 0.0));
    const double slope = first > 0.0 ? xy / first : 0.0;
    const double root12 = std::sqrt(12.0);
    aim.extent = {vec3((x * first + y * slope) * root12), vec3(y * std::sqrt(std::max(yy - slope * slope, 0.0)) * root12)};
    aim.leaves = std::move(weights);
}

} // namespace atrium
