// Mirrors, metals and glass: where light goes on from a point of them, and how much of it.
#pragma once

#include "engine/scene/material.h"

namespace atrium {

/// Unpolarised Fresnel reflectance of a dielectric interface, in [0, 1]; `cos_i` >= 0 on the side of relative index 1, `eta`
/// = index behind over index in front. 1 at total internal reflection.
float fresnel_dielectric(float cos_i, float eta);

/// Beer-Lambert transmittance of a solid along `path` metres, as KHR_materials_volume has it: attenuation_color ^ (path /
/// attenuation_distance). 1 without attenuation; never NaN.
Rgb absorption(const Material& material, float path);

/// A surface that mirrors or refracts: mirror, polished metal, glass. Metals of roughness kDullMetal and above scatter so
/// widely that they count as diffuse.
bool is_specular(const Material& material);

/// A surface whose own irradiance nobody sees: it scatters nothing, and is not shown as if it did.
bool shows_no_irradiance(const Material& material);

/// One way on from a specular surface.
struct SpecularSample {
    vec3 direction{0.0F}; ///< unit, away from the surface
    Rgb weight{0.0F};     ///< of the light that comes along the incoming ray over the probability of this way; 0 = absorbed
    float spread = 0.0F;  ///< RMS half angle of the lobe about its middle, radians; 0 for mirrors and clear glass
    bool transmitted = false;
};

/// Where light that meets a surface is at the point of it.
struct SpecularPoint {
    const Material* material = nullptr;
    Rgb base_color{1.0F}; ///< textures applied
    vec3 normal{0.0F};    ///< unit shading normal, on the side that the light comes from
    vec3 geometric{0.0F}; ///< unit geometric normal, on the same side
    bool front = true;    ///< the light comes from the surface's front: it enters a solid
    bool slab = false;    ///< a face of a flat pane of solid glass: what goes through goes straight on, as with clear sheets
};

/// Picks one way on for light that arrives along `in` (unit, towards the surface) by three numbers in [0,1): u.x, u.y place
/// it within the lobe, u.z picks the lobe. What the material scatters diffusely is no part of it, nor what goes straight on
/// through thin clear glass (RayScene::straight_through()): of thin clear glass and slabs only the reflection is left.
/// Weights carry radiance backwards and power forwards alike (both ends of a path in air: the squares of the indices
/// cancel). Mean weight over u <= 1. GGX by visible normals (Heitz 2018), height-correlated Smith; smooth below
/// kMirrorRoughness. Frosted sheets send through what a mirror image of their reflection lobe says, tinted. Dull and
/// diffuse materials, and points that no light can come to, give weight 0. Any input; never NaN.
SpecularSample sample_specular(const SpecularPoint& at, const vec3& in, const vec3& u);

/// Both ways on for the facet that u.x, u.y pick, each with its own share of the light and no choice between them: for
/// whoever follows both. Weights may be 0. sample_specular() is a choice between these two in proportion to their weights.
struct SpecularWays {
    SpecularSample reflected;
    SpecularSample transmitted;
};
SpecularWays specular_ways(const SpecularPoint& at, const vec3& in, const vec2& u);

/// Share of light along `in` that sample_specular() sends on, mean over u, luminance: for telling which surfaces matter.
float specular_albedo(const SpecularPoint& at, const vec3& in);

/// A sheet of clear glass that light crosses unbent: thin-walled, smooth. Solid panes are told by RaySurface::slab.
bool is_clear_sheet(const Material& material);

} // namespace atrium
