// The way of light over mirrors, metals and glass, one surface at a time.
#pragma once

#include "engine/optics/specular.h"
#include "engine/raycast/ray_scene.h"

namespace atrium {

/// A place that a ray has met, as what bends light there sees it. Normals are on the side that the ray came from; one that
/// interpolation has turned away from the ray is the geometric one.
struct WalkPoint : SpecularPoint {
    vec3 position{0.0F};  ///< hit_position()
    float cover = 1.0F;   ///< alpha of a blended surface, else 1
    bool mirrors = false; ///< mirrors or refracts on this side; backs of metals are black where the file says one-sided
};
WalkPoint walk_point(const RayScene& rays, const Hit& hit, const vec3& direction);

/// What a solid leaves of light that has come through it to this point; 1 elsewhere.
Rgb left_by_solid(const WalkPoint& at, const Hit& hit);

/// A point moved off its surface by a few roundings of its coordinates, at least 10 micrometres.
vec3 off_surface(const vec3& position, const vec3& normal);

/// A ray on its way. Light may be followed from where it comes or back from where it arrives: the weights are the same.
struct LightWay {
    Ray ray;
    Rgb through{1.0F};      ///< of the light at its start what is still there
    float unit = 1.0F;      ///< largest component of `through` at the start: what the roulette judges by
    unsigned bends = 0;     ///< mirrors met, lenses entered or left: everything but straight passages
    std::uint64_t seed = 0; ///< of the choices on this way
};

/// How one surface sent a ray on.
struct WayOn {
    vec3 position{0.0F};  ///< where it met the surface
    vec3 geometric{0.0F}; ///< unit normals on the side that it came from
    vec3 shading{0.0F};
    float spread = 0.0F; ///< see SpecularSample
    bool straight = false;
    bool transmitted = false; ///< through the surface, straight or bent
};

/// Sends a ray on from what it met: straight through clear glass and holes, or over a mirror or through a lens, by one
/// choice in proportion to what goes either way. Weights are moved from the light that is left to chance (Russian roulette)
/// below kRouletteBelow, never cut off. False where no light goes on; `way` is then as before but for its seed.
bool send_on(const RayScene& rays, const Hit& hit, LightWay& way, WayOn* how = nullptr);
/// The same over a mirror or through a lens only, never straight; `u` are three numbers in [0,1) for its lobe.
bool bend_on(const RayScene& rays, const Hit& hit, LightWay& way, const vec3& u, WayOn& how);
inline constexpr float kRouletteBelow = 0.05F;

/// Share of light along `direction` that a smooth mirror sends on from a hit: Schlick's with the colour there.
Rgb mirror_reflectance(const RayScene& rays, const Hit& hit, const vec3& direction);

/// Share of light along `direction` that send_on() sends on from a hit, luminance, mean over chance.
float onward_share(const RayScene& rays, const Hit& hit, const vec3& direction);

/// Position of a hit from its triangle: the rounding of a ray that came from far away is left behind.
vec3 hit_position(const RayScene& rays, const Hit& hit);

/// Most surfaces that one ray is followed over; where mirrors face each other the roulette may take long.
inline constexpr unsigned kMostSurfaces = 256;

} // namespace atrium
