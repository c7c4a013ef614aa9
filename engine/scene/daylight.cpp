#include "engine/scene/daylight.h"

namespace atrium {

bool has_no_light(const Scene& scene) {
    if (max_component(scene.environment.sky_radiance) > 0.0F) {
        return false;
    }
    for (const NodeId id : scene.in_tree_order()) {
        const Node& node = *scene.nodes.find(id);
        if (!scene.shown(id)) {
            continue;
        }
        const Light* light = scene.lights.find(node.light);
        if (light != nullptr && light->enabled && light->intensity > 0.0F && max_component(light->color) > 0.0F) {
            return false;
        }
        const Shape* shape = scene.shapes.find(node.shape);
        for (std::size_t part = 0; shape != nullptr && part < part_count(*shape); ++part) {
            const Material* material = scene.material_of(node, part);
            if (material != nullptr && material->emits()) {
                return false;
            }
        }
    }
    return true;
}

SceneEdit add_daylight(const Scene& scene) {
    Light sun;
    sun.name = "Sun";
    sun.kind = Light::Kind::Directional;
    sun.color = Rgb(1.0F, 0.94F, 0.84F);
    sun.intensity = 40000.0F;
    Node node;
    node.name = "Sun";
    node.light = scene.lights.next_key();
    // Shines along -z: 30 degrees down, 40 degrees round from the z axis, so that two sides of a house are lit.
    node.transform.rotation = glm::normalize(glm::angleAxis(radians_from_degrees(40.0), dvec3(0.0, 1.0, 0.0)) *
                                             glm::angleAxis(radians_from_degrees(-30.0), dvec3(1.0, 0.0, 0.0)));
    const DBox3 box = scene.bounds();
    if (!box.empty()) { // a place where its symbol is found: above the scene
        node.transform.translation = dvec3(box.centre().x, box.max.y + 0.2 * box.diagonal(), box.centre().z);
    }
    EditGroup group;
    group.edits.push_back({AddResource<Light>{node.light, sun}});
    group.edits.push_back({AddNode{scene.nodes.next_key(), node}});
    group.edits.push_back({SetEnvironment{Environment{Rgb(2700.0F, 3000.0F, 3400.0F)}}});
    return {group};
}

} // namespace atrium
