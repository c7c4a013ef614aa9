// Charts of every surface that rays can meet.
#pragma once

#include "engine/geometry/surface_charts.h"
#include "engine/raycast/ray_scene.h"

#include <vector>

namespace atrium {

/// Charts of every surface of `rays`, in the order of RayScene::surfaces(): triangles, their order and barycentric
/// coordinates are those of Hit. Curved primitives are charted by their own coordinates. On all cores; the same for any
/// number of them.
/// Some have none when it is stopped.
std::vector<SurfaceCharts> chart_surfaces(const RayScene& rays, const ChartSettings& settings,
                                          const RunContext& context = {});

/// Those of one surface.
SurfaceCharts chart_surface(const RayScene& rays, std::uint32_t surface, const ChartSettings& settings,
                            const RunContext& context = {});

/// Chart-space coordinates of a point of a charted triangle, `barycentric` as in Hit (tiles).
inline vec2 chart_uv(const SurfaceCharts& charts, std::uint32_t triangle, const vec2& barycentric) {
    const std::array<vec2, 3>& uv = charts.uv[triangle];
    return uv[0] + (uv[1] - uv[0]) * barycentric.x + (uv[2] - uv[0]) * barycentric.y;
}

} // namespace atrium
