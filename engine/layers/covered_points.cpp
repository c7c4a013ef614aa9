#include "engine/layers/covered_points.h"

#include <algorithm>
#include <array>

namespace atrium {
namespace {

// Opaque, and dark behind: where such a surface is met from its back, one is behind it.
bool is_unlit_back(const RayScene& rays, const Hit& hit) {
    return hit && !hit.front && !rays.surfaces()[hit.surface].back_side && !(rays.material(hit.surface).transmission > 0.0F);
}

} // namespace

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
        if (!is_unlit_back(rays, hit)) {
            return false;
        }
    }
    return true;
}

bool is_cut_off(const RayScene& rays, const vec3& point, const vec3& normal, float reach) {
    vec3 t;
    vec3 b;
    make_frame(normal, t, b);
    const std::array<vec3, 4> ways{t, -t, b, -b};
    return std::any_of(ways.begin(), ways.end(), [&](const vec3& d) {
        return is_unlit_back(rays, rays.nearest({point + normal * (0.01F * reach), d, 0.5F * reach}));
    });
}

} // namespace atrium
