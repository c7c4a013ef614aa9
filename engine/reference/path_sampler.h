// Random numbers of one path: well stratified for its first bounces, hashed after them.
#pragma once

#include "engine/base/rng.h"

namespace atrium {

/// Numbers in [0,1) of path `index` of a stream. Paths of one stream are stratified against each other in their first
/// kStratifiedGroups groups of four; streams with different keys are independent.
class PathSampler {
public:
    PathSampler(std::uint64_t key, std::uint32_t index) : key_(key), index_(index) {}

    /// Four numbers that belong together. Each group is an Owen-scrambled Sobol sequence of its own order: with one order
    /// for all, groups would agree in their leading bits and never fill the product space (Burley 2020).
    vec4 next4() {
        const std::uint64_t key = hash_combine(key_, group_);
        if (group_++ < kStratifiedGroups) {
            const std::uint32_t shuffled =
                reverse_bits(owen_scramble_reversed(reverse_bits(index_), std::uint32_t(key >> 32)));
            const auto seed = std::uint32_t(key);
            return {sobol_owen(shuffled, 0, seed), sobol_owen(shuffled, 1, seed), sobol_owen(shuffled, 2, seed),
                    sobol_owen(shuffled, 3, seed)};
        }
        const std::uint64_t a = hash64(key ^ hash64(index_));
        const std::uint64_t b = hash64(a);
        return {unit_float(std::uint32_t(a >> 32)), unit_float(std::uint32_t(a)), unit_float(std::uint32_t(b >> 32)),
                unit_float(std::uint32_t(b))};
    }

    /// One number for a choice that needs no strata.
    float next1() { return unit_float(std::uint32_t(hash64(hash_combine(key_ + 0x51ED27ULL, index_) + single_++) >> 32)); }

private:
    static constexpr std::uint32_t kStratifiedGroups = 5;
    std::uint64_t key_;
    std::uint32_t index_;
    std::uint32_t group_ = 0;
    std::uint32_t single_ = 0;
};

} // namespace atrium
