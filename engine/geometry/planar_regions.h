// Pieces of a triangle surface that lie in one plane: what planar charts are made of.
#pragma once

#include "engine/base/math.h"
#include "engine/base/run_context.h"

#include <cstdint>
#include <span>
#include <vector>

namespace atrium {

/// How far triangles may be from a common plane and from each other and still be one piece. Metres.
struct PlanarSettings {
    float flatness = 1e-3F;     ///< about the largest distance of a corner from the plane of the piece
    float cos_angle = 0.99985F; ///< of the largest angle between a triangle's normal and that of the piece (1 degree)
};

/// Triangles of one plane.
struct PlanarRegion {
    dvec3 normal{0.0}; ///< unit, on the triangles' front side
    dvec3 centroid{0.0};
    double area = 0.0;       ///< of its triangles, square metres
    vec3 axis{0.0F};         ///< unit, in the plane: most of the outline, by length, goes along or across it
    std::uint32_t first = 0; ///< into PlanarRegions::members
    std::uint32_t count = 0;
};

/// All pieces of a surface, in the order of their first triangles.
struct PlanarRegions {
    std::vector<PlanarRegion> regions;
    std::vector<std::uint32_t> members; ///< triangles, piece by piece, ascending within each
};

/// Divides triangles (counter-clockwise from the front) into planar pieces: triangles that share an edge, corners welded
/// within two millionths of the extents, whatever number of triangles meets there; and pieces of one plane whose rectangles
/// touch or overlap, which finds neighbours without a whole edge in common (T-vertices), and nested pieces, which share the
/// rectangle at no cost. Triangles without area are in no piece. Deterministic, O(n log n).
/// Nothing when stopped.
PlanarRegions planar_regions(std::span<const vec3> positions, std::span<const uvec3> triangles,
                             const PlanarSettings& settings, const RunContext& context = {});

} // namespace atrium
