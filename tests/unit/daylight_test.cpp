#include "engine/scene/daylight.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

TEST(Daylight, IsMissingUntilSomethingEmits) {
    Scene scene;
    const MaterialId white = test::add_material(scene, 0.8F);
    const NodeId floor = test::add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, white);
    EXPECT_TRUE(has_no_light(scene));
    scene.materials.find(white)->emissive_color = Rgb(1.0F);
    scene.materials.find(white)->emissive_strength = 100.0F;
    EXPECT_FALSE(has_no_light(scene));
    scene.nodes.find(floor)->visible = false;
    EXPECT_TRUE(has_no_light(scene)) << "a hidden lamp gives no light";
}

TEST(Daylight, AddsSunAndSkyAndUndoes) {
    Scene scene;
    test::add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, test::add_material(scene, 0.5F));
    const Scene before = scene;
    const auto undo = apply(scene, add_daylight(scene));
    ASSERT_TRUE(undo) << undo.error().message();
    EXPECT_FALSE(has_no_light(scene));
    // On an open horizontal plane: sun 40,000 lx at 30 degrees, tinted, and pi times the sky's luminance.
    const auto solved = test::solve(scene, SolverSettings::Quality::Draft);
    const double sun = 40000.0 * 0.5 * luminance({1.0F, 0.94F, 0.84F});
    const double sky = kPiD * luminance({2700.0F, 3000.0F, 3400.0F});
    EXPECT_NEAR(test::mean_irradiance(scene, *solved.solution) / (sun + sky), 1.0, 0.02);
    ASSERT_TRUE(apply(scene, *undo));
    EXPECT_EQ(scene, before);
}

} // namespace
} // namespace atrium
