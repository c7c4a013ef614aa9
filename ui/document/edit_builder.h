// Puts several edits together into one, each made for the scene as the edits before it leave it.
#pragma once

#include "engine/scene/edit_tools.h"
#include "engine/scene/scene_edit.h"

#include <utility>
#include <vector>

namespace atrium::ui {

/// Collects edits while applying them to a copy, so that each new id is free given the edits before it.
class EditBuilder {
public:
    explicit EditBuilder(const Scene& scene) : scratch_(scene) {}
    [[nodiscard]] const Scene& scene() const { return scratch_; }
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

} // namespace atrium::ui
