// How bright a scene is from its darkest to its brightest surfaces, for scales that fit by themselves.
#pragma once

#include "engine/solver/solution.h"
#include "engine/view/false_color.h"

#include <span>
#include <unordered_set>
#include <vector>

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

/// The amounts that light_range() looks at, ascending: each stands for the same area. Only of the nodes in `of` unless that
/// is null. Empty where there is no light. Any thread.
std::vector<double> light_amounts(const Scene& scene, const Solution& solution, LightQuantity quantity,
                                  const LightShares& shares, const std::unordered_set<NodeId>* of);

/// How many of some amounts lie in each of `bars` equal pieces of a scale, over the most of any piece; what lies beyond an
/// end counts there.
std::vector<float> light_bars(const FalseColor& scale, std::span<const double> amounts, std::size_t bars = 48);

/// `scale` with round ends around the range: from zero on a linear scale, over at most three powers of ten on a logarithmic
/// one. Unchanged where there is no light.
FalseColor fitted_scale(FalseColor scale, const LightRange& range);

} // namespace atrium
