#include "engine/scene/edit_tools.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace atrium {

namespace {

template <class T> const SlotMap<T>& pool(const Scene& scene) {
    if constexpr (std::is_same_v<T, Shape>) {
        return scene.shapes;
    } else if constexpr (std::is_same_v<T, Material>) {
        return scene.materials;
    } else if constexpr (std::is_same_v<T, Texture>) {
        return scene.textures;
    } else if constexpr (std::is_same_v<T, Light>) {
        return scene.lights;
    } else {
        return scene.cameras;
    }
}

template <class T> bool same_resource(const Scene& scene, const SetResource<T>& edit) {
    const T* old = pool<T>(scene).find(edit.id);
    return old != nullptr && *old == edit.value;
}

struct Null {
    const Scene& scene;
    bool operator()(const SetTransform& e) const {
        const Node* node = scene.nodes.find(e.id);
        return node != nullptr && node->transform == e.transform;
    }
    bool operator()(const SetNode& e) const {
        const Node* node = scene.nodes.find(e.id);
        if (node == nullptr) {
            return false;
        }
        Node value = e.value; // what SetNode leaves alone must not count
        value.parent = node->parent;
        value.children = node->children;
        value.transform = node->transform;
        return value == *node;
    }
    bool operator()(const SetEnvironment& e) const { return scene.environment == e.value; }
    bool operator()(const SetSolverSettings& e) const { return scene.settings == e.value; }
    template <class T> bool operator()(const SetResource<T>& e) const { return same_resource(scene, e); }
    bool operator()(const EditGroup& e) const {
        return std::all_of(e.edits.begin(), e.edits.end(),
                           [this](const SceneEdit& edit) { return changes_nothing(scene, edit); });
    }
    template <class T> bool operator()(const T&) const { return false; }
};

struct ReplacesValue {
    bool operator()(const SetTransform&) const { return true; }
    bool operator()(const SetNode&) const { return true; }
    bool operator()(const SetEnvironment&) const { return true; }
    bool operator()(const SetSolverSettings&) const { return true; }
    template <class T> bool operator()(const SetResource<T>&) const { return true; }
    template <class T> bool operator()(const T&) const { return false; }
};

} // namespace

bool changes_nothing(const Scene& scene, const SceneEdit& edit) { return std::visit(Null{scene}, edit.value); }

bool replaces_value(const SceneEdit& edit) { return std::visit(ReplacesValue{}, edit.value); }

SceneEdit as_one(std::vector<SceneEdit> edits) {
    if (edits.size() == 1) {
        return std::move(edits.front());
    }
    return SceneEdit{EditGroup{std::move(edits)}};
}

void GestureEdits::absorb(const SceneEdit& edit, const SceneEdit& inverse) {
    // A group whose inverse has the same parts in reverse is kept part by part, so that dragging several objects merges too.
    const auto* group = std::get_if<EditGroup>(&edit.value);
    const auto* undo_group = std::get_if<EditGroup>(&inverse.value);
    if (group != nullptr && undo_group != nullptr && group->edits.size() == undo_group->edits.size()) {
        for (std::size_t i = 0; i < group->edits.size(); ++i) {
            absorb_one(group->edits[i], undo_group->edits[group->edits.size() - 1 - i]);
        }
    } else {
        absorb_one(edit, inverse);
    }
}

void GestureEdits::absorb_one(const SceneEdit& edit, const SceneEdit& inverse) {
    if (replaces_value(edit)) {
        for (std::size_t i = done_.size(); i-- > 0;) {
            if (supersedes(edit, done_[i])) {
                done_[i] = edit; // its inverse already leads back to the start of the gesture
                return;
            }
            if (!replaces_value(done_[i])) {
                break; // never move an edit across one that makes or removes what it refers to
            }
        }
    }
    done_.push_back(edit);
    inverse_.push_back(inverse);
}

UndoEntry GestureEdits::take() {
    std::reverse(inverse_.begin(), inverse_.end());
    return {as_one(std::exchange(done_, {})), as_one(std::exchange(inverse_, {}))};
}

} // namespace atrium
