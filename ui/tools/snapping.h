// What drags snap to, and the faces of bounds that they may meet. Pure.
#pragma once

#include "engine/base/math.h"

#include <array>
#include <optional>
#include <span>

namespace atrium::ui {

/// The user's choice; Ctrl during a drag turns `on` round.
struct Snapping {
    bool on = false;
    double grid = 0.1;            ///< metres
    double angle = kPiD / 12;     ///< radians
    double factor = 0.1;          ///< of a scale
    bool on_surfaces = false;     ///< an object that is dragged by itself goes on what is under the cursor
    bool turn_to_surface = false; ///< and turns with it
    bool own_axes = false;        ///< handles stand along the object's own axes, not the world's
    friend bool operator==(const Snapping&, const Snapping&) = default;
};

/// A face of another object's bounds that a moving box meets along one axis.
struct FaceSnap {
    double shift = 0; ///< metres to add to the box along the axis
    double plane = 0; ///< world coordinate of the face
    DBox3 other;      ///< whose face it is
};

/// For each axis the nearest face within `reach` metres of a face of `moving`, among boxes that are not further than `near`
/// metres away from it; none where there is none. The earlier box wins between equals.
std::array<std::optional<FaceSnap>, 3> snap_to_faces(const DBox3& moving, std::span<const DBox3> others, double reach,
                                                     double near);

} // namespace atrium::ui
