#include "engine/scene/scene_edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace atrium {
namespace {

using testing::HasSubstr;

constexpr double kInf = std::numeric_limits<double>::infinity();

NodeId add(Scene& scene, Node node, std::size_t index = SIZE_MAX) {
    const NodeId id = scene.nodes.next_key();
    const auto done = apply(scene, {AddNode{id, std::move(node), index}});
    EXPECT_TRUE(done) << done.error().message();
    return id;
}
Node named(const char* name, NodeId parent = {}) {
    Node n;
    n.name = name;
    n.parent = parent;
    return n;
}

/// room > (table > (lamp, cup), chair) with one box shape, one material, one light and a camera below the root.
struct Room : testing::Test {
    Scene scene;
    ShapeId box = scene.shapes.insert({"box", Box{vec3(1.0F)}, {}});
    MaterialId paint = scene.materials.insert(Material{});
    LightId bulb = scene.lights.insert(Light{});
    CameraId view = scene.cameras.insert(Camera{});
    NodeId room, table, lamp, cup, chair, eye;

    void SetUp() override {
        room = add(scene, named("room"));
        table = add(scene, with_shape(named("table", room)));
        lamp = add(scene, named("lamp", table));
        scene.nodes.find(lamp)->light = bulb;
        cup = add(scene, with_shape(named("cup", table)));
        chair = add(scene, with_shape(named("chair", room)));
        eye = add(scene, named("eye"));
        scene.nodes.find(eye)->camera = view;
    }
    [[nodiscard]] Node with_shape(Node n) const {
        n.shape = box;
        n.materials = {paint};
        return n;
    }
    /// Applies, checks that the inverse restores the scene, and leaves the edit applied.
    void expect_exact(const SceneEdit& edit) {
        const Scene before = scene;
        auto undo = apply(scene, edit);
        ASSERT_TRUE(undo) << undo.error().message();
        const Scene after = scene;
        EXPECT_NE(before, after);
        auto redo = apply(scene, *undo);
        ASSERT_TRUE(redo) << redo.error().message();
        EXPECT_EQ(scene, before);
        ASSERT_TRUE(apply(scene, *redo));
        EXPECT_EQ(scene, after);
    }
    /// Expects a refusal that changes nothing; returns its message.
    std::string expect_refused(const SceneEdit& edit) {
        const Scene before = scene;
        const auto result = apply(scene, edit);
        EXPECT_FALSE(result.has_value());
        EXPECT_EQ(scene, before);
        return result ? std::string() : result.error().message();
    }
    [[nodiscard]] bool neutral(const SceneEdit& edit) const { return leaves_light_unchanged(scene, edit); }
    [[nodiscard]] Node value(NodeId id) const { return *scene.nodes.find(id); }
};

TEST_F(Room, RemovingASubtreeComesBackWithIdsAndOrder) {
    expect_exact({RemoveNode{table}});
    EXPECT_EQ(scene.nodes.size(), 3U);
    EXPECT_EQ(scene.nodes.find(room)->children, std::vector<NodeId>{chair});
    EXPECT_EQ(scene.shapes.size(), 1U) << "shapes stay: undo needs them";
}

TEST_F(Room, AddedNodesTakeTheAskedForPlace) {
    const NodeId rug = add(scene, named("rug", room), 1);
    EXPECT_EQ(scene.nodes.find(room)->children, (std::vector<NodeId>{table, rug, chair}));
    const NodeId first = add(scene, named("first"), 0);
    EXPECT_EQ(scene.roots, (std::vector<NodeId>{first, room, eye}));
    const NodeId last = add(scene, named("last"), 99);
    EXPECT_EQ(scene.roots.back(), last);
}

TEST_F(Room, EveryKindOfEditIsExact) {
    Transform t;
    t.translation = dvec3(0.1, 0.2, 1e6 / 3.0);
    t.rotation = glm::angleAxis(0.3, glm::normalize(dvec3(1.0, 2.0, 3.0)));
    expect_exact({SetTransform{table, t}});
    expect_exact({SetParent{cup, chair, 0}});
    expect_exact({SetParent{table, room, 1}});
    Node n = value(chair);
    n.name = "armchair";
    n.visible = false;
    n.extras = "{\"a\":1}";
    expect_exact({SetNode{chair, n}});
    EXPECT_EQ(scene.nodes.find(chair)->children, std::vector<NodeId>{cup}) << "children are not part of SetNode";
    expect_exact({SetEnvironment{{Rgb(100.0F)}}});
    expect_exact({SetSolverSettings{{SolverSettings::Quality::Draft, 7, {}}}});
    expect_exact({SetResource<Shape>{box, {"ball", Sphere{0.3F}, {}}}});
    Material red;
    red.base_color = Rgb(0.5F, 0.0F, 0.0F);
    expect_exact({SetResource<Material>{paint, red}});
    expect_exact({AddResource<Texture>{scene.textures.next_key(), Texture{}}});
    expect_exact({RemoveResource<Light>{bulb}});
    expect_exact({RemoveResource<Camera>{view}});
}

TEST_F(Room, SetParentCountsTheIndexWithoutTheNodeItself) {
    const NodeId rug = add(scene, named("rug", room));
    ASSERT_TRUE(apply(scene, {SetParent{table, room, 2}}));
    EXPECT_EQ(scene.nodes.find(room)->children, (std::vector<NodeId>{chair, rug, table}));
}

TEST_F(Room, RefusalsNameTheNodeAndSayWhy) {
    const NodeId gone{77, 3};
    EXPECT_THAT(expect_refused({RemoveNode{gone}}), HasSubstr("node 77.3"));
    EXPECT_THAT(expect_refused({SetTransform{gone, {}}}), HasSubstr("no such node"));
    EXPECT_THAT(expect_refused({SetParent{cup, gone}}), HasSubstr("'cup'"));
    EXPECT_THAT(expect_refused({SetParent{room, cup}}), HasSubstr("'cup', which is part of it"));
    EXPECT_THAT(expect_refused({SetParent{room, room}}), HasSubstr("part of it"));
    EXPECT_THAT(expect_refused({AddNode{cup, named("cup 2")}}), HasSubstr("already taken"));
    EXPECT_THAT(expect_refused({AddNode{{cup.slot, 9}, named("cup 3")}}), HasSubstr("already taken"));
    EXPECT_THAT(expect_refused({AddNode{{}, named("nobody")}}), HasSubstr("needs an id"));
    EXPECT_THAT(expect_refused({AddNode{{0xFFFFFFF0U, 1}, named("far")}}), HasSubstr("never given out"));
    EXPECT_THAT(expect_refused({AddNode{scene.nodes.next_key(), named("orphan", gone)}}), HasSubstr("77.3"));
    Node parent = named("parent");
    parent.children = {cup};
    EXPECT_THAT(expect_refused({AddNode{scene.nodes.next_key(), parent}}), HasSubstr("without children"));
    Transform t;
    t.translation.y = kInf;
    EXPECT_THAT(expect_refused({SetTransform{cup, t}}), HasSubstr("'cup': its position, rotation or scale is not a finite"));
    Node two = value(cup);
    two.materials = {paint, paint};
    EXPECT_THAT(expect_refused({SetNode{cup, two}}), HasSubstr("2 materials, but its shape has 1 part"));
    Light bright;
    bright.intensity = float(kInf);
    EXPECT_THAT(expect_refused({SetResource<Light>{bulb, bright}}), HasSubstr("not a finite number"));
    Material m;
    m.base_color.g = std::nanf("");
    EXPECT_THAT(expect_refused({SetResource<Material>{paint, m}}), HasSubstr("not a finite number"));
    EXPECT_THAT(expect_refused({SetResource<Shape>{box, {"x", Mesh{}, {}}}}), HasSubstr("no data"));
    EXPECT_THAT(expect_refused({RemoveResource<Texture>{{4, 1}}}), HasSubstr("texture 4.1"));
    EXPECT_THAT(expect_refused({SetEnvironment{{Rgb(float(kInf))}}}), HasSubstr("sky"));
    Camera c;
    c.yfov = std::nanf("");
    EXPECT_THAT(expect_refused({AddResource<Camera>{scene.cameras.next_key(), c}}), HasSubstr("camera"));
}

TEST_F(Room, AttenuationDistanceMayBeInfinite) {
    Material glass;
    glass.attenuation_distance = float(kInf);
    EXPECT_TRUE(apply(scene, {SetResource<Material>{paint, glass}}));
    glass.attenuation_distance = std::nanf("");
    expect_refused({SetResource<Material>{paint, glass}});
}

TEST_F(Room, AShapeMustKeepAPartForEveryMaterial) {
    auto data = std::make_shared<MeshData>();
    data->positions = {vec3(0.0F), vec3(1.0F, 0.0F, 0.0F), vec3(0.0F, 1.0F, 0.0F)};
    data->indices = {0, 1, 2};
    data->parts = {{0, 3}, {0, 3}};
    ASSERT_TRUE(apply(scene, {SetResource<Shape>{box, {"two parts", Mesh{data}, {}}}}));
    Node two = value(cup);
    two.materials = {paint, paint};
    ASSERT_TRUE(apply(scene, {SetNode{cup, two}}));
    EXPECT_THAT(expect_refused({SetResource<Shape>{box, {"one part", Box{}, {}}}}), HasSubstr("'cup'"));
}

TEST_F(Room, RotationsAreMadeUnitAndUnitOnesKeepTheirBits) {
    Transform t;
    t.rotation = dquat(0.0, 0.0, 0.0, 0.0);
    ASSERT_TRUE(apply(scene, {SetTransform{cup, t}}));
    EXPECT_EQ(scene.nodes.find(cup)->transform.rotation, dquat(1.0, 0.0, 0.0, 0.0));
    t.rotation = dquat(2.0, 0.0, 2.0, 0.0);
    ASSERT_TRUE(apply(scene, {SetTransform{cup, t}}));
    EXPECT_NEAR(glm::length(scene.nodes.find(cup)->transform.rotation), 1.0, 1e-15);
    t.rotation = dquat(1e-300, 0.0, 1e-300, 0.0);
    ASSERT_TRUE(apply(scene, {SetTransform{cup, t}}));
    EXPECT_NEAR(scene.nodes.find(cup)->transform.rotation.y, std::sqrt(0.5), 1e-12);
    t.rotation = glm::angleAxis(1.234, glm::normalize(dvec3(3.0, -1.0, 0.2)));
    ASSERT_TRUE(apply(scene, {SetTransform{cup, t}}));
    EXPECT_EQ(scene.nodes.find(cup)->transform.rotation, t.rotation);
}

TEST_F(Room, AGroupIsAllOrNothing) {
    Transform t;
    t.translation = dvec3(1.0, 2.0, 3.0);
    EditGroup bad;
    bad.edits = {{SetTransform{cup, t}}, {RemoveNode{table}}, {SetTransform{cup, t}}};
    EXPECT_THAT(expect_refused({bad}), HasSubstr("no such node"));
    EditGroup good;
    good.edits = {{SetTransform{cup, t}}, {SetParent{cup, room}}, {RemoveNode{table}}};
    expect_exact({good});
    EXPECT_TRUE(scene.nodes.contains(cup));
}

TEST_F(Room, SupersedesOnlyTheSameKindOnTheSameTarget) {
    const SceneEdit a{SetTransform{cup, {}}};
    const SceneEdit b{SetTransform{chair, {}}};
    EXPECT_TRUE(supersedes(a, a));
    EXPECT_FALSE(supersedes(a, b));
    EXPECT_FALSE(supersedes(a, {SetNode{cup, value(cup)}}));
    EXPECT_TRUE(supersedes({SetNode{cup, {}}}, {SetNode{cup, value(cup)}}));
    EXPECT_TRUE(supersedes({SetEnvironment{}}, {SetEnvironment{{Rgb(3.0F)}}}));
    EXPECT_TRUE(supersedes({SetSolverSettings{}}, {SetSolverSettings{}}));
    EXPECT_TRUE(supersedes({SetResource<Material>{paint, {}}}, {SetResource<Material>{paint, {}}}));
    EXPECT_FALSE(supersedes({SetResource<Material>{paint, {}}}, {SetResource<Material>{{9, 1}, {}}}));
    EXPECT_FALSE(supersedes({SetParent{cup, room}}, {SetParent{cup, chair}})) << "the order among siblings would differ";
    EXPECT_FALSE(supersedes({RemoveNode{cup}}, {RemoveNode{cup}}));
    EXPECT_TRUE(supersedes({EditGroup{{a, b}}}, {EditGroup{{a, b}}}));
    EXPECT_FALSE(supersedes({EditGroup{{a}}}, {EditGroup{{a, b}}}));
    EXPECT_FALSE(supersedes({EditGroup{{a, b}}}, {EditGroup{{a}}}));
    EXPECT_FALSE(supersedes({EditGroup{}}, {EditGroup{}}));
}

TEST_F(Room, NamesLocksCamerasAndExtrasLeaveLightAlone) {
    Node n = value(cup);
    n.name = "mug";
    n.locked = true;
    n.camera = view;
    n.extras = "{}";
    EXPECT_TRUE(neutral({SetNode{cup, n}}));
    Transform t;
    t.translation.x = 1.0;
    EXPECT_TRUE(neutral({SetTransform{eye, t}}));
    EXPECT_FALSE(neutral({SetTransform{cup, t}}));
    EXPECT_FALSE(neutral({SetTransform{lamp, t}}));
    EXPECT_FALSE(neutral({SetTransform{room, t}})) << "what is below it moves";
    EXPECT_TRUE(neutral({SetTransform{cup, value(cup).transform}})) << "nothing changes";
    EXPECT_TRUE(neutral({SetResource<Camera>{view, {}}}));
    Material named_paint;
    named_paint.name = "eggshell";
    EXPECT_TRUE(neutral({SetResource<Material>{paint, named_paint}}));
    named_paint.base_color = Rgb(0.2F);
    EXPECT_FALSE(neutral({SetResource<Material>{paint, named_paint}}));
    EXPECT_TRUE(neutral({SetResource<Shape>{box, {"crate", Box{vec3(1.0F)}, {}}}}));
    EXPECT_FALSE(neutral({SetResource<Shape>{box, {"crate", Box{vec3(2.0F)}, {}}}}));
    EXPECT_TRUE(neutral({SetEnvironment{}}));
    EXPECT_FALSE(neutral({SetEnvironment{{Rgb(1.0F)}}}));
    EXPECT_FALSE(neutral({SetSolverSettings{{SolverSettings::Quality::Fine, 1, {}}}}));
    EXPECT_FALSE(neutral({RemoveNode{NodeId{77, 3}}}));
}

TEST_F(Room, HidingMattersOnlyWhereSomethingIsSeen) {
    Node n = value(eye);
    n.visible = false;
    EXPECT_TRUE(neutral({SetNode{eye, n}}));
    n = value(table);
    n.shape = {};
    n.materials = {};
    ASSERT_TRUE(apply(scene, {SetNode{table, n}}));
    n.visible = false;
    EXPECT_FALSE(neutral({SetNode{table, n}})) << "the lamp and the cup go dark with it";
    ASSERT_TRUE(apply(scene, {SetNode{table, n}}));
    Transform t;
    t.translation.x = 1.0;
    EXPECT_TRUE(neutral({SetTransform{cup, t}}));
    EXPECT_TRUE(neutral({RemoveNode{table}}));
    EXPECT_TRUE(neutral({SetParent{cup, lamp}})) << "hidden here and there";
    EXPECT_FALSE(neutral({SetParent{cup, room}})) << "it comes to light";
    EXPECT_TRUE(neutral({AddNode{scene.nodes.next_key(), with_shape(named("spoon", table))}}));
    EXPECT_FALSE(neutral({AddNode{scene.nodes.next_key(), with_shape(named("spoon", room))}}));
}

TEST_F(Room, RegroupingInPlaceLeavesLightAlone) {
    const NodeId group = scene.nodes.next_key();
    EXPECT_TRUE(neutral({EditGroup{{{AddNode{group, named("group", room)}}, {SetParent{cup, table, 0}}}}}));
    EXPECT_TRUE(neutral({EditGroup{{{AddNode{group, named("group", room)}}, {SetParent{chair, group}}}}}));
    Transform t;
    t.translation.x = 1.0;
    ASSERT_TRUE(apply(scene, {SetTransform{table, t}}));
    EXPECT_FALSE(neutral({SetParent{cup, room}}));
}

TEST_F(Room, AGroupIsJudgedStepByStep) {
    Node hidden = value(chair);
    hidden.visible = false;
    Node group = value(table);
    group.visible = false;
    ASSERT_TRUE(apply(scene, {SetNode{chair, hidden}}));
    ASSERT_TRUE(apply(scene, {SetNode{table, group}}));
    ASSERT_TRUE(apply(scene, {SetParent{chair, table}}));
    Node visible = hidden;
    visible.visible = true;
    EXPECT_TRUE(neutral({SetNode{chair, visible}}));
    EXPECT_TRUE(neutral({SetParent{chair, room}}));
    EXPECT_FALSE(neutral({EditGroup{{{SetParent{chair, room}}, {SetNode{chair, visible}}}}}));
}

TEST_F(Room, LightsThatDoNotShineCountForNothing) {
    Light off;
    off.enabled = false;
    EXPECT_FALSE(neutral({SetResource<Light>{bulb, off}}));
    ASSERT_TRUE(apply(scene, {SetResource<Light>{bulb, off}}));
    Transform t;
    t.translation.x = 1.0;
    EXPECT_TRUE(neutral({SetTransform{lamp, t}}));
    off.intensity = 3.0F;
    EXPECT_TRUE(neutral({SetResource<Light>{bulb, off}}));
    EXPECT_TRUE(neutral({RemoveResource<Light>{bulb}}));
    EXPECT_TRUE(neutral({AddResource<Light>{scene.lights.next_key(), Light{}}})) << "no node has it yet";
}

} // namespace
} // namespace atrium
