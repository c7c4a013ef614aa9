// LocalError: errors of places from an audit; and what the histogram counts.
#include "engine/base/rng.h"
#include "engine/measure/light_range.h"
#include "engine/measure/local_error.h"
#include "engine/solver/gi_engine.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace atrium {
namespace {

using namespace test;

/// Normal numbers by Box and Muller, which know nothing of the places.
double normal_number(std::uint64_t i) {
    const auto uniform = [&](std::uint64_t k) { return (double(hash_combine(2 * i + k, 77U) >> 11U) + 0.5) * 0x1p-53; };
    return std::sqrt(-2.0 * std::log(uniform(0))) * std::cos(2.0 * kPiD * uniform(1));
}

/// Places on the floor of a hall, 10 % off for x < 0 and 1 % off elsewhere.
std::vector<AuditPlace> hall(std::uint32_t count) {
    std::vector<AuditPlace> out;
    for (std::uint32_t i = 0; i < count; ++i) {
        const vec2 u = sobol_owen2(i, 0, 5U);
        AuditPlace p;
        p.point = {10.0 * double(u.x) - 5.0, 0.0, 10.0 * double(u.y) - 5.0};
        const double off = (p.point.x < 0.0 ? 0.1 : 0.01) * normal_number(i);
        p.reference = 300.0;
        p.computed = 300.0 * (1.0 + off);
        p.square = off * off;
        out.push_back(p);
    }
    return out;
}

TEST(LocalError, IsThatOfThePlacesAround) {
    const LocalError error(hall(512));
    EXPECT_NEAR(error.overall(), std::sqrt(0.5 * (0.01 + 0.0001)), 0.012);
    const double bad = error.at({-3.0, 0.0, 1.0}, {0, 1, 0}, 300.0), good = error.at({3.0, 0.0, 1.0}, {0, 1, 0}, 300.0);
    // 32 squares of normal numbers: their root mean square is good to 12 %; the pull towards all places comes on top.
    const double pull = 8.0 * error.overall() * error.overall();
    EXPECT_NEAR(bad, std::sqrt((32.0 * 0.01 + pull) / 40.0), 0.03);
    EXPECT_NEAR(good, std::sqrt((32.0 * 0.0001 + pull) / 40.0), 0.004);
    EXPECT_LT(good, 0.6 * error.overall());
}

TEST(LocalError, KnowsNothingWithoutPlacesAndLittleWithOne) {
    EXPECT_TRUE(LocalError({}).empty());
    EXPECT_EQ(LocalError({}).at({}, {0, 1, 0}, 100.0), 0.0);
    AuditPlace one;
    one.computed = 100.0;
    one.square = 0.04;
    EXPECT_NEAR(LocalError({one}).at({9, 9, 9}, {0, 1, 0}, 5.0), 0.2, 1e-12);
    one.square = -0.04; // noise alone
    EXPECT_EQ(LocalError({one}).at({}, {0, 1, 0}, 100.0), 0.0);
}

/// What is left of a room's errors when their scale is taken out, each place judged by the others: the mean of
/// log s + d^2 / (2 s^2), which is least for the true standard deviations.
TEST(LocalError, TellsMoreOfARoomThanOneNumberDoes) {
    Scene scene;
    add_room(scene, 5, 2.8F, 6, add_material(scene, 0.7F));
    const MaterialId wood = add_material(scene, 0.4F);
    const auto box = [&](const dvec3& size, const dvec3& at) {
        Shape shape;
        shape.geometry = Box{vec3(size)};
        Node node;
        node.shape = scene.shapes.insert(shape);
        node.materials = {wood};
        node.transform.translation = at;
        scene.roots.push_back(scene.nodes.insert(node));
    };
    box({1.6, 0.05, 0.8}, {2.4, 0.72, 2.5}); // a table
    box({0.9, 1.9, 0.4}, {0.5, 0.96, 5.0});  // a cupboard, close to the wall
    box({1.8, 0.45, 0.8}, {3.6, 0.23, 4.9});
    add_point_light(scene, {1.2, 2.2, 1.5}, 3000.0);
    GiEngine engine;
    SolveOptions options;
    options.quality = SolverSettings::Quality::Draft;
    const auto solved = engine.solve(scene, options, {});
    ASSERT_TRUE(solved);
    AuditSettings settings{384, 1024, 4096};
    const auto places = audit_places(scene, **solved, settings, {});
    ASSERT_TRUE(places) << places.error().message();
    const auto whole = audit_error(scene, **solved, settings, {});
    ASSERT_TRUE(whole);
    const LocalError error(*places);
    EXPECT_EQ(error.size(), whole->points);
    EXPECT_NEAR(error.overall(), whole->rms, 1e-9 + 1e-6 * whole->rms) << "the same places, the same differences";
    double local = 0.0, global = 0.0;
    std::size_t within = 0, open = 0;
    for (std::size_t i = 0; i < places->size(); ++i) {
        const AuditPlace& p = (*places)[i];
        const double noise = p.reference > 0.0 ? p.noise / p.reference : 0.0;
        const double d2 = p.square + noise * noise;
        const double s2 = std::pow(error.at(p.point, p.normal, p.computed, i), 2) + noise * noise;
        const double g2 = error.overall() * error.overall() + noise * noise;
        local += 0.5 * std::log(s2) + 0.5 * d2 / s2;
        global += 0.5 * std::log(g2) + 0.5 * d2 / g2;
        within += d2 <= 4.0 * s2 ? 1 : 0;
        open += s2 < g2 ? 1 : 0;
    }
    const auto n = double(places->size());
    std::printf(
        "rms %.2f %%; log-likelihood gain per place %.3f; %.1f %% of the places within two deviations, %.0f %% told to be "
        "better than the whole\n",
        100.0 * error.overall(), (global - local) / n, 100.0 * double(within) / n, 100.0 * double(open) / n);
    EXPECT_LT(local, global);
    EXPECT_GT(double(within), 0.9 * n) << "19 of 20 for a normal distribution; errors have longer tails";
}

TEST(LightBars, CountAmountsByTheirPlaceOnTheScale) {
    const FalseColor scale{LightQuantity::Illuminance, false, 0.0, 100.0, false};
    const std::vector<double> amounts{5.0, 15.0, 15.0, 15.0, 15.0, 55.0, 55.0, 250.0};
    const std::vector<float> bars = light_bars(scale, amounts, 10);
    EXPECT_EQ(bars, (std::vector<float>{0.25F, 1.0F, 0, 0, 0, 0.5F, 0, 0, 0, 0.25F}));
    EXPECT_TRUE(light_bars(scale, {}, 10).empty());
}

} // namespace
} // namespace atrium
