// glTF nodes of the scene to show -> Node, in tree order; instances and sheared transforms are expanded here.
#include "engine/io/gltf_accessor.h"
#include "engine/io/gltf_extensions.h"
#include "engine/io/gltf_read_context.h"

#include <fmt/format.h>
#include <optional>
#include <tiny_gltf.h>

namespace atrium::gltf {
namespace {

constexpr std::uint64_t kMaxDrawnTriangles = 20'000'000;

class NodeReader {
public:
    explicit NodeReader(ReadContext& context) : context_(context), nodes_(section(context.root, "nodes")) {}
    void read();

private:
    /// One node still to be made. `before` is what its parent's translate-rotate-scale could not express.
    struct Pending {
        int node;
        NodeId parent;
        dmat4 before;
        bool has_before;
    };
    std::vector<int> root_nodes();
    void check_budget(const std::vector<int>& roots);
    void make_node(const Pending& pending, std::vector<Pending>& stack);
    void attach(const Json& json, Node& node, int index);
    /// Sets the transform of a node; returns the residual of a sheared matrix.
    std::optional<dmat4> place_node(Node& node, const dmat4& matrix, const std::string& where);
    void show_mesh(Node& node, int mesh, const std::optional<dmat4>& residual);
    void make_instances(const Json& instancing, int mesh, NodeId parent, const std::optional<dmat4>& before,
                        const std::string& where);
    std::size_t instance_count(const Json& instancing, const std::string& where) const;
    NodeId insert(Node node);

    ReadContext& context_;
    const Json& nodes_;
    std::vector<bool> made_;
};

Transform transform_of(ReadContext& context, const tinygltf::Node& node, const std::string& where) {
    Transform t;
    if (node.translation.size() == 3) {
        t.translation = {node.translation[0], node.translation[1], node.translation[2]};
    }
    if (node.scale.size() == 3) {
        t.scale = {node.scale[0], node.scale[1], node.scale[2]};
    }
    if (node.rotation.size() == 4) {
        t.rotation = dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double square = glm::dot(t.rotation, t.rotation);
        if (square < 1e-12) {
            context.warn(where, "a rotation without direction was left out");
            t.rotation = dquat(1.0, 0.0, 0.0, 0.0);
        } else if (std::abs(square - 1.0) > 1e-12) {
            if (std::abs(square - 1.0) > 1e-3) {
                context.warn(where, "a rotation that was not of unit length was normalised");
            }
            t.rotation /= std::sqrt(square);
        }
    }
    return t;
}

dmat4 matrix_of(ReadContext& context, const std::vector<double>& values, const std::string& where) {
    dmat4 m;
    for (int i = 0; i < 16; ++i) {
        m[i / 4][i % 4] = values[std::size_t(i)];
    }
    if (std::abs(m[0].w) + std::abs(m[1].w) + std::abs(m[2].w) + std::abs(m[3].w - 1.0) > 1e-6) {
        context.warn(where, "the last row of its matrix is not 0 0 0 1 and was replaced by that");
    }
    m[0].w = m[1].w = m[2].w = 0.0;
    m[3].w = 1.0;
    return m;
}

/// What was set by hand about caustics. What this version does not know is automatic: it only decides how light is shown.
CausticWish wish_of(ReadContext& context, const Json& json, const std::string& where) {
    CausticWish wish;
    const std::string show = text(json, "show", where);
    if (show == caustic_show_name(CausticWish::Show::Mesh)) {
        wish.show = CausticWish::Show::Mesh;
    } else if (show == caustic_show_name(CausticWish::Show::Texture)) {
        wish.show = CausticWish::Show::Texture;
    } else if (!show.empty() && show != caustic_show_name(CausticWish::Show::Automatic)) {
        context.warn(where, "\"" + show + "\" is no way to show caustics that this version knows; they are automatic");
    }
    const auto length = [&](const char* key) {
        const double value = number(json, key, 0.0, where);
        if (value < 0.0) {
            context.warn(where, std::string("\"") + key + "\" is below zero and was left out");
            return 0.0F;
        }
        return float(value);
    };
    wish.texel = length("texel");
    wish.threshold = length("threshold");
    return wish;
}

/// Copy of a mesh with a linear residual applied to every vertex.
std::shared_ptr<const MeshData> baked(const MeshData& mesh, const dmat4& residual) {
    auto out = std::make_shared<MeshData>(mesh);
    for (vec3& p : out->positions) {
        p = vec3(residual * dvec4(p, 1.0));
    }
    const dmat3 normal_matrix = glm::transpose(glm::inverse(dmat3(residual)));
    for (vec3& n : out->normals) {
        const dvec3 turned = normal_matrix * dvec3(n);
        const double length = glm::length(turned);
        n = length > 0.0 ? vec3(turned / length) : n;
    }
    return out;
}

std::vector<int> NodeReader::root_nodes() {
    const Json& scenes = section(context_.root, "scenes");
    std::vector<int> roots;
    if (scenes.empty()) {
        std::vector<bool> is_child(nodes_.size(), false);
        for (const tinygltf::Node& node : context_.model.nodes) {
            for (const int child : node.children) {
                is_child[std::size_t(child)] = true;
            }
        }
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            if (!is_child[i]) {
                roots.push_back(int(i));
            }
        }
        return roots;
    }
    std::size_t chosen = 0;
    if (const Json* wish = find(context_.root, "scene")) {
        if (wish->is_number_unsigned() && wish->get<std::size_t>() < scenes.size()) {
            chosen = wish->get<std::size_t>();
        } else {
            context_.warn("scene", "the default scene does not exist; the first one is shown");
        }
    }
    if (scenes.size() > 1) {
        context_.note(
            place(context_.root, "scenes", chosen),
            fmt::format("the file holds {} scenes; this one is shown, and saving keeps this one only", scenes.size()));
    }
    context_.out.scene.name = text(scenes[chosen], "name", "scenes");
    if (const Json* list = find_array(scenes[chosen], "nodes", "scenes")) {
        for (const Json& node : *list) {
            roots.push_back(node.get<int>());
        }
    }
    return roots;
}

std::size_t NodeReader::instance_count(const Json& instancing, const std::string& where) const {
    const Json* attributes = find_object(instancing, "attributes", where);
    const std::size_t accessors = context_.model.accessors.size();
    std::size_t count = 0;
    if (attributes != nullptr) {
        for (const auto& [name, value] : attributes->items()) {
            const int accessor = index(*attributes, name.c_str(), accessors, where);
            const std::size_t n = context_.model.accessors[std::size_t(accessor)].count;
            if (count != 0 && n != count) {
                refuse(where, "the attributes of its instances differ in number");
            }
            count = n;
        }
    }
    return count;
}

/// A few bytes can ask for thousands of millions of triangles by instancing: counted before anything is expanded.
void NodeReader::check_budget(const std::vector<int>& roots) {
    std::uint64_t drawn = 0;
    std::vector<int> stack = roots;
    std::vector<bool> seen(nodes_.size(), false);
    while (!stack.empty()) {
        const auto i = std::size_t(stack.back());
        stack.pop_back();
        if (seen[i]) {
            continue;
        }
        seen[i] = true;
        const tinygltf::Node& node = context_.model.nodes[i];
        if (node.mesh >= 0) {
            const std::string where = place(context_.root, "nodes", i);
            const Json* instancing = find_extension(nodes_[i], kInstancing);
            const std::uint64_t instances = instancing != nullptr ? instance_count(*instancing, where) : 1;
            context_.budget.charge(instances * (sizeof(Node) + 64), where);
            drawn += instances * context_.meshes[std::size_t(node.mesh)].triangles;
            if (drawn > kMaxDrawnTriangles) {
                refuse(where,
                       fmt::format("with it the scene draws more than {} million triangles", kMaxDrawnTriangles / 1000000),
                       "Simplify the model or leave out repeated objects.");
            }
        }
        stack.insert(stack.end(), node.children.begin(), node.children.end());
    }
}

NodeId NodeReader::insert(Node node) {
    Scene& scene = context_.out.scene;
    const auto is_usable = [](const dvec3& v) { return is_finite(v) && glm::length(v) < 1e30; };
    if (!is_usable(node.transform.translation) || !is_usable(node.transform.scale)) {
        refuse("node " + node.name, "its placement holds a number that is too large");
    }
    const NodeId parent = node.parent;
    const NodeId id = scene.nodes.insert(std::move(node));
    if (Node* above = scene.nodes.find(parent)) {
        above->children.push_back(id);
    } else {
        scene.roots.push_back(id);
    }
    return id;
}

std::optional<dmat4> NodeReader::place_node(Node& node, const dmat4& matrix, const std::string& where) {
    bool exact = true;
    node.transform = decompose(matrix, &exact);
    if (exact) {
        return std::nullopt;
    }
    const dmat4 placed = node.transform.matrix();
    if (std::abs(glm::determinant(dmat3(placed))) < 1e-30) {
        context_.warn(where, "its matrix is flat and sheared; the nearest placement is shown");
        return std::nullopt;
    }
    context_.warn(where, "its placement is sheared; the shear was worked into a copy of the geometry",
                  "The picture is the same, but the copy no longer shares its shape.");
    return glm::inverse(placed) * matrix;
}

void NodeReader::show_mesh(Node& node, int mesh, const std::optional<dmat4>& residual) {
    const ReadContext::LoadedMesh& loaded = context_.meshes[std::size_t(mesh)];
    if (!loaded.shape) {
        return;
    }
    node.shape = loaded.shape;
    node.materials = loaded.materials;
    if (residual) {
        const Shape& original = *context_.out.scene.shapes.find(loaded.shape);
        context_.budget.charge(loaded.triangles * 128, node.name);
        Shape copy{original.name, Mesh{baked(*loaded.stand_in.data, *residual)}, original.extras};
        // The stand-in of a high-level primitive has one part per face kind; all of them show the primitive's material.
        node.materials.resize(part_count(copy), loaded.materials.empty() ? MaterialId{} : loaded.materials.front());
        node.shape = context_.out.scene.shapes.insert(std::move(copy));
    }
}

void NodeReader::make_instances(const Json& instancing, int mesh, NodeId parent, const std::optional<dmat4>& before,
                                const std::string& where) {
    const Json none = Json::object();
    const Json* found = find_object(instancing, "attributes", where);
    const Json& attributes = found != nullptr ? *found : none;
    const std::size_t count = instance_count(instancing, where);
    const auto read = [&](const char* key, std::size_t components) {
        const int accessor = index(attributes, key, context_.model.accessors.size(), where);
        FloatElements out = accessor >= 0 ? read_floats(context_, accessor) : FloatElements{};
        if (accessor >= 0 && out.components != components) {
            refuse(where + "/" + key, fmt::format("has {} numbers per instance, not {}", out.components, components));
        }
        return out;
    };
    const FloatElements translation = read("TRANSLATION", 3);
    const FloatElements rotation = read("ROTATION", 4);
    const FloatElements scale = read("SCALE", 3);
    const std::string name = context_.out.scene.nodes.find(parent)->name;
    for (std::size_t i = 0; i < count; ++i) {
        Node node;
        node.parent = parent;
        node.name = (name.empty() ? "Instance" : name) + " " + std::to_string(i + 1);
        tinygltf::Node values;
        const auto copy = [i](const FloatElements& from, std::vector<double>& to) {
            const float* first = from.values.data() + i * from.components;
            to.assign(first, first + from.components);
        };
        copy(translation, values.translation);
        copy(rotation, values.rotation);
        copy(scale, values.scale);
        node.transform = transform_of(context_, values, where);
        std::optional<dmat4> residual;
        if (before) {
            residual = place_node(node, *before * node.transform.matrix(), where);
        }
        show_mesh(node, mesh, residual);
        insert(std::move(node));
    }
    context_.note(where, fmt::format("{} instances became nodes of their own", count));
}

void NodeReader::attach(const Json& json, Node& node, int index_of_node) {
    const std::string where = place(context_.root, "nodes", std::size_t(index_of_node));
    const tinygltf::Node& gltf = context_.model.nodes[std::size_t(index_of_node)];
    if (gltf.camera >= 0) {
        node.camera = context_.cameras[std::size_t(gltf.camera)];
    }
    if (const Json* light = find_extension(json, kLightsPunctual)) {
        const int i = index(*light, "light", context_.lights.size(), where);
        node.light = i >= 0 ? context_.lights[std::size_t(i)] : LightId{};
    }
    node.light = node_photometry(context_, json, node.light, where);
    if (const Json* visibility = find_extension(json, kNodeVisibility)) {
        node.visible = boolean(*visibility, "visible", true, where);
    }
    if (const Json* ours = find_extension(json, kNode)) {
        node.visible = boolean(*ours, "visible", node.visible, where);
        node.locked = boolean(*ours, "locked", false, where);
        if (const Json* caustics = find_object(*ours, "caustics", where)) {
            node.caustics = wish_of(context_, *caustics, where + "/caustics");
        }
    }
    if (gltf.skin >= 0) {
        context_.count("meshes are bound to a skeleton: they are shown in their rest pose, and the skeleton is not saved");
    }
    if (json.contains("weights")) {
        context_.count("nodes set morph target weights of their own, which are ignored");
    }
}

void NodeReader::make_node(const Pending& pending, std::vector<Pending>& stack) {
    const auto i = std::size_t(pending.node);
    const std::string where = place(context_.root, "nodes", i);
    if (made_[i]) {
        context_.warn(where, "appears twice in the scene; the second one was left out");
        return;
    }
    made_[i] = true;
    const Json& json = nodes_[i];
    const tinygltf::Node& gltf = context_.model.nodes[i];
    Node node;
    node.parent = pending.parent;
    node.name = text(json, "name", where);
    node.extras = json_text(json, "extras");
    std::optional<dmat4> residual;
    if (gltf.matrix.size() == 16 || pending.has_before) {
        const dmat4 own = gltf.matrix.size() == 16 ? matrix_of(context_, gltf.matrix, where)
                                                   : transform_of(context_, gltf, where).matrix();
        residual = place_node(node, pending.before * own, where);
    } else {
        node.transform = transform_of(context_, gltf, where);
    }
    attach(json, node, pending.node);
    const Json* instancing = gltf.mesh >= 0 ? find_extension(json, kInstancing) : nullptr;
    if (gltf.mesh >= 0 && instancing == nullptr) {
        show_mesh(node, gltf.mesh, residual);
    }
    const NodeId id = insert(std::move(node));
    if (instancing != nullptr) {
        make_instances(*instancing, gltf.mesh, id, residual, where);
    }
    for (auto child = gltf.children.rbegin(); child != gltf.children.rend(); ++child) {
        stack.push_back({*child, id, residual.value_or(dmat4(1.0)), residual.has_value()});
    }
}

void NodeReader::read() {
    const std::vector<int> roots = root_nodes();
    check_budget(roots);
    made_.assign(nodes_.size(), false);
    std::vector<Pending> stack;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
        stack.push_back({*root, {}, dmat4(1.0), false});
    }
    while (!stack.empty()) {
        const Pending pending = stack.back();
        stack.pop_back();
        make_node(pending, stack);
    }
}

} // namespace

void read_nodes(ReadContext& context) { NodeReader(context).read(); }

} // namespace atrium::gltf
