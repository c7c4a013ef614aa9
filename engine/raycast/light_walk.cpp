#include "engine/raycast/light_walk.h"

#include "engine/base/rng.h"

#include <algorithm>

namespace atrium {
namespace {

float next_number(std::uint64_t& seed) {
    seed = hash64(seed);
    return unit_float(std::uint32_t(seed >> 32));
}

bool lets_on(const Material& m) {
    return m.transmission > 0.0F || m.alpha_mode != Material::Alpha::Opaque || is_specular(m);
}

// Moves the ray on. Little light is left to chance.
bool leave(LightWay& way, Rgb left, const vec3& direction, const WayOn& how) {
    const float before = max_component(way.through);
    const float most = max_component(left);
    if (!(most > 0.0F) || !is_finite(left) || !is_finite(direction)) {
        return false;
    }
    if (most < kRouletteBelow * way.unit && most < before) {
        const float survival = most / std::min(kRouletteBelow * way.unit, before);
        if (next_number(way.seed) >= survival) {
            return false;
        }
        left /= survival;
    }
    way.ray = {off_surface(how.position, how.transmitted ? -how.geometric : how.geometric), direction};
    way.through = left;
    way.bends += how.straight ? 0U : 1U;
    return true;
}

// Backs of metals are black where the file says one-sided; both sides of glass are glass.
bool side_mirrors(const RayScene& rays, const Hit& hit, const Material& m) {
    return is_specular(m) && (hit.front || rays.surfaces()[hit.surface].back_side || m.transmission > 0.0F);
}

} // namespace

vec3 hit_position(const RayScene& rays, const Hit& hit) {
    const auto p = rays.triangle(hit.surface, hit.triangle);
    return p[0] + (p[1] - p[0]) * hit.barycentric.x + (p[2] - p[0]) * hit.barycentric.y;
}

vec3 off_surface(const vec3& position, const vec3& normal) {
    const vec3 size = glm::abs(position);
    return position + normal * std::max(1e-5F, 5e-7F * max_component(size));
}

WalkPoint walk_point(const RayScene& rays, const Hit& hit, const vec3& direction) {
    WalkPoint at;
    at.material = &rays.material(hit.surface);
    const vec4 color = rays.base_color(hit.surface, hit.triangle, hit.barycentric);
    at.cover = at.material->alpha_mode == Material::Alpha::Blend ? std::clamp(color.a, 0.0F, 1.0F) : 1.0F;
    at.base_color = Rgb(color);
    at.front = hit.front;
    at.slab = rays.surfaces()[hit.surface].slab;
    at.geometric = hit.front ? hit.geometric_normal : -hit.geometric_normal;
    const vec3 smooth = rays.shading_normal(hit);
    at.normal = hit.front ? smooth : -smooth;
    if (!(glm::dot(at.normal, direction) < 0.0F)) {
        at.normal = at.geometric;
    }
    at.position = hit_position(rays, hit);
    at.mirrors = side_mirrors(rays, hit, *at.material);
    return at;
}

Rgb left_by_solid(const WalkPoint& at, const Hit& hit) {
    const Material& m = *at.material;
    const bool within = !at.front && !at.slab && m.transmission > 0.0F && m.thickness > 0.0F;
    return within ? absorption(m, hit.t) : Rgb(1.0F); // the ray has just crossed it
}

float onward_share(const RayScene& rays, const Hit& hit, const vec3& direction) {
    const Material& m = rays.material(hit.surface);
    if (!lets_on(m)) {
        return 0.0F;
    }
    float share = luminance(rays.straight_through(hit, direction));
    if (side_mirrors(rays, hit, m)) {
        const WalkPoint at = walk_point(rays, hit, direction);
        share += at.cover * specular_albedo(at, direction);
    }
    return std::min(share, 1.0F);
}

Rgb mirror_reflectance(const RayScene& rays, const Hit& hit, const vec3& direction) {
    const WalkPoint at = walk_point(rays, hit, direction);
    return sample_specular(at, direction, vec3(0.5F)).weight * at.cover;
}

bool bend_on(const RayScene& rays, const Hit& hit, LightWay& way, const vec3& u, WayOn& how) {
    if (!side_mirrors(rays, hit, rays.material(hit.surface))) {
        return false;
    }
    const WalkPoint at = walk_point(rays, hit, way.ray.direction);
    const SpecularSample s = sample_specular(at, way.ray.direction, u);
    how = {at.position, at.geometric, at.normal, s.spread, false, s.transmitted};
    return leave(way, way.through * (s.weight * at.cover * left_by_solid(at, hit)), s.direction, how);
}

bool send_on(const RayScene& rays, const Hit& hit, LightWay& way, WayOn* how) {
    const Material& m = rays.material(hit.surface);
    if (!lets_on(m)) {
        return false;
    }
    WayOn local;
    WayOn& on = how != nullptr ? *how : local;
    const vec3 in = way.ray.direction;
    const Rgb straight = rays.straight_through(hit, in);
    const float passes = luminance(straight);
    const bool mirrors = side_mirrors(rays, hit, m);
    float chance = mirrors ? 1.0F : 0.0F; // of being bent
    if (mirrors && passes > 0.0F) {
        const WalkPoint at = walk_point(rays, hit, in);
        const float bent = at.cover * specular_albedo(at, in);
        chance = bent / (bent + passes);
    }
    if (chance >= 1.0F || (chance > 0.0F && next_number(way.seed) < chance)) {
        const float x = next_number(way.seed);
        const float y = next_number(way.seed);
        const float z = next_number(way.seed);
        const Rgb before = way.through;
        way.through /= chance;
        const bool goes_on = bend_on(rays, hit, way, {x, y, z}, on);
        way.through = goes_on ? way.through : before;
        return goes_on;
    }
    const vec3 geometric = hit.front ? hit.geometric_normal : -hit.geometric_normal;
    on = {hit_position(rays, hit), geometric, geometric, 0.0F, true, true};
    return leave(way, way.through * straight / (1.0F - chance), in, on);
}

} // namespace atrium
