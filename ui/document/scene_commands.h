// The editor's commands as edits: they read a scene and return one SceneEdit, applied by the document as one undo entry.
#pragma once

#include "engine/scene/scene_edit.h"

#include <cstdint>
#include <string>
#include <vector>

namespace atrium::ui {

/// Lamps are hung so high above the floor, metres.
inline constexpr double kLampHeight = 2.2;

/// What the Add menu offers.
enum class NewObject : std::uint8_t {
    Polygon,
    Box,
    Sphere,
    Cylinder,
    Cone,
    Disc,
    PointLight,
    SpotLight,
    Sun,
    AreaLight,
    Camera
};

/// An edit with the nodes that should be selected once it is applied.
struct Command {
    SceneEdit edit;
    std::vector<NodeId> select;
};

/// Puts a new object into the scene as a root. `at` is a point on a floor or surface, world metres: solids stand on it,
/// lamps hang above it. `name` must be translated; a number is appended where it is taken.
Command add_object(const Scene& scene, NewObject kind, const dvec3& at, const std::string& name);
/// A camera node with this placement and lens.
Command add_camera(const Scene& scene, const dmat4& to_world, const Camera& lens, const std::string& name);
/// A lamp that shines downwards as a photometric file says. `at`: world metres, the lamp itself.
Command add_luminaire(const Scene& scene, std::shared_ptr<const PhotometricWeb> web, const dvec3& at,
                      const std::string& name);
/// Gives point and spot lights a photometric distribution, or takes it away (null). Suns and lights that are gone are left
/// out.
SceneEdit set_lamp_photometry(const Scene& scene, const std::vector<LightId>& lights,
                              const std::shared_ptr<const PhotometricWeb>& web);
/// Removes the nodes with all below them.
SceneEdit delete_nodes(const std::vector<NodeId>& nodes);
/// Copies the subtrees next to their originals; shapes and materials stay shared, lights and cameras are copied.
Command duplicate_nodes(const Scene& scene, const std::vector<NodeId>& nodes);
/// Puts the nodes under a new group with their world placement kept. The group stands where the first one's parent is.
Command group_nodes(const Scene& scene, const std::vector<NodeId>& nodes, const std::string& name);
/// Moves nodes below `parent` (none = root) at `index`, with their world placement kept (nearest, under shear).
SceneEdit reparent_nodes(const Scene& scene, const std::vector<NodeId>& nodes, NodeId parent, std::size_t index);
/// Everything of `other` under a new root group; ids are new.
Command merge_scene(const Scene& scene, const Scene& other, const std::string& name);
/// Wraps all roots in a group that scales by `unit_scale` and, with `z_up`, turns +Z to +Y.
Command wrap_roots(const Scene& scene, double unit_scale, bool z_up, const std::string& name);
/// SetNode with visible or locked changed for each node.
SceneEdit set_visible(const Scene& scene, const std::vector<NodeId>& nodes, bool visible);
SceneEdit set_locked(const Scene& scene, const std::vector<NodeId>& nodes, bool locked);
/// Gives one part of a node a material of its own: a copy of the one it shares.
SceneEdit make_material_unique(const Scene& scene, NodeId node, std::size_t part, const std::string& name);

/// `base`, or `base 2`, `base 3`, ... until no node has it.
std::string free_name(const Scene& scene, const std::string& base);
/// Number of node parts that use a material.
std::size_t material_users(const Scene& scene, MaterialId material);

} // namespace atrium::ui
