// A room whose light follows what is done to a box in it, and its light on the floor.
#pragma once

#include "engine/base/rng.h"
#include "tests/support/light_cases.h"
#include "tests/support/rooms.h"

namespace atrium::test {

/// A room with a lamp under its ceiling, a point light and a box that stands on the floor.
struct FollowedRoom {
    Scene scene;
    NodeId box, lamp, point;
    GiEngine engine;
    SolveOptions options;

    explicit FollowedRoom(float rho = 0.7F) {
        add_room(scene, 4, 3, 4, add_material(scene, rho));
        box = add_shape(scene, "box", Box{vec3(0.4F, 0.8F, 0.4F)}, {1.2, 0.41, 1.2}, add_material(scene, 0.7F * rho));
        lamp = add_rectangle(scene, "panel", {2, 2.9, 2}, {0, -1, 0}, {1, 0, 0}, 0.4F, 0.4F,
                             add_material(scene, 0.5F, 20000.0F));
        point = add_point_light(scene, {0.6, 2.4, 0.6}, 1500.0);
        options.quality = SolverSettings::Quality::Draft;
        options.keep_for_updates = true;
    }
    void move(const dvec3& by) { scene.nodes.find(box)->transform.translation += by; }
    std::shared_ptr<const Solution> solve() {
        auto r = engine.solve(scene, options, {});
        return r ? *r : nullptr;
    }
    [[nodiscard]] std::vector<double> floor_light(const Solution& solution) const {
        std::vector<SensorPlace> places;
        const dvec3 stands = scene.nodes.find(box)->transform.translation;
        for (std::uint32_t i = 0; i < 2000; ++i) {
            const vec2 u = sobol_owen2(i, 0, 5U);
            const dvec3 p(0.1 + 3.8 * u.x, 0.0, 0.1 + 3.8 * u.y);
            const bool hidden = std::abs(p.x - stands.x) < 0.22 && std::abs(p.z - stands.z) < 0.22; // nobody sees it there
            places.push_back({hidden ? dvec3(0.1, 0.0, 0.1) : p, {0, 1, 0}});
        }
        std::vector<double> out;
        for (const SensorReading& r : read_surfaces(scene, solution, places)) {
            out.push_back(r.on_surface ? luminance(r.irradiance) : 0.0);
        }
        return out;
    }
};

inline std::vector<SensorPlace> places_on_floor() {
    std::vector<SensorPlace> out;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const vec2 u = sobol_owen2(i, 0, 5U);
        out.push_back({{0.1 + 3.8 * u.x, 0.0, 0.1 + 3.8 * u.y}, {0, 1, 0}});
    }
    return out;
}

inline double relative_rms(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += (a[i] - b[i]) * (a[i] - b[i]);
        mean += b[i];
    }
    return std::sqrt(sum / double(a.size())) / (mean / double(a.size()));
}

} // namespace atrium::test
