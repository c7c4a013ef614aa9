// Random numbers of one sample of one pixel of a still.
#pragma once

#include "engine/base/rng.h"

namespace atrium {

/// Numbers in [0,1) in groups of four that belong together. Samples are numbered along a curve that fills the picture
/// (pixel_order()), so that neighbouring pixels share out the strata of one Owen-scrambled Sobol sequence: grain is fine
/// (blue), as eyes like it (Ahmed and Wonka 2020).
class PixelSampler {
public:
    PixelSampler(std::uint64_t key, std::uint64_t index) : key_(key), index_(index) {}

    /// Group `number`; the first few are stratified, later ones are hashed.
    [[nodiscard]] vec4 group(std::uint32_t number) const {
        const std::uint64_t key = hash_combine(key_ + (index_ >> 32), number);
        const auto low = std::uint32_t(index_);
        if (number < kStratified) {
            // One order for each group: with one for all they would agree in their leading bits (Burley 2020).
            const std::uint32_t shuffled = reverse_bits(owen_scramble_reversed(reverse_bits(low), std::uint32_t(key >> 32)));
            const auto seed = std::uint32_t(key);
            return {sobol_owen(shuffled, 0, seed), sobol_owen(shuffled, 1, seed), sobol_owen(shuffled, 2, seed),
                    sobol_owen(shuffled, 3, seed)};
        }
        const std::uint64_t a = hash64(key ^ hash64(low));
        const std::uint64_t b = hash64(a);
        return {unit_float(std::uint32_t(a >> 32)), unit_float(std::uint32_t(a)), unit_float(std::uint32_t(b >> 32)),
                unit_float(std::uint32_t(b))};
    }
    /// One number that needs no strata.
    [[nodiscard]] std::uint64_t hash(std::uint64_t number) const { return hash64(hash_combine(key_ ^ number, index_)); }

private:
    static constexpr std::uint32_t kStratified = 8;
    std::uint64_t key_;
    std::uint64_t index_;
};

/// Place of a pixel on a curve that fills the picture square by square (Morton order).
inline std::uint64_t pixel_order(std::uint32_t x, std::uint32_t y) {
    const auto spread = [](std::uint64_t v) {
        v = (v | (v << 16)) & 0x0000FFFF0000FFFFULL;
        v = (v | (v << 8)) & 0x00FF00FF00FF00FFULL;
        v = (v | (v << 4)) & 0x0F0F0F0F0F0F0F0FULL;
        v = (v | (v << 2)) & 0x3333333333333333ULL;
        v = (v | (v << 1)) & 0x5555555555555555ULL;
        return v;
    };
    return spread(x) | (spread(y) << 1);
}

} // namespace atrium
