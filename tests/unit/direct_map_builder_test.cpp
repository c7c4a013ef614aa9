// Light maps of lights that are known everywhere: nothing missed, nothing wasted, no seams, no halos.
#include "engine/layers/direct_map_builder.h"

#include "engine/base/parallel.h"
#include "tests/support/flat_charts.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

namespace atrium {
namespace {

using namespace test;

constexpr float kFull = 1000.0F; // lux

/// A floor of w x d metres about the origin, front up, whatever stands on it, and its charts.
struct Stage {
    Scene scene;
    std::unique_ptr<RayScene> rays;
    std::vector<SurfaceCharts> charts;
    DirectMapSettings settings;
    RunContext context;

    Stage(float w, float d) {
        add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, w, d, add_material(scene, 0.5F));
        ready();
    }
    void ready() {
        rays = std::make_unique<RayScene>(scene);
        charts = flat_charts(*rays);
    }
    DirectMaps build(const DirectFunction& direct, bool back = false) const {
        return build_direct_maps(
            *rays, charts, direct, [&](std::uint32_t) { return back; }, settings, context, 0.0, 1.0);
    }
    /// Luminance of the map of the first surface at a point of the world.
    double at(const DirectMaps& maps, double x, double z) const {
        const vec3 p = vec3(dvec3(x, 0, z) - rays->origin());
        return luminance(maps.front[0]->irradiance(chart_position(charts[0], p)));
    }
};

/// Light that depends on the place on the floor only.
template <class F> DirectFunction on_floor(F&& light) {
    return [light](const vec3& p, const vec3&) { return DirectSample{Rgb(light(p.x, p.z)), 0.0F}; };
}
/// Lit where the distance from a line through `offset` along the direction `angle` is positive.
auto half_plane(double angle, double offset) {
    const auto c = float(std::cos(angle)), s = float(std::sin(angle)), o = float(offset);
    return [=](float x, float z) { return c * x + s * z > o ? kFull : 0.0F; };
}

TEST(DirectMaps, UniformLightStaysAtTheFirstLevel) {
    const Stage stage(3.2F, 3.2F);
    const DirectMaps maps = stage.build(on_floor([](float, float) { return kFull; }));
    ASSERT_TRUE(maps.complete);
    ASSERT_TRUE(maps.front[0]);
    EXPECT_FALSE(maps.back[0]) << "one-sided";
    for (const LightMap::Tile& t : maps.front[0]->tiles) {
        EXPECT_EQ(t.used, 1U);
        EXPECT_EQ(t.level, stage.settings.first_level);
    }
    EXPECT_EQ(maps.samples, 100U * 25U);
    EXPECT_EQ(maps.evaluations, 41U * 41U + 40U * 40U) << "nodes that tiles share once, and a probe per cell";
    for (double x = -1.59; x < 1.6; x += 0.37) {
        EXPECT_FLOAT_EQ(float(stage.at(maps, x, 0.7 * x)), kFull);
    }
    EXPECT_EQ(maps.limited_tiles, 0U);
    EXPECT_EQ(maps.error_estimate, 0.0);
}

TEST(DirectMaps, NothingShinesNothingIsKept) {
    const Stage stage(1, 1);
    const DirectMaps maps = stage.build(on_floor([](float, float) { return 0.0F; }));
    ASSERT_TRUE(maps.complete);
    EXPECT_FALSE(maps.front[0]);
    EXPECT_EQ(maps.memory_bytes(), 0U);
}

class StraightEdge : public testing::TestWithParam<double> {};

// A sharp edge in any direction: light and dark are right from one texel's diagonal on, on both sides and everywhere.
TEST_P(StraightEdge, IsWithinOneTexel) {
    const double angle = GetParam(), offset = 0.137;
    const Stage stage(2.4F, 2.1F);
    const DirectMaps maps = stage.build(on_floor(half_plane(angle, offset)));
    ASSERT_TRUE(maps.complete);
    const double texel = 0.32 / 64 * std::sqrt(2.0);
    for (double x = -1.195; x < 1.2; x += 0.0119) {
        for (double z = -1.045; z < 1.05; z += 0.0131) {
            const double d = std::cos(angle) * x + std::sin(angle) * z - offset;
            if (std::abs(d) > texel) {
                ASSERT_NEAR(stage.at(maps, x, z), d > 0 ? kFull : 0.0, 1e-3) << x << ", " << z;
            }
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Angles, StraightEdge, testing::Values(0.0, 0.01, 0.3, 0.785398, 1.2, 1.570796, 2.2));

// Steps of the interpolant over every border of tiles, at levels 2 to 6 beside each other.
TEST(DirectMaps, TilesOfDifferentLevelMeetWithoutACrack) {
    const Stage stage(2.56F, 2.56F);
    // A sharp edge, and beside it light that curves gently enough for levels between.
    const auto light = [edge = half_plane(0.4, 0.3)](float x, float z) {
        return edge(x, z) + 400.0F * std::exp(-40.0F * (x * x + z * z));
    };
    const DirectMaps maps = stage.build(on_floor(light));
    ASSERT_TRUE(maps.complete);
    const LightMap& map = *maps.front[0];
    std::array<int, 13> levels{};
    for (const LightMap::Tile& t : map.tiles) {
        ++levels[t.level];
    }
    EXPECT_GT(levels[2], 0);
    EXPECT_GT(levels[6], 0);
    EXPECT_GT(levels[3] + levels[4] + levels[5], 0);
    for (int border = 1; border < 8; ++border) {
        for (float along = 0.003F; along < 8.0F; along += 0.0071F) {
            const float below = std::nextafter(float(border), 0.0F);
            const float across = luminance(map.irradiance({below, along})) - luminance(map.irradiance({border, along}));
            const float up = luminance(map.irradiance({along, below})) - luminance(map.irradiance({along, border}));
            ASSERT_NEAR(across, 0.0F, 0.1F) << border << ", " << along;
            ASSERT_NEAR(up, 0.0F, 0.1F) << along << ", " << border;
        }
    }
}

class Streak : public testing::TestWithParam<std::pair<double, double>> {};

// A streak of light or shadow across a floor of 6 m, narrower than the first samples are apart, at any angle.
TEST_P(Streak, IsFoundAndRunsThrough) {
    const auto [angle, width] = GetParam();
    const Stage stage(6.0F, 3.0F);
    const double c = std::cos(angle), s = std::sin(angle), offset = 0.043;
    for (const bool bright : {true, false}) {
        const DirectMaps maps = stage.build(on_floor([=](float x, float z) {
            const bool inside = std::abs(c * x + s * z - offset) < 0.5 * width;
            return inside == bright ? kFull : 0.0F;
        }));
        ASSERT_TRUE(maps.complete);
        for (double along = -4.0; along < 4.0; along += 0.0037) {
            const double x = c * offset - s * along, z = s * offset + c * along;
            if (std::abs(x) > 2.99 || std::abs(z) > 1.49) {
                continue;
            }
            ASSERT_NEAR(stage.at(maps, x, z), bright ? kFull : 0.0F, 1e-3) << "in it at " << along;
            for (const double side : {-1.0, 1.0}) {
                const double off = side * (0.5 * width + 0.01);
                const double bx = x + c * off, bz = z + s * off;
                if (std::abs(bx) < 3.0 && std::abs(bz) < 1.5) {
                    ASSERT_NEAR(stage.at(maps, bx, bz), bright ? 0.0F : kFull, 1e-3) << "beside it at " << along;
                }
            }
        }
    }
}
INSTANTIATE_TEST_SUITE_P(AnglesAndWidths, Streak,
                         testing::Values(std::pair{0.0, 0.03}, std::pair{1.570796, 0.03}, std::pair{0.01, 0.03},
                                         std::pair{0.5, 0.03}, std::pair{0.785398, 0.03}, std::pair{1.1, 0.02},
                                         std::pair{0.0, 0.016}));

// A floor of twice the edge length has twice the length of shadow and four times the area.
TEST(DirectMaps, CostFollowsTheLengthOfEdgesNotTheArea) {
    std::array<double, 2> extra{};
    std::array<double, 2> texels{};
    for (std::size_t i = 0; i < 2; ++i) {
        const float edge = i == 0 ? 2.56F : 5.12F;
        const Stage stage(edge, edge);
        const DirectMaps flat = stage.build(on_floor([](float, float) { return kFull; }));
        const DirectMaps maps = stage.build(on_floor(half_plane(0.35, 0.01)));
        extra[i] = double(maps.evaluations - flat.evaluations);
        texels[i] = double(edge) * edge / (0.005 * 0.005);
    }
    EXPECT_NEAR(extra[1] / extra[0], 2.0, 0.15);
    EXPECT_LT(extra[0], 0.02 * texels[0]);
}

// A sharp part over a soft one: both are there, and the sharp one's edge asks the soft one nothing.
TEST(DirectMaps, PartsAddUpAndAreLookedForApart) {
    const Stage stage(2.56F, 2.56F);
    std::array<std::atomic<std::size_t>, 2> calls{};
    const auto edge = half_plane(0.4, 0.3);
    const auto soft = [](float x, float z) { return 200.0F + 60.0F * x + 30.0F * z; };
    const DirectPart parts[] = {{on_floor([&](float x, float z) {
                                     ++calls[0];
                                     return edge(x, z);
                                 }),
                                 false},
                                {on_floor([&](float x, float z) {
                                     ++calls[1];
                                     return soft(x, z);
                                 }),
                                 true}};
    const DirectMaps maps = build_direct_maps(
        *stage.rays, stage.charts, parts, [](std::uint32_t) { return false; }, stage.settings, stage.context, 0.0, 1.0);
    ASSERT_TRUE(maps.complete && maps.front[0]);
    EXPECT_EQ(calls[1], 9U * 9U + 8U * 8U) << "corners of tiles, and a probe in each";
    EXPECT_EQ(maps.evaluations, calls[0] + calls[1]);
    for (double x = -1.27; x < 1.28; x += 0.0313) {
        for (double z = -1.27; z < 1.28; z += 0.0297) {
            if (std::abs(std::cos(0.4) * x + std::sin(0.4) * z - 0.3) > 0.0075) { // border samples are 2 mm inside
                const float expected = edge(float(x), float(z)) + soft(float(x), float(z));
                ASSERT_NEAR(stage.at(maps, x, z), expected, 0.2) << x << ", " << z;
            }
        }
    }
}

// A smooth field is followed within the contrast asked for and without the finest texels.
TEST(DirectMaps, SmoothLightIsFollowedWithinTheContrast) {
    const Stage stage(3.2F, 3.2F);
    // A point light 0.5 m above the floor: 1000 lux below it.
    const auto lamp = [](float x, float z) { return kFull * std::pow(1.0F + 4.0F * (x * x + z * z), -1.5F); };
    const DirectMaps maps = stage.build(on_floor(lamp));
    for (double x = -1.59; x < 1.6; x += 0.0517) {
        for (double z = -1.59; z < 1.6; z += 0.0533) {
            const double e = lamp(float(x), float(z));
            ASSERT_NEAR(stage.at(maps, x, z), e, stage.settings.contrast * e) << x << ", " << z;
        }
    }
    for (const LightMap::Tile& t : maps.front[0]->tiles) {
        EXPECT_LE(t.level, 4U);
    }
}

// Noise that the samples declare is not looked into.
TEST(DirectMaps, DeclaredNoiseAsksForNoTexels) {
    const Stage stage(3.2F, 3.2F);
    const auto noisy = [](const vec3& p, const vec3&) {
        const float r = std::sin(12345.0F * p.x + 54321.0F * p.z);
        return DirectSample{Rgb(kFull + 100.0F * r), 100.0F * 100.0F};
    };
    const DirectMaps maps = stage.build(noisy);
    for (const LightMap::Tile& t : maps.front[0]->tiles) {
        EXPECT_EQ(t.level, stage.settings.first_level);
    }
    EXPECT_NEAR(maps.error_estimate, 0.1, 0.005) << "100 lux of 1000";
}

// An L-shaped floor: no sample outside it or on its very edge, real light up to the border.
TEST(DirectMaps, SamplesStayInsideThePolygon) {
    Stage stage(1, 1);
    stage.scene = Scene();
    Shape shape;
    shape.geometry = Polygon{{{-1, -1}, {1, -1}, {1, -0.3F}, {-0.2F, -0.3F}, {-0.2F, 0.9F}, {-1, 0.9F}}, {}};
    Node node;
    node.shape = stage.scene.shapes.insert(shape);
    node.materials = {add_material(stage.scene, 0.5F)};
    stage.scene.roots.push_back(stage.scene.nodes.insert(node));
    stage.ready();
    std::atomic<int> outside{0};
    const vec3 o(stage.rays->origin());
    const DirectMaps maps = stage.build([&](const vec3& engine, const vec3& n) {
        const vec3 p = engine + o;
        const auto in = [&](float x0, float y0, float x1, float y1) {
            return p.x > x0 && p.x < x1 && p.y > y0 && p.y < y1 && std::abs(p.z) < 1e-6F;
        };
        const float m = 0.0012F; // of the 2 mm that samples keep from the border; 1.4 of them across a corner
        const bool inside = in(-1 + m, -1 + m, 1 - m, -0.3F - m) || in(-1 + m, -1 + m, -0.2F - m, 0.9F - m);
        outside += inside && n.z > 0.99F ? 0 : 1;
        return DirectSample{Rgb(p.x > 0.4F ? kFull : 0.5F * kFull), 0.0F};
    });
    ASSERT_TRUE(maps.complete);
    EXPECT_EQ(outside, 0);
    const auto at = [&](float x, float y) {
        return luminance(maps.front[0]->irradiance(chart_position(stage.charts[0], vec3(x, y, 0) - o)));
    };
    for (const auto& [x, y] : {std::pair{0.999F, -0.301F}, {0.999F, -0.999F}, {0.42F, -0.3F}}) {
        EXPECT_NEAR(at(x, y), kFull, 1e-3) << x;
    }
    for (const auto& [x, y] : {std::pair{-0.201F, -0.299F}, {-0.201F, 0.899F}, {-0.999F, 0.899F}}) {
        EXPECT_NEAR(at(x, y), 0.5F * kFull, 1e-3) << x;
    }
    int unused = 0;
    for (const LightMap::Tile& t : maps.front[0]->tiles) {
        unused += t.used == 0 ? 1 : 0;
    }
    EXPECT_GT(unused, 0) << "tiles in the notch of the L";
}

NodeId add_box(Scene& scene, const vec3& size, const dvec3& centre) {
    Shape shape;
    shape.geometry = Box{size};
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = {add_material(scene, 0.5F)};
    node.transform.translation = centre;
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

// A box on the floor beside a lamp: full light up to its lit side, full dark up to its dark side.
TEST(DirectMaps, NoHaloRunsOutFromUnderABox) {
    for (const double gap : {0.0, 1e-4}) {
        Stage stage(3.2F, 3.2F);
        add_box(stage.scene, {0.5F, 0.4F, 0.6F}, {0.013, 0.2 + gap, 0.007});
        add_point_light(stage.scene, {-1.2, 1.5, 0}, 4 * kPiD * 1000);
        stage.ready();
        stage.charts.resize(1);
        stage.charts.resize(stage.rays->surfaces().size());
        const DirectLight direct(stage.scene, *stage.rays);
        const DirectMaps maps = stage.build([&](const vec3& p, const vec3& n) { return direct.irradiance(p, n, 1, 0); });
        ASSERT_TRUE(maps.complete);
        const auto lamp = [](double x, double z) {
            const double d2 = (x + 1.2) * (x + 1.2) + 1.5 * 1.5 + z * z;
            return 1000.0 * 1.5 / (d2 * std::sqrt(d2));
        };
        for (double z = -0.28; z < 0.29; z += 0.011) {
            for (const double x : {-0.2375, -0.24, -0.25, -0.3}) {
                ASSERT_NEAR(stage.at(maps, x, z) / lamp(x, z), 1.0, 0.03) << x << ", " << z;
            }
            for (const double x : {0.264, 0.268, 0.3}) {
                ASSERT_EQ(stage.at(maps, x, z), 0.0) << x << ", " << z;
            }
        }
    }
}

// Light of large sources has its finest detail beside things: there it is sampled as densely as all other light, elsewhere
// at the corners of tiles. A dark patch between these is found beside a box, and would not be found without it.
TEST(DirectMaps, SoftLightIsLookedAtCloselyBesideThings) {
    const auto dark_in = [](float x, float z) {
        return glm::length(vec2(x, z) - vec2(0.48F, -0.16F)) < 0.1F ? 0.0F : kFull;
    };
    std::array<std::size_t, 2> samples{};
    for (const bool box : {false, true}) {
        Stage stage(2.56F, 2.56F);
        if (box) {
            add_box(stage.scene, {0.1F, 0.3F, 0.1F}, {0.48, 0.151, -0.16}); // just off the floor
        }
        stage.ready();
        stage.charts.resize(1);
        stage.charts.resize(stage.rays->surfaces().size());
        const auto o = vec3(stage.rays->origin());
        const DirectPart part{[&](const vec3& p, const vec3&) {
                                  return DirectSample{Rgb(dark_in(p.x + o.x, p.z + o.z)), 0.0F};
                              },
                              true,
                              false,
                              {}};
        const DirectMaps maps = build_direct_maps(
            *stage.rays, stage.charts, std::span(&part, 1), [](std::uint32_t) { return false; }, stage.settings,
            stage.context, 0.0, 1.0);
        ASSERT_TRUE(maps.complete && maps.front[0]);
        samples[box ? 1 : 0] = maps.evaluations;
        EXPECT_NEAR(stage.at(maps, 0.48, -0.10), box ? 0.0 : kFull, 0.3 * kFull);
        EXPECT_NEAR(stage.at(maps, -0.9, 0.3), kFull, 1e-3);
    }
    EXPECT_LT(samples[0], 300U);
    EXPECT_LT(samples[1], 33U * 33U) << "the rest of the floor stays coarse";
}

TEST(DirectMaps, BackSidesHaveMapsOfTheirOwn) {
    Stage stage(1.28F, 1.28F);
    Material both;
    both.double_sided = true;
    stage.scene.nodes.find(stage.scene.roots[0])->materials = {stage.scene.materials.insert(both)};
    stage.ready();
    const auto by_side = [](const vec3&, const vec3& n) { return DirectSample{Rgb(n.y > 0 ? 10.0F : 20.0F), 0.0F}; };
    const DirectMaps maps = stage.build(by_side, true);
    ASSERT_TRUE(maps.front[0] && maps.back[0]);
    EXPECT_NEAR(luminance(maps.front[0]->irradiance({1.3F, 2.2F})), 10.0F, 1e-4);
    EXPECT_NEAR(luminance(maps.back[0]->irradiance({1.3F, 2.2F})), 20.0F, 1e-4);
    EXPECT_FALSE(stage.build(by_side, false).back[0]);
}

/// The side of a cylinder of radius 0.3 and height 1 about z in n flat strips with round normals, and its chart.
void add_cylinder(Stage& stage, int n, float radius) {
    auto data = std::make_shared<MeshData>();
    for (int i = 0; i <= n; ++i) {
        const float a = 2 * kPi * float(i) / float(n);
        for (const float z : {0.0F, 1.0F}) {
            data->positions.emplace_back(radius * std::cos(a), radius * std::sin(a), z);
            data->normals.emplace_back(std::cos(a), std::sin(a), 0);
        }
    }
    for (std::uint32_t i = 0; i < std::uint32_t(n); ++i) {
        const std::uint32_t a = 2 * i;
        data->indices.insert(data->indices.end(), {a, a + 2, a + 1, a + 2, a + 3, a + 1});
    }
    data->parts = {{0, std::uint32_t(data->indices.size())}};
    stage.scene = Scene();
    Shape shape;
    shape.geometry = Mesh{data};
    Node node;
    node.shape = stage.scene.shapes.insert(shape);
    node.materials = {add_material(stage.scene, 0.5F)};
    stage.scene.roots.push_back(stage.scene.nodes.insert(node));
    stage.rays = std::make_unique<RayScene>(stage.scene);
    SurfaceCharts charts;
    charts.tile_edge = 0.32F;
    charts.width = 6;
    charts.height = 3;
    Chart chart;
    chart.planar = false;
    chart.tiles_u = 6;
    chart.tiles_v = 3;
    chart.scale = vec2(2 * kPi * radius / 6.0F, 0.36F);
    charts.charts = {chart};
    for (const uvec3& t : stage.rays->surfaces()[0].triangles) {
        std::array<vec2, 3> uv;
        for (int k = 0; k < 3; ++k) {
            uv[std::size_t(k)] = {6.0F * float(t[k] / 2) / float(n), float(t[k] % 2) / 0.36F};
        }
        charts.uv.push_back(uv);
        charts.chart_of_triangle.push_back(0);
    }
    stage.charts = {charts};
}

// A round thing in parallel light: the cosine of the round normal, whatever its facets, and no facet shades itself.
TEST(DirectMaps, RoundThingsAreLitAsRound) {
    Stage stage(1, 1);
    add_cylinder(stage, 16, 0.3F);
    Light sun;
    sun.kind = Light::Kind::Directional;
    sun.intensity = kFull;
    sun.angular_diameter_degrees = 0.0F;
    Node node;
    node.light = stage.scene.lights.insert(sun);
    node.transform.rotation = glm::angleAxis(kPiD / 2, dvec3(0, 1, 0)); // shines along -x
    stage.scene.roots.push_back(stage.scene.nodes.insert(node));
    const DirectLight direct(stage.scene, *stage.rays);
    const DirectMaps maps = stage.build([&](const vec3& p, const vec3& n) { return direct.irradiance(p, n, 1, 0); });
    ASSERT_TRUE(maps.complete && maps.front[0]);
    for (float u = 0.01F; u < 5.99F; u += 0.0371F) {
        const float cosine = std::max(std::cos(2 * kPi * u / 6.0F), 0.0F);
        for (const float v : {0.1F, 1.3F, 2.7F}) {
            // Normals interpolated over a facet of 22.5 degrees are off by 0.1 % of the light, slightly behind it by 2 %.
            ASSERT_NEAR(luminance(maps.front[0]->irradiance({u, v})) / kFull, cosine, 0.03F) << u << ", " << v;
        }
    }
}

TEST(DirectMaps, SameBitsForAnyNumberOfThreads) {
    const Stage stage(2.4F, 2.1F);
    const auto light = [edge = half_plane(0.7, 0.1)](float x, float z) { return edge(x, z) + 50.0F * x * x * z; };
    std::vector<LightMap> seen;
    for (const unsigned threads : {1U, 2U, 8U}) {
        set_thread_limit(threads);
        const DirectMaps maps = stage.build(on_floor(light));
        ASSERT_TRUE(maps.front[0]);
        seen.push_back(*maps.front[0]);
    }
    set_thread_limit(0);
    EXPECT_TRUE(seen[0] == seen[1]);
    EXPECT_TRUE(seen[0] == seen[2]);
}

// A strong edge and a weak one, and room for one of them.
TEST(DirectMaps, BudgetIsKeptAndGoesToTheStrongestEdge) {
    Stage stage(3.2F, 3.2F);
    const auto light = [strong = half_plane(0, -0.77), weak = half_plane(0, 0.77)](float x, float z) {
        return 500.0F + strong(x, z) + 0.3F * weak(x, z);
    };
    const DirectMaps whole = stage.build(on_floor(light));
    EXPECT_EQ(whole.limited_tiles, 0U);
    stage.settings.max_samples = 100 * 25 + 12 * 65 * 65;
    const DirectMaps maps = stage.build(on_floor(light));
    ASSERT_TRUE(maps.complete);
    EXPECT_LE(maps.samples, stage.settings.max_samples);
    EXPECT_GT(maps.limited_tiles, 0U);
    EXPECT_GT(whole.samples, stage.settings.max_samples);
    int fine_strong = 0, fine_weak = 0;
    const LightMap& map = *maps.front[0];
    for (std::uint32_t v = 0; v < map.height; ++v) {
        fine_strong += map.tiles[v * map.width + 2].level == 6 ? 1 : 0;
        fine_weak += map.tiles[v * map.width + 7].level == 6 ? 1 : 0;
    }
    EXPECT_GE(fine_strong, 9);
    EXPECT_EQ(fine_weak, 0);
}

TEST(DirectMaps, StopsPromptlyAndProgressNeverFalls) {
    Stage stage(3.2F, 3.2F);
    std::atomic<std::size_t> calls{0};
    const auto light = half_plane(0.7, 0.1);
    const auto count = [&](float x, float z) {
        if (++calls == 2000) {
            stage.context.stop.request_stop();
        }
        return light(x, z);
    };
    double last = 0.0;
    bool falls = false;
    stage.context.on_progress = [&](const Progress& p) {
        falls = falls || p.fraction < last;
        last = p.fraction;
    };
    const DirectMaps stopped = stage.build(on_floor(count));
    EXPECT_FALSE(stopped.complete);
    EXPECT_TRUE(stopped.front.empty());
    EXPECT_LT(calls, 2000U + 32U * (thread_limit() + 1)) << "a chunk per thread at most";
    stage.context.stop = StopFlag();
    calls = 2001;
    last = 0.0;
    EXPECT_TRUE(stage.build(on_floor(count)).complete);
    EXPECT_FALSE(falls);
    EXPECT_EQ(last, 1.0);
}

// The mean over rectangles of any place and size against many lookups.
TEST(LightMapMean, IsTheIntegralOfTheInterpolant) {
    const Stage stage(1.6F, 1.28F);
    const DirectMaps maps = stage.build(on_floor(half_plane(0.7, 0.1)));
    const LightMap& map = *maps.front[0];
    const float rectangles[][4] = {
        {0, 0, 5, 4}, {0.2F, 0.3F, 0.21F, 0.32F}, {1.9F, 0.1F, 3.3F, 3.9F}, {2.4F, 1.9F, 2.7F, 2.1F}, {-1, -1, 2, 2}};
    for (const auto& r : rectangles) {
        double sum = 0.0;
        int inside = 0;
        constexpr int kPoints = 600;
        for (int j = 0; j < kPoints; ++j) {
            for (int i = 0; i < kPoints; ++i) {
                const vec2 p(r[0] + (r[2] - r[0]) * (float(i) + 0.5F) / kPoints,
                             r[1] + (r[3] - r[1]) * (float(j) + 0.5F) / kPoints);
                if (p.x > 0 && p.y > 0) { // what lies outside the map does not count
                    sum += luminance(map.irradiance(p));
                    ++inside;
                }
            }
        }
        EXPECT_NEAR(luminance(map.mean({r[0], r[1]}, {r[2], r[3]})), sum / inside, 0.001 * kFull) << r[0];
    }
    EXPECT_EQ(map.mean({1, 1}, {1, 1}), map.irradiance({1, 1}));
    EXPECT_EQ(luminance(LightMap().mean({0, 0}, {1, 1})), 0.0F);
}

} // namespace
} // namespace atrium
