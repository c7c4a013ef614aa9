// What an eye ray meets: how much is scattered, let straight through, mirrored or refracted there.
#pragma once

#include "engine/optics/specular.h"
#include "engine/raycast/ray_scene.h"

namespace atrium {

/// Everything about a hit that does not depend on chance.
struct EyeSurface {
    Hit hit;
    const Material* material = nullptr;
    vec3 direction{0.0F}; ///< the way that the ray came, unit
    vec3 position{0.0F};  ///< from the triangle, not along the ray: free of the rounding of a far origin
    vec3 side{0.0F};      ///< unit geometric normal on the side that was met
    vec3 normal{0.0F};    ///< unit shading normal on that side
    Rgb color{0.0F};      ///< base colour, textures applied
    float covered = 1.0F; ///< alpha of a blended surface, else 1
    Rgb emitted{0.0F};    ///< cd/m2, cover applied
    Rgb diffuse{0.0F};    ///< reflectance, cover applied; 0 on black backs
    Rgb through{0.0F};    ///< goes straight on
    bool specular = false;

    /// One looks into rooms through the backs of one-sided walls: such a hit is none for the eye.
    [[nodiscard]] bool culled() const;
    /// The two ways on over mirror or glass by two numbers in [0,1), cover and absorption on the way here applied.
    [[nodiscard]] SpecularWays ways(const RayScene& rays, const vec2& u) const;
    /// Where a ray that leaves on the side of `way`, or straight on, starts.
    [[nodiscard]] vec3 start_of(const SpecularSample& way) const;
    [[nodiscard]] vec3 behind() const;
};
EyeSurface eye_surface(const RayScene& rays, const Hit& hit, const vec3& direction);

/// A point moved off its surface by a few roundings of its coordinates, at least 10 micrometres.
vec3 off_surface(const vec3& position, const vec3& normal);

} // namespace atrium
