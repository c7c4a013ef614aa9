// Scenes with caustics in which something moves, and what tracing needs of them.
#pragma once

#include "engine/particles/particle_map.h"
#include "engine/raycast/scene_charts.h"
#include "tests/support/rooms.h"

#include <memory>

namespace atrium::test {

inline MaterialId add_specular(Scene& scene, bool glass, float roughness = 0.0F) {
    Material m;
    m.base_color = Rgb(glass ? 1.0F : 0.9F);
    m.metallic = glass ? 0.0F : 1.0F;
    m.roughness = roughness;
    m.transmission = glass ? 1.0F : 0.0F;
    m.thickness = glass ? 1.0F : 0.0F;
    m.ior = 1.5F;
    return scene.materials.insert(m);
}

inline NodeId add_shape(Scene& scene, const Geometry& geometry, const dvec3& at, MaterialId material) {
    Shape shape;
    shape.geometry = geometry;
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = {material};
    node.transform.translation = at;
    scene.roots.push_back(scene.nodes.insert(node));
    return scene.roots.back();
}

inline NodeId add_sun(Scene& scene, const dvec3& direction, float lux) {
    Light light;
    light.kind = Light::Kind::Directional;
    light.intensity = lux;
    Node node;
    node.light = scene.lights.insert(light);
    const dvec3 z = -glm::normalize(direction);
    const dvec3 x = glm::normalize(glm::cross(dvec3(0.1, 1, 0.2), z));
    node.transform.rotation = glm::normalize(glm::quat_cast(dmat3(x, glm::cross(z, x), z)));
    scene.roots.push_back(scene.nodes.insert(node));
    return scene.roots.back();
}

/// An open stage: floor and back wall, two mirrors, a ball of glass, a rough metal ball, sun, lamp, a shining ball and a
/// small box to move.
struct Stage {
    Scene scene;
    NodeId box, ball, lamp, shining;
};
inline Stage stage() {
    Stage s;
    Scene& scene = s.scene;
    const MaterialId matt = add_material(scene, 0.6F);
    add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 6.0F, 6.0F, matt);
    add_rectangle(scene, "wall", {0, 1.5, -3}, {0, 0, 1}, {1, 0, 0}, 6.0F, 3.0F, matt);
    add_rectangle(scene, "mirror", {1.5, 1.0, 0.3}, glm::normalize(dvec3(-1, -0.1, 0)), {0, 0, 1}, 0.8F, 0.8F,
                  add_specular(scene, false));
    add_rectangle(scene, "to the wall", {-2.0, 1.2, -1.5}, glm::normalize(dvec3(-0.41, 0.6, -0.81)),
                  glm::normalize(dvec3(0.81, 0, -0.41)), 0.3F, 0.3F, add_specular(scene, false));
    s.ball = add_shape(scene, Sphere{0.3F}, {-0.6, 0.5, -0.5}, add_specular(scene, true));
    add_shape(scene, Sphere{0.2F}, {0.2, 0.4, -1.5}, add_specular(scene, false, 0.2F));
    s.box = add_shape(scene, Box{{0.2F, 0.2F, 0.2F}}, {0.0, 0.3, 0.0}, matt);
    s.shining = add_shape(scene, Sphere{0.05F}, {-1.2, 1.4, 0.6}, add_material(scene, 0.0F, 1e5F));
    s.lamp = add_point_light(scene, {0.3, 1.8, 1.0}, 2000.0);
    add_sun(scene, {1, -1, -0.2}, 1e5F);
    return s;
}

/// A scene ready for particles.
struct Staged {
    explicit Staged(const Scene& scene) : rays(scene), targets(rays), direct(scene, rays), emitters(shining_leaves(rays)) {}
    static Hierarchy shining_leaves(const RayScene& rays) {
        HierarchySettings settings;
        settings.smallest_patch = 0.1F;
        settings.group_size = 0.05F;
        return build_hierarchy(rays, settings);
    }
    [[nodiscard]] ParticleScene particle_scene() const { return {rays, targets, direct, emitters, {}}; }
    RayScene rays;
    SpecularTargets targets;
    DirectLight direct;
    Hierarchy emitters;
};

/// Surfaces whose vertices differ, and their bounds before and after.
struct Moved {
    Moved(const RayScene& before, const RayScene& after) {
        for (std::uint32_t s = 0; s < before.surfaces().size(); ++s) {
            if (*before.surfaces()[s].positions != *after.surfaces()[s].positions) {
                surfaces.push_back(s);
                for (const RayScene* rays : {&before, &after}) {
                    Box3 box;
                    for (const vec3& p : *rays->surfaces()[s].positions) {
                        box.add(p);
                    }
                    boxes.push_back(box);
                }
            }
        }
    }
    std::vector<std::uint32_t> surfaces;
    std::vector<Box3> boxes;
};

} // namespace atrium::test
