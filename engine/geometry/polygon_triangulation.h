// Triangulation of planar polygons with holes.
#pragma once

#include "engine/geometry/primitives.h"

#include <cstdint>
#include <vector>

namespace atrium {

/// Points of a polygon (outer ring, then holes in order) and triangles over them, counter-clockwise.
struct PolygonTriangles {
    std::vector<vec2> points;
    std::vector<std::uint32_t> indices;
};

/// Ear clipping; holes are joined to the outer ring by bridges (Eberly, "Triangulation by Ear Clipping"). Rings in either
/// orientation are accepted, they may touch. O(n^2) for simple rings; self-intersecting rings give some triangulation of
/// what is left, never a hang.
PolygonTriangles triangulate(const Polygon& polygon);

} // namespace atrium
