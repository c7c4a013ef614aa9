// Narrow openings before large lamps are found and looked through by their own area.
#include "engine/geometry/form_factor.h"
#include "engine/radiosity/lamp_slits.h"
#include "engine/radiosity/light_split.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace test;

constexpr float kExitance = 1000.0F * kPi;

/// A shining floor of 4 m x 4 m half a metre below a black screen with an opening of `width` x 1 m in its middle, and a
/// small receiver a metre above that.
Scene slit_scene(float width, float exitance = kExitance) {
    Scene scene;
    const MaterialId black = add_material(scene, 0.0F);
    add_rectangle(scene, "glow", {0, -0.5, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, add_material(scene, 0.0F, exitance));
    for (const float side : {-1.0F, 1.0F}) {
        add_rectangle(scene, "screen", {side * (0.5F * width + 1.0F), 0, 0}, {0, 1, 0}, {1, 0, 0}, 2, 4, black);
        add_rectangle(scene, "end", {0, 0, side * 1.25F}, {0, 1, 0}, {1, 0, 0}, width, 1.5F, black);
    }
    add_rectangle(scene, "receiver", {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, 0.2F, 0.2F, black);
    return scene;
}

std::vector<SkyWindow> slits_of(const Scene& scene) {
    const RayScene rays(scene);
    const Hierarchy h = build_hierarchy(rays, {});
    return find_lamp_slits(rays, only_flagged(h, LeafFlags(h.elements.size(), 1), true));
}

double through_slit(float width, const vec3& point) {
    const float w = 0.5F * width;
    const std::array<vec3, 4> corners{vec3(-w, 0, -0.5F), vec3(w, 0, -0.5F), vec3(w, 0, 0.5F), vec3(-w, 0, 0.5F)};
    return kExitance * form_factor_to_polygon(point, {0, -1, 0}, corners);
}

TEST(LampSlits, LightThroughThemIsThatOfTheirArea) {
    for (const float width : {2e-4F, 1e-3F, 5e-3F, 0.02F}) {
        const Scene scene = slit_scene(width);
        const Solved s = solve(scene, SolverSettings::Quality::Draft);
        ASSERT_TRUE(s.solution);
        for (const vec3& p : {vec3(0, 1, 0), vec3(0.05F, 1, -0.07F)}) {
            const double lux = luminance(read_surface(scene, *s.solution, dvec3(p), {0, -1, 0}).irradiance);
            EXPECT_NEAR(lux / through_slit(width, p), 1.0, 0.02) << width << " m at " << p.x;
        }
        // The light of the whole slit, far off to the side: seen at an angle.
        const vec3 aside(1.5F, 0.5F, 0.2F);
        EXPECT_NEAR(luminance(s.engine.gather_free(dvec3(aside), {0, -1, 0}).irradiance) / through_slit(width, aside), 1.0,
                    0.05)
            << width;
    }
}

TEST(LampSlits, TheSlitIsFoundAndIsAsLargeAsItIs) {
    const std::vector<SkyWindow> slits = slits_of(slit_scene(1e-3F));
    ASSERT_EQ(slits.size(), 1U);
    float least = 1e9F, most = 0.0F;
    for (std::size_t k = 0; k < 4; ++k) {
        const float edge = glm::length(slits[0].corners[k] - slits[0].corners[(k + 1) % 4]);
        least = std::min(least, edge);
        most = std::max(most, edge);
    }
    EXPECT_NEAR(least, 1e-3F, 1e-5F);
    EXPECT_NEAR(most, 1.0F, 1e-3F) << "its ends are shut by what lies in it";
}

TEST(LampSlits, OrdinaryRoomsHaveNone) {
    Scene scene;
    const MaterialId grey = add_material(scene, 0.5F);
    add_room(scene, 4, 3, 5, grey);
    add_rectangle(scene, "lamp", {2, 2.99, 2.5}, {0, -1, 0}, {1, 0, 0}, 1, 1, add_material(scene, 0.0F, 5000.0F));
    for (int i = 0; i < 4; ++i) { // boards side by side, a millimetre apart, on a table top
        add_rectangle(scene, "board", {1.0 + 0.301 * i, 0.8, 2}, {0, 1, 0}, {1, 0, 0}, 0.3F, 1.0F, grey);
    }
    add_rectangle(scene, "top", {1.5, 0.795, 2}, {0, 1, 0}, {1, 0, 0}, 2, 2, grey);
    EXPECT_TRUE(slits_of(scene).empty()) << "shut behind";
    EXPECT_TRUE(slits_of(slit_scene(1e-3F, 0.0F)).empty()) << "no lamp";
}

// Boards with gaps between them over an open table: what lies below sees the lamp past their ends too.
TEST(LampSlits, AreOfNoUseWhereTheLampIsSeenAnyway) {
    Scene scene;
    const MaterialId grey = add_material(scene, 0.5F);
    add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4, 4, grey);
    add_rectangle(scene, "lamp", {0, 3, 0}, {0, -1, 0}, {1, 0, 0}, 3, 3, add_material(scene, 0.0F, 5000.0F));
    for (const double side : {-1.0, 1.0}) {
        add_rectangle(scene, "slat", {side * 0.0255, 1.5, 0}, {0, 1, 0}, {1, 0, 0}, 0.05F, 1.0F, grey);
    }
    EXPECT_TRUE(slits_of(scene).empty());
}

} // namespace
} // namespace atrium
