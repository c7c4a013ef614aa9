#include "engine/optics/specular.h"

#include <algorithm>

namespace atrium {

float fresnel_dielectric(float cos_i, float eta) {
    const double n = eta;
    if (!(n > 0.0)) {
        return 1.0F;
    }
    if (std::abs(n - 1.0) < 1e-6) {
        return 0.0F; // no interface, at grazing incidence as well
    }
    const double c = std::clamp(double(cos_i), 0.0, 1.0);
    const double sin2_t = (1.0 - c * c) / (n * n);
    if (!(sin2_t < 1.0)) {
        return 1.0F;
    }
    const double cos_t = std::sqrt(1.0 - sin2_t);
    const double rs = (c - n * cos_t) / (c + n * cos_t);
    const double rp = (n * c - cos_t) / (n * c + cos_t);
    return float(0.5 * (rs * rs + rp * rp));
}

Rgb absorption(const Material& material, float path) {
    const double distance = material.attenuation_distance;
    if (!(path > 0.0F) || std::isnan(distance) || distance == std::numeric_limits<double>::infinity()) {
        return Rgb(1.0F);
    }
    Rgb out(1.0F);
    for (int k = 0; k < 3; ++k) {
        const double left = std::clamp(double(material.attenuation_color[k]), 0.0, 1.0);
        if (!(left < 1.0)) {
            continue; // also where the distance is 0 and the exponent has no end
        }
        out[k] = distance > 0.0 ? float(std::pow(left, double(path) / distance)) : 0.0F;
    }
    return out;
}

} // namespace atrium
