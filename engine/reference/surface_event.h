// What may become of light at a surface: scattered, let straight through, mirrored or refracted.
#pragma once

#include "engine/optics/specular.h"
#include "engine/raycast/ray_scene.h"

namespace atrium {

/// A point moved off its surface by a few roundings of its coordinates, at least 10 micrometres.
vec3 clear_of(const vec3& position, const vec3& normal);

/// True when the side of the surface that a hit met reflects and emits; other backs are black.
bool side_reflects(const RayScene& rays, const Hit& hit);

/// Everything about a hit that does not depend on chance.
struct SurfacePoint {
    Hit hit;
    const Material* material = nullptr;
    vec3 direction{0.0F}; ///< the way that the ray came, unit
    vec3 position{0.0F};  ///< from the triangle and not along the ray: the rounding of a far origin is left behind
    vec3 side{0.0F};      ///< geometric normal on the side that was met
    Rgb color{0.0F};      ///< base colour, textures applied
    float covered = 1.0F; ///< alpha of a blended surface, else 1
    Rgb diffuse{0.0F};    ///< reflectance; 0 on black backs
    Rgb through{0.0F};    ///< goes straight on
    bool specular = false;
};
SurfacePoint surface_point(const RayScene& rays, const Hit& hit, const vec3& direction);

/// One way on over mirror or glass by three numbers in [0,1): the surface's cover is in the weight, and so is what a solid
/// absorbed over `path` metres to a hit from within.
SpecularSample specular_way(const RayScene& rays, const SurfacePoint& point, const vec3& u, float path);

/// Where the ray of that way starts.
vec3 start_of(const SurfacePoint& point, const SpecularSample& way);

/// A place that bends light within: lengths within a solid count from one such place to the next.
bool bounds_solid(const RayScene& rays, const SurfacePoint& point);

} // namespace atrium
