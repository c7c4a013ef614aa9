// What is set by hand about caustics in files: kept, and never a reason to refuse one.
#include "engine/io/edit_script_reader.h"
#include "tests/io/io_test_support.h"

#include <gmock/gmock.h>

namespace atrium::test {
namespace {

using testing::HasSubstr;

Scene wishing_scene() {
    Scene scene;
    Shape shape{"Floor", Box{vec3(1.0F)}, {}};
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = {scene.materials.insert(Material{})};
    const CausticWish wishes[] = {{},
                                  {CausticWish::Show::Mesh, 0, 0},
                                  {CausticWish::Show::Texture, 0.0025F, 0},
                                  {CausticWish::Show::Automatic, 0.1F, 12.5F}};
    for (const CausticWish& wish : wishes) {
        node.name = "Floor " + std::to_string(scene.roots.size());
        node.caustics = wish;
        scene.roots.push_back(scene.nodes.insert(node));
    }
    return scene;
}

TEST(CausticWishIo, IsKept) {
    for (const char* name : {"scene.gltf", "scene.glb", "scene.atrium"}) {
        const TemporaryFolder folder;
        const Scene scene = wishing_scene();
        ASSERT_TRUE(write_scene(folder / name, scene));
        const auto loaded = read_scene(folder / name);
        ASSERT_TRUE(loaded) << loaded.error().message();
        ASSERT_EQ(loaded->scene.roots.size(), scene.roots.size());
        for (std::size_t i = 0; i < scene.roots.size(); ++i) {
            EXPECT_EQ(loaded->scene.nodes.find(loaded->scene.roots[i])->caustics,
                      scene.nodes.find(scene.roots[i])->caustics);
        }
    }
}

TEST(CausticWishIo, AutomaticLeavesNoTrace) {
    const TemporaryFolder folder;
    Scene scene = wishing_scene();
    for (const NodeId id : scene.roots) {
        scene.nodes.find(id)->caustics = {};
    }
    ASSERT_TRUE(write_scene(folder / "scene.gltf", scene));
    EXPECT_EQ(content(folder / "scene.gltf").find("ATRIUM_node"), std::string::npos);
    EXPECT_EQ(content(folder / "scene.gltf").find("caustics"), std::string::npos);
}

TEST(CausticWishIo, WhatMakesNoSenseIsAutomatic) {
    const auto read = [](const std::string& caustics) {
        return read_text(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"name": "A", "extensions": {"ATRIUM_node": {"caustics": )" +
                         caustics + R"(}}}]})");
    };
    const auto wish = [&](const std::string& caustics) {
        const auto loaded = read(caustics);
        EXPECT_TRUE(loaded) << caustics;
        return loaded ? loaded->scene.nodes.find(loaded->scene.roots.at(0))->caustics : CausticWish{};
    };
    EXPECT_EQ(wish(R"({"show": "mesh", "texel": 0.5})"), (CausticWish{CausticWish::Show::Mesh, 0.5F, 0.0F}));
    EXPECT_EQ(wish(R"({"show": "automatic"})"), CausticWish{});
    EXPECT_EQ(wish(R"({"show": "hologram", "threshold": 4})"), (CausticWish{CausticWish::Show::Automatic, 0.0F, 4.0F}));
    EXPECT_EQ(wish(R"({"texel": -1, "threshold": -2})"), CausticWish{});
    EXPECT_TRUE(has_warning(*read(R"({"show": "hologram"})")));
    EXPECT_TRUE(has_warning(*read(R"({"texel": -1})")));
}

TEST(CausticWishIo, AScriptSaysIt) {
    const auto script = parse_edit_script(
        R"({"edits": [{"kind": "caustics", "node": "Floor", "show": "texture", "texel": 0.002, "threshold": 9}]})",
        "s.json");
    ASSERT_TRUE(script) << script.error().message();
    const auto& e = std::get<ScriptCaustics>(script->edits.at(0).value);
    EXPECT_EQ(e.node, "Floor");
    EXPECT_EQ(e.show, CausticWish::Show::Texture);
    EXPECT_EQ(e.texel, 0.002F);
    EXPECT_EQ(e.threshold, 9.0F);
    const auto refusal = [](const std::string& members) {
        const auto bad = parse_edit_script(R"({"edits": [{"kind": "caustics", )" + members + "}]}", "s.json");
        return bad ? std::string("accepted") : bad.error().message();
    };
    EXPECT_THAT(refusal(R"("node": "Floor", "show": "mirror")"), HasSubstr("Write automatic, mesh or texture"));
    EXPECT_THAT(refusal(R"("node": "Floor", "texel": -2)"), HasSubstr("must be a number of at least 0"));
    EXPECT_THAT(refusal(R"("node": "Floor")"), HasSubstr("nothing to change"));
    EXPECT_THAT(refusal(R"("show": "mesh")"), HasSubstr("\"node\" is missing"));
}

} // namespace
} // namespace atrium::test
