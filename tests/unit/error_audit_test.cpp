// The number beside the light: an error that is put in on purpose is found, and nothing but that.
#include "engine/measure/error_audit.h"

#include "engine/base/parallel.h"
#include "engine/raycast/ray_scene.h"
#include "engine/reference/lit_places.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using test::add_material;
using test::add_point_light;
using test::add_rectangle;
using test::add_room;

Scene room_with_lamp(double lumen) {
    Scene scene;
    add_room(scene, 4, 3, 5, add_material(scene, 0.5F));
    add_point_light(scene, {2, 2.2, 2.5}, lumen);
    return scene;
}

std::shared_ptr<const Solution> solve(const Scene& scene) {
    GiEngine engine;
    SolveOptions options;
    options.quality = SolverSettings::Quality::Draft;
    return *engine.solve(scene, options, RunContext{});
}

TEST(ErrorAudit, FindsAnErrorThatIsPutIn) {
    const Scene truth = room_with_lamp(1000);
    const auto right = audit_error(truth, *solve(truth), {}, RunContext{});
    ASSERT_TRUE(right);
    EXPECT_EQ(right->points, 512U);
    EXPECT_LT(right->rms, 0.03);
    EXPECT_LT(std::abs(right->bias), 0.01 + 2.0 * right->bias_error);
    // The light of a lamp that is a fifth too bright, held against the room as it is: 20 % everywhere.
    const auto wrong = audit_error(truth, *solve(room_with_lamp(1200)), {}, RunContext{});
    ASSERT_TRUE(wrong);
    EXPECT_NEAR(wrong->rms, 0.2, 0.02);
    EXPECT_NEAR(wrong->bias, 0.2, 0.01);
    EXPECT_NEAR(wrong->typical, 0.2, 0.02);
    EXPECT_LT(right->typical, 0.02);
    EXPECT_LE(wrong->low, 0.205);
    EXPECT_GE(wrong->high, 0.195);
    EXPECT_LE(wrong->low, wrong->rms);
    EXPECT_LE(wrong->rms, wrong->high);
}

TEST(ErrorAudit, IsTheSameForAnyNumberOfThreads) {
    const Scene scene = room_with_lamp(1000);
    const auto solution = solve(scene);
    set_thread_limit(1);
    auto one = audit_error(scene, *solution, {64, 64, 64}, RunContext{});
    set_thread_limit(0);
    auto many = audit_error(scene, *solution, {64, 64, 64}, RunContext{});
    ASSERT_TRUE(one && many);
    one->seconds = many->seconds = 0.0;
    EXPECT_EQ(*one, *many);
}

TEST(ErrorAudit, BecomesTheErrorEstimateAndIsKept) {
    const Scene scene = room_with_lamp(1000);
    const auto solution = solve(room_with_lamp(1200));
    const auto out = audited(scene, solution, {}, RunContext{});
    ASSERT_NE(out, solution);
    EXPECT_NEAR(out->statistics.error_estimate, 0.2, 0.02);
    EXPECT_EQ(out->statistics.error_estimate, out->statistics.audit.rms);
    EXPECT_EQ(out->surfaces, solution->surfaces) << "shared, not copied";
    const auto again = decode_solution(encode_solution(*out, scene), scene);
    ASSERT_TRUE(again);
    EXPECT_EQ((*again)->statistics.audit, out->statistics.audit);
}

TEST(ErrorAudit, LeavesLightAloneThatItCannotCompare) {
    Scene dark;
    add_room(dark, 4, 3, 5, add_material(dark, 0.5F));
    const auto solution = solve(dark);
    EXPECT_FALSE(audit_error(dark, *solution, {}, RunContext{}));
    EXPECT_EQ(audited(dark, solution, {}, RunContext{}), solution);
    const Scene lit = room_with_lamp(1000);
    const auto light = solve(lit);
    RunContext stopped;
    stopped.stop.request_stop();
    EXPECT_EQ(audited(lit, light, {}, stopped), light);
}

/// Of the places in a scene, how many lie on the node of that name, and how open they are at least.
std::pair<int, float> places_on(const Scene& scene, const std::string& name) {
    const RayScene rays(scene);
    const PathTracer tracer(scene, rays);
    int count = 0;
    float open = 1.0F;
    for (const LitPlace& place : lit_places(rays, tracer, 2000, 1)) {
        if (scene.nodes.find(place.node)->name == name) {
            ++count;
            open = std::min(open, place.open);
        }
    }
    return {count, open};
}

TEST(LitPlaces, LeaveOutWhatLiesOnSomethingAndTellGaps) {
    Scene scene = room_with_lamp(1000);
    const MaterialId paper = add_material(scene, 0.5F);
    // A poster on the wall: two faces in one plane; which of them is seen is left to rounding.
    add_rectangle(scene, "poster", {0, 1.5, 2.5}, {1, 0, 0}, {0, 0, 1}, 2, 1.5, paper);
    EXPECT_EQ(places_on(scene, "poster").first, 0);
    EXPECT_GT(places_on(scene, "wall x0").first, 10);
    // Two boards 5 mm apart that face each other.
    add_rectangle(scene, "left board", {2, 1, 2}, {0, 0, 1}, {1, 0, 0}, 1, 1, paper);
    add_rectangle(scene, "right board", {2, 1, 2.005}, {0, 0, -1}, {1, 0, 0}, 1, 1, paper);
    const auto [count, open] = places_on(scene, "left board");
    EXPECT_GT(count, 2);
    EXPECT_LT(open, 0.1F) << "only rays along the boards get 3.5 cm far";
    Scene empty = room_with_lamp(1000);
    EXPECT_GT(places_on(empty, "floor").second, 0.4F) << "the foot of a wall hides half";
}

} // namespace
} // namespace atrium
