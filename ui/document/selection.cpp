#include "ui/document/selection.h"

#include <algorithm>

namespace atrium::ui {

bool Selection::contains(NodeId id) const { return std::find(nodes_.begin(), nodes_.end(), id) != nodes_.end(); }

void Selection::set(std::vector<NodeId> nodes) {
    std::vector<NodeId> unique;
    unique.reserve(nodes.size());
    // The last mention decides the place, so that the last one given stays the active one.
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto rest = nodes.begin() + std::ptrdiff_t(i) + 1;
        if (nodes[i] && std::find(rest, nodes.end(), nodes[i]) == nodes.end()) {
            unique.push_back(nodes[i]);
        }
    }
    if (unique != nodes_) {
        nodes_ = std::move(unique);
        Q_EMIT changed();
    }
}

void Selection::toggle(NodeId id) {
    std::vector<NodeId> next = nodes_;
    const auto it = std::find(next.begin(), next.end(), id);
    if (it != next.end()) {
        next.erase(it);
    } else {
        next.push_back(id);
    }
    set(std::move(next));
}

std::vector<NodeId> Selection::top_level(const Scene& scene) const {
    std::vector<NodeId> out;
    for (const NodeId id : nodes_) {
        const Node* node = scene.nodes.find(id);
        if (node == nullptr) {
            continue;
        }
        bool below_selected = false;
        for (const Node* above = scene.nodes.find(node->parent); above != nullptr && !below_selected;) {
            below_selected = contains(node->parent);
            node = above;
            above = scene.nodes.find(node->parent);
        }
        if (!below_selected) {
            out.push_back(id);
        }
    }
    return out;
}

} // namespace atrium::ui
