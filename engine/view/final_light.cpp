#include "engine/view/final_light.h"

#include "engine/raycast/light_walk.h"
#include "engine/solver/quality.h"
#include "engine/view/eye_surface.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kMostLampsByName = 8; // more than this are picked from
constexpr float kNearShare = 0.01F;         // of the scene's diagonal: layers are not trusted closer than this
constexpr float kMostNear = 0.1F;           // metres

vec3 cosine_direction(const vec3& n, const vec2& u) {
    vec3 t;
    vec3 b;
    make_frame(n, t, b);
    const float sine = std::sqrt(u.x);
    const float angle = 2.0F * kPi * u.y;
    return glm::normalize((sine * std::cos(angle)) * t + (sine * std::sin(angle)) * b + std::sqrt(1.0F - u.x) * n);
}

/// Surfaces that stand out by what they emit, as the solver tells them (radiosity/light_split), over all rooms.
std::vector<bool> named_surfaces(const RayScene& rays) {
    const auto& surfaces = rays.surfaces();
    std::vector<double> flux(surfaces.size(), 0.0);
    std::vector<double> area(surfaces.size(), 0.0);
    double all_flux = 0.0;
    double all_area = 0.0;
    for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
        const bool shines = rays.material(s).emits();
        for (std::uint32_t t = 0; t < surfaces[s].triangles.size(); ++t) {
            const auto p = rays.triangle(s, t);
            const double a = 0.5 * double(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
            area[s] += a;
            flux[s] += shines ? a * double(luminance(rays.emission(s, t, vec2(1.0F / 3.0F)))) : 0.0;
        }
        all_flux += flux[s];
        all_area += area[s];
    }
    const auto contrast = double(QualitySettings{}.emitter_contrast);
    std::vector<bool> out(surfaces.size(), false);
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const double others = all_area - area[s];
        const bool alone = !(others > 1e-6 * all_area);
        const double against = alone ? all_flux / std::max(all_area, 1e-30) : (all_flux - flux[s]) / others;
        out[s] = flux[s] > 0.0 && flux[s] > contrast * against * area[s];
    }
    return out;
}

} // namespace

FinalLight::FinalLight(const Scene& scene, const RayScene& rays, const LitScene& lit, bool mirror_images, bool gathers,
                       const RunContext& context)
    : rays_(rays), lit_(lit), to_rays_(lit.rays().origin() - rays.origin()), lights_(scene, rays, context),
      spots_(lit, context), named_(named_surfaces(lit.rays())), gathers_(gathers),
      near_(std::min(kNearShare * lit.rays().bounds().diagonal(), kMostNear)) {
    if (mirror_images) {
        mirrors_ = PlanarMirrors(rays);
    }
}

Rgb FinalLight::lamps(const vec3& point, const vec3& normal, const vec2& u, float pick, const MirrorSight* over) const {
    Rgb sum(0.0F);
    const auto open = [&](const PlacedLight& lamp) { // without anything between
        const vec3 d = lamp.position - point;
        const float distance2 = glm::dot(d, d);
        const float distance = std::sqrt(distance2);
        const float cosine = distance > 0.0F ? glm::dot(normal, d) / distance : 0.0F;
        return cosine > 0.0F
                   ? lamp.light.color * (lamp.light.intensity * lamp.distribution(-d / distance) * cosine / distance2)
                   : Rgb(0.0F);
    };
    const auto seen = [&](const PlacedLight& lamp) {
        return over != nullptr ? over->transmittance(lamp.position) : rays_.transmittance(point, lamp.position);
    };
    std::size_t count = 0;
    float total = 0.0F;
    for (const PlacedLight& lamp : lights_.lights()) {
        if (lamp.light.kind != Light::Kind::Directional) {
            ++count;
            total += luminance(open(lamp));
            continue;
        }
        const float radius = std::tan(float(radians_from_degrees(0.5 * lamp.light.angular_diameter_degrees)));
        vec3 t;
        vec3 b;
        make_frame(-lamp.axis, t, b);
        const float r = radius * std::sqrt(u.x);
        const float angle = 2.0F * kPi * u.y;
        const vec3 to_sun = glm::normalize((r * std::cos(angle)) * t + (r * std::sin(angle)) * b - lamp.axis);
        const float cosine = glm::dot(normal, to_sun);
        if (cosine > 0.0F) {
            sum +=
                lamp.light.color * (lamp.light.intensity * cosine) *
                (over != nullptr ? over->transmittance_to_infinity(to_sun) : rays_.transmittance_to_infinity(point, to_sun));
        }
    }
    if (!(total > 0.0F)) {
        return sum;
    }
    float left = pick * total;
    for (const PlacedLight& lamp : lights_.lights()) {
        if (lamp.light.kind == Light::Kind::Directional) {
            continue;
        }
        const Rgb light = open(lamp);
        const float share = luminance(light);
        if (!(share > 0.0F)) {
            continue;
        }
        if (count <= kMostLampsByName) {
            sum += light * seen(lamp);
        } else if (left < share) {
            return sum + light * seen(lamp) * (total / share);
        } else {
            left -= share;
        }
    }
    return sum;
}

std::size_t FinalLight::windows_crossed(const vec3& point, const vec3& direction) const {
    std::size_t count = 0;
    for (const SkyWindow& window : lights_.sky().windows()) {
        count += std::isfinite(window.crossing(point, direction)) ? 1 : 0;
    }
    return count;
}

Rgb FinalLight::sky_windows(const vec3& point, const vec3& normal, const vec2& u, float pick) const {
    thread_local std::vector<float> factors;
    const auto windows = lights_.sky().windows();
    factors.assign(windows.size(), 0.0F);
    float sum = 0.0F;
    for (std::size_t i = 0; i < windows.size(); ++i) {
        factors[i] = windows[i].form_factor(point, normal);
        sum += factors[i];
    }
    if (!(sum > 0.0F)) {
        return Rgb(0.0F);
    }
    float left = pick * sum;
    std::size_t chosen = windows.size();
    for (std::size_t i = 0; i < windows.size(); ++i) {
        if (factors[i] > 0.0F) {
            chosen = i;
            if (left < factors[i]) {
                break;
            }
            left -= factors[i];
        }
    }
    const WindowPoints points(windows[chosen], point, normal);
    const WindowPoints::Place place = points.at(u);
    if (!(place.weight > 0.0F)) {
        return Rgb(0.0F);
    }
    // The weights of places are known but for a factor: their mean stands for the whole window's form factor.
    constexpr int kGrid = 4;
    float mean = 0.0F;
    for (int i = 0; i < kGrid * kGrid; ++i) {
        mean += points.at({(float(i % kGrid) + 0.5F) / kGrid, (float(i / kGrid) + 0.5F) / kGrid}).weight;
    }
    mean /= float(kGrid * kGrid);
    if (!(mean > 0.0F)) {
        return Rgb(0.0F);
    }
    // A direction over several windows (both faces of a pane, panes behind openings) is met from each of them.
    const std::size_t crossed = std::max<std::size_t>(windows_crossed(point, place.direction), 1);
    const Rgb seen = rays_.transmittance_to_infinity(point, place.direction);
    return lights_.sky().radiance() * seen * (kPi * sum * std::min(place.weight / mean, 4.0F) / float(crossed));
}

void FinalLight::spot(const vec3& point, const vec3& normal, float which, const vec2& where, PointLight& out) const {
    LitPieces::Spot s;
    if (!spots_.pick(point, normal, which, where, s)) {
        return;
    }
    const float cosine = glm::dot(normal, s.direction);
    const float followed = cosine * kInvPi; // density of the hemisphere's rays there
    const Rgb seen = lit_.rays().transmittance(point, point + s.direction * s.hit.t);
    if (!(max_component(seen) > 0.0F)) {
        return;
    }
    const Rgb weight = seen * (cosine / (s.density + followed));
    const Rgb emitted = lit_.rays().emission(s.hit.surface, s.hit.triangle, s.hit.barycentric);
    out.direct += weight * emitted;
    out.diffuse += weight * glm::max(lit_.radiance(s.hit) - emitted, Rgb(0.0F));
}

Rgb FinalLight::spot_over(const MirrorSight& over, float which, const vec2& where) const {
    LitPieces::Spot s;
    const vec3 image = over.image() - to_rays_;
    if (!spots_.pick(image, over.image_normal(), which, where, s) || !named_[s.hit.surface]) {
        return Rgb(0.0F);
    }
    const float cosine = glm::dot(over.image_normal(), s.direction);
    const Rgb seen = over.transmittance(over.image() + s.direction * s.hit.t);
    return lit_.rays().emission(s.hit.surface, s.hit.triangle, s.hit.barycentric) * seen * (cosine / s.density);
}

void FinalLight::gather(const vec3& point, const vec3& normal, const vec2& u, const PixelSampler& sampler,
                        std::uint32_t group, int depth, PointLight& out) const {
    const RayScene& rays = lit_.rays();
    LightWay way;
    way.ray = {point, cosine_direction(normal, u)};
    way.seed = sampler.hash(group + 0x6A7EULL);
    const vec3 first_direction = way.ray.direction;
    const float density = glm::dot(normal, first_direction) * kInvPi;
    for (unsigned met = 0; met < kMostSurfaces; ++met) {
        const Hit hit = rays.nearest(way.ray);
        if (!hit) {
            const Rgb sky = way.through * kPi * lights_.sky().radiance();
            if (way.bends > 0) {
                out.diffuse += sky;
            } else if (windows_crossed(point + to_rays_, first_direction) == 0) {
                out.direct += sky;
            }
            return;
        }
        const EyeSurface at = eye_surface(rays, hit, way.ray.direction);
        if (max_component(at.emitted) > 0.0F || max_component(at.diffuse) > 0.0F) {
            float weight = 1.0F;
            const float distance = glm::length(at.position - point);
            if (way.bends == 0) {
                weight = density / (density + spots_.density(point, normal, hit, first_direction, distance));
            }
            const Rgb share = way.through * (kPi * weight);
            if (way.bends == 0) {
                out.direct += share * at.emitted;
            } else if (!named_[hit.surface]) {
                out.diffuse += share * at.emitted;
            }
            if (max_component(at.diffuse) > 0.0F) {
                // Close by, layers are interpolated over more than what matters: look again from there.
                const bool near = way.bends == 0 && depth == 0 && distance < near_;
                const Rgb there =
                    near ? FinalLight::at(off_surface(at.position, at.geometric), at.geometric, sampler, group + kGroups, 1)
                                   .sum() +
                               lit_.irradiance(hit, {false, false, true})
                         : lit_.irradiance(hit);
                out.diffuse += share * at.diffuse * kInvPi * there;
            }
        }
        if (!send_on(rays, hit, way)) {
            return;
        }
    }
}

PointLight FinalLight::at(const vec3& point, const vec3& normal, const PixelSampler& sampler, std::uint32_t group,
                          int depth) const {
    PointLight out;
    const vec4 a = sampler.group(group);
    const vec4 b = sampler.group(group + 1);
    const vec4 c = sampler.group(group + 2);
    const vec3 in_rays = point + to_rays_;
    out.direct = lamps(in_rays, normal, {a.z, a.w}, c.w, nullptr);
    if (lights_.has_sky() && !lights_.sky().windows().empty()) {
        out.direct += sky_windows(in_rays, normal, {b.x, b.y}, b.z);
    }
    for (std::uint32_t k = 0; k < mirrors_.mirrors().size(); ++k) {
        const MirrorSight over(rays_, mirrors_, k, in_rays, normal);
        if (over.sees()) {
            out.direct +=
                lamps(over.image(), over.image_normal(), {a.z, a.w}, c.w, &over) + spot_over(over, b.w, {c.x, c.y});
        }
    }
    spot(point, normal, b.w, {c.x, c.y}, out);
    gather(point, normal, {a.x, a.y}, sampler, group, depth, out);
    return out;
}

} // namespace atrium
