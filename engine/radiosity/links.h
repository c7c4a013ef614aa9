// Links: light transfer between any two elements. Symmetric, made by refinement from the root pair.
#pragma once

#include "engine/base/run_context.h"
#include "engine/radiosity/hierarchy.h"

#include <cstdint>
#include <vector>

namespace atrium {

/// Transfer between elements a and b, valid both ways. Between two patches `weight` = A_a F_ab (square metres); where a
/// cluster or faces take part it is V / (pi r^2) (per square metre), to be multiplied by both projected areas.
struct Link {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    float weight = 0.0F;
};

/// How far refinement goes.
struct RefineSettings {
    float flux_threshold = 1e-4F; ///< share of the flux sent out in a room below which a transfer's error is let be
    unsigned rays = 8; ///< visibility rays of an ordinary link, up to four times as many for strong ones; 0: no weights
    std::size_t max_links = 20'000'000; ///< memory budget: when reached, the weaker transfers stay on higher links
};

/// All links of a hierarchy. refine() may be called again after a solution to look closer where light now flows.
class LinkSet {
public:
    /// Starts from the root pair.
    explicit LinkSet(const Hierarchy& hierarchy);

    /// Splits links whose transfer is uncertain by more than the threshold, given present radiosities (elements and links
    /// change), the most uncertain first, then finds the weights of new links with visibility rays. Where the hierarchy
    /// knows several rooms with light of their own (Hierarchy::room), each is refined by its own flux: a cellar lamp is
    /// not lost beside the sun. Returns the number of links made; stops early when the context says so (links stay
    /// complete: every pair of leaves is covered once).
    std::size_t refine(Hierarchy& hierarchy, const RayScene& rays, const RefineSettings& settings,
                       const RunContext& context);

    [[nodiscard]] const std::vector<Link>& links() const { return links_; }
    /// The last refine() left transfers on higher links for want of budget.
    [[nodiscard]] bool budget_reached() const { return budget_reached_; }
    [[nodiscard]] std::size_t memory_bytes() const { return links_.capacity() * sizeof(Link); }

private:
    std::vector<Link> links_;
    bool budget_reached_ = false;
    std::vector<std::uint32_t> self_pairs_; ///< elements whose inner exchange has not been opened yet
};

/// Direction-dependent receiving or emitting area of an element towards unit direction d, square metres, not negative.
float projected_area(const Hierarchy& hierarchy, const Element& element, const vec3& d);

} // namespace atrium
