// Light at the border of what rests on a surface: what the vertices under it have to show so that it is right beside it.
#pragma once

#include "engine/base/run_context.h"
#include "engine/layers/node_mesh.h"

#include <functional>
#include <vector>

namespace atrium {

/// An edge from an open vertex to a covered one, and the light where the cover begins on it.
struct BorderEdge {
    std::uint32_t open = 0;    ///< into NodeMesh::vertices
    std::uint32_t covered = 0; ///< likewise
    float length = 0.0F;       ///< metres
    float at = 0.0F;           ///< share of the edge, from the open end, that is open: [0, 1]
    vec3 position{0.0F};       ///< engine coordinates, on the open side of the border
    vec3 normal{0.0F};         ///< unit, of the side that is lit
    DirectSample reflected;
    DirectSample direct;
};

/// Side of a vertex and what tells of it.
struct VertexSide {
    bool back = false;
    [[nodiscard]] bool wanted(const LightVertex& v) const { return !v.unlit && (!back || v.wants_back); }
    [[nodiscard]] bool covered(const LightVertex& v) const { return back ? v.back_covered : v.front_covered; }
    [[nodiscard]] vec3 normal(const LightVertex& v) const { return back ? -v.normal : v.normal; }
};

/// Point of a side where the light of a vertex is sampled.
using SamplePlace = std::function<vec3(const LightVertex& vertex, const vec3& normal)>;
/// is_covered() of a point of a side.
using CoveredAt = std::function<bool(const vec3& point, const vec3& normal)>;

/// All edges of a side of a mesh with one end open and one covered, each once, those of a covered vertex together, with the
/// place where the cover begins: found by halving, to within a thirtieth of the edge. Parallel inside, the same for any
/// number of threads. Not to be used when stopped.
std::vector<BorderEdge> find_borders(const NodeMesh& mesh, const VertexSide& side, const SamplePlace& place,
                                     const CoveredAt& covered, const RunContext& context);

/// Covered vertices take the light with which the interpolation along their border edges is right where the cover begins (by
/// least squares); others that are covered take that of their neighbours, from the rim inwards, so that no dark halo runs
/// out from under a foot, a board or a rug. `borders` as found, with the light of `sample` in `of_border`. When stopped,
/// some are left.
void fill_covered(NodeMesh& mesh, const VertexSide& side, DirectSample LightVertex::*sample,
                  const std::vector<BorderEdge>& borders, DirectSample BorderEdge::*of_border, StopCheck& stop);

} // namespace atrium
