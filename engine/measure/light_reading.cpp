#include "engine/measure/light_reading.h"

#include "engine/scene/texture_sampling.h"

#include <algorithm>

namespace atrium {
namespace {

Rgb textured(const Scene& scene, const TextureRef& ref, const DisplayMesh& mesh, const std::uint32_t* v,
             const vec3& weight) {
    const auto& uv = ref.texcoord == 0 ? mesh.texcoords0 : mesh.texcoords1;
    const Texture* texture = ref ? scene.textures.find(ref.texture) : nullptr;
    if (texture == nullptr) {
        return Rgb(1.0F);
    }
    const vec2 at = uv.empty() ? vec2(0.0F) : uv[v[0]] * weight[0] + uv[v[1]] * weight[1] + uv[v[2]] * weight[2];
    return Rgb(sample_texture(*texture, ref.apply(at)));
}

} // namespace

LightReading read_light(const Scene& scene, const Solution& solution, const SurfaceLayer& layer, const Material& material,
                        std::size_t first_index, const vec3& weight, bool back) {
    const DisplayMesh& mesh = *layer.mesh;
    const std::uint32_t* v = &mesh.indices[first_index];
    const std::array<std::uint32_t, 3> corners{v[0], v[1], v[2]};
    const auto share = [&](bool diffuse, bool direct, bool caustic) {
        return double(luminance(irradiance_at(layer, corners, weight, back, {diffuse, direct, caustic})));
    };
    LightReading out;
    out.irradiance = irradiance_at(layer, corners, weight, back);
    out.illuminance = double(luminance(out.irradiance));
    const Statistics& s = solution.statistics;
    out.standard_error = s.audit.points > 0 ? out.illuminance * s.error_estimate : 0.0;
    out.diffuse = share(true, false, false);
    out.direct = share(false, true, false);
    out.caustic = share(false, false, true);
    Material at_point = material;
    at_point.base_color *= textured(scene, material.base_color_texture, mesh, v, weight);
    if (!mesh.colors.empty()) {
        at_point.base_color *= mesh.colors[v[0]] * weight[0] + mesh.colors[v[1]] * weight[1] + mesh.colors[v[2]] * weight[2];
    }
    Rgb radiance = diffuse_reflectance(at_point) * glm::max(out.irradiance, Rgb(0.0F)) * kInvPi;
    if (!back || material.double_sided) {
        radiance += material.emitted_radiance() * textured(scene, material.emissive_texture, mesh, v, weight);
    }
    out.luminance = double(luminance(radiance));
    return out;
}

} // namespace atrium
