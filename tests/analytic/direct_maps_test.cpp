// Light maps against shadows in closed form and by brute force (cases named as in shared/validation).
#include "engine/layers/direct_map_builder.h"
#include "engine/radiosity/point_gather.h"
#include "tests/support/flat_charts.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace test;

// Turns a light's -z downwards.
const dquat kDown = glm::angleAxis(-kPiD / 2, dvec3(1, 0, 0));

/// A floor (the first surface) with a light map under whatever a test builds over it.
struct Floor {
    Scene scene;
    std::unique_ptr<RayScene> rays;
    std::vector<SurfaceCharts> charts;
    DirectMapSettings settings;
    DirectMaps maps;

    Floor(float w, float d) { add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, w, d, add_material(scene, 0)); }
    void ready() {
        rays = std::make_unique<RayScene>(scene);
        charts = flat_charts(*rays);
        for (std::size_t i = 1; i < charts.size(); ++i) {
            charts[i] = {}; // nobody looks at the others
        }
    }
    void build(const DirectFunction& light) {
        maps = build_direct_maps(
            *rays, charts, light, [](std::uint32_t) { return false; }, settings, RunContext{}, 0.0, 1.0);
        ASSERT_TRUE(maps.complete && maps.front[0]);
    }
    double at(double x, double z) const {
        const vec3 p = vec3(dvec3(x, 0, z) - rays->origin());
        return luminance(maps.front[0]->irradiance(chart_position(charts[0], p)));
    }
};

// Share of the unit disc on the side x < c of a straight edge: the area of a circular segment.
double segment_share(double c) {
    c = std::clamp(c, -1.0, 1.0);
    return 1.0 - (std::acos(c) - c * std::sqrt(1.0 - c * c)) / kPiD;
}

// SHADOW-SUN: the sun at the zenith, a half plane 3 m above the floor.
TEST(DirectMaps, PenumbraOfTheSunAlongAWholeEdge) {
    constexpr double kHeight = 3.0, kHalfWidth = kHeight * 0.0046530814;
    const double published[][2] = {{-0.75, 0.07214680641}, {-0.25, 0.3425188212}, {0.5, 0.8044988905}};
    for (const auto& [x, visible] : published) {
        ASSERT_NEAR(segment_share(x), visible, 1e-7);
    }
    for (const double turn : {0.0, 0.5}) {
        Floor floor(1.0F, 1.0F);
        Light sun;
        sun.kind = Light::Kind::Directional;
        sun.intensity = 1000;
        sun.angular_diameter_degrees = 2.0F * 0.2666F;
        Node node;
        node.light = floor.scene.lights.insert(sun);
        node.transform.rotation = kDown;
        floor.scene.roots.push_back(floor.scene.nodes.insert(node));
        const dvec3 across(std::cos(turn), 0, std::sin(turn));
        add_rectangle(floor.scene, "roof", -5.0 * across + dvec3(0, kHeight, 0), {0, -1, 0}, across, 10, 10,
                      add_material(floor.scene, 0));
        floor.ready();
        const DirectLight direct(floor.scene, *floor.rays);
        floor.build([&](const vec3& p, const vec3& n) { return direct.irradiance(p, n, 256, 0); });
        // On texels 2 %; between them the straight line from one to the next is off by up to another 2 % where the umbra
        // ends.
        const double texel = 0.32 / 64;
        for (int j = 50; j < 150; ++j) {
            for (int i = 0; i < 400; ++i) {
                const double x = -0.5 + 0.5 * texel * i, z = -0.5 + texel * j;
                const double d = across.x * x + across.z * z;
                if (std::abs(d) < 0.05) {
                    const double bound = i % 2 == 0 ? 0.02 : 0.04;
                    ASSERT_NEAR(floor.at(x, z) / 1000.0, segment_share(d / kHalfWidth), bound) << x << ", " << z;
                }
            }
        }
        EXPECT_LT(floor.maps.evaluations, 8000U) << "of 40,000 texels";
    }
}

// A point light 2 m above the floor, a slot of 5 cm in a board at half height: a streak of 10 cm with sharp edges.
TEST(DirectMaps, PointLightThroughASlot) {
    Floor floor(1.6F, 1.6F);
    add_point_light(floor.scene, {0, 2, 0}, 4 * kPiD * 400); // 100 lux below it
    const MaterialId black = add_material(floor.scene, 0);
    add_rectangle(floor.scene, "left", {-1.025, 1, 0}, {0, 1, 0}, {1, 0, 0}, 2, 4, black);
    add_rectangle(floor.scene, "right", {1.025, 1, 0}, {0, 1, 0}, {1, 0, 0}, 2, 4, black);
    floor.ready();
    const DirectLight direct(floor.scene, *floor.rays);
    floor.build([&](const vec3& p, const vec3& n) { return direct.irradiance(p, n, 1, 0); });
    const double texel = 0.32 / 64;
    for (double z = -0.79; z < 0.8; z += 0.0117) {
        for (double x = -0.12; x < 0.12; x += 0.0011) {
            if (std::abs(std::abs(x) - 0.05) < texel) {
                continue;
            }
            const double d2 = x * x + 4 + z * z;
            const double e = std::abs(x) < 0.05 ? 400 * 2 / (d2 * std::sqrt(d2)) : 0.0;
            ASSERT_NEAR(floor.at(x, z), e, 0.5) << x << ", " << z;
        }
    }
}

// Irradiance at a floor point from a downward rectangle (centre (0, h, 0), a x a, exitance M) past a half plane x < 0 at
// height k, by many points.
double past_half_plane(double x, double z, double h, double a, double exitance, double k) {
    constexpr int kPoints = 300;
    double sum = 0.0;
    for (int i = 0; i < kPoints; ++i) {
        const double lx = a * ((i + 0.5) / kPoints - 0.5);
        if (x + (lx - x) * k / h < 0.0) {
            continue;
        }
        for (int j = 0; j < kPoints; ++j) {
            const double lz = a * ((j + 0.5) / kPoints - 0.5);
            const double d2 = (lx - x) * (lx - x) + h * h + (lz - z) * (lz - z);
            sum += h * h / (d2 * d2);
        }
    }
    return exitance / kPiD * sum * (a / kPoints) * (a / kPoints);
}

// A panel of 0.3 m, a board's edge at a quarter of its height: a penumbra of 10 cm, with sampled visibility.
TEST(DirectMaps, PenumbraOfAGlowingPanel) {
    constexpr double kHeight = 2.0, kEdge = 0.3, kExitance = 10000.0, kBoard = 0.5;
    Floor floor(0.9F, 0.9F);
    add_rectangle(floor.scene, "panel", {0, kHeight, 0}, {0, -1, 0}, {1, 0, 0}, float(kEdge), float(kEdge),
                  add_material(floor.scene, 0, float(kExitance)));
    add_rectangle(floor.scene, "board", {-2, kBoard, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, add_material(floor.scene, 0));
    floor.ready();
    Hierarchy hierarchy = build_hierarchy(*floor.rays, {});
    for (Element& e : hierarchy.elements) {
        e.radiosity = e.leaf() ? e.emitted : Rgb(0.0F);
    }
    hierarchy.pull_radiosity();
    const PointGather gather(hierarchy, *floor.rays);
    GatherSettings settings;
    settings.rays = 256;
    floor.build([&](const vec3& p, const vec3& n) { return gather.irradiance(p, n, settings); });
    const double full = past_half_plane(0.3, 0, kHeight, kEdge, kExitance, kBoard);
    double sum2 = 0.0;
    int count = 0;
    for (double z = -0.3; z < 0.31; z += 0.0537) {
        for (double x = -0.15; x < 0.151; x += 0.0049) {
            const double off = (floor.at(x, z) - past_half_plane(x, z, kHeight, kEdge, kExitance, kBoard)) / full;
            ASSERT_NEAR(off, 0.0, 0.04) << x << ", " << z;
            sum2 += off * off;
            ++count;
        }
    }
    EXPECT_LT(std::sqrt(sum2 / count), 0.012);
}

} // namespace
} // namespace atrium
