// The part of a hierarchy that shines, as those read it who gather its light by name: nothing dark, bounds of what shines
// alone, and where to it can shine.
#pragma once

#include "engine/radiosity/hierarchy.h"

#include <span>
#include <vector>

namespace atrium {

/// A branch. Lengths in metres.
struct GatherNode {
    std::uint32_t element = 0; ///< of the hierarchy
    std::uint32_t first_child = 0;
    std::uint32_t child_count = 0; ///< that shine; 0 on leaves
    float largest = 0.0F;          ///< radius of the largest leaf below
    vec3 centre{0.0F};             ///< of a ball about all that shines below
    float radius = 0.0F;
    vec3 axis{0.0F};     ///< the normals below lie in a cone about it, unit
    float cosine = 1.0F; ///< of that cone's half angle; -1 where normals point anywhere
    float sine = 0.0F;

    /// Nothing of it faces a point. May be false though nothing does.
    [[nodiscard]] bool turns_away_from(const vec3& point) const;
    /// Some leaf may be nearer to a point than so many of its own radii; never false where one is.
    [[nodiscard]] bool may_be_near(const vec3& point, float radii) const;
};

/// Made from a hierarchy as it shines then. Branches with one child that shines are left out: the child stands for them.
/// Children come after their parents. Immutable; O(n) of elements and faces.
class GatherTree {
public:
    explicit GatherTree(const Hierarchy& hierarchy);
    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    [[nodiscard]] const GatherNode& root() const { return nodes_.front(); }
    [[nodiscard]] std::span<const GatherNode> children(const GatherNode& node) const {
        return std::span(nodes_).subspan(node.first_child, node.child_count);
    }
    [[nodiscard]] std::size_t size() const { return nodes_.size(); }

private:
    std::vector<GatherNode> nodes_;
};

} // namespace atrium
