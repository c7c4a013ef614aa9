// GiEngine::update(): things that are added or scaled are there at once.
#include "engine/base/parallel.h"
#include "engine/measure/light_difference.h"
#include "tests/support/followed_room.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace test;

std::shared_ptr<const Solution> anew(const Scene& scene) {
    return test::solve(scene, SolverSettings::Quality::Draft).solution;
}

/// Light where it can be seen, on all surfaces of `scene`, beside that of `truth`.
LightDifference beside(const Scene& scene, const Solution& light, const Solution& truth) {
    return light_difference(scene, light, truth, seen_places(scene, 2000));
}

// What is not there in `light` counts as dark; over the mean of `truth`.
double missing(const Scene& scene, const Solution& light, const Solution& truth) {
    std::vector<double> a, b;
    const std::vector<SensorPlace> places = seen_places(scene, 2000);
    for (const Solution* s : {&light, &truth}) {
        for (const SensorReading& r : read_surfaces(scene, *s, places)) {
            (s == &light ? a : b).push_back(r.on_surface ? luminance(r.irradiance) : 0.0);
        }
    }
    return relative_rms(a, b);
}

// On the surfaces of one node alone.
double off_on(const Scene& scene, NodeId node, const Solution& light, const Solution& truth) {
    return mean_irradiance(scene, light, node) / mean_irradiance(scene, truth, node) - 1.0;
}

NodeId add_table(Scene& scene, float rho = 0.6F) {
    return add_shape(scene, "table", Box{vec3(0.9F, 0.7F, 0.6F)}, {2.7, 0.36, 1.5}, add_material(scene, rho));
}

// The same thing, but that it stood elsewhere when all was solved.
std::shared_ptr<const Solution> moved_there(FollowedRoom& room, NodeId thing) {
    const dvec3 there = room.scene.nodes.find(thing)->transform.translation;
    room.scene.nodes.find(thing)->transform.translation += dvec3(-0.2, 0.0, 1.6);
    EXPECT_TRUE(room.solve());
    room.scene.nodes.find(thing)->transform.translation = there;
    EXPECT_TRUE(room.engine.update(room.scene, room.options, {}));
    room.options.settle = true;
    const auto out = room.engine.update(room.scene, room.options, {});
    return out ? *out : nullptr;
}

// The table is lit, throws its shadow and is seen by the walls around it: as good as where the same table was moved there.
TEST(Additions, WhatIsAddedIsThereAtOnce) {
    for (const float rho : {0.02F, 0.7F}) {
        FollowedRoom room(rho), moved(rho);
        const auto before = room.solve();
        ASSERT_TRUE(before);
        const NodeId table = add_table(room.scene);
        const auto truth = anew(room.scene);
        const auto hurried = room.engine.update(room.scene, room.options, {});
        ASSERT_TRUE(hurried) << hurried.error().message();
        EXPECT_EQ((*hurried)->surfaces.size(), before->surfaces.size() + 1);
        EXPECT_LT((*hurried)->statistics.rays, truth->statistics.rays / 6);
        room.options.settle = true;
        const auto settled = room.engine.update(room.scene, room.options, {});
        ASSERT_TRUE(settled) << settled.error().message();
        const auto placed = moved_there(moved, add_table(moved.scene));
        ASSERT_TRUE(placed);
        const double stale = missing(room.scene, *before, *truth);
        const double quick = missing(room.scene, **hurried, *truth), exact = missing(room.scene, **settled, *truth);
        const double as_moved = missing(moved.scene, *placed, *truth);
        std::printf("table in a room of %.2f: rms %.2f %%, settled %.2f %% (moved there %.2f %%), without it %.1f %%; on it "
                    "%+.1f %%, settled %+.1f %%\n",
                    double(rho), 100.0 * quick, 100.0 * exact, 100.0 * as_moved, 100.0 * stale,
                    100.0 * off_on(room.scene, table, **hurried, *truth),
                    100.0 * off_on(room.scene, table, **settled, *truth));
        EXPECT_LT(quick, 0.1 * stale);
        EXPECT_LT(exact, rho < 0.1F ? 0.05 * stale : 0.1 * stale);
        // Shadows on walls depend on what was there before, by no more than two solutions differ; reflected light does not.
        EXPECT_LT(exact, (rho < 0.1F ? 2.0 : 1.25) * as_moved);
        EXPECT_LT(std::abs(off_on(room.scene, table, **settled, *truth)), 0.025);
        // And the complete solution that follows is that of a scene which was always so.
        room.options.settle = false;
        EXPECT_EQ(room.floor_light(*room.solve()), room.floor_light(*truth));
    }
}

// It goes on with the hand, and goes and comes back as what was always there does.
TEST(Additions, WhatIsAddedMovesGoesAndComesBack) {
    FollowedRoom room;
    const auto before = room.solve();
    ASSERT_TRUE(before);
    const Scene without = room.scene;
    const NodeId table = add_table(room.scene);
    ASSERT_TRUE(room.engine.update(room.scene, room.options, {}));
    for (int step = 0; step < 3; ++step) {
        room.scene.nodes.find(table)->transform.translation += dvec3(-0.1, 0.0, 0.3);
        ASSERT_TRUE(room.engine.update(room.scene, room.options, {}));
    }
    const Scene with = room.scene;
    room.options.settle = true;
    const auto moved = room.engine.update(with, room.options, {});
    ASSERT_TRUE(moved);
    const auto truth = anew(with);
    const LightDifference d = beside(with, **moved, *truth);
    std::printf("added and moved: rms %.2f %%, energy %.3f %%\n", 100.0 * d.rel_rms, 100.0 * d.energy_rel);
    EXPECT_LT(d.rel_rms, 0.02);
    room.scene = without;
    const auto gone = room.engine.update(without, room.options, {});
    ASSERT_TRUE(gone) << gone.error().message();
    EXPECT_EQ((*gone)->surfaces.size(), before->surfaces.size());
    EXPECT_LT(relative_rms(room.floor_light(**gone), room.floor_light(*before)), 0.01) << "no trace";
    const auto back = room.engine.update(with, room.options, {});
    ASSERT_TRUE(back) << back.error().message();
    EXPECT_LT(beside(with, **back, **moved).rel_rms, 0.005);
}

// Deleted, all solved without it, and then undone: what the light knows nothing of any more is added again.
TEST(Additions, UndoOfADeleteAfterTheCompleteSolution) {
    FollowedRoom room;
    const Scene with = room.scene;
    const auto truth = anew(with);
    std::erase(room.scene.roots, room.box);
    room.scene.nodes.erase(room.box);
    ASSERT_TRUE(room.solve());
    room.scene = with;
    const auto back = room.engine.update(with, room.options, {});
    ASSERT_TRUE(back) << back.error().message();
    room.options.settle = true;
    const auto settled = room.engine.update(with, room.options, {});
    ASSERT_TRUE(settled);
    EXPECT_LT(relative_rms(room.floor_light(**back), room.floor_light(*truth)), 0.03);
    EXPECT_LT(relative_rms(room.floor_light(**settled), room.floor_light(*truth)), 0.015);
}

// A scale that changes is followed, step by step, and leaves nothing behind when it is taken back.
TEST(Additions, WhatIsScaledIsFollowed) {
    FollowedRoom room;
    const auto before = room.solve();
    ASSERT_TRUE(before);
    const Transform was = room.scene.nodes.find(room.box)->transform;
    for (int step = 1; step <= 4; ++step) {
        Transform& t = room.scene.nodes.find(room.box)->transform;
        t.scale = dvec3(1.0 + 0.3 * step, 1.0 + 0.1 * step, 1.0 + 0.2 * step);
        t.translation.y = 0.4 * t.scale.y + 0.01;
        const auto hurried = room.engine.update(room.scene, room.options, {});
        ASSERT_TRUE(hurried) << hurried.error().message();
        EXPECT_EQ((*hurried)->surfaces.size(), before->surfaces.size()) << "what it was is not shown";
    }
    room.options.settle = true;
    const auto settled = room.engine.update(room.scene, room.options, {});
    ASSERT_TRUE(settled);
    const auto truth = anew(room.scene);
    FollowedRoom moved;
    moved.scene = room.scene;
    const auto placed = moved_there(moved, room.box);
    ASSERT_TRUE(placed);
    const double left = missing(room.scene, **settled, *truth), stale = missing(room.scene, *before, *truth);
    const double as_moved = missing(room.scene, *placed, *truth);
    std::printf("scaled: rms %.2f %% (moved there %.2f %%) of %.1f %%\n", 100.0 * left, 100.0 * as_moved, 100.0 * stale);
    EXPECT_LT(left, 0.25 * stale);
    EXPECT_LT(left, 1.25 * as_moved);
    room.scene.nodes.find(room.box)->transform = was;
    const auto back = room.engine.update(room.scene, room.options, {});
    ASSERT_TRUE(back);
    EXPECT_LT(relative_rms(room.floor_light(**back), room.floor_light(*before)), 0.01);
}

// Lamps, colours and what was added follow in turn.
TEST(Additions, LampsAndPaintGoOnAfterwards) {
    FollowedRoom room;
    ASSERT_TRUE(room.solve());
    const NodeId table = add_table(room.scene);
    ASSERT_TRUE(room.engine.update(room.scene, room.options, {}));
    room.scene.lights.find(room.scene.nodes.find(room.point)->light)->intensity *= 0.5F;
    ASSERT_TRUE(room.engine.update(room.scene, room.options, {}));
    room.scene.materials.find(room.scene.nodes.find(table)->materials[0])->base_color = Rgb(0.2F, 0.6F, 0.2F);
    ASSERT_TRUE(room.engine.update(room.scene, room.options, {}));
    room.scene.nodes.find(room.point)->transform.translation.z += 0.8;
    ASSERT_TRUE(room.engine.update(room.scene, room.options, {}));
    const NodeId second = add_shape(room.scene, "stool", Box{vec3(0.3F)}, {1.0, 0.16, 3.0}, add_material(room.scene, 0.4F));
    ASSERT_TRUE(room.engine.update(room.scene, room.options, {}));
    room.scene.nodes.find(second)->transform.translation.x += 0.5;
    room.options.settle = true;
    const auto settled = room.engine.update(room.scene, room.options, {});
    ASSERT_TRUE(settled) << settled.error().message();
    const auto truth = anew(room.scene);
    const LightDifference d = beside(room.scene, **settled, *truth);
    std::printf("added, dimmed, painted, lamp moved, added: rms %.2f %%\n", 100.0 * d.rel_rms);
    EXPECT_LT(d.rel_rms, 0.04);
}

TEST(Additions, ThreadsDoNotMatter) {
    const auto light = [](unsigned threads) {
        set_thread_limit(threads);
        FollowedRoom room;
        EXPECT_TRUE(room.solve());
        add_table(room.scene);
        EXPECT_TRUE(room.engine.update(room.scene, room.options, {}));
        room.options.settle = true;
        const auto settled = room.engine.update(room.scene, room.options, {});
        set_thread_limit(0);
        return room.floor_light(**settled);
    };
    EXPECT_EQ(light(1), light(3));
}

} // namespace
} // namespace atrium
