// A wish for an error or a time takes the quality that it needs, and never gives up light that is complete.
#include "engine/measure/wished_solve.h"

#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using test::add_material;
using test::add_point_light;
using test::add_room;

Scene room_with_lamp() {
    Scene scene;
    add_room(scene, 4, 3, 5, add_material(scene, 0.5F));
    add_point_light(scene, {2, 2.2, 2.5}, 1000);
    return scene;
}

TEST(WishedSolve, WithoutAWishIsTheQualityAskedFor) {
    const Scene scene = room_with_lamp();
    GiEngine engine;
    SolveOptions options;
    options.quality = SolverSettings::Quality::Draft;
    const auto light = solve_to_wish(engine, scene, options, {}, RunContext{});
    ASSERT_TRUE(light);
    EXPECT_EQ((*light)->statistics.quality, "draft");
    EXPECT_EQ((*light)->statistics.audit.points, 0U) << "nobody asked for the error";
    const auto told = solve_to_wish(engine, scene, options, {.audit = true}, RunContext{});
    ASSERT_TRUE(told);
    EXPECT_GT((*told)->statistics.audit.points, 0U);
}

TEST(WishedSolve, AnErrorTakesAsMuchAsItNeeds) {
    const Scene scene = room_with_lamp();
    GiEngine engine;
    const auto easy = solve_to_wish(engine, scene, SolveOptions{}, {.error = 0.5}, RunContext{});
    ASSERT_TRUE(easy);
    EXPECT_EQ((*easy)->statistics.quality, "draft") << "whatever the options say";
    const double draft = (*easy)->statistics.error_estimate;
    ASSERT_GT(draft, 0.0);
    const double asked = 0.9 * draft;
    const auto better = solve_to_wish(engine, scene, SolveOptions{}, {.error = asked}, RunContext{});
    ASSERT_TRUE(better);
    EXPECT_NE((*better)->statistics.quality, "draft");
    EXPECT_LE((*better)->statistics.error_estimate, asked);
}

TEST(WishedSolve, WhatIsBegunInVainDoesNotReplaceADraft) {
    const Scene scene = room_with_lamp();
    GiEngine engine;
    RunContext context;
    context.deadline = RunContext::Clock::now() + std::chrono::hours(1);
    int complete = 0;
    const auto watch = [&](const std::shared_ptr<const Solution>& light) {
        if (light->final && ++complete == 1) {
            EXPECT_EQ(light->statistics.quality, "draft") << "something complete comes first";
        }
    };
    // The time would be enough for the finest step there is; the user's patience is not.
    context.on_progress = [&](const Progress&) {
        if (complete == 1) {
            context.stop.request_stop();
        }
    };
    const auto light = solve_to_wish(engine, scene, SolveOptions{}, {.best_in_time = true}, context, watch);
    ASSERT_TRUE(light);
    EXPECT_EQ(complete, 1);
    EXPECT_TRUE((*light)->final);
    EXPECT_EQ((*light)->statistics.quality, "draft");
}

TEST(WishedSolve, TimeThatIsOverGivesNoLight) {
    const Scene scene = room_with_lamp();
    GiEngine engine;
    RunContext context;
    context.deadline = RunContext::Clock::now() - std::chrono::seconds(1);
    EXPECT_FALSE(solve_to_wish(engine, scene, SolveOptions{}, {.best_in_time = true}, context));
}

} // namespace
} // namespace atrium
