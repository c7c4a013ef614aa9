// Cells of a sheet: what of the sheet's triangles lies in a rectangle, and points and colours of it.
#pragma once

#include "engine/radiosity/element_color.h"

#include <span>

namespace atrium {

/// Fills the element of a whole sheet's side (its kind, place, area and colour) and appends its cell.
void make_sheet_patch(Hierarchy& hierarchy, const RayScene& rays, std::uint32_t element, std::uint32_t sheet, bool back);

/// A point of the surface in a cell, uniform for uniform `u` in [0,1)^2; never quite on an edge of a rectangle.
struct CellPoint {
    vec3 position{0.0F};
    std::uint32_t triangle = Element::kNone; ///< within the surface; kNone where the cell keeps no parts
    vec2 barycentric{0.0F};
};
CellPoint point_in_cell(const Hierarchy& hierarchy, const PatchCell& cell, vec2 u);
/// The same by way of the parts, which a cell of varying colour always has.
CellPoint point_in_parts(const Hierarchy& hierarchy, const PatchCell& cell, vec2 u);

} // namespace atrium
