// How bright a scene is from its darkest to its brightest surfaces, for scales that fit by themselves.
#pragma once

#include "engine/solver/solution.h"
#include "engine/view/false_color.h"

namespace atrium {

/// Between which amounts nearly all of the light on matt surfaces lies; lux or cd/m2.
struct LightRange {
    double low = 0;  ///< five per cent of the surfaces' area are darker; not below a twentieth of the median, since
                     ///< what lies inside and behind things is never seen
    double high = 0; ///< one per cent of it is brighter; 0 = no light
};

/// Read at 16384 points spread evenly over all shown sides of matt surfaces. Luminance is without textures. Any thread;
/// tens of milliseconds in large scenes.
LightRange light_range(const Scene& scene, const Solution& solution, LightQuantity quantity, const LightShares& shares = {});

/// `scale` with round ends around the range: from zero on a linear scale, over at most three powers of ten on a logarithmic
/// one. Unchanged where there is no light.
FalseColor fitted_scale(FalseColor scale, const LightRange& range);

} // namespace atrium
