// Checks of what the hierarchy, its links and the transport promise. For tests and debugging; slow, nothing else calls it.
#pragma once

#include "engine/radiosity/hierarchy.h"
#include "engine/radiosity/links.h"
#include "engine/radiosity/transport.h"

#include <string>
#include <vector>

namespace atrium {

/// Faults of the tree, one sentence each, at most 20; empty = sound. Parents precede children, areas and harmonics add up,
/// balls hold everything below, every triangle side of the scene is covered exactly once, random streams are distinct.
std::vector<std::string> check_hierarchy(const Hierarchy& hierarchy, const RayScene& rays);

/// Faults of the links: every pair of leaves is covered at most once, and once if both are patches that face each other.
/// Counts all pairs of leaves (memory and time O(n^2)): for small scenes.
std::vector<std::string> check_links(const Hierarchy& hierarchy, const std::vector<Link>& links);

/// Faults of the operator: row sums at most 1 + 1e-4 when `closed`, no negative or infinite light, and symmetry of
/// area * transport to `symmetry` (relative, on sums over random radiosities). Leaves other radiosities in the hierarchy.
std::vector<std::string> check_transport(const Hierarchy& hierarchy, Transport& transport, bool closed, double symmetry);

} // namespace atrium
