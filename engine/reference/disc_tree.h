// Which of many small discs a straight stretch crosses.
#pragma once

#include "engine/base/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace atrium {

/// A small disc that counts the particles that cross it from its front.
struct CausticDisc {
    vec3 centre{0.0F};
    vec3 normal{0.0F}; ///< unit
};

/// A tree of boxes about discs of one radius (metres). Immutable; safe from any thread.
class DiscTree {
public:
    DiscTree(std::span<const CausticDisc> discs, float radius);

    /// Puts the indices of the discs that the stretch of `length` (metres, may be infinite) crosses from their fronts into
    /// `out`, which it clears first, in no order.
    void crossed(const vec3& from, const vec3& direction, float length, std::vector<std::uint32_t>& out) const;
    [[nodiscard]] std::span<const CausticDisc> discs() const { return discs_; }
    [[nodiscard]] float radius() const { return radius_; }

private:
    struct Node {
        Box3 box;
        std::uint32_t begin = 0; ///< of order_; with `end` the discs of a leaf
        std::uint32_t end = 0;
        std::uint32_t second = 0; ///< the other half; the first follows the node. 0 = leaf
    };
    void divide(std::uint32_t begin, std::uint32_t end);

    std::vector<CausticDisc> discs_;
    float radius_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace atrium
