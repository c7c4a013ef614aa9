#include "engine/radiosity/direct_light.h"

#include "engine/base/rng.h"

#include <algorithm>

namespace atrium {

DirectLight::DirectLight(const Scene& scene, const RayScene& rays) : rays_(rays) {
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
        lights_.push_back(
            {*light, id, vec3(dvec3(world[3]) - rays.origin()), length > 0.0 ? vec3(axis / length) : vec3(0, 0, -1)});
    }
    sky_radiance_ = scene.environment.sky_radiance;
    sky_ = max_component(sky_radiance_) > 0.0F;
}

DirectSample DirectLight::irradiance(const vec3& point, const vec3& normal, unsigned sun_rays, unsigned sky_rays) const {
    DirectSample out;
    for (const PlacedLight& placed : lights_) {
        const Light& light = placed.light;
        if (light.kind == Light::Kind::Directional) {
            const float radius = std::tan(float(radians_from_degrees(0.5 * light.angular_diameter_degrees)));
            const unsigned n = radius > 0.0F ? std::max(sun_rays, 1U) : 1U;
            vec3 t;
            vec3 b;
            make_frame(-placed.axis, t, b);
            const Rgb full = light.color * light.intensity;
            Rgb sum(0.0F);
            float lit = 0.0F;
            for (unsigned i = 0; i < n; ++i) {
                vec3 to_sun = -placed.axis;
                if (n > 1) {
                    // Fermat spiral: even over the disc for any n.
                    const float r = radius * std::sqrt((float(i) + 0.5F) / float(n));
                    const float angle = 2.39996323F * float(i);
                    to_sun = glm::normalize(to_sun + (r * std::cos(angle)) * t + (r * std::sin(angle)) * b);
                }
                const float cosine = glm::dot(normal, to_sun);
                if (cosine > 0.0F) {
                    const Rgb through = rays_.transmittance_to_infinity(point, to_sun);
                    sum += through * cosine;
                    lit += max_component(through) > 0.0F ? 1.0F : 0.0F;
                }
            }
            const Rgb e = full * sum / float(n);
            out.irradiance += e;
            if (n > 1) {
                const float share = (lit + 1.0F) * (float(n) - lit + 1.0F) / ((float(n) + 2.0F) * (float(n) + 2.0F));
                const float whole = luminance(full) * std::max(glm::dot(normal, -placed.axis), 0.0F);
                out.variance += lit == 0.0F || lit == float(n) ? 0.0F : whole * whole * share / float(n);
            }
            continue;
        }
        const vec3 d = placed.position - point;
        const float distance2 = glm::dot(d, d);
        const float distance = std::sqrt(distance2);
        const float cosine = distance > 0.0F ? glm::dot(normal, d) / distance : 0.0F;
        float candela = light.intensity;
        if (light.kind == Light::Kind::Spot && distance > 0.0F) {
            candela *= spot_falloff(light, -glm::dot(d, placed.axis) / distance);
        }
        if (cosine <= 0.0F || candela <= 0.0F) {
            continue;
        }
        out.irradiance += light.color * (candela * cosine / distance2) * rays_.transmittance(point, placed.position);
    }
    if (sky_ && sky_rays > 0) {
        vec3 t;
        vec3 b;
        make_frame(normal, t, b);
        Rgb sum(0.0F);
        float seen = 0.0F;
        for (unsigned i = 0; i < sky_rays; ++i) {
            const vec2 u = sobol_owen2(i, 0, 0x5B7U);
            const float r = std::sqrt(u.x);
            const float angle = 2.0F * kPi * u.y;
            const vec3 direction = glm::normalize((r * std::cos(angle)) * t + (r * std::sin(angle)) * b +
                                                  std::sqrt(std::max(1.0F - u.x, 1e-6F)) * normal);
            const Rgb through = rays_.transmittance_to_infinity(point, direction);
            sum += through;
            seen += max_component(through) > 0.0F ? 1.0F : 0.0F;
        }
        const auto n = float(sky_rays);
        const Rgb whole = sky_radiance_ * kPi;
        out.irradiance += whole * sum / n;
        if (seen > 0.0F && seen < n) {
            const float share = (seen + 1.0F) * (n - seen + 1.0F) / ((n + 2.0F) * (n + 2.0F));
            out.variance += luminance(whole) * luminance(whole) * share / n;
        }
    }
    return out;
}

double DirectLight::emitted_flux() const {
    double flux = 0.0;
    for (const PlacedLight& placed : lights_) {
        const Light& light = placed.light;
        const double candela = double(luminance(light.color)) * light.intensity;
        if (light.kind == Light::Kind::Point) {
            flux += 4.0 * kPiD * candela;
        } else if (light.kind == Light::Kind::Spot) {
            // Integral of the squared falloff over the cone: 2 pi I [(1 - cos i) + (cos i - cos o) / 3].
            const double inner = std::cos(light.inner_cone);
            const double outer = std::cos(light.outer_cone);
            flux += 2.0 * kPiD * candela * ((1.0 - inner) + (inner - outer) / 3.0);
        }
    }
    return flux;
}

} // namespace atrium
