#include "engine/base/rng.h"

#include "engine/base/checks.h"

#include <array>

namespace atrium {
namespace {

using Directions = std::array<std::uint32_t, 32>;

// Direction numbers of the first four Sobol dimensions from the primitive polynomials and initial numbers of
// Joe & Kuo (2008): dimension 1 is van der Corput; 2: s=1 a=0 m={1}; 3: s=2 a=1 m={1,3}; 4: s=3 a=1 m={1,3,1}.
constexpr Directions make_directions(unsigned s, unsigned a, std::array<std::uint32_t, 3> m) {
    Directions v{};
    for (unsigned i = 0; i < 32; ++i) {
        if (s == 0) {
            v[i] = 1U << (31 - i);
        } else if (i < s) {
            v[i] = m[i] << (31 - i);
        } else {
            v[i] = v[i - s] ^ (v[i - s] >> s);
            for (unsigned k = 1; k < s; ++k) {
                v[i] ^= ((a >> (s - 1 - k)) & 1U) * v[i - k];
            }
        }
    }
    return v;
}
constexpr std::array<Directions, 4> kDirections{make_directions(0, 0, {}), make_directions(1, 0, {1, 0, 0}),
                                                make_directions(2, 1, {1, 3, 0}), make_directions(3, 1, {1, 3, 1})};

// The same eight bits of the index at a time.
using Bytes = std::array<std::array<std::uint32_t, 256>, 4>;
constexpr Bytes by_bytes(const Directions& v) {
    Bytes out{};
    for (unsigned byte = 0; byte < 4; ++byte) {
        for (unsigned value = 0; value < 256; ++value) {
            for (unsigned i = 0; i < 8; ++i) {
                out[byte][value] ^= ((value >> i) & 1U) * v[8 * byte + i];
            }
        }
    }
    return out;
}
constexpr std::array<Bytes, 4> kBytes{by_bytes(kDirections[0]), by_bytes(kDirections[1]), by_bytes(kDirections[2]),
                                      by_bytes(kDirections[3])};

} // namespace

float sobol_owen(std::uint32_t index, unsigned dimension, std::uint32_t seed) {
    ATRIUM_CHECK(dimension < kBytes.size());
    const Bytes& table = kBytes[dimension];
    const std::uint32_t bits =
        table[0][index & 255U] ^ table[1][(index >> 8U) & 255U] ^ table[2][(index >> 16U) & 255U] ^ table[3][index >> 24U];
    const auto key = std::uint32_t(hash64(seed * 4ULL + dimension));
    return unit_float(reverse_bits(owen_scramble_reversed(reverse_bits(bits), key)));
}

} // namespace atrium
