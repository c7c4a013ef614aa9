#include "ui/tools/snapping.h"

namespace atrium::ui {

std::array<std::optional<FaceSnap>, 3> snap_to_faces(const DBox3& moving, std::span<const DBox3> others, double reach,
                                                     double near) {
    std::array<std::optional<FaceSnap>, 3> out;
    if (moving.empty()) {
        return out;
    }
    for (const DBox3& other : others) {
        const dvec3 gap = glm::max(other.min - moving.max, moving.min - other.max);
        for (int axis = 0; axis < 3; ++axis) {
            const int a = (axis + 1) % 3;
            const int b = (axis + 2) % 3;
            if (gap[a] > near || gap[b] > near) {
                continue;
            }
            for (const double mine : {moving.min[axis], moving.max[axis]}) {
                for (const double face : {other.min[axis], other.max[axis]}) {
                    const double shift = face - mine;
                    auto& best = out[std::size_t(axis)];
                    if (std::abs(shift) <= reach && (!best || std::abs(shift) < std::abs(best->shift))) {
                        best = FaceSnap{shift, face, other};
                    }
                }
            }
        }
    }
    return out;
}

} // namespace atrium::ui
