#include "engine/particles/emission.h"

#include "engine/base/rng.h"
#include "engine/particles/area_sources.h"

#include <algorithm>
#include <map>

namespace atrium {
namespace {

// Square to disc, strata kept compact (Shirley & Chiu 1997).
vec2 concentric(const vec2& u) {
    const vec2 v = 2.0F * u - vec2(1.0F);
    if (std::abs(v.x) > std::abs(v.y)) {
        const float angle = 0.25F * kPi * (v.y / v.x);
        return v.x * vec2(std::cos(angle), std::sin(angle));
    }
    if (v.y != 0.0F) {
        const float angle = 0.5F * kPi - 0.25F * kPi * (v.x / v.y);
        return v.y * vec2(std::cos(angle), std::sin(angle));
    }
    return vec2(0.0F);
}

std::array<vec3, 8> corners(const Box3& b) {
    std::array<vec3, 8> out;
    for (std::size_t i = 0; i < 8; ++i) {
        out[i] =
            vec3((i & 1U) != 0 ? b.max.x : b.min.x, (i & 2U) != 0 ? b.max.y : b.min.y, (i & 4U) != 0 ? b.max.z : b.min.z);
    }
    return out;
}

// Smallest rectangle across `axis` around the points, over rotations by steps: bounds of the box's silhouette.
template <class Project>
ParticleAim smallest_window(const vec3& axis, const std::array<vec3, 8>& points, Project&& project) {
    vec3 t;
    vec3 b;
    make_frame(axis, t, b);
    std::array<vec2, 8> flat;
    for (std::size_t i = 0; i < 8; ++i) {
        flat[i] = project(points[i], t, b);
    }
    ParticleAim best;
    float least = std::numeric_limits<float>::infinity();
    constexpr int kTurns = 16;
    for (int k = 0; k < kTurns; ++k) {
        const float angle = 0.5F * kPi * float(k) / kTurns;
        const vec2 e(std::cos(angle), std::sin(angle));
        vec2 low(std::numeric_limits<float>::infinity());
        vec2 high(-std::numeric_limits<float>::infinity());
        for (const vec2& p : flat) {
            const vec2 q(p.x * e.x + p.y * e.y, -p.x * e.y + p.y * e.x);
            low = glm::min(low, q);
            high = glm::max(high, q);
        }
        const vec2 size = high - low;
        if (size.x * size.y < least) {
            least = size.x * size.y;
            best.axis = axis;
            best.a = t * e.x + b * e.y;
            best.b = b * e.x - t * e.y;
            best.low = low;
            best.high = high;
            best.window = true;
        }
    }
    return best;
}

// A box as a point sees it, on the plane at distance 1 across the aim's axis; false where it is too close for that.
bool look_at_box(const vec3& origin, const Box3& bounds, ParticleAim& aim) {
    aim.low = vec2(std::numeric_limits<float>::infinity());
    aim.high = vec2(-std::numeric_limits<float>::infinity());
    for (const vec3& c : corners(bounds)) {
        const vec3 d = c - origin;
        const float depth = glm::dot(d, aim.axis);
        if (!(depth > 0.0F) || depth * depth < 0.04F * glm::dot(d, d)) {
            return false;
        }
        const vec2 at = vec2(glm::dot(d, aim.a), glm::dot(d, aim.b)) / depth;
        aim.low = glm::min(aim.low, at);
        aim.high = glm::max(aim.high, at);
    }
    return true;
}

// A direction over the aim's window, and the solid angle over the square of u there.
void through_window(const ParticleAim& aim, const vec2& u, vec3& direction, float& solid_angle, vec3& du, vec3& dv) {
    const vec2 size = glm::max(aim.high - aim.low, vec2(1e-7F));
    const vec2 at = aim.low + u * size;
    const vec3 v = aim.axis + at.x * aim.a + at.y * aim.b;
    const float length = glm::length(v);
    direction = v / length;
    solid_angle = size.x * size.y / (length * length * length);
    du = (aim.a - direction * glm::dot(direction, aim.a)) * (size.x / length);
    dv = (aim.b - direction * glm::dot(direction, aim.b)) * (size.y / length);
}

// From close by or inside: a cone about the ball around the bounds, or all round.
void through_cone(const vec3& origin, const Box3& bounds, const vec2& u, vec3& direction, float& solid_angle, vec3& du,
                  vec3& dv) {
    const vec3 to_centre = bounds.centre() - origin;
    const float distance = glm::length(to_centre);
    const float radius = 0.5F * bounds.diagonal();
    const vec3 axis = distance > 0.0F ? to_centre / distance : vec3(0.0F, 0.0F, 1.0F);
    const float sine = distance > 0.0F ? radius / distance : 2.0F;
    const float lowest = sine < 1.0F ? std::sqrt(1.0F - sine * sine) : -1.0F;
    vec3 t;
    vec3 b;
    make_frame(axis, t, b);
    const auto at = [&](const vec2& w) {
        const vec2 d = concentric(w);
        const float r2 = std::min(glm::dot(d, d), 1.0F);
        const float z = 1.0F - r2 * (1.0F - lowest);
        const float k = std::sqrt(std::max((1.0F - lowest) * (2.0F - r2 * (1.0F - lowest)), 0.0F));
        return glm::normalize(k * d.x * t + k * d.y * b + z * axis);
    };
    direction = at(u);
    solid_angle = 2.0F * kPi * (1.0F - lowest);
    constexpr float kStep = 1e-3F;
    const vec2 step(u.x < 0.5F ? kStep : -kStep, u.y < 0.5F ? kStep : -kStep);
    du = (at({u.x + step.x, u.y}) - direction) / step.x;
    dv = (at({u.x, u.y + step.y}) - direction) / step.y;
}

bool emit_sun(const ParticleSource& source, const SpecularTarget& target, const ParticleAim& w, const vec4& u,
              Emission& out) {
    const vec3 axis = source.light.axis;
    const float radius = source.sun_radius;
    const vec3 centre = target.bounds.centre();
    const vec2 size = w.high - w.low;
    vec3 t;
    vec3 b;
    make_frame(axis, t, b);
    const vec2 disc = radius * concentric({u.z, u.w});
    out.direction = glm::normalize(axis + disc.x * t + disc.y * b);
    const vec3 at = centre + w.a * (w.low.x + u.x * size.x) + w.b * (w.low.y + u.y * size.y);
    const float away = source.reach + glm::length(at) + 1.0F;
    out.origin = at - out.direction * away;
    out.throughput = Rgb(size.x * size.y);
    out.d_origin = {w.a * size.x, w.b * size.y, vec3(0.0F), vec3(0.0F)};
    // A disc spreads as a strip of 1.73 radii does.
    out.d_direction = {vec3(0.0F), vec3(0.0F), t * (1.7320508F * radius), b * (1.7320508F * radius)};
    out.d_origin[2] = -out.d_direction[2] * away;
    out.d_origin[3] = -out.d_direction[3] * away;
    return true;
}

bool emit_area(const ParticleSource& source, const SpecularTarget& target, const ParticleAim& aim, const Hierarchy& emitters,
               const RayScene& rays, const vec4& u, Emission& out) {
    const std::vector<double>& weights = *aim.leaves;
    const double total = weights.back();
    const double pick = double(u.z) * total;
    const auto at = std::min(std::upper_bound(weights.begin(), weights.end(), pick) - weights.begin(),
                             std::ptrdiff_t(weights.size()) - 1);
    const double below = at > 0 ? weights[std::size_t(at - 1)] : 0.0;
    const double share = weights[std::size_t(at)] - below;
    const std::uint32_t leaf = source.leaves[std::size_t(at)];
    const Element& e = emitters.elements[leaf];
    const vec2 v(float(std::clamp((pick - below) / share, 0.0, 0.99999994)), u.w);
    const SurfacePoint from = sample_point(emitters, rays, leaf, v, false);
    float solid_angle = 0.0F;
    vec3 du;
    vec3 dv;
    ParticleAim from_here = aim; // turned as from the source's middle, which is about right
    if (aim.window && look_at_box(from.position, target.bounds, from_here)) {
        through_window(from_here, {u.x, u.y}, out.direction, solid_angle, du, dv);
    } else {
        through_cone(from.position, target.bounds, {u.x, u.y}, out.direction, solid_angle, du, dv);
    }
    const float cosine = glm::dot(from.normal, out.direction);
    if (!(cosine > 0.0F)) {
        return false;
    }
    const vec3 size = glm::abs(from.position);
    out.origin = from.position + from.normal * std::max(1e-5F, 5e-7F * max_component(size));
    out.leaf = std::uint32_t(at);
    // Exitance over pi is radiance; the point has the density of its leaf's share of the weights over the leaf's area.
    const Rgb exitance = source.matt() ? Rgb(1.0F) : e.emitted;
    out.throughput = exitance * float(kInvPi * cosine * solid_angle * e.area * total / share);
    const float distance = std::max(glm::length(target.bounds.centre() - source.centre), 0.5F * target.bounds.diagonal());
    out.d_origin = {vec3(0.0F), vec3(0.0F), aim.extent[0], aim.extent[1]};
    out.d_direction = {du, dv, vec3(0.0F), vec3(0.0F)};
    for (std::size_t k = 0; k < 2; ++k) { // from elsewhere on the source it would be aimed at the same place
        const vec3 across = aim.extent[k] - out.direction * glm::dot(out.direction, aim.extent[k]);
        out.d_direction[2 + k] = -across / distance;
    }
    return true;
}

} // namespace

bool sends_alike(const ParticleSource& a, const ParticleSource& b) {
    const Light& l = a.light.light;
    const Light& m = b.light.light;
    return l.kind == m.kind && l.photometry == m.photometry && a.light.right == b.light.right &&
           l.inner_cone == m.inner_cone && l.outer_cone == m.outer_cone && a.light.position == b.light.position &&
           a.light.axis == b.light.axis && a.leaves == b.leaves && a.power == b.power && a.shape == b.shape &&
           a.centre == b.centre && a.sun_radius == b.sun_radius && a.has_size == b.has_size && a.reach == b.reach &&
           a.surface == b.surface && a.key == b.key;
}

float scene_reach(const RayScene& rays) {
    const Box3 all = rays.bounds();
    const float corner = glm::length(glm::max(glm::abs(all.min), glm::abs(all.max)));
    float reach = 1.0F;
    while (reach < corner && std::isfinite(corner)) {
        reach *= 2.0F;
    }
    return reach;
}

std::vector<ParticleSource> particle_sources(const DirectLight& direct, const Hierarchy& emitters, const RayScene& rays) {
    std::vector<ParticleSource> out;
    const float reach = scene_reach(rays);
    for (const PlacedLight& light : direct.lights()) {
        ParticleSource source;
        source.light = light;
        source.radiance = light.light.color * light.light.intensity;
        if (light.light.kind == Light::Kind::Directional) {
            source.sun_radius = std::tan(float(radians_from_degrees(0.5 * light.light.angular_diameter_degrees)));
            source.has_size = source.sun_radius > 0.0F;
            source.reach = reach;
        }
        source.key = hash_combine(0x1A3BULL, out.size());
        out.push_back(std::move(source));
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_surface;
    for (std::uint32_t i = 0; i < emitters.elements.size(); ++i) {
        const Element& e = emitters.elements[i];
        if (e.leaf() && double(e.area) * luminance(e.emitted) > 0.0) {
            by_surface[e.kind == Element::Kind::Patch ? e.surface : emitters.faces[e.triangle].surface].push_back(i);
        }
    }
    for (auto& [surface, leaves] : by_surface) {
        out.push_back(area_source(emitters, rays, surface, std::move(leaves), false));
    }
    return out;
}

ParticleAim make_aim(const ParticleSource& source, const SpecularTarget& target) {
    const auto box = corners(target.bounds);
    const vec3 centre = target.bounds.centre();
    if (source.leaves.empty() && source.light.light.kind == Light::Kind::Directional) {
        ParticleAim out = smallest_window(source.light.axis, box, [&](const vec3& c, const vec3& t, const vec3& b) {
            return vec2(glm::dot(c - centre, t), glm::dot(c - centre, b));
        });
        const float diagonal = target.bounds.diagonal(); // the disc's outer rays cross the target's depth aslant
        const vec2 margin(source.sun_radius * 0.5F * diagonal + 1e-6F * diagonal);
        out.low -= margin;
        out.high += margin;
        return out;
    }
    const vec3 origin = source.leaves.empty() ? source.light.position : source.centre;
    const vec3 to_centre = centre - origin;
    const float distance = glm::length(to_centre);
    ParticleAim out;
    if (!source.leaves.empty()) {
        aim_leaves(source, target, out);
    }
    if (!(distance > 0.525F * target.bounds.diagonal())) {
        return out;
    }
    const ParticleAim window = smallest_window(to_centre / distance, box, [&](const vec3& c, const vec3& t, const vec3& b) {
        const vec3 d = c - origin;
        return vec2(glm::dot(d, t), glm::dot(d, b)) / std::max(glm::dot(d, to_centre / distance), 1e-6F);
    });
    out.axis = window.axis;
    out.a = window.a;
    out.b = window.b;
    out.window = look_at_box(origin, target.bounds, out);
    return out;
}

bool emit(const ParticleSource& source, const SpecularTarget& target, const ParticleAim& aim, const Hierarchy& emitters,
          const RayScene& rays, const vec4& u, Emission& out) {
    if (!source.leaves.empty()) {
        return emit_area(source, target, aim, emitters, rays, u, out);
    }
    if (source.light.light.kind == Light::Kind::Directional) {
        return emit_sun(source, target, aim, u, out);
    }
    float solid_angle = 0.0F;
    vec3 du;
    vec3 dv;
    if (aim.window) {
        through_window(aim, {u.x, u.y}, out.direction, solid_angle, du, dv);
    } else {
        through_cone(source.light.position, target.bounds, {u.x, u.y}, out.direction, solid_angle, du, dv);
    }
    const float shape = source.light.distribution(out.direction);
    out.origin = source.light.position;
    out.throughput = Rgb(solid_angle * shape);
    out.d_origin = {};
    out.d_direction = {du, dv, vec3(0.0F), vec3(0.0F)};
    return shape > 0.0F;
}

} // namespace atrium
