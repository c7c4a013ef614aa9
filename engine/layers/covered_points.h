// Places of a surface that something else rests on.
#pragma once

#include "engine/raycast/ray_scene.h"

namespace atrium {

/// True where no light can reach a point of a surface because something rests on the surface or encloses the point: every
/// way out of the half space about `normal` is shut within `reach` metres, or ends on the unlit inside of a solid. (The
/// underside of a box that stands on the floor lies in the floor's own plane, where no ray can tell them apart.) Any thread.
bool is_covered(const RayScene& rays, const vec3& point, const vec3& normal, float reach);

/// True for the end of something that sinks a little into another surface: along its own surface the point meets the unlit
/// back of that one within half of `reach`. What falls there (under the floor: the sky) is no light of the part that is
/// seen. Any thread.
bool is_cut_off(const RayScene& rays, const vec3& point, const vec3& normal, float reach);

/// Either: nobody sees the point itself, and it shows its neighbours' light. Any thread.
inline bool is_out_of_sight(const RayScene& rays, const vec3& point, const vec3& normal, float reach) {
    return is_covered(rays, point, normal, reach) || is_cut_off(rays, point, normal, reach);
}

} // namespace atrium
