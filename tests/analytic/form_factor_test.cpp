// Form factors against Howell's catalogue (FF-C11, FF-C14 of the validation cases).
#include "engine/geometry/form_factor.h"
#include "tests/support/rooms.h"

#include <array>
#include <functional>
#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace test;

// Mean of the point form factor over a rectangle by Gauss-Legendre (8 points a side, 4 x 4 panels).
template <class F> double mean_over_unit_square(F&& f) {
    constexpr std::array<double, 4> node{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    constexpr int kPanels = 4;
    double sum = 0.0;
    for (int p = 0; p < kPanels * kPanels; ++p) {
        for (int i = 0; i < 64; ++i) {
            const auto coordinate = [&](int k, int panel, double& w) {
                const std::size_t n = std::size_t(k % 4);
                w *= weight[n] * 0.5 / kPanels;
                return (panel + 0.5 + (k < 4 ? 0.5 : -0.5) * node[n]) / kPanels;
            };
            double w = 1.0;
            const double x = coordinate(i % 8, p % kPanels, w);
            const double y = coordinate(i / 8, p / kPanels, w);
            sum += w * f(x, y);
        }
    }
    return sum;
}

TEST(FormFactor, C11OpposedRectangles) {
    // X = a/c, Y = b/c at c = 1; values of FF-C11.
    const std::array<std::array<double, 3>, 7> cases{{{1, 1, 0.199824895698},
                                                      {2, 2, 0.415253283577},
                                                      {4, 4, 0.632036430014},
                                                      {0.5, 0.5, 0.0685895888186},
                                                      {2, 3, 0.475576436533},
                                                      {0.01, 0.01, 3.18288667328e-05},
                                                      {10, 0.1, 0.0467083533303}}};
    for (const auto& [a, b, expected] : cases) {
        const float fa = float(a), fb = float(b);
        const std::array<vec3, 4> above{vec3(0, 1, 0), vec3(fa, 1, 0), vec3(fa, 1, fb), vec3(0, 1, fb)};
        const double f = mean_over_unit_square([&, ca = a, cb = b](double x, double y) {
            return form_factor_to_polygon(vec3(float(x * ca), 0, float(y * cb)), {0, 1, 0}, above);
        });
        EXPECT_NEAR(f / expected, 1.0, 1e-4) << a << " x " << b;
    }
}

TEST(FormFactor, C14RectanglesWithCommonEdge) {
    // Floor w x 1, wall h x 1 on the edge x = 0; the kernel is singular at the edge, so the panels shrink towards it.
    const std::array<std::array<double, 3>, 5> cases{{{1, 1, 0.200043776075},
                                                      {0.5, 1, 0.146186679106},
                                                      {2, 1, 0.232852602795},
                                                      {1, 2, 0.116426301398},
                                                      {0.1, 1, 0.0432513694007}}};
    for (const auto& [h, w, expected] : cases) {
        const float fh = float(h);
        const std::array<vec3, 4> wall{vec3(0, 0, 0), vec3(0, 0, 1), vec3(0, fh, 1), vec3(0, fh, 0)};
        // Substitution x = w u^3 clusters points at the edge: dx = 3 w u^2 du.
        const double f = mean_over_unit_square([&, cw = w](double u, double z) {
            return 3.0 * u * u * form_factor_to_polygon(vec3(float(cw * u * u * u), 0, float(z)), {0, 1, 0}, wall);
        });
        EXPECT_NEAR(f / expected, 1.0, 1e-3) << "H " << h << " W " << w;
    }
}

TEST(FormFactor, IsNeverNegativeAndClipsAtTheHorizon) {
    const std::array<vec3, 3> half_below{vec3(-1, -1, 2), vec3(1, -1, 2), vec3(0, 1, 2)};
    const double clipped = form_factor_to_polygon(vec3(0), {0, 1, 0}, half_below);
    const std::array<vec3, 3> above_only{vec3(-0.5F, 0, 2), vec3(0.5F, 0, 2), vec3(0, 1, 2)};
    EXPECT_NEAR(clipped, form_factor_to_polygon(vec3(0), {0, 1, 0}, above_only), 1e-9);
    const std::array<vec3, 3> below{vec3(-1, -3, 2), vec3(1, -3, 2), vec3(0, -1, 2)};
    EXPECT_EQ(form_factor_to_polygon(vec3(0), {0, 1, 0}, below), 0.0);
}

// The same two cases through the whole engine: a black receiver under an emitting rectangle holds E = M F (by area means).
struct Pair {
    const char* name;
    double expected;
    dvec3 centre;
    dvec3 normal;
};
TEST(FormFactor, EngineTransfersC11AndC14) {
    for (const Pair& pair :
         {Pair{"C-11", 0.199824895698, {0.5, 1, 0.5}, {0, -1, 0}}, Pair{"C-14", 0.200043776075, {0, 0.5, 0.5}, {1, 0, 0}}}) {
        Scene scene;
        const NodeId receiver =
            add_rectangle(scene, "receiver", {0.5, 0, 0.5}, {0, 1, 0}, {1, 0, 0}, 1, 1, add_material(scene, 0));
        add_rectangle(scene, "source", pair.centre, pair.normal, {0, 0, 1}, 1, 1, add_material(scene, 0, 100));
        const Solved s = solve(scene);
        ASSERT_TRUE(s.solution);
        const double f = mean_irradiance(scene, *s.solution, receiver) / 100.0;
        EXPECT_NEAR(f / pair.expected, 1.0, 0.03) << pair.name;
        std::printf("%s through the engine: F = %.5f, expected %.5f\n", pair.name, f, pair.expected);
    }
}

// C-14 with a common edge of 1: from a floor of width w to a wall of height h.
double c14(double w, double h) {
    const double w2 = w * w, h2 = h * h, all = 1.0 + w2 + h2;
    const double logs = std::log((1.0 + w2) * (1.0 + h2) / all) + w2 * std::log(w2 * all / ((1.0 + w2) * (w2 + h2))) +
                        h2 * std::log(h2 * all / ((1.0 + h2) * (w2 + h2)));
    const double root = std::sqrt(w2 + h2);
    return (w * std::atan(1.0 / w) + h * std::atan(1.0 / h) - root * std::atan(1.0 / root) + 0.25 * logs) / (kPiD * w);
}

/// Mean of f over 0 to `length`, looked at closely near 0.
double mean_from_edge(double length, const std::function<double(double y)>& f) {
    constexpr int kPoints = 4000;
    double sum = 0.0;
    for (int i = 0; i < kPoints; ++i) {
        const double u = (i + 0.5) / kPoints;
        sum += f(length * u * u) * 2.0 * u / kPoints;
    }
    return sum;
}

// Mean irradiance on the middle line of the wall x = 0 from one height to another, as shown; and by the closed form, up to
// `length` above a strip of width w and exitance 1 that stands on it.
double light_across(const Scene& scene, const Solution& solution, double from, double to) {
    std::vector<SensorPlace> places;
    mean_from_edge(to - from, [&](double y) {
        places.push_back({{0, from + y, 0.5}, {1, 0, 0}});
        return 0.0;
    });
    const std::vector<SensorReading> read = read_surfaces(scene, solution, places);
    std::size_t next = 0;
    return mean_from_edge(to - from, [&](double) { return double(luminance(read[next++].irradiance)); });
}
double exact_light_across(double w, double length) {
    const std::array<vec3, 4> strip{vec3(0, 0, 0), {0, 0, 1}, {float(w), 0, 1}, {float(w), 0, 0}};
    return mean_from_edge(length, [&](double y) { return form_factor_to_polygon({0, float(y), 0.5F}, {1, 0, 0}, strip); });
}

// X-SINGULAR-EDGE: surfaces that meet in an edge, down to a ten-thousandth of each other's width. The kernel is infinite at
// the edge; light in the strip beside it is half of what the wall emits, however narrow it is.
TEST(FormFactor, NarrowStripsAtACommonEdgeThroughTheEngine) {
    EXPECT_NEAR(c14(1, 1), 0.200043776075, 1e-11);
    EXPECT_NEAR(c14(0.001, 1), 0.498592023105, 1e-9);
    for (const double w : {1.0, 0.1, 0.01, 1e-3, 1e-4}) {
        const auto through_engine = [&](bool strip_shines) {
            Scene scene;
            const MaterialId dark = add_material(scene, 0),
                             bright = add_material(scene, 0, strip_shines ? float(100.0 / w) : 100.0F);
            const NodeId strip = add_rectangle(scene, "strip", {0.5 * w, 0, 0.5}, {0, 1, 0}, {1, 0, 0}, float(w), 1,
                                               strip_shines ? bright : dark);
            add_rectangle(scene, "wall", {0, 0.5, 0.5}, {1, 0, 0}, {0, 0, 1}, 1, 1, strip_shines ? dark : bright);
            const Solved s = solve(scene);
            if (!s.solution) {
                return 0.0;
            }
            return strip_shines ? light_across(scene, *s.solution, 0, 1) / (100.0 / w * exact_light_across(w, 1))
                                : mean_irradiance(scene, *s.solution, strip) / (100.0 * c14(w, 1));
        };
        // Reciprocity: the wall gets w F of what the strip emits, most of it within a few widths of the edge. Samples are
        // 5 mm apart there and keep 2 mm from the edge, but each has the mean of what it stands for.
        const double lit = through_engine(false), given = through_engine(true);
        std::printf("width %g: %.4f of the light from the wall, %.4f of that from the strip\n", w, lit, given);
        EXPECT_NEAR(lit, 1.0, 0.02) << w;
        EXPECT_NEAR(given, 1.0, 0.02) << w;
    }
}

// The same for a lamp that stands on the wall where no sample's place has to do with it: what goes to both sides.
TEST(FormFactor, LightBesideANarrowLampThatStandsOnAWall) {
    double worst = 0.0;
    for (const double shift : {0.0, 0.0013, 0.0031}) {
        Scene scene;
        const MaterialId dark = add_material(scene, 0), bright = add_material(scene, 0, 50'000.0F);
        const double at = 0.4 + shift; // height on the wall
        add_rectangle(scene, "strip", {0.001, at, 0.5}, {0, 1, 0}, {1, 0, 0}, 0.002F, 1, bright);
        add_rectangle(scene, "wall", {0, 0.5, 0.5}, {1, 0, 0}, {0, 0, 1}, 1, 1, dark);
        const Solved s = solve(scene);
        ASSERT_TRUE(s.solution);
        const double above = light_across(scene, *s.solution, at, 1),
                     below = light_across(scene, *s.solution, at, at - 0.01);
        const double given =
            (above * (1.0 - at) + below * 0.01) / (50'000.0 * exact_light_across(0.002, 1.0 - at) * (1.0 - at));
        std::printf("%g m: %.3f of the light\n", at, given);
        worst = std::max(worst, std::abs(given - 1.0));
    }
    EXPECT_LT(worst, 0.25) << "half a texel of 5 mm may be taken for lit or not";
}

} // namespace
} // namespace atrium
