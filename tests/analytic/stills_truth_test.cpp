// Stills of scenes that ship against path traced pictures: every part of the light has to be there.
#include "engine/io/scene_file.h"
#include "engine/measure/compare.h"
#include "engine/reference/reference.h"
#include "engine/solver/gi_engine.h"
#include "engine/view/still.h"
#include "engine/view/tone.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

Picture shown(Picture picture, float exposure) {
    for (Rgb& c : picture.pixels) {
        c = filmic(c * exposure);
    }
    return picture;
}

/// Both ways of drawing are within FLIP 0.05 of the truth, and without any one of the parts named they are not.
void expect_true(const std::string& name, const std::vector<Picture StillLayers::*>& parts, std::uint64_t paths) {
    auto loaded = read_scene(ATRIUM_SOURCE_DIR "/scenes/" + name + "/" + name + ".glb");
    ASSERT_TRUE(loaded);
    const Scene& scene = loaded->scene;
    const auto camera = find_camera(scene, "");
    ASSERT_TRUE(camera);
    GiEngine engine;
    SolveOptions solve;
    const auto solution = engine.solve(scene, solve, RunContext{});
    ASSERT_TRUE(solution);
    const int width = 40;
    const int height = 22;
    ReferenceSettings settings;
    settings.paths = paths;
    const auto truth = reference_picture(scene, {camera->to_world, camera->lens, width, height}, settings, RunContext{});
    ASSERT_TRUE(truth);
    const float exposure = exposure_scale((*solution)->mean_radiance, 0.0F);
    const Picture seen = shown(truth->radiance, exposure);
    StillOptions options;
    options.width = width;
    options.height = height;
    options.samples_per_axis = 4;
    options.final_samples = 64;
    for (const bool final_pass : {false, true}) {
        options.final_pass = final_pass;
        StillLayers layers = render_layers(scene, **solution, *camera, options, RunContext{});
        EXPECT_LE(flip(shown(layers.beauty(), exposure), seen), 0.05) << name << (final_pass ? " final" : " fast");
        for (const auto part : parts) {
            StillLayers less = layers;
            (less.*part).pixels.assign((less.*part).pixels.size(), vec3(0.0F));
            EXPECT_GT(flip(shown(less.beauty(), exposure), seen), 1.5 * flip(shown(layers.beauty(), exposure), seen))
                << name << (final_pass ? " final" : " fast") << ": nobody would miss a part";
        }
    }
}

TEST(StillsTruth, Ring) {
    expect_true("ring", {&StillLayers::direct, &StillLayers::diffuse, &StillLayers::caustic, &StillLayers::specular}, 512);
}

TEST(StillsTruth, GlassBall) {
    expect_true("glass-ball", {&StillLayers::direct, &StillLayers::caustic, &StillLayers::specular}, 512);
}

TEST(StillsTruth, SunMirror) { expect_true("sun-mirror", {&StillLayers::direct, &StillLayers::diffuse}, 2048); }

} // namespace
} // namespace atrium
