#include "engine/session/edit_mailbox.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace atrium {
namespace {

/// What an edit writes. A node's placement and its other values are separate: edits of one commute with edits of the other.
enum class Aspect : std::uint8_t { Placement, NodeValue, Environment, Settings, Resource };
struct Target {
    Aspect aspect;
    std::size_t resource_kind; ///< index of the resource's Set edit in the variant; 0 for the other aspects
    std::uint64_t key;
    friend bool operator==(const Target&, const Target&) = default;
};

template <class T> constexpr std::size_t kResourceKind = 0;
template <> constexpr std::size_t kResourceKind<Shape> = 1;
template <> constexpr std::size_t kResourceKind<Material> = 2;
template <> constexpr std::size_t kResourceKind<Texture> = 3;
template <> constexpr std::size_t kResourceKind<Light> = 4;
template <> constexpr std::size_t kResourceKind<Camera> = 5;

void collect(const SceneEdit& edit, std::vector<Target>& out);

void collect_one(const SetTransform& e, std::vector<Target>& out) { out.push_back({Aspect::Placement, 0, e.id.key()}); }
void collect_one(const SetNode& e, std::vector<Target>& out) { out.push_back({Aspect::NodeValue, 0, e.id.key()}); }
void collect_one(const AddNode& e, std::vector<Target>& out) {
    out.push_back({Aspect::Placement, 0, e.id.key()});
    out.push_back({Aspect::NodeValue, 0, e.id.key()});
}
// Nodes below the removed one need no mention: whoever edits one of them later must have brought it back before, and the
// AddNode that did so names it.
void collect_one(const RemoveNode& e, std::vector<Target>& out) {
    out.push_back({Aspect::Placement, 0, e.id.key()});
    out.push_back({Aspect::NodeValue, 0, e.id.key()});
}
// Placement is relative to the parent, whichever it is, so a change of parent commutes with everything that is merged.
void collect_one(const SetParent& /*e*/, std::vector<Target>& /*out*/) {}
void collect_one(const SetEnvironment& /*e*/, std::vector<Target>& out) { out.push_back({Aspect::Environment, 0, 0}); }
void collect_one(const SetSolverSettings& /*e*/, std::vector<Target>& out) { out.push_back({Aspect::Settings, 0, 0}); }
template <class T> void collect_one(const AddResource<T>& e, std::vector<Target>& out) {
    out.push_back({Aspect::Resource, kResourceKind<T>, e.id.key()});
}
template <class T> void collect_one(const RemoveResource<T>& e, std::vector<Target>& out) {
    out.push_back({Aspect::Resource, kResourceKind<T>, e.id.key()});
}
template <class T> void collect_one(const SetResource<T>& e, std::vector<Target>& out) {
    out.push_back({Aspect::Resource, kResourceKind<T>, e.id.key()});
}
void collect_one(const EditGroup& e, std::vector<Target>& out) {
    for (const SceneEdit& edit : e.edits) {
        collect(edit, out);
    }
}
void collect(const SceneEdit& edit, std::vector<Target>& out) {
    std::visit([&](const auto& e) { collect_one(e, out); }, edit.value);
}

std::vector<Target> targets_of(const SceneEdit& edit) {
    std::vector<Target> out;
    collect(edit, out);
    return out;
}
bool disjoint(const std::vector<Target>& a, const std::vector<Target>& b) {
    return std::none_of(a.begin(), a.end(), [&](const Target& t) { return std::find(b.begin(), b.end(), t) != b.end(); });
}

/// True when `later` is accepted wherever `earlier` was, and so is everything that was accepted after `earlier`. Only the
/// count of a shape's parts against its nodes' materials ties edits of different targets together.
bool fits_in_place_of(const SceneEdit& later, const SceneEdit& earlier) {
    if (const auto* l = std::get_if<SetNode>(&later.value)) {
        const auto& e = std::get<SetNode>(earlier.value);
        return l->value.shape == e.value.shape && l->value.materials.size() <= e.value.materials.size();
    }
    if (const auto* l = std::get_if<SetResource<Shape>>(&later.value)) {
        const auto* now = std::get_if<Mesh>(&l->value.geometry);
        const auto* old = std::get_if<Mesh>(&std::get<SetResource<Shape>>(earlier.value).value.geometry);
        const std::size_t parts_now = now != nullptr && now->data ? now->data->parts.size() : 1;
        const std::size_t parts_old = old != nullptr && old->data ? old->data->parts.size() : 1;
        return parts_now >= parts_old;
    }
    if (const auto* l = std::get_if<EditGroup>(&later.value)) {
        const auto& e = std::get<EditGroup>(earlier.value);
        return std::equal(l->edits.begin(), l->edits.end(), e.edits.begin(), e.edits.end(), fits_in_place_of);
    }
    return true;
}

} // namespace

void EditMailbox::post(SceneEdit edit, std::uint64_t revision) {
    revision_ = revision;
    const std::vector<Target> targets = targets_of(edit);
    for (auto it = pending_.rbegin(); it != pending_.rend(); ++it) {
        if (supersedes(edit, *it)) {
            // With nothing after it a single edit always fits: it was valid behind the one that it replaces.
            const bool last_and_single = it == pending_.rbegin() && !std::holds_alternative<EditGroup>(edit.value);
            if (last_and_single || fits_in_place_of(edit, *it)) {
                *it = std::move(edit);
                return;
            }
            break;
        }
        if (!disjoint(targets, targets_of(*it))) {
            break;
        }
    }
    pending_.push_back(std::move(edit));
}

EditMailbox::Batch EditMailbox::take() { return {std::exchange(pending_, {}), revision_}; }

void EditMailbox::clear() { pending_.clear(); }

} // namespace atrium
