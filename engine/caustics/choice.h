// Mesh or texture: has the light on a chart detail that the mesh cannot show, or is it as even as chance allows?
#pragma once

#include "engine/caustics/texel_grid.h"

namespace atrium {

/// Contrast of PAPER equation 2 as mended, (p_max - p_min) / p_max in [0,1]; 0 where nothing landed.
float caustic_contrast(float p_min, float p_max);

/// A weight in [0,1] as a whole multiple of 2^-24: sums of up to 2^28 of them are exact, whatever their order.
double exact_weight(double weight);

/// A landing as the choice sees it.
struct WeightedPoint {
    vec2 uv{0.0F};       ///< chart space
    double weight = 0.0; ///< its power over that of the strongest, by exact_weight()
};

/// By how much weights per texel are more uneven than if the same particles had been dropped on the texels by chance, in
/// proportion to `expected` (areas): chi square with its exact mean and variance for particles of any weights, as the normal
/// deviate ("standard deviations") of the same probability, so that one threshold holds for 10 particles and for a million.
/// Texels with hardly any share count together. Below 0 for particles of a low-discrepancy stream. 0 for fewer than two
/// texels with a share and for fewer than two particles.
double dispersion(std::span<const double> sums, std::span<const double> expected, double sum_of_squares,
                  double sum_of_fourths);

struct Choice {
    CausticRecord::Decision decision = CausticRecord::Decision::TooFew;
    double dispersion = 0.0;
    float contrast = 0.0F; ///< of the histogram of the same test
};
/// What to do with the landings of a chart. Uniform: the histogram at about 16 particles a texel, nine texels at least, is
/// no more uneven than `least_dispersion` standard deviations of chance. Coarse: after the density at the mesh's resolution,
/// interpolated, is taken away, what is left beyond three standard deviations is a matter of chance, or below 5 % of the
/// light. Stopped by the context: whatever was found so far.
Choice choose_texture(std::span<const WeightedPoint> points, const ChartDomain& domain, const SurfaceCharts& charts,
                      std::span<const vec3> positions, std::span<const uvec3> triangles, const CausticSettings& settings,
                      const RunContext& context = {});

} // namespace atrium
