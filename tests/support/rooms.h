// Scenes for tests, built from primitives: rooms of rectangles that face inwards, lamps, sensors.
#pragma once

#include "engine/scene/scene.h"
#include "engine/solver/gi_engine.h"
#include "tests/support/light_maps.h"

#include <array>

namespace atrium::test {

/// Adds a material that reflects rho (same in all channels) and emits exitance M (lumen per square metre per channel).
inline MaterialId add_material(Scene& scene, float rho, float exitance = 0.0F) {
    Material m;
    m.name = "rho " + std::to_string(rho);
    m.base_color = Rgb(rho);
    m.emissive_color = Rgb(exitance > 0.0F ? 1.0F : 0.0F);
    m.emissive_strength = exitance * kInvPi;
    return scene.materials.insert(m);
}

/// Adds a w x h rectangle centred at `centre`, its front towards `normal`, its width along `u` (unit, at right angles).
inline NodeId add_rectangle(Scene& scene, const std::string& name, const dvec3& centre, const dvec3& normal, const dvec3& u,
                            float w, float h, MaterialId material) {
    Shape shape;
    shape.name = name;
    shape.geometry = Polygon{{{-w / 2, -h / 2}, {w / 2, -h / 2}, {w / 2, h / 2}, {-w / 2, h / 2}}, {}};
    Node node;
    node.name = name;
    node.shape = scene.shapes.insert(shape);
    node.materials = {material};
    node.transform.translation = centre;
    node.transform.rotation = glm::normalize(glm::quat_cast(dmat3(u, glm::cross(normal, u), normal)));
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

/// Room [0,x] x [0,height] x [0,z], +Y up, faces inwards; materials in the order floor, ceiling, x=0, x=max, z=0, z=max.
inline void add_room(Scene& scene, float x, float height, float z, const std::array<MaterialId, 6>& m) {
    const double cx = x / 2.0, cy = height / 2.0, cz = z / 2.0;
    add_rectangle(scene, "floor", {cx, 0, cz}, {0, 1, 0}, {1, 0, 0}, x, z, m[0]);
    add_rectangle(scene, "ceiling", {cx, height, cz}, {0, -1, 0}, {1, 0, 0}, x, z, m[1]);
    add_rectangle(scene, "wall x0", {0, cy, cz}, {1, 0, 0}, {0, 0, 1}, z, height, m[2]);
    add_rectangle(scene, "wall x1", {x, cy, cz}, {-1, 0, 0}, {0, 0, 1}, z, height, m[3]);
    add_rectangle(scene, "wall z0", {cx, cy, 0}, {0, 0, 1}, {1, 0, 0}, x, height, m[4]);
    add_rectangle(scene, "wall z1", {cx, cy, z}, {0, 0, -1}, {1, 0, 0}, x, height, m[5]);
}
inline void add_room(Scene& scene, float x, float height, float z, MaterialId m) {
    add_room(scene, x, height, z, {m, m, m, m, m, m});
}

/// Isotropic point light of a total flux in lumen.
inline NodeId add_point_light(Scene& scene, const dvec3& at, double lumen) {
    Light light;
    light.name = "lamp";
    light.intensity = float(lumen / (4.0 * kPiD));
    Node node;
    node.name = "lamp";
    node.light = scene.lights.insert(light);
    node.transform.translation = at;
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

/// Solves and returns the engine with its final solution.
struct Solved {
    GiEngine engine;
    std::shared_ptr<const Solution> solution;
};
inline Solved solve(const Scene& scene, SolverSettings::Quality quality = SolverSettings::Quality::Normal,
                    std::uint32_t seed = 1) {
    Solved out;
    SolveOptions options;
    options.quality = quality;
    options.seed = seed;
    auto result = out.engine.solve(scene, options, RunContext{});
    if (result) {
        out.solution = *result;
    }
    return out;
}

/// Area mean of the shown irradiance (luminance) over all surfaces, or over one node.
inline double mean_irradiance(const Scene& scene, const Solution& solution, NodeId only = {}) {
    double sum = 0.0;
    double area_sum = 0.0;
    for (const auto& layer : solution.surfaces) {
        if (only && layer->node != only) {
            continue;
        }
        const dmat4 world = scene.world_matrix(layer->node);
        const auto& mesh = *layer->mesh;
        for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
            std::array<dvec3, 3> p;
            double e = 0.0;
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = dvec3(world * dvec4(dvec3(mesh.positions[mesh.indices[t + k]]), 1.0));
            }
            // Light maps change within a triangle: the mean of a grid of points in it.
            constexpr int kGrid = 12;
            const std::array<std::uint32_t, 3> corner{mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
            for (int i = 0; i < kGrid; ++i) {
                for (int j = 0; j < kGrid; ++j) {
                    float u = (float(i) + 0.5F) / kGrid, v = (float(j) + 0.5F) / kGrid;
                    if (u + v > 1.0F) {
                        u = 1.0F - u;
                        v = 1.0F - v;
                    }
                    e += luminance(irradiance_at(*layer, corner, {1.0F - u - v, u, v}, false)) / (kGrid * kGrid);
                }
            }
            const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
            sum += e * area;
            area_sum += area;
        }
    }
    return area_sum > 0.0 ? sum / area_sum : 0.0;
}

} // namespace atrium::test
