// What the edits of a script mean in a scene: names, numbers, undo as in the editor.
#include "engine/scene/edit_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace atrium {
namespace {

using testing::HasSubstr;

struct EditScriptTest : testing::Test {
    EditScriptTest() {
        Material wall;
        wall.name = "Wall";
        Material glow;
        glow.name = "Glow";
        glow.emissive_color = Rgb(1.0F);
        glow.emissive_strength = 800.0F;
        const MaterialId walls = scene.materials.insert(wall);
        const MaterialId glows = scene.materials.insert(glow);
        const ShapeId box = scene.shapes.insert({"box", Box{}, {}});
        Light light;
        light.intensity = 100.0F;
        chair = add("Chair", {}, box, walls);
        seat = add("Part", chair, box, walls);
        back = add("Part", chair, box, walls);
        lamp = add("Lamp", {}, {}, {});
        scene.nodes.find(lamp)->light = scene.lights.insert(light);
        panel = add("Panel", {}, box, glows);
    }
    NodeId add(const std::string& name, NodeId parent, ShapeId shape, MaterialId material) {
        Node node;
        node.name = name;
        node.parent = parent;
        node.shape = shape;
        if (shape) {
            node.materials = {material};
        }
        const NodeId id = scene.nodes.next_key();
        EXPECT_TRUE(apply(scene, {AddNode{id, node}}));
        return id;
    }
    static std::string refusal(ScriptedScene& stage, const ScriptEdit& edit) {
        const auto done = stage.apply(edit);
        return done ? "accepted" : done.error().message();
    }

    Scene scene;
    NodeId chair, seat, back, lamp, panel;
};

TEST_F(EditScriptTest, NodesHaveNamesOrNumbers) {
    ScriptedScene stage(scene);
    ASSERT_TRUE(stage.apply({ScriptMove{"Chair", dvec3(1, 0, 0), {}, {}}}));
    ASSERT_TRUE(stage.apply({ScriptMove{"#2", dvec3(2, 0, 0), {}, {}}}));
    EXPECT_EQ(stage.scene().nodes.find(chair)->transform.translation.x, 1.0);
    EXPECT_EQ(stage.scene().nodes.find(back)->transform.translation.x, 2.0);
    EXPECT_THAT(refusal(stage, {ScriptDelete{"Part"}}), HasSubstr("2 nodes are named 'Part'. Write the number of the one "
                                                                  "that is meant: #1, #2"));
    EXPECT_THAT(refusal(stage, {ScriptDelete{"chair"}}), HasSubstr("no node named 'chair'"));
    EXPECT_THAT(refusal(stage, {ScriptDelete{"#5"}}), HasSubstr("there is no node #5, only 5, the first of them #0"));
    EXPECT_THAT(refusal(stage, {ScriptDelete{"#"}}), HasSubstr("no node named '#'"));
    // Numbers are those of the file, whatever was deleted, and go on with what was added.
    ASSERT_TRUE(stage.apply({ScriptDelete{"Chair"}}));
    EXPECT_THAT(refusal(stage, {ScriptDelete{"#1"}}), HasSubstr("node #1 was deleted"));
    ASSERT_TRUE(stage.apply({ScriptAdd{{"Ball", Sphere{}, {}}, {}, ""}}));
    ASSERT_TRUE(stage.apply({ScriptMove{"#4", dvec3(4, 0, 0), {}, {}}}));
    EXPECT_EQ(stage.scene().nodes.find(panel)->transform.translation.x, 4.0);
    ASSERT_TRUE(stage.apply({ScriptDelete{"#5"}}));
    EXPECT_THAT(refusal(stage, {ScriptDelete{"Ball"}}), HasSubstr("no node named 'Ball'"));
}

TEST_F(EditScriptTest, MoveKeepsWhatItDoesNotName) {
    ScriptedScene stage(scene);
    ASSERT_TRUE(stage.apply({ScriptMove{"Chair", {}, {}, dvec3(2.0)}}));
    ASSERT_TRUE(stage.apply({ScriptMove{"Chair", {}, dquat(0, 0, 1, 0), {}}}));
    const Transform& t = stage.scene().nodes.find(chair)->transform;
    EXPECT_EQ(t.scale, dvec3(2.0));
    EXPECT_EQ(t.rotation, dquat(0, 0, 1, 0));
    EXPECT_EQ(t.translation, dvec3(0.0));
}

TEST_F(EditScriptTest, Materials) {
    ScriptedScene stage(scene);
    ScriptMaterial e{"Wall", Rgb(0.1F), {}, 0.3F, {}, {}};
    ASSERT_TRUE(stage.apply({e}));
    const Material& wall = *stage.scene().material_of(*stage.scene().nodes.find(chair), 0);
    EXPECT_EQ(wall.base_color, Rgb(0.1F));
    EXPECT_EQ(wall.roughness, 0.3F);
    EXPECT_EQ(wall.metallic, 0.0F);
    e.material = "#1";
    ASSERT_TRUE(stage.apply({e}));
    EXPECT_EQ(stage.scene().material_of(*stage.scene().nodes.find(panel), 0)->roughness, 0.3F);
    e.material = "Paper";
    EXPECT_THAT(refusal(stage, {e}), HasSubstr("no material named 'Paper'"));
}

TEST_F(EditScriptTest, LightsAndSurfacesThatShine) {
    ScriptedScene stage(scene);
    ASSERT_TRUE(stage.apply({ScriptLight{"Lamp", 250.0F, {}, false}}));
    const Light& light = *stage.scene().lights.find(scene.nodes.find(lamp)->light);
    EXPECT_EQ(light.intensity, 250.0F);
    EXPECT_FALSE(light.enabled);
    const auto glow = [&] { return *stage.scene().material_of(*stage.scene().nodes.find(panel), 0); };
    ASSERT_TRUE(stage.apply({ScriptLight{"Panel", 300.0F, Rgb(1.0F, 0.5F, 0.5F), {}}}));
    EXPECT_EQ(glow().emitted_radiance(), Rgb(300.0F, 150.0F, 150.0F));
    ASSERT_TRUE(stage.apply({ScriptLight{"Panel", {}, {}, false}}));
    EXPECT_FALSE(glow().emits());
    EXPECT_THAT(refusal(stage, {ScriptLight{"Panel", {}, {}, true}}), HasSubstr("Give its intensity"));
    ASSERT_TRUE(stage.apply({ScriptUndo{}}));
    EXPECT_TRUE(glow().emits());
    EXPECT_THAT(refusal(stage, {ScriptLight{"Chair", 1.0F, {}, {}}}), HasSubstr("no light"));
}

TEST_F(EditScriptTest, AddedThingsHaveTheMaterialOrOneOfTheirOwn) {
    ScriptedScene stage(scene);
    Transform t;
    t.translation = {1, 2, 3};
    ASSERT_TRUE(stage.apply({ScriptAdd{{"Ball", Sphere{}, {}}, t, "Wall"}}));
    ASSERT_TRUE(stage.apply({ScriptAdd{{"Sheet", Disc{}, {}}, t, ""}}));
    const Scene& s = stage.scene();
    ASSERT_EQ(s.roots.size(), 5U);
    const Node& ball = *s.nodes.find(s.roots[3]);
    EXPECT_EQ(ball.name, "Ball");
    EXPECT_EQ(ball.transform, t);
    EXPECT_EQ(s.material_of(ball, 0)->name, "Wall");
    const Node& sheet = *s.nodes.find(s.roots[4]);
    EXPECT_EQ(s.material_of(sheet, 0)->name, "Sheet");
    EXPECT_TRUE(s.material_of(sheet, 0)->double_sided) << "a flat thing is seen from both sides";
    EXPECT_THAT(refusal(stage, {ScriptAdd{{"Ball", Sphere{}, {}}, t, "Glass"}}), HasSubstr("no material named 'Glass'"));
    ASSERT_TRUE(stage.apply({ScriptUndo{}}));
    ASSERT_TRUE(stage.apply({ScriptUndo{}}));
    EXPECT_EQ(stage.scene(), scene);
}

TEST_F(EditScriptTest, UndoAndRedoLeadBackAndForth) {
    ScriptedScene stage(scene);
    std::vector<Scene> states = {scene};
    const auto step = [&](const ScriptEdit& edit) {
        ASSERT_TRUE(stage.apply(edit));
        states.push_back(stage.scene());
    };
    step({ScriptMove{"Chair", dvec3(1, 0, 0), {}, {}}});
    step({ScriptMaterial{"Wall", Rgb(0.1F), {}, {}, {}, {}}});
    step({ScriptDelete{"Chair"}});
    step({ScriptAdd{{"Ball", Sphere{}, {}}, {}, "Wall"}});
    step({ScriptLight{"Lamp", 1.0F, {}, {}}});
    EXPECT_EQ(stage.undo_target(), "Lamp");
    for (std::size_t i = states.size() - 1; i-- > 0;) {
        const auto done = stage.apply({ScriptUndo{}});
        ASSERT_TRUE(done);
        EXPECT_TRUE(done->has_value());
        EXPECT_EQ(stage.scene(), states[i]) << i;
    }
    EXPECT_THAT(refusal(stage, {ScriptUndo{}}), HasSubstr("nothing to undo"));
    EXPECT_EQ(stage.redo_target(), "Chair");
    for (std::size_t i = 1; i < states.size(); ++i) {
        ASSERT_TRUE(stage.apply({ScriptRedo{}}));
        EXPECT_EQ(stage.scene(), states[i]) << i;
    }
    EXPECT_THAT(refusal(stage, {ScriptRedo{}}), HasSubstr("nothing to redo"));
    ASSERT_TRUE(stage.apply({ScriptUndo{}}));
    ASSERT_TRUE(stage.apply({ScriptLight{"Lamp", 2.0F, {}, {}}}));
    EXPECT_THAT(refusal(stage, {ScriptRedo{}}), HasSubstr("nothing to redo"));
}

TEST_F(EditScriptTest, ADragIsOneEntryAndWhatChangesNothingIsNone) {
    ScriptedScene stage(scene);
    const ScriptDrag drag{"Chair", {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, 16, true};
    for (const dvec3& p : drag.positions) {
        const auto done = stage.drag_to(drag, p);
        ASSERT_TRUE(done);
        EXPECT_TRUE(done->has_value());
    }
    stage.end_drag();
    const auto still = stage.apply({ScriptMove{"Chair", dvec3(3, 0, 0), {}, {}}});
    ASSERT_TRUE(still);
    EXPECT_FALSE(still->has_value());
    ASSERT_TRUE(stage.apply({ScriptUndo{}}));
    EXPECT_EQ(stage.scene(), scene);
    ASSERT_TRUE(stage.apply({ScriptRedo{}}));
    EXPECT_EQ(stage.scene().nodes.find(chair)->transform.translation.x, 3.0);
    ASSERT_TRUE(stage.apply({ScriptUndo{}}));
    // There and back again leaves no entry.
    ASSERT_TRUE(stage.drag_to(drag, {1, 0, 0}));
    ASSERT_TRUE(stage.drag_to(drag, {0, 0, 0}));
    stage.end_drag();
    EXPECT_EQ(stage.undo_target(), "");
}

TEST_F(EditScriptTest, RehearsalFindsTheFirstWrongEdit) {
    EditScript script{"s.json",
                      {{ScriptDrag{"Chair", {{1, 0, 0}, {2, 0, 0}}, 16, true}},
                       {ScriptAdd{{"Ball", Sphere{}, {}}, {}, ""}},
                       {ScriptDelete{"Ball"}},
                       {ScriptUndo{}},
                       {ScriptMove{"Ball", dvec3(1.0), {}, {}}}}};
    EXPECT_TRUE(rehearse(scene, script));
    script.edits.push_back({ScriptDrag{"Bell", {{1, 0, 0}}, 16, true}});
    const auto wrong = rehearse(scene, script);
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().message(), testing::StartsWith("s.json: edits/5 (drag Bell): there is no node named 'Bell'"));
}

} // namespace
} // namespace atrium
