#include "engine/raycast/scene_charts.h"

#include "engine/base/parallel.h"

namespace atrium {

std::vector<SurfaceCharts> chart_surfaces(const RayScene& rays, const ChartSettings& settings, const RunContext& context) {
    const std::vector<RaySurface>& surfaces = rays.surfaces();
    std::vector<SurfaceCharts> out(surfaces.size());
    parallel_chunks(surfaces.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            out[i] = chart_surface(rays, std::uint32_t(i), settings, context);
        }
    });
    return out;
}

SurfaceCharts chart_surface(const RayScene& rays, std::uint32_t surface, const ChartSettings& settings,
                            const RunContext& context) {
    const RaySurface& s = rays.surfaces()[surface];
    return build_charts(*s.positions, s.triangles, s.domain ? *s.domain : std::vector<vec2>{}, settings, context);
}

} // namespace atrium
