// 16-bit floating-point numbers (IEEE 754 binary16), as light maps are stored and sent to the graphics card.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace atrium {

/// Bits of the half nearest to `value` (ties to even): relative error at most 2^-11 from 2^-14 to 65504. Larger values
/// become infinite, NaN stays NaN.
inline std::uint16_t half_from_float(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = (bits >> 16U) & 0x8000U;
    const std::uint32_t magnitude = bits & 0x7FFFFFFFU;
    if (magnitude >= 0x47800000U) { // 65536 and more
        return std::uint16_t(sign | (magnitude > 0x7F800000U ? 0x7E00U : 0x7C00U));
    }
    if (magnitude < 0x38800000U) { // below 2^-14: adding 0.5 lets the processor round to multiples of 2^-24
        const float shifted = std::bit_cast<float>(magnitude) + 0.5F;
        return std::uint16_t(sign | (std::bit_cast<std::uint32_t>(shifted) - 0x3F000000U));
    }
    const std::uint32_t odd = (magnitude >> 13U) & 1U;
    return std::uint16_t(sign | ((magnitude - 0x38000000U + 0xFFFU + odd) >> 13U));
}

/// Value of a half, exact.
inline float float_from_half(std::uint16_t half) {
    const std::uint32_t sign = (half & 0x8000U) << 16U;
    const std::uint32_t exponent = (half >> 10U) & 0x1FU;
    const std::uint32_t fraction = half & 0x3FFU;
    if (exponent == 0) {
        const float value = float(fraction) * (1.0F / 16777216.0F);
        return sign != 0 ? -value : value;
    }
    const std::uint32_t wide = exponent == 31U ? 0xFFU : exponent + 112U;
    return std::bit_cast<float>(sign | (wide << 23U) | (fraction << 13U));
}

/// True when the half is neither infinite nor NaN.
inline bool half_is_finite(std::uint16_t half) { return (half & 0x7C00U) != 0x7C00U; }

/// Exponent e such that values up to `largest` divided by 2^e use a half's range to the full: below 2^15, with nine orders
/// of magnitude under it in full precision. The same for a value and for what is left of it after storing it so.
inline int half_scale_exponent(float largest) {
    int exponent = 0;
    const float fraction = std::frexp(largest, &exponent); // in [0.5, 1), or 0
    if (!(fraction > 0.0F) || !std::isfinite(fraction)) {
        return 0;
    }
    if (fraction >= 1.0F - 0x1p-12F) {
        ++exponent; // rounds to the next power of two
    }
    return exponent - 15 < -110 ? -110 : exponent - 15;
}

} // namespace atrium
