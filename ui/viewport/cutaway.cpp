#include "ui/viewport/cutaway.h"

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr double kLowestRoom = 2.0; ///< metres
constexpr double kNarrowestRoom = 1.5;

/// Walls lie within this of the room's bounds, in metres and as a share of its size.
constexpr double kDepth = 0.5;
constexpr double kDepthShare = 0.15;

/// What lies in that layer goes with the wall when it is thin (a window, a picture) or extends over much of the room.
constexpr double kThin = 0.15;
constexpr double kWallShare = 0.4;

} // namespace

bool is_room(const DBox3& bounds) {
    const dvec3 size = bounds.empty() ? dvec3(0.0) : bounds.size();
    return size.y >= kLowestRoom && std::min(size.x, size.z) >= kNarrowestRoom;
}

Cutaway::Cutaway(const DBox3& room, const dvec3& eye) : room_(room) {
    if (!is_room(room)) {
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double depth = std::min(kDepth, kDepthShare * room.size()[axis]);
        if (eye[axis] > room.max[axis]) {
            side_[axis] = 1.0;
            plane_[axis] = room.max[axis] - depth;
        } else if (eye[axis] < room.min[axis]) {
            side_[axis] = -1.0;
            plane_[axis] = room.min[axis] + depth;
        }
    }
}

Cutaway::Part Cutaway::part_of(const DBox3& bounds) const {
    if (!active() || bounds.empty()) {
        return Part::None;
    }
    Part part = Part::None;
    const dvec3 size = bounds.size();
    for (int axis = 0; axis < 3; ++axis) {
        if (side_[axis] == 0.0) {
            continue;
        }
        const double inner = side_[axis] > 0 ? bounds.min[axis] - plane_[axis] : plane_[axis] - bounds.max[axis];
        const double outer = side_[axis] > 0 ? bounds.max[axis] - plane_[axis] : plane_[axis] - bounds.min[axis];
        const bool wide = [&] {
            for (int other = 0; other < 3; ++other) {
                if (other != axis && size[other] >= kWallShare * room_.size()[other]) {
                    return true;
                }
            }
            return false;
        }();
        if (inner > 0.0 && (wide || size[axis] <= kThin)) {
            return Part::All;
        }
        if (outer > 0.0 && wide) {
            part = Part::Some;
        }
    }
    return part;
}

bool Cutaway::hides(const dvec3& point, const dvec3& normal) const {
    for (int axis = 0; axis < 3; ++axis) {
        if (side_[axis] * (point[axis] - plane_[axis]) > 0.0 && std::abs(normal[axis]) > kFacing) {
            return true;
        }
    }
    return false;
}

} // namespace atrium::ui
