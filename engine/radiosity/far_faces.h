// Groups of many small faces as seen from far away: by direction, instead of face by face.
#pragma once

#include "engine/radiosity/hierarchy.h"

#include <vector>

namespace atrium {

/// What the largest groups of faces that shine show towards all directions: their visible area and where its middle is.
/// Immutable; safe from any thread.
class FarFaces {
public:
    FarFaces(const Hierarchy& hierarchy, const RayScene& rays);

    /// Form factor of a group's faces, unobstructed. Negative where it is not known: for other elements, from close by, and
    /// where the horizon may cut them.
    [[nodiscard]] float factor(const Hierarchy& hierarchy, std::uint32_t element, const SurfacePoint& from) const;

private:
    std::vector<std::uint32_t> groups_; ///< elements, ascending
    /// Of each group by direction: what would be seen of it at its centre's distance, as (area times place from its centre,
    /// area); from the least distance and from infinity.
    struct View {
        vec4 least{0.0F}, infinity{0.0F};
    };
    std::vector<View> views_;
};

} // namespace atrium
