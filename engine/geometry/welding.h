// Corners of triangles that are the same point, and triangles that share an edge, in any triangle soup.
#pragma once

#include "engine/base/math.h"
#include "engine/base/run_context.h"

#include <cstdint>
#include <span>
#include <vector>

namespace atrium {

/// Triangles over welded points: corners nearer to each other than `tolerance` (metres, per axis) have one index. Points
/// that no triangle uses have none. Of points in a row, each within the tolerance of the next, some may stay apart.
struct WeldedTriangles {
    std::vector<vec3> points;
    std::vector<uvec3> triangles; ///< one per input triangle, in order
};
/// What it returns when stopped is of no use; the same holds for edge_rings().
WeldedTriangles weld(std::span<const vec3> positions, std::span<const uvec3> triangles, float tolerance,
                     const RunContext& context = {});

/// For every half-edge 3 t + k (corner k to corner k + 1 of triangle t) the next one on the same edge, either way round, in
/// a ring; itself where nothing else has that edge. Edges that three or more triangles share are rings of that length.
std::vector<std::uint32_t> edge_rings(const WeldedTriangles& mesh, const RunContext& context = {});

} // namespace atrium
