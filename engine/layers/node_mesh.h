// The growing mesh of one node: triangles whose edges are split without T-vertices and without slivers.
#pragma once

#include "engine/base/run_context.h"
#include "engine/radiosity/direct_light.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace atrium {

/// Vertex of the growing mesh of one node, with the light sampled there.
struct LightVertex {
    vec3 local{0.0F};
    vec3 local_normal{0.0F};
    vec2 uv0{0.0F};
    vec2 uv1{0.0F};
    vec3 color{1.0F};
    vec3 position{0.0F}; ///< engine coordinates
    vec3 normal{0.0F};   ///< engine coordinates, unit, on the front side
    vec3 towards{0.0F};  ///< sum of (centroid - position) of the triangles around it
    float triangles = 0.0F;
    std::uint32_t weld = 0; ///< same for coincident vertices of the node
    bool wants_back = false;
    bool unlit = false;         ///< of a mirror or glass: its irradiance is of no interest
    bool front_covered = false; ///< something lies on the surface here: no light of its own, shown like its neighbours
    bool back_covered = false;
    bool close = false;   ///< its light is sampled close to it, for a little further inside something lies on the surface
    vec2 light_uv{-1.0F}; ///< chart-space coordinates (tiles); negative: uncharted, direct light is sampled here
    DirectSample front;   ///< reflected light
    DirectSample back;
    DirectSample front_direct; ///< straight from lamps, sun and sky; uncharted vertices only
    DirectSample back_direct;

    [[nodiscard]] bool charted() const { return light_uv.x >= 0.0F; }
};

/// Triangle of the growing mesh; indices into NodeMesh::vertices.
struct MeshTriangle {
    std::array<std::uint32_t, 3> v{};
    std::uint32_t surface = 0;
    bool open = true; ///< its edges may still be split
};

/// Mixes the two halves of an edge key.
struct EdgeHash {
    std::size_t operator()(std::uint64_t key) const noexcept { return std::size_t(key * 0x9E3779B97F4A7C15ULL >> 13); }
};

/// Same for (a, b) and (b, a).
inline std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t(std::min(a, b)) << 32) | std::max(a, b);
}

/// Triangles of all surfaces of one node, split together.
struct NodeMesh {
    std::vector<std::uint32_t> surfaces;
    std::vector<LightVertex> vertices;
    std::vector<MeshTriangle> triangles;
    std::uint32_t welds = 0;
};

/// Split edges, by the welded ids of their ends: the welded id of the middle.
using SplitSet = std::unordered_map<std::uint64_t, std::uint32_t, EdgeHash>;
/// Middles that exist already, by the vertex pair: the vertex.
using Middles = std::unordered_map<std::uint64_t, std::uint32_t, EdgeHash>;

/// Appends a triangle and tells its vertices where it lies.
void add_triangle(NodeMesh& mesh, const MeshTriangle& triangle);
/// Vertex half-way between two, all attributes interpolated; it has no light and no welded id yet.
LightVertex midpoint(const LightVertex& a, const LightVertex& b);
/// Length of an edge in engine coordinates, metres.
float edge_length(const NodeMesh& mesh, std::uint32_t a, std::uint32_t b);
/// Grows a set of split edges until every triangle that has one also splits its longest edge, and opens all triangles
/// concerned: no slivers, and no T-vertex on a triangle that was thought finished.
/// When stopped, this and cut() leave a mesh that is of no use.
void close_split(NodeMesh& mesh, SplitSet& split, StopCheck& stop);
/// Cuts the open triangles along the edges of a closed set (close_split); open triangles without one are closed. Middles
/// found in `middles` are used, others made. Returns the number of vertices made.
std::size_t cut(NodeMesh& mesh, const SplitSet& split, Middles& middles, StopCheck& stop);

} // namespace atrium
