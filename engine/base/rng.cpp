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

} // namespace

float sobol_owen(std::uint32_t index, unsigned dimension, std::uint32_t seed) {
    ATRIUM_CHECK(dimension < kDirections.size());
    std::uint32_t bits = 0;
    for (unsigned i = 0; index != 0; ++i, index >>= 1) {
        bits ^= (index & 1U) * kDirections[dimension][i];
    }
    const auto key = std::uint32_t(hash64(seed * 4ULL + dimension));
    return unit_float(reverse_bits(owen_scramble_reversed(reverse_bits(bits), key)));
}

} // namespace atrium
