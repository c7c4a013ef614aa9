#include "ui/document/scene_commands.h"

#include "engine/scene/edit_tools.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace atrium::ui {

namespace {

/// Collects edits while applying them to a copy, so that each new id is free given the edits before it.
class Builder {
public:
    explicit Builder(const Scene& scene) : scratch_(scene) {}
    const Scene& scene() const { return scratch_; }
    void add(SceneEdit edit) {
        if (atrium::apply(scratch_, edit)) {
            edits_.push_back(std::move(edit));
        }
    }
    NodeId add_node(Node node, std::size_t index = SIZE_MAX) {
        const NodeId id = scratch_.nodes.next_key();
        node.children.clear();
        add(SceneEdit{AddNode{id, std::move(node), index}});
        return id;
    }
    template <class T> Id<T> add_resource(const SlotMap<T>& pool, T value) {
        const Id<T> id = pool.next_key();
        add(SceneEdit{AddResource<T>{id, std::move(value)}});
        return id;
    }
    SceneEdit finish() { return as_one(std::move(edits_)); }

private:
    Scene scratch_;
    std::vector<SceneEdit> edits_;
};

const dquat kLieDown = glm::angleAxis(-kPiD / 2, dvec3(1, 0, 0)); // local +z to world +y
const dquat kFaceDown = glm::angleAxis(kPiD / 2, dvec3(1, 0, 0)); // local +z to world -y

Polygon rectangle(float width, float depth) {
    const float x = width / 2;
    const float y = depth / 2;
    return Polygon{{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, {}};
}

template <class T> std::size_t index_in(const std::vector<T>& list, const T& value) {
    const auto it = std::find(list.begin(), list.end(), value);
    return it == list.end() ? SIZE_MAX : std::size_t(it - list.begin());
}

const std::vector<NodeId>& siblings(const Scene& scene, NodeId parent) {
    const Node* node = scene.nodes.find(parent);
    return node == nullptr ? scene.roots : node->children;
}

NodeId copy_subtree(Builder& builder, NodeId source, NodeId parent, std::size_t index, const std::string& name) {
    Node node = *builder.scene().nodes.find(source);
    const std::vector<NodeId> children = node.children;
    node.parent = parent;
    node.name = name;
    if (const Light* light = builder.scene().lights.find(node.light)) {
        node.light = builder.add_resource(builder.scene().lights, Light(*light));
    }
    if (const Camera* camera = builder.scene().cameras.find(node.camera)) {
        node.camera = builder.add_resource(builder.scene().cameras, Camera(*camera));
    }
    const NodeId copy = builder.add_node(std::move(node), index);
    for (const NodeId child : children) {
        copy_subtree(builder, child, copy, SIZE_MAX, builder.scene().nodes.find(child)->name);
    }
    return copy;
}

} // namespace

std::string free_name(const Scene& scene, const std::string& base) {
    std::unordered_set<std::string> taken;
    scene.nodes.for_each([&](NodeId, const Node& node) { taken.insert(node.name); });
    if (taken.count(base) == 0) {
        return base;
    }
    // "Chair 2" copies to "Chair 3", not to "Chair 2 2".
    std::string stem = base;
    const std::size_t space = base.rfind(' ');
    if (space != std::string::npos && space > 0 && space + 1 < base.size() &&
        base.find_first_not_of("0123456789", space + 1) == std::string::npos) {
        stem = base.substr(0, space);
    }
    for (std::size_t i = 2;; ++i) {
        std::string name = stem + " " + std::to_string(i);
        if (taken.count(name) == 0) {
            return name;
        }
    }
}

std::size_t material_users(const Scene& scene, MaterialId material) {
    std::size_t users = 0;
    scene.nodes.for_each([&](NodeId, const Node& node) {
        users += std::size_t(std::count(node.materials.begin(), node.materials.end(), material));
    });
    return users;
}

Command add_object(const Scene& scene, NewObject kind, const dvec3& at, const std::string& name) {
    Builder builder(scene);
    Node node;
    node.name = free_name(scene, name);
    node.transform.translation = at;
    const auto use_shape = [&](Geometry geometry) {
        node.shape = builder.add_resource(builder.scene().shapes, Shape{node.name, std::move(geometry), {}});
        node.materials.assign(1, MaterialId{});
    };
    const auto use_material = [&](Material material) {
        material.name = node.name;
        node.materials.assign(1, builder.add_resource(builder.scene().materials, std::move(material)));
    };
    const auto use_light = [&](Light light) {
        light.name = node.name;
        node.light = builder.add_resource(builder.scene().lights, std::move(light));
    };
    Material plain;
    plain.base_color = Rgb(0.7F);
    switch (kind) {
    case NewObject::Polygon:
        use_shape(rectangle(2.0F, 2.0F));
        plain.double_sided = true;
        use_material(plain);
        node.transform.rotation = kLieDown;
        node.transform.translation.y += 0.001; // clear of the floor it was placed on
        break;
    case NewObject::Box:
        use_shape(Box{vec3(0.5F)});
        use_material(plain);
        node.transform.translation.y += 0.25;
        break;
    case NewObject::Sphere:
        use_shape(Sphere{0.25F});
        use_material(plain);
        node.transform.translation.y += 0.25;
        break;
    case NewObject::Cylinder:
        use_shape(Cylinder{0.25F, 0.75F, true});
        use_material(plain);
        node.transform.translation.y += 0.375;
        break;
    case NewObject::Cone:
        use_shape(Cone{0.25F, 0.0F, 0.75F, true});
        use_material(plain);
        node.transform.translation.y += 0.375;
        break;
    case NewObject::Disc:
        use_shape(Disc{0.5F});
        plain.double_sided = true;
        use_material(plain);
        node.transform.rotation = kLieDown;
        node.transform.translation.y += 0.001;
        break;
    case NewObject::PointLight:
        use_light(Light{});
        node.transform.translation.y += kLampHeight;
        break;
    case NewObject::SpotLight: {
        Light light;
        light.kind = Light::Kind::Spot;
        light.intensity = 600.0F;
        light.inner_cone = kPi / 9;
        light.outer_cone = kPi / 6;
        use_light(light);
        node.transform.rotation = kLieDown; // -z looks down
        node.transform.translation.y += kLampHeight;
        break;
    }
    case NewObject::Sun: {
        Light light;
        light.kind = Light::Kind::Directional;
        light.intensity = 50000.0F;
        light.color = Rgb(1.0F, 0.95F, 0.88F);
        use_light(light);
        // 40 degrees above the horizon, from the south-west.
        node.transform.rotation = glm::angleAxis(radians_from_degrees(-35), dvec3(0, 1, 0)) *
                                  glm::angleAxis(radians_from_degrees(-40), dvec3(1, 0, 0));
        node.transform.translation.y += 4;
        break;
    }
    case NewObject::AreaLight: {
        use_shape(Disc{0.3F});
        Material lamp;
        lamp.base_color = Rgb(0.8F);
        lamp.emissive_color = Rgb(1.0F, 0.93F, 0.82F);
        lamp.emissive_strength = 4000.0F;
        use_material(lamp);
        node.transform.rotation = kFaceDown;
        node.transform.translation.y += kLampHeight;
        break;
    }
    case NewObject::Camera: return add_camera(scene, node.transform.matrix(), Camera{}, name);
    }
    const NodeId id = builder.add_node(std::move(node));
    return {builder.finish(), {id}};
}

Command add_luminaire(const Scene& scene, std::shared_ptr<const PhotometricWeb> web, const dvec3& at,
                      const std::string& name) {
    Builder builder(scene);
    Node node;
    node.name = free_name(scene, name);
    Light light;
    light.name = node.name;
    set_photometry(light, std::move(web));
    node.light = builder.add_resource(builder.scene().lights, std::move(light));
    node.transform.translation = at;
    node.transform.rotation = kLieDown; // -z looks down
    const NodeId id = builder.add_node(std::move(node));
    return {builder.finish(), {id}};
}

SceneEdit set_lamp_photometry(const Scene& scene, const std::vector<LightId>& lights,
                              const std::shared_ptr<const PhotometricWeb>& web) {
    std::vector<SceneEdit> edits;
    for (const LightId id : lights) {
        const Light* found = scene.lights.find(id);
        if (found == nullptr || found->kind == Light::Kind::Directional) {
            continue;
        }
        Light light = *found;
        if (web) {
            set_photometry(light, web);
        } else {
            remove_photometry(light);
        }
        edits.push_back(SceneEdit{SetResource<Light>{id, std::move(light)}});
    }
    return as_one(std::move(edits));
}

Command add_camera(const Scene& scene, const dmat4& to_world, const Camera& lens, const std::string& name) {
    Builder builder(scene);
    Node node;
    node.name = free_name(scene, name);
    node.transform = decompose(to_world);
    Camera camera = lens;
    camera.name = node.name;
    camera.extras.clear();
    node.camera = builder.add_resource(builder.scene().cameras, std::move(camera));
    const NodeId id = builder.add_node(std::move(node));
    return {builder.finish(), {id}};
}

SceneEdit delete_nodes(const std::vector<NodeId>& nodes) {
    std::vector<SceneEdit> edits;
    for (const NodeId id : nodes) {
        edits.push_back(SceneEdit{RemoveNode{id}});
    }
    return as_one(std::move(edits));
}

Command duplicate_nodes(const Scene& scene, const std::vector<NodeId>& nodes) {
    Builder builder(scene);
    std::vector<NodeId> copies;
    for (const NodeId id : nodes) {
        const Node* node = builder.scene().nodes.find(id);
        if (node == nullptr) {
            continue;
        }
        const NodeId parent = node->parent;
        const std::size_t at = index_in(siblings(builder.scene(), parent), id);
        copies.push_back(
            copy_subtree(builder, id, parent, at == SIZE_MAX ? SIZE_MAX : at + 1, free_name(builder.scene(), node->name)));
    }
    return {builder.finish(), copies};
}

Command group_nodes(const Scene& scene, const std::vector<NodeId>& nodes, const std::string& name) {
    Builder builder(scene);
    Node group;
    group.name = free_name(scene, name);
    if (const Node* first = nodes.empty() ? nullptr : scene.nodes.find(nodes.front())) {
        group.parent = first->parent;
    }
    const NodeId id = builder.add_node(std::move(group));
    builder.add(reparent_nodes(builder.scene(), nodes, id, SIZE_MAX));
    return {builder.finish(), {id}};
}

SceneEdit reparent_nodes(const Scene& scene, const std::vector<NodeId>& nodes, NodeId parent, std::size_t index) {
    Builder builder(scene);
    const dmat4 to_parent = glm::inverse(scene.world_matrix(parent));
    for (const NodeId id : nodes) {
        const Node* node = builder.scene().nodes.find(id);
        if (node == nullptr) {
            continue;
        }
        const bool same_parent = node->parent == parent;
        const Transform placed = decompose(to_parent * scene.world_matrix(id));
        std::size_t at = index;
        if (same_parent && index != SIZE_MAX && index_in(siblings(builder.scene(), parent), id) < index) {
            --at; // taking the node out moves what follows it up by one
        }
        builder.add(SceneEdit{SetParent{id, parent, at}});
        if (!same_parent) {
            builder.add(SceneEdit{SetTransform{id, placed}});
        }
        if (index != SIZE_MAX) {
            index = at + 1;
        }
    }
    return builder.finish();
}

Command merge_scene(const Scene& scene, const Scene& other, const std::string& name) {
    Builder builder(scene);
    std::unordered_map<TextureId, TextureId> textures;
    std::unordered_map<MaterialId, MaterialId> materials;
    std::unordered_map<ShapeId, ShapeId> shapes;
    std::unordered_map<LightId, LightId> lights;
    std::unordered_map<CameraId, CameraId> cameras;
    const auto mapped = [](const auto& map, auto id) {
        const auto it = map.find(id);
        return it == map.end() ? decltype(id){} : it->second;
    };
    other.textures.for_each(
        [&](TextureId id, const Texture& t) { textures[id] = builder.add_resource(builder.scene().textures, Texture(t)); });
    other.materials.for_each([&](MaterialId id, Material m) {
        m.base_color_texture.texture = mapped(textures, m.base_color_texture.texture);
        m.emissive_texture.texture = mapped(textures, m.emissive_texture.texture);
        for (Material::OtherTexture& t : m.other_textures) {
            t.ref.texture = mapped(textures, t.ref.texture);
        }
        materials[id] = builder.add_resource(builder.scene().materials, std::move(m));
    });
    other.shapes.for_each(
        [&](ShapeId id, const Shape& s) { shapes[id] = builder.add_resource(builder.scene().shapes, Shape(s)); });
    other.lights.for_each(
        [&](LightId id, const Light& l) { lights[id] = builder.add_resource(builder.scene().lights, Light(l)); });
    other.cameras.for_each(
        [&](CameraId id, const Camera& c) { cameras[id] = builder.add_resource(builder.scene().cameras, Camera(c)); });
    Node group;
    group.name = free_name(scene, name);
    const NodeId top = builder.add_node(std::move(group));
    std::unordered_map<NodeId, NodeId> nodes;
    for (const NodeId id : other.in_tree_order()) {
        Node node = *other.nodes.find(id);
        node.parent = node.parent ? mapped(nodes, node.parent) : top;
        node.shape = mapped(shapes, node.shape);
        node.light = mapped(lights, node.light);
        node.camera = mapped(cameras, node.camera);
        for (MaterialId& material : node.materials) {
            material = mapped(materials, material);
        }
        nodes[id] = builder.add_node(std::move(node));
    }
    return {builder.finish(), {top}};
}

Command wrap_roots(const Scene& scene, double unit_scale, bool z_up, const std::string& name) {
    Builder builder(scene);
    Node group;
    group.name = free_name(scene, name);
    group.transform.scale = dvec3(unit_scale);
    if (z_up) {
        group.transform.rotation = kLieDown;
    }
    const std::vector<NodeId> roots = scene.roots;
    const NodeId top = builder.add_node(std::move(group));
    for (const NodeId root : roots) {
        builder.add(SceneEdit{SetParent{root, top, SIZE_MAX}});
    }
    return {builder.finish(), {}};
}

SceneEdit set_visible(const Scene& scene, const std::vector<NodeId>& nodes, bool visible) {
    std::vector<SceneEdit> edits;
    for (const NodeId id : nodes) {
        if (const Node* node = scene.nodes.find(id)) {
            Node value = *node;
            value.visible = visible;
            edits.push_back(SceneEdit{SetNode{id, std::move(value)}});
        }
    }
    return as_one(std::move(edits));
}

SceneEdit set_locked(const Scene& scene, const std::vector<NodeId>& nodes, bool locked) {
    std::vector<SceneEdit> edits;
    for (const NodeId id : nodes) {
        if (const Node* node = scene.nodes.find(id)) {
            Node value = *node;
            value.locked = locked;
            edits.push_back(SceneEdit{SetNode{id, std::move(value)}});
        }
    }
    return as_one(std::move(edits));
}

SceneEdit make_material_unique(const Scene& scene, NodeId node, std::size_t part, const std::string& name) {
    Builder builder(scene);
    Node value = *scene.nodes.find(node);
    const Material* shared = scene.material_of(value, part);
    Material material = shared == nullptr ? default_material() : *shared;
    material.name = name;
    if (value.materials.size() <= part) {
        value.materials.resize(part + 1);
    }
    value.materials[part] = builder.add_resource(builder.scene().materials, std::move(material));
    builder.add(SceneEdit{SetNode{node, std::move(value)}});
    return builder.finish();
}

} // namespace atrium::ui
