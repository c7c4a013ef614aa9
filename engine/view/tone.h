// From scene radiance to display values: exposure and the filmic curve shared by the viewport and `render`.
#pragma once

#include "engine/base/units.h"

namespace atrium {

/// Scale that brings a log-average radiance (cd/m2) to middle grey 0.18, times 2^ev. Zero radiance gives 1.
float exposure_scale(double mean_radiance, float ev);
/// Filmic curve on exposed linear radiance, per channel, monotone, [0,inf) to [0,1]: the rational fit of the ACES curve by
/// K. Narkowicz (2015). The viewport's shader has the same formula.
Rgb filmic(const Rgb& exposed);
/// Exposure, curve and sRGB encoding in one: display values in [0,1].
Rgb display_color(const Rgb& radiance, float scale);

} // namespace atrium
