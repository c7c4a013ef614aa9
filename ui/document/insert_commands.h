// Scenes put into scenes: what library, clipboard and import add, and what copying takes out.
#pragma once

#include "ui/document/scene_commands.h"

namespace atrium::ui {

/// The nodes with all below them as a scene of their own, in their places in the world, with the resources that they use
/// and no others. Nodes below other ones of the list come with these.
Scene extract_nodes(const Scene& scene, const std::vector<NodeId>& nodes);

/// The roots of `other` as roots here, `placement` (world) before their own transforms; ids are new, and the names of the
/// roots are free. Materials and textures that `scene` has with the same value are used, not copied.
Command insert_scene(const Scene& scene, const Scene& other, const dmat4& placement);

/// Everything of `other` under a new root group; ids are new.
Command merge_scene(const Scene& scene, const Scene& other, const std::string& name);

/// One part of a node that takes a material.
struct MaterialPlace {
    NodeId node;
    std::size_t part = 0;
};
/// All parts of the nodes and of what is below them.
std::vector<MaterialPlace> material_places(const Scene& scene, const std::vector<NodeId>& nodes);
/// Gives the places a material of `other`, with its textures; the scene's own one of the same value where there is one.
SceneEdit assign_material(const Scene& scene, const std::vector<MaterialPlace>& places, const Scene& other,
                          MaterialId material);
/// A scene that holds one material, with its textures, on a small polygon: a form that every reader of scenes understands.
Scene material_scene(const Scene& from, MaterialId material);
/// The material of a scene from material_scene(), none where there is none.
MaterialId material_in(const Scene& scene);

} // namespace atrium::ui
