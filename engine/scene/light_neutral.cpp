// Which edits need no new solution. When in doubt an edit counts as changing light: a needless solve costs seconds, a
// forgotten one shows a wrong picture.
#include "engine/scene/scene_edit.h"

#include <algorithm>
#include <type_traits>

namespace atrium {
namespace {

bool shines(const Light& l) { return l.enabled && l.intensity > 0.0F && max_component(l.color) > 0.0F; }
/// A dangling id counts as shining: whoever adds the light later asks again, but then about the light.
bool may_shine(const Scene& scene, LightId id) {
    const Light* light = scene.lights.find(id);
    return light != nullptr ? shines(*light) : bool(id);
}
bool has_part_in_light(const Scene& scene, const Node& node) { return bool(node.shape) || may_shine(scene, node.light); }

/// Whether the node or anything visible below it takes part in the light, its own visibility aside.
bool subtree_has_part(const Scene& scene, NodeId id) {
    std::vector<NodeId> stack{id};
    while (!stack.empty()) {
        const NodeId at = stack.back();
        stack.pop_back();
        const Node* node = scene.nodes.find(at);
        if (node == nullptr || (at != id && !node->visible)) {
            continue;
        }
        if (has_part_in_light(scene, *node)) {
            return true;
        }
        stack.insert(stack.end(), node->children.begin(), node->children.end());
    }
    return false;
}

template <class F> bool any_shown_node(const Scene& scene, F&& uses) {
    bool found = false;
    scene.nodes.for_each([&](NodeId id, const Node& node) { found = found || (uses(node) && scene.shown(id)); });
    return found;
}

bool is_shown(const Scene& scene, ShapeId id) {
    return any_shown_node(scene, [&](const Node& n) { return n.shape == id; });
}
bool is_shown(const Scene& scene, MaterialId id) {
    return any_shown_node(scene, [&](const Node& n) {
        return n.shape && std::find(n.materials.begin(), n.materials.end(), id) != n.materials.end();
    });
}
bool is_shown(const Scene& scene, TextureId id) {
    bool found = false;
    scene.materials.for_each([&](MaterialId material, const Material& m) {
        const bool uses = m.base_color_texture.texture == id || m.emissive_texture.texture == id;
        found = found || (uses && is_shown(scene, material));
    });
    return found;
}
bool is_shown(const Scene& scene, LightId id) {
    return any_shown_node(scene, [&](const Node& n) { return n.light == id; });
}

/// The resource with everything taken out that light does not depend on.
Shape light_part(const Shape& shape) { return Shape{{}, shape.geometry, {}}; }
Material light_part(Material m) {
    m.name.clear();
    m.extras.clear();
    m.other_extensions.clear();
    m.other_textures.clear();
    return m;
}
Texture light_part(Texture t) {
    t.name.clear();
    t.mime_type.clear();
    t.uri.clear();
    t.encoded.reset();
    return t;
}
Light light_part(Light l) {
    l.name.clear();
    l.extras.clear();
    return l;
}

const Shape* find(const Scene& s, ShapeId id) { return s.shapes.find(id); }
const Material* find(const Scene& s, MaterialId id) { return s.materials.find(id); }
const Texture* find(const Scene& s, TextureId id) { return s.textures.find(id); }
const Light* find(const Scene& s, LightId id) { return s.lights.find(id); }

template <class T> bool inert(const T& /*value*/) { return false; }
bool inert(const Light& light) { return !shines(light); }

// ---- one function per kind of edit ----

bool neutral(const Scene& scene, const AddNode& e) {
    const bool seen =
        e.node.visible && (!e.node.parent || !scene.nodes.contains(e.node.parent) || scene.shown(e.node.parent));
    return !seen || !has_part_in_light(scene, e.node);
}
bool neutral(const Scene& scene, const RemoveNode& e) {
    return scene.nodes.contains(e.id) && (!scene.shown(e.id) || !subtree_has_part(scene, e.id));
}
bool neutral(const Scene& scene, const SetTransform& e) {
    const Node* node = scene.nodes.find(e.id);
    return node != nullptr && (node->transform == e.transform || !scene.shown(e.id) || !subtree_has_part(scene, e.id));
}
bool neutral(const Scene& scene, const SetParent& e) {
    const Node* node = scene.nodes.find(e.id);
    if (node == nullptr) {
        return false;
    }
    const bool shown_there = !e.parent || scene.shown(e.parent);
    const bool shown_here = !node->parent || scene.shown(node->parent);
    if (!node->visible || (!shown_here && !shown_there) || !subtree_has_part(scene, e.id)) {
        return true;
    }
    // Another place in the tree, the same place in the room.
    return shown_here == shown_there && scene.world_matrix(node->parent) == scene.world_matrix(e.parent);
}
bool neutral(const Scene& scene, const SetNode& e) {
    const Node* old = scene.nodes.find(e.id);
    if (old == nullptr) {
        return false;
    }
    const bool above_shown = !old->parent || scene.shown(old->parent);
    if (!above_shown || (!old->visible && !e.value.visible)) {
        return true;
    }
    if (old->visible != e.value.visible) {
        // Its own shape and light count on the side where it is visible, what is below it on both.
        const Node& seen = old->visible ? *old : e.value;
        const bool below = std::any_of(old->children.begin(), old->children.end(), [&](NodeId child) {
            const Node* node = scene.nodes.find(child);
            return node != nullptr && node->visible && subtree_has_part(scene, child);
        });
        return !below && !has_part_in_light(scene, seen);
    }
    const bool same_light =
        old->light == e.value.light || (!may_shine(scene, old->light) && !may_shine(scene, e.value.light));
    return old->shape == e.value.shape && same_light &&
           (!old->shape || (old->materials == e.value.materials && old->caustics == e.value.caustics));
}
bool neutral(const Scene& scene, const SetEnvironment& e) { return scene.environment == e.value; }
bool neutral(const Scene& scene, const SetSolverSettings& e) { return scene.settings == e.value; }

template <class T> bool neutral(const Scene& scene, const AddResource<T>& e) {
    return inert(e.value) || !is_shown(scene, e.id);
}
template <class T> bool neutral(const Scene& scene, const RemoveResource<T>& e) {
    const T* value = find(scene, e.id);
    return value != nullptr && (inert(*value) || !is_shown(scene, e.id));
}
template <class T> bool neutral(const Scene& scene, const SetResource<T>& e) {
    const T* value = find(scene, e.id);
    return value != nullptr &&
           ((inert(*value) && inert(e.value)) || light_part(*value) == light_part(e.value) || !is_shown(scene, e.id));
}
bool neutral(const Scene& /*scene*/, const AddResource<Camera>& /*e*/) { return true; }
bool neutral(const Scene& /*scene*/, const RemoveResource<Camera>& /*e*/) { return true; }
bool neutral(const Scene& /*scene*/, const SetResource<Camera>& /*e*/) { return true; }

bool neutral(const Scene& scene, const EditGroup& group) {
    // Each edit is judged on the scene that it meets: a hidden chair moved out of a hidden room and then shown changes light
    // although either step alone does not. The copy is made only when a second edit has to be judged.
    Scene present;
    const Scene* before = &scene;
    for (std::size_t i = 0; i < group.edits.size(); ++i) {
        if (!leaves_light_unchanged(*before, group.edits[i])) {
            return false;
        }
        if (i + 1 < group.edits.size()) {
            if (before == &scene) {
                present = scene;
                before = &present;
            }
            if (!apply(present, group.edits[i])) {
                return false;
            }
        }
    }
    return true;
}

} // namespace

bool leaves_light_unchanged(const Scene& before, const SceneEdit& edit) {
    return std::visit([&](const auto& e) { return neutral(before, e); }, edit.value);
}

} // namespace atrium
