// The sides of charts on which direct light is looked for, and where their places lie in space.
#pragma once

#include "engine/base/run_context.h"
#include "engine/layers/chart_lookup.h"
#include "engine/raycast/ray_scene.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace atrium {

/// One side of a chart.
struct LightSheet {
    std::uint32_t surface = 0;
    bool back = false;
    const Chart* chart = nullptr;
    std::size_t lookup = 0;         ///< of its chart, in LightSheets
    std::vector<std::uint8_t> used; ///< per tile of the chart's rectangle, row by row: 1 where the surface reaches into it
};

/// All sheets of a scene, by surface; front before back for each chart. Immutable; safe from any thread.
class LightSheets {
public:
    /// `rays` and `charts` (one entry per surface) must outlive it. `back_lit(surface)` as in build_direct_maps(). Not to be
    /// used when `context` asked to stop meanwhile.
    LightSheets(const RayScene& rays, std::span<const SurfaceCharts> charts,
                const std::function<bool(std::uint32_t)>& back_lit, const RunContext& context);

    [[nodiscard]] const std::vector<LightSheet>& sheets() const { return sheets_; }
    [[nodiscard]] const RayScene& rays() const { return rays_; }

    struct Place {
        vec3 point{0.0F};  ///< engine coordinates
        vec3 normal{0.0F}; ///< of the side, unit: the plane's on planar charts, the shading normal on curved ones
    };
    /// Where light is to be sampled for a position in a chart (metres from the corner of its rectangle): at the nearest
    /// point of its triangles, a little inside their border; none when that is more than `reach` metres away.
    [[nodiscard]] std::optional<Place> locate(std::uint32_t sheet, const vec2& at, float reach) const;
    /// Metres along the chart from a position to the nearest of its triangles; infinite where that is much farther than
    /// `reach`.
    [[nodiscard]] float distance(std::uint32_t sheet, const vec2& at, float reach) const;

private:
    [[nodiscard]] Place round_place(const LightSheet& sheet, const ChartPoint& on) const;

    const RayScene& rays_;
    std::vector<LightSheet> sheets_;
    std::vector<ChartLookup> lookups_; ///< of all charts, surface by surface
};

} // namespace atrium
