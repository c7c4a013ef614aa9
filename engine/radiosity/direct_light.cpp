#include "engine/radiosity/direct_light.h"

#include "engine/radiosity/disc_pattern.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kSunScouts = 8; // rays towards the sun that may stand for all where they agree

// Mean of max(0, cosine + y) over a disc whose points are uniform, y from -radius to radius: what a sun gives whose middle
// stands at `cosine` and whose rim may be below the horizon.
float above_horizon(float cosine, float radius) {
    const float a = std::clamp(cosine / radius, -1.0F, 1.0F);
    const float root = std::sqrt(1.0F - a * a);
    const float share = a * (0.25F * kPi + 0.5F * (a * root + std::asin(a))) + root * root * root / 3.0F;
    return std::max(radius * share * 2.0F / kPi, cosine);
}

// How a luminaire is turned about its axis, and what it gives hanging askew.
void place_photometry(const PhotometricWeb& web, const dmat4& world, PlacedLight& out) {
    const dvec3 axis(out.axis);
    const dvec3 across = dvec3(world[0]) - axis * glm::dot(axis, dvec3(world[0]));
    const double length = glm::length(across);
    vec3 t;
    vec3 b;
    make_frame(out.axis, t, b);
    out.right = length > 0.0 ? vec3(across / length) : t;
    out.light.intensity *= web.tilt_factor(degrees_from_radians(std::acos(std::clamp(-axis.y, -1.0, 1.0))));
}

} // namespace

float PlacedLight::distribution(const vec3& away) const {
    if (const PhotometricWeb* web = light.photometry.web.get()) {
        return web->relative({glm::dot(away, right), glm::dot(away, glm::cross(right, axis)), -glm::dot(away, axis)});
    }
    return light.kind == Light::Kind::Spot ? spot_falloff(light, glm::dot(away, axis)) : 1.0F;
}

bool same_but_brightness(const PlacedLight& a, const PlacedLight& b) {
    Light light = b.light;
    light.color = a.light.color;
    light.intensity = a.light.intensity;
    light.name = a.light.name;
    light.extras = a.light.extras;
    light.enabled = a.light.enabled;
    return light == a.light && a.position == b.position && a.axis == b.axis && a.right == b.right;
}

std::vector<PlacedLight> placed_lights(const Scene& scene, const dvec3& origin) {
    std::vector<PlacedLight> out;
    for (const NodeId id : scene.in_tree_order()) {
        const Node& node = *scene.nodes.find(id);
        const Light* light = scene.lights.find(node.light);
        if (light == nullptr || !light->enabled || !scene.shown(id) || !(light->intensity > 0.0F) ||
            !(max_component(light->color) > 0.0F)) {
            continue;
        }
        const dmat4 world = scene.world_matrix(id);
        const dvec3 axis = -dvec3(world[2]);
        const double length = glm::length(axis);
        PlacedLight placed;
        placed.light = *light;
        placed.node = id;
        placed.position = vec3(dvec3(world[3]) - origin);
        placed.axis = length > 0.0 ? vec3(axis / length) : vec3(0, 0, -1);
        if (const PhotometricWeb* web = light_distribution(*light)) {
            place_photometry(*web, world, placed);
        }
        out.push_back(std::move(placed));
    }
    return out;
}

DirectLight::DirectLight(const Scene& scene, const RayScene& rays, const RunContext& context)
    : rays_(rays), lights_(placed_lights(scene, rays.origin())), sky_(scene.environment.sky_radiance, rays, context) {}

Rgb per_brightness(const Rgb& light, const Rgb& brightness) {
    Rgb out(0.0F);
    float sum = 0.0F;
    int lit = 0;
    for (int c = 0; c < 3; ++c) {
        if (brightness[c] > 0.0F) {
            out[c] = light[c] / brightness[c];
            sum += out[c];
            ++lit;
        }
    }
    for (int c = 0; c < 3 && lit > 0; ++c) {
        out[c] = brightness[c] > 0.0F ? out[c] : sum / float(lit);
    }
    return out;
}

void DirectLight::set_brightness(std::span<const PlacedLight> lights, const Rgb& sky) {
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        lights_[i].light.color = lights[i].light.color;
        lights_[i].light.intensity = lights[i].light.intensity;
    }
    sky_.set_radiance(sky);
}

DirectSample DirectLight::irradiance(const vec3& point, const vec3& normal, unsigned sun_rays, unsigned sky_rays) const {
    DirectSample out = lamps_irradiance(point, normal, sun_rays);
    const DirectSample sky = sky_irradiance(point, normal, sky_rays);
    out.irradiance += sky.irradiance;
    out.variance += sky.variance;
    return out;
}

DirectSample DirectLight::lamps_irradiance(const vec3& point, const vec3& normal, unsigned sun_rays) const {
    return lamps_irradiance(point, normal, sun_rays, nullptr);
}

DirectSample DirectLight::lamps_irradiance(const vec3& point, const vec3& normal, unsigned sun_rays,
                                           const MirrorSight* over) const {
    DirectSample out;
    for (const PlacedLight& placed : lights_) {
        const Light& light = placed.light;
        if (!(max_component(light.color) * light.intensity > 0.0F)) {
            continue; // switched off since: see set_brightness()
        }
        if (light.kind == Light::Kind::Directional) {
            add_sun(placed, point, normal, sun_rays, over, out);
            continue;
        }
        const vec3 d = placed.position - point;
        const float distance2 = glm::dot(d, d);
        const float distance = std::sqrt(distance2);
        const float cosine = distance > 0.0F ? glm::dot(normal, d) / distance : 0.0F;
        if (cosine <= 0.0F) {
            continue;
        }
        const float candela = light.intensity * placed.distribution(-d / distance);
        if (candela <= 0.0F) {
            continue;
        }
        const Rgb through =
            over != nullptr ? over->transmittance(placed.position) : rays_.transmittance(point, placed.position);
        out.irradiance += light.color * (candela * cosine / distance2) * through;
    }
    return out;
}

DirectSample DirectLight::sky_irradiance(const vec3& point, const vec3& normal, unsigned sky_rays) const {
    return sky_.irradiance(point, normal, sky_rays);
}

void DirectLight::add_sun(const PlacedLight& sun, const vec3& point, const vec3& normal, unsigned sun_rays,
                          const MirrorSight* over, DirectSample& out) const {
    const auto light_from = [&](const vec3& to_sun) {
        return over != nullptr ? over->transmittance_to_infinity(to_sun) : rays_.transmittance_to_infinity(point, to_sun);
    };
    const Rgb full = sun.light.color * sun.light.intensity;
    const float radius = std::tan(float(radians_from_degrees(0.5 * sun.light.angular_diameter_degrees)));
    const float cosine = -glm::dot(normal, sun.axis);
    if (!(radius > 0.0F)) {
        if (cosine > 0.0F) {
            out.irradiance += full * cosine * light_from(-sun.axis);
        }
        return;
    }
    if (cosine < -radius) {
        return; // wholly below the horizon
    }
    const bool whole = cosine > 1.5F * radius; // the disc stands above the horizon
    bool may_agree = whole;
    if (over != nullptr) {
        const MirrorSight::Cover cover = over->cover(-sun.axis, std::atan(radius));
        if (cover == MirrorSight::Cover::None) {
            return;
        }
        // The first few rays may well pass by a small mirror on all sides.
        may_agree = whole && cover == MirrorSight::Cover::Whole && over->fills();
    }
    const std::vector<vec2>& disc = disc_pattern(std::max(sun_rays, 1U));
    vec3 t;
    vec3 b;
    make_frame(-sun.axis, t, b);
    Rgb sum(0.0F), least(1.0F), most(0.0F);
    float lit = 0.0F;
    float cosines = 0.0F;
    std::size_t traced = 0;
    for (; traced < disc.size(); ++traced) {
        // Where the first few rays all say the same, so would the others: only in penumbrae are they worth tracing.
        if (traced == kSunScouts && may_agree && max_component(most - least) <= 0.01F) {
            break;
        }
        const vec2 offset = radius * disc[traced];
        const vec3 to_sun = glm::normalize(offset.x * t + offset.y * b - sun.axis);
        const float c = whole ? cosine : glm::dot(normal, to_sun);
        const Rgb through = c > 0.0F ? light_from(to_sun) : Rgb(0.0F);
        least = glm::min(least, through);
        most = glm::max(most, through);
        sum += through * std::max(c, 0.0F);
        cosines += std::max(c, 0.0F);
        lit += max_component(through) > 0.0F ? 1.0F : 0.0F;
    }
    const auto n = float(traced);
    if (whole) {
        out.irradiance += full * sum / n;
    } else {
        // Few of the points are above the horizon: they tell what share of the light arrives, not how much there is.
        const float sine = std::sqrt(std::max(1.0F - cosine * cosine, 0.0F));
        if (!(cosines > 0.0F)) { // none is: the middle of what can be seen stands for all of it
            const vec3 up = normal + cosine * sun.axis;
            const float y = 0.5F * (radius - cosine / std::max(sine, 1e-6F));
            sum = light_from(glm::normalize(up * (y / std::max(glm::length(up), 1e-6F)) - sun.axis));
            cosines = 1.0F;
        }
        out.irradiance += full * (above_horizon(cosine, radius * sine) / cosines) * sum;
    }
    if (lit > 0.0F && lit < n) {
        // Of n even points about 2 sqrt(n p (1 - p)) stand for pieces of the disc that an edge cuts: each is off by a
        // variance of 1/12 of its light squared.
        const float p = lit / n;
        const float light = luminance(full) * std::max(cosine, radius);
        out.variance += light * light * 2.0F * std::sqrt(p * (1.0F - p)) / (12.0F * n * std::sqrt(n));
    }
}

double DirectLight::emitted_flux() const {
    double flux = 0.0;
    for (const PlacedLight& placed : lights_) {
        flux += flux_of(placed.light);
    }
    return flux;
}

} // namespace atrium
