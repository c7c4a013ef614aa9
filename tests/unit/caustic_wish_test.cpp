// What is set by hand about caustics: textures, mesh, texels and threshold, and light that follows it without a new
// solution.
#include "engine/caustics/reconstruction.h"
#include "engine/scene/edit_script.h"
#include "engine/solver/gi_engine.h"
#include "tests/support/charted.h"
#include "tests/support/moving_caustics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace atrium {
namespace {

using namespace test;
using testing::HasSubstr;
using Decision = CausticRecord::Decision;
using Show = CausticWish::Show;

CausticSettings wishing(const CausticWish& wish) {
    CausticSettings settings;
    settings.wish = wish;
    return settings;
}

std::vector<CausticLanding> even(const Charted& c, std::uint32_t n) {
    std::vector<CausticLanding> out;
    for (std::uint32_t i = 0; i < n; ++i) {
        out.push_back(at_place(c, 2.0F * sobol_owen2(i, 0, 7), 1.0F / float(n), 3.0F / std::sqrt(float(n))));
    }
    return out;
}

TEST(CausticWish, TheMeshByHand) {
    const Charted c(rectangle(4, 4));
    const auto landings = spot(c, 20'000, {1.0F, 1.5F}, 0.2F);
    for (const bool paper : {false, true}) {
        CausticSettings settings = wishing({Show::Mesh, 0, 0});
        settings.paper = paper;
        const CausticSide side = c.build(landings, settings);
        EXPECT_TRUE(side.textures.empty());
        EXPECT_EQ(side.on_mesh.size(), landings.size());
        ASSERT_EQ(side.records.size(), 1U);
        const CausticRecord& r = side.records[0];
        EXPECT_EQ(r.decision, Decision::SetToMesh);
        EXPECT_EQ(r.found, Decision::Texture) << "what it would be by itself is told";
        EXPECT_EQ(r.wish, settings.wish);
        EXPECT_THAT(r.why, HasSubstr("set by hand to mesh, by itself texture"));
        EXPECT_NEAR(r.power_mesh, 1.0, 1e-5);
        EXPECT_EQ(r.power_texture, 0.0);
    }
}

TEST(CausticWish, ATextureByHand) {
    const Charted c(rectangle(2, 2));
    const auto landings = even(c, 20'000);
    ASSERT_EQ(c.build(landings).records.at(0).decision, Decision::Uniform);
    for (const bool paper : {false, true}) {
        CausticSettings settings = wishing({Show::Texture, 0, 0});
        settings.paper = paper;
        const CausticSide side = c.build(landings, settings);
        ASSERT_EQ(side.records.size(), 1U);
        EXPECT_EQ(side.records[0].decision, Decision::Texture);
        EXPECT_EQ(side.records[0].found, Decision::Uniform);
        EXPECT_FALSE(side.textures.empty());
        EXPECT_GT(side.records[0].power_texture, 0.95);
        EXPECT_NEAR(power_of(side, landings), 1.0, 1e-5);
    }
    // Nine particles fill no texture, whoever wishes it.
    const CausticSide few = c.build(even(c, 9), wishing({Show::Texture, 0, 0}));
    EXPECT_TRUE(few.textures.empty());
    EXPECT_EQ(few.records.at(0).decision, Decision::TooFew);
}

TEST(CausticWish, TexelsByHand) {
    const Charted c(rectangle(4, 4));
    const auto landings = spot(c, 20'000, {1.0F, 1.5F}, 0.2F);
    const CausticRecord automatic = c.build(landings).records.at(0);
    EXPECT_EQ(automatic.sizing, CausticRecord::Sizing::Footprints);
    EXPECT_GT(automatic.kernel, 0.0F);
    const CausticSide side = c.build(landings, wishing({Show::Automatic, 0.02F, 0}));
    const CausticRecord& r = side.records.at(0);
    EXPECT_EQ(r.sizing, CausticRecord::Sizing::ByHand);
    EXPECT_EQ(r.width, std::uint32_t(std::ceil(r.extent.x / 0.02F)));
    EXPECT_NE(r.width, automatic.width);
    EXPECT_THAT(r.why, HasSubstr("texels of 20.0 mm: set by hand"));
    EXPECT_NEAR(power_of(side, landings), 1.0, 1e-5);
    // Finer than the memory for textures allows: as fine as that.
    CausticSettings fine = wishing({Show::Automatic, 1e-5F, 0});
    fine.most_texels = 40'000;
    const CausticSide most = c.build(landings, fine);
    EXPECT_EQ(most.records.at(0).sizing, CausticRecord::Sizing::Memory);
    std::size_t texels = 0;
    for (const auto& t : most.textures) {
        texels += t->image.size();
    }
    EXPECT_LE(texels, 44'000U);
    EXPECT_GT(texels, 20'000U);
}

TEST(CausticWish, ThresholdByHand) {
    const Charted c(rectangle(4, 4));
    const auto landings = spot(c, 20'000, {1.0F, 1.5F}, 0.2F);
    const CausticRecord automatic = c.build(landings).records.at(0);
    ASSERT_EQ(automatic.decision, Decision::Texture);
    EXPECT_EQ(automatic.threshold, CausticSettings{}.least_dispersion);
    const CausticRecord high = c.build(landings, wishing({Show::Automatic, 0, 2.0F * automatic.dispersion})).records.at(0);
    EXPECT_EQ(high.decision, Decision::Uniform);
    EXPECT_EQ(high.threshold, 2.0F * automatic.dispersion);
    EXPECT_THAT(high.why, HasSubstr("set by hand"));
    EXPECT_EQ(c.build(landings, wishing({Show::Automatic, 0, 0.5F * automatic.dispersion})).records.at(0).decision,
              Decision::Texture);
}

TEST(CausticWish, IsAnEditThatChangesLight) {
    Stage stage;
    stage = test::stage();
    Scene& scene = stage.scene;
    const Scene before = scene;
    const NodeId floor = scene.roots.front();
    Node value = *scene.nodes.find(floor);
    value.caustics = {Show::Mesh, 0.005F, 8.0F};
    EXPECT_FALSE(leaves_light_unchanged(scene, {SetNode{floor, value}}));
    const auto inverse = apply(scene, {SetNode{floor, value}});
    ASSERT_TRUE(inverse);
    EXPECT_EQ(scene.nodes.find(floor)->caustics, value.caustics);
    ASSERT_TRUE(apply(scene, *inverse));
    EXPECT_EQ(scene, before);
    Node lamp = *scene.nodes.find(stage.lamp);
    lamp.caustics = value.caustics;
    EXPECT_TRUE(leaves_light_unchanged(scene, {SetNode{stage.lamp, lamp}})) << "nothing falls on a lamp without a shape";
    for (const float bad : {-1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        value.caustics = {Show::Automatic, bad, 0.0F};
        EXPECT_FALSE(apply(scene, {SetNode{floor, value}}));
        value.caustics = {Show::Automatic, 0.0F, bad};
        EXPECT_FALSE(apply(scene, {SetNode{floor, value}}));
        EXPECT_EQ(scene, before);
    }
}

TEST(CausticWish, AScriptSetsIt) {
    ScriptedScene stage(test::stage().scene);
    ScriptCaustics e;
    e.node = "floor";
    e.show = Show::Texture;
    ASSERT_TRUE(stage.apply({e}));
    e.show.reset();
    e.texel = 0.004F;
    ASSERT_TRUE(stage.apply({e}));
    const auto wish = [&] { return stage.scene().nodes.find(stage.scene().roots.front())->caustics; };
    EXPECT_EQ(wish(), (CausticWish{Show::Texture, 0.004F, 0.0F})) << "what is absent stays";
    ASSERT_TRUE(stage.apply({ScriptUndo{}}));
    EXPECT_EQ(wish(), (CausticWish{Show::Texture, 0.0F, 0.0F}));
}

/// The stage at draft quality, with an engine that keeps what updates need.
struct Lit {
    Stage stage = test::stage();
    GiEngine engine;
    SolveOptions options;
    Lit() {
        options.quality = SolverSettings::Quality::Draft;
        options.keep_for_updates = true;
    }
    std::shared_ptr<const Solution> solve() {
        auto r = engine.solve(stage.scene, options, {});
        EXPECT_TRUE(r);
        return r ? *r : nullptr;
    }
    CausticWish& wish(std::size_t root) { return stage.scene.nodes.find(stage.scene.roots[root])->caustics; }
};

void expect_same_caustics(const Solution& a, const Solution& b) {
    EXPECT_EQ(a.caustic_records, b.caustic_records);
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
    for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
        const SurfaceLayer &x = *a.surfaces[i], &y = *b.surfaces[i];
        EXPECT_EQ(*x.mesh, *y.mesh);
        EXPECT_EQ(x.irradiance_front, y.irradiance_front);
        EXPECT_EQ(x.direct_front, y.direct_front);
        EXPECT_EQ(x.caustic_front, y.caustic_front);
        EXPECT_EQ(x.caustic_back, y.caustic_back);
        ASSERT_EQ(x.caustic_textures_front.size(), y.caustic_textures_front.size());
        for (std::size_t k = 0; k < x.caustic_textures_front.size(); ++k) {
            EXPECT_EQ(*x.caustic_textures_front[k], *y.caustic_textures_front[k]);
        }
    }
    EXPECT_EQ(a.statistics.memory.caustic_textures, b.statistics.memory.caustic_textures);
}

TEST(CausticWish, IsFollowedWithoutTracingAnythingAnew) {
    Lit lit;
    const auto before = lit.solve();
    ASSERT_FALSE(before->caustic_records.empty());
    const std::uint64_t rays = before->statistics.rays;
    lit.wish(0) = {Show::Mesh, 0, 0};
    lit.options.revision = 2;
    const auto mesh = lit.solve();
    EXPECT_TRUE(mesh->final);
    EXPECT_EQ(mesh->revision, 2U);
    EXPECT_TRUE(mesh->updatable);
    EXPECT_EQ(mesh->statistics.rays, rays);
    EXPECT_EQ(mesh->surfaces[0]->direct_map_front, before->surfaces[0]->direct_map_front) << "shared, not made again";
    Lit fresh;
    fresh.stage = lit.stage;
    expect_same_caustics(*mesh, *fresh.solve());
    // Texels of another surface, then all as it was: the bits as well.
    lit.wish(0) = {};
    lit.wish(1) = {Show::Automatic, 0.03F, 0};
    const auto coarse = lit.solve();
    EXPECT_EQ(coarse->surfaces[0]->direct_map_front, before->surfaces[0]->direct_map_front);
    lit.wish(1) = {};
    expect_same_caustics(*lit.solve(), *before);
    // A hand that moves something and wishes something: both are followed.
    lit.wish(0) = {Show::Mesh, 0, 0};
    lit.stage.scene.nodes.find(lit.stage.box)->transform.translation.x += 0.05;
    auto moved = lit.engine.update(lit.stage.scene, lit.options, {});
    ASSERT_TRUE(moved) << moved.error().message();
    EXPECT_TRUE((*moved)->surfaces[0]->caustic_textures_front.empty());
    const auto settled = lit.solve();
    EXPECT_FALSE(settled->statistics.update.degraded);
    fresh.stage = lit.stage;
    fresh.engine = GiEngine();
    expect_same_caustics(*settled, *fresh.solve());
}

TEST(CausticWish, CostsNothingWhereThereAreNoCaustics) {
    Lit lit;
    lit.stage.scene = Scene();
    test::add_rectangle(lit.stage.scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 2.0F, 2.0F,
                        test::add_material(lit.stage.scene, 0.5F));
    test::add_point_light(lit.stage.scene, {0.3, 1.0, 0.2}, 1000.0);
    const auto before = lit.solve();
    lit.wish(0) = {Show::Texture, 0, 0};
    const auto after = lit.solve();
    EXPECT_NE(after, before);
    EXPECT_EQ(after->surfaces, before->surfaces) << "shared, not solved again";
}

// What glass threw goes when the glass is taken out of the sun, also from surfaces that nothing lands on any more.
TEST(MovingGlass, TakesItsCausticAlong) {
    Scene scene;
    test::add_rectangle(scene, "table", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 1.0F, 1.0F, test::add_material(scene, 0.5F));
    test::add_rectangle(scene, "far", {3, -1, 0}, {0, 1, 0}, {1, 0, 0}, 1.0F, 1.0F, test::add_material(scene, 0.5F));
    const NodeId ball = test::add_shape(scene, Sphere{0.1F}, {0, 0.15, 0}, test::add_specular(scene, true));
    test::add_sun(scene, {0, -1, 0}, 1e5F);
    GiEngine engine;
    SolveOptions options;
    options.quality = SolverSettings::Quality::Draft;
    options.keep_for_updates = true;
    const auto before = engine.solve(scene, options, {});
    ASSERT_TRUE(before);
    ASSERT_FALSE((*before)->surfaces[0]->caustic_textures_front.empty());
    for (const double x : {3.0, 8.0}) { // over the other table, and over none; below both what it throws aside
        scene.nodes.find(ball)->transform.translation = {x, x == 3.0 ? -0.85 : -5.0, 0};
        options.hurried = true;
        const auto moved = engine.solve(scene, options, {});
        ASSERT_TRUE(moved) << moved.error().message();
        EXPECT_TRUE((*moved)->surfaces[0]->caustic_textures_front.empty()) << x;
        EXPECT_TRUE((*moved)->surfaces[0]->caustic_front.empty()) << x;
        const bool lit =
            !(*moved)->surfaces[1]->caustic_textures_front.empty() || !(*moved)->surfaces[1]->caustic_front.empty();
        EXPECT_EQ(lit, x == 3.0);
    }
}

TEST(Landings, AreToldWhenAskedFor) {
    Lit lit;
    const auto before = lit.solve();
    EXPECT_FALSE(before->landings) << "nobody asked";
    lit.options.keep_landings = true;
    const auto with = lit.solve();
    ASSERT_TRUE(with->landings);
    EXPECT_EQ(with->statistics.rays, before->statistics.rays) << "asked for later, nothing is traced";
    expect_same_caustics(*with, *before);
    std::size_t count = 0;
    for (const SurfaceLandings& side : *with->landings) {
        count += side.places.size();
        if (side.node == lit.stage.scene.roots[0]) { // the floor, in its own coordinates
            for (const vec3& p : side.places) {
                EXPECT_NEAR(p.z, 0.0F, 1e-5F);
                EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 3.001F);
            }
        }
    }
    EXPECT_EQ(count, with->statistics.particles_stored);
    EXPECT_GT(count, 1000U);
    // They go with what moves.
    lit.stage.scene.nodes.find(lit.stage.ball)->transform.translation.x += 0.2;
    const auto moved = lit.engine.update(lit.stage.scene, lit.options, {});
    ASSERT_TRUE(moved) << moved.error().message();
    ASSERT_TRUE((*moved)->landings);
    EXPECT_NE((*moved)->landings, with->landings);
    const auto settled = lit.solve();
    ASSERT_TRUE(settled->landings);
    lit.options.keep_landings = false;
    lit.wish(0) = {Show::Mesh, 0, 0};
    EXPECT_FALSE(lit.solve()->landings) << "and are gone with the next light";
}

} // namespace
} // namespace atrium
