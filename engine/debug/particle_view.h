// Ways of particles over mirrors and through glass, as polylines.
#pragma once

#include "engine/base/ids.h"
#include "engine/base/math.h"
#include "engine/base/units.h"
#include "engine/scene/scene.h"
#include "engine/solver/solution.h"

#include <unordered_set>
#include <vector>

namespace atrium {

/// One particle from its source to where it ended, world coordinates.
struct ParticlePolyline {
    std::vector<dvec3> points;
    Rgb power{0.0F}; ///< of what landed, lumen
};
struct ParticleView {
    std::vector<ParticlePolyline> ways;
    std::uint64_t particles = 0;   ///< that were emitted in the whole scene
    std::size_t passage_cells = 0; ///< of the octree of passing particles; 0 = there is none, they are found by a scan
};

/// Ways of particles that landed on one of some nodes or were aimed at one; of all nodes where `of` is empty. At most
/// `most`, evenly chosen. Ends that lie outside everything are cut off. Empty without Solution::insides. Any thread.
ParticleView view_particles(const Solution& solution, const std::unordered_set<NodeId>& of, std::size_t most = 400);

} // namespace atrium
