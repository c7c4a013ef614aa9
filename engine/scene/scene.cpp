#include "engine/scene/scene.h"

#include <algorithm>

namespace atrium {

dmat4 Transform::matrix() const {
    const dmat3 r = glm::mat3_cast(rotation);
    return dmat4(dvec4(r[0] * scale.x, 0.0), dvec4(r[1] * scale.y, 0.0), dvec4(r[2] * scale.z, 0.0),
                 dvec4(translation, 1.0));
}

dmat4 Scene::world_matrix(NodeId id) const {
    dmat4 m(1.0);
    for (const Node* node = nodes.find(id); node != nullptr; node = nodes.find(node->parent)) {
        m = node->transform.matrix() * m;
    }
    return m;
}

bool Scene::shown(NodeId id) const {
    for (const Node* node = nodes.find(id); node != nullptr; node = nodes.find(node->parent)) {
        if (!node->visible) {
            return false;
        }
    }
    return true;
}

const Material* Scene::material_of(const Node& node, std::size_t part) const {
    return part < node.materials.size() ? materials.find(node.materials[part]) : nullptr;
}

DBox3 Scene::world_bounds(NodeId id) const {
    DBox3 out;
    const Node* node = nodes.find(id);
    const Shape* shape = node != nullptr ? shapes.find(node->shape) : nullptr;
    if (shape == nullptr) {
        return out;
    }
    const Box3 local = local_bounds(shape->geometry);
    if (local.empty()) {
        return out;
    }
    const dmat4 m = world_matrix(id);
    for (int corner = 0; corner < 8; ++corner) {
        const dvec3 p((corner & 1) != 0 ? local.max.x : local.min.x, (corner & 2) != 0 ? local.max.y : local.min.y,
                      (corner & 4) != 0 ? local.max.z : local.min.z);
        out.add(dvec3(m * dvec4(p, 1.0)));
    }
    return out;
}

DBox3 Scene::subtree_bounds(NodeId id) const {
    DBox3 out;
    for (const NodeId child : in_tree_order(id)) {
        const DBox3 b = world_bounds(child);
        if (!b.empty()) {
            out.add(b);
        }
    }
    return out;
}

DBox3 Scene::bounds() const {
    DBox3 out;
    nodes.for_each([&](NodeId id, const Node& node) {
        if (node.shape && shown(id)) {
            const DBox3 b = world_bounds(id);
            if (!b.empty()) {
                out.add(b);
            }
        }
    });
    return out;
}

std::vector<NodeId> Scene::in_tree_order(NodeId root) const {
    std::vector<NodeId> out;
    std::vector<NodeId> stack;
    if (root) {
        stack.push_back(root);
    } else {
        stack.assign(roots.rbegin(), roots.rend());
    }
    while (!stack.empty()) {
        const NodeId id = stack.back();
        stack.pop_back();
        const Node* node = nodes.find(id);
        if (node == nullptr) {
            continue;
        }
        out.push_back(id);
        stack.insert(stack.end(), node->children.rbegin(), node->children.rend());
    }
    return out;
}

const Material& default_material() {
    static const Material material = [] {
        Material m;
        m.name = "Default";
        return m;
    }();
    return material;
}

Transform decompose(const dmat4& matrix, bool* exact) {
    Transform t;
    t.translation = dvec3(matrix[3]);
    dmat3 m(matrix);
    t.scale = dvec3(glm::length(m[0]), glm::length(m[1]), glm::length(m[2]));
    if (glm::determinant(m) < 0.0) {
        t.scale.x = -t.scale.x;
    }
    const double largest = std::max({std::abs(t.scale.x), t.scale.y, t.scale.z});
    bool is_exact = true;
    // A vanished axis leaves its direction open: any unit vector completes the frame.
    dmat3 r(1.0);
    if (largest > 0.0) {
        for (int i = 0; i < 3; ++i) {
            r[i] = t.scale[i] != 0.0 ? m[i] / t.scale[i] : dvec3(0.0);
        }
        for (int i = 0; i < 3; ++i) {
            if (t.scale[i] == 0.0) {
                dvec3 c = glm::cross(r[(i + 1) % 3], r[(i + 2) % 3]);
                const double length = glm::length(c);
                r[i] = length > 1e-12 ? c / length : dvec3(i == 0, i == 1, i == 2);
            }
        }
        const double skew =
            std::max({std::abs(glm::dot(r[0], r[1])), std::abs(glm::dot(r[1], r[2])), std::abs(glm::dot(r[2], r[0]))});
        is_exact = skew < 1e-5;
        // Gram-Schmidt: the nearest rotation that keeps the first axis.
        r[1] = glm::normalize(r[1] - r[0] * glm::dot(r[0], r[1]));
        r[2] = glm::cross(r[0], r[1]);
        t.rotation = glm::normalize(glm::quat_cast(r));
    }
    if (exact != nullptr) {
        *exact = is_exact;
    }
    return t;
}

} // namespace atrium
