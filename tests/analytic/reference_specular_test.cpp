// The reference over mirrors and glass: caustics of the validation set, and energy.
#include "engine/base/parallel.h"
#include "engine/geometry/tessellate.h"
#include "engine/reference/reference.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using test::add_material;
using test::add_point_light;
using test::add_rectangle;

MaterialId add_mirror(Scene& scene, float rho, float roughness = 0.0F) {
    Material m;
    m.base_color = Rgb(rho);
    m.metallic = 1.0F;
    m.roughness = roughness;
    return scene.materials.insert(m);
}

MaterialId add_glass(Scene& scene, float ior, float thickness = 1.0F) {
    Material m;
    m.base_color = Rgb(1.0F);
    m.transmission = 1.0F;
    m.roughness = 0.0F;
    m.thickness = thickness;
    m.ior = ior;
    return scene.materials.insert(m);
}

void add_shape(Scene& scene, const Geometry& geometry, const dvec3& at, MaterialId material) {
    Shape shape;
    shape.geometry = geometry;
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = {material};
    node.transform.translation = at;
    scene.roots.push_back(scene.nodes.insert(node));
}

Mesh fine_ball(float radius, int segments) { return {tessellate(Sphere{radius}, TessellationOptions{segments})}; }

/// A parallel beam along `direction`, lux across it.
void add_beam(Scene& scene, const dvec3& direction, float lux, float diameter = 0.0F) {
    Light sun;
    sun.kind = Light::Kind::Directional;
    sun.intensity = lux;
    sun.angular_diameter_degrees = diameter;
    const dvec3 z = -glm::normalize(direction);
    const dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), z));
    Node node;
    node.light = scene.lights.insert(sun);
    node.transform.rotation = glm::normalize(glm::quat_cast(dmat3(x, glm::cross(z, x), z)));
    scene.roots.push_back(scene.nodes.insert(node));
}

ReferenceCaustics caustics(const Scene& scene, const ReferenceRectangle& rectangle, std::size_t nx, std::size_t ny,
                           std::uint64_t particles) {
    CausticReferenceSettings settings;
    settings.particles = particles;
    auto out = reference_caustics(scene, rectangle, nx, ny, settings, RunContext{});
    EXPECT_TRUE(out);
    return out ? *out : ReferenceCaustics{};
}

ReferenceReadings measured(const Scene& scene, const std::vector<ReferencePoint>& points, std::uint64_t paths,
                           float radius) {
    ReferenceSettings settings;
    settings.paths = paths;
    settings.caustic_radius = radius;
    auto out = reference_irradiance(scene, points, settings, RunContext{});
    EXPECT_TRUE(out);
    return out ? *out : ReferenceReadings{};
}

/// CAUSTIC-PLANE-MIRROR; the case's z is our y and its y our z.
Scene plane_mirror() {
    Scene scene;
    add_rectangle(scene, "mirror", {0, 1.5, 2}, {1, 0, 0}, {0, 0, 1}, 2, 1, add_mirror(scene, 0.9F));
    add_rectangle(scene, "wall", {4, 1.5, 2}, {-1, 0, 0}, {0, 0, 1}, 30, 20, add_material(scene, 0.0F));
    add_point_light(scene, {1, 1.5, 2}, 1000.0);
    return scene;
}

TEST(ReferenceSpecular, PlaneMirrorThrowsItsRectangle) {
    const Scene scene = plane_mirror();
    const ReferenceCaustics whole = caustics(scene, {{4, -1, -3}, {0, 0, 10}, {0, 5, 0}, {-1, 0, 0}}, 1, 1, 1U << 19U);
    const double flux = 50.0 * luminance(whole.irradiance[0]);
    EXPECT_NEAR(flux, 92.17474411461005, 50.0 * 4.0 * whole.standard_error[0] + 0.01);
    EXPECT_LT(50.0 * whole.standard_error[0], 0.5);
    const struct {
        double y, z, mirror, direct;
    } places[] = {{1.5, 2, 2.864788975654116, 8.841941282883075},
                  {1.5, 4, 2.293008438103367, 5.0932660478820875},
                  {3.5, 2, 2.293008438103367, 5.0932660478820875},
                  {1.5, 6.9, 1.0436997897602942, 1.2587604940318646},
                  {1.5, 7.1, 0.0, 1.1524530047078339},
                  {4.1, 2, 0.0, 3.81572503066561}};
    std::vector<ReferencePoint> points;
    for (const auto& p : places) {
        points.push_back({{4, p.y, p.z}, {-1, 0, 0}});
    }
    const ReferenceReadings r = measured(scene, points, 2048, 0.08F);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& p = places[i];
        EXPECT_NEAR(luminance(r.points[i].irradiance), p.mirror + p.direct, 4.0 * r.points[i].standard_error + 0.002) << i;
        EXPECT_LT(r.points[i].standard_error, 0.15);
        const ReferenceRectangle about{{4, p.y - 0.09, p.z - 0.09}, {0, 0, 0.18}, {0, 0.18, 0}, {-1, 0, 0}};
        const ReferenceCaustics texel = caustics(scene, about, 1, 1, 1U << 19U);
        EXPECT_NEAR(luminance(texel.irradiance[0]), p.mirror, 4.0 * texel.standard_error[0] + 0.002) << i;
    }
}

TEST(ReferenceSpecular, NephroidOfACylindricalMirror) {
    Scene scene;
    auto arc = std::make_shared<MeshData>();
    constexpr int kFacets = 720;
    for (int i = 0; i <= kFacets; ++i) {
        const float phi = float(radians_from_degrees(-60.0 + 120.0 * i / kFacets));
        for (const float y : {0.0F, 1.0F}) {
            arc->positions.emplace_back(std::cos(phi), y, std::sin(phi));
            arc->normals.emplace_back(-std::cos(phi), 0.0F, -std::sin(phi));
        }
    }
    for (unsigned i = 0; i < kFacets; ++i) {
        for (const unsigned k : {0U, 3U, 1U, 0U, 2U, 3U}) { // front to the axis
            arc->indices.push_back(2 * i + k);
        }
    }
    arc->parts = {{0, std::uint32_t(arc->indices.size())}};
    add_shape(scene, Mesh{arc}, {0, 0, 0}, add_mirror(scene, 1.0F));
    add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, add_material(scene, 0.0F));
    add_beam(scene, {1, -1, 0}, 1000.0F);
    // Mean gain over texels: rows along x from 0, columns along the case's y from -0.5, both in steps of 1/8.
    const double gain[8][8] = {{0.0, 0.0074, 0.5348, 1.0566, 1.0566, 0.5348, 0.0074, 0.0},
                               {0.0, 0.4252, 1.1735, 1.5249, 1.5249, 1.1735, 0.4252, 0.0},
                               {0.0, 0.7754, 1.3427, 2.2941, 2.2941, 1.3427, 0.7754, 0.0},
                               {0.0, 0.789, 1.2863, 3.7943, 3.7943, 1.2863, 0.789, 0.0},
                               {0.0, 0.5724, 0.9895, 6.4242, 6.4242, 0.9895, 0.5724, 0.0},
                               {2.1184, 2.7457, 4.6353, 5.8871, 5.8871, 4.6353, 2.7457, 2.1184},
                               {1.3693, 2.0139, 2.7222, 2.8642, 2.8642, 2.7222, 2.0139, 1.3693},
                               {0.1992, 0.6481, 1.0572, 1.7019, 1.7019, 1.0572, 0.6481, 0.1992}};
    const ReferenceRectangle floor{{0, 0, -0.5}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
    const ReferenceCaustics r = caustics(scene, floor, 8, 8, 1U << 21U);
    const double unit = 1000.0 * std::sqrt(0.5);
    for (std::size_t x = 0; x < 8; ++x) {
        for (std::size_t y = 0; y < 8; ++y) {
            const double found = luminance(r.irradiance[y * 8 + x]) / unit;
            const double error = r.standard_error[y * 8 + x] / unit;
            EXPECT_NEAR(found, gain[x][y], 4.0 * error + 0.005 * gain[x][y] + 0.001) << x << " " << y;
            EXPECT_LT(error, 0.05);
        }
    }
    const ReferenceRectangle all{{-2, 0, -2}, {4, 0, 0}, {0, 0, 4}, {0, 1, 0}};
    const ReferenceCaustics flux = caustics(scene, all, 1, 1, 1U << 19U);
    EXPECT_NEAR(16.0 * luminance(flux.irradiance[0]), 1000.0 * 1.2247448713915892, 64.0 * flux.standard_error[0] + 0.5);
}

TEST(ReferenceSpecular, GlassBallGathersParallelLight) {
    // What lands in a square about the focus: exact rays of CAUSTIC-BALL-AXIS, first order, by their impact height.
    const double n = 1.5;
    Scene scene;
    add_shape(scene, fine_ball(1.0F, 256), {0, 0, 0}, add_glass(scene, float(n)));
    add_rectangle(scene, "screen", {1.5, 0, 0}, {-1, 0, 0}, {0, 0, 1}, 6, 6, add_material(scene, 0.0F));
    add_beam(scene, {1, 0, 0}, 1000.0F);
    for (const double half : {0.05, 0.2, 0.5}) {
        double expected = 0.0;
        constexpr int kSteps = 2000;
        for (int i = 0; i < kSteps; ++i) {
            const double h2 = (i + 0.5) / kSteps;
            const double h = std::sqrt(h2);
            const double turn = 2.0 * (std::asin(h) - std::asin(h / n));
            const double at = std::abs((1.5 - h / std::sin(turn)) * std::tan(turn)); // from the axis, on the screen
            const double inside = std::acos(std::min(half / at, 1.0)); // azimuth from which a circle leaves the square
            const double share = at <= half ? 1.0 : std::max(1.0 - 8.0 * inside / (2.0 * kPiD), 0.0);
            const double ci = std::sqrt(1.0 - h2), ct = std::sqrt(1.0 - h2 / (n * n));
            const double rs = (ci - n * ct) / (ci + n * ct), rp = (n * ci - ct) / (n * ci + ct);
            const double f = 0.5 * (rs * rs + rp * rp);
            if (turn < 0.5 * kPiD) {
                expected += 1000.0 * kPiD / kSteps * share * (1.0 - f) * (1.0 - f);
            }
        }
        const ReferenceRectangle square{{1.5, -half, -half}, {0, 0, 2 * half}, {0, 2 * half, 0}, {-1, 0, 0}};
        const ReferenceCaustics r = caustics(scene, square, 1, 1, 1U << 19U);
        const double area = 4.0 * half * half;
        EXPECT_LT(area * r.standard_error[0], 0.005 * expected);
        // Light that was reflected twice within comes on top: below 0.3 %.
        EXPECT_NEAR(area * luminance(r.irradiance[0]) / expected, 1.0, 4.0 * area * r.standard_error[0] / expected + 0.006)
            << half;
    }
}

/// All that a lamp sends to a lossless ball comes to the walls.
TEST(ReferenceSpecular, WhatMeetsALosslessBallLands) {
    for (const bool glass : {true, false}) {
        Scene scene;
        test::add_room(scene, 4, 3, 4, add_material(scene, 0.0F));
        add_shape(scene, fine_ball(0.5F, 128), {2, 1, 2}, glass ? add_glass(scene, 1.5F) : add_mirror(scene, 1.0F));
        add_point_light(scene, {0.8, 2, 1.6}, 1000.0);
        const ReferenceRectangle walls[] = {
            {{0, 0, 0}, {4, 0, 0}, {0, 0, 4}, {0, 1, 0}}, {{0, 3, 0}, {4, 0, 0}, {0, 0, 4}, {0, -1, 0}},
            {{0, 0, 0}, {0, 3, 0}, {0, 0, 4}, {1, 0, 0}}, {{4, 0, 0}, {0, 3, 0}, {0, 0, 4}, {-1, 0, 0}},
            {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 0, 1}}, {{0, 0, 4}, {4, 0, 0}, {0, 3, 0}, {0, 0, -1}}};
        double flux = 0.0;
        double variance = 0.0;
        for (const ReferenceRectangle& wall : walls) {
            const double area = glm::length(glm::cross(wall.u, wall.v));
            const ReferenceCaustics r = caustics(scene, wall, 1, 1, 1U << 17U);
            flux += area * luminance(r.irradiance[0]);
            variance += area * area * r.standard_error[0] * r.standard_error[0];
        }
        const double distance2 = 1.2 * 1.2 + 1.0 + 0.4 * 0.4;
        const double expected = 500.0 * (1.0 - std::sqrt(1.0 - 0.25 / distance2));
        EXPECT_LT(std::sqrt(variance), 0.01 * expected);
        EXPECT_NEAR(flux, expected, 4.0 * std::sqrt(variance) + 0.002 * expected) << glass; // 0.2 %: facets
    }
}

/// The same over all bounces: what a lamp sends into a room with a mirror ball is absorbed by its walls.
TEST(ReferenceSpecular, EnergyOfARoomWithAMirrorBall) {
    Scene scene;
    test::add_room(scene, 3, 2, 4, add_material(scene, 0.6F));
    add_shape(scene, fine_ball(0.6F, 64), {1.8, 1, 1.7}, add_mirror(scene, 1.0F));
    add_point_light(scene, {0.6, 1.4, 2.4}, 1000.0);
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
            weight.push_back(0.4 * glm::length(glm::cross(u[face], v[face])) / (kSide * kSide));
        }
    }
    const ReferenceReadings r = measured(scene, points, 256, 0.07F);
    double absorbed = 0.0;
    double variance = 0.0; // of independent points: particles cross many discs, so a little too small
    for (std::size_t i = 0; i < points.size(); ++i) {
        absorbed += weight[i] * luminance(r.points[i].irradiance);
        variance += weight[i] * weight[i] * r.points[i].standard_error * r.points[i].standard_error;
    }
    EXPECT_LE(std::sqrt(variance), 2.0);
    EXPECT_NEAR(absorbed, 1000.0, 4.0 * std::sqrt(variance) + 3.0);
}

Scene furnace_with_balls() {
    Scene scene;
    test::add_room(scene, 2, 3, 4, add_material(scene, 0.5F, 100.0F));
    add_shape(scene, Sphere{0.5F}, {1, 0.7, 1.2}, add_glass(scene, 1.5F));
    add_shape(scene, Sphere{0.4F}, {1, 1.8, 2.6}, add_mirror(scene, 1.0F));
    add_rectangle(scene, "pane", {1, 1.5, 3.4}, {0, 0, -1}, {1, 0, 0}, 1.5F, 2, add_glass(scene, 1.5F, 0.0F));
    add_shape(scene, Box{{1.2F, 0.02F, 0.8F}}, {1, 2.6, 1}, add_glass(scene, 1.5F, 0.02F));
    return scene;
}

TEST(ReferenceSpecular, FurnaceWithGlassAndMirrorsStaysEven) {
    const ReferenceReadings r = measured(furnace_with_balls(),
                                         {{{1, 0, 2}, {0, 1, 0}},
                                          {{1, 0, 1.2}, {0, 1, 0}},
                                          {{0, 1, 1.3}, {1, 0, 0}},
                                          {{1, 1.5, 4}, {0, 0, -1}},
                                          {{1, 2.9, 1}, {0.6, -0.8, 0.0}}},
                                         16384, 0.0F);
    for (const ReferenceReading& reading : r.points) {
        EXPECT_LE(reading.standard_error, 3.0);
        EXPECT_NEAR(luminance(reading.irradiance), 200.0, 4.0 * reading.standard_error);
    }
}

TEST(ReferenceSpecular, PictureOfThatFurnaceIsEvenToo) {
    ReferenceView view;
    view.to_world[3] = {1, 1.2, 3.9, 1};
    view.width = 16;
    view.height = 9;
    ReferenceSettings settings;
    settings.paths = 128;
    const auto r = reference_picture(furnace_with_balls(), view, settings, RunContext{});
    ASSERT_TRUE(r);
    double mean = 0.0;
    for (std::size_t i = 0; i < 144; ++i) {
        mean += luminance(r->radiance.pixels[i]) / 144.0;
        EXPECT_NEAR(luminance(r->radiance.pixels[i]) / (200.0 / kPiD), 1.0, 0.3) << i;
    }
    EXPECT_NEAR(mean, 200.0 / kPiD, 0.5);
}

TEST(ReferenceSpecular, SmallLampsAreFoundOverMirrorsAsLargeOnesAre) {
    // The lit place of a plane mirror once more, from a lamp of 4 cm in place of a point: by particles; and a screen whose
    // other light comes from a large panel over the mirror, by paths. Both against the mirror's image by form factors.
    Scene scene;
    add_rectangle(scene, "mirror", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 2.6F, 2.6F, add_mirror(scene, 0.8F));
    add_rectangle(scene, "screen", {0, 2, 0}, {0, -1, 0}, {1, 0, 0}, 0.2F, 0.2F, add_material(scene, 0.0F));
    const auto lit = [&](float side) {
        Scene with = scene;
        const float exitance = 1000.0F / (side * side);
        add_rectangle(with, "lamp", {0, 1.9, 1.2}, {0, -1, 0}, {1, 0, 0}, side, side, add_material(with, 0.0F, exitance));
        const ReferenceReadings r = measured(with, {{{0, 2, 0}, {0, -1, 0}}}, 16384, 0.05F);
        return r.points[0];
    };
    const double d2 = 3.9 * 3.9 + 1.2 * 1.2; // to the image, 1.9 m below the mirror
    const double expected = 0.8 * 1000.0 / kPiD * 3.9 * 3.9 / (d2 * d2);
    for (const float side : {0.04F, 0.6F}) {
        const ReferenceReading r = lit(side);
        EXPECT_LT(r.standard_error, 0.06 * expected) << side;
        EXPECT_NEAR(luminance(r.irradiance), expected, 4.0 * r.standard_error + 0.01 * expected) << side;
    }
}

TEST(ReferenceSpecular, SameBitsForAnyNumberOfThreads) {
    const Scene scene = plane_mirror();
    std::vector<ReferenceReadings> readings;
    std::vector<ReferenceCaustics> texels;
    for (const unsigned threads : {1U, 3U, 8U}) {
        set_thread_limit(threads);
        readings.push_back(measured(scene, {{{4, 1.5, 2}, {-1, 0, 0}}}, 512, 0.1F));
        texels.push_back(caustics(scene, {{4, -1, -3}, {0, 0, 10}, {0, 5, 0}, {-1, 0, 0}}, 5, 3, 1U << 15U));
    }
    set_thread_limit(0);
    for (std::size_t i = 1; i < readings.size(); ++i) {
        EXPECT_EQ(readings[i].points[0].irradiance, readings[0].points[0].irradiance);
        EXPECT_EQ(readings[i].points[0].standard_error, readings[0].points[0].standard_error);
        EXPECT_EQ(texels[i].irradiance, texels[0].irradiance);
        EXPECT_EQ(texels[i].standard_error, texels[0].standard_error);
    }
}

TEST(ReferenceSpecular, CausticsSayWhatIsMissing) {
    const Scene scene = plane_mirror();
    const ReferenceRectangle wall{{4, -1, -3}, {0, 0, 10}, {0, 5, 0}, {-1, 0, 0}};
    EXPECT_FALSE(reference_caustics(scene, wall, 1, 1, CausticReferenceSettings{}, RunContext{}));
    CausticReferenceSettings settings;
    settings.particles = 1000;
    EXPECT_FALSE(reference_caustics(scene, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 1, 1, settings, RunContext{})) << "no area";
    RunContext context;
    context.stop.request_stop();
    EXPECT_FALSE(reference_caustics(scene, wall, 1, 1, settings, context));
    Scene matt;
    add_rectangle(matt, "wall", {4, 1.5, 2}, {-1, 0, 0}, {0, 0, 1}, 30, 20, add_material(matt, 0.5F));
    add_point_light(matt, {1, 1.5, 2}, 1000.0);
    EXPECT_EQ(caustics(matt, wall, 1, 1, 1000).irradiance[0], Rgb(0.0F)) << "nothing that mirrors";
}

} // namespace
} // namespace atrium
