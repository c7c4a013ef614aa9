// Numbers for points that are the same to the last bit and for copies of vertices: flat tables, for meshes of millions.
#pragma once

#include "engine/base/math.h"
#include "engine/base/rng.h"

#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace atrium {

/// Numbers keys in the order in which they first come. `Hash` makes 64 well mixed bits of a key.
template <class Key, class Hash> class KeyTable {
public:
    /// Room for `most` keys; more are taken too.
    explicit KeyTable(std::size_t most) : slots_(std::bit_ceil(2 * most + 16), kNone) { keys_.reserve(most); }

    /// Number of a key and whether it is a new one, which then has the next number.
    std::pair<std::uint32_t, bool> insert(const Key& key) {
        std::size_t slot = start(key);
        for (; slots_[slot] != kNone; slot = (slot + 1) & (slots_.size() - 1)) {
            if (keys_[slots_[slot]] == key) {
                return {slots_[slot], false};
            }
        }
        const auto number = std::uint32_t(keys_.size());
        slots_[slot] = number;
        keys_.push_back(key);
        if (2 * keys_.size() > slots_.size()) {
            grow();
        }
        return {number, true};
    }
    [[nodiscard]] std::size_t size() const { return keys_.size(); }

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    [[nodiscard]] std::size_t start(const Key& key) const { return std::size_t(Hash{}(key)) & (slots_.size() - 1); }
    void grow() {
        slots_.assign(2 * slots_.size(), kNone);
        for (std::uint32_t i = 0; i < keys_.size(); ++i) {
            std::size_t slot = start(keys_[i]);
            while (slots_[slot] != kNone) {
                slot = (slot + 1) & (slots_.size() - 1);
            }
            slots_[slot] = i;
        }
    }

    std::vector<std::uint32_t> slots_;
    std::vector<Key> keys_;
};

/// For points without -0, which would be another one than 0.
struct PointHash {
    std::uint64_t operator()(const vec3& p) const {
        const auto bits = [](float x) { return std::uint64_t(std::bit_cast<std::uint32_t>(x)); };
        return hash_combine(hash64(bits(p.x) | bits(p.y) << 32U), bits(p.z));
    }
};
using PointTable = KeyTable<vec3, PointHash>;

/// A copy of a vertex: its number and what else tells it from others.
using CopyKey = std::array<std::uint32_t, 5>;
struct CopyHash {
    std::uint64_t operator()(const CopyKey& key) const {
        std::uint64_t h = key[4];
        for (std::size_t i = 0; i < 4; i += 2) {
            h = hash_combine(h, key[i] | std::uint64_t(key[i + 1]) << 32U);
        }
        return h;
    }
};
using CopyTable = KeyTable<CopyKey, CopyHash>;

} // namespace atrium
