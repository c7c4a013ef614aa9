// The brute-force reference against closed forms and published values: within four of its own standard errors, and those
// small.
#include "engine/reference/reference.h"

#include "engine/base/parallel.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace atrium {
namespace {

ReferenceReadings measured(const Scene& scene, const std::vector<ReferencePoint>& points, std::uint64_t paths,
                           std::uint32_t seed = 1) {
    ReferenceSettings settings;
    settings.paths = paths;
    settings.seed = seed;
    auto result = reference_irradiance(scene, points, settings, RunContext{});
    EXPECT_TRUE(result);
    return result ? *result : ReferenceReadings{};
}

/// Within four standard errors (and the rounding of floats) of `expected`, and the error at most `precision` of it.
void expect_light(const ReferenceReading& r, double expected, double precision, const std::string& what) {
    EXPECT_LE(r.standard_error, precision * expected) << what;
    EXPECT_NEAR(luminance(r.irradiance), expected, 4.0 * r.standard_error + 1e-5 * expected) << what;
}

/// Form factor from a small plate to a parallel rectangle a x b at distance c, its normal through a corner (Howell B-3).
double corner_factor(double a, double b, double c) {
    const double x = a / c, y = b / c;
    const double p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
    return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * kPiD);
}
/// To a rectangle [x0,x1] x [y0,y1] relative to the foot of the normal.
double rectangle_factor(double x0, double x1, double y0, double y1, double c) {
    const auto part = [&](double x, double y) {
        return (x < 0 ? -1.0 : 1.0) * (y < 0 ? -1.0 : 1.0) * corner_factor(std::abs(x), std::abs(y), c);
    };
    return part(x1, y1) - part(x0, y1) - part(x1, y0) + part(x0, y0);
}

/// The room of CIE 171 5.3: 4 x 4 m, 3 m high, a source of 1 m2 and 1000 cd/m2 in the middle of the ceiling. +Y is up here,
/// so the case's z is our y and its y our z.
Scene room_53(float floor, float ceiling, float walls) {
    Scene scene;
    const MaterialId f = test::add_material(scene, floor);
    const MaterialId c = test::add_material(scene, ceiling);
    const MaterialId w = test::add_material(scene, walls);
    test::add_rectangle(scene, "floor", {2, 0, 2}, {0, 1, 0}, {1, 0, 0}, 4, 4, f);
    test::add_rectangle(scene, "wall x0", {0, 1.5, 2}, {1, 0, 0}, {0, 0, 1}, 4, 3, w);
    test::add_rectangle(scene, "wall x1", {4, 1.5, 2}, {-1, 0, 0}, {0, 0, 1}, 4, 3, w);
    test::add_rectangle(scene, "wall z0", {2, 1.5, 0}, {0, 0, 1}, {1, 0, 0}, 4, 3, w);
    test::add_rectangle(scene, "wall z1", {2, 1.5, 4}, {0, 0, -1}, {1, 0, 0}, 4, 3, w);
    // The ceiling around the source, which is no second surface above it.
    test::add_rectangle(scene, "ceiling a", {2, 3, 0.75}, {0, -1, 0}, {1, 0, 0}, 4, 1.5F, c);
    test::add_rectangle(scene, "ceiling b", {2, 3, 3.25}, {0, -1, 0}, {1, 0, 0}, 4, 1.5F, c);
    test::add_rectangle(scene, "ceiling c", {0.75, 3, 2}, {0, -1, 0}, {1, 0, 0}, 1.5F, 1, c);
    test::add_rectangle(scene, "ceiling d", {3.25, 3, 2}, {0, -1, 0}, {1, 0, 0}, 1.5F, 1, c);
    test::add_rectangle(scene, "source", {2, 3, 2}, {0, -1, 0}, {1, 0, 0}, 1, 1,
                        test::add_material(scene, ceiling, float(1000.0 * kPiD)));
    return scene;
}

TEST(Reference, FurnaceIsExact) {
    Scene scene;
    test::add_room(scene, 2, 3, 4, test::add_material(scene, 0.8F, 100.0F));
    const auto r =
        measured(scene, {{{1, 0, 2}, {0, 1, 0}}, {{0.01, 0.01, 0}, {0, 0, 1}}, {{1, 1.5, 2}, {0.6, 0.0, 0.8}}}, 16384);
    for (const ReferenceReading& reading : r.points) {
        expect_light(reading, 500.0, 0.006, "E = M / (1 - rho)");
    }
}

TEST(Reference, LongPathsAreNotCut) {
    Scene scene;
    test::add_room(scene, 2, 2, 2, test::add_material(scene, 0.99F, 1.0F));
    const auto r = measured(scene, {{{1, 0, 1}, {0, 1, 0}}}, 4096);
    expect_light(r.points[0], 100.0, 0.02, "a hundred bounces on average");
}

TEST(Reference, PointLightInTheOpen) {
    Scene scene;
    test::add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 10, 10, test::add_material(scene, 0.5F));
    test::add_point_light(scene, {0, 3, 0}, 4000.0 * kPiD); // 1000 cd
    const auto r = measured(scene, {{{0, 0, 0}, {0, 1, 0}}, {{4, 0, 0}, {0, 1, 0}}, {{1, 1, 0}, {-1, 0, 0}}}, 256);
    expect_light(r.points[0], 1000.0 / 9.0, 0.0, "below");
    expect_light(r.points[1], 1000.0 * 3.0 / 125.0, 0.0, "aside: cosine over the square of 5 m");
    EXPECT_TRUE(r.points[0].on_surface);
    EXPECT_FALSE(r.points[2].on_surface);
    // The free sensor faces the lamp at 1 m across and 2 m up, and also gets light from the floor.
    EXPECT_GT(luminance(r.points[2].irradiance), 1000.0 / (5.0 * std::sqrt(5.0)));
}

TEST(Reference, AreaSourceOfCie171Case53) {
    const Scene scene = room_53(0.0F, 0.0F, 0.0F);
    std::vector<ReferencePoint> points;
    for (int i = 0; i < 6; ++i) {
        points.push_back({{2, 2.75 - 0.5 * i, 0}, {0, 0, 1}});
    }
    for (int i = 0; i < 8; ++i) {
        points.push_back({{2, 0, 0.25 + 0.5 * i}, {0, 1, 0}});
    }
    const std::array<double, 14> expected = {32.67689801, 75.19392457, 81.32317212, 69.06062701, 53.40353111,
                                             40.00185202, 61.42409854, 79.25515732, 95.66727633, 105.7782422,
                                             105.7782422, 95.66727633, 79.25515732, 61.42409854};
    const auto r = measured(scene, points, 65536);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        expect_light(r.points[i], expected[i], 0.0015, std::string(1, char('A' + i)));
    }
}

TEST(Reference, AreaSourceInReflectingRoom) {
    // ENC-ROOM-543: radiosity with closed-form factors, extrapolated; its own uncertainty is below 0.1 %.
    const Scene scene = room_53(0.2F, 0.7F, 0.5F);
    struct Case {
        dvec3 at, normal;
        double expected;
    };
    const std::array<Case, 6> cases{{{{2, 2.75, 0}, {0, 0, 1}, 60.9373},
                                     {{2, 1.75, 0}, {0, 0, 1}, 111.4073},
                                     {{2, 0.25, 0}, {0, 0, 1}, 67.4869},
                                     {{2, 0, 1.75}, {0, 1, 0}, 138.7656},
                                     {{1, 0, 1}, {0, 1, 0}, 106.2131},
                                     {{0, 1.5, 2}, {1, 0, 0}, 106.436}}};
    std::vector<ReferencePoint> points;
    for (const Case& c : cases) {
        points.push_back({c.at, c.normal});
    }
    const auto r = measured(scene, points, 16384);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        EXPECT_LE(r.points[i].standard_error, 0.003 * cases[i].expected);
        EXPECT_NEAR(luminance(r.points[i].irradiance), cases[i].expected,
                    4.0 * r.points[i].standard_error + 0.001 * cases[i].expected)
            << i;
    }
}

TEST(Reference, EnergyOfARoomOfTwoMaterials) {
    // All light of the lamp is absorbed: the sum of (1 - rho) E over all area is its flux.
    Scene scene;
    const MaterialId dark = test::add_material(scene, 0.2F);
    const MaterialId light = test::add_material(scene, 0.7F);
    test::add_room(scene, 3, 2, 4, {dark, light, light, light, dark, light});
    test::add_point_light(scene, {1.5, 1, 2}, 1000.0);
    const std::array<float, 6> rho{0.2F, 0.7F, 0.7F, 0.7F, 0.2F, 0.7F};
    const std::array<dvec3, 6> corner{{{0, 0, 0}, {0, 2, 0}, {0, 0, 0}, {3, 0, 0}, {0, 0, 0}, {0, 0, 4}}};
    const std::array<dvec3, 6> u{{{3, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 2, 0}, {3, 0, 0}, {3, 0, 0}}};
    const std::array<dvec3, 6> v{{{0, 0, 4}, {0, 0, 4}, {0, 0, 4}, {0, 0, 4}, {0, 2, 0}, {0, 2, 0}}};
    const std::array<dvec3, 6> normal{{{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}}};
    constexpr int kSide = 12;
    std::vector<ReferencePoint> points;
    std::vector<double> weight;
    for (std::size_t face = 0; face < 6; ++face) {
        for (int i = 0; i < kSide * kSide; ++i) {
            points.push_back({corner[face] + u[face] * ((i % kSide + 0.5) / kSide) + v[face] * ((i / kSide + 0.5) / kSide),
                              normal[face]});
            weight.push_back((1.0 - double(rho[face])) * glm::length(glm::cross(u[face], v[face])) / (kSide * kSide));
        }
    }
    const auto r = measured(scene, points, 256);
    double absorbed = 0.0;
    double variance = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        absorbed += weight[i] * luminance(r.points[i].irradiance);
        variance += weight[i] * weight[i] * r.points[i].standard_error * r.points[i].standard_error;
    }
    EXPECT_LE(std::sqrt(variance), 2.0);
    EXPECT_NEAR(absorbed, 1000.0, 4.0 * std::sqrt(variance) + 2.0); // 0.2 % for the midpoint rule
}

TEST(Reference, PenumbraOfAHalfPlaneInTheSun) {
    // SHADOW-SUN: the visible share of a disc cut by a straight edge.
    Scene scene;
    const double height = 3.0;
    test::add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, test::add_material(scene, 0.0F));
    test::add_rectangle(scene, "edge", {-5, height, 0}, {0, 1, 0}, {1, 0, 0}, 10, 10, test::add_material(scene, 0.0F));
    Light sun;
    sun.kind = Light::Kind::Directional;
    sun.intensity = 100000.0F;
    sun.angular_diameter_degrees = 0.5332F;
    Node node;
    node.light = scene.lights.insert(sun);
    node.transform.rotation = glm::angleAxis(-kPiD / 2, dvec3(1, 0, 0));
    scene.roots.push_back(scene.nodes.insert(node));
    const double half_width = height * std::tan(radians_from_degrees(0.2666));
    const std::array<std::pair<double, double>, 5> cases{
        {{-0.75, 0.07214680641}, {-0.25, 0.3425188212}, {0, 0.5}, {0.5, 0.8044988905}, {0.75, 0.9278531936}}};
    std::vector<ReferencePoint> points;
    for (const auto& [x, share] : cases) {
        points.push_back({{x * half_width, 0, 0.1}, {0, 1, 0}});
    }
    points.push_back({{1.5, 0, 0.1}, {0, 1, 0}});
    points.push_back({{-1.5, 0, 0.1}, {0, 1, 0}});
    const auto r = measured(scene, points, 16384);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        EXPECT_LE(r.points[i].standard_error, 150.0);
        EXPECT_NEAR(luminance(r.points[i].irradiance), 100000.0 * cases[i].second, 4.0 * r.points[i].standard_error + 5.0)
            << i;
    }
    EXPECT_NEAR(luminance(r.points[5].irradiance), 100000.0, 1.0); // the whole disc gives what the lamp says
    EXPECT_EQ(luminance(r.points[6].irradiance), 0.0F);
}

TEST(Reference, SkyThroughARoofOpening) {
    // CIE 171 5.9 under a uniform sky: a black room, 1 x 1 m open in the middle of the ceiling. E / E_hz is the form factor.
    Scene scene = room_53(0.0F, 0.0F, 0.0F);
    for (const NodeId id : scene.in_tree_order()) {
        Node* node = scene.nodes.find(id);
        node->visible = node->name != "source";
    }
    scene.environment.sky_radiance = Rgb(1000.0F);
    std::vector<ReferencePoint> points;
    for (int i = 0; i < 8; ++i) {
        points.push_back({{2, 0, 0.25 + 0.5 * i}, {0, 1, 0}});
    }
    const std::array<double, 8> published = {1.955, 2.523, 3.045, 3.367, 3.367, 3.045, 2.523, 1.955}; // per cent
    const auto r = measured(scene, points, 65536);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double z = points[i].position.z;
        const double factor = rectangle_factor(-0.5, 0.5, 1.5 - z, 2.5 - z, 3.0);
        EXPECT_NEAR(100.0 * factor, published[i], 0.001);
        expect_light(r.points[i], 1000.0 * kPiD * factor, 0.01, "floor point " + std::to_string(i));
    }
}

TEST(Reference, GlassTakesItsShare) {
    // A pane over a sensor under a uniform sky: E = pi L times the mean of (1 - F) / (1 + F) over the cosine.
    Scene scene;
    Material glass;
    glass.base_color = Rgb(1.0F, 0.5F, 1.0F);
    glass.transmission = 1.0F;
    glass.roughness = 0.0F;
    const MaterialId pane = scene.materials.insert(glass);
    test::add_rectangle(scene, "pane", {0, 0.01, 0}, {0, 1, 0}, {1, 0, 0}, 1000, 1000, pane);
    // A black floor, or the pane would mirror the sky below.
    test::add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 1000, 1000, test::add_material(scene, 0.0F));
    scene.environment.sky_radiance = Rgb(100.0F);
    double expected = 0.0;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
        const double c = std::sqrt((i + 0.5) / kSteps); // even in squared cosine is cosine weighted
        const double t = std::sqrt(1.0 - (1.0 - c * c) / 2.25);
        const double rs = (c - 1.5 * t) / (c + 1.5 * t), rp = (1.5 * c - t) / (1.5 * c + t);
        const double f = 0.5 * (rs * rs + rp * rp);
        expected += (1.0 - f) / (1.0 + f) / kSteps;
    }
    const auto r = measured(scene, {{{0, 0, 0}, {0, 1, 0}}}, 1U << 18U);
    const double whole = 100.0 * kPiD * expected;
    EXPECT_LE(r.points[0].standard_error, 0.001 * whole);
    EXPECT_NEAR(r.points[0].irradiance.r, whole, 0.001 * whole + 4.0 * r.points[0].standard_error);
    EXPECT_NEAR(r.points[0].irradiance.g, 0.5 * whole, 0.0005 * whole + 4.0 * r.points[0].standard_error);
}

TEST(Reference, SameBitsForAnyNumberOfThreads) {
    const Scene scene = room_53(0.2F, 0.7F, 0.5F);
    const std::vector<ReferencePoint> points{{{1, 0, 3}, {0, 1, 0}}, {{2, 2.5, 0}, {0, 0, 1}}};
    std::vector<ReferenceReadings> results;
    for (const unsigned threads : {1U, 2U, 8U}) {
        set_thread_limit(threads);
        results.push_back(measured(scene, points, 2048));
    }
    set_thread_limit(0);
    for (const ReferenceReadings& r : results) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_EQ(r.points[i].irradiance, results[0].points[i].irradiance);
            EXPECT_EQ(r.points[i].standard_error, results[0].points[i].standard_error);
        }
    }
    EXPECT_NE(measured(scene, points, 2048, 2).points[0].irradiance, results[0].points[0].irradiance);
}

TEST(Reference, StopsSoon) {
    const Scene scene = room_53(0.2F, 0.7F, 0.5F);
    double best = 1.0;
    for (int attempt = 0; attempt < 5; ++attempt) {
        RunContext context;
        RunContext::Clock::time_point asked;
        std::thread stopper([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            asked = RunContext::Clock::now();
            context.stop.request_stop();
        });
        ReferenceSettings settings;
        settings.relative_error = 1e-9;
        const auto r = reference_irradiance(scene, {{{1, 0, 3}, {0, 1, 0}}}, settings, context);
        const auto ended = RunContext::Clock::now();
        stopper.join();
        best = std::min(best, std::chrono::duration<double>(ended - asked).count());
        ASSERT_TRUE(r); // 200 ms are enough for a first round
        EXPECT_FALSE(r->run.reached);
        EXPECT_GT(r->run.paths, 0U);
    }
    EXPECT_LT(best, 0.05);
}

TEST(Reference, SaysWhenItCannotEndOrHadNoTime) {
    const Scene scene = room_53(0.2F, 0.7F, 0.5F);
    EXPECT_FALSE(reference_irradiance(scene, {{{1, 0, 3}, {0, 1, 0}}}, ReferenceSettings{}, RunContext{}));
    RunContext context;
    context.stop.request_stop();
    ReferenceSettings settings;
    settings.paths = 1000;
    const auto r = reference_irradiance(scene, {{{1, 0, 3}, {0, 1, 0}}}, settings, context);
    ASSERT_FALSE(r);
    EXPECT_EQ(r.error().what, "stopped before the first estimate");
}

TEST(Reference, ReachesTheErrorAskedFor) {
    const Scene scene = room_53(0.2F, 0.7F, 0.5F);
    ReferenceSettings settings;
    settings.relative_error = 0.005;
    const std::vector<ReferencePoint> points{{{1, 0, 1}, {0, 1, 0}}, {{0, 1.5, 2}, {1, 0, 0}}};
    const auto r = reference_irradiance(scene, points, settings, RunContext{});
    ASSERT_TRUE(r);
    EXPECT_TRUE(r->run.reached);
    const std::array<double, 2> expected{106.2131, 106.436};
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_LE(r->points[i].standard_error, 0.005 * luminance(r->points[i].irradiance));
        EXPECT_NEAR(luminance(r->points[i].irradiance), expected[i], 0.025 * expected[i]); // five of the errors asked for
    }
}

TEST(Reference, ItsStandardErrorIsTheScatterOfItsSeeds) {
    const Scene scene = room_53(0.2F, 0.7F, 0.5F);
    const std::vector<ReferencePoint> points{{{1, 0, 3}, {0, 1, 0}}, {{2, 2.5, 0}, {0, 0, 1}}, {{3, 3, 3.5}, {0, -1, 0}}};
    constexpr std::uint32_t kSeeds = 64;
    std::vector<double> sum(points.size()), squares(points.size()), claimed(points.size());
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
        const auto r = measured(scene, points, 512, seed);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double e = luminance(r.points[i].irradiance);
            sum[i] += e;
            squares[i] += e * e;
            claimed[i] += r.points[i].standard_error * r.points[i].standard_error / kSeeds;
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double mean = sum[i] / kSeeds;
        const double scatter = (squares[i] - kSeeds * mean * mean) / (kSeeds - 1);
        // A variance from 64 seeds has a relative standard error of 18 %: four of them either way, in the root.
        EXPECT_GT(std::sqrt(scatter / claimed[i]), 0.6) << i;
        EXPECT_LT(std::sqrt(scatter / claimed[i]), 1.4) << i;
    }
}

TEST(Reference, PictureOfAFurnaceIsEvenAndKnowsItsNoise) {
    Scene scene;
    test::add_room(scene, 2, 3, 4, test::add_material(scene, 0.5F, 100.0F));
    ReferenceView view;
    view.to_world[3] = {1, 1.5, 2, 1};
    view.width = 16;
    view.height = 9;
    ReferenceSettings settings;
    settings.paths = 64;
    const auto r = reference_picture(scene, view, settings, RunContext{});
    ASSERT_TRUE(r);
    ASSERT_EQ(r->radiance.pixels.size(), 144U);
    double deviations = 0.0;
    double mean = 0.0;
    for (std::size_t i = 0; i < 144; ++i) {
        const double radiance = luminance(r->radiance.pixels[i]);
        mean += radiance / 144.0;
        deviations += std::pow((radiance - 200.0 / kPiD) / double(r->standard_error[i]), 2.0) / 144.0;
    }
    EXPECT_NEAR(mean, 200.0 / kPiD, 0.5);
    EXPECT_GT(deviations, 0.4); // 1.4 is expected of eight streams (Student's t), with a spread of about 0.3
    EXPECT_LT(deviations, 3.0);
}

} // namespace
} // namespace atrium
