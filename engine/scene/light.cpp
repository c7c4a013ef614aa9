#include "engine/scene/light.h"

#include "engine/scene/photometric_web.h"

#include <algorithm>

namespace atrium {

bool operator==(const Photometry& a, const Photometry& b) {
    return a.web == b.web || (a.web != nullptr && b.web != nullptr && *a.web == *b.web);
}

float spot_falloff(const Light& light, float cos_angle) {
    const float cos_inner = std::cos(light.inner_cone);
    const float cos_outer = std::cos(light.outer_cone);
    const float t = std::clamp((cos_angle - cos_outer) / std::max(cos_inner - cos_outer, 1e-4F), 0.0F, 1.0F);
    return t * t;
}

const PhotometricWeb* light_distribution(const Light& light) {
    return light.kind != Light::Kind::Directional ? light.photometry.web.get() : nullptr;
}

double solid_angle_of(const Light& light) {
    if (const PhotometricWeb* web = light_distribution(light)) {
        return web->flux() / double(web->peak());
    }
    switch (light.kind) {
    case Light::Kind::Point: return 4.0 * kPiD;
    case Light::Kind::Spot: {
        // Integral of the squared falloff over the cone: 2 pi [(1 - cos i) + (cos i - cos o) / 3].
        const double inner = std::cos(light.inner_cone);
        const double outer = std::cos(light.outer_cone);
        return 2.0 * kPiD * ((1.0 - inner) + (inner - outer) / 3.0);
    }
    case Light::Kind::Directional: break;
    }
    return 0.0;
}

double flux_of(const Light& light) { return double(luminance(light.color)) * light.intensity * solid_angle_of(light); }

void set_photometry(Light& light, std::shared_ptr<const PhotometricWeb> web) {
    // Half the peak at the beam's edge, nothing beyond the field: what lies outside 90 degrees no spot has.
    const double beam = 0.5 * std::max(web->beam_angle(0.0), web->beam_angle(90.0));
    const double field = 0.5 * std::max(web->beam_angle(0.0, 0.1), web->beam_angle(90.0, 0.1));
    const bool downwards = web->candela({0.0F, 0.0F, -1.0F}) > web->candela({0.0F, 0.0F, 1.0F});
    light.kind = downwards && field <= 90.0 ? Light::Kind::Spot : Light::Kind::Point;
    if (light.kind == Light::Kind::Spot) {
        light.outer_cone = float(radians_from_degrees(std::clamp(field, 1.0, 90.0)));
        light.inner_cone = std::min(float(radians_from_degrees(0.7 * beam)), 0.95F * light.outer_cone);
    }
    light.intensity = web->peak();
    light.photometry.web = std::move(web);
}

void remove_photometry(Light& light) {
    if (light_distribution(light) != nullptr) {
        const double measured = solid_angle_of(light);
        light.photometry = {};
        light.intensity = float(light.intensity * measured / solid_angle_of(light));
    }
    light.photometry = {};
}

} // namespace atrium
