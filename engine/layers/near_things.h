// What stands close before the sides of charts: there light from large sources changes within a hand's breadth.
#pragma once

#include "engine/layers/light_cells.h"
#include "engine/layers/light_sheets.h"

#include <span>
#include <vector>

namespace atrium {

/// All triangles of a scene by where they are. Immutable; safe from any thread. `rays` must outlive it.
class NearThings {
public:
    /// Nothing farther than `reach` metres is ever looked for.
    NearThings(const RayScene& rays, float reach);

    /// A triangle in a chart's own coordinates: metres along u and v from the corner of its rectangle, and before its side.
    using Triangle = std::array<vec3, 3>;
    /// Those of which some part is before a planar sheet and within reach of it, by the tiles (of the chart's rectangle, row
    /// by row) that they are within reach of.
    [[nodiscard]] std::vector<std::vector<Triangle>> before(const LightSheet& sheet) const;

private:
    struct Block {
        Box3 box;
        std::uint32_t first = 0, last = 0; ///< triangles of its surface
    };
    const RayScene& rays_;
    float reach_;
    std::vector<Box3> boxes_;                ///< of surfaces
    std::vector<std::vector<Block>> blocks_; ///< of their triangles
};

/// Distance from a place on a sheet (metres along u and v) to a triangle.
float distance_to(const NearThings::Triangle& triangle, const vec2& place);

/// Cells to divide where light from large sources is to be looked for, so that what is left is small beside the distance of
/// whatever stands before it, and does not reach far beyond the border of its chart: starting from whole tiles, down to
/// `level` at most; each before its own quarters. Coordinates are in steps, 2^max_level to a tile.
std::vector<LightCell> cells_near_things(const LightSheets& sheets, unsigned level, unsigned max_level,
                                         const RunContext& context);

} // namespace atrium
