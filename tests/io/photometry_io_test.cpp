// Photometric lights in scene files: EXT_lights_ies, written and read, and what cannot be read.
#include "engine/io/ies_reader.h"
#include "engine/reference/web_reading.h"
#include "tests/io/io_test_support.h"

#include <nlohmann/json.hpp>

namespace atrium::test {
namespace {

constexpr char kSpot[] = "IESNA:LM-63-1995\n[MANUFAC] Maker\nTILT=NONE\n1 1000 1.37 4 1 1 2 -0.1 0 0\n1 1 10\n"
                         "0 20 45 90\n0\n1000 613.7 77.13 0\n";
constexpr char kBatwing[] = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 3 1 2 0.3 1.2 0\n1 1 30\n0 45 90\n0 45 90\n"
                            "300 200 0\n300 250 0\n300 333.3 0\n";

std::shared_ptr<const PhotometricWeb> web_of(const std::string& text, const std::string& name) {
    const auto loaded = parse_ies({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, name);
    return loaded.value().web;
}

/// Three lamps, two of one kind; one dimmed and coloured, one switched off; and a lamp without photometry.
Scene lit_scene() {
    Scene scene;
    const auto spot = web_of(kSpot, "narrow spot.ies");
    const auto add = [&](const std::string& name, const std::shared_ptr<const PhotometricWeb>& web) {
        Light light;
        light.name = name;
        if (web) {
            set_photometry(light, web);
        }
        Node node;
        node.name = name;
        node.transform.translation = {double(scene.roots.size()), 2.0, 0.1};
        node.light = scene.lights.insert(std::move(light));
        scene.roots.push_back(scene.nodes.insert(node));
        return node.light;
    };
    add("A", spot);
    const LightId dimmed = add("B", spot);
    scene.lights.find(dimmed)->intensity *= 0.371F;
    scene.lights.find(dimmed)->color = {1.0F, 0.86F, 0.681F};
    const LightId off = add("C", web_of(kBatwing, "batwing.ies"));
    scene.lights.find(off)->enabled = false;
    add("D", nullptr);
    return scene;
}

std::vector<Light> lights_of(const Scene& scene) {
    std::vector<Light> out;
    for (const NodeId id : scene.in_tree_order()) {
        if (const Light* light = scene.lights.find(scene.nodes.find(id)->light)) {
            out.push_back(*light);
        }
    }
    return out;
}

TEST(PhotometryIo, SurvivesEveryKindOfFile) {
    for (const char* name : {"scene.gltf", "scene.glb", "scene.atrium"}) {
        SCOPED_TRACE(name);
        const TemporaryFolder folder;
        const Scene scene = lit_scene();
        ASSERT_TRUE(write_scene(folder / name, scene));
        const auto loaded = read_scene(folder / name);
        ASSERT_TRUE(loaded) << loaded.error().message();
        EXPECT_FALSE(has_warning(*loaded)) << all_problems(*loaded);
        EXPECT_EQ(lights_of(loaded->scene), lights_of(scene)); // bit for bit, files and their names included
        // Lamps of a kind share their web.
        EXPECT_EQ(lights_of(loaded->scene)[0].photometry.web, lights_of(loaded->scene)[1].photometry.web);
        const std::string first = content(folder / name);
        ASSERT_TRUE(write_scene(folder / name, loaded->scene));
        EXPECT_EQ(content(folder / name), first);
    }
}

TEST(PhotometryIo, IsPlainForOthers) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_scene(folder / "scene.gltf", lit_scene()));
    EXPECT_EQ(content(folder / "narrow spot.ies"), kSpot);
    EXPECT_EQ(content(folder / "batwing.ies"), kBatwing);
    const auto json = nlohmann::json::parse(content(folder / "scene.gltf"));
    EXPECT_FALSE(json.contains("extensionsRequired"));
    const auto& profiles = json["extensions"]["EXT_lights_ies"]["lights"];
    ASSERT_EQ(profiles.size(), 2U);
    EXPECT_EQ(profiles[0]["uri"], "narrow%20spot.ies");
    const auto& nodes = json["nodes"];
    EXPECT_EQ(nodes[0]["extensions"]["EXT_lights_ies"], nlohmann::json({{"light", 0}}));
    EXPECT_NEAR(nodes[1]["extensions"]["EXT_lights_ies"]["multiplier"].get<double>(), 0.371, 1e-6);
    EXPECT_EQ(nodes[1]["extensions"]["EXT_lights_ies"]["color"][1].get<float>(), 0.86F);
    EXPECT_EQ(nodes[2]["extensions"]["EXT_lights_ies"]["multiplier"], 0.0); // dark for all
    EXPECT_FALSE(nodes[3]["extensions"].contains("EXT_lights_ies"));
    // Whoever does not know profiles finds a spot of that intensity.
    const auto& spot = json["extensions"]["KHR_lights_punctual"]["lights"][0];
    EXPECT_EQ(spot["type"], "spot");
    EXPECT_FLOAT_EQ(spot["intensity"].get<float>(), 1370.0F);
    // In one file there is no other.
    ASSERT_TRUE(write_scene(folder / "alone.glb", lit_scene()));
    std::filesystem::remove(folder / "narrow spot.ies");
    EXPECT_EQ(lights_of(read_scene(folder / "alone.glb")->scene), lights_of(lit_scene()));
}

TEST(PhotometryIo, NoFileIsOverwritten) {
    const TemporaryFolder folder;
    put_content(folder / "batwing.ies", "something else");
    ASSERT_TRUE(write_scene(folder / "scene.gltf", lit_scene()));
    EXPECT_EQ(content(folder / "batwing.ies"), "something else");
    EXPECT_EQ(content(folder / "batwing-2.ies"), kBatwing);
    const auto loaded = read_scene(folder / "scene.gltf");
    ASSERT_TRUE(loaded);
    EXPECT_EQ(lights_of(loaded->scene), lights_of(lit_scene()));
}

/// A document of others: profiles only, one node that refers to the first.
std::string foreign(const std::string& profile, const std::string& node_more = "", const std::string& root_more = "") {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "extensionsUsed": ["EXT_lights_ies"], "extensionsRequired": ["EXT_lights_ies"],
        "extensions": {"EXT_lights_ies": {"lights": [)" +
           profile + "]}" + root_more + R"(}, "nodes": [{"name": "L", "extensions": {"EXT_lights_ies": {"light": 0)" +
           node_more + R"(}}}]})";
}

TEST(PhotometryIo, FilesOfOthers) {
    const TemporaryFolder folder;
    put_content(folder / "spot.ies", kSpot);
    put_content(folder / "scene.gltf",
                foreign(R"({"uri": "spot.ies", "name": "Profile"})", R"(, "multiplier": 0.5, "color": [1, 0.5, 0.25])"));
    const auto loaded = read_scene(folder / "scene.gltf");
    ASSERT_TRUE(loaded) << loaded.error().message();
    const Light light = lights_of(loaded->scene).at(0);
    ASSERT_TRUE(light.photometry);
    EXPECT_EQ(light.name, "Profile");
    EXPECT_FLOAT_EQ(light.intensity, 0.5F * 1370.0F);
    EXPECT_EQ(light.color, Rgb(1.0F, 0.5F, 0.25F));
    EXPECT_FALSE(has_warning(*loaded)) << all_problems(*loaded);

    // A data: URI.
    const auto with_data = read_text(foreign(
        R"({"uri": "data:application/x-ies-lm-63;base64,VElMVD1OT05FCjEgLTEgMSAyIDEgMSAyIDAgMCAwIDEgMSAxMCAwIDkwIDAgNTAgMAo="})"));
    ASSERT_TRUE(with_data) << with_data.error().message();
    EXPECT_FLOAT_EQ(lights_of(with_data->scene).at(0).intensity, 50.0F);

    // Both kinds of light on one node: the profile counts.
    put_content(folder / "both.gltf",
                R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "extensions": {"EXT_lights_ies": {"lights": [{"uri": "spot.ies"}]},
                       "KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 7}]}},
        "nodes": [{"extensions": {"EXT_lights_ies": {"light": 0}, "KHR_lights_punctual": {"light": 0}}}]})");
    const auto both = read_scene(folder / "both.gltf");
    ASSERT_TRUE(both);
    EXPECT_FLOAT_EQ(lights_of(both->scene).at(0).intensity, 1370.0F);
    EXPECT_TRUE(has_problem(*both, "only the profile is used"));
}

TEST(PhotometryIo, WhatCannotBeReadIsToldAndLeftOut) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "scene");
    put_content(folder / "outside.ies", kSpot);
    put_content(folder / "scene/damaged.ies", std::string(kSpot).substr(0, 100));
    const std::pair<const char*, const char*> kCases[] = {
        {R"({"uri": "../outside.ies"})", "lies outside the folder"},
        {R"({"uri": "/etc/passwd"})", "lies outside the folder"},
        {R"({"uri": "http://x/y.ies"})", "is not a file beside the scene"},
        {R"({"uri": "missing.ies"})", "cannot be opened"},
        {R"({"uri": "damaged.ies"})", "the file ends where"},
        {R"({"uri": "data:,abc"})", "not valid base64"},
        {R"({})", "neither a file nor a buffer view"},
    };
    for (const auto& [profile, words] : kCases) {
        put_content(folder / "scene/scene.gltf", foreign(profile));
        const auto loaded = read_scene(folder / "scene/scene.gltf");
        ASSERT_TRUE(loaded) << loaded.error().message();
        EXPECT_TRUE(has_problem(*loaded, words)) << words << "\n" << all_problems(*loaded);
        EXPECT_TRUE(lights_of(loaded->scene).empty());
    }
    // References that lead nowhere are the file's fault.
    EXPECT_FALSE(read_text(foreign(R"({"bufferView": 3})")));
    EXPECT_FALSE(read_text(foreign("")));
}

} // namespace
} // namespace atrium::test
