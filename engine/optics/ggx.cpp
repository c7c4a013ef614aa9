#include "engine/optics/ggx.h"

#include <algorithm>

namespace atrium {

vec3 ggx_visible_normal(const vec3& view, float alpha, const vec2& u) {
    // Stretched so that the facets make a hemisphere, of which the view sees a disc.
    const vec3 v = glm::normalize(vec3(alpha * view.x, alpha * view.y, std::max(view.z, 1e-7F)));
    const float across2 = v.x * v.x + v.y * v.y;
    const vec3 t1 = across2 > 0.0F ? vec3(-v.y, v.x, 0.0F) / std::sqrt(across2) : vec3(1.0F, 0.0F, 0.0F);
    const vec3 t2 = glm::cross(v, t1);
    const float r = std::sqrt(u.x);
    const float angle = 2.0F * kPi * u.y;
    const float p1 = r * std::cos(angle);
    const float s = 0.5F * (1.0F + v.z);
    const float p2 = (1.0F - s) * std::sqrt(std::max(1.0F - p1 * p1, 0.0F)) + s * r * std::sin(angle);
    const vec3 h = p1 * t1 + p2 * t2 + std::sqrt(std::max(1.0F - p1 * p1 - p2 * p2, 0.0F)) * v;
    return glm::normalize(vec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-7F)));
}

float ggx_lambda(float cosine, float alpha) {
    const double c2 = double(cosine) * double(cosine);
    if (!(c2 > 0.0)) {
        return std::numeric_limits<float>::infinity();
    }
    const double tan2 = std::max(1.0 - c2, 0.0) / c2;
    return float(0.5 * (std::sqrt(1.0 + double(alpha) * double(alpha) * tan2) - 1.0));
}

float ggx_reflected(float cos_in, float cos_out, float alpha) {
    if (!(cos_in > 0.0F) || !(cos_out > 0.0F)) {
        return 0.0F;
    }
    const float in = ggx_lambda(cos_in, alpha);
    const float out = ggx_lambda(cos_out, alpha);
    return std::isfinite(out) && std::isfinite(in) ? (1.0F + in) / (1.0F + in + out) : 0.0F;
}

float ggx_transmitted(float cos_out, float alpha) {
    return cos_out > 0.0F ? 1.0F / (1.0F + ggx_lambda(cos_out, alpha)) : 0.0F;
}

float ggx_rms_tilt(float alpha) {
    const float a = std::max(alpha, 1e-6F);
    return a * std::sqrt(std::log(1.0F + (0.62F + 0.45F * a) / (a * a)));
}

} // namespace atrium
