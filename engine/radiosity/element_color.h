// Mean reflectance and exitance of elements, from the materials as they are.
#pragma once

#include "engine/radiosity/hierarchy.h"

#include <span>
#include <vector>

namespace atrium {

/// Mean reflectance and exitance of a piece of surface.
struct SurfaceColor {
    Rgb rho{0.0F};
    Rgb emitted{0.0F};
};
/// At one point of a triangle side, `barycentric` as in Hit.
SurfaceColor color_at(const RayScene& rays, std::uint32_t surface, std::uint32_t triangle, bool back,
                      const vec2& barycentric);
/// True when textures or vertex colours make color_at() depend on the point.
bool color_varies(const RayScene& rays, std::uint32_t surface);
/// Of a leaf.
SurfaceColor mean_color(const Hierarchy& hierarchy, const RayScene& rays, const Element& leaf);
/// Leaves with a face of a surface that is marked (one mark per surface), in storage order.
std::vector<std::uint32_t> leaves_of(const Hierarchy& hierarchy, std::span<const std::uint8_t> surfaces);

} // namespace atrium
