// What an eye ray meets: how much is scattered, let straight through, mirrored or refracted there.
#pragma once

#include "engine/raycast/light_walk.h"

namespace atrium {

/// Everything about a hit that does not depend on chance.
struct EyeSurface : WalkPoint {
    Hit hit;
    vec3 direction{0.0F}; ///< the way that the ray came, unit
    Rgb emitted{0.0F};    ///< cd/m2, cover applied
    Rgb diffuse{0.0F};    ///< reflectance, cover applied; 0 on black backs
    Rgb through{0.0F};    ///< goes straight on

    /// One looks into rooms through the backs of one-sided walls: such a hit is none for the eye.
    [[nodiscard]] bool culled() const;
    /// The two ways on over mirror or glass by two numbers in [0,1), cover and absorption on the way here applied.
    [[nodiscard]] SpecularWays ways(const vec2& u) const;
    /// Where a ray that leaves on the side of `way`, or straight on, starts.
    [[nodiscard]] vec3 start_of(const SpecularSample& way) const;
    [[nodiscard]] vec3 behind() const;
};
EyeSurface eye_surface(const RayScene& rays, const Hit& hit, const vec3& direction);

} // namespace atrium
