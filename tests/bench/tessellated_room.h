// One furnished room in any number of triangles: the same surfaces and the same light, cut finer.
#pragma once

#include "engine/scene/scene.h"

namespace atrium::bench {

/// A room of 5 x 2.7 x 6 m with a ceiling lamp, twelve boxes and two eight-sided columns, each face cut into a grid whose
/// cells give the room about `triangles` triangles (not less than its faces need).
Scene tessellated_room(std::size_t triangles);

} // namespace atrium::bench
