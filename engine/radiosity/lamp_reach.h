// How much light of a lamp can reach a place at all, whatever is in the way: what need not be looked at when it moves.
#pragma once

#include "engine/radiosity/direct_light.h"

namespace atrium {

/// No more light than this (lux) reaches a place within `radius` of the point, in the plane across the unit `normal` through
/// the point; a zero normal stands for all planes. 0 where there can be none: behind the lamp's cone or the plane.
float most_light(const PlacedLight& lamp, const vec3& point, float radius, const vec3& normal);
/// The same over a flat mirror.
float most_light_over(const PlanarMirror& mirror, const PlacedLight& lamp, const vec3& point, float radius,
                      const vec3& normal);

} // namespace atrium
