// Questions about how a mesh's triangles hang together. OpenMesh is included by mesh_topology.cpp and nowhere else.
#pragma once

#include "engine/base/run_context.h"
#include "engine/geometry/primitives.h"

namespace atrium {

/// True when the triangles, welded by position, form a closed half-edge mesh: every edge is shared by two triangles in
/// opposite directions. Such a mesh bounds a solid and its back sides can never be seen from outside. Meshes that no
/// half-edge structure can hold (an edge with three triangles, flipped neighbours) are not closed. Degenerate triangles do
/// not count. False when stopped.
bool is_closed(const MeshData& mesh, const RunContext& context = {});

/// Signed volume of a closed mesh, cubic metres in its own coordinates: positive when its faces look outward.
double signed_volume(const MeshData& mesh);

} // namespace atrium
