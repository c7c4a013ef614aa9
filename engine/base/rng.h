// Deterministic numbers: every stream is a pure function of stable keys, never of allocation order or threads.
#pragma once

#include "engine/base/math.h"

#include <cstdint>

namespace atrium {

/// 64-bit mixer (splitmix64 finaliser).
inline std::uint64_t hash64(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15ULL;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    return x ^ (x >> 31);
}
inline std::uint64_t hash_combine(std::uint64_t a, std::uint64_t b) { return hash64(a ^ (hash64(b) + (a << 6) + (a >> 2))); }

/// Bits to a float in [0, 1).
inline float unit_float(std::uint32_t bits) { return float(bits >> 8) * 0x1.0p-24F; }

/// Laine-Karras style hash permutation: nested uniform (Owen) scrambling of a bit-reversed integer
/// (Laine & Karras 2011; constants of Vegdahl 2021).
inline std::uint32_t owen_scramble_reversed(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3D20ADEAU;
    x += seed;
    x *= (seed >> 16) | 1U;
    x ^= x * 0x05526C56U;
    x ^= x * 0x53A22864U;
    return x;
}
inline std::uint32_t reverse_bits(std::uint32_t x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00FF00FFU) << 8) | ((x & 0xFF00FF00U) >> 8);
    x = ((x & 0x0F0F0F0FU) << 4) | ((x & 0xF0F0F0F0U) >> 4);
    x = ((x & 0x33333333U) << 2) | ((x & 0xCCCCCCCCU) >> 2);
    return ((x & 0x55555555U) << 1) | ((x & 0xAAAAAAAAU) >> 1);
}
/// Sample `index` of dimension `dimension` (0 to 3) of the Sobol sequence, Owen-scrambled by `seed`; in [0, 1).
/// The first 2^k indices are stratified for every k, so streams are nested: doubling the count keeps the first half.
float sobol_owen(std::uint32_t index, unsigned dimension, std::uint32_t seed);
/// Two dimensions at once: (0,1) or (2,3).
inline vec2 sobol_owen2(std::uint32_t index, unsigned first_dimension, std::uint32_t seed) {
    return {sobol_owen(index, first_dimension, seed), sobol_owen(index, first_dimension + 1, seed)};
}

} // namespace atrium
