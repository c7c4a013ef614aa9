// The final pass of a still: closed forms, its parts, its way of picking lit places.
#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/view/final_light.h"
#include "engine/view/still.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace test;
using Quality = SolverSettings::Quality;

ViewCamera looking(const dvec3& at, const dvec3& look, float yfov) {
    ViewCamera camera;
    const dvec3 back = -glm::normalize(look);
    const dvec3 right = glm::normalize(glm::cross(std::abs(back.y) > 0.9 ? dvec3(0, 0, 1) : dvec3(0, 1, 0), back));
    camera.to_world[0] = dvec4(right, 0);
    camera.to_world[1] = dvec4(glm::cross(back, right), 0);
    camera.to_world[2] = dvec4(back, 0);
    camera.to_world[3] = dvec4(at, 1);
    camera.lens.yfov = yfov;
    return camera;
}

StillOptions final_picture(int width, int height, int samples) {
    StillOptions out;
    out.width = width;
    out.height = height;
    out.samples_per_axis = 1;
    out.final_pass = true;
    out.final_samples = samples;
    return out;
}

Scene furnace(float rho) {
    Scene scene;
    add_room(scene, 4, 3, 5, add_material(scene, rho, 1.0F));
    return scene;
}

void add_sun(Scene& scene, const dvec3& direction, float lux) {
    Light light;
    light.kind = Light::Kind::Directional;
    light.intensity = lux;
    light.angular_diameter_degrees = 0.0F;
    Node node;
    node.light = scene.lights.insert(light);
    const dvec3 z = -glm::normalize(direction);
    const dvec3 x = glm::normalize(glm::cross(dvec3(0.1, 1, 0.2), z));
    node.transform.rotation = glm::normalize(glm::quat_cast(dmat3(x, glm::cross(z, x), z)));
    scene.roots.push_back(scene.nodes.insert(node));
}

/// A room with a lamp, a mirror, a ball of glass and a rough metal.
Scene mixed_room() {
    Scene scene;
    add_room(scene, 4, 3, 5, add_material(scene, 0.6F));
    add_point_light(scene, {2.0, 2.6, 2.0}, 1500.0);
    Material mirror;
    mirror.base_color = Rgb(0.9F);
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    add_rectangle(scene, "mirror", {2, 1.5, 0.01}, {0, 0, 1}, {1, 0, 0}, 1.0F, 1.0F, scene.materials.insert(mirror));
    mirror.roughness = 0.3F;
    add_rectangle(scene, "metal", {0.7, 1.5, 0.01}, {0, 0, 1}, {1, 0, 0}, 1.0F, 1.0F, scene.materials.insert(mirror));
    Material glass;
    glass.base_color = Rgb(1.0F);
    glass.roughness = 0.0F;
    glass.transmission = 1.0F;
    glass.thickness = 1.0F;
    Shape ball;
    ball.geometry = Sphere{0.4F};
    Node node;
    node.name = "ball";
    node.shape = scene.shapes.insert(ball);
    node.materials = {scene.materials.insert(glass)};
    node.transform.translation = {3.0, 1.0, 1.5};
    scene.roots.push_back(scene.nodes.insert(node));
    return scene;
}

const ViewCamera& room_camera() {
    static const ViewCamera camera = looking({2, 1.5, 4.5}, {0, -0.1, -1}, 1.2F);
    return camera;
}

TEST(FinalStill, AFurnaceIsOneColourAllOver) {
    const Scene scene = furnace(0.6F);
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    const double expected = 1.0 / (1.0 - 0.6) / kPiD; // B / pi
    const Picture picture = render_still(scene, *s.solution, looking({1.7, 1.4, 2.2}, {1, -0.3, 0.3}, 1.4F),
                                         final_picture(24, 18, 64), RunContext{});
    double sum = 0.0;
    for (const vec3& p : picture.pixels) {
        sum += double(luminance(p)) / double(picture.pixels.size());
        EXPECT_NEAR(double(luminance(p)) / expected, 1.0, 0.15); // grain
    }
    EXPECT_NEAR(sum / expected, 1.0, 0.01);
}

TEST(FinalStill, LightOfALampIsExactInEveryPixel) {
    Scene scene;
    const MaterialId black = add_material(scene, 0.0F);
    add_room(scene, 4, 3, 5, {add_material(scene, 0.5F), black, black, black, black, black});
    add_point_light(scene, {2.0, 1.0, 2.0}, 4.0 * kPiD * 100.0); // 100 cd
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    const int n = 15;
    const Picture picture =
        render_still(scene, *s.solution, looking({2.0, 2.0, 2.0}, {0, -1, 0}, 1.0F), final_picture(n, n, 16), RunContext{});
    for (int i = 0; i < n * n; ++i) {
        // The floor 2 m below the eye: means of the lamp's irradiance over each pixel, by its middle.
        const double half = 2.0 * std::tan(0.5);
        const double x = (2.0 * (i % n + 0.5) / n - 1.0) * half;
        const double z = (2.0 * (i / n + 0.5) / n - 1.0) * half;
        const double d2 = 1.0 + x * x + z * z;
        const double expected = 0.5 / kPiD * 100.0 / (d2 * std::sqrt(d2));
        EXPECT_NEAR(double(luminance(picture.pixels[std::size_t(i)])) / expected, 1.0, 0.03);
    }
}

TEST(FinalStill, ShadowsAreSharpWhereLayersAreNot) {
    // A plate 2 m over a large floor in a parallel sun from straight above; its edge is at x = 0. One pixel is 4 mm.
    Scene scene;
    add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 30, 30, add_material(scene, 0.5F));
    Material black;
    black.base_color = Rgb(0.0F);
    black.double_sided = true;
    add_rectangle(scene, "plate", {-0.5, 2.0, 0}, {0, 1, 0}, {1, 0, 0}, 1, 1, scene.materials.insert(black));
    add_sun(scene, {0, -1, 0}, 1000.0F);
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    const ViewCamera camera = looking({0, 1, 0}, {0, -1, 0}, 2.0F * std::atan(0.018F));
    const StillLayers layers = render_layers(scene, *s.solution, camera, final_picture(9, 9, 16), RunContext{});
    for (int x = 0; x < 9; ++x) {
        const double seen = double(luminance(layers.direct.pixels[std::size_t(4 * 9 + x)])) / (0.5 / kPiD * 1000.0);
        // Which way x runs depends on the camera: by the ends, one of which is dark.
        const bool dark_left = luminance(layers.direct.pixels[4 * 9]) < luminance(layers.direct.pixels[4 * 9 + 8]);
        const bool dark = dark_left ? x < 4 : x > 4;
        if (x != 4) {
            EXPECT_NEAR(seen, dark ? 0.0 : 1.0, 1e-3) << x;
        }
    }
}

TEST(FinalStill, PartsAddUpAndTellTheFirstSurface) {
    const Scene scene = mixed_room();
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    for (const bool final_pass : {false, true}) {
        StillOptions options = final_picture(40, 30, 4);
        options.final_pass = final_pass;
        const StillLayers layers = render_layers(scene, *s.solution, room_camera(), options, RunContext{});
        const Picture whole = render_still(scene, *s.solution, room_camera(), options, RunContext{});
        double shares[4] = {0, 0, 0, 0};
        for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
            const Rgb parts[4] = {layers.direct.pixels[i], layers.diffuse.pixels[i], layers.caustic.pixels[i],
                                  layers.specular.pixels[i]};
            const Rgb sum = parts[0] + parts[1] + parts[2] + parts[3];
            for (int c = 0; c < 3; ++c) { // but for the order of adding
                EXPECT_NEAR(sum[c], whole.pixels[i][c], 1e-6F * (1.0F + whole.pixels[i][c]));
            }
            for (int k = 0; k < 4; ++k) {
                shares[k] += double(luminance(parts[k]));
            }
            EXPECT_NEAR(glm::length(layers.normal.pixels[i]), 1.0F, 1e-4F);
            EXPECT_GT(layers.depth[i], 0.5F);
            EXPECT_LT(layers.depth[i], 6.0F);
        }
        for (const double share : shares) {
            EXPECT_GT(share, 0.0);
        }
        // The centre of the picture is the mirror: 4.49 m away, faces the eye, reflects 0.9 and nothing of it is matt.
        const std::size_t centre = 12 * 40 + 20;
        EXPECT_NEAR(layers.depth[centre], 4.49F, 0.1F);
        EXPECT_NEAR(layers.normal.pixels[centre].z, 1.0F, 1e-3F);
        EXPECT_NEAR(luminance(layers.albedo.pixels[centre]), 0.9F, 0.01F);
        EXPECT_EQ(layers.direct.pixels[centre] + layers.diffuse.pixels[centre] + layers.caustic.pixels[centre], Rgb(0.0F));
        const std::vector<PictureChannel> channels = layers.channels();
        ASSERT_EQ(channels.size(), 19U);
        EXPECT_EQ(channels.front().name, "direct.R");
        EXPECT_EQ(channels.back().name, "depth.Z");
        EXPECT_EQ(channels.back().values, layers.depth);
    }
}

TEST(FinalStill, SameBitsForAnyNumberOfThreadsAndOtherGrainForAnotherSeed) {
    const Scene scene = mixed_room();
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    StillOptions options = final_picture(33, 21, 4);
    set_thread_limit(1);
    const Picture one = render_still(scene, *s.solution, room_camera(), options, RunContext{});
    set_thread_limit(3);
    const Picture three = render_still(scene, *s.solution, room_camera(), options, RunContext{});
    set_thread_limit(0);
    EXPECT_EQ(one.pixels, three.pixels);
    options.seed = 2;
    EXPECT_NE(one.pixels, render_still(scene, *s.solution, room_camera(), options, RunContext{}).pixels);
}

TEST(FinalStill, ShowsEverBetterPicturesAndStopsWithTheLast) {
    const Scene scene = mixed_room();
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    RunContext context;
    int shown = 0;
    StillLayers second;
    const StillLayers stopped =
        render_layers(scene, *s.solution, room_camera(), final_picture(24, 18, 64), context, [&](const StillLayers& layers) {
            if (++shown == 2) {
                second = layers;
                context.stop.request_stop();
            }
        });
    EXPECT_EQ(shown, 2);
    EXPECT_EQ(stopped.beauty().pixels, second.beauty().pixels);
    RunContext never;
    never.stop.request_stop();
    const Picture black = render_still(scene, *s.solution, room_camera(), final_picture(24, 18, 64), never);
    ASSERT_EQ(black.pixels.size(), 24U * 18U);
    EXPECT_EQ(black.pixels.front(), vec3(0.0F));
}

TEST(LitPieces, PickedPlacesFillTheHemisphereAndTellTheirDensity) {
    const Scene scene = mixed_room();
    const Solved s = solve(scene, Quality::Draft);
    ASSERT_TRUE(s.solution);
    const LitScene lit(scene, *s.solution);
    const LitPieces pieces(lit, RunContext{});
    ASSERT_GT(pieces.size(), 1000U);
    const vec3 point(dvec3(1.2, 0.001, 3.0) - lit.rays().origin());
    const vec3 normal(0, 1, 0);
    constexpr std::uint32_t kPicks = 20'000;
    double solid_angle = 0.0;
    for (std::uint32_t i = 0; i < kPicks; ++i) {
        LitPieces::Spot spot;
        const vec2 u = sobol_owen2(i, 0, 7U);
        if (!pieces.pick(point, normal, sobol_owen(i, 2, 7U), u, spot)) {
            continue;
        }
        const float told = pieces.density(point, normal, spot.hit, spot.direction, spot.hit.t);
        ASSERT_NEAR(told / spot.density, 1.0F, 1e-3F);
        solid_angle += 1.0 / double(spot.density) / kPicks; // mirrors and glass are not lit: the matt room is all
    }
    EXPECT_NEAR(solid_angle, 2.0 * kPiD, 0.15);
}

} // namespace
} // namespace atrium
