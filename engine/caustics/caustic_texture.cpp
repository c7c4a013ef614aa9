#include "engine/caustics/caustic_texture.h"

#include <algorithm>

namespace atrium {

Rgb CausticTexture::irradiance(const vec2& uv) const {
    if (image.empty() || uv.x < low.x || uv.y < low.y || uv.x > high.x || uv.y > high.y) {
        return Rgb(0.0F);
    }
    const vec2 at = (uv - low) / (high - low) * vec2(float(width), float(height)) - vec2(0.5F);
    const float x = std::clamp(at.x, 0.0F, float(width - 1));
    const float y = std::clamp(at.y, 0.0F, float(height - 1));
    const auto ix = std::min(std::uint32_t(x), width - 1), iy = std::min(std::uint32_t(y), height - 1);
    const std::uint32_t jx = std::min(ix + 1, width - 1), jy = std::min(iy + 1, height - 1);
    const float fx = x - float(ix), fy = y - float(iy);
    const auto texel = [&](std::uint32_t i, std::uint32_t j) { return image[std::size_t(j) * width + i]; };
    return (texel(ix, iy) * (1.0F - fx) + texel(jx, iy) * fx) * (1.0F - fy) +
           (texel(ix, jy) * (1.0F - fx) + texel(jx, jy) * fx) * fy;
}

const char* caustic_decision_name(CausticRecord::Decision decision) {
    static constexpr const char* kNames[] = {
        "texture",        "mesh: uniform",    "mesh: no finer than the mesh", "mesh: too few particles",
        "mesh: no chart", "mesh: set by hand"};
    return kNames[std::size_t(decision)];
}

} // namespace atrium
