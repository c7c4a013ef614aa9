#include "ui/document/insert_commands.h"

#include "ui/document/edit_builder.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace atrium::ui {
namespace {

/// Copies resources and nodes of one scene into another, each once.
class Copier {
public:
    /// `share` takes materials and textures that are there already, with the same value, instead of a copy.
    Copier(EditBuilder& to, const Scene& from, bool share) : to_(to), from_(from), share_(share) {}

    TextureId texture(TextureId id) { return copy(textures_, from_.textures, to_.scene().textures, id, share_); }
    MaterialId material(MaterialId id) {
        if (const auto known = materials_.find(id); known != materials_.end()) {
            return known->second;
        }
        const Material* source = from_.materials.find(id);
        if (source == nullptr) {
            return {};
        }
        Material m = *source;
        m.base_color_texture.texture = texture(m.base_color_texture.texture);
        m.emissive_texture.texture = texture(m.emissive_texture.texture);
        for (Material::OtherTexture& t : m.other_textures) {
            t.ref.texture = texture(t.ref.texture);
        }
        return materials_[id] = add(to_.scene().materials, std::move(m), share_);
    }
    /// The node without its children; `parent` is one of the target's.
    NodeId node(NodeId id, NodeId parent, const Transform& transform, const std::string& name) {
        Node n = *from_.nodes.find(id);
        n.parent = parent;
        n.transform = transform;
        n.name = name;
        n.shape = copy(shapes_, from_.shapes, to_.scene().shapes, n.shape, false);
        n.light = copy(lights_, from_.lights, to_.scene().lights, n.light, false);
        n.camera = copy(cameras_, from_.cameras, to_.scene().cameras, n.camera, false);
        for (MaterialId& m : n.materials) {
            m = material(m);
        }
        return to_.add_node(std::move(n));
    }
    void below(NodeId source, NodeId parent) {
        for (const NodeId child : from_.nodes.find(source)->children) {
            const Node* n = from_.nodes.find(child);
            below(child, node(child, parent, n->transform, n->name));
        }
    }

private:
    template <class T> Id<T> add(const SlotMap<T>& pool, T value, bool share) {
        Id<T> same;
        if (share) {
            pool.for_each([&](Id<T> id, const T& there) {
                if (!same && there == value) {
                    same = id;
                }
            });
        }
        return same ? same : to_.add_resource(pool, std::move(value));
    }
    template <class T>
    Id<T> copy(std::unordered_map<Id<T>, Id<T>>& done, const SlotMap<T>& from, const SlotMap<T>& to, Id<T> id, bool share) {
        const T* value = from.find(id);
        if (value == nullptr) {
            return {};
        }
        if (const auto known = done.find(id); known != done.end()) {
            return known->second;
        }
        return done[id] = add(to, T(*value), share);
    }

    EditBuilder& to_;
    const Scene& from_;
    bool share_;
    std::unordered_map<TextureId, TextureId> textures_;
    std::unordered_map<MaterialId, MaterialId> materials_;
    std::unordered_map<ShapeId, ShapeId> shapes_;
    std::unordered_map<LightId, LightId> lights_;
    std::unordered_map<CameraId, CameraId> cameras_;
};

Scene applied(Scene scene, const SceneEdit& edit) {
    (void)atrium::apply(scene, edit);
    return scene;
}

} // namespace

Scene extract_nodes(const Scene& scene, const std::vector<NodeId>& nodes) {
    const std::unordered_set<NodeId> wanted(nodes.begin(), nodes.end());
    Scene out;
    EditBuilder builder(out);
    Copier copier(builder, scene, false);
    for (const NodeId id : scene.in_tree_order()) {
        bool below_another = false;
        for (NodeId up = scene.nodes.find(id)->parent; up; up = scene.nodes.find(up)->parent) {
            below_another = below_another || wanted.contains(up);
        }
        if (wanted.contains(id) && !below_another) {
            copier.below(id, copier.node(id, {}, decompose(scene.world_matrix(id)), scene.nodes.find(id)->name));
        }
    }
    return applied(std::move(out), builder.finish());
}

Command insert_scene(const Scene& scene, const Scene& other, const dmat4& placement) {
    EditBuilder builder(scene);
    Copier copier(builder, other, true);
    std::vector<NodeId> roots;
    for (const NodeId id : other.roots) {
        const Node* root = other.nodes.find(id);
        const NodeId made =
            copier.node(id, {}, decompose(placement * root->transform.matrix()), free_name(builder.scene(), root->name));
        copier.below(id, made);
        roots.push_back(made);
    }
    return {builder.finish(), roots};
}

Command merge_scene(const Scene& scene, const Scene& other, const std::string& name) {
    EditBuilder builder(scene);
    Node group;
    group.name = free_name(scene, name);
    const NodeId top = builder.add_node(std::move(group));
    Copier copier(builder, other, false);
    for (const NodeId id : other.roots) {
        const Node* root = other.nodes.find(id);
        copier.below(id, copier.node(id, top, root->transform, root->name));
    }
    return {builder.finish(), {top}};
}

std::vector<MaterialPlace> material_places(const Scene& scene, const std::vector<NodeId>& nodes) {
    std::vector<MaterialPlace> out;
    std::unordered_set<NodeId> seen;
    for (const NodeId top : nodes) {
        for (const NodeId id : scene.in_tree_order(top)) {
            const Node* node = scene.nodes.find(id);
            const Shape* shape = node == nullptr ? nullptr : scene.shapes.find(node->shape);
            if (shape != nullptr && seen.insert(id).second) {
                for (std::size_t part = 0; part < part_count(*shape); ++part) {
                    out.push_back({id, part});
                }
            }
        }
    }
    return out;
}

SceneEdit assign_material(const Scene& scene, const std::vector<MaterialPlace>& places, const Scene& other,
                          MaterialId material) {
    EditBuilder builder(scene);
    Copier copier(builder, other, true);
    const MaterialId id = copier.material(material);
    for (const MaterialPlace& place : places) {
        const Node* node = builder.scene().nodes.find(place.node);
        if (node == nullptr) {
            continue;
        }
        Node value = *node;
        if (value.materials.size() <= place.part) {
            value.materials.resize(place.part + 1);
        }
        value.materials[place.part] = id;
        builder.add(SceneEdit{SetNode{place.node, std::move(value)}});
    }
    return builder.finish();
}

Scene material_scene(const Scene& from, MaterialId material) {
    Scene out;
    EditBuilder builder(out);
    Copier copier(builder, from, false);
    const MaterialId id = copier.material(material);
    Node node;
    node.name = "Material";
    node.shape = builder.add_resource(builder.scene().shapes,
                                      Shape{node.name, Polygon{{{0, 0}, {0.1F, 0}, {0.1F, 0.1F}, {0, 0.1F}}, {}}, {}});
    node.materials.assign(1, id);
    builder.add_node(std::move(node));
    return applied(std::move(out), builder.finish());
}

MaterialId material_in(const Scene& scene) {
    for (const NodeId id : scene.in_tree_order()) {
        for (const MaterialId material : scene.nodes.find(id)->materials) {
            if (scene.materials.contains(material)) {
                return material;
            }
        }
    }
    return {};
}

} // namespace atrium::ui
