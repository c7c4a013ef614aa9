#include "ui/document/placement_frame.h"

#include "engine/scene/edit_tools.h"

#include <algorithm>
#include <unordered_map>

namespace atrium::ui {
namespace {

/// Nodes that were placed already, over those of a scene.
using Placed = std::unordered_map<NodeId, Transform>;

dmat4 parent_matrix(const Scene& scene, const Placed& placed, const Node& child) {
    dmat4 m(1.0);
    NodeId id = child.parent;
    for (const Node* node = scene.nodes.find(id); node != nullptr; node = scene.nodes.find(id)) {
        const auto it = placed.find(id);
        m = (it == placed.end() ? node->transform : it->second).matrix() * m;
        id = node->parent;
    }
    return m;
}

int depth_of(const Scene& scene, NodeId id) {
    int out = 0;
    for (const Node* node = scene.nodes.find(id); node != nullptr; node = scene.nodes.find(node->parent)) {
        ++out;
    }
    return out;
}

/// A parent's frame as numbers go in and out of it.
struct Frame {
    Frame(const dmat4& parent, bool is_root, PlacementFrame frame)
        : plain_(is_root), world_(frame == PlacementFrame::World) {
        if (!plain_) {
            linear_ = dmat3(parent);
            origin_ = dvec3(parent[3]);
            turn_ = decompose(parent).rotation;
        }
    }
    [[nodiscard]] dvec3 out(const dvec3& own) const {
        return plain_ ? own : world_ ? origin_ + linear_ * own : own * lengths();
    }
    /// The step in the parent's own numbers; none where the parent has no extent along it.
    [[nodiscard]] dvec3 step_in(const dvec3& step) const {
        if (plain_) {
            return step;
        }
        const dvec3 own = world_ ? glm::inverse(linear_) * step : step / lengths();
        return glm::all(glm::lessThan(glm::abs(own), dvec3(1e30))) ? own : dvec3(0.0); // false for what is not a number
    }
    [[nodiscard]] dquat out(const dquat& own) const { return plain_ || !world_ ? own : turn_ * own; }
    [[nodiscard]] dquat in(const dquat& told) const {
        return plain_ || !world_ ? told : glm::normalize(glm::inverse(turn_) * told);
    }

private:
    [[nodiscard]] dvec3 lengths() const {
        return {glm::length(linear_[0]), glm::length(linear_[1]), glm::length(linear_[2])};
    }
    bool plain_;
    bool world_;
    dmat3 linear_{1.0};
    dvec3 origin_{0.0};
    dquat turn_{1.0, 0.0, 0.0, 0.0};
};

Frame frame_of(const Scene& scene, const Placed& placed, const Node& node, PlacementFrame frame) {
    const bool root = !scene.nodes.contains(node.parent);
    return {root ? dmat4(1.0) : parent_matrix(scene, placed, node), root, frame};
}

} // namespace

FramedPlacement placement_in(const Scene& scene, NodeId id, PlacementFrame frame) {
    const Node& node = *scene.nodes.find(id);
    const Frame in = frame_of(scene, {}, node, frame);
    return {in.out(node.transform.translation), in.out(node.transform.rotation)};
}

SceneEdit place_nodes(const Scene& scene, const std::vector<NodeId>& nodes, PlacementFrame frame,
                      const std::function<void(FramedPlacement&, NodeId)>& change) {
    std::vector<NodeId> order = nodes;
    std::stable_sort(order.begin(), order.end(),
                     [&](NodeId a, NodeId b) { return depth_of(scene, a) < depth_of(scene, b); });
    Placed placed;
    std::vector<SceneEdit> edits;
    for (const NodeId id : order) {
        const Node& node = *scene.nodes.find(id);
        const Frame in = frame_of(scene, placed, node, frame);
        Transform transform = node.transform;
        const FramedPlacement before{in.out(transform.translation), in.out(transform.rotation)};
        FramedPlacement after = before;
        change(after, id);
        if (after.position != before.position) {
            transform.translation += in.step_in(after.position - before.position);
        }
        if (after.rotation != before.rotation) {
            transform.rotation = in.in(after.rotation);
        }
        placed[id] = transform;
        edits.push_back(SceneEdit{SetTransform{id, transform}});
    }
    return as_one(std::move(edits));
}

} // namespace atrium::ui
