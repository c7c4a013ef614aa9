// Reflected light at points: what stands out, rays over the hemisphere, records and leaves that are too coarse.
#include "engine/base/parallel.h"
#include "engine/radiosity/indirect_gather.h"
#include "engine/radiosity/irradiance_cache.h"
#include "engine/radiosity/leaf_gather.h"
#include "engine/radiosity/light_split.h"
#include "engine/reference/reference.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using test::add_material;
using test::add_rectangle;
using test::add_room;

Scene room(float rho, float exitance = 0.0F) {
    Scene scene;
    add_room(scene, 4, 2.5F, 3, add_material(scene, rho, exitance));
    return scene;
}

TEST(LightSplit, LampsStandOutAndWallsOfAFurnaceDoNot) {
    Scene lit = room(0.5F);
    add_rectangle(lit, "panel", {2, 2.49, 1.5}, {0, -1, 0}, {1, 0, 0}, 0.6F, 0.6F, add_material(lit, 0.0F, 3000.0F));
    const RayScene rays(lit);
    const Hierarchy h = build_hierarchy(rays, {});
    const LeafFlags named = named_emitters(h, {}, 4.0F);
    double flux = 0.0;
    for (std::size_t i = 0; i < named.size(); ++i) {
        flux += named[i] != 0 ? double(h.elements[i].area) * h.elements[i].emitted.r : 0.0;
    }
    EXPECT_NEAR(flux, 0.36 * 3000.0, 0.1);
    // The copy shines with the lamp alone.
    EXPECT_NEAR(only_flagged(h, named, true).elements[0].power, 0.36F * 3000.0F, 0.1F);

    const RayScene furnace(room(0.5F, 100.0F));
    const Hierarchy all = build_hierarchy(furnace, {});
    for (const std::uint8_t flag : named_emitters(all, {}, 4.0F)) {
        EXPECT_EQ(flag, 0) << "no wall stands out from the others";
    }
}

TEST(IndirectGather, UniformRadiosityGivesThatIrradiance) {
    const Scene scene = room(0.5F);
    const RayScene rays(scene);
    Hierarchy h = build_hierarchy(rays, {});
    for (Element& e : h.elements) {
        e.radiosity = Rgb(1.0F, 2.0F, 3.0F);
    }
    h.pull_radiosity();
    const IndirectGather gather(h, rays, LeafFlags(h.elements.size(), 0));
    const vec3 corner = vec3(dvec3(0.01, 0, 0.01) - rays.origin());
    const FieldSample sample = gather.irradiance(corner, {0, 1, 0}, {});
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(sample.irradiance[c], float(c + 1), 1e-4F) << "in a closed room every ray lands";
    }
    EXPECT_LT(sample.nearest, 0.2F) << "walls are a centimetre away";
    EXPECT_LT(sample.distance, 1.0F);
    EXPECT_LT(sample.variance, 1e-6F);
}

/// A room of radiosity 1 with a panel of one square metre under its ceiling whose radiosity is 50.
struct PanelRoom {
    static Scene with_panel() {
        Scene scene = room(0.5F);
        add_rectangle(scene, "panel", {2, 2.4, 1.5}, {0, -1, 0}, {1, 0, 0}, 1, 1, add_material(scene, 0.5F));
        return scene;
    }
    RayScene rays{with_panel()};
    Hierarchy h = build_hierarchy(rays, {});
    LeafFlags bright = LeafFlags(h.elements.size(), 0); ///< the panel

    PanelRoom() {
        for (std::size_t i = 0; i < h.elements.size(); ++i) {
            Element& e = h.elements[i];
            const bool panel = e.leaf() && std::abs(e.area - 1.0F) < 1e-3F;
            bright[i] = panel ? 1 : 0;
            e.radiosity = Rgb(panel ? 50.0F : 1.0F);
        }
        h.pull_radiosity();
    }
};

// A bright panel gathered by name and the same panel found by rays: two estimates of one integral.
TEST(IndirectGather, WhatIsGatheredByNameIsNotGatheredTwice) {
    const PanelRoom panel;
    IndirectSettings many;
    many.rays = many.max_rays = 4096;
    many.bright.tolerance = 1e-4F;
    const IndirectGather by_rays(panel.h, panel.rays, LeafFlags(panel.h.elements.size(), 0));
    const IndirectGather by_name(panel.h, panel.rays, panel.bright);
    const vec3 p = vec3(dvec3(1.2, 0, 1.1) - panel.rays.origin());
    const FieldSample a = by_rays.irradiance(p, {0, 1, 0}, many);
    const FieldSample b = by_name.irradiance(p, {0, 1, 0}, many);
    EXPECT_GT(a.irradiance.r, 2.0F);
    EXPECT_LT(b.variance, 0.1F * a.variance);
    EXPECT_NEAR(b.irradiance.r, a.irradiance.r, 3.0F * std::sqrt(a.variance + b.variance));
    EXPECT_LT(std::sqrt(a.variance), 0.05F * a.irradiance.r) << "or the comparison says little";
}

// Beside a spot that stands out its mean says too little: rays look at it, and it is still counted once.
TEST(IndirectGather, SpotsThatAreTooNearAreLeftToTheRays) {
    const PanelRoom panel;
    IndirectSettings settings;
    settings.rays = settings.max_rays = 1024;
    settings.bright.nearest = 1.5F; // of the panel's radius of 0.71 m
    const IndirectGather by_rays(panel.h, panel.rays, LeafFlags(panel.h.elements.size(), 0));
    const IndirectGather by_name(panel.h, panel.rays, panel.bright);
    const auto both = [&](double y) {
        const vec3 p = vec3(dvec3(2.1, y, 1.4) - panel.rays.origin());
        return std::pair(by_rays.irradiance(p, {0, 1, 0}, settings).irradiance.r,
                         by_name.irradiance(p, {0, 1, 0}, settings).irradiance.r);
    };
    const auto [near_rays, near_name] = both(1.9);
    EXPECT_GT(near_rays, 20.0F);
    EXPECT_EQ(near_name, near_rays) << "the same rays and nothing else";
    const auto [far_rays, far_name] = both(0.0);
    EXPECT_NE(far_name, far_rays) << "by name again";
    EXPECT_NEAR(far_name, far_rays, 0.1F * far_rays);
}

// Between two plates light fades from their open edge inwards. On leaves as large as the plates that is one mean; four
// further rays leave of its error what four reflections leave.
TEST(IndirectGather, NarrowPlacesAreAsDarkAsTheyAreThoughLeavesAreLarge) {
    constexpr float kRho = 0.5F;
    Scene scene;
    const MaterialId grey = add_material(scene, kRho);
    add_rectangle(scene, "left", {0, 0.25, 0}, {1, 0, 0}, {0, 0, 1}, 2, 0.5F, grey);
    add_rectangle(scene, "right", {0.06, 0.25, 0}, {-1, 0, 0}, {0, 0, 1}, 2, 0.5F, grey);
    add_rectangle(scene, "lamp", {0.03, 0.6, 0}, {0, -1, 0}, {0, 0, 1}, 2, 1.0F, add_material(scene, 0.0F, 1000.0F));
    const RayScene rays(scene);
    HierarchySettings coarse;
    coarse.smallest_patch = 4.0F;
    Hierarchy h = build_hierarchy(rays, coarse);
    // The leaves' means are those of the truth, so that all that is off is where in the leaf the light is.
    std::vector<ReferencePoint> points;
    for (int i = 0; i < 25; ++i) {
        points.push_back({{0, 0.01 + 0.02 * i, 0.1}, {1, 0, 0}});
    }
    ReferenceSettings paths;
    paths.paths = 16384;
    const auto truth = reference_irradiance(scene, points, paths, RunContext{});
    ASSERT_TRUE(bool(truth));
    double mean = 0.0;
    for (const ReferenceReading& r : truth->points) {
        mean += luminance(r.irradiance) / double(points.size());
    }
    for (Element& e : h.elements) {
        if (e.leaf() && e.rho.r > 0.0F) {
            e.irradiance = Rgb(float(mean));
            e.radiosity = e.rho * e.irradiance;
            EXPECT_GT(e.area, 0.9F) << "one leaf a plate";
        } else if (e.leaf()) {
            e.radiosity = e.emitted;
        }
    }
    h.pull_radiosity();
    const IndirectGather gather(h, rays, LeafFlags(h.elements.size(), 0));
    IndirectSettings settings;
    settings.rays = settings.max_rays = 4096;
    const std::size_t deep = 5; // 11 cm from the lower edge
    const vec3 p = vec3(points[deep].position - rays.origin());
    const double right = luminance(truth->points[deep].irradiance);
    const double by_means = luminance(gather.irradiance(p, {1, 0, 0}, settings).irradiance);
    settings.near = 1.0F;
    const FieldSample near = gather.irradiance(p, {1, 0, 0}, settings);
    EXPECT_GT(by_means, 3.0 * right) << "or the case says nothing";
    const double left_of_means = std::pow(kRho, 1.0 + settings.most_bounces) * mean;
    const double noise = std::hypot(std::sqrt(double(near.variance)), truth->points[deep].standard_error);
    EXPECT_NEAR(luminance(near.irradiance), right, left_of_means + 3.0 * noise);
    EXPECT_LT(left_of_means, 0.1 * (by_means - right));
}

// A floor that is white on one side only, under a point that looks down on its middle: the rays that find it white are half
// of all, and their further rays have to look everywhere all the same, wherever the light comes from.
TEST(IndirectGather, FurtherRaysDoNotFollowFromTheFirst) {
    constexpr float kWhite = 0.8F;
    for (const auto& [x, z] : {std::pair(-1.0, -1.0), {-1.0, 1.0}, {1.0, -1.0}, {1.0, 1.0}}) {
        Scene scene;
        add_rectangle(scene, "black", {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 4, 2, add_material(scene, 0.0F));
        add_rectangle(scene, "white", {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 4, 2, add_material(scene, kWhite));
        add_rectangle(scene, "lamp", {x, 1.2, z}, {0, -1, 0}, {0, 0, 1}, 1, 1, add_material(scene, 0.0F, 1000.0F));
        const RayScene rays(scene);
        HierarchySettings coarse;
        coarse.smallest_patch = 8.0F;
        Hierarchy h = build_hierarchy(rays, coarse);
        for (Element& e : h.elements) {
            e.radiosity = e.leaf() ? e.emitted : Rgb(0.0F);
        }
        h.pull_radiosity();
        const IndirectGather gather(h, rays, LeafFlags(h.elements.size(), 0));
        IndirectSettings settings;
        settings.rays = settings.max_rays = 4096;
        const vec3 p = vec3(dvec3(0, 0.02, 0) - rays.origin());
        const float floor = gather.irradiance(p, {0, 1, 0}, settings).irradiance.r; // alike below the point within 2 %
        for (Element& e : h.elements) { // what the leaf tells of its mean decides how many further rays there are
            e.irradiance = e.leaf() && e.rho.r > 0.0F ? Rgb(floor) : Rgb(0.0F);
        }
        settings.near = 1.0F;
        const float found = gather.irradiance(p, {0, -1, 0}, settings).irradiance.r;
        EXPECT_GT(floor, 30.0F);
        const float hits = 0.5F * float(settings.rays) * floor / 1000.0F; // further rays that find the lamp
        const float expected = 0.5F * kWhite * floor;
        EXPECT_NEAR(found, expected, 3.0F / std::sqrt(hits) * expected) << "lamp over " << x << ", " << z;
    }
}

std::vector<SurfacePoint> floor_points(const RayScene& rays, int n, double x0, double x1) {
    std::vector<SurfacePoint> points;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const dvec3 p(x0 + (x1 - x0) * (i + 0.5) / n, 0.0, 0.1 + 2.8 * (j + 0.5) / n);
            points.push_back({vec3(p - rays.origin()), {0, 1, 0}});
        }
    }
    return points;
}

TEST(IrradianceCache, FewRecordsHoldSmoothLight) {
    const RayScene rays(room(0.5F));
    const auto light = [&](const vec3& p) {
        const double x = double(p.x) + rays.origin().x;
        return float(100.0 + 30.0 * x + 10.0 * x * x);
    };
    IrradianceCache cache(rays,
                          [&](const vec3& p, const vec3&) {
                              FieldSample s;
                              s.irradiance = Rgb(light(p));
                              s.distance = 1.5F;
                              s.nearest = 1.0F;
                              return s;
                          },
                          {});
    const auto points = floor_points(rays, 60, 0.1, 3.9);
    ASSERT_TRUE(cache.cover(points, RunContext{}));
    EXPECT_LT(cache.size(), points.size() / 10);
    for (const SurfacePoint& p : points) {
        EXPECT_NEAR(cache.at(p.position, p.normal).irradiance.r / light(p.position), 1.0F, CacheSettings{}.contrast);
    }
}

// A wall between two rooms on one floor: records of the bright side must not be used on the dark one.
TEST(IrradianceCache, NothingReachesThroughAWall) {
    Scene scene = room(0.5F);
    Material both;
    both.double_sided = true;
    add_rectangle(scene, "partition", {2, 1.25, 1.5}, {1, 0, 0}, {0, 0, 1}, 3, 2.5F, scene.materials.insert(both));
    const RayScene rays(scene);
    const auto bright = [&](const vec3& p) { return double(p.x) + rays.origin().x < 2.0; };
    IrradianceCache cache(rays,
                          [&](const vec3& p, const vec3&) {
                              FieldSample s;
                              s.irradiance = Rgb(bright(p) ? 1000.0F : 1.0F);
                              s.distance = s.nearest = 2.0F;
                              return s;
                          },
                          {});
    const auto points = floor_points(rays, 50, 1.5, 2.5);
    ASSERT_TRUE(cache.cover(points, RunContext{}));
    for (const SurfacePoint& p : points) {
        EXPECT_NEAR(cache.at(p.position, p.normal).irradiance.r, bright(p.position) ? 1000.0F : 1.0F, 1e-2F);
    }
}

TEST(IrradianceCache, SameBitsForAnyNumberOfThreadsAndStopsWhenAsked) {
    const RayScene rays(room(0.5F));
    const auto sampler = [](const vec3& p, const vec3&) {
        FieldSample s;
        s.irradiance = Rgb(1.0F + std::sin(9.0F * p.x) * std::cos(7.0F * p.z));
        s.distance = s.nearest = 0.5F;
        return s;
    };
    const auto points = floor_points(rays, 60, 0.1, 3.9);
    std::vector<float> first;
    for (const unsigned threads : {1U, 2U, 8U}) {
        set_thread_limit(threads);
        IrradianceCache cache(rays, sampler, {});
        ASSERT_TRUE(cache.cover(points, RunContext{}));
        std::vector<float> values;
        for (const SurfacePoint& p : points) {
            values.push_back(cache.at(p.position, p.normal).irradiance.r);
        }
        first = first.empty() ? values : first;
        EXPECT_EQ(values, first) << threads;
    }
    set_thread_limit(0);
    RunContext stopped;
    stopped.stop.request_stop();
    IrradianceCache cache(rays, sampler, {});
    EXPECT_FALSE(cache.cover(points, stopped));
}

TEST(LeafGather, SplitsLeavesOnWhichReflectedLightIsUneven) {
    Scene scene = room(0.5F);
    const RayScene rays(scene);
    HierarchySettings settings;
    settings.smallest_patch = 0.3F;
    Hierarchy h = build_hierarchy(rays, settings);
    const auto never = [](const SurfacePoint&) { return false; };
    for (Element& e : h.elements) {
        e.radiosity = Rgb(1.0F);
    }
    h.pull_radiosity();
    const LeafGather even(h, rays, 128, 0, never, RunContext{});
    ASSERT_TRUE(even.complete());
    EXPECT_EQ(even.split_uneven(h, rays, 0.2F, 0.05F), 0U) << "every ray brings the same";
    // One wall shines: next to it there is more light than far from it.
    for (Element& e : h.elements) {
        e.radiosity = Rgb(e.leaf() && e.normal.x > 0.9F ? 10.0F : 0.1F);
    }
    h.pull_radiosity();
    const std::size_t before = h.elements.size();
    const LeafGather uneven(h, rays, 1024, 0, never, RunContext{});
    ASSERT_TRUE(uneven.complete());
    EXPECT_GE(uneven.split_uneven(h, rays, 0.2F, 0.05F), 2U) << "floor and ceiling at least";
    EXPECT_GT(h.elements.size(), before);
}

} // namespace
} // namespace atrium
