// How many texels a caustic texture has.
#pragma once

#include "engine/caustics/texel_grid.h"

namespace atrium {

/// PAPER equation 7 as mended: the largest whole d with K 4^(d+1) / n <= epsilon, that is d <= ln(n epsilon / K) / (2 ln 2)
/// - 1; a texture of 2^d texels a side. K, the integral of the squared kernel, is 1 for a box. Never negative.
int caustic_level(double particles, double epsilon);

struct TexelCount {
    std::uint32_t width = 1;
    std::uint32_t height = 1;
};
/// Powers of two of about 4^level texels together, as nearly square on the surface as they go; `extent` in metres.
TexelCount paper_resolution(int level, const vec2& extent);

/// Edge of a texel, metres: half the minor half axis of the particles' footprints, the median by power, so that kernels are
/// resolved where they are typically narrow; no finer than what `most_texels` over `area` (square metres) allow, no coarser
/// than a quarter of what the mesh shows.
float footprint_resolution(std::vector<std::pair<float, float>> axis_and_power, double area, std::uint32_t most_texels,
                           float mesh_edge);

} // namespace atrium
