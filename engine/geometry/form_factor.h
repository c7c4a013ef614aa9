// Form factors in closed form, stable from far to touching.
#pragma once

#include "engine/base/math.h"

#include <span>

namespace atrium {

/// Form factor from a differential element at `point` with unit normal `normal` to a convex planar polygon, 0 to 1:
/// Lambert's sum over the edges in the atan2 form, in double, the polygon first clipped to the element's horizon.
/// The polygon's side is not looked at: the caller tests that `point` lies in front of it. At most 12 corners.
double form_factor_to_polygon(const vec3& point, const vec3& normal, std::span<const vec3> polygon);

} // namespace atrium
