#include "ui/document/placement.h"

namespace atrium::ui {
namespace {

constexpr double kSteep = 0.9; ///< |normal.y| from which a surface counts as floor or ceiling

} // namespace

dquat turn_to_face(const dvec3& normal) {
    dmat3 axes(1.0);
    axes[1] = normal;
    if (std::abs(normal.y) < kSteep) {
        const dvec3 up(0, 1, 0);
        axes[2] = -glm::normalize(up - normal * normal.y);
        axes[0] = glm::cross(axes[1], axes[2]);
    } else {
        axes[0] = glm::normalize(dvec3(1, 0, 0) - normal * normal.x);
        axes[2] = glm::cross(axes[0], axes[1]);
    }
    return glm::normalize(glm::quat_cast(axes));
}

dvec3 shift_to_rest(const DBox3& box, const dvec3& point, const dvec3& normal) {
    const dvec3 half = 0.5 * (box.max - box.min);
    const double reach = glm::dot(half, glm::abs(normal));
    return point + normal * reach - box.centre();
}

dmat4 place_on(const DBox3& bounds, Mount mount, const dvec3& point, const dvec3& normal) {
    dmat4 out(1.0);
    if (mount == Mount::Stand) {
        const dvec3 shift = bounds.empty() ? point : shift_to_rest(bounds, point, normal);
        out[3] = dvec4(shift, 1.0);
        return out;
    }
    out = glm::mat4_cast(turn_to_face(normal));
    const double below = bounds.empty() ? 0.0 : -bounds.min.y;
    out[3] = dvec4(point + normal * below, 1.0);
    return out;
}

} // namespace atrium::ui
