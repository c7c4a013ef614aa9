// What the leaves of the hierarchy see around them: whether they are enclosed, and whether any light can get to them.
#pragma once

#include "engine/base/run_context.h"
#include "engine/radiosity/hierarchy.h"

#include <cstdint>
#include <vector>

namespace atrium {

/// One entry per leaf, in the order of the list that was asked for.
struct LeafSurroundings {
    std::vector<std::uint8_t> enclosed; ///< no ray leaves the scene or meets glass or a side that reflects nothing
    std::vector<std::uint8_t> dark;     ///< in a room of its own without any light (see look_around)
};

/// Shoots a fixed bundle of rays from every leaf. Leaves that see each other, directly or over others, are one room; a room
/// with no emitting leaf, no direct light and no glass is dark. Links of clusters average over walls: without this a trace
/// of one room's light would come out in the next. `leaves` are the hierarchy's leaves, their direct light known.
LeafSurroundings look_around(const Hierarchy& hierarchy, const RayScene& rays, const std::vector<std::uint32_t>& leaves,
                             const RunContext& context);

/// Takes the light off dark leaves and pulls the radiosities anew.
void darken(Hierarchy& hierarchy, const std::vector<std::uint32_t>& leaves, const LeafSurroundings& surroundings);

} // namespace atrium
