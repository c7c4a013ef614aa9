// Random edits as a person makes them in a furnished room, with undo and redo. The same seed makes the same edits.
#pragma once

#include "engine/base/checks.h"
#include "engine/base/rng.h"
#include "engine/scene/scene_edit.h"
#include "tests/support/rooms.h"

#include <array>
#include <deque>
#include <optional>

namespace atrium::test {

/// Which kinds of edits there are.
enum class EditKind : std::uint8_t { Move, Turn, Scale, Hide, Dim, Switch, Paint, Glow, Sky, Add, Delete, Mirror, Rename };
inline constexpr std::size_t kEditKinds = 13;
inline const char* edit_kind_name(EditKind kind) {
    constexpr std::array<const char*, kEditKinds> kNames{"move", "turn", "scale", "hide",   "dim",    "switch", "paint",
                                                         "glow", "sky",  "add",   "delete", "mirror", "rename"};
    return kNames[std::size_t(kind)];
}

/// Rooms for edits: as they come, nearly white, dark with a point lamp alone, under the open sky, in the sun with a mirror.
enum class RoomKind : std::uint8_t { Grey, White, Dark, Sky, SunAndMirror };
inline constexpr std::size_t kRoomKinds = 5;
inline const char* room_kind_name(RoomKind kind) {
    constexpr std::array<const char*, kRoomKinds> kNames{"grey", "white", "dark", "sky", "sun and mirror"};
    return kNames[std::size_t(kind)];
}

/// A room of 4 x 3 x 4 m with boxes on its floor, a lamp that is a surface and one that is a point.
struct EditedRoom {
    Scene scene;
    std::vector<NodeId> things; ///< that may be moved and so on; those added come later
    NodeId panel, point;

    explicit EditedRoom(RoomKind kind = RoomKind::Grey) {
        scene.settings.quality = SolverSettings::Quality::Draft;
        const float rho = kind == RoomKind::White ? 0.85F : (kind == RoomKind::Dark ? 0.1F : 0.6F);
        add_room(scene, 4, 3, 4, add_material(scene, rho));
        if (kind == RoomKind::Sky || kind == RoomKind::SunAndMirror) { // no ceiling
            const NodeId ceiling = scene.roots[1];
            scene.roots.erase(scene.roots.begin() + 1);
            scene.nodes.erase(ceiling);
        }
        if (kind == RoomKind::Sky) {
            scene.environment.sky_radiance = Rgb(500.0F);
        }
        if (kind == RoomKind::SunAndMirror) {
            Light sun;
            sun.kind = Light::Kind::Directional;
            sun.intensity = 20000.0F;
            Node node;
            node.name = "sun";
            node.light = scene.lights.insert(sun);
            node.transform.rotation = glm::angleAxis(-1.0, dvec3(1, 0, 0));
            scene.roots.push_back(scene.nodes.insert(node));
            Material metal;
            metal.metallic = 1.0F;
            metal.roughness = 0.0F;
            metal.base_color = Rgb(0.9F);
            add_rectangle(scene, "mirror", {2, 1.5, 0.02}, {0, 0, 1}, {1, 0, 0}, 1.5F, 1.5F, scene.materials.insert(metal));
        }
        for (int i = 0; i < 4; ++i) {
            const float height = 0.4F + 0.2F * float(i);
            things.push_back(add_thing("box " + std::to_string(i), vec3(0.4F, height, 0.4F),
                                       {0.9 + 0.7 * i, 0.5 * height, 1.0 + 0.6 * (i % 3)}, 0.3F + 0.1F * float(i)));
        }
        panel = add_rectangle(scene, "panel", {2, 2.95, 2}, {0, -1, 0}, {1, 0, 0}, 0.5F, 0.5F,
                              add_material(scene, 0.5F, kind == RoomKind::Dark ? 0.0F : 20000.0F));
        point = add_point_light(scene, {0.6, 2.4, 3.2}, 1500.0);
    }

private:
    NodeId add_thing(const std::string& name, const vec3& size, const dvec3& at, float rho) {
        Shape shape;
        shape.geometry = Box{size};
        Node node;
        node.name = name;
        node.shape = scene.shapes.insert(shape);
        node.materials = {add_material(scene, rho)};
        node.transform.translation = at;
        const NodeId id = scene.nodes.insert(node);
        scene.roots.push_back(id);
        return id;
    }
};

/// Makes edits of the kinds given and applies them, and now and then takes some back or makes them again.
class UserEdits {
public:
    /// `undo`: how many in a hundred steps are undo or redo.
    UserEdits(EditedRoom& room, std::uint64_t seed, std::vector<EditKind> kinds, std::uint32_t undo = 15)
        : scene_(room.scene), things_(room.things), panel_(room.panel), point_(room.point), kinds_(std::move(kinds)),
          undo_percent_(undo), state_(seed) {}

    /// One step: what was applied to the scene, for whoever else has it.
    SceneEdit step() {
        if (below(100) < undo_percent_) {
            if (auto edit = below(100) < 70 ? take_back(undo_, redo_) : take_back(redo_, undo_)) {
                return *edit;
            }
        }
        for (;;) {
            const SceneEdit edit = make(kinds_[below(std::uint32_t(kinds_.size()))]);
            if (auto inverse = apply(scene_, edit)) {
                ++applied_;
                undo_.push_back(std::move(*inverse));
                redo_.clear();
                if (undo_.size() > kMostUndo) {
                    undo_.pop_front();
                }
                return edit;
            }
        }
    }
    [[nodiscard]] std::size_t applied() const { return applied_; } ///< undo and redo not counted

private:
    static constexpr std::size_t kMostUndo = 50;
    static constexpr std::size_t kMostThings = 8;

    std::uint32_t below(std::uint32_t count) {
        state_ = hash64(state_ + 0x9E3779B97F4A7C15ULL);
        return std::uint32_t((state_ >> 20) % count);
    }
    double between(double a, double b) { return a + (b - a) * double(below(1U << 20U)) / double(1U << 20U); }

    std::optional<SceneEdit> take_back(std::deque<SceneEdit>& from, std::deque<SceneEdit>& to) {
        if (from.empty()) {
            return std::nullopt;
        }
        SceneEdit edit = std::move(from.back());
        from.pop_back();
        auto inverse = apply(scene_, edit);
        ATRIUM_CHECK(inverse); // what was done can be undone
        to.push_back(std::move(*inverse));
        return edit;
    }

    std::vector<NodeId> present() const {
        std::vector<NodeId> out;
        for (const NodeId id : things_) {
            if (scene_.nodes.find(id) != nullptr) {
                out.push_back(id);
            }
        }
        return out;
    }

    SceneEdit make(EditKind kind) {
        const std::vector<NodeId> there = present();
        if (there.empty() && kind != EditKind::Add) {
            return make(EditKind::Add);
        }
        const NodeId id = there.empty() ? NodeId{} : there[below(std::uint32_t(there.size()))];
        const Node* node = scene_.nodes.find(id);
        switch (kind) {
        case EditKind::Move: {
            Transform t = node->transform;
            t.translation.x = std::clamp(t.translation.x + between(-0.4, 0.4), 0.4, 3.6);
            t.translation.z = std::clamp(t.translation.z + between(-0.4, 0.4), 0.4, 3.6);
            return {SetTransform{id, t}};
        }
        case EditKind::Turn: {
            Transform t = node->transform;
            t.rotation = glm::normalize(glm::angleAxis(between(-1.0, 1.0), dvec3(0, 1, 0)) * t.rotation);
            return {SetTransform{id, t}};
        }
        case EditKind::Scale: {
            Transform t = node->transform;
            t.scale = glm::clamp(t.scale * dvec3(between(0.7, 1.4)), dvec3(0.4), dvec3(1.6));
            return {SetTransform{id, t}};
        }
        case EditKind::Hide: {
            Node value = *node;
            value.visible = !value.visible;
            return {SetNode{id, value}};
        }
        case EditKind::Dim:
        case EditKind::Switch: {
            const LightId light = scene_.nodes.find(point_)->light;
            Light value = *scene_.lights.find(light);
            if (kind == EditKind::Switch) {
                value.enabled = !value.enabled;
            } else {
                value.intensity = float(between(20.0, 200.0));
            }
            return {SetResource<Light>{light, value}};
        }
        case EditKind::Paint: {
            const MaterialId material = node->materials[0];
            Material value = *scene_.materials.find(material);
            value.base_color = Rgb(float(between(0.1, 0.9)), float(between(0.1, 0.9)), float(between(0.1, 0.9)));
            return {SetResource<Material>{material, value}};
        }
        case EditKind::Glow: {
            const MaterialId material = scene_.nodes.find(panel_)->materials[0];
            Material value = *scene_.materials.find(material);
            value.emissive_strength = float(between(1000.0, 20000.0));
            return {SetResource<Material>{material, value}};
        }
        case EditKind::Sky: return {SetEnvironment{{Rgb(float(between(0.0, 100.0)))}}};
        case EditKind::Add: return there.size() < kMostThings ? add() : make(EditKind::Delete);
        case EditKind::Delete: return there.size() > 2 ? SceneEdit{RemoveNode{id}} : make(EditKind::Move);
        case EditKind::Mirror: {
            const MaterialId material = node->materials[0];
            Material value = *scene_.materials.find(material);
            value.metallic = value.metallic > 0.0F ? 0.0F : 1.0F;
            value.roughness = value.metallic > 0.0F ? 0.0F : 1.0F;
            return {SetResource<Material>{material, value}};
        }
        case EditKind::Rename: {
            Node value = *node;
            value.name = "thing " + std::to_string(below(1000));
            return {SetNode{id, value}};
        }
        }
        return {EditGroup{}};
    }

    SceneEdit add() {
        Material material;
        material.base_color = Rgb(float(between(0.2, 0.8)));
        Shape shape;
        shape.geometry = below(2) == 0 ? Geometry{Box{vec3(0.3F)}} : Geometry{Sphere{0.2F}};
        Node node;
        node.name = "new";
        node.shape = scene_.shapes.next_key();
        node.materials = {scene_.materials.next_key()};
        node.transform.translation = {between(0.5, 3.5), 0.2, between(0.5, 3.5)};
        const NodeId id = scene_.nodes.next_key();
        if (std::find(things_.begin(), things_.end(), id) == things_.end()) {
            things_.push_back(id);
        }
        return {EditGroup{{{AddResource<Shape>{node.shape, shape}},
                           {AddResource<Material>{node.materials[0], material}},
                           {AddNode{id, node}}}}};
    }

    Scene& scene_;
    std::vector<NodeId> things_;
    NodeId panel_, point_;
    std::vector<EditKind> kinds_;
    std::uint32_t undo_percent_;
    std::uint64_t state_;
    std::deque<SceneEdit> undo_, redo_;
    std::size_t applied_ = 0;
};

/// What GiEngine::update() follows, most of the time.
inline std::vector<EditKind> followed_edit_kinds() {
    return {EditKind::Move,  EditKind::Move, EditKind::Turn, EditKind::Hide,  EditKind::Dim,
            EditKind::Paint, EditKind::Glow, EditKind::Add,  EditKind::Scale, EditKind::Delete};
}

/// Every kind.
inline std::vector<EditKind> all_edit_kinds() {
    std::vector<EditKind> out;
    for (std::size_t k = 0; k < kEditKinds; ++k) {
        out.push_back(EditKind(k));
    }
    return out;
}

} // namespace atrium::test
