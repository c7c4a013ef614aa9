#include "engine/scene/light.h"

#include <algorithm>

namespace atrium {

float spot_falloff(const Light& light, float cos_angle) {
    const float cos_inner = std::cos(light.inner_cone);
    const float cos_outer = std::cos(light.outer_cone);
    const float t = std::clamp((cos_angle - cos_outer) / std::max(cos_inner - cos_outer, 1e-4F), 0.0F, 1.0F);
    return t * t;
}

} // namespace atrium
