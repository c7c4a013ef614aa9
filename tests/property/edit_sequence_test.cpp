// Random sequences of edits, valid and invalid: undo and redo are exact, a refused edit changes nothing, merged edits end in
// the same document, and edits that claim to leave light unchanged do.
#include "engine/base/float_traps.h"
#include "engine/base/rng.h"
#include "engine/scene/scene_edit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace atrium {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Makes random edits for the scene that it is shown; the same seed makes the same sequence.
class EditMaker {
public:
    explicit EditMaker(std::uint64_t seed) : state_(seed) {}

    std::uint32_t below(std::uint32_t count) {
        state_ = hash64(state_);
        return std::uint32_t((state_ >> 20) % count);
    }
    bool chance(unsigned percent) { return below(100) < percent; }

    SceneEdit make(const Scene& scene, int depth = 0) {
        switch (below(depth < 2 ? 16 : 14)) {
        case 0: return {AddResource<Shape>{new_id(scene.shapes), shape()}};
        case 1: return {SetResource<Shape>{any(scene.shapes), shape()}};
        case 2: return {AddResource<Material>{new_id(scene.materials), material(scene)}};
        case 3: return {SetResource<Material>{any(scene.materials), material(scene)}};
        case 4: return {AddResource<Light>{new_id(scene.lights), light()}};
        case 5: return {SetResource<Light>{any(scene.lights), light()}};
        case 6: return camera_or_texture(scene);
        case 7: return removal(scene);
        case 8:
        case 9: return {AddNode{new_id(scene.nodes), node(scene), index()}};
        case 10: return chance(20) ? SceneEdit{RemoveNode{any(scene.nodes)}} : settings();
        case 11: return {SetTransform{any(scene.nodes), transform()}};
        case 12: return {SetParent{any(scene.nodes), maybe(scene.nodes), index()}};
        case 13: {
            const NodeId id = any(scene.nodes);
            const Node* old = scene.nodes.find(id);
            Node value = old != nullptr && chance(60) ? *old : node(scene);
            value.name = name();
            value.locked = chance(50);
            value.visible = chance(70);
            return {SetNode{id, value}};
        }
        default: {
            EditGroup group;
            Scene ahead = scene; // later members mostly fit what the earlier ones left
            for (std::uint32_t i = below(4); i > 0; --i) {
                group.edits.push_back(make(ahead, depth + 1));
                (void)apply(ahead, group.edits.back());
            }
            return {std::move(group)};
        }
        }
    }

private:
    template <class T> Id<T> any(const SlotMap<T>& map) {
        const auto keys = map.keys();
        if (keys.empty() || chance(4)) {
            return Id<T>{below(50), below(3)};
        }
        return keys[below(std::uint32_t(keys.size()))];
    }
    template <class T> Id<T> maybe(const SlotMap<T>& map) { return chance(30) ? Id<T>{} : any(map); }
    template <class T> Id<T> new_id(const SlotMap<T>& map) { return chance(6) ? any(map) : map.next_key(); }
    std::size_t index() { return chance(50) ? SIZE_MAX : below(5); }
    std::string name() { return "n" + std::to_string(below(1000)); }
    float number() { return chance(1) ? kNan : float(below(2000)) / 100.0F; }
    double coordinate() { return chance(1) ? std::numeric_limits<double>::infinity() : double(below(2000)) / 7.0 - 140.0; }

    Transform transform() {
        Transform t;
        t.translation = chance(30) ? dvec3(0.0) : dvec3(coordinate(), coordinate(), coordinate());
        if (chance(50)) {
            t.rotation = dquat(double(below(100)), double(below(100)), 0.0, double(below(3)));
        }
        t.scale = dvec3(1.0 + below(3), 1.0, chance(5) ? 0.0 : 1.0);
        return t;
    }
    Shape shape() {
        Shape s{name(), Box{vec3(number())}, {}};
        if (chance(30)) {
            auto data = std::make_shared<MeshData>();
            data->positions = {vec3(0.0F), vec3(number(), 0.0F, 0.0F), vec3(0.0F, 1.0F, 0.0F)};
            data->indices = {0, 1, chance(5) ? 9U : 2U};
            for (std::uint32_t i = below(4); i > 0; --i) {
                data->parts.push_back({0, chance(5) ? 4U : 3U});
            }
            s.geometry = Mesh{data};
        } else if (chance(30)) {
            s.geometry = Sphere{number()};
        }
        return s;
    }
    Material material(const Scene& scene) {
        Material m;
        m.name = name();
        m.base_color = Rgb(number() / 20.0F);
        m.base_color_texture.texture = maybe(scene.textures);
        m.roughness = chance(50) ? 0.5F : number();
        return m;
    }
    Light light() {
        Light l;
        l.name = name();
        l.enabled = chance(60);
        l.intensity = chance(40) ? 10.0F : number();
        return l;
    }
    Node node(const Scene& scene) {
        Node n;
        n.name = name();
        n.parent = maybe(scene.nodes);
        n.transform = transform();
        n.shape = maybe(scene.shapes);
        for (std::uint32_t i = below(4); i > 0; --i) {
            n.materials.push_back(maybe(scene.materials));
        }
        n.light = maybe(scene.lights);
        n.camera = maybe(scene.cameras);
        n.visible = chance(80);
        if (chance(2)) {
            n.children.push_back(any(scene.nodes));
        }
        return n;
    }
    SceneEdit settings() {
        if (chance(50)) {
            return {SetEnvironment{{Rgb(number())}}};
        }
        return {SetSolverSettings{{SolverSettings::Quality::Fine, below(3), {}}}};
    }
    SceneEdit camera_or_texture(const Scene& scene) {
        Camera c;
        c.name = name();
        c.yfov = number();
        Texture t;
        t.name = name();
        t.nearest = chance(50);
        switch (below(4)) {
        case 0: return {AddResource<Camera>{new_id(scene.cameras), c}};
        case 1: return {SetResource<Camera>{any(scene.cameras), c}};
        case 2: return {AddResource<Texture>{new_id(scene.textures), t}};
        default: return {SetResource<Texture>{any(scene.textures), t}};
        }
    }
    SceneEdit removal(const Scene& scene) {
        switch (below(5)) {
        case 0: return {RemoveResource<Shape>{any(scene.shapes)}};
        case 1: return {RemoveResource<Material>{any(scene.materials)}};
        case 2: return {RemoveResource<Texture>{any(scene.textures)}};
        case 3: return {RemoveResource<Light>{any(scene.lights)}};
        default: return {RemoveResource<Camera>{any(scene.cameras)}};
        }
    }

    std::uint64_t state_;
};

/// Every node is in exactly one list, that of its parent; nothing else is in a list.
void expect_sound_tree(const Scene& scene) {
    std::map<NodeId, int> listed;
    const auto visit = [&](NodeId parent, const std::vector<NodeId>& children) {
        for (const NodeId id : children) {
            ++listed[id];
            const Node* node = scene.nodes.find(id);
            ASSERT_NE(node, nullptr);
            EXPECT_EQ(node->parent, parent);
        }
    };
    visit({}, scene.roots);
    scene.nodes.for_each([&](NodeId id, const Node& node) { visit(id, node.children); });
    EXPECT_EQ(listed.size(), scene.nodes.size());
    EXPECT_EQ(scene.in_tree_order().size(), scene.nodes.size()) << "a cycle, or a node that no root reaches";
    for (const auto& [id, times] : listed) {
        EXPECT_EQ(times, 1);
    }
}

/// All that light depends on, written independently of light_neutral.cpp.
struct LightState {
    std::vector<std::tuple<NodeId, dmat4, Geometry, std::vector<Material>, std::vector<Texture>>> surfaces;
    std::vector<std::tuple<NodeId, dmat4, Light>> lights;
    Environment environment;
    SolverSettings settings;
    bool operator==(const LightState&) const = default;
};
LightState light_state(const Scene& scene) {
    LightState out{{}, {}, scene.environment, scene.settings};
    scene.nodes.for_each([&](NodeId id, const Node& node) {
        if (!scene.shown(id)) {
            return;
        }
        if (const Shape* shape = scene.shapes.find(node.shape)) {
            std::vector<Material> materials;
            std::vector<Texture> textures;
            for (std::size_t part = 0; part < part_count(*shape); ++part) {
                const Material* m = scene.material_of(node, part);
                materials.push_back(m != nullptr ? *m : default_material());
                materials.back().name.clear();
                if (const Texture* t = scene.textures.find(materials.back().base_color_texture.texture)) {
                    textures.push_back(*t);
                    textures.back().name.clear();
                }
            }
            out.surfaces.emplace_back(id, scene.world_matrix(id), shape->geometry, materials, textures);
        }
        if (const Light* light = scene.lights.find(node.light);
            light != nullptr && light->enabled && light->intensity > 0.0F) {
            out.lights.emplace_back(id, scene.world_matrix(id), *light);
            std::get<2>(out.lights.back()).name.clear();
        }
    });
    return out;
}

class EditSequence : public testing::TestWithParam<std::uint64_t> {};

TEST_P(EditSequence, UndoAndRedoAreExactAndRefusalsChangeNothing) {
    const FloatTrapsOff no_numbers_on_purpose;
    EditMaker maker(GetParam());
    Scene scene;
    struct Step {
        SceneEdit undo;
        Scene before;
    };
    std::vector<Step> history;
    int applied = 0;
    int refused = 0;
    int neutral = 0;
    std::size_t largest_tree = 0;
    for (int i = 0; i < 6000; ++i) {
        const SceneEdit edit = maker.make(scene);
        const Scene before = scene;
        const bool claims_neutral = leaves_light_unchanged(before, edit);
        auto undo = apply(scene, edit);
        if (!undo) {
            ++refused;
            EXPECT_FALSE(undo.error().what.empty());
            EXPECT_FALSE(undo.error().where.empty());
            ASSERT_EQ(scene, before) << "a refused edit left traces: " << undo.error().message();
            continue;
        }
        ++applied;
        expect_sound_tree(scene);
        largest_tree = std::max(largest_tree, scene.nodes.size());
        if (claims_neutral) {
            ++neutral;
            ASSERT_EQ(light_state(scene), light_state(before)) << "edit kind " << edit.value.index();
        }
        const Scene after = scene;
        auto redo = apply(scene, *undo);
        ASSERT_TRUE(redo) << redo.error().message();
        ASSERT_EQ(scene, before) << "edit kind " << edit.value.index();
        ASSERT_TRUE(apply(scene, *redo));
        ASSERT_EQ(scene, after) << "edit kind " << edit.value.index();
        history.push_back({std::move(*undo), before});
        // Now and then a walk back through several steps; the sequence goes on from there.
        if (history.size() >= 25) {
            for (std::uint32_t back = maker.below(20); back > 0; --back) {
                ASSERT_TRUE(apply(scene, history.back().undo));
                ASSERT_EQ(scene, history.back().before);
                history.pop_back();
            }
            if (history.size() > 20) {
                history.erase(history.begin(), history.begin() + 10);
            }
        }
    }
    EXPECT_GT(applied, 2000);
    EXPECT_GT(refused, 50);
    EXPECT_GT(neutral, 50);
    EXPECT_GT(largest_tree, 10U);
}

TEST_P(EditSequence, ALaterEditThatSupersedesMayReplaceTheEarlierOne) {
    EditMaker maker(GetParam() + 1000);
    Scene scene;
    int merged = 0;
    for (int i = 0; i < 6000; ++i) {
        const SceneEdit first = maker.make(scene);
        Scene both = scene;
        if (!apply(both, first)) {
            continue;
        }
        SceneEdit second = maker.make(both);
        for (int tries = 0; tries < 10 && !supersedes(second, first); ++tries) {
            second = maker.make(both);
        }
        if (supersedes(second, first) && apply(both, second)) {
            ++merged;
            ASSERT_TRUE(apply(scene, second));
            ASSERT_EQ(scene, both);
        } else {
            ASSERT_TRUE(apply(scene, first));
        }
    }
    EXPECT_GT(merged, 20);
}

INSTANTIATE_TEST_SUITE_P(Seeds, EditSequence, testing::Values(1, 2, 3, 4));

} // namespace
} // namespace atrium
