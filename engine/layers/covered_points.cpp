#include "engine/layers/covered_points.h"

namespace atrium {

bool is_covered(const RayScene& rays, const vec3& point, const vec3& normal, float reach) {
    vec3 t;
    vec3 b;
    make_frame(normal, t, b);
    for (int i = 0; i < 9; ++i) { // straight out first: in the open one ray is enough
        const float angle = 2.0F * kPi * float(i) / 8.0F;
        const vec3 d = i == 0 ? normal : glm::normalize(0.35F * normal + std::cos(angle) * t + std::sin(angle) * b);
        // Where the way is free beyond the reach, one ray tells both that and where it ends.
        const Hit hit = rays.nearest({point + normal * (0.01F * reach), d});
        if (hit && hit.t <= reach && rays.occluded(point, point + d * reach)) {
            continue;
        }
        if (!hit || hit.front || rays.surfaces()[hit.surface].back_side || rays.material(hit.surface).transmission > 0.0F) {
            return false;
        }
    }
    return true;
}

} // namespace atrium
