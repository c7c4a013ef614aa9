#include "engine/reference/path_tracer.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kMostLampsByName = 8; // more than this are picked from even at the first vertex
constexpr float kLampClearance = 2e-4F;     // metres: a lamp that lies on the ceiling shines (as RayScene::transmittance)
constexpr float kRouletteBelow = 0.25F;     // throughput from which paths may end
constexpr int kLongLeg = 64;                // hits between two vertices from which paths may end

vec3 cosine_direction(const vec3& n, const vec2& u) {
    vec3 t;
    vec3 b;
    make_frame(n, t, b);
    const float sine = std::sqrt(u.x);
    const float angle = 2.0F * kPi * u.y;
    return glm::normalize((sine * std::cos(angle)) * t + (sine * std::sin(angle)) * b + std::sqrt(1.0F - u.x) * n);
}

} // namespace

PathTracer::PathTracer(const Scene& scene, const RayScene& rays) : rays_(rays), lights_(scene, rays) {}

Rgb PathTracer::lamps_and_suns(const PathVertex& v, const vec2& u, float pick, bool all_lamps) const {
    Rgb sum(0.0F);
    for (const PathLights::Sun& sun : lights_.suns()) {
        const vec3 towards = sun.sample(u);
        const float cosine = glm::dot(v.normal, towards);
        if (cosine > 0.0F) {
            sum += sun.normal_irradiance * (cosine * sun.weight()) * rays_.transmittance(Ray{v.origin, towards});
        }
    }
    const auto shine = [&](const PathLights::Lamp& lamp, const Rgb& open) {
        const vec3 d = lamp.position - v.origin;
        const float distance = glm::length(d);
        return open * rays_.transmittance(Ray{v.origin, d / distance, std::max(distance - kLampClearance, 0.5F * distance)});
    };
    const auto& lamps = lights_.lamps();
    if (all_lamps && lamps.size() <= kMostLampsByName) {
        for (const PathLights::Lamp& lamp : lamps) {
            const Rgb open = lamp.irradiance(v.origin, v.normal);
            if (max_component(open) > 0.0F) {
                sum += shine(lamp, open);
            }
        }
        return sum;
    }
    // One lamp stands for all, picked by what it would give where nothing stands in its way.
    float total = 0.0F;
    for (const PathLights::Lamp& lamp : lamps) {
        total += luminance(lamp.irradiance(v.origin, v.normal));
    }
    float at = pick * total;
    for (const PathLights::Lamp& lamp : lamps) {
        const Rgb open = lamp.irradiance(v.origin, v.normal);
        const float share = luminance(open);
        if (at < share) {
            return sum + shine(lamp, open) * (total / share);
        }
        at -= share;
    }
    return sum;
}

Rgb PathTracer::emitter(const PathVertex& v, const vec2& u, float pick) const {
    const PathLights::EmitterPoint y = lights_.sample_emitter(pick, u);
    vec3 d = y.position - v.origin;
    const bool front = glm::dot(d, y.normal) < 0.0F;
    if (!front && !rays_.surfaces()[y.surface].back_side) {
        return Rgb(0.0F);
    }
    const vec3 side = front ? y.normal : -y.normal;
    d = clear_of(y.position, side) - v.origin;
    const float distance2 = glm::dot(d, d);
    const float distance = std::sqrt(distance2);
    const vec3 direction = d / distance;
    const float cosine_here = glm::dot(v.normal, direction);
    const float cosine_there = -glm::dot(side, direction);
    if (!(distance > 0.0F) || cosine_here <= 0.0F || cosine_there <= 0.0F) {
        return Rgb(0.0F);
    }
    Rgb emitted = rays_.emission(y.surface, y.triangle, y.barycentric);
    const Material& m = rays_.material(y.surface);
    if (m.alpha_mode != Material::Alpha::Opaque) {
        const float alpha = rays_.base_color(y.surface, y.triangle, y.barycentric).a;
        const bool mask = m.alpha_mode == Material::Alpha::Mask;
        emitted *= mask ? (alpha >= m.alpha_cutoff ? 1.0F : 0.0F) : std::clamp(alpha, 0.0F, 1.0F);
    }
    if (!(max_component(emitted) > 0.0F)) {
        return Rgb(0.0F);
    }
    const float here = y.area_probability * distance2 / cosine_there; // per solid angle
    const float followed = cosine_here * kInvPi;
    return emitted * (cosine_here / (here + followed)) * rays_.transmittance(Ray{v.origin, direction, distance});
}

Rgb PathTracer::emission(const SurfacePoint& at, const vec3& start, float density) const {
    const float from_area = lights_.area_probability(at.hit.surface, at.hit.triangle);
    if (!(from_area > 0.0F)) {
        return Rgb(0.0F);
    }
    const float cosine = std::abs(glm::dot(at.hit.geometric_normal, at.direction));
    const vec3 d = at.position - start;
    const float by_name = density > 0.0F && cosine > 0.0F ? from_area * glm::dot(d, d) / cosine : 0.0F;
    const float share = by_name > 0.0F ? density / (density + by_name) : 1.0F;
    return (at.covered * share) * rays_.emission(at.hit.surface, at.hit.triangle, at.hit.barycentric);
}

PathTracer::Leg PathTracer::follow(Ray ray, float density, bool from_camera, PathSampler& sampler) const {
    Leg leg;
    Rgb weight(1.0F);
    const vec3 start = ray.origin;
    bool straight = true; // so far: nothing mirrored or bent the ray
    float within = 0.0F;  // metres since the last face of a solid
    for (int hits = 1;; ++hits) {
        const Hit hit = rays_.nearest(ray);
        if (!hit) {
            leg.seen += weight * lights_.sky_radiance();
            return leg;
        }
        const SurfacePoint at = surface_point(rays_, hit, ray.direction);
        within += hit.t;
        if (from_camera && straight && !hit.front && !at.material->double_sided &&
            classify(*at.material) != MaterialKind::DielectricSolid) {
            ray.origin = clear_of(at.position, ray.direction);
            continue;
        }
        if (side_reflects(rays_, hit) && (straight || from_camera || !lights_.small(hit.surface))) {
            leg.seen += weight * emission(at, start, straight ? density : 0.0F);
        }
        SpecularSample way;
        if (at.specular) {
            way = specular_way(rays_, at, vec3(sampler.next4()), within);
        }
        within = bounds_solid(rays_, at) ? 0.0F : within;
        const float stay = max_component(at.diffuse);
        const float pass = max_component(at.through);
        const float bend = max_component(way.weight);
        const float all = stay + pass + bend;
        if (!(all > 0.0F)) {
            return leg;
        }
        const float pick = stay < all ? sampler.next1() * all : 0.0F;
        if (pick < stay) {
            leg.scatter = weight * at.diffuse * (all / stay);
            leg.next = {clear_of(at.position, at.side), at.side};
            return leg;
        }
        if (pick < stay + pass || !(bend > 0.0F)) {
            weight *= at.through * (all / pass);
            ray.origin = clear_of(at.position, ray.direction);
        } else {
            weight *= way.weight * (all / bend);
            ray = {start_of(at, way), way.direction};
            straight = false;
        }
        // Light that runs round within glass, or is hardly there, ends by chance alone.
        const float left = max_component(weight);
        const float survival = hits > kLongLeg ? 0.9F : std::min(left / kRouletteBelow, 1.0F);
        if (survival < 1.0F && !straight) {
            if (sampler.next1() >= survival) {
                return leg;
            }
            weight /= survival;
        }
    }
}

Rgb PathTracer::irradiance(PathVertex v, PathSampler& sampler) const {
    Rgb sum(0.0F);
    Rgb throughput(1.0F);
    for (bool first = true;; first = false) {
        const vec4 a = sampler.next4();
        const vec4 b = sampler.next4();
        sum += throughput * lamps_and_suns(v, {b.x, b.y}, b.w, first);
        if (lights_.has_emitters()) {
            sum += throughput * emitter(v, {a.z, a.w}, b.z);
        }
        const vec3 direction = cosine_direction(v.normal, {a.x, a.y});
        const float density = lights_.has_emitters() ? glm::dot(direction, v.normal) * kInvPi : 0.0F;
        const Leg leg = follow({v.origin, direction}, density, false, sampler);
        sum += throughput * kPi * leg.seen; // radiance over a density of cosine / pi, times the cosine
        throughput *= leg.scatter;          // and reflectance / pi makes radiance of irradiance
        const float left = max_component(throughput);
        if (!(left > 0.0F)) {
            return sum;
        }
        if (left < kRouletteBelow) {
            const float survival = left / kRouletteBelow;
            if (sampler.next1() >= survival) {
                return sum;
            }
            throughput /= survival;
        }
        v = leg.next;
    }
}

bool PathTracer::finds_light(PathVertex v, PathSampler& sampler, unsigned bounces) const {
    for (unsigned bounce = 0; bounce <= bounces; ++bounce) {
        const vec4 a = sampler.next4();
        const vec4 b = sampler.next4();
        Rgb found = lamps_and_suns(v, {b.x, b.y}, b.w, true);
        if (lights_.has_emitters()) {
            found += emitter(v, {a.z, a.w}, b.z);
        }
        const Leg leg = follow({v.origin, cosine_direction(v.normal, {a.x, a.y})}, 0.0F, false, sampler);
        if (max_component(found + leg.seen) > 0.0F) {
            return true;
        }
        if (!(max_component(leg.scatter) > 0.0F)) {
            return false;
        }
        v = leg.next;
    }
    return false;
}

Rgb PathTracer::radiance(Ray ray, PathSampler& sampler, const VertexLight& vertex_light) const {
    const Leg leg = follow(ray, 0.0F, true, sampler);
    if (!(max_component(leg.scatter) > 0.0F)) {
        return leg.seen;
    }
    Rgb there = irradiance(leg.next, sampler);
    if (vertex_light) {
        there += vertex_light(leg.next);
    }
    return leg.seen + leg.scatter * kInvPi * there;
}

} // namespace atrium
