// Photometric conventions of the whole program (CONTRACTS: Units).
#pragma once

#include "engine/base/math.h"

namespace atrium {

/// Linear RGB with Rec. 709 primaries. As radiance each channel is in cd/m2, as irradiance in lux, as flux in lumen.
using Rgb = vec3;

/// Photometric value of a linear Rec. 709 triple: lux, cd/m2 or lumen according to what the triple holds.
inline float luminance(const Rgb& c) { return 0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b; }

/// Angular diameter of the sun from the earth, degrees, used where a directional light does not say otherwise.
inline constexpr float kSunAngularDiameterDegrees = 0.53F;

inline constexpr double radians_from_degrees(double degrees) { return degrees * kPiD / 180.0; }
inline constexpr double degrees_from_radians(double radians) { return radians * 180.0 / kPiD; }

/// sRGB transfer function, one channel, [0,1] to [0,1].
inline float srgb_to_linear(float s) { return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F); }
inline float linear_to_srgb(float l) { return l <= 0.0031308F ? 12.92F * l : 1.055F * std::pow(l, 1.0F / 2.4F) - 0.055F; }

} // namespace atrium
