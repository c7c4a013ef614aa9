#include "engine/geometry/primitives.h"

namespace atrium {

Box3 local_bounds(const Geometry& geometry) {
    Box3 box;
    const auto symmetric = [&](const vec3& half) {
        box.add(-half);
        box.add(half);
    };
    std::visit(
        [&](const auto& g) {
            using G = std::decay_t<decltype(g)>;
            if constexpr (std::is_same_v<G, Polygon>) {
                for (const vec2& p : g.outer) {
                    box.add(vec3(p, 0.0F));
                }
            } else if constexpr (std::is_same_v<G, Box>) {
                symmetric(g.size * 0.5F);
            } else if constexpr (std::is_same_v<G, Sphere>) {
                symmetric(vec3(g.radius));
            } else if constexpr (std::is_same_v<G, Cylinder>) {
                symmetric(vec3(g.radius, g.height * 0.5F, g.radius));
            } else if constexpr (std::is_same_v<G, Cone>) {
                const float r = std::fmax(g.base_radius, g.top_radius);
                symmetric(vec3(r, g.height * 0.5F, r));
            } else if constexpr (std::is_same_v<G, Disc>) {
                symmetric(vec3(g.radius, g.radius, 0.0F));
            } else {
                for (const vec3& p : g.data->positions) {
                    if (is_finite(p)) { // a stray NaN must not take the whole scene's bounds with it
                        box.add(p);
                    }
                }
            }
        },
        geometry);
    return box;
}

} // namespace atrium
