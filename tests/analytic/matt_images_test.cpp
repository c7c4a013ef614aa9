// Images of matt surfaces: what a lit panel throws through glass and over bent mirrors, against the reference tracer.
#include "engine/base/parallel.h"
#include "engine/reference/reference.h"
#include "engine/solver/memory_budget.h"
#include "tests/support/followed_room.h"
#include "tests/support/light_cases.h"
#include "tests/support/moving_caustics.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using test::add_material;
using test::add_rectangle;
using test::Solved;

NodeId add_spot(Scene& scene, const dvec3& at, const dvec3& towards, float candela) {
    Light light;
    light.kind = Light::Kind::Spot;
    light.intensity = candela;
    light.inner_cone = 0.16F;
    light.outer_cone = 0.22F;
    Node node;
    node.name = "spot";
    node.light = scene.lights.insert(light);
    const dvec3 z = glm::normalize(at - towards);
    const dvec3 x = glm::normalize(glm::cross(dvec3(0, 1, 0), z));
    node.transform.translation = at;
    node.transform.rotation = glm::normalize(glm::quat_cast(dmat3(x, glm::cross(z, x), z)));
    scene.roots.push_back(scene.nodes.insert(node));
    return scene.roots.back();
}

/// A panel in the light of a spot lamp, 1 m above the middle of a ball of glass that images it onto the floor. No light of
/// the lamp meets the ball.
struct PanelOverBall {
    Scene scene;
    NodeId panel, ball, lamp, box;
    MaterialId of_panel;

    explicit PanelOverBall(float panel_rho = 0.8F) {
        of_panel = add_material(scene, panel_rho);
        test::add_room(scene, 3, 2.4F, 3, add_material(scene, 0.3F));
        panel = add_rectangle(scene, "panel", {1.5, 1.43, 1.5}, {0, -1, 0}, {1, 0, 0}, 0.4F, 0.4F, of_panel);
        ball = test::add_shape(scene, "ball", Sphere{0.2F}, {1.5, 0.43, 1.5}, test::add_specular(scene, true));
        lamp = add_spot(scene, {0.5, 0.9, 1.5}, {1.5, 1.43, 1.5}, 8000.0F);
        box = test::add_shape(scene, "box", Box{vec3(0.2F, 0.02F, 0.2F)}, {2.6, 0.02, 2.6}, add_material(scene, 0.3F));
    }
};

// On the floor, in the image and outside of it, from the middle below the ball.
std::vector<ReferencePoint> places(const dvec2& middle = {1.5, 1.5}) {
    std::vector<ReferencePoint> out;
    for (const dvec2& d : {dvec2(0, 0), dvec2(0.05, 0), dvec2(-0.05, 0.03), dvec2(0.08, -0.06), dvec2(-0.1, 0),
                           dvec2(0.15, 0), dvec2(0, 0.4), dvec2(-0.6, 0.5)}) {
        out.push_back({{middle.x + d.x, 0.0, middle.y + d.y}, {0, 1, 0}});
    }
    return out;
}

constexpr std::size_t kBelow = 6; // of these: where the ball is in the way of the panel

std::vector<double> shown_at(const Scene& scene, const Solution& solution, const std::vector<ReferencePoint>& points) {
    std::vector<double> out;
    for (const ReferencePoint& p : points) {
        out.push_back(luminance(read_surface(scene, solution, p.position, p.normal).irradiance));
    }
    return out;
}

// Only what particles brought.
std::vector<double> caustics_at(const Scene& scene, const Solution& solution, const std::vector<ReferencePoint>& points) {
    Solution without = solution;
    for (auto& surface : without.surfaces) {
        auto layer = std::make_shared<SurfaceLayer>(*surface);
        layer->caustic_front.clear();
        layer->caustic_textures_front.clear();
        surface = std::move(layer);
    }
    std::vector<double> out = shown_at(scene, solution, points);
    const std::vector<double> rest = shown_at(scene, without, points);
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] -= rest[i];
    }
    return out;
}

ReferenceReadings truth_of(const Scene& scene, const std::vector<ReferencePoint>& points) {
    ReferenceSettings settings;
    settings.relative_error = 0.01;
    settings.paths = 1U << 20U;
    const auto out = reference_irradiance(scene, points, settings, RunContext{});
    EXPECT_TRUE(out);
    return out ? *out : ReferenceReadings{};
}

SolveOptions followed(SolverSettings::Quality quality) {
    SolveOptions out;
    out.quality = quality;
    out.keep_for_updates = true;
    return out;
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

// What the panel sends through the ball is what the room has of light less what it has with a black panel: all that bends
// another way, and what the panel sends to the walls and they to the floor, is a few lux. Four seeds of draft (normal)
// quality were 4 % (2.5 %) apart in the middle of the image: the bounds are three times that.
TEST(MattImages, PanelThroughABall) {
    const PanelOverBall room, black(0.0F);
    const ReferenceReadings truth = truth_of(room.scene, places()), rest = truth_of(black.scene, places());
    for (const auto& [quality, within] :
         {std::pair(SolverSettings::Quality::Draft, 0.12), std::pair(SolverSettings::Quality::Normal, 0.08)}) {
        const Solved s = test::solve(room.scene, quality);
        ASSERT_TRUE(s.solution);
        const std::vector<double> shown = shown_at(room.scene, *s.solution, places());
        const std::vector<double> brought = caustics_at(room.scene, *s.solution, places());
        double brightest = 0.0;
        for (const ReferenceReading& r : truth.points) {
            brightest = std::max(brightest, double(luminance(r.irradiance)));
        }
        for (std::size_t i = 0; i < places().size(); ++i) {
            const bool below = i < kBelow; // elsewhere the panel also sends straight to the floor
            const double expected = luminance(truth.points[i].irradiance);
            const double image = expected - luminance(rest.points[i].irradiance);
            const dvec3 at = places()[i].position;
            std::printf("%+.2f %+.2f: %.1f lux shown, %.1f expected (+- %.1f); by particles %.1f, of the panel %.1f\n",
                        at.x - 1.5, at.z - 1.5, shown[i], expected, truth.points[i].standard_error, brought[i], image);
            EXPECT_NEAR(shown[i], expected, within * brightest);
            EXPECT_NEAR(brought[i], below ? image : 0.0, within * brightest);
        }
        EXPECT_NEAR(s.solution->statistics.energy.defect, 0.0, 0.01);
        // A sensor in the air looks for itself, and finds all of it.
        const SensorReading in_the_air = s.engine.gather_free({1.5, 0.0, 1.5}, {0, 1, 0});
        EXPECT_NEAR(luminance(in_the_air.irradiance), luminance(truth.points[0].irradiance), 0.08 * brightest);
    }
}

// The memory for particles is for those of lamps and of matt surfaces together.
TEST(MattImages, CountInTheMemoryBudget) {
    PanelOverBall room;
    test::add_point_light(room.scene, {0.9, 0.43, 1.5}, 60.0); // shines through the ball too
    constexpr std::size_t kBudget = std::size_t(300) << 20U;
    QualitySettings most = quality_settings(SolverSettings::Quality::Normal, 4.0F, 0.0);
    const std::uint32_t wanted = most.particles;
    EXPECT_TRUE(keep_within(most, kBudget, 4000).particles);
    EXPECT_LE(most.particles, wanted);
    const Solved free = test::solve(room.scene);
    set_memory_budget(kBudget);
    const Solved bound = test::solve(room.scene);
    set_memory_budget(0);
    ASSERT_TRUE(free.solution && bound.solution);
    const Statistics &a = free.solution->statistics, &b = bound.solution->statistics;
    EXPECT_GT(a.particles_emitted, most.most_particles) << "or the bound would be none";
    EXPECT_LE(b.particles_emitted, most.most_particles + 100U) << "but for rounding";
    EXPECT_GT(b.particles_emitted, most.particles) << "those of matt surfaces have their share";
    EXPECT_LT(b.memory.particles, a.memory.particles);
    EXPECT_TRUE(lowered_by_memory(a.features).empty());
    const std::vector<std::string> lowered = lowered_by_memory(b.features);
    EXPECT_EQ(std::count(lowered.begin(), lowered.end(), "more_particles"), 1);
}

// Where nothing matt stands out no particle leaves any.
TEST(MattImages, NoneOfEvenWalls) {
    Scene scene;
    test::add_room(scene, 3, 2.4F, 3, add_material(scene, 0.5F));
    test::add_shape(scene, "ball", Sphere{0.2F}, {1.5, 0.43, 1.5}, test::add_specular(scene, true));
    add_rectangle(scene, "black", {1.5, 1.4, 1.5}, {0, 1, 0}, {1, 0, 0}, 1.0F, 1.0F, add_material(scene, 0.0F));
    test::add_point_light(scene, {1.5, 1.5, 1.5}, 1000.0); // the ball is in the shadow of what lies under it
    const Solved s = test::solve(scene, SolverSettings::Quality::Draft);
    ASSERT_TRUE(s.solution);
    EXPECT_EQ(s.solution->statistics.particles_emitted, 0U);
    EXPECT_EQ(s.solution->statistics.memory.caustic_textures, 0U);
}

// Brightness is no part of what is stored: a lamp that is dimmed and a panel that is painted need no particle.
TEST(MattImages, BrightnessTracesNothing) {
    PanelOverBall room;
    GiEngine engine;
    SolveOptions options = followed(SolverSettings::Quality::Draft);
    const auto before = engine.solve(room.scene, options, {});
    ASSERT_TRUE(before);
    const std::vector<double> bright = caustics_at(room.scene, **before, places());
    room.scene.lights.find(room.scene.nodes.find(room.lamp)->light)->intensity *= 0.5F;
    auto updated = engine.update(room.scene, options, {});
    ASSERT_TRUE(updated) << updated.error().message();
    std::vector<double> now = caustics_at(room.scene, **updated, places());
    for (std::size_t i = 0; i < now.size(); ++i) {
        EXPECT_NEAR(now[i], 0.5 * bright[i], 0.01 * largest(bright)) << i;
    }
    EXPECT_EQ((*updated)->statistics.update.particles_traced, 0U);
    // A panel of another colour, the rest as it is: what the leaves say is not taken off a second time.
    room.scene.materials.find(room.of_panel)->base_color = Rgb(0.2F);
    updated = engine.update(room.scene, options, {});
    ASSERT_TRUE(updated) << updated.error().message();
    EXPECT_EQ((*updated)->statistics.update.particles_traced, 0U);
    now = caustics_at(room.scene, **updated, places());
    for (std::size_t i = 0; i < now.size(); ++i) {
        EXPECT_NEAR(now[i], 0.125 * bright[i], 0.01 * largest(bright)) << i;
    }
    GiEngine fresh;
    const auto expected = fresh.solve(room.scene, options, {});
    ASSERT_TRUE(expected);
    const std::vector<double> truth = shown_at(room.scene, **expected, places());
    const double error = test::relative_rms(shown_at(room.scene, **updated, places()), truth);
    const double stale = test::relative_rms(shown_at(room.scene, **before, places()), truth);
    std::printf("painted: rms %.1f %%, had it stayed %.1f %%\n", 100.0 * error, 100.0 * stale);
    EXPECT_LT(error, 0.05 * stale);
    // Back again: not a bit is other than at first.
    room.scene.materials.find(room.of_panel)->base_color = Rgb(0.8F);
    room.scene.lights.find(room.scene.nodes.find(room.lamp)->light)->intensity *= 2.0F;
    updated = engine.update(room.scene, options, {});
    ASSERT_TRUE(updated) << updated.error().message();
    EXPECT_EQ(caustics_at(room.scene, **updated, places()), bright);
}

// Moves `what` by `by`; the settled light near where the image was and is against that of a new solution.
void follow_move(const NodeId PanelOverBall::*what, const dvec3& by, const char* name, double hurried_share) {
    PanelOverBall room;
    GiEngine engine;
    SolveOptions options = followed(SolverSettings::Quality::Draft);
    const auto before = engine.solve(room.scene, options, {});
    ASSERT_TRUE(before);
    Node& node = *room.scene.nodes.find(room.*what);
    const dvec3 home = node.transform.translation;
    node.transform.translation = home + by;
    const auto hurried = engine.update(room.scene, options, {});
    ASSERT_TRUE(hurried) << hurried.error().message();
    options.settle = true;
    const auto settled = engine.update(room.scene, options, {});
    ASSERT_TRUE(settled) << settled.error().message();
    options.settle = false;
    GiEngine fresh;
    const auto expected = fresh.solve(room.scene, options, {});
    ASSERT_TRUE(expected);
    std::vector<ReferencePoint> points = places();
    for (const ReferencePoint& p : places({1.5 + by.x, 1.5 + by.z})) {
        points.push_back(p);
    }
    const std::vector<double> truth = shown_at(room.scene, **expected, points);
    const std::vector<double> stale = shown_at(room.scene, **before, points);
    const double of_stale = test::relative_rms(stale, truth);
    const double of_hurried = test::relative_rms(shown_at(room.scene, **hurried, points), truth);
    const double of_settled = test::relative_rms(shown_at(room.scene, **settled, points), truth);
    std::printf("%s moved: rms %.1f %%, settled %.1f %%; had it stayed %.1f %%\n", name, 100.0 * of_hurried,
                100.0 * of_settled, 100.0 * of_stale);
    EXPECT_LT(of_hurried, hurried_share * of_stale) << name;
    EXPECT_LT(of_settled, 0.2 * of_stale) << name;
    room.scene.nodes.find(room.*what)->transform.translation = home;
    options.settle = true;
    const auto back = engine.update(room.scene, options, {});
    ASSERT_TRUE(back) << back.error().message();
    EXPECT_LT(test::relative_rms(shown_at(room.scene, **back, points), stale), 0.05) << name;
    const std::vector<double> image = caustics_at(room.scene, **before, points);
    const std::vector<double> again = caustics_at(room.scene, **back, points);
    for (std::size_t i = 0; i < image.size(); ++i) {
        EXPECT_NEAR(again[i], image[i], 0.01 * largest(image)) << name;
    }
}
// Places that saw the ball and see the room now wait for the settled light when they are looked at in a hurry.
TEST(MattImages, FollowTheBall) { follow_move(&PanelOverBall::ball, {0.25, 0.0, 0.1}, "ball", 0.4); }
TEST(MattImages, FollowThePanel) { follow_move(&PanelOverBall::panel, {-0.15, 0.0, 0.1}, "panel", 0.2); }
// Into the way of the light to the ball.
TEST(MattImages, FollowWhatStandsBetween) { follow_move(&PanelOverBall::box, {-1.1, 0.9, -1.1}, "box", 0.2); }

TEST(MattImages, SameForAnyNumberOfThreads) {
    const PanelOverBall room;
    std::vector<double> first;
    for (const unsigned threads : {1U, 2U, 8U}) {
        set_thread_limit(threads);
        const Solved s = test::solve(room.scene, SolverSettings::Quality::Draft);
        set_thread_limit(0);
        ASSERT_TRUE(s.solution);
        const std::vector<double> shown = shown_at(room.scene, *s.solution, places());
        first = first.empty() ? shown : first;
        EXPECT_EQ(shown, first) << threads;
    }
}

} // namespace
} // namespace atrium
