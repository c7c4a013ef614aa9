// Light over flat mirrors against closed forms and against the really mirrored lamp behind an aperture of the mirror's
// shape. Cases named as in shared/validation; y and z of a case are our z and y.
#include "engine/geometry/form_factor.h"
#include "engine/layers/direct_map_builder.h"
#include "engine/particles/particle_map.h"
#include "engine/radiosity/indirect_gather.h"
#include "tests/support/flat_charts.h"
#include "tests/support/light_cases.h"

#include <gtest/gtest.h>

#include <random>

namespace atrium {
namespace {

using namespace test;

MaterialId add_mirror(Scene& scene, const Rgb& rho, bool double_sided = false) {
    Material m;
    m.base_color = rho;
    m.metallic = 1.0F;
    m.roughness = 0.0F;
    m.double_sided = double_sided;
    return scene.materials.insert(m);
}

MaterialId add_pane(Scene& scene, float ior) {
    Material m;
    m.base_color = Rgb(1.0F);
    m.roughness = 0.0F;
    m.transmission = 1.0F;
    m.thickness = 0.0F;
    m.ior = ior;
    return scene.materials.insert(m);
}

// A sun whose light goes along `direction`.
void add_sun(Scene& scene, const dvec3& direction, float lux, float degrees) {
    Light light;
    light.kind = Light::Kind::Directional;
    light.intensity = lux;
    light.angular_diameter_degrees = degrees;
    Node node;
    node.light = scene.lights.insert(light);
    const dvec3 z = -glm::normalize(direction);
    const dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), z));
    node.transform.rotation = glm::normalize(glm::quat_cast(dmat3(x, glm::cross(z, x), z)));
    scene.roots.push_back(scene.nodes.insert(node));
}

// Reflectance of metal of normal reflectance rho at a cosine.
double schlick(double rho, double cosine) { return rho + (1.0 - rho) * std::pow(1.0 - cosine, 5.0); }

// Share of the unit disc on the side x < c of a straight edge.
double segment_share(double c) {
    c = std::clamp(c, -1.0, 1.0);
    return 1.0 - (std::acos(c) - c * std::sqrt(1.0 - c * c)) / kPiD;
}

/// A scene with what looks at its lights over its mirrors. Emitting surfaces are lamps.
struct Looker {
    explicit Looker(const Scene& scene) : rays(scene), direct(scene, rays), mirrors(rays) {
        const Hierarchy all = build_hierarchy(rays, {});
        LeafFlags lamps(all.elements.size(), 0);
        bool any = false;
        for (std::size_t i = 0; i < lamps.size(); ++i) {
            lamps[i] = all.elements[i].leaf() && max_component(all.elements[i].emitted) > 0.0F ? 1 : 0;
            any = any || lamps[i] != 0;
        }
        if (any) {
            emitters = only_flagged(all, lamps, true);
        }
        gather = std::make_unique<PointGather>(emitters, rays);
        settings.sun_rays = 256;
        settings.rays = 4096;
    }
    [[nodiscard]] Rgb mirrored(const dvec3& p, const dvec3& n) const {
        return mirrors.irradiance(vec3(p - rays.origin()), vec3(n), settings, &direct, gather.get()).irradiance;
    }
    [[nodiscard]] double over_mirrors(const dvec3& p, const dvec3& n) const { return luminance(mirrored(p, n)); }
    [[nodiscard]] double straight(const dvec3& p, const dvec3& n) const {
        const vec3 at(p - rays.origin());
        return luminance(direct.lamps_irradiance(at, vec3(n), settings.sun_rays).irradiance +
                         gather->irradiance(at, vec3(n), settings).irradiance);
    }
    RayScene rays;
    DirectLight direct;
    MirrorLight mirrors;
    Hierarchy emitters;
    std::unique_ptr<PointGather> gather;
    GatherSettings settings;
};

// CAUSTIC-PLANE-MIRROR: 1000 lm at (1, 1.5, 2), a mirror of 2 x 1 m at x = 0, a black wall at x = 4 that looks at it.
constexpr double kRho = 0.9;
Scene plane_mirror(bool turned = false, bool double_sided = false) {
    Scene scene;
    add_rectangle(scene, "wall", {4, 1.5, 2}, {-1, 0, 0}, {0, 0, 1}, 16, 10, add_material(scene, 0.0F));
    add_rectangle(scene, "mirror", {0, 1.5, 2}, {turned ? -1 : 1, 0, 0}, {0, 0, turned ? 1 : -1}, 2, 1,
                  add_mirror(scene, Rgb(float(kRho)), double_sided));
    add_point_light(scene, {1, 1.5, 2}, 1000);
    return scene;
}
const dvec3 kWall(-1, 0, 0);

TEST(MirrorLight, CausticPlaneMirror) {
    const Looker s(plane_mirror());
    ASSERT_EQ(s.mirrors.mirrors().mirrors().size(), 1U);
    const struct {
        dvec3 at;
        double mirror, direct;
    } points[] = {{{4, 1.5, 2}, 2.864788975654116, 8.841941282883075},
                  {{4, 1.5, 4}, 2.293008438103367, 5.0932660478820875},
                  {{4, 3.5, 2}, 2.293008438103367, 5.0932660478820875},
                  {{4, 1.5, 6.9}, 1.0436997897602942, 1.2587604940318646},
                  {{4, 1.5, 7.1}, 0.0, 1.1524530047078339},
                  {{4, 4.1, 2}, 0.0, 3.81572503066561}};
    for (const auto& p : points) {
        // The case has a constant reflectance, metal has a little more at an angle.
        const double cosine = 5.0 / glm::length(p.at - dvec3(-1, 1.5, 2));
        const double expected = p.mirror * schlick(kRho, cosine) / kRho;
        EXPECT_NEAR(s.over_mirrors(p.at, kWall), expected, 1e-5 * p.mirror) << p.at.y << " " << p.at.z;
        EXPECT_NEAR(s.straight(p.at, kWall) / p.direct, 1.0, 1e-5) << p.at.y << " " << p.at.z;
    }
    EXPECT_EQ(s.over_mirrors({4, 1.5, 2}, {1, 0, 0}), 0.0) << "looks away";
    EXPECT_EQ(s.over_mirrors({-3, 1.5, 2}, {1, 0, 0}), 0.0) << "behind the mirror";
    // All of the mirror's flux lands on the wall.
    double flux = 0.0;
    double expected = 0.0;
    constexpr int kCells = 100;
    for (int i = 0; i < kCells * kCells; ++i) {
        const dvec3 p(4, -1 + 5.0 * (i / kCells + 0.5) / kCells, -3 + 10.0 * (i % kCells + 0.5) / kCells);
        const double cosine = 5.0 / glm::length(p - dvec3(-1, 1.5, 2));
        const double light = s.over_mirrors(p, kWall) * 50.0 / (kCells * kCells);
        flux += light * kRho / schlick(kRho, cosine);
        expected += light;
    }
    EXPECT_NEAR(flux / 92.17474411461005, 1.0, 1e-4);
    // Particles carry none of it: they land where the images are.
    const SpecularTargets targets(s.rays);
    const ParticleMap particles(
        s.rays, targets, s.direct, {}, [&](const Hit& h) { return s.mirrors.carries(h); }, ParticleSettings{20'000, 256, 1},
        RunContext{});
    EXPECT_TRUE(particles.landings().empty());
}

TEST(MirrorLight, EdgeOnTheLightMapIsWhereTheImageHasIt) {
    const Looker s(plane_mirror());
    std::vector<SurfaceCharts> charts = flat_charts(s.rays);
    charts[1] = {};
    const DirectMaps maps = build_direct_maps(
        s.rays, charts,
        [&](const vec3& p, const vec3& n) { return s.mirrors.irradiance(p, n, s.settings, &s.direct, nullptr); },
        [](std::uint32_t) { return false; }, {}, RunContext{}, 0.0, 1.0);
    ASSERT_TRUE(maps.complete && maps.front[0]);
    const auto lit = [&](double y, double z) {
        const vec3 p(dvec3(4, y, z) - s.rays.origin());
        const dvec3 d = dvec3(4, y, z) - dvec3(-1, 1.5, 2);
        const double whole = kRho * 1000.0 / (4.0 * kPiD) * 5.0 / std::pow(glm::length(d), 3.0);
        return luminance(maps.front[0]->irradiance(chart_position(charts[0], p))) > 0.5 * whole;
    };
    // By halving, from inside to outside.
    const auto edge = [&](const std::function<bool(double)>& inside, double in, double out) {
        for (int k = 0; k < 30; ++k) {
            const double middle = 0.5 * (in + out);
            (inside(middle) ? in : out) = middle;
        }
        return in;
    };
    for (double t = -0.95; t < 1.0; t += 0.19) {
        const double y = 1.5 + 2.5 * t;
        const double z = 2.0 + 5.0 * t;
        EXPECT_NEAR(edge([&](double v) { return lit(y, v); }, 2, 9), 7.0, 0.010) << y;
        EXPECT_NEAR(edge([&](double v) { return lit(y, v); }, 2, -5), -3.0, 0.010) << y;
        EXPECT_NEAR(edge([&](double v) { return lit(v, z); }, 1.5, 6), 4.0, 0.010) << z;
        EXPECT_NEAR(edge([&](double v) { return lit(v, z); }, 1.5, -3), -1.0, 0.010) << z;
    }
}

// The sun at 45 degrees on an upright mirror whose lower edge is 1 m above the floor: a patch from x = 1 on.
TEST(MirrorLight, SunPatchAndItsPenumbra) {
    constexpr float kDegrees = 0.533F;
    const double radius = std::tan(radians_from_degrees(0.5 * kDegrees));
    for (const bool disc : {false, true}) {
        Scene scene;
        add_rectangle(scene, "mirror", {0, 1.5, 0}, {1, 0, 0}, {0, 0, -1}, 1, 1, add_mirror(scene, Rgb(0.8F)));
        add_rectangle(scene, "floor", {2, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, add_material(scene, 0.0F));
        add_sun(scene, {-1, -1, 0}, 1000, disc ? kDegrees : 0.0F);
        const Looker s(scene);
        const dvec3 up(0, 1, 0);
        const double full = 1000.0 * schlick(0.8, std::sqrt(0.5)) * std::sqrt(0.5);
        EXPECT_NEAR(s.over_mirrors({1.5, 0, 0.1}, up) / full, 1.0, 1e-5);
        EXPECT_NEAR(s.over_mirrors({1.5, 0, 0.1}, {-1, 0, 0}) / full, 1.0, 1e-5) << "upright, in the same light";
        EXPECT_EQ(s.over_mirrors({1.5, 0, 0.1}, {1, 0, 0}), 0.0) << "the sun stands on its back in the image";
        for (const dvec3& dark : {dvec3(0.97, 0, 0), dvec3(2.05, 0, 0), dvec3(1.5, 0, 0.53), dvec3(1.5, 0, -0.53)}) {
            EXPECT_EQ(s.over_mirrors(dark, up), 0.0) << dark.x << " " << dark.z;
        }
        // Along the patch's near edge the mirror's edge cuts the disc; without one the edge is sharp.
        for (double x = 0.98; x < 1.02; x += 0.0013) {
            const double above = std::tan(kPiD / 4 - std::atan2(1.0, x)) / radius;
            const double share = disc ? segment_share(above) : (above > 0.0 ? 1.0 : 0.0);
            EXPECT_NEAR(s.over_mirrors({x, 0, 0.2}, up) / full, share, disc ? 0.02 : 1e-5) << x;
        }
    }
}

// 5 mm of mirror in the middle of the sun's disc, which is 9.3 mm wide at that distance: the first rays pass by it.
TEST(MirrorLight, MirrorSmallerThanTheSunsDisc) {
    Scene scene;
    add_rectangle(scene, "mirror", {0, 0, 0}, {1, 0, 0}, {0, 0, -1}, 0.005F, 0.005F, add_mirror(scene, Rgb(1.0F)));
    add_sun(scene, {-1, 0, 0}, 1000, 0.533F);
    Looker s(scene);
    s.settings.sun_rays = 1024;
    const double radius = std::tan(radians_from_degrees(0.5 * 0.533));
    const double share = 25e-6 / (kPiD * radius * radius);
    EXPECT_NEAR(s.over_mirrors({1, 0, 0}, {-1, 0, 0}) / 1000.0, share, 0.02);
}

// A lamp that shines into the mirror and is not in its own way, and the same lamp where its image is, behind a screen with a
// hole like the mirror.
TEST(MirrorLight, AreaLampEqualsTheMirroredLampBehindAnAperture) {
    for (const float size : {0.1F, 0.8F}) {
        Scene real;
        add_rectangle(real, "mirror", {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, 0.6F, 0.4F, add_mirror(real, Rgb(1.0F)));
        add_rectangle(real, "lamp", {1, 2.2, 0.3}, {-1, 0, 0}, {0, 0, 1}, size, size, add_material(real, 0, 1000));
        Scene image;
        add_frame(image, {0, -4, 5}, {0, 0, -10}, {0, 10, 0}, {4.7, 4.8}, {5.3, 5.2}, add_material(image, 0));
        add_rectangle(image, "lamp", {-1, 2.2, 0.3}, {1, 0, 0}, {0, 0, -1}, size, size, add_material(image, 0, 1000));
        const Looker a(real);
        Looker b(image);
        b.settings.rays = 1U << 14U;
        int lit = 0;
        int dark = 0;
        for (double z = -2.0; z <= 1.0; z += 0.23) {
            for (double y = -2.6; y <= 0.2; y += 0.31) {
                const dvec3 p(2, y, z);
                const double over = a.over_mirrors(p, {-1, 0, 0});
                const double straight = b.straight(p, {-1, 0, 0});
                // Sample points of a lamp keep clear of its rim by 0.2 %: the sampled one is off where only the rim is seen.
                EXPECT_NEAR(over, straight, 0.005 * straight + 0.03 * size * size) << size << " " << y << " " << z;
                // Through the mirror a part of the image's plane is seen, half as large again.
                const double low = std::max(2.2 - 0.5 * size, y + 1.5 * (0.8 - y));
                const double high = std::min(2.2 + 0.5 * size, y + 1.5 * (1.2 - y));
                const double left = std::max(0.3 - 0.5 * size, z + 1.5 * (-0.3 - z));
                const double right = std::min(0.3 + 0.5 * size, z + 1.5 * (0.3 - z));
                double exact = 0.0;
                if (low < high && left < right) {
                    const std::array<vec3, 4> seen{vec3(-1, low, left), vec3(-1, low, right), vec3(-1, high, right),
                                                   vec3(-1, high, left)};
                    exact = 1000.0 * form_factor_to_polygon(vec3(p), {-1, 0, 0}, seen);
                }
                EXPECT_NEAR(over, exact, 1e-4 * (exact + 1.0)) << size << " " << y << " " << z;
                lit += straight > 0.0 ? 1 : 0;
                dark += straight > 0.0 ? 0 : 1;
            }
        }
        EXPECT_GT(lit, 5);
        EXPECT_GT(dark, size < 0.5F ? 5 : 0);
    }
}

TEST(MirrorLight, LampInPiecesAndRoundMirror) {
    // A ball of many small faces far from the mirror's edge: as the point light of its flux.
    Scene scene;
    add_shape(scene, "ball", Sphere{0.02F}, {1, 1.5, 2}, add_material(scene, 0, float(1000.0 / (4 * kPiD * 4e-4))));
    add_rectangle(scene, "mirror", {0, 1.5, 2}, {1, 0, 0}, {0, 0, -1}, 2, 1, add_mirror(scene, Rgb(float(kRho))));
    const Looker s(scene);
    EXPECT_NEAR(s.over_mirrors({4, 1.5, 4}, kWall) / 2.293008438, 1.0, 0.01);
    EXPECT_EQ(s.over_mirrors({4, 1.5, 7.5}, kWall), 0.0);

    // A round mirror is less than its rectangle.
    Scene round;
    Shape shape;
    Polygon outline;
    for (int k = 0; k < 64; ++k) {
        outline.outer.push_back({0.5F * std::cos(float(k) * kPi / 32), 0.5F * std::sin(float(k) * kPi / 32)});
    }
    shape.geometry = outline;
    Node node;
    node.shape = round.shapes.insert(shape);
    node.materials = {add_mirror(round, Rgb(1.0F))};
    round.roots.push_back(round.nodes.insert(node)); // looks along z
    add_point_light(round, {0, 0, 1}, 1000);
    const Looker r(round);
    ASSERT_EQ(r.mirrors.mirrors().mirrors().size(), 1U);
    EXPECT_FALSE(r.mirrors.mirrors().mirrors()[0].fills);
    // Seen from z = 1 the image of a place at distance d is at d / 2 in the mirror.
    for (const double d : {0.0, 0.6, 0.98, 1.02, 1.3}) {
        const dvec3 p(d * std::sqrt(0.5), d * std::sqrt(0.5), 1);
        const double e = 1000.0 / (4.0 * kPiD) * 2.0 / std::pow(4.0 + d * d, 1.5);
        EXPECT_NEAR(r.over_mirrors(p, {0, 0, -1}), d < 1.0 ? e : 0.0, 1e-5 * e) << d;
    }
}

// Straight on through a pane there and back: 0.92307692 each way (FRESNEL, n = 1.5).
TEST(MirrorLight, ThroughAClearPane) {
    Scene scene = plane_mirror();
    add_rectangle(scene, "pane", {0.5, 1.5, 2}, {1, 0, 0}, {0, 0, -1}, 6, 6, add_pane(scene, 1.5F));
    const Looker both(scene);
    EXPECT_NEAR(both.over_mirrors({4, 1.5, 2}, kWall) / 2.864788975654116, 0.92307692 * 0.92307692, 1e-5);
    Scene once = plane_mirror();
    add_rectangle(once, "pane", {2, 1.5, 2}, {1, 0, 0}, {0, 0, -1}, 6, 6, add_pane(once, 1.5F));
    EXPECT_NEAR(Looker(once).over_mirrors({4, 1.5, 2}, kWall) / 2.864788975654116, 0.92307692, 1e-5);
}

// From (4, 4) over (0, 2.4) to the lamp at (1, 2), in x and z.
TEST(MirrorLight, BlockersOnBothWays) {
    const dvec3 p(4, 1.5, 4);
    const struct {
        double x, z;
        bool blocks;
    } boards[] = {{2, 3.2, true},     {0.05, 2.42, true}, {0.5, 2.2, true},
                  {-0.5, 2.2, false}, {2, 2.8, false},    {0.5, 2.5, false}};
    const double open = Looker(plane_mirror()).over_mirrors(p, kWall);
    EXPECT_NEAR(open / 2.293008438103367, 1.0, 1e-5);
    for (const auto& b : boards) {
        Scene scene = plane_mirror();
        add_rectangle(scene, "board", {b.x, 1.5, b.z}, {1, 0, 0}, {0, 0, -1}, 0.02F, 0.1F, add_material(scene, 0.5F));
        EXPECT_EQ(Looker(scene).over_mirrors(p, kWall), b.blocks ? 0.0 : open) << b.x << " " << b.z;
    }
    // Another mirror in the way is a blocker too.
    Scene scene = plane_mirror();
    add_rectangle(scene, "mirror", {2, 1.5, 3.2}, {1, 0, 0}, {0, 0, -1}, 0.2F, 0.2F, add_mirror(scene, Rgb(1.0F), true));
    const Looker two(scene);
    EXPECT_EQ(two.mirrors.mirrors().mirrors().size(), 2U);
    EXPECT_EQ(two.over_mirrors(p, kWall), 0.0);
}

TEST(MirrorLight, OnlyMirroringSidesCount) {
    const dvec3 p(4, 1.5, 4);
    EXPECT_EQ(Looker(plane_mirror(true)).over_mirrors(p, kWall), 0.0);
    const Looker s(plane_mirror(true, true));
    EXPECT_NEAR(s.over_mirrors(p, kWall) / 2.293008438103367, 1.0, 1e-5) << "the back of a double-sided sheet";
    EXPECT_EQ(s.over_mirrors({-3, 1.5, 2}, {1, 0, 0}), 0.0) << "the lamp is on the other side";
    EXPECT_EQ(s.over_mirrors({0, 1.5, 4}, {1, 0, 0}), 0.0) << "in the mirror's own plane";
}

TEST(MirrorLight, TintAndSpot) {
    Scene scene;
    add_rectangle(scene, "mirror", {0, 1.5, 2}, {1, 0, 0}, {0, 0, -1}, 2, 1, add_mirror(scene, {0.9F, 0.5F, 0.2F}));
    Light spot;
    spot.kind = Light::Kind::Spot;
    spot.intensity = 100;
    spot.inner_cone = 0.3F;
    spot.outer_cone = 0.4F;
    Node node;
    node.light = scene.lights.insert(spot);
    node.transform.translation = {1, 1.5, 2};
    node.transform.rotation = glm::angleAxis(kPiD / 2, dvec3(0, 1, 0)); // along -x, into the mirror
    scene.roots.push_back(scene.nodes.insert(node));
    const Looker s(scene);
    const Rgb e = s.mirrored({4, 1.5, 2}, kWall);
    EXPECT_NEAR(e.r, 0.9 * 4.0, 1e-4);
    EXPECT_NEAR(e.g, 0.5 * 4.0, 1e-4);
    EXPECT_NEAR(e.b, 0.2 * 4.0, 1e-4);
    EXPECT_EQ(s.over_mirrors({4, 1.5, 2 + 5 * std::tan(0.41)}, kWall), 0.0);
    EXPECT_GT(s.over_mirrors({4, 1.5, 2 + 5 * std::tan(0.39)}, kWall), 0.0);
}

TEST(MirrorLight, WhichSurfacesAreFlatMirrors) {
    Scene scene;
    const MaterialId mirror = add_mirror(scene, Rgb(1.0F));
    add_shape(scene, "box", Box{vec3(1.0F)}, {0, 0, 0}, mirror);
    add_shape(scene, "ball", Sphere{0.5F}, {3, 0, 0}, mirror);
    add_shape(scene, "tin", Cylinder{0.5F, 1.0F, true}, {6, 0, 0}, mirror);
    add_rectangle(scene, "chip", {9, 0, 0}, {1, 0, 0}, {0, 0, -1}, 0.005F, 0.005F, mirror);
    add_rectangle(scene, "wall", {9, 3, 0}, {1, 0, 0}, {0, 0, -1}, 1, 1, add_material(scene, 0.5F));
    const RayScene rays(scene);
    const PlanarMirrors mirrors(rays);
    EXPECT_EQ(mirrors.mirrors().size(), 8U) << "the sides of the box and the ends of the tin";
    const Hit box = rays.nearest({vec3(dvec3(-5, 0.1, 0.1) - rays.origin()), vec3(1, 0, 0)});
    ASSERT_TRUE(mirrors.is_image_mirror(box));
    EXPECT_NEAR(mirrors.mirrors()[mirrors.mirror_at(box)].height(vec3(dvec3(-5, 0, 0) - rays.origin())), 4.5, 1e-5);
    Hit within = box;
    within.front = false;
    EXPECT_FALSE(mirrors.is_image_mirror(within));
    EXPECT_FALSE(mirrors.is_image_mirror(rays.nearest({vec3(dvec3(3.1, 0.1, 5) - rays.origin()), vec3(0, 0, -1)})));
    for (int k = 0; k < 40; ++k) {
        add_rectangle(scene, "tile", {double(k % 8), 4, double(k / 8)}, {0, 1, 0}, {1, 0, 0}, 0.9F, 0.5F, mirror);
    }
    EXPECT_EQ(PlanarMirrors(RayScene(scene)).mirrors().size(), PlanarMirrors::kMost);
}

TEST(MirrorLight, NoMirrorsNoRays) {
    Scene scene;
    add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, add_material(scene, 0.5F));
    add_rectangle(scene, "lamp", {0, 2, 0}, {0, -1, 0}, {1, 0, 0}, 0.5F, 0.5F, add_material(scene, 0, 1000));
    add_point_light(scene, {1, 2, 0}, 1000);
    add_sun(scene, {-1, -2, 0.2}, 1000, 0.5F);
    const Looker s(scene);
    EXPECT_TRUE(s.mirrors.empty());
    std::uint64_t before = s.rays.rays_traced();
    EXPECT_EQ(s.over_mirrors({0.3, 0, 0}, {0, 1, 0}), 0.0);
    EXPECT_EQ(s.rays.rays_traced(), before);
    EXPECT_GT(s.direct.lamps_irradiance(vec3(0.3F, 0, 0), {0, 1, 0}, 256).irradiance.r, 0.0F);
    EXPECT_EQ(s.rays.rays_traced(), before + 1 + 8) << "one to the lamp, eight that agree to the sun";
    // Nor where the mirror is not where the light is.
    const Looker mirrored(plane_mirror());
    before = mirrored.rays.rays_traced();
    EXPECT_EQ(mirrored.over_mirrors({4, 4.1, 2}, kWall), 0.0);
    EXPECT_EQ(mirrored.rays.rays_traced(), before);
}

// A bright panel gathered by name, straight and over a mirror, and the same panel found by rays.
TEST(MirrorLight, BrightSpotsAreNotGatheredTwice) {
    Scene scene;
    const MaterialId wall = add_material(scene, 0.5F);
    add_room(scene, 4, 2.5F, 3, {wall, wall, add_mirror(scene, Rgb(0.9F)), wall, wall, wall});
    add_rectangle(scene, "panel", {2, 1.2, 1.5}, {-1, 0, 0}, {0, 0, 1}, 1, 1, add_material(scene, 0.5F));
    const RayScene rays(scene);
    const MirrorLight mirrors(rays);
    ASSERT_EQ(mirrors.mirrors().mirrors().size(), 1U);
    Hierarchy h = build_hierarchy(rays, {});
    LeafFlags bright(h.elements.size(), 0);
    for (std::size_t i = 0; i < h.elements.size(); ++i) {
        Element& e = h.elements[i];
        const bool panel = e.leaf() && std::abs(e.area - 1.0F) < 1e-3F;
        const bool metal = e.leaf() && e.kind == Element::Kind::Patch && mirrors.mirrors().mirrors()[0].surface == e.surface;
        bright[i] = panel ? 1 : 0;
        e.radiosity = Rgb(panel ? 50.0F : metal ? 0.0F : 1.0F);
    }
    h.pull_radiosity();
    IndirectSettings many;
    many.rays = many.max_rays = 4096;
    many.bright.tolerance = 1e-4F;
    many.bright.rays = 1024;
    const IndirectGather by_rays(h, rays, LeafFlags(h.elements.size(), 0));
    const IndirectGather by_name(h, rays, bright, {}, Rgb(0.0F), &mirrors);
    const IndirectGather straight(h, rays, bright);
    for (const dvec3& at : {dvec3(3.9, 0, 1.1), dvec3(1.2, 0, 1.1), dvec3(2.5, 0, 0.2)}) {
        const vec3 p(at - rays.origin());
        const FieldSample a = by_rays.irradiance(p, {0, 1, 0}, many);
        const FieldSample b = by_name.irradiance(p, {0, 1, 0}, many);
        const FieldSample c = straight.irradiance(p, {0, 1, 0}, many);
        EXPECT_NEAR(b.irradiance.r, a.irradiance.r, 3.0F * std::sqrt(a.variance + b.variance)) << at.x;
        EXPECT_NEAR(c.irradiance.r, a.irradiance.r, 3.0F * std::sqrt(a.variance + c.variance)) << at.x;
        EXPECT_LE(b.variance, c.variance) << at.x;
        EXPECT_LT(std::sqrt(a.variance), 0.05F * a.irradiance.r) << "or the comparison says little";
    }
}

// The same through the engine: on the wall, at a sensor in the air; and by the particles of the paper.
TEST(MirrorLight, ImagesInSolutions) {
    const Scene scene = plane_mirror();
    Solved s = solve(scene, SolverSettings::Quality::Draft);
    ASSERT_TRUE(s.solution);
    const struct {
        dvec3 at;
        double expected;
    } points[] = {{{4, 1.5, 2}, 2.864788976 + 8.841941283},
                  {{4, 3.5, 2}, 2.293008438 + 5.093266048},
                  {{4, 4.5, 2}, 1000.0 / (4 * kPiD) * 3.0 / std::pow(18.0, 1.5)}};
    for (const auto& p : points) {
        const SensorReading shown = read_surface(scene, *s.solution, p.at, kWall);
        ASSERT_TRUE(shown.on_surface);
        EXPECT_NEAR(luminance(shown.irradiance) / p.expected, 1.0, 0.01) << p.at.y;
        EXPECT_NEAR(luminance(s.engine.gather_free(p.at, kWall).irradiance) / p.expected, 1.0, 1e-4) << p.at.y;
    }
    EXPECT_EQ(s.solution->statistics.particles_stored, 0U);
    EXPECT_NEAR(s.solution->statistics.energy.defect, 0.0, 0.01);

    SolveOptions options;
    options.quality = SolverSettings::Quality::Draft;
    options.paper_mode = true;
    GiEngine engine;
    const auto paper = engine.solve(scene, options, RunContext{});
    ASSERT_TRUE(paper);
    EXPECT_GT((*paper)->statistics.particles_stored, 0U);
    const SensorReading shown = read_surface(scene, **paper, points[1].at, kWall);
    EXPECT_NEAR(luminance(shown.irradiance) / points[1].expected, 1.0, 0.1);
}

// What is held to lie wholly behind the mirror's rectangle is not cut out: all of it must be in sight.
TEST(MirrorSight, HoldsBallsThatAreWhollyInSight) {
    const Looker room(plane_mirror());
    std::mt19937 random(5);
    std::uniform_real_distribution<float> u(-3.0F, 3.0F);
    std::normal_distribution<float> normal;
    const MirrorSight sight(room.rays, room.mirrors.mirrors(), 0, vec3(dvec3(3, 1.5, 2) - room.rays.origin()), {-1, 0, 0});
    ASSERT_TRUE(sight.sees());
    const vec3 mirror(dvec3(0, 1.5, 2) - room.rays.origin());
    int held = 0, missed = 0;
    for (int i = 0; i < 20'000; ++i) {
        const vec3 centre = mirror + vec3(u(random), u(random), u(random));
        const float radius = 0.3F * std::abs(u(random)) / 3.0F;
        const vec3 on = centre + radius * glm::normalize(vec3(normal(random), normal(random), normal(random)));
        if (sight.holds(centre, radius)) {
            ++held;
            EXPECT_TRUE(sight.crosses(on));
            EXPECT_FALSE(sight.misses(centre, radius));
        }
        if (sight.misses(centre, radius)) {
            ++missed;
            EXPECT_FALSE(sight.holds(centre, radius));
        }
    }
    EXPECT_GT(held, 200);
    EXPECT_GT(missed, 1000);
}

} // namespace
} // namespace atrium
