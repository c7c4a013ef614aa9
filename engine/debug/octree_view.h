// The octree of passing particles around some objects, as figures.
#pragma once

#include "engine/base/ids.h"
#include "engine/base/math.h"
#include "engine/scene/scene.h"
#include "engine/solver/solution.h"

#include <unordered_set>
#include <vector>

namespace atrium {

/// A cell that is not divided, world coordinates.
struct OctreeCell {
    DBox3 box;
    std::size_t particles = 0; ///< that cross it
};
struct OctreeView {
    std::vector<OctreeCell> cells;
    std::size_t touched = 0;   ///< particles that cross the bounds of the objects: what their move would send anew
    std::size_t particles = 0; ///< in all, that go over mirrors and glass
    std::size_t scan = 0;      ///< that a look through the cells has to look at; without them it is all of them
};

/// What PassageOctree makes around the bounds of some nodes' surfaces, when these are what moves: the cells are as small as
/// they are, and each has the particles that cross it. Nothing without Solution::insides, particles or surfaces. The engine
/// of the editor itself finds touched particles by a scan; the answer is the same. Any thread.
OctreeView view_octree(const Solution& solution, const std::unordered_set<NodeId>& of);

} // namespace atrium
