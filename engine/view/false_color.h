// Amounts of light as colours: the scale that viewport, stills and legends share.
#pragma once

#include "engine/base/units.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace atrium {

/// What a picture in false colour tells of a surface.
enum class LightQuantity : std::uint8_t {
    Illuminance, ///< lux: light that arrives
    Luminance    ///< cd/m2: light that leaves towards the eye
};
/// "lx" or "cd/m2" with a raised 2, UTF-8.
const char* unit_name(LightQuantity quantity);

/// Which colour stands for which amount. Values outside the range have the colours of its ends.
struct FalseColor {
    LightQuantity quantity = LightQuantity::Illuminance;
    bool logarithmic = false;
    double minimum = 0.0; ///< lux or cd/m2; above 0 on a logarithmic scale
    double maximum = 500.0;
    bool contours = false; ///< lines where the light has one of round_values()
    friend bool operator==(const FalseColor&, const FalseColor&) = default;
};
/// The nearest scale that can be drawn: ends in order and apart, and above 0 where it is logarithmic.
FalseColor valid_scale(FalseColor scale);

/// Number of colours of color_map().
inline constexpr std::size_t kMapColors = 256;
/// From dark to bright, 0xRRGGBB in sRGB: viridis by S. van der Walt and N. Smith (2015), in the public domain (CC0). Even
/// steps look even, brightness alone tells the order, and the common kinds of colour blindness see the same.
std::span<const std::uint32_t, kMapColors> color_map();
/// Colour at a place on the map, 0 to 1, in display values.
Rgb map_color(float place);

/// Where an amount lies on the scale, 0 to 1. Needs a valid scale.
float scale_place(const FalseColor& scale, double value);
/// Display values for an amount.
Rgb false_color(const FalseColor& scale, double value);
/// Round amounts within the range, at most `most`, rising: even steps of 1, 2 or 5 times a power of ten on a linear scale,
/// 1-2-3-5, 1-2-5, 1-3 or powers of ten on a logarithmic one. Legends and contours have the same.
std::vector<double> round_values(const FalseColor& scale, std::size_t most = 12);

/// Least 1, 2, 3 or 5 times a power of ten that is not below a positive value.
double round_up(double value);
/// Greatest one that is not above it.
double round_down(double value);

} // namespace atrium
