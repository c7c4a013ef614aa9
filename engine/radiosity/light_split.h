// Which light is looked for by name: emitters and sunlit spots that stand out are gathered by their own form factors and
// visibility rays, the rest by rays over the hemisphere.
#pragma once

#include "engine/radiosity/hierarchy.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace atrium {

/// One entry per element of the hierarchy it was made for; only leaves count.
using LeafFlags = std::vector<std::uint8_t>;

/// Leaves whose own exitance M is more than `contrast` times the mean over the other surfaces of their room: lamps, screens,
/// but not the walls of a furnace, whose light the links carry exactly. `room` = one number per element, equal within a room
/// (empty: all is one room).
LeafFlags named_emitters(const Hierarchy& hierarchy, const std::vector<std::uint32_t>& room, float contrast);

/// The same for radiosity after a solution: spots in the sun, ceilings next to a lamp.
LeafFlags bright_leaves(const Hierarchy& hierarchy, const std::vector<std::uint32_t>& room, float contrast);

/// True where particles bring the light that a leaf sends over a mirror or through glass (`over`, the last thing that bent a
/// ray before it came to the leaf, one of `bends`): whoever follows it back leaves it to them. Safe from any thread.
using CarriedByParticles = std::function<bool(std::uint32_t leaf, const Hit& over, unsigned bends)>;

/// A copy of the tree in which only flagged leaves shine: by their exitance M (`emission`), or by their radiosity.
Hierarchy only_flagged(const Hierarchy& hierarchy, const LeafFlags& flags, bool emission);

} // namespace atrium
