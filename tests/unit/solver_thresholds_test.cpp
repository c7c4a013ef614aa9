// Thresholds that are set by hand: they reach the solver, those left alone stay as the quality has them.
#include "engine/solver/quality.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace test;
using Quality = SolverSettings::Quality;

TEST(SolverThresholds, AutomaticOnesChangeNothing) {
    for (const Quality quality : {Quality::Draft, Quality::Normal, Quality::Fine}) {
        const QualitySettings wanted = quality_settings(quality, 7.0F, 0.0);
        QualitySettings set = wanted;
        set_thresholds(set, {});
        EXPECT_EQ(thresholds_of(set), thresholds_of(wanted));
        for (const ThresholdInfo& info : kThresholds) {
            const float value = thresholds_of(wanted).*info.value;
            EXPECT_GT(value, info.least) << info.key;
            EXPECT_LT(value, info.most) << info.key;
        }
    }
}

TEST(SolverThresholds, EachIsSetAloneAndWithinItsLimits) {
    const QualitySettings normal = quality_settings(Quality::Normal, 10.0F, 0.0);
    const SolverThresholds automatic = thresholds_of(normal);
    for (const ThresholdInfo& info : kThresholds) {
        QualitySettings set = normal;
        SolverThresholds wish;
        wish.*info.value = 0.25F * automatic.*info.value; // lengths, counts and shares alike: by steps of two
        set_thresholds(set, wish);
        SolverThresholds expected = automatic;
        expected.*info.value = wish.*info.value;
        for (const ThresholdInfo& other : kThresholds) {
            EXPECT_NEAR(thresholds_of(set).*other.value, expected.*other.value, 1e-4F * expected.*other.value)
                << other.key << " after " << info.key;
        }
        wish.*info.value = 1e30F;
        set_thresholds(set, wish);
        EXPECT_LE(thresholds_of(set).*info.value, info.most) << info.key;
        wish.*info.value = 1e-30F;
        set_thresholds(set, wish);
        EXPECT_GE(thresholds_of(set).*info.value, 0.4F * info.least) << info.key << ", to a step of two";
    }
    QualitySettings coarse = normal;
    SolverThresholds wish;
    wish.mesh_edge = 2.0F;
    set_thresholds(coarse, wish);
    EXPECT_GE(coarse.layers.base_edge, coarse.layers.smallest_edge);
    EXPECT_GE(coarse.first_layers.base_edge, coarse.first_layers.smallest_edge);
}

TEST(SolverThresholds, ReachTheSolverAndItsNextSolution) {
    Scene scene;
    add_room(scene, 3, 2.5F, 3, add_material(scene, 0.5F));
    add_point_light(scene, {1.5, 2.2, 1.5}, 2000.0);
    GiEngine engine;
    SolveOptions options;
    options.quality = Quality::Draft;
    options.keep_for_updates = true;
    const auto solve = [&] {
        auto out = engine.solve(scene, options, {});
        EXPECT_TRUE(out);
        return *out;
    };
    const auto automatic = solve();
    scene.settings.thresholds.element_edge = 0.1F;
    scene.settings.thresholds.link_share = 1e-5F;
    const auto finer = solve();
    EXPECT_GT(finer->statistics.elements, 2 * automatic->statistics.elements);
    EXPECT_TRUE(finer->final);
    scene.settings.thresholds = {};
    EXPECT_EQ(solve()->statistics.elements, automatic->statistics.elements);
}

} // namespace
} // namespace atrium
