// Edit scripts: every kind is read, and whatever is wrong is refused with the edit, what is wrong and what would be right.
#include "engine/io/edit_script_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

namespace atrium {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// The one edit of a script.
template <class T> T one(const std::string& json) {
    const auto script = parse_edit_script(R"({"edits": [)" + json + "]}", "s.json");
    if (!script || script->edits.size() != 1 || !std::holds_alternative<T>(script->edits[0].value)) {
        ADD_FAILURE() << json << (script ? "" : script.error().message());
        return {};
    }
    return std::get<T>(script->edits[0].value);
}
std::string refusal(const std::string& text) {
    const auto script = parse_edit_script(text, "s.json");
    return script ? "accepted" : script.error().message();
}
/// What is said about an edit behind a good one.
std::string refusal_of(const std::string& json) { return refusal(R"({"edits": [{"kind": "undo"}, )" + json + "]}"); }

TEST(EditScriptReader, Drag) {
    const auto d = one<ScriptDrag>(R"({"kind": "drag", "node": "Chair", "positions": [[0, 1, 2], [0.5, 1, 2]],
                                       "interval_ms": 8, "settle": false})");
    EXPECT_EQ(d.node, "Chair");
    ASSERT_EQ(d.positions.size(), 2U);
    EXPECT_EQ(d.positions[1], dvec3(0.5, 1.0, 2.0));
    EXPECT_EQ(d.interval_ms, 8.0);
    EXPECT_FALSE(d.settle);
    const auto plain = one<ScriptDrag>(R"({"kind": "drag", "node": "#3", "positions": [[0, 1, 2]]})");
    EXPECT_EQ(plain.interval_ms, 16.0);
    EXPECT_TRUE(plain.settle);
}

TEST(EditScriptReader, Move) {
    const auto m = one<ScriptMove>(
        R"({"kind": "move", "node": "Mirror", "translation": [1, 2, 3], "rotation": [0.1, 0.2, 0.3, 0.9], "scale": [1, 1, 2]})");
    EXPECT_EQ(m.node, "Mirror");
    EXPECT_EQ(m.translation, dvec3(1, 2, 3));
    EXPECT_EQ(m.rotation, dquat(0.9, 0.1, 0.2, 0.3)) << "x, y, z, w in the file as in glTF";
    EXPECT_EQ(m.scale, dvec3(1, 1, 2));
    EXPECT_FALSE(one<ScriptMove>(R"({"kind": "move", "node": "Mirror", "scale": [2, 2, 2]})").translation);
}

TEST(EditScriptReader, MaterialAndLight) {
    const auto m =
        one<ScriptMaterial>(R"({"kind": "material", "material": "Wall", "baseColor": [0.1, 0.2, 0.3], "metallic": 1,
                                           "roughness": 0.5, "transmission": 0.25, "ior": 1.4})");
    EXPECT_EQ(m.material, "Wall");
    EXPECT_EQ(m.base_color, Rgb(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(m.metallic, 1.0F);
    EXPECT_EQ(m.roughness, 0.5F);
    EXPECT_EQ(m.transmission, 0.25F);
    EXPECT_EQ(m.ior, 1.4F);
    const auto l =
        one<ScriptLight>(R"({"kind": "light", "node": "Lamp", "intensity": 250, "color": [1, 0.9, 2], "enabled": false})");
    EXPECT_EQ(l.node, "Lamp");
    EXPECT_EQ(l.intensity, 250.0F);
    EXPECT_EQ(l.color, Rgb(1.0F, 0.9F, 2.0F));
    EXPECT_EQ(l.enabled, false);
}

TEST(EditScriptReader, AddOfEveryShape) {
    const auto add = [](const std::string& more) { return one<ScriptAdd>(R"({"kind": "add", "shape": )" + more + "}"); };
    const auto ball = add(R"("sphere", "name": "Ball", "size": [0.4], "translation": [1, 2, 3], "material": "Glass")");
    EXPECT_EQ(ball.shape.geometry, Geometry(Sphere{0.2F}));
    EXPECT_EQ(ball.shape.name, "Ball");
    EXPECT_EQ(ball.material, "Glass");
    EXPECT_EQ(ball.transform.translation, dvec3(1, 2, 3));
    EXPECT_EQ(add(R"("sphere", "size": [1, 1, 1])").shape.geometry, Geometry(Sphere{0.5F}));
    EXPECT_EQ(add(R"("sphere")").shape.name, "sphere");
    EXPECT_EQ(add(R"("box", "size": [1, 2, 3])").shape.geometry, Geometry(Box{{1, 2, 3}}));
    EXPECT_EQ(add(R"("box", "size": [2])").shape.geometry, Geometry(Box{{2, 2, 2}}));
    EXPECT_EQ(add(R"("cylinder", "size": [1, 3])").shape.geometry, Geometry(Cylinder{0.5F, 3.0F, true}));
    EXPECT_EQ(add(R"("cone", "size": [1, 3, 1])").shape.geometry, Geometry(Cone{0.5F, 0.0F, 3.0F, true}));
    EXPECT_EQ(add(R"("disc", "size": [3])").shape.geometry, Geometry(Disc{1.5F}));
    const Geometry sheet = Polygon{{{-1, -0.5F}, {1, -0.5F}, {1, 0.5F}, {-1, 0.5F}}, {}};
    EXPECT_EQ(add(R"("rectangle", "size": [2, 1])").shape.geometry, sheet);
    EXPECT_EQ(add(R"("polygon", "size": [2, 1], "rotation": [1, 0, 0, 0], "scale": [1, 2, 1])").transform.scale,
              dvec3(1, 2, 1));
}

TEST(EditScriptReader, DeleteUndoRedo) {
    EXPECT_EQ(one<ScriptDelete>(R"({"kind": "delete", "node": "#12"})").node, "#12");
    one<ScriptUndo>(R"({"kind": "undo"})");
    one<ScriptRedo>(R"({"kind": "redo"})");
    const auto script = parse_edit_script(R"({"edits": [{"kind": "redo"}, {"kind": "delete", "node": "A"}]})", "s.json");
    ASSERT_TRUE(script);
    EXPECT_EQ(script->place(0), "edits/0 (redo)");
    EXPECT_EQ(script->place(1), "edits/1 (delete A)");
    EXPECT_TRUE(parse_edit_script(R"({"edits": []})", "s.json"));
}

TEST(EditScriptReader, RefusesWhatIsNoScript) {
    EXPECT_THAT(refusal(""), AllOf(StartsWith("s.json: is not JSON: "), HasSubstr("line 1"), HasSubstr("quotes")));
    EXPECT_THAT(refusal("{\"edits\": [\n{\"kind\" \"undo\"}]}"), HasSubstr("line 2"));
    EXPECT_THAT(refusal(R"({"edits": [{"kind": "light", "node": "L", "intensity": 1e999}]})"),
                StartsWith("s.json: is not JSON"));
    EXPECT_THAT(refusal("[]"), AllOf(HasSubstr("not a JSON object"), HasSubstr("Write {\"edits\"")));
    EXPECT_THAT(refusal("{}"), HasSubstr("has no list \"edits\""));
    EXPECT_THAT(refusal(R"({"edits": {}})"), HasSubstr("\"edits\" is not a list"));
    EXPECT_THAT(refusal(R"({"edits": [], "seed": 3})"), HasSubstr("\"seed\" means nothing here"));
}

TEST(EditScriptReader, RefusesWrongEditsByTheirIndex) {
    EXPECT_THAT(refusal_of("3"), AllOf(StartsWith("s.json: edits/1: is 3"), HasSubstr("{\"kind\": \"undo\"}")));
    EXPECT_THAT(refusal_of("{}"), AllOf(HasSubstr("edits/1: \"kind\" is missing"), HasSubstr("drag, move")));
    EXPECT_THAT(refusal_of(R"({"kind": 7})"), HasSubstr("\"kind\" is 7"));
    EXPECT_THAT(refusal_of(R"({"kind": "jump"})"), AllOf(HasSubstr("\"jump\", which is no kind"), HasSubstr("drag, move")));
    EXPECT_THAT(refusal_of(R"({"kind": "undo", "node": "A"})"), HasSubstr("edits/1 (undo): \"node\" means nothing here"));
}

TEST(EditScriptReader, RefusesWrongMembers) {
    struct {
        const char* edit;
        const char* says;
    } const cases[] = {
        {R"({"kind": "drag", "positions": [[0, 0, 0]]})", "edits/1 (drag): \"node\" is missing"},
        {R"({"kind": "drag", "node": "A"})", "\"positions\" is missing"},
        {R"({"kind": "drag", "node": "A", "positions": []})", "\"positions\" is not a list of places"},
        {R"({"kind": "drag", "node": "A", "positions": [[0, 0, 0], [0, 0]]})", "\"positions/1\" is [0,0] but must be"},
        {R"({"kind": "drag", "node": "A", "positions": [[0, 0, 1e300]]})", "each a finite number"},
        {R"({"kind": "drag", "node": "A", "positions": [[0, 0, 0]], "interval_ms": -1})", "\"interval_ms\" is -1"},
        {R"({"kind": "drag", "node": "A", "positions": [[0, 0, 0]], "settle": 1})",
         "\"settle\" is 1 but must be true or false"},
        {R"({"kind": "drag", "node": "A", "positions": [[0, 0, 0]], "interval_ms": "1"})", "\"interval_ms\" is \"1\""},
        {R"({"kind": "move", "node": ""})", "\"node\" is \"\" but must be a text"},
        {R"({"kind": "move", "node": "A"})", "it says nothing to change. Give at least one of translation, rotation, scale"},
        {R"({"kind": "move", "node": "A", "position": [0, 0, 0]})", "Known are node, translation, rotation, scale"},
        {R"({"kind": "move", "node": "A", "translation": [0, "x", 0]})", "must be a list of 3 numbers"},
        {R"({"kind": "move", "node": "A", "rotation": [0, 0, 0]})", "must be a list of 4 numbers"},
        {R"({"kind": "move", "node": "A", "rotation": [0, 0, 0, 0]})", "is no rotation"},
        {R"({"kind": "material", "material": "A"})", "it says nothing to change"},
        {R"({"kind": "material", "node": "A", "ior": 1})", "\"node\" means nothing here"},
        {R"({"kind": "material", "ior": 1.5})", "\"material\" is missing"},
        {R"({"kind": "material", "material": "A", "roughness": 1.5})",
         "\"roughness\" is 1.5 but must be a number from 0.0 to 1.0"},
        {R"({"kind": "material", "material": "A", "baseColor": [0, 2, 0]})", "\"baseColor\""},
        {R"({"kind": "material", "material": "A", "ior": 0.5})", "a number of at least 1.0"},
        {R"({"kind": "light", "node": "A"})", "it says nothing to change"},
        {R"({"kind": "light", "node": "A", "intensity": -2})", "\"intensity\" is -2"},
        {R"({"kind": "light", "node": "A", "enabled": "yes"})", "\"enabled\" is \"yes\""},
        {R"({"kind": "light", "node": "A", "color": "#ffffff"})", "\"color\""},
        {R"({"kind": "add"})", "\"shape\" is missing"},
        {R"({"kind": "add", "shape": "teapot"})", "Write box, sphere"},
        {R"({"kind": "add", "shape": "box", "size": [1, -1, 1]})", "lengths above zero"},
        {R"({"kind": "add", "shape": "box", "size": [1, 1e300, 1]})", "lengths above zero"},
        {R"({"kind": "add", "shape": "box", "size": [1, 2]})", "does not fit a box"},
        {R"({"kind": "add", "shape": "sphere", "size": [1, 2, 1]})", "does not fit a sphere"},
        {R"({"kind": "add", "shape": "disc", "size": [1, 1, 1]})", "does not fit a disc"},
        {R"({"kind": "delete"})", "\"node\" is missing"},
    };
    for (const auto& c : cases) {
        EXPECT_THAT(refusal_of(c.edit), AllOf(StartsWith("s.json: edits/1 ("), HasSubstr(c.says))) << c.edit;
    }
}

TEST(EditScriptReader, ReadsFiles) {
    const std::string path = testing::TempDir() + "edit_script_reader_test.json";
    std::ofstream(path) << R"({"edits": [{"kind": "undo"}]})";
    const auto script = read_edit_script(path);
    ASSERT_TRUE(script);
    EXPECT_EQ(script->file, path);
    std::remove(path.c_str());
    const auto missing = read_edit_script(path);
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message(), HasSubstr(path));
}

} // namespace
} // namespace atrium
