// Scenes whose caustics are measured: one receiver in the plane y = 0 each, under a ring, a ball, a mirror, a lamp.
#pragma once

#include "engine/layers/caustic_layer.h"
#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace atrium::bench {

struct CausticScene {
    std::string name;
    Scene scene;
    std::uint32_t receiver = 0; ///< ray surface: a square floor, its first node
    vec2 corner{0.0F};          ///< x, z of the square that is compared, world
    float size = 1.0F;          ///< of that square, metres

    [[nodiscard]] bool on_receiver(const RayScene&, const Landing& l) const { return l.surface == receiver && !l.back; }
    /// Place of a landing in the square, [0,1]^2 within it.
    [[nodiscard]] vec2 place(const RayScene& rays, const Landing& l) const;
    /// Chart-space coordinates of a place in the square.
    [[nodiscard]] vec2 chart_position(const SurfaceCharts& charts, const vec2& place) const;
    /// The tree of shining leaves, where the light is a surface; else empty.
    [[nodiscard]] Hierarchy emitters(const RayScene& rays) const;
    dvec3 origin{0.0}; ///< RayScene::origin() of the scene
};
std::vector<CausticScene> caustic_scenes();

} // namespace atrium::bench
