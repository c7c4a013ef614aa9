// Charts: the flat or rolled-out pieces of a surface with coordinates of their own. Light maps, caustic textures and the
// quadtrees of the element hierarchy live on them.
#pragma once

#include "engine/base/math.h"
#include "engine/base/run_context.h"
#include "engine/geometry/primitives.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace atrium {

/// What charts are made of. Lengths are in engine coordinates, metres.
struct ChartSettings {
    float tile_edge = 0.32F;       ///< edge of a square tile; every chart's rectangle is a whole number of tiles
    float smallest_extent = 0.16F; ///< pieces whose longer side is below this stay uncharted (light on vertices)
    float smallest_width = 0.01F;  ///< pieces narrower than this on average (area over longer side) stay uncharted too
    float flatness = 1e-3F;        ///< triangles within this of a plane (and within about 1 degree) may share a chart
};

/// One piece of a surface and its rectangle in the surface's chart space (tiles; u to the right, v up).
struct Chart {
    bool planar = true;       ///< false: the rolled-out side of a sphere, cylinder or cone
    std::uint32_t tile_u = 0; ///< first tile of its rectangle
    std::uint32_t tile_v = 0;
    std::uint32_t tiles_u = 0; ///< size of its rectangle
    std::uint32_t tiles_v = 0;
    vec2 scale{1.0F};  ///< metres per tile along u and v (tile_edge where planar; on curved charts, where widest)
    vec3 origin{0.0F}; ///< planar: position of the rectangle's corner (tile_u, tile_v)
    vec3 axis_u{0.0F}; ///< planar: unit vectors; axis_u x axis_v = normal on the front side
    vec3 axis_v{0.0F};
    vec3 normal{0.0F};
    float area = 0.0F; ///< of its triangles, square metres
};

/// All charts of one surface. Triangles keep their order; a triangle belongs to at most one chart. Coordinates of its
/// corners stay a little inside the chart's rectangle (a few roundings), so that no interpolated point falls on another
/// chart's tile.
struct SurfaceCharts {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    float tile_edge = 0.0F;
    std::uint32_t width = 0; ///< of the chart space, tiles; 0 when nothing is charted
    std::uint32_t height = 0;
    std::vector<Chart> charts;
    std::vector<std::uint32_t> chart_of_triangle; ///< one per triangle, kNone = uncharted
    std::vector<std::array<vec2, 3>> uv;          ///< one per triangle: chart-space coordinates (tiles) of its corners

    [[nodiscard]] bool empty() const { return charts.empty(); }
};

/// Charts of a surface given as triangles in engine coordinates, counter-clockwise from the front. Edge-connected triangles
/// of one plane become one planar chart, whatever their number; so do pieces of one plane whose rectangles touch or overlap
/// (see planar_regions()). `domain` (empty, or one per position; see curved_domain()) are a curved primitive's own [0,1]^2
/// coordinates, which make one curved chart of all triangles that have them (metres from its largest extents); negative
/// coordinates mark the flat ends, which become planar charts. Rectangles are packed into a roughly square space of at most
/// 65535 tiles: a surface that needs more gets larger tiles (twice, four times ...), one of very many pieces loses the
/// smallest. Deterministic; O(n log n). Nothing when stopped.
SurfaceCharts build_charts(std::span<const vec3> positions, std::span<const uvec3> triangles, std::span<const vec2> domain,
                           const ChartSettings& settings, const RunContext& context = {});

/// Domain coordinates for build_charts() of a tessellated primitive, one per vertex of `mesh`: those of the rolled-out side
/// of a sphere, cylinder or cone (u around, v along the axis; no triangle goes over the seam), (-1, -1) on flat ends. Empty
/// for every other primitive. `mesh` is what tessellate() made of `geometry`.
std::vector<vec2> curved_domain(const Geometry& geometry, const MeshData& mesh);

} // namespace atrium
