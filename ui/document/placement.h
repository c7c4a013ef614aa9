// How objects stand on surfaces: upright, or turned with the surface. Pure, world coordinates in metres.
#pragma once

#include "engine/base/math.h"

#include <cstdint>

namespace atrium::ui {

/// How an object meets the surface that it is put on.
enum class Mount : std::uint8_t {
    Stand,  ///< upright: on the floor, a table, against a wall
    Face,   ///< turned with the surface: pictures, rugs, wall lights
    Ceiling ///< as Face, and hung from the ceiling above when put on anything else
};

/// Turn of an object whose +y points away from a surface with this normal (unit): identity on a floor; on a wall its -z
/// points up; under a ceiling it is upside down.
dquat turn_to_face(const dvec3& normal);

/// Shift that makes `box` touch the plane through `point` with this normal from its front, its middle in front of `point`.
dvec3 shift_to_rest(const DBox3& box, const dvec3& point, const dvec3& normal);

/// World placement of an object with these bounds (its own coordinates, +y away from the surface) on a surface point.
dmat4 place_on(const DBox3& bounds, Mount mount, const dvec3& point, const dvec3& normal);

} // namespace atrium::ui
