// Real files are in metres with +Y up: none of them may be offered another unit or a turn.
#include "engine/io/scene_file.h"
#include "engine/scene/problems.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace atrium {
namespace {

TEST(ImportSuggestion, RealScenesInMetresGetNone) {
    const std::filesystem::path shared = std::filesystem::path(ATRIUM_SHARED_DIR) / "scenes";
    if (!std::filesystem::exists(shared)) {
        GTEST_SKIP() << "no shared scenes at " << shared;
    }
    int read = 0;
    for (const char* folder : {"interiors", "objects", "conformance"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(shared / folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".glb" && extension != ".gltf") {
                continue;
            }
            const auto loaded = read_scene(entry.path());
            if (!loaded) {
                continue; // what the reader refuses is its own tests' business
            }
            ++read;
            const ImportSuggestion s = suggest_import_fix(loaded->scene);
            EXPECT_FALSE(s.any()) << entry.path() << ": " << s.why;
            for (const Problem& p : find_problems(loaded->scene)) {
                EXPECT_NE(p.severity, Problem::Severity::Error) << entry.path() << ": " << p.what;
                EXPECT_FALSE(p.what.empty());
                EXPECT_FALSE(p.hint.empty());
            }
        }
    }
    EXPECT_GE(read, 20);
}

/// The same scene as another program would have written it: in another unit, and with +Z up.
Scene rewritten(const Scene& scene, double units_per_metre, bool z_up) {
    Scene out = scene;
    const dquat turn = z_up ? glm::angleAxis(kPiD / 2.0, dvec3(1.0, 0.0, 0.0)) : dquat(1.0, 0.0, 0.0, 0.0);
    for (const NodeId id : out.roots) {
        Transform& t = out.nodes.find(id)->transform;
        t.translation = turn * (t.translation * units_per_metre);
        t.rotation = turn * t.rotation;
        t.scale *= units_per_metre;
    }
    return out;
}

TEST(ImportSuggestion, RealInteriorsInOtherUnitsAreRecognised) {
    const std::filesystem::path shared = std::filesystem::path(ATRIUM_SHARED_DIR) / "scenes/interiors";
    if (!std::filesystem::exists(shared)) {
        GTEST_SKIP() << "no shared scenes at " << shared;
    }
    struct Case {
        const char* name;
        bool turned_is_seen; ///< its floors and walls are enough to tell; of the others nothing wrong is said
    };
    for (const Case& c : {Case{"office_simple", true}, Case{"office_b90", true}, Case{"classroom_leuven", true},
                          Case{"fzk_house_bim", false}, Case{"small_house", false}, Case{"wooden_staircase", false}}) {
        const auto loaded = read_scene(shared / (std::string(c.name) + ".glb"));
        ASSERT_TRUE(loaded) << loaded.error().message();
        const ImportSuggestion mm = suggest_import_fix(rewritten(loaded->scene, 1000.0, false));
        EXPECT_EQ(mm.unit_scale, 0.001) << c.name;
        EXPECT_FALSE(mm.z_up) << c.name;
        const ImportSuggestion turned = suggest_import_fix(rewritten(loaded->scene, 1.0, true));
        EXPECT_EQ(turned.unit_scale, 1.0) << c.name << ": " << turned.why;
        EXPECT_EQ(turned.z_up, c.turned_is_seen) << c.name << ": " << turned.why;
        if (c.turned_is_seen) {
            const ImportSuggestion both = suggest_import_fix(rewritten(loaded->scene, 1000.0, true));
            EXPECT_EQ(both.unit_scale, 0.001) << c.name << ": " << both.why;
            EXPECT_TRUE(both.z_up) << c.name << ": " << both.why;
        }
    }
}

} // namespace
} // namespace atrium
