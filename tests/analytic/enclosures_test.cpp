// Closed enclosures whose light is known: the numbers are derived here or named from shared/validation.
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace test;

// ENC-FURNACE: every surface emits M and reflects rho, so B = M + rho B everywhere: B = M / (1 - rho), E = B.
class Furnace : public testing::TestWithParam<float> {};

TEST_P(Furnace, RadiosityIsEmissionOverOneMinusReflectance) {
    const float rho = GetParam();
    Scene scene;
    add_room(scene, 4.0F, 3.0F, 5.0F, add_material(scene, rho, 1.0F));
    const Solved s = solve(scene);
    ASSERT_TRUE(s.solution);
    EXPECT_TRUE(s.solution->statistics.converged);
    const double expected = 1.0 / (1.0 - double(rho));
    std::size_t vertices = 0;
    double worst = 0.0;
    for (const auto& layer : s.solution->surfaces) {
        for (std::size_t i = 0; i < layer->irradiance_front.size(); ++i) {
            worst = std::max(worst, std::abs(luminance(light_on(*layer, i)) / expected - 1.0));
            ++vertices;
        }
    }
    EXPECT_GT(vertices, 100U);
    EXPECT_LT(worst, 0.03);
    EXPECT_NEAR(mean_irradiance(scene, *s.solution) / expected, 1.0, 0.01);
    EXPECT_NEAR(s.solution->statistics.energy.defect, 0.0, 0.01);
    std::printf("furnace rho %.3f: mean E / B = %.5f, %d sweeps\n", double(rho),
                mean_irradiance(scene, *s.solution) / expected, s.solution->statistics.iterations);
}
INSTANTIATE_TEST_SUITE_P(Reflectances, Furnace, testing::Values(0.0F, 0.2F, 0.5F, 0.8F, 0.9F, 0.95F, 0.99F, 0.999F));

// CIE 171:2006 5.3: black room 4 x 4 x 3 m, 1 m2 Lambertian source of 1000 cd/m2 in the ceiling's centre.
// The CIE's z is our y, its y our z.
struct Probe {
    const char* name;
    dvec3 point;
    dvec3 normal;
    double direct;
    double total; ///< ENC-ROOM-543
};
const Probe kProbes[] = {
    {"wall A", {2, 2.75, 0}, {0, 0, 1}, 32.67689801, 60.9373},   {"wall B", {2, 2.25, 0}, {0, 0, 1}, 75.19392457, 104.7082},
    {"wall C", {2, 1.75, 0}, {0, 0, 1}, 81.32317212, 111.4073},  {"wall D", {2, 1.25, 0}, {0, 0, 1}, 69.06062701, 99.0924},
    {"wall E", {2, 0.75, 0}, {0, 0, 1}, 53.40353111, 82.6749},   {"wall F", {2, 0.25, 0}, {0, 0, 1}, 40.00185202, 67.4869},
    {"floor G", {2, 0, 0.25}, {0, 1, 0}, 61.42409854, 93.9781},  {"floor H", {2, 0, 0.75}, {0, 1, 0}, 79.25515732, 112.6108},
    {"floor I", {2, 0, 1.25}, {0, 1, 0}, 95.66727633, 128.8298}, {"floor J", {2, 0, 1.75}, {0, 1, 0}, 105.7782422, 138.7656},
    {"floor x1 z1", {1, 0, 1}, {0, 1, 0}, 73.3507302, 106.2131}, {"floor x1 z2", {1, 0, 2}, {0, 1, 0}, 87.9305278, 121.2139},
    {"wall z0 x1", {1, 1.5, 0}, {0, 0, 1}, 57.219692, 87.7549},  {"wall x0 z2", {0, 1.5, 2}, {1, 0, 0}, 76.2940195, 106.436},
};

Scene area_source_room(float floor, float ceiling, float wall) {
    Scene scene;
    const MaterialId w = add_material(scene, wall);
    const MaterialId f = add_material(scene, floor);
    const MaterialId c = add_material(scene, ceiling);
    add_room(scene, 4, 3, 4, {f, c, w, w, w, w});
    // The lamp hangs flush with the ceiling: coplanar, as in the case, and must still shine.
    add_rectangle(scene, "source", {2, 3, 2}, {0, -1, 0}, {1, 0, 0}, 1, 1, add_material(scene, ceiling, 1000.0F * kPi));
    return scene;
}

TEST(Cie171, AreaSourceInBlackRoom53) {
    const Scene scene = area_source_room(0, 0, 0);
    const Solved s = solve(scene);
    ASSERT_TRUE(s.solution);
    double worst = 0.0;
    for (const Probe& p : kProbes) {
        const SensorReading on = read_surface(scene, *s.solution, p.point, p.normal);
        ASSERT_TRUE(on.on_surface) << p.name;
        EXPECT_NEAR(luminance(on.irradiance) / p.direct, 1.0, 0.03) << p.name;
        EXPECT_NEAR(luminance(s.engine.gather_free(p.point, p.normal).irradiance) / p.direct, 1.0, 0.01) << p.name;
        worst = std::max(worst, std::abs(luminance(on.irradiance) / p.direct - 1.0));
    }
    std::printf("CIE 171 5.3: worst point off by %.2f %%\n", 100 * worst);
}

TEST(EncRoom543, AreaSourceInReflectingRoom) {
    const Scene scene = area_source_room(0.2F, 0.7F, 0.5F);
    const Solved s = solve(scene);
    ASSERT_TRUE(s.solution);
    double worst = 0.0;
    for (const Probe& p : kProbes) {
        const SensorReading on = read_surface(scene, *s.solution, p.point, p.normal);
        ASSERT_TRUE(on.on_surface) << p.name;
        EXPECT_NEAR(luminance(on.irradiance) / p.total, 1.0, 0.03) << p.name;
        worst = std::max(worst, std::abs(luminance(on.irradiance) / p.total - 1.0));
    }
    std::printf("ENC-ROOM-543: worst point off by %.2f %%, energy defect %.4f\n", 100 * worst,
                s.solution->statistics.energy.defect);
    EXPECT_NEAR(s.solution->statistics.energy.defect, 0.0, 0.02);
}

// CIE 171 5.4: 10,000 lm in the centre of a black room 4 x 4 x 3 m: flux on each face in closed form.
TEST(Cie171, FluxConservation54) {
    Scene scene;
    add_room(scene, 4, 3, 4, add_material(scene, 0));
    add_point_light(scene, {2, 1.5, 2}, 10000);
    const Solved s = solve(scene);
    ASSERT_TRUE(s.solution);
    double total = 0.0;
    for (const NodeId id : scene.roots) {
        const Node& node = *scene.nodes.find(id);
        if (!node.shape) {
            continue;
        }
        const bool horizontal = node.name == "floor" || node.name == "ceiling";
        const double area = horizontal ? 16 : 12;
        const double flux = area * mean_irradiance(scene, *s.solution, id);
        EXPECT_NEAR(flux / (horizontal ? 2210.656639 : 1394.671681), 1.0, 0.03) << node.name;
        total += flux;
    }
    EXPECT_NEAR(total / 10000, 1.0, 0.01);
    std::printf("CIE 171 5.4: %.1f of 10000 lm received\n", total);
}

// CIE 171 5.8: closed cube of 4 m, 10,000 lm in the centre: area mean of the indirect part 10000/96 * rho / (1 - rho).
class Cube58 : public testing::TestWithParam<float> {};

TEST_P(Cube58, InternallyReflectedComponent) {
    const float rho = GetParam();
    Scene scene;
    add_room(scene, 4, 4, 4, add_material(scene, rho));
    add_point_light(scene, {2, 2, 2}, 10000);
    const Solved s = solve(scene);
    ASSERT_TRUE(s.solution);
    const double expected = 10000.0 / 96.0 / (1.0 - double(rho));
    const double mean = mean_irradiance(scene, *s.solution);
    EXPECT_NEAR(mean / expected, 1.0, 0.03);
    std::printf("CIE 171 5.8 rho %.3f: mean %.2f, expected %.2f lx, %d sweeps\n", double(rho), mean, expected,
                s.solution->statistics.iterations);
}
INSTANTIATE_TEST_SUITE_P(Reflectances, Cube58, testing::Values(0.05F, 0.3F, 0.5F, 0.8F, 0.9F, 0.95F, 0.99F));

} // namespace
} // namespace atrium
