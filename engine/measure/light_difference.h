// How far the light of one scene is apart in two solutions, read at the same points of its surfaces.
#pragma once

#include "engine/solver/gi_engine.h"

#include <cstddef>
#include <span>
#include <vector>

namespace atrium {

/// `count` places spread evenly over the area of all surfaces that scatter light (both sides where both have light), the
/// same ones every time: one in each equal share of the summed area, at varying points of its triangle.
std::vector<SensorPlace> spread_places(const Scene& scene, const Solution& solution, std::size_t count);

/// About `count` places that light can reach and that one can look at, evenly by area, the same ones every time: inside of
/// solids and in gaps (LitPlace::seen()) nobody cares for light, and two solutions may differ there by as much as they like.
/// Empty where the scene has no light. Another `seed` gives other places.
/// Fewer or none when stopped.
std::vector<SensorPlace> seen_places(const Scene& scene, std::size_t count, std::uint32_t seed = 0x5EE7U,
                                     const RunContext& context = {});

/// Figures over all three channels, as in `difference()`.
struct LightDifference {
    std::size_t points = 0; ///< read from both
    double rel_rms = 0;     ///< root of the mean squared difference, over the mean
    double rel_max = 0;     ///< largest |a - b| / (|b| + 1 % of the mean)
    double energy_rel = 0;  ///< |a - b| / b of the light on all surfaces together
};
/// `solution` against `reference`, both of `scene`, where both have light of `places`.
LightDifference light_difference(const Scene& scene, const Solution& solution, const Solution& reference,
                                 std::span<const SensorPlace> places);
/// The same at `count` places of spread_places().
LightDifference light_difference(const Scene& scene, const Solution& solution, const Solution& reference,
                                 std::size_t count = 4096);

} // namespace atrium
