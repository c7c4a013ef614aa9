// GiEngine::update() while lamps move, turn and change their shape: against solutions that know of no past.
#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/measure/light_difference.h"
#include "engine/radiosity/lamp_reach.h"
#include "engine/radiosity/mirror_light.h"
#include "engine/scene/photometric_web.h"
#include "tests/support/light_cases.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <random>

namespace atrium {
namespace {

using namespace test;

/// A room with a box on its floor and a ball above it, two point lights, a spot, and what else is wished for.
struct Room {
    Scene scene;
    NodeId box, ball, point, other, spot;
    GiEngine engine;
    SolveOptions options;

    explicit Room(float rho = 0.5F) {
        add_room(scene, 4, 3, 4, add_material(scene, rho));
        box = add_shape(scene, "box", Box{vec3(0.4F, 0.8F, 0.4F)}, {1.2, 0.41, 1.2}, add_material(scene, rho));
        ball = add_shape(scene, "ball", Sphere{0.2F}, {2.6, 1.0, 1.6}, add_material(scene, rho));
        point = add_point_light(scene, {0.6, 2.4, 0.6}, 1500.0);
        other = add_point_light(scene, {3.2, 1.6, 3.0}, 500.0);
        spot = add_point_light(scene, {2.2, 2.8, 2.4}, 1500.0);
        Light& light = *scene.lights.find(scene.nodes.find(spot)->light);
        light.kind = Light::Kind::Spot;
        light.outer_cone = 0.5F;
        light.inner_cone = 0.3F;
        scene.nodes.find(spot)->transform.rotation = glm::angleAxis(-0.5 * kPiD, dvec3(1, 0, 0));
        scene.settings.quality = options.quality = SolverSettings::Quality::Draft;
        options.keep_for_updates = true;
    }
    Light& light_of(NodeId node) { return *scene.lights.find(scene.nodes.find(node)->light); }
    void move(NodeId node, const dvec3& by) { scene.nodes.find(node)->transform.translation += by; }
    void turn(NodeId node, double angle) {
        dquat& q = scene.nodes.find(node)->transform.rotation;
        q = glm::normalize(glm::angleAxis(angle, dvec3(0, 0, 1)) * q);
    }
    std::shared_ptr<const Solution> solve() {
        auto r = engine.solve(scene, options, {});
        return r ? *r : nullptr;
    }
    std::shared_ptr<const Solution> update(bool settle = false) {
        SolveOptions how = options;
        how.settle = settle;
        auto r = engine.update(scene, how, {});
        EXPECT_TRUE(r) << r.error().message();
        return r ? *r : nullptr;
    }
    [[nodiscard]] std::shared_ptr<const Solution> fresh(std::uint32_t seed = 1) const {
        return test::solve(scene, options.quality, seed).solution;
    }
};

double apart(const Scene& scene, const Solution& a, const Solution& b) {
    return light_difference(scene, a, b, seen_places(scene, 3000)).rel_rms;
}

/// How far light is from a solution of the same scene.
struct Followed {
    double hurried = 0.0, settled = 0.0, stayed = 0.0, seeds = 0.0;
};

// Three hurried steps, then settled. `most_rays`: of those of a solution, what a step may take.
Followed follow(const std::string& name, Room& room, const std::function<void(Room&)>& step, double most_rays = 0.125) {
    const auto before = room.solve();
    EXPECT_TRUE(before);
    std::shared_ptr<const Solution> light;
    for (int i = 0; i < 3; ++i) {
        step(room);
        light = room.update();
        EXPECT_TRUE(light && light->statistics.update.degraded && !light->final);
    }
    const auto settled = room.update(true);
    const auto truth = room.fresh(), other = room.fresh(2);
    Followed out{apart(room.scene, *light, *truth), apart(room.scene, *settled, *truth), apart(room.scene, *before, *truth),
                 apart(room.scene, *other, *truth)};
    std::printf("%s: rms %.2f %%, settled %.2f %%, had it stayed %.1f %%, two seeds %.2f %%; rays %.1f %% and %.1f %%\n",
                name.c_str(), 100.0 * out.hurried, 100.0 * out.settled, 100.0 * out.stayed, 100.0 * out.seeds,
                100.0 * double(light->statistics.rays) / double(truth->statistics.rays),
                100.0 * double(settled->statistics.rays) / double(truth->statistics.rays));
    EXPECT_LT(double(light->statistics.rays), most_rays * double(truth->statistics.rays));
    EXPECT_LT(settled->statistics.rays, truth->statistics.rays);
    return out;
}

TEST(LampMoves, APointLightTakesItsLightAlong) {
    Room room;
    const Followed f = follow("point", room, [](Room& r) { r.move(r.point, {0.35, -0.2, 0.3}); });
    EXPECT_LT(f.hurried, 0.2 * f.stayed);
    EXPECT_LT(f.settled, 0.1 * f.stayed);
}

// A lamp that was not there, or was off when all was solved, shines at once; then it goes on as the others do.
TEST(LampMoves, ANewLampShines) {
    Room room;
    int step = 0;
    const Followed f = follow("new lamp", room, [&](Room& r) {
        if (step++ == 0) {
            r.light_of(r.other).intensity *= 1.5F; // both at once
            add_point_light(r.scene, {1.2, 1.8, 2.6}, 1200.0);
        } else {
            r.move(r.scene.roots.back(), {0.3, 0.1, -0.2});
        }
    });
    EXPECT_LT(f.hurried, 0.2 * f.stayed);
    EXPECT_LT(f.settled, 0.1 * f.stayed);
}

TEST(LampMoves, ALampThatIsSwitchedOnShinesAndGoesOffAgain) {
    Room room;
    room.light_of(room.other).enabled = false;
    const auto before = room.solve();
    ASSERT_TRUE(before);
    const Scene off = room.scene;
    room.light_of(room.other).enabled = true;
    ASSERT_TRUE(room.update());
    const auto on = room.update(true);
    ASSERT_TRUE(on);
    const double error = apart(room.scene, *on, *room.fresh()), stale = apart(room.scene, *before, *room.fresh());
    std::printf("switched on: rms %.2f %%, had it stayed %.1f %%\n", 100.0 * error, 100.0 * stale);
    EXPECT_LT(error, 0.1 * stale);
    room.scene = off;
    const auto again = room.update();
    ASSERT_TRUE(again);
    EXPECT_LT(apart(room.scene, *again, *before), 0.01) << "as if it had never shone";
}

// Its light in mirrors that are no planes comes with the complete solution, but nothing else is left out.
TEST(LampMoves, ANewLampBesideMirrorsAndGlass) {
    Room room;
    Material metal;
    metal.metallic = 1.0F;
    metal.roughness = 0.0F;
    add_shape(room.scene, "mirror ball", Sphere{0.25F}, {3.2, 0.3, 1.0}, room.scene.materials.insert(metal));
    const auto before = room.solve();
    ASSERT_TRUE(before);
    add_point_light(room.scene, {1.2, 1.8, 2.6}, 1200.0);
    ASSERT_TRUE(room.update());
    const auto settled = room.update(true);
    ASSERT_TRUE(settled);
    room.light_of(room.point).intensity *= 0.5F;
    const auto dimmed = room.update();
    ASSERT_TRUE(dimmed);
    const auto truth = room.fresh();
    const double error = apart(room.scene, *dimmed, *truth), stale = apart(room.scene, *before, *truth);
    std::printf("new lamp beside a mirror ball: rms %.2f %%, had it stayed %.1f %%\n", 100.0 * error, 100.0 * stale);
    EXPECT_LT(error, 0.2 * stale);
}

// Nearly black walls: all light is direct, and once settled as good as new.
TEST(LampMoves, SettledDirectLightIsThatOfANewSolution) {
    Room room(0.02F);
    const Followed f = follow("dark room", room, [](Room& r) { r.move(r.point, {0.35, -0.2, 0.3}); });
    EXPECT_LT(f.hurried, 0.15 * f.stayed);
    EXPECT_LT(f.settled, 0.01);
}

TEST(LampMoves, ASpotThatTurnsTakesItsConeAlong) {
    Room room;
    const Followed f = follow("spot", room, [](Room& r) { r.turn(r.spot, 0.15); });
    EXPECT_LT(f.hurried, 0.2 * f.stayed);
    EXPECT_LT(f.settled, 0.1 * f.stayed);
}

TEST(LampMoves, ASpotThatOpensIsFollowedToo) {
    Room room;
    const Followed f = follow("cone", room, [](Room& r) { r.light_of(r.spot).outer_cone += 0.1F; });
    EXPECT_LT(f.hurried, 0.25 * f.stayed);
    EXPECT_LT(f.settled, 0.1 * f.stayed);
}

TEST(LampMoves, TheSunGoesRound) {
    Room room;
    // A hole in the ceiling would do; a sun within the room's walls does as well: there is no outside here.
    Scene& s = room.scene;
    for (const NodeId id : s.roots) {
        if (s.nodes.find(id)->name == "ceiling") {
            s.nodes.find(id)->transform.translation.x += 1.5;
        }
    }
    Light sun;
    sun.kind = Light::Kind::Directional;
    sun.intensity = 3000.0F;
    Node node;
    node.light = s.lights.insert(sun);
    node.transform.rotation = glm::angleAxis(-1.2, dvec3(1, 0, 0));
    const NodeId id = s.nodes.insert(node);
    s.roots.push_back(id);
    const Followed f = follow("sun", room, [id](Room& r) { r.turn(id, 0.06); });
    EXPECT_LT(f.hurried, 0.3 * f.stayed);
    EXPECT_LT(f.settled, 0.1 * f.stayed);
}

// What such a lamp sends depends on how it is turned about its axis too.
TEST(LampMoves, APhotometricLampTurnsAboutItsAxis) {
    Room room;
    PhotometricData web;
    web.vertical = {0.0F, 45.0F, 80.0F};
    web.horizontal = {0.0F, 180.0F, 360.0F}; // bright on one side
    web.candela = {500, 1500, 0, 500, 100, 0, 500, 1500, 0};
    ASSERT_EQ(PhotometricWeb::coverage_fault(web), "");
    set_photometry(room.light_of(room.spot), std::make_shared<const PhotometricWeb>(std::move(web)));
    const Followed f = follow("photometric", room, [](Room& r) {
        dquat& q = r.scene.nodes.find(r.spot)->transform.rotation;
        q = glm::normalize(q * glm::angleAxis(0.6, dvec3(0, 0, 1)));
    });
    EXPECT_LT(f.hurried, 0.25 * f.stayed);
    EXPECT_LT(f.settled, 0.2 * f.stayed);
}

// An architect drags a lamp by its shade: an object and a light at once.
TEST(LampMoves, ALampInItsShadeIsFollowed) {
    Room room;
    Node group;
    group.name = "lamp with a shade";
    group.transform.translation = {0.9, 1.8, 2.6};
    const NodeId id = room.scene.nodes.insert(group);
    room.scene.roots.push_back(id);
    const NodeId shade = add_shape(room.scene, "shade", Cylinder{0.15F, 0.2F}, {0, 0, 0}, add_material(room.scene, 0.5F));
    const NodeId bulb = add_point_light(room.scene, {0, 0.2, 0}, 600.0);
    for (const NodeId child : {shade, bulb}) {
        room.scene.nodes.find(child)->parent = id;
        room.scene.nodes.find(id)->children.push_back(child);
        std::erase(room.scene.roots, child);
    }
    // Sight past the shade takes most rays, a fixed number, and this room is solved with few.
    const Followed f = follow(
        "shade", room,
        [id](Room& r) {
            r.move(id, {0.2, 0.05, -0.2});
        },
        0.5);
    EXPECT_LT(f.hurried, 0.3 * f.stayed);
    EXPECT_LT(f.settled, 0.12 * f.stayed);
}

// What it sends over a flat mirror goes along, and particles over a ball of metal are traced again.
TEST(LampMoves, LightOverMirrorsAndMetalGoesAlong) {
    Room room(0.2F);
    Material silver;
    silver.metallic = 1.0F;
    silver.roughness = 0.0F;
    silver.base_color = Rgb(0.9F);
    const MaterialId id = room.scene.materials.insert(silver);
    add_rectangle(room.scene, "mirror", {3.95, 1.4, 1.4}, {-1, 0, 0}, {0, 0, 1}, 1.6F, 1.8F, id);
    add_shape(room.scene, "metal", Sphere{0.25F}, {2.0, 0.3, 3.0}, id);
    const Followed f = follow("mirror", room, [](Room& r) { r.move(r.point, {0.35, -0.2, 0.3}); });
    EXPECT_LT(f.hurried, 0.2 * f.stayed);
    EXPECT_LT(f.settled, 0.1 * f.stayed);
}

// All light that is not that of the lamp stays to the last bit: where it does not shine, before or now, nothing changes.
TEST(LampMoves, LightOfOthersStaysToTheBit) {
    Room room(0.0F);
    const auto before = room.solve();
    room.turn(room.spot, 0.1);
    const auto after = room.update();
    const std::vector<SensorPlace> places = seen_places(room.scene, 6000);
    const auto was = read_surfaces(room.scene, *before, places), is = read_surfaces(room.scene, *after, places);
    const dvec3 spot = room.scene.nodes.find(room.spot)->transform.translation;
    std::size_t same = 0, other = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const dvec3 d = glm::normalize(places[i].point - spot);
        const bool outside = std::acos(std::clamp(-d.y, -1.0, 1.0)) > 0.5 + 0.1 + 0.25; // a tile reads its neighbours
        if (outside) {
            EXPECT_EQ(was[i].irradiance, is[i].irradiance) << i;
            ++same;
        } else {
            other += was[i].irradiance != is[i].irradiance ? 1 : 0;
        }
    }
    EXPECT_GT(same, 1000U);
    EXPECT_GT(other, 100U);
}

TEST(LampMoves, ThereAndBackLeavesNoTrace) {
    for (const bool settle : {false, true}) {
        Room room;
        const auto before = room.solve();
        room.move(room.point, {0.7, -0.3, 0.4});
        room.turn(room.spot, 0.4);
        ASSERT_TRUE(room.update());
        room.move(room.point, {-0.7, 0.3, -0.4});
        room.turn(room.spot, -0.4);
        const auto back = room.update(settle);
        ASSERT_TRUE(back);
        const double left = apart(room.scene, *back, *before);
        std::printf("there and back%s: rms %.3f %%\n", settle ? ", settled" : "", 100.0 * left);
        EXPECT_LT(left, settle ? 0.001 : 0.02); // in a hurry shadows are coarser than they were
    }
}

// A hundred steps are as good as one: light is the part that stays and what the lamps send now.
TEST(LampMoves, ManyStepsDoNotDrift) {
    const auto after = [](int steps) {
        Room room;
        EXPECT_TRUE(room.solve());
        const dvec3 from = room.scene.nodes.find(room.point)->transform.translation;
        for (int i = 1; i <= steps; ++i) {
            const double t = double(i) / steps;
            room.scene.nodes.find(room.point)->transform.translation =
                from + t * dvec3(1.0, -0.4, 0.8) + (i < steps ? 0.2 * std::sin(double(i)) : 0.0) * dvec3(1, 0, 0);
            EXPECT_TRUE(room.update());
        }
        const auto settled = room.update(true);
        return std::pair(room.scene, settled);
    };
    const auto many = after(40), one = after(1);
    const double off = apart(one.first, *many.second, *one.second);
    std::printf("40 steps and 1: %.3f %% apart\n", 100.0 * off);
    EXPECT_LT(off, 0.005);
}

// Stopped anywhere, and one more step or a dimmer after it: the next update makes all of it good.
TEST(LampMoves, AStoppedUpdateIsDoneByTheNext) {
    Room other;
    ASSERT_TRUE(other.solve());
    other.move(other.point, {0.6, -0.2, 0.3});
    other.light_of(other.point).intensity *= 0.5F;
    const auto at_once = other.update(true);
    for (const double seconds : {0.0, 0.002, 0.005, 0.01, 0.02, 0.04, 0.08}) {
        Room room;
        ASSERT_TRUE(room.solve());
        room.move(room.point, {0.3, -0.1, 0.1});
        RunContext stopped;
        stopped.deadline =
            std::chrono::steady_clock::now() +
            std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
        (void)room.engine.update(room.scene, room.options, stopped); // it may have been fast enough
        ASSERT_TRUE(room.engine.can_update());
        room.move(room.point, {0.3, -0.1, 0.2});
        room.light_of(room.point).intensity *= 0.5F;
        ASSERT_TRUE(room.update());
        const auto late = room.update(true);
        ASSERT_TRUE(late);
        EXPECT_LT(apart(room.scene, *late, *at_once), 0.002) << seconds;
    }
}

// Dimming a lamp that moved, moving one that was dimmed, switching off and on: each goes on from what is shown.
TEST(LampMoves, DimmersAndMovesTakeTurns) {
    Room room;
    const auto before = room.solve();
    ASSERT_TRUE(before);
    room.light_of(room.point).intensity *= 0.5F;
    ASSERT_TRUE(room.update());
    room.move(room.point, {0.5, -0.2, 0.3});
    ASSERT_TRUE(room.update());
    room.light_of(room.point).intensity *= 1.5F;
    room.light_of(room.other).color = Rgb(1.0F, 0.5F, 0.5F);
    ASSERT_TRUE(room.update());
    ASSERT_TRUE(room.update(true));
    room.scene.nodes.find(room.other)->visible = false;
    ASSERT_TRUE(room.update());
    room.move(room.spot, {-0.4, 0.0, 0.2});
    room.move(room.box, {0.2, 0.0, 0.3});
    ASSERT_TRUE(room.update());
    const auto settled = room.update(true);
    ASSERT_TRUE(settled);
    const auto truth = room.fresh();
    const double off = apart(room.scene, *settled, *truth), stale = apart(room.scene, *before, *truth);
    std::printf("taking turns: rms %.2f %%, had it stayed %.1f %%\n", 100.0 * off, 100.0 * stale);
    EXPECT_LT(off, 0.1 * stale);
    EXPECT_NEAR(settled->mean_radiance, truth->mean_radiance, 0.1 * truth->mean_radiance);
}

// The same for any number of threads.
TEST(LampMoves, ThreadsDoNotMatter) {
    const auto light = [](unsigned threads) {
        set_thread_limit(threads);
        Room room;
        EXPECT_TRUE(room.solve());
        room.move(room.point, {0.5, -0.2, 0.3});
        EXPECT_TRUE(room.update());
        const auto settled = room.update(true);
        std::vector<Rgb> out;
        for (const SensorReading& r : read_surfaces(room.scene, *settled, seen_places(room.scene, 2000))) {
            out.push_back(r.irradiance);
        }
        set_thread_limit(0);
        return out;
    };
    EXPECT_EQ(light(1), light(3));
}

// The complete solution knows nothing of it.
TEST(LampMoves, TheCompleteSolutionIsThatOfANewScene) {
    Room room;
    ASSERT_TRUE(room.solve());
    room.move(room.point, {0.5, -0.2, 0.3});
    ASSERT_TRUE(room.update());
    const auto complete = room.solve(), fresh = room.fresh();
    ASSERT_TRUE(complete && fresh);
    EXPECT_EQ(apart(room.scene, *complete, *fresh), 0.0);
}

// ---- what lamps can reach

// Nowhere is there more light than the bound says, and in most places far from the cone it says none.
TEST(LampReach, IsNeverBelowTheLight) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> u(-1.0F, 1.0F);
    const auto unit = [&] {
        vec3 v(0.0F);
        do {
            v = vec3(u(random), u(random), u(random));
        } while (!(glm::dot(v, v) <= 1.0F && glm::dot(v, v) > 0.01F));
        return glm::normalize(v);
    };
    Scene scene; // one far away, for a ray scene with bounds
    Material metal;
    metal.metallic = 1.0F;
    metal.roughness = 0.0F;
    metal.base_color = Rgb(1.0F);
    add_rectangle(scene, "mirror", {0, -2, 0}, {0, 1, 0}, {1, 0, 0}, 2, 2, scene.materials.insert(metal));
    const RayScene rays(scene);
    const PlanarMirrors mirrors(rays);
    ASSERT_FALSE(mirrors.empty());
    int dark = 0, lit = 0;
    for (int i = 0; i < 4000; ++i) {
        PlacedLight lamp;
        lamp.light.kind = i % 3 == 0 ? Light::Kind::Point : i % 3 == 1 ? Light::Kind::Spot : Light::Kind::Directional;
        lamp.light.outer_cone = 0.6F;
        lamp.light.intensity = 100.0F;
        lamp.position = 3.0F * vec3(u(random), u(random), u(random));
        lamp.axis = unit();
        const vec3 centre = 3.0F * vec3(u(random), u(random), u(random)), normal = unit();
        const float radius = 0.3F;
        const float bound = most_light(lamp, centre, radius, normal);
        const float over = most_light_over(mirrors.mirrors()[0], lamp, centre, radius, normal);
        dark += bound == 0.0F ? 1 : 0;
        const DirectLight light({lamp}, rays);
        const MirrorLight by_mirror(rays);
        for (int k = 0; k < 20; ++k) {
            vec3 across = unit();
            across -= normal * glm::dot(across, normal);
            const vec3 p = centre + across * (radius * 0.999F);
            const float straight = max_component(light.lamps_irradiance(p, normal, 16).irradiance);
            const float mirrored = max_component(by_mirror.irradiance(p, normal, {}, &light, nullptr).irradiance);
            EXPECT_LE(straight, bound * 1.001F) << i;
            EXPECT_LE(mirrored, over * 1.001F) << i;
            lit += straight > 0.0F || mirrored > 0.0F ? 1 : 0;
        }
    }
    EXPECT_GT(dark, 1000);
    EXPECT_GT(lit, 1000);
}

} // namespace
} // namespace atrium
