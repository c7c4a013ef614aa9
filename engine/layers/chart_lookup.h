// From a position in a chart to the point of the surface there, or the nearest one.
#pragma once

#include "engine/geometry/surface_charts.h"

#include <cstdint>
#include <span>
#include <vector>

namespace atrium {

/// A point of a chart's triangles.
struct ChartPoint {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    std::uint32_t triangle = kNone; ///< of the surface; kNone: no triangle within the distance asked for
    vec2 barycentric{0.0F};         ///< weights of its corners 1 and 2
    float distance = 0.0F;          ///< from the position asked for, metres along the chart; 0 inside the triangles
    explicit operator bool() const { return triangle != kNone; }
};

/// A grid over one chart's triangles. Positions are metres along the chart from the corner of its rectangle, that is
/// (uv - (tile_u, tile_v)) * scale. Immutable; safe from any thread.
class ChartLookup {
public:
    ChartLookup() = default; ///< of nothing: not to be asked
    /// `triangles` are those of the chart, ascending indices into `charts.uv`.
    ChartLookup(const SurfaceCharts& charts, const Chart& chart, std::span<const std::uint32_t> triangles);

    /// True when a triangle reaches into the tile (counted from the chart's rectangle), not merely up to its edge.
    [[nodiscard]] bool touches_tile(std::uint32_t u, std::uint32_t v) const { return touched_[v * chart_.tiles_u + u] != 0; }
    /// The point of the triangles nearest to `at`, among those not much farther than `reach` metres.
    [[nodiscard]] ChartPoint nearest(const vec2& at, float reach) const;
    /// The same, and moved by `pull` metres away from the border of the triangles where it lies closer to it than that.
    [[nodiscard]] ChartPoint nearest_inside(const vec2& at, float reach, float pull) const;

private:
    struct Flat {
        vec2 corner[3];
        std::uint32_t triangle;
    };
    /// First triangle of the bin at `at` that holds it; kNone outside.
    [[nodiscard]] ChartPoint containing(const vec2& at) const;
    void add_to_bins();
    [[nodiscard]] int bin_x(float x) const;
    [[nodiscard]] int bin_y(float y) const;

    Chart chart_;
    vec2 bin_{1.0F}; ///< size of a bin, metres
    int bins_x_ = 1;
    int bins_y_ = 1;
    std::vector<Flat> flat_;
    std::vector<std::uint32_t> first_; ///< of each bin in members_; one more at the end
    std::vector<std::uint32_t> members_;
    std::vector<std::uint8_t> touched_;
};

} // namespace atrium
