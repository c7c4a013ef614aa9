#include "engine/view/tone.h"

namespace atrium {

float exposure_scale(double mean_radiance, float ev) {
    return mean_radiance > 0.0 ? float(0.18 / mean_radiance) * std::exp2(ev) : 1.0F;
}

Rgb filmic(const Rgb& exposed) {
    const Rgb x = glm::max(exposed, Rgb(0.0F));
    return glm::min((x * (2.51F * x + 0.03F)) / (x * (2.43F * x + 0.59F) + 0.14F), Rgb(1.0F));
}

Rgb display_color(const Rgb& radiance, float scale) {
    const Rgb c = filmic(radiance * scale);
    return {linear_to_srgb(c.r), linear_to_srgb(c.g), linear_to_srgb(c.b)};
}

} // namespace atrium
