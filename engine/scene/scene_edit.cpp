#include "engine/scene/scene_edit.h"

#include "engine/base/checks.h"
#include "engine/scene/light_limits.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>

namespace atrium {
namespace {

// Ids are handed out one slot at a time; far beyond that it is a stray number, which must not allocate gigabytes.
constexpr std::size_t kMaxSlotsAhead = std::size_t(1) << 16;

template <class T> struct ResourceTraits;
template <> struct ResourceTraits<Shape> {
    static constexpr const char* kName = "shape";
    static SlotMap<Shape>& map(Scene& s) { return s.shapes; }
};
template <> struct ResourceTraits<Material> {
    static constexpr const char* kName = "material";
    static SlotMap<Material>& map(Scene& s) { return s.materials; }
};
template <> struct ResourceTraits<Texture> {
    static constexpr const char* kName = "texture";
    static SlotMap<Texture>& map(Scene& s) { return s.textures; }
};
template <> struct ResourceTraits<Light> {
    static constexpr const char* kName = "light";
    static SlotMap<Light>& map(Scene& s) { return s.lights; }
};
template <> struct ResourceTraits<Camera> {
    static constexpr const char* kName = "camera";
    static SlotMap<Camera>& map(Scene& s) { return s.cameras; }
};

/// "node 'Chair'" or, without a name, "node 12.3" (slot.generation).
template <class Key> std::string label(const char* kind, const std::string& name, Key id) {
    const std::string number = std::to_string(id.slot) + "." + std::to_string(id.generation);
    return std::string(kind) + (name.empty() ? " " + number : " '" + name + "'");
}
std::string node_label(const Scene& scene, NodeId id) {
    const Node* node = scene.nodes.find(id);
    return label("node", node != nullptr ? node->name : std::string(), id);
}
tl::unexpected<Error> unknown(const std::string& where, const char* kind) {
    return fail("", where, std::string("there is no such ") + kind, "It may have been deleted");
}

template <class T> Result<void> check_free(const SlotMap<T>& map, const char* kind, const std::string& name, Id<T> id) {
    const std::string where = label(kind, name, id);
    if (!id) {
        return fail("", where, "a new item needs an id", "Take it from next_key()");
    }
    if (id.slot >= map.slot_count() + kMaxSlotsAhead) {
        return fail("", where, "its id was never given out", "Take it from next_key()");
    }
    if (map.occupied(id)) {
        return fail("", where, "its id is already taken", "Take it from next_key()");
    }
    return {};
}

// ---- finite numbers ----

bool finite(float v) { return std::isfinite(v); }
bool finite(const TextureRef& r) { return is_finite(r.offset) && is_finite(r.scale) && finite(r.rotation); }
bool finite(const std::vector<vec2>& points) {
    return std::all_of(points.begin(), points.end(), [](const vec2& p) { return is_finite(p); });
}
bool finite(const std::vector<vec3>& points) {
    return std::all_of(points.begin(), points.end(), [](const vec3& p) { return is_finite(p); });
}
bool finite(const Polygon& g) {
    return finite(g.outer) && std::all_of(g.holes.begin(), g.holes.end(), [](const auto& h) { return finite(h); });
}
bool finite(const Box& g) { return is_finite(g.size); }
bool finite(const Sphere& g) { return finite(g.radius); }
bool finite(const Cylinder& g) { return finite(g.radius) && finite(g.height); }
bool finite(const Cone& g) { return finite(g.base_radius) && finite(g.top_radius) && finite(g.height); }
bool finite(const Disc& g) { return finite(g.radius); }
bool finite(const Mesh& g) {
    const MeshData& d = *g.data;
    return finite(d.positions) && finite(d.normals) && finite(d.texcoords0) && finite(d.texcoords1) && finite(d.colors);
}

/// What makes a mesh unusable, or null.
const char* mesh_fault(const Mesh& mesh) {
    if (!mesh.data) {
        return "the mesh has no data";
    }
    const MeshData& d = *mesh.data;
    const auto per_vertex = [&](std::size_t n) { return n == 0 || n == d.positions.size(); };
    if (!per_vertex(d.normals.size()) || !per_vertex(d.texcoords0.size()) || !per_vertex(d.texcoords1.size()) ||
        !per_vertex(d.colors.size())) {
        return "the mesh has vertex attributes of different lengths";
    }
    if (std::any_of(d.indices.begin(), d.indices.end(), [&](std::uint32_t i) { return i >= d.positions.size(); })) {
        return "the mesh refers to a vertex that does not exist";
    }
    for (const MeshPart& part : d.parts) {
        if (part.index_count % 3 != 0 || std::size_t(part.first_index) + part.index_count > d.indices.size()) {
            return "a part of the mesh lies outside its index list";
        }
    }
    return nullptr;
}

Result<void> check_value(const std::string& where, const Shape& shape) {
    if (const auto* mesh = std::get_if<Mesh>(&shape.geometry)) {
        if (const char* fault = mesh_fault(*mesh)) {
            return fail("", where, fault);
        }
    }
    if (!std::visit([](const auto& g) { return finite(g); }, shape.geometry)) {
        return fail("", where, "a size or coordinate is not a finite number");
    }
    return {};
}
Result<void> check_value(const std::string& where, const Material& m) {
    const bool good = is_finite(m.base_color) && finite(m.alpha) && finite(m.metallic) && finite(m.roughness) &&
                      finite(m.transmission) && finite(m.ior) && finite(m.specular) && is_finite(m.specular_color) &&
                      finite(m.thickness) && is_finite(m.attenuation_color) && !std::isnan(m.attenuation_distance) &&
                      is_finite(m.emissive_color) && finite(m.emissive_strength) && finite(m.alpha_cutoff) &&
                      finite(m.base_color_texture) && finite(m.emissive_texture) &&
                      std::all_of(m.other_textures.begin(), m.other_textures.end(),
                                  [](const auto& t) { return finite(t.ref) && finite(t.scale); });
    if (!good) {
        return fail("", where, "a value of the material is not a finite number");
    }
    if (max_component(m.emissive_color) * m.emissive_strength > kMaxLight) {
        return fail("", where, "it emits more than 1e12 cd/m2", "The sun has 1.6e9 cd/m2.");
    }
    return {};
}
Result<void> check_value(const std::string& /*where*/, const Texture& /*texture*/) { return {}; }
Result<void> check_value(const std::string& where, const Light& l) {
    if (!is_finite(l.color) || !finite(l.intensity) || !finite(l.inner_cone) || !finite(l.outer_cone) ||
        !finite(l.angular_diameter_degrees)) {
        return fail("", where, "a value of the light is not a finite number");
    }
    if (l.intensity > kMaxLight || max_component(l.color) * l.intensity > kMaxLight) {
        return fail("", where, "its intensity is more than 1e12", "Set it in candela, or in lux for a sun.");
    }
    return {};
}
Result<void> check_value(const std::string& where, const Camera& c) {
    if (!finite(c.yfov) || !finite(c.ymag) || !finite(c.znear) || !finite(c.zfar) || !finite(c.exposure_ev)) {
        return fail("", where, "a value of the camera is not a finite number");
    }
    return {};
}

/// Finite, with a unit rotation. A rotation that is unit already keeps its bits, so that undo is exact.
Result<Transform> checked_transform(const std::string& where, Transform t) {
    const dquat& q = t.rotation;
    if (!is_finite(t.translation) || !is_finite(t.scale) || !std::isfinite(q.w) || !std::isfinite(q.x) ||
        !std::isfinite(q.y) || !std::isfinite(q.z)) {
        return fail("", where, "its position, rotation or scale is not a finite number");
    }
    const double length = std::hypot(std::hypot(q.w, q.x), std::hypot(q.y, q.z));
    if (length == 0.0) {
        t.rotation = dquat(1.0, 0.0, 0.0, 0.0); // no axis, no rotation
    } else if (std::abs(length - 1.0) > 1e-6) {
        const dquat n(q.w / length, q.x / length, q.y / length, q.z / length);
        t.rotation = glm::normalize(n); // twice: dividing by a denormal length loses digits
    }
    return t;
}

Result<void> check_parts(const Scene& scene, const std::string& where, const Node& node) {
    const Shape* shape = scene.shapes.find(node.shape);
    if (shape != nullptr && node.materials.size() > part_count(*shape)) {
        return fail("", where,
                    "it names " + std::to_string(node.materials.size()) + " materials, but its shape has " +
                        std::to_string(part_count(*shape)) + " parts");
    }
    return {};
}

Result<void> check_wish(const std::string& where, const CausticWish& wish) {
    const auto usable = [](float v) { return finite(v) && v >= 0.0F; };
    if (!usable(wish.texel) || !usable(wish.threshold)) {
        return fail("", where, "the size of its caustic texels or their threshold is below zero or not a finite number",
                    "Zero is automatic");
    }
    return {};
}

// ---- the tree ----

std::vector<NodeId>& siblings_below(Scene& scene, NodeId parent) {
    Node* node = scene.nodes.find(parent);
    return node != nullptr ? node->children : scene.roots;
}
void insert_child(std::vector<NodeId>& list, NodeId id, std::size_t index) {
    list.insert(list.begin() + std::ptrdiff_t(std::min(index, list.size())), id);
}
/// Takes a node out of its parent's list and returns where it was.
std::size_t take_child(std::vector<NodeId>& list, NodeId id) {
    const auto at = std::find(list.begin(), list.end(), id);
    ATRIUM_CHECK(at != list.end()); // a node is always in its parent's list
    const auto index = std::size_t(std::distance(list.begin(), at));
    list.erase(at);
    return index;
}

// ---- one function per kind of edit; all checks before the first change ----

Result<SceneEdit> apply_one(Scene& scene, const AddNode& edit) {
    const std::string where = label("node", edit.node.name, edit.id);
    if (auto free = check_free(scene.nodes, "node", edit.node.name, edit.id); !free) {
        return tl::unexpected(free.error());
    }
    if (!edit.node.children.empty()) {
        return fail("", where, "a node is added without children", "Add them one by one after it");
    }
    if (edit.node.parent && !scene.nodes.contains(edit.node.parent)) {
        return unknown(where + ": parent " + node_label(scene, edit.node.parent), "node");
    }
    auto transform = checked_transform(where, edit.node.transform);
    if (!transform) {
        return tl::unexpected(transform.error());
    }
    if (auto parts = check_parts(scene, where, edit.node); !parts) {
        return tl::unexpected(parts.error());
    }
    if (auto wish = check_wish(where, edit.node.caustics); !wish) {
        return tl::unexpected(wish.error());
    }
    Node node = edit.node;
    node.transform = *transform;
    node.parent = node.parent ? node.parent : NodeId{}; // every way to write "none" becomes one
    ATRIUM_CHECK(scene.nodes.restore(edit.id, std::move(node)));
    insert_child(siblings_below(scene, edit.node.parent), edit.id, edit.index);
    return SceneEdit{RemoveNode{edit.id}};
}

Result<SceneEdit> apply_one(Scene& scene, const RemoveNode& edit) {
    const Node* top = scene.nodes.find(edit.id);
    if (top == nullptr) {
        return unknown(node_label(scene, edit.id), "node");
    }
    const std::vector<NodeId> subtree = scene.in_tree_order(edit.id);
    const std::size_t index = take_child(siblings_below(scene, top->parent), edit.id);
    EditGroup restore;
    restore.edits.reserve(subtree.size());
    for (const NodeId id : subtree) {
        AddNode add{id, std::move(*scene.nodes.find(id)), id == edit.id ? index : SIZE_MAX};
        add.node.children.clear(); // tree order brings them back one by one, each at the end of its parent's list
        restore.edits.push_back(SceneEdit{std::move(add)});
    }
    for (const NodeId id : subtree) {
        scene.nodes.erase(id);
    }
    return restore.edits.size() == 1 ? std::move(restore.edits.front()) : SceneEdit{std::move(restore)};
}

Result<SceneEdit> apply_one(Scene& scene, const SetTransform& edit) {
    Node* node = scene.nodes.find(edit.id);
    if (node == nullptr) {
        return unknown(node_label(scene, edit.id), "node");
    }
    auto transform = checked_transform(node_label(scene, edit.id), edit.transform);
    if (!transform) {
        return tl::unexpected(transform.error());
    }
    return SceneEdit{SetTransform{edit.id, std::exchange(node->transform, *transform)}};
}

Result<SceneEdit> apply_one(Scene& scene, const SetParent& edit) {
    Node* node = scene.nodes.find(edit.id);
    if (node == nullptr) {
        return unknown(node_label(scene, edit.id), "node");
    }
    const std::string where = node_label(scene, edit.id);
    if (edit.parent && !scene.nodes.contains(edit.parent)) {
        return unknown(where + ": new parent " + node_label(scene, edit.parent), "node");
    }
    for (NodeId up = edit.parent; const Node* above = scene.nodes.find(up); up = above->parent) {
        if (up == edit.id) {
            return fail("", where, "it cannot be moved below " + node_label(scene, edit.parent) + ", which is part of it");
        }
    }
    const NodeId old_parent = std::exchange(node->parent, edit.parent ? edit.parent : NodeId{});
    const std::size_t old_index = take_child(siblings_below(scene, old_parent), edit.id);
    insert_child(siblings_below(scene, edit.parent), edit.id, edit.index);
    return SceneEdit{SetParent{edit.id, old_parent, old_index}};
}

Result<SceneEdit> apply_one(Scene& scene, const SetNode& edit) {
    Node* node = scene.nodes.find(edit.id);
    if (node == nullptr) {
        return unknown(node_label(scene, edit.id), "node");
    }
    if (auto parts = check_parts(scene, node_label(scene, edit.id), edit.value); !parts) {
        return tl::unexpected(parts.error());
    }
    if (auto wish = check_wish(node_label(scene, edit.id), edit.value.caustics); !wish) {
        return tl::unexpected(wish.error());
    }
    Node value = edit.value;
    value.parent = node->parent;
    value.children = node->children;
    value.transform = node->transform;
    SetNode inverse{edit.id, std::exchange(*node, std::move(value))};
    inverse.value.children.clear(); // not part of this edit
    return SceneEdit{std::move(inverse)};
}

Result<SceneEdit> apply_one(Scene& scene, const SetEnvironment& edit) {
    if (!is_finite(edit.value.sky_radiance)) {
        return fail("", "environment", "the sky's radiance is not a finite number");
    }
    return SceneEdit{SetEnvironment{std::exchange(scene.environment, edit.value)}};
}

Result<SceneEdit> apply_one(Scene& scene, const SetSolverSettings& edit) {
    return SceneEdit{SetSolverSettings{std::exchange(scene.settings, edit.value)}};
}

/// A shape that loses parts must not leave nodes with more materials than parts: their undo would be refused.
Result<void> check_users(const Scene& scene, ShapeId id, const std::string& where, const Shape& value) {
    Result<void> out;
    scene.nodes.for_each([&](NodeId user, const Node& node) {
        if (out && node.shape == id && node.materials.size() > part_count(value)) {
            out = fail("", where,
                       "its " + std::to_string(part_count(value)) + " parts are fewer than the materials of " +
                           node_label(scene, user),
                       "Shorten that node's materials first");
        }
    });
    return out;
}
template <class T> Result<void> check_users(const Scene&, Id<T>, const std::string&, const T&) { return {}; }

template <class T> Result<SceneEdit> apply_one(Scene& scene, const AddResource<T>& edit) {
    using Traits = ResourceTraits<T>;
    SlotMap<T>& map = Traits::map(scene);
    const std::string where = label(Traits::kName, edit.value.name, edit.id);
    auto good = check_free(map, Traits::kName, edit.value.name, edit.id);
    if (good) {
        good = check_value(where, edit.value);
    }
    if (good) {
        good = check_users(scene, edit.id, where, edit.value);
    }
    if (!good) {
        return tl::unexpected(good.error());
    }
    ATRIUM_CHECK(map.restore(edit.id, edit.value));
    return SceneEdit{RemoveResource<T>{edit.id}};
}

template <class T> Result<SceneEdit> apply_one(Scene& scene, const RemoveResource<T>& edit) {
    SlotMap<T>& map = ResourceTraits<T>::map(scene);
    T* value = map.find(edit.id);
    if (value == nullptr) {
        return unknown(label(ResourceTraits<T>::kName, {}, edit.id), ResourceTraits<T>::kName);
    }
    AddResource<T> inverse{edit.id, std::move(*value)};
    map.erase(edit.id);
    return SceneEdit{std::move(inverse)};
}

template <class T> Result<SceneEdit> apply_one(Scene& scene, const SetResource<T>& edit) {
    T* value = ResourceTraits<T>::map(scene).find(edit.id);
    if (value == nullptr) {
        return unknown(label(ResourceTraits<T>::kName, edit.value.name, edit.id), ResourceTraits<T>::kName);
    }
    const std::string where = label(ResourceTraits<T>::kName, value->name, edit.id);
    auto good = check_value(where, edit.value);
    if (good) {
        good = check_users(scene, edit.id, where, edit.value);
    }
    if (!good) {
        return tl::unexpected(good.error());
    }
    return SceneEdit{SetResource<T>{edit.id, std::exchange(*value, edit.value)}};
}

Result<SceneEdit> apply_one(Scene& scene, const EditGroup& group) {
    EditGroup inverse;
    inverse.edits.reserve(group.edits.size());
    for (const SceneEdit& edit : group.edits) {
        auto undo = apply(scene, edit);
        if (!undo) {
            for (auto it = inverse.edits.rbegin(); it != inverse.edits.rend(); ++it) {
                ATRIUM_CHECK(apply(scene, *it).has_value());
            }
            return undo;
        }
        inverse.edits.push_back(std::move(*undo));
    }
    std::reverse(inverse.edits.begin(), inverse.edits.end());
    return SceneEdit{std::move(inverse)};
}

template <class E> constexpr bool kSetsOneTarget = false;
template <> constexpr bool kSetsOneTarget<SetTransform> = true;
template <> constexpr bool kSetsOneTarget<SetNode> = true;
template <class T> constexpr bool kSetsOneTarget<SetResource<T>> = true;

} // namespace

Result<SceneEdit> apply(Scene& scene, const SceneEdit& edit) {
    return std::visit([&](const auto& e) { return apply_one(scene, e); }, edit.value);
}

bool supersedes(const SceneEdit& later, const SceneEdit& earlier) {
    if (later.value.index() != earlier.value.index()) {
        return false;
    }
    return std::visit(
        [&](const auto& l) {
            using E = std::decay_t<decltype(l)>;
            const E& e = std::get<E>(earlier.value);
            if constexpr (kSetsOneTarget<E>) {
                return l.id == e.id;
            } else if constexpr (std::is_same_v<E, SetEnvironment> || std::is_same_v<E, SetSolverSettings>) {
                return true;
            } else if constexpr (std::is_same_v<E, EditGroup>) {
                // Several things dragged at once: the same targets in the same order, nothing more on either side.
                return !l.edits.empty() &&
                       std::equal(l.edits.begin(), l.edits.end(), e.edits.begin(), e.edits.end(),
                                  [](const SceneEdit& a, const SceneEdit& b) { return supersedes(a, b); });
            } else {
                return false;
            }
        },
        later.value);
}

} // namespace atrium
