// One chart on its way to caustic textures: what landed on it, what of that is in textures, and what was decided.
#pragma once

#include "engine/base/run_context.h"
#include "engine/caustics/restriction.h"
#include "engine/caustics/texel_grid.h"

namespace atrium {

/// What the makers of textures share. Whatever refers to the surface must outlive it.
struct ChartWork {
    const ChartDomain& domain;
    const SurfaceCharts& charts;
    std::span<const vec3> positions;
    std::span<const uvec3> triangles;
    const CausticSettings& settings;
    const RunContext& context;
    std::vector<CausticLanding> landings{}; ///< side by side in memory, for they are looked at many times
    std::vector<double> weight{};           ///< luminance of each over that of the strongest, see exact_weight()
    std::vector<std::uint32_t> left{};      ///< landings that no texture holds, ascending
    double power = 0.0;                     ///< lumen: the sum of every landing's strongest colour
    OrderFreeSum in_textures{0.0};          ///< luminance, lumen
    CausticRecord record{};
    std::vector<std::shared_ptr<const CausticTexture>> textures{};

    [[nodiscard]] vec2 size() const { return domain.high - domain.low; }
    [[nodiscard]] double fullest() const; ///< lumen that textures all over the chart could hold
    [[nodiscard]] bool stopped() const { return context.should_stop(); }
    /// A rectangle of whole texels of a grid of width x height texels over the chart.
    [[nodiscard]] TexelGrid grid_of(const CellBox& box, int width, int height) const;
    /// Makes a texture of an image on such a rectangle.
    void keep(const TexelGrid& grid, std::vector<Rgb> image);
};

/// Textures by the landings' footprints, of about `texels` texels together.
void fill_by_footprints(ChartWork& work, double texels);
/// The algorithms of 2001: contrast, equation 7, spiral, flood fill.
void fill_as_in_2001(ChartWork& work, double texels);

/// Paper mode may find otherwise than the tests, and a hand than both: what is to be done with a chart.
void obey_wish(ChartWork& work);

} // namespace atrium
