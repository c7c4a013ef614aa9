// How strong light may be.
#pragma once

namespace atrium {

/// Largest luminous intensity (cd), illuminance of a sun (lux) and luminance (cd/m2) of one source: 600 times the luminance
/// of the sun. Light is kept in single precision; up to here its squares times areas stay numbers.
inline constexpr float kMaxLight = 1e12F;

} // namespace atrium
