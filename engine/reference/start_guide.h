// Where particles that come to something useful started: what a first look found steers those that follow.
#pragma once

#include "engine/base/math.h"

#include <span>
#include <vector>

namespace atrium {

/// A density over the four numbers that a particle starts from, constant on boxes of the unit cube, learnt from particles
/// that were traced before. Some of it is spread evenly, so whatever can happen still does and every estimate stays
/// unbiased. (Importance by a tree over the space of random numbers: Guo, Bauszat, Bikker & Eisemann 2018.)
class StartGuide {
public:
    /// A start that was tried, and what came of it.
    struct Trial {
        dvec4 at{0.0};        ///< the numbers it started from
        float density = 1.0F; ///< with which they were drawn
        float use = 0.0F;     ///< flux that landed, any unit
    };
    struct Start {
        dvec4 at{0.0};
        float density = 1.0F; ///< of `at`; the mean over the cube is 1
    };

    /// Even: every start is as likely as any other.
    StartGuide() = default;
    /// Learns from trials, in their order; even where none was of use.
    explicit StartGuide(std::span<const Trial> trials);

    /// The start for four numbers that are spread evenly over [0, 1).
    [[nodiscard]] Start operator()(dvec4 u) const;

private:
    struct Node {
        double at = 0.0;         ///< where the box is cut, of the axis
        double low_share = 0.5;  ///< probability of the lower part
        std::uint32_t first = 0; ///< index of the lower part, followed by the upper; 0 = not cut
        std::uint8_t axis = 0;
    };
    void divide(std::uint32_t node, std::span<Trial> trials, dvec4 low, dvec4 high, int depth);

    std::vector<Node> nodes_;
};

} // namespace atrium
