#include "engine/layers/surface_layer.h"

namespace atrium {

Rgb vertex_irradiance(const SurfaceLayer& layer, std::uint32_t vertex, bool back, const LightShares& shares) {
    Rgb sum(0.0F);
    if (shares.diffuse) {
        sum += (back ? layer.irradiance_back : layer.irradiance_front)[vertex];
    }
    const auto& direct = back ? layer.direct_back : layer.direct_front;
    if (shares.direct && !direct.empty()) {
        sum += direct[vertex];
    }
    const auto& caustic = back ? layer.caustic_back : layer.caustic_front;
    if (shares.caustic && !caustic.empty()) {
        sum += caustic[vertex];
    }
    return sum;
}

Rgb irradiance_at(const SurfaceLayer& layer, const std::array<std::uint32_t, 3>& vertex, const vec3& weight, bool back,
                  const LightShares& shares) {
    Rgb sum(0.0F);
    for (int k = 0; k < 3; ++k) {
        sum += vertex_irradiance(layer, vertex[std::size_t(k)], back, shares) * weight[k];
    }
    const auto& map = back ? layer.direct_map_back : layer.direct_map_front;
    const auto& uv = layer.mesh->light_uv;
    if (uv.empty() || uv[vertex[0]].x < 0.0F) {
        return sum;
    }
    const vec2 at = uv[vertex[0]] * weight[0] + uv[vertex[1]] * weight[1] + uv[vertex[2]] * weight[2];
    if (shares.direct && map) {
        sum += map->irradiance(at);
    }
    if (shares.caustic) {
        for (const auto& texture : back ? layer.caustic_textures_back : layer.caustic_textures_front) {
            sum += texture->irradiance(at);
        }
    }
    return sum;
}

} // namespace atrium
