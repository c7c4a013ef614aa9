// An edit is a value: what changed, in its type. Applying one yields the edit that undoes it.
#pragma once

#include "engine/base/result.h"
#include "engine/scene/scene.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace atrium {

struct SceneEdit;

/// Puts `value` under `id` (which must be free); kinds: Shape, Material, Texture, Light, Camera.
template <class T> struct AddResource {
    Id<T> id;
    T value;
};
/// Takes a resource away. The caller makes sure that no node refers to it (dangling ids read as "none").
template <class T> struct RemoveResource { Id<T> id; };
/// Replaces a resource's whole value.
template <class T> struct SetResource {
    Id<T> id;
    T value;
};

/// Inserts a node (node.children must be empty) as child `index` of node.parent, or among the roots; index past the end
/// appends. `id` must be free; take it from scene.nodes.next_key().
struct AddNode {
    NodeId id;
    Node node;
    std::size_t index = SIZE_MAX;
};
/// Removes a node with everything below it. Shapes, materials and lights stay (undo needs them; saving drops the unused).
struct RemoveNode {
    NodeId id;
};
struct SetTransform {
    NodeId id;
    Transform transform;
};
/// Moves a node (with its subtree) below another parent (none = root), at an index. Refused when it would make a cycle.
struct SetParent {
    NodeId id;
    NodeId parent;
    std::size_t index = SIZE_MAX;
};
/// Replaces name, visibility, lock, shape, materials, light, camera, caustics and extras; parent, children and transform
/// stay.
struct SetNode {
    NodeId id;
    Node value;
};
struct SetEnvironment {
    Environment value;
};
struct SetSolverSettings {
    SolverSettings value;
};
/// Several edits as one; applied in order, undone in reverse. If one fails, those before it are rolled back.
struct EditGroup {
    std::vector<SceneEdit> edits;
};

/// Every change to a document. Members are found by std::get_if / std::visit on `value`.
struct SceneEdit {
    std::variant<AddNode, RemoveNode, SetTransform, SetParent, SetNode, SetEnvironment, SetSolverSettings,
                 AddResource<Shape>, RemoveResource<Shape>, SetResource<Shape>, AddResource<Material>,
                 RemoveResource<Material>, SetResource<Material>, AddResource<Texture>, RemoveResource<Texture>,
                 SetResource<Texture>, AddResource<Light>, RemoveResource<Light>, SetResource<Light>, AddResource<Camera>,
                 RemoveResource<Camera>, SetResource<Camera>, EditGroup>
        value;
};

/// Applies `edit` and returns the edit that restores the scene exactly (same ids, same order). On an error (unknown id,
/// id taken, cycle, number not finite) the scene is unchanged and the message names the node.
Result<SceneEdit> apply(Scene& scene, const SceneEdit& edit);

/// True when `later` replaces what `earlier` did to the same target, so that a mailbox or an undo entry may keep only
/// `later` (SetTransform on one node, SetResource on one id, SetNode on one node, SetEnvironment, SetSolverSettings).
bool supersedes(const SceneEdit& later, const SceneEdit& earlier);

/// True for edits that change light nowhere (names, locks, cameras, extras): they need no new solution.
bool leaves_light_unchanged(const Scene& before, const SceneEdit& edit);

} // namespace atrium
