#include "engine/raycast/mirror_sight.h"

#include "engine/raycast/light_walk.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr float kEdge = 1e-6F; // relative: what lies so close to an edge of the rectangle is left to the rays to judge
constexpr int kMostPanes = 64; // between a point and a mirror

} // namespace

MirrorSight::MirrorSight(const RayScene& rays, const PlanarMirrors& mirrors, std::uint32_t mirror, const vec3& point,
                         const vec3& normal)
    : rays_(rays), mirrors_(mirrors), mirror_(mirror), point_(point) {
    const PlanarMirror& m = mirrors.mirrors()[mirror];
    const double height = m.height(point);
    image_ = m.reflect_point(point);
    image_normal_ = m.reflect_direction(normal);
    fills_ = m.fills;
    height_ = float(std::abs(height));
    if (!(height > 0.0 || m.both_sides) || !(height_ > 1e-6F * (1.0F + max_component(glm::abs(point))))) {
        return;
    }
    const double sign = height > 0.0 ? 1.0 : -1.0;
    side_ = vec3(sign * m.normal);
    for (const vec3& corner : m.corner) {
        sees_ = sees_ || glm::dot(corner - point, normal) > 0.0F;
    }
    const dvec3 eye = dvec3(point) - 2.0 * height * m.normal;
    for (std::size_t k = 0; k < 4; ++k) {
        // Inward as it is for an image behind the front; for one before it the other way round.
        const dvec3 n = sign * glm::cross(dvec3(m.corner[k]) - eye, dvec3(m.corner[(k + 1) % 4]) - eye);
        const double length = glm::length(n);
        edge_[k] = length > 0.0 ? vec3(n / length) : vec3(0.0F);
    }
}

bool MirrorSight::crosses(const vec3& to) const {
    const vec3 d = to - image_;
    const float slack = -kEdge * glm::length(d);
    return glm::dot(side_, d) > height_ && glm::dot(edge_[0], d) > slack && glm::dot(edge_[1], d) > slack &&
           glm::dot(edge_[2], d) > slack && glm::dot(edge_[3], d) > slack;
}

bool MirrorSight::misses(const vec3& centre, float radius) const {
    const vec3 d = centre - image_;
    return glm::dot(side_, d) < height_ - radius || glm::dot(edge_[0], d) < -radius || glm::dot(edge_[1], d) < -radius ||
           glm::dot(edge_[2], d) < -radius || glm::dot(edge_[3], d) < -radius;
}

bool MirrorSight::holds(const vec3& centre, float radius) const {
    const vec3 d = centre - image_;
    return glm::dot(side_, d) >= height_ + radius && glm::dot(edge_[0], d) >= radius && glm::dot(edge_[1], d) >= radius &&
           glm::dot(edge_[2], d) >= radius && glm::dot(edge_[3], d) >= radius;
}

MirrorSight::Cover MirrorSight::cover(const vec3& direction, float angle) const {
    const float reach = std::sin(angle) + kEdge;
    float least = glm::dot(side_, direction);
    for (const vec3& n : edge_) {
        least = std::min(least, glm::dot(n, direction));
    }
    return least < -reach ? Cover::None : least > reach ? Cover::Whole : Cover::Part;
}

std::size_t MirrorSight::clip(std::span<const vec3> polygon, std::array<vec3, kMaxCorners>& out) const {
    std::array<vec3, kMaxCorners> from;
    std::size_t count = std::min<std::size_t>(polygon.size(), kMaxCorners - 5); // each plane adds a corner at most
    std::copy_n(polygon.begin(), count, out.begin());
    for (std::size_t plane = 0; plane < 5 && count > 0; ++plane) {
        const vec3& n = plane < 4 ? edge_[plane] : side_;
        const float least = plane < 4 ? 0.0F : height_;
        std::array<float, kMaxCorners> inside;
        from = out;
        for (std::size_t i = 0; i < count; ++i) {
            inside[i] = glm::dot(n, from[i] - image_) - least;
        }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t j = (i + 1) % count;
            if (inside[i] >= 0.0F) {
                out[kept++] = from[i];
            }
            if ((inside[i] > 0.0F && inside[j] < 0.0F) || (inside[i] < 0.0F && inside[j] > 0.0F)) {
                out[kept++] = from[i] + (from[j] - from[i]) * (inside[i] / (inside[i] - inside[j]));
            }
        }
        count = kept < 3 ? 0 : kept;
    }
    return count;
}

Rgb MirrorSight::to_mirror(const vec3& direction, vec3& at) const {
    const vec3 real = direction - 2.0F * glm::dot(direction, side_) * side_;
    // No closer to the point than a shadow ray, which keeps clear of the surface that the point lies on.
    const float reach = height_ / std::max(glm::dot(direction, side_), 1e-6F);
    Ray ray{point_ + real * std::min(shadow_offset(point_), 0.1F * reach), real};
    Rgb through(1.0F);
    for (int crossing = 0; crossing < kMostPanes; ++crossing) {
        const Hit hit = rays_.nearest(ray);
        if (!hit) {
            return Rgb(0.0F);
        }
        if (mirrors_.mirror_at(hit) == mirror_) {
            at = hit_position(rays_, hit) + side_ * std::max(1e-5F, 5e-7F * max_component(glm::abs(point_)));
            return through * mirror_reflectance(rays_, hit, real);
        }
        through *= rays_.straight_through(hit, real);
        if (max_component(through) <= 1e-4F) {
            return Rgb(0.0F);
        }
        ray.origin += real * (hit.t + std::max(1e-5F, 1e-6F * max_component(glm::abs(ray.origin))));
    }
    return Rgb(0.0F);
}

Rgb MirrorSight::transmittance(const vec3& to) const {
    if (!crosses(to)) {
        return Rgb(0.0F);
    }
    vec3 at;
    const Rgb through = to_mirror(glm::normalize(to - image_), at);
    return max_component(through) > 0.0F ? through * rays_.transmittance(at, to) : through;
}

Rgb MirrorSight::transmittance_to_infinity(const vec3& direction) const {
    if (!(glm::dot(side_, direction) > 0.0F) ||
        std::any_of(edge_.begin(), edge_.end(), [&](const vec3& n) { return !(glm::dot(n, direction) > -kEdge); })) {
        return Rgb(0.0F);
    }
    vec3 at;
    const Rgb through = to_mirror(direction, at);
    return max_component(through) > 0.0F ? through * rays_.transmittance_to_infinity(at, direction) : through;
}

} // namespace atrium
