// Light maps that are repaired where something moved: the same as new ones, at a fraction of the samples.
#include "engine/layers/direct_map_builder.h"
#include "engine/radiosity/light_shafts.h"
#include "tests/support/flat_charts.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>

namespace atrium {
namespace {

using namespace test;

constexpr float kFull = 1000.0F; // lux

/// Two floors of 3.2 m side by side, lit all over but for a round shadow that moves.
struct Shadow {
    Scene scene;
    std::unique_ptr<RayScene> rays;
    std::vector<SurfaceCharts> charts;
    DirectMapSettings settings;
    RunContext context;
    vec2 centre{-2.0F, 0.3F}; ///< engine coordinates
    float radius = 0.25F;
    std::atomic<std::size_t> calls = 0;

    Shadow() {
        const MaterialId grey = add_material(scene, 0.5F);
        add_rectangle(scene, "left", {-2, 0, 0}, {0, 1, 0}, {1, 0, 0}, 3.2F, 3.2F, grey);
        add_rectangle(scene, "right", {2, 0, 0}, {0, 1, 0}, {1, 0, 0}, 3.2F, 3.2F, grey);
        rays = std::make_unique<RayScene>(scene);
        charts = flat_charts(*rays);
    }
    float leaves = 0.0F; ///< per metre and direction, with gaps between them; 0 = one round shadow
    [[nodiscard]] float light_at(float x, float z) const {
        const vec2 d = vec2(x, z) - centre;
        const bool gap = leaves > 0.0F && std::sin(kPi * leaves * d.x) * std::sin(kPi * leaves * d.y) > 0.0F;
        return glm::length(d) > radius || gap ? kFull : 0.0F;
    }
    [[nodiscard]] std::vector<DirectPart> parts(bool soft = false) {
        DirectPart part;
        part.soft = soft;
        part.sharp = !soft;
        part.light = [this](const vec3& p, const vec3&) {
            ++calls;
            return DirectSample{Rgb(light_at(p.x, p.z)), 0.0F};
        };
        part.touched = [](const vec3& p, float r, const Box3& box) {
            return p.x > box.min.x - r && p.x < box.max.x + r && p.z > box.min.z - r && p.z < box.max.z + r;
        };
        return {part};
    }
    [[nodiscard]] std::unique_ptr<LiveDirectMaps> live(bool soft = false) {
        return std::make_unique<LiveDirectMaps>(
            *rays, charts, parts(soft), [](std::uint32_t) { return false; }, settings, context);
    }
    [[nodiscard]] Box3 box() const {
        Box3 out;
        out.add(vec3(centre.x - radius, -0.01F, centre.y - radius));
        out.add(vec3(centre.x + radius, 0.5F, centre.y + radius));
        return out;
    }
    /// Moves the shadow and says what that touches.
    LightChange move(const vec2& by) {
        LightChange change;
        change.moved.assign(2, 0);
        change.boxes.push_back(box());
        centre += by;
        change.boxes.push_back(box());
        return change;
    }
    [[nodiscard]] float shown(const DirectMaps& maps, const vec2& at) const {
        const std::size_t floor = at.x < 0.0F ? 0 : 1;
        return luminance(maps.front[floor]->irradiance(chart_position(charts[floor], vec3(at.x, 0.0F, at.y))));
    }
    /// RMS difference to the true light over the left floor, relative to full light.
    [[nodiscard]] double error(const DirectMaps& maps) const {
        std::mt19937 random(7);
        std::uniform_real_distribution<float> u(-1.5F, 1.5F);
        double sum = 0.0;
        constexpr int kPoints = 20000;
        for (int i = 0; i < kPoints; ++i) {
            const vec2 p(-2.0F + u(random), u(random));
            const double d = (shown(maps, p) - light_at(p.x, p.y)) / kFull;
            sum += d * d;
        }
        return std::sqrt(sum / kPoints);
    }
};

TEST(LiveDirectMaps, RepairIsAsGoodAsNewAndCostsAFraction) {
    Shadow shadow;
    auto live = shadow.live();
    DirectMaps maps = live->build(0.0, 1.0);
    ASSERT_TRUE(maps.complete);
    const std::shared_ptr<const LightMap> untouched = maps.front[1];
    for (const vec2& by : {vec2(0.3F, 0.1F), vec2(0.37F, -0.6F), vec2(-0.05F, 0.02F)}) {
        const LightChange change = shadow.move(by);
        EXPECT_GT(shadow.error(maps), 0.03) << "the old map is wrong here";
        const RepairReport report = live->repair(change, maps, shadow.context);
        ASSERT_TRUE(report.complete);
        EXPECT_EQ(report.surfaces, std::vector<std::uint32_t>{0});
        EXPECT_EQ(maps.front[1], untouched) << "shared while unchanged";
        Shadow fresh;
        fresh.centre = shadow.centre;
        const DirectMaps anew = fresh.live()->build(0.0, 1.0);
        EXPECT_LE(shadow.error(maps), 1.05 * fresh.error(anew) + 1e-3);
        EXPECT_LT(report.samples, anew.evaluations / 2);
    }
}

TEST(LiveDirectMaps, ThereAndBackLeavesNoTrace) {
    Shadow shadow;
    auto live = shadow.live();
    DirectMaps maps = live->build(0.0, 1.0);
    const double before = shadow.error(maps);
    ASSERT_TRUE(live->repair(shadow.move(vec2(0.6F, -0.4F)), maps, shadow.context).complete);
    ASSERT_TRUE(live->repair(shadow.move(vec2(-0.6F, 0.4F)), maps, shadow.context).complete);
    EXPECT_LE(shadow.error(maps), before + 1e-4) << "finer cells at most";
    // Nothing left to do: looking again changes nothing, and no map is made anew.
    EXPECT_TRUE(live->repair(shadow.move(vec2(0.0F)), maps, shadow.context).surfaces.empty());
}

TEST(LiveDirectMaps, NothingMovedNothingAsked) {
    Shadow shadow;
    auto live = shadow.live();
    DirectMaps maps = live->build(0.0, 1.0);
    shadow.calls = 0;
    LightChange elsewhere;
    elsewhere.moved.assign(2, 0);
    Box3 far;
    far.add(vec3(50.0F));
    far.add(vec3(51.0F));
    elsewhere.boxes.push_back(far);
    const RepairReport report = live->repair(elsewhere, maps, shadow.context);
    EXPECT_TRUE(report.complete);
    EXPECT_EQ(shadow.calls, 0U);
    EXPECT_EQ(report.samples, 0U);
}

TEST(LiveDirectMaps, AStoppedRepairIsDoneByTheNext) {
    Shadow shadow;
    auto live = shadow.live();
    DirectMaps maps = live->build(0.0, 1.0);
    const LightChange change = shadow.move(vec2(0.5F, 0.2F));
    RunContext stopped;
    stopped.stop.request_stop();
    EXPECT_FALSE(live->repair(change, maps, stopped).complete);
    ASSERT_TRUE(live->repair(change, maps, shadow.context).complete);
    Shadow fresh;
    fresh.centre = shadow.centre;
    EXPECT_LE(shadow.error(maps), 1.05 * fresh.error(fresh.live()->build(0.0, 1.0)) + 1e-3);
}

TEST(LiveDirectMaps, SoftLightFollowsOnTheCoarseGrid) {
    Shadow shadow;
    shadow.radius = 0.6F;
    auto live = shadow.live(true);
    DirectMaps maps = live->build(0.0, 1.0);
    const LightChange change = shadow.move(vec2(0.4F, 0.3F));
    const double stale = shadow.error(maps);
    const RepairReport report = live->repair(change, maps, shadow.context);
    ASSERT_TRUE(report.complete);
    EXPECT_LT(shadow.error(maps), 0.6 * stale);
    EXPECT_LE(report.samples, 1024U);
}

// A small shadow comes to lie between the corners of whole tiles, where nothing stood before.
TEST(LiveDirectMaps, SoftLightIsLookedAtCloselyWhereSomethingComesToStand) {
    Shadow shadow;
    shadow.radius = 0.12F;
    auto live = shadow.live(true);
    DirectMaps maps = live->build(0.0, 1.0);
    const LightChange change = shadow.move(vec2(-1.2F, 0.16F) - shadow.centre);
    EXPECT_NEAR(shadow.shown(maps, shadow.centre), kFull, 1.0);
    ASSERT_TRUE(live->repair(change, maps, shadow.context).complete);
    EXPECT_NEAR(shadow.shown(maps, shadow.centre), 0.0, 1.0);
    EXPECT_NEAR(shadow.shown(maps, shadow.centre + vec2(0.3F, 0.0F)), kFull, 1.0);
}

// Neither sharp nor soft: as soon as very much is touched, the coarsest samples stand for the others.
TEST(LiveDirectMaps, LargeChangesOfDearLightCostABoundedNumberOfSamples) {
    Shadow shadow;
    shadow.radius = 0.7F;
    std::vector<DirectPart> parts = shadow.parts();
    parts[0].sharp = false;
    LiveDirectMaps live(
        *shadow.rays, shadow.charts, parts, [](std::uint32_t) { return false; }, shadow.settings, shadow.context);
    DirectMaps maps = live.build(0.0, 1.0);
    const LightChange change = shadow.move(vec2(0.2F, 0.1F));
    const double stale = shadow.error(maps);
    const RepairReport report = live.repair(change, maps, shadow.context);
    ASSERT_TRUE(report.complete);
    EXPECT_LE(report.samples, 512U);
    EXPECT_LT(shadow.error(maps), stale);
}

// Sharp light of which very much is touched, as by many leaves: what stands for all is as fine as the number of samples
// allows.
TEST(LiveDirectMaps, LargeChangesOfSharpLightKeepTheirShape) {
    Shadow shadow;
    shadow.leaves = 9.0F;
    shadow.radius = 1.2F;
    auto live = shadow.live();
    DirectMaps maps = live->build(0.0, 1.0);
    const LightChange change = shadow.move(vec2(0.11F, 0.05F));
    const double stale = shadow.error(maps);
    const RepairReport report = live->repair(change, maps, shadow.context);
    ASSERT_TRUE(report.complete);
    const double left = shadow.error(maps);
    std::printf("of the error %.2f is left after %zu samples\n", left / stale, report.samples);
    EXPECT_LE(report.samples, 16384U);
    EXPECT_GT(report.samples, 2048U);
    EXPECT_LT(left, 0.6 * stale);
}

// ---- shafts

bool hits(const vec3& from, const vec3& to, const Box3& box) {
    for (int i = 0; i <= 400; ++i) {
        const vec3 p = glm::mix(from, to, float(i) / 400.0F);
        if (glm::all(glm::greaterThanEqual(p, box.min)) && glm::all(glm::lessThanEqual(p, box.max))) {
            return true;
        }
    }
    return false;
}

TEST(LightShafts, NoTouchedShaftIsMissedAndMostOthersAreLeftOut) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> u(-1.0F, 1.0F);
    const auto point = [&](float scale) { return vec3(u(random), u(random), u(random)) * scale; };
    int touched = 0, named = 0;
    for (int i = 0; i < 10000; ++i) {
        const vec3 from = point(4.0F), centre = point(4.0F);
        const float radius = 0.2F + 0.2F * u(random);
        Box3 box;
        const vec3 at = point(4.0F);
        box.add(at - vec3(0.3F));
        box.add(at + vec3(0.3F));
        bool any = false;
        for (int k = 0; k < 30; ++k) {
            vec3 d = point(1.0F);
            d = glm::length(d) > 1.0F ? glm::normalize(d) : d;
            any = any || hits(from, centre + d * radius, box);
        }
        const bool said = shaft_to_ball_touches(from, 0.0F, centre, radius, box);
        EXPECT_TRUE(said || !any) << i;
        // A ball around the point that holds it can only touch more.
        EXPECT_TRUE(!any || shaft_to_ball_touches(from + vec3(0.1F, 0.0F, 0.0F), 0.1F, centre, radius, box)) << i;
        touched += any ? 1 : 0;
        named += said ? 1 : 0;
        const vec3 to_sun = glm::normalize(point(1.0F) + vec3(0.0F, 1e-3F, 0.0F));
        if (hits(from, from + to_sun * 40.0F, box)) {
            EXPECT_TRUE(shaft_to_sun_touches(from, 0.0F, to_sun, 0.005F, box)) << i;
        }
    }
    EXPECT_GT(touched, 50);
    EXPECT_LT(named, 3 * touched);
}

TEST(LightShafts, OverAMirrorBothWaysCount) {
    Scene scene;
    Material metal;
    metal.metallic = 1.0F;
    metal.roughness = 0.0F;
    metal.base_color = Rgb(1.0F);
    add_rectangle(scene, "mirror", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, scene.materials.insert(metal));
    add_point_light(scene, {1, 2, 0}, 1000.0);
    const RayScene rays(scene);
    const vec3 o(rays.origin());
    const DirectLight lights(scene, rays);
    const MirrorLight mirrors(rays);
    ASSERT_FALSE(mirrors.empty());
    LightShafts shafts;
    shafts.add_lamps(lights);
    shafts.over_mirrors(mirrors.mirrors());
    const auto box_at = [&](const vec3& p) {
        Box3 box;
        box.add(p - o - vec3(0.1F));
        box.add(p - o + vec3(0.1F));
        return box;
    };
    const vec3 point = vec3(-1, 2, 0) - o; // sees the lamp at (0, 0, 0) of the mirror
    EXPECT_TRUE(shafts.touched(point, 0.0F, box_at({-0.5F, 1, 0}))) << "between the point and the mirror";
    EXPECT_TRUE(shafts.touched(point, 0.0F, box_at({0.5F, 1, 0}))) << "between the mirror and the lamp";
    EXPECT_FALSE(shafts.touched(point, 0.0F, box_at({0, 2, 0}))) << "straight between them";
    EXPECT_FALSE(shafts.touched(point, 0.0F, box_at({0, 1, 1})));
}

} // namespace
} // namespace atrium
