#include "engine/particles/emission.h"

#include "engine/base/rng.h"

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

// A frame across `axis` in which the box looks small: turned with the silhouette's longest diagonal or kept with an edge.
struct Window {
    vec3 a{0.0F}; // unit, across the axis
    vec3 b{0.0F};
    vec2 low{0.0F};
    vec2 high{0.0F};
};

// Smallest rectangle across `axis` around the points, over rotations by steps: bounds of the box's silhouette.
template <class Project> Window smallest_window(const vec3& axis, const std::array<vec3, 8>& points, Project&& project) {
    vec3 t;
    vec3 b;
    make_frame(axis, t, b);
    std::array<vec2, 8> flat;
    for (std::size_t i = 0; i < 8; ++i) {
        flat[i] = project(points[i], t, b);
    }
    Window best;
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
            best = {t * e.x + b * e.y, b * e.x - t * e.y, low, high};
        }
    }
    return best;
}

// Directions from a point over the bounds of a target. `density` is the solid angle over the square of u at the direction.
bool aim(const vec3& origin, const Box3& bounds, const vec2& u, vec3& direction, float& solid_angle, vec3& du, vec3& dv) {
    const vec3 to_centre = bounds.centre() - origin;
    const float distance = glm::length(to_centre);
    const float radius = 0.5F * bounds.diagonal();
    const auto box = corners(bounds);
    bool in_front = distance > 1.05F * radius;
    const vec3 axis = distance > 0.0F ? to_centre / distance : vec3(0.0F, 0.0F, 1.0F);
    for (const vec3& c : box) {
        in_front = in_front && glm::dot(c - origin, axis) > 0.2F * glm::length(c - origin);
    }
    if (in_front) {
        // A rectangle on the plane at distance 1.
        const Window w = smallest_window(axis, box, [&](const vec3& c, const vec3& t, const vec3& b) {
            const vec3 d = c - origin;
            return vec2(glm::dot(d, t), glm::dot(d, b)) / glm::dot(d, axis);
        });
        const vec2 size = glm::max(w.high - w.low, vec2(1e-7F));
        const vec2 at = w.low + u * size;
        const vec3 v = axis + at.x * w.a + at.y * w.b;
        const float length = glm::length(v);
        direction = v / length;
        solid_angle = size.x * size.y / (length * length * length);
        du = (w.a - direction * glm::dot(direction, w.a)) * (size.x / length);
        dv = (w.b - direction * glm::dot(direction, w.b)) * (size.y / length);
        return solid_angle > 0.0F;
    }
    // From close by or inside: a cone about the ball around the bounds, or all round.
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
    return true;
}

bool emit_sun(const ParticleSource& source, const SpecularTarget& target, const RayScene& rays, const vec4& u,
              Emission& out) {
    const vec3 axis = source.light.axis;
    const float radius = std::tan(float(radians_from_degrees(0.5 * source.light.light.angular_diameter_degrees)));
    const vec3 centre = target.bounds.centre();
    Window w = smallest_window(axis, corners(target.bounds), [&](const vec3& c, const vec3& t, const vec3& b) {
        return vec2(glm::dot(c - centre, t), glm::dot(c - centre, b));
    });
    const vec2 margin(radius * 0.5F * target.bounds.diagonal() + 1e-6F * target.bounds.diagonal());
    w.low -= margin;
    w.high += margin;
    const vec2 size = w.high - w.low;
    vec3 t;
    vec3 b;
    make_frame(axis, t, b);
    const vec2 disc = radius * concentric({u.z, u.w});
    out.direction = glm::normalize(axis + disc.x * t + disc.y * b);
    const vec3 at = centre + w.a * (w.low.x + u.x * size.x) + w.b * (w.low.y + u.y * size.y);
    const Box3 all = rays.bounds();
    const float away = all.diagonal() + glm::length(at - all.centre()) + 1.0F;
    out.origin = at - out.direction * away;
    out.throughput = Rgb(size.x * size.y);
    out.d_origin = {w.a * size.x, w.b * size.y, vec3(0.0F), vec3(0.0F)};
    // A disc spreads as a strip of 1.73 radii does.
    out.d_direction = {vec3(0.0F), vec3(0.0F), t * (1.7320508F * radius), b * (1.7320508F * radius)};
    out.d_origin[2] = -out.d_direction[2] * away;
    out.d_origin[3] = -out.d_direction[3] * away;
    return true;
}

bool emit_area(const ParticleSource& source, const SpecularTarget& target, const Hierarchy& emitters, const RayScene& rays,
               const vec4& u, Emission& out) {
    const double total = source.power.back();
    const double pick = double(u.z) * total;
    const auto at = std::min(std::upper_bound(source.power.begin(), source.power.end(), pick) - source.power.begin(),
                             std::ptrdiff_t(source.power.size()) - 1);
    const double below = at > 0 ? source.power[std::size_t(at - 1)] : 0.0;
    const double share = source.power[std::size_t(at)] - below;
    const std::uint32_t leaf = source.leaves[std::size_t(at)];
    const Element& e = emitters.elements[leaf];
    const vec2 v(float(std::clamp((pick - below) / share, 0.0, 0.99999994)), u.w);
    const SurfacePoint from = sample_point(emitters, rays, leaf, v, false);
    float solid_angle = 0.0F;
    vec3 du;
    vec3 dv;
    if (!aim(from.position, target.bounds, {u.x, u.y}, out.direction, solid_angle, du, dv)) {
        return false;
    }
    const float cosine = glm::dot(from.normal, out.direction);
    if (!(cosine > 0.0F)) {
        return false;
    }
    const vec3 size = glm::abs(from.position);
    out.origin = from.position + from.normal * std::max(1e-5F, 5e-7F * max_component(size));
    // Exitance over pi is radiance; the point has the density of its leaf's share of the power over the leaf's area.
    out.throughput = e.emitted * float(kInvPi * cosine * solid_angle * e.area * total / share);
    const float distance = std::max(glm::length(target.bounds.centre() - source.centre), 0.5F * target.bounds.diagonal());
    out.d_origin = {vec3(0.0F), vec3(0.0F), source.extent[0], source.extent[1]};
    out.d_direction = {du, dv, vec3(0.0F), vec3(0.0F)};
    for (std::size_t k = 0; k < 2; ++k) { // from elsewhere on the source it would be aimed at the same place
        const vec3 across = source.extent[k] - out.direction * glm::dot(out.direction, source.extent[k]);
        out.d_direction[2 + k] = -across / distance;
    }
    return true;
}

// Axes of the two largest spreads of points with weights, by power iteration on their covariance.
std::array<vec3, 2> spread_axes(const std::vector<std::pair<vec3, double>>& points, const vec3& centre) {
    dmat3 c(0.0);
    double total = 0.0;
    for (const auto& [p, w] : points) {
        const dvec3 d(p - centre);
        c += w * glm::outerProduct(d, d);
        total += w;
    }
    std::array<vec3, 2> out{vec3(0.0F), vec3(0.0F)};
    if (!(total > 0.0)) {
        return out;
    }
    c = c / total;
    for (vec3& axis : out) {
        dvec3 v(0.577, 0.578, 0.5771);
        double value = 0.0;
        for (int i = 0; i < 64; ++i) {
            const dvec3 next = c * v;
            value = glm::length(next);
            if (!(value > 1e-18)) {
                break;
            }
            v = next / value;
        }
        if (!(value > 1e-18)) {
            break;
        }
        axis = vec3(v * std::sqrt(12.0 * value));
        c -= value * glm::outerProduct(v, v);
    }
    return out;
}

} // namespace

std::vector<ParticleSource> particle_sources(const DirectLight& direct, const Hierarchy& emitters, const RayScene& rays) {
    std::vector<ParticleSource> out;
    for (const PlacedLight& light : direct.lights()) {
        ParticleSource source;
        source.light = light;
        source.radiance = light.light.color * light.light.intensity;
        source.key = hash_combine(0x1A3BULL, out.size());
        out.push_back(std::move(source));
    }
    std::map<std::uint32_t, ParticleSource> by_surface;
    std::map<std::uint32_t, std::vector<std::pair<vec3, double>>> points;
    for (std::uint32_t i = 0; i < emitters.elements.size(); ++i) {
        const Element& e = emitters.elements[i];
        const double power = double(e.area) * luminance(e.emitted);
        if (!e.leaf() || !(power > 0.0)) {
            continue;
        }
        const std::uint32_t surface = e.kind == Element::Kind::Patch ? e.surface : emitters.faces[e.triangle].surface;
        ParticleSource& source = by_surface[surface];
        source.leaves.push_back(i);
        source.power.push_back(power + (source.power.empty() ? 0.0 : source.power.back()));
        for (std::uint32_t k = 0; k < 16; ++k) {
            const SurfacePoint p = sample_point(emitters, rays, i, sobol_owen2(k, 0, std::uint32_t(e.path)), false);
            points[surface].emplace_back(p.position, power);
        }
    }
    for (auto& [surface, source] : by_surface) {
        dvec3 centre(0.0);
        double total = 0.0;
        for (const auto& [p, w] : points[surface]) {
            centre += dvec3(p) * w;
            total += w;
        }
        source.centre = vec3(centre / total);
        source.extent = spread_axes(points[surface], source.centre);
        source.key = hash_combine(0xA4EAULL, surface);
        out.push_back(std::move(source));
    }
    return out;
}

bool emit(const ParticleSource& source, const SpecularTarget& target, const Hierarchy& emitters, const RayScene& rays,
          const vec4& u, Emission& out) {
    if (!source.leaves.empty()) {
        return emit_area(source, target, emitters, rays, u, out);
    }
    if (source.light.light.kind == Light::Kind::Directional) {
        return emit_sun(source, target, rays, u, out);
    }
    float solid_angle = 0.0F;
    vec3 du;
    vec3 dv;
    if (!aim(source.light.position, target.bounds, {u.x, u.y}, out.direction, solid_angle, du, dv)) {
        return false;
    }
    float shape = 1.0F;
    if (source.light.light.kind == Light::Kind::Spot) {
        shape = spot_falloff(source.light.light, glm::dot(out.direction, source.light.axis));
    }
    out.origin = source.light.position;
    out.throughput = Rgb(solid_angle * shape);
    out.d_origin = {};
    out.d_direction = {du, dv, vec3(0.0F), vec3(0.0F)};
    return shape > 0.0F;
}

} // namespace atrium
