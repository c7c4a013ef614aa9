// What is left out of the picture so that one looks into a room from outside: walls and ceiling between the eye and the
// room.
#pragma once

#include "engine/base/math.h"
#include "engine/scene/scene.h"

namespace atrium::ui {

/// True for bounds that a person can stand in: a room or a house rather than a piece of furniture.
bool is_room(const DBox3& bounds);

/// Value; any thread. Inside the room, or where there is none, it hides nothing.
class Cutaway {
public:
    Cutaway() = default;
    /// `room`: bounds of what is shown, world metres.
    Cutaway(const DBox3& room, const dvec3& eye);

    [[nodiscard]] bool active() const { return side_ != dvec3(0.0); }
    /// Per axis -1 or 1 where the eye is beyond that side of the room, else 0.
    [[nodiscard]] const dvec3& side() const { return side_; }
    /// Inner face of the layer that is cut off, per axis; of no meaning where side() is 0.
    [[nodiscard]] const dvec3& plane() const { return plane_; }

    enum class Part : std::uint8_t { None, Some, All };
    /// What of a surface with these world bounds is hidden. Some: ask hides() point by point.
    [[nodiscard]] Part part_of(const DBox3& bounds) const;
    /// A point of a surface for which part_of() says Some; the normal is unit, of either sense.
    [[nodiscard]] bool hides(const dvec3& point, const dvec3& normal) const;

    /// A surface this steep to an axis is not a wall on that side.
    static constexpr double kFacing = 0.7;

private:
    DBox3 room_;
    dvec3 side_{0.0};
    dvec3 plane_{0.0};
};

} // namespace atrium::ui
