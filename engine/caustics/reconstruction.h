// From particles or a histogram to the texels of a caustic texture.
#pragma once

#include "engine/caustics/texel_grid.h"

namespace atrium {

/// How wide the kernel of a landing without a known footprint is, and what is allowed for one with it; in texels.
struct KernelLimits {
    float unknown = 2.0F; ///< radius where the footprint is unknown
    float least = 0.7F;   ///< added to every half axis by its square, so that no texel is missed between two
    float most = 64.0F;   ///< longest half axis
};

/// The texels that kernels may light, and where the chart ends: in texels of the grid.
struct LitRange {
    std::array<int, 2> first{0, 0};
    std::array<int, 2> last{0, 0}; ///< one behind the last
    vec2 edge_low{-1.0F, -1.0F};   ///< the chart's own edges, where kernels are folded back; negative: not here
    vec2 edge_high{-1.0F, -1.0F};
};

/// Spreads the power of a landing over the texels of a grid by an Epanechnikov kernel on its footprint: phi (1 - q), q =
/// x^T M^-1 x < 1, M = footprint + least^2 (photon differentials, Schjoth et al. 2007). Weights are scaled over the surface
/// in the texels, so the power is kept at the edge of a polygon and of the grid too; at the chart's own edges kernels are
/// folded back. A kernel with hardly any surface under it is widened, so that slivers do not glow. False where that does
/// not help or the texels could not hold the light: nothing is added. One thread at a time for the same `sums`. `sign` = -1
/// takes a landing away again.
bool splat(const CausticLanding& landing, const TexelGrid& grid, const LitRange& range, const KernelLimits& limits,
           CausticAccumulator& sums, double sign = 1.0);

/// Half the width of a landing's kernel across its narrow side, texels of the grid.
float kernel_width(const CausticLanding& landing, const TexelGrid& grid, const KernelLimits& limits);

/// The same surface in texels of twice the edge.
TexelGrid coarser(const TexelGrid& grid);

/// Adds what a grid with texels `factor` times as large holds to `image`, bilinear between its texels, within `range` and
/// scaled to the same power channel by channel.
void add_coarser(const std::vector<Rgb>& from, const TexelGrid& coarse, int factor, const TexelGrid& grid,
                 const LitRange& range, std::vector<Rgb>& image);

/// Largest value of a histogram per area, luminance, lux: p_max of the paper. `histogram` is PAPER equation 1 with the area
/// of a full texel for all; texels with less than a quarter of it do not count.
float peak(const std::vector<Rgb>& histogram, const TexelGrid& grid);

/// PAPER equation 8: from every texel outwards in rings, until what was met reaches the histogram's largest value or the
/// radius `reach` (texels); the texel becomes the mean over the surface that was met. The whole is then scaled to the power
/// of the histogram, which this smoothing alone does not keep. `histogram` as for peak(); the result is irradiance, lux.
std::vector<Rgb> spiral_means(const std::vector<Rgb>& histogram, const TexelGrid& grid, float reach);

/// Carries light on into texels without surface next to lit ones, so that interpolation up to a polygon's edge does not
/// darken.
void fill_around(std::vector<Rgb>& image, const TexelGrid& grid);

} // namespace atrium
