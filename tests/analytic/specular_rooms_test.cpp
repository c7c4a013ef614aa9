// Rooms with mirrors, metal and glass in them whose light is known.
#include "tests/support/light_cases.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using test::add_material;
using test::add_rectangle;
using test::add_shape;
using test::Solved;

MaterialId add_metal(Scene& scene, float rho, float roughness) {
    Material m;
    m.base_color = Rgb(rho);
    m.metallic = 1.0F;
    m.roughness = roughness;
    return scene.materials.insert(m);
}

MaterialId add_solid_glass(Scene& scene, float ior) {
    Material m;
    m.base_color = Rgb(1.0F);
    m.roughness = 0.0F;
    m.transmission = 1.0F;
    m.thickness = 1.0F;
    m.ior = ior;
    return scene.materials.insert(m);
}

// Half of the room of ENC-ROOM-543, closed at x = 2 with a wall of metal. y and z of the case are our z and y.
Scene half_room(float metal_roughness) {
    Scene scene;
    const MaterialId wall = add_material(scene, 0.5F);
    const double h = 3.0, d = 4.0, w = 2.0;
    add_rectangle(scene, "floor", {w / 2, 0, d / 2}, {0, 1, 0}, {1, 0, 0}, 2, 4, add_material(scene, 0.2F));
    add_rectangle(scene, "ceiling", {w / 2, h, d / 2}, {0, -1, 0}, {1, 0, 0}, 2, 4, add_material(scene, 0.7F));
    add_rectangle(scene, "wall x0", {0, h / 2, d / 2}, {1, 0, 0}, {0, 0, 1}, 4, 3, wall);
    add_rectangle(scene, "wall z0", {w / 2, h / 2, 0}, {0, 0, 1}, {1, 0, 0}, 2, 3, wall);
    add_rectangle(scene, "wall z1", {w / 2, h / 2, d}, {0, 0, -1}, {1, 0, 0}, 2, 3, wall);
    add_rectangle(scene, "mirror", {w, h / 2, d / 2}, {-1, 0, 0}, {0, 0, 1}, 4, 3, add_metal(scene, 1.0F, metal_roughness));
    add_rectangle(scene, "source", {1.75, h, 2}, {0, -1, 0}, {1, 0, 0}, 0.5F, 1, add_material(scene, 0.7F, 1000.0F * kPi));
    return scene;
}

// ENC-MIRROR-SYMM: a lossless mirror stands for the other half.
TEST(SpecularRooms, MirrorStandsForTheOtherHalf) {
    Scene scene = half_room(0.0F);
    Solved s = test::solve(scene, SolverSettings::Quality::Normal);
    ASSERT_TRUE(s.solution);
    struct Probe {
        const char* name;
        dvec3 at, normal;
        double total;
    };
    for (const Probe& p :
         {Probe{"floor 1 1", {1, 0, 1}, {0, 1, 0}, 106.2131}, Probe{"floor 1 2", {1, 0, 2}, {0, 1, 0}, 121.2139},
          Probe{"wall z0", {1, 1.5, 0}, {0, 0, 1}, 87.7549}, Probe{"wall x0", {0, 1.5, 2}, {1, 0, 0}, 106.436}}) {
        const SensorReading shown = read_surface(scene, *s.solution, p.at, p.normal);
        ASSERT_TRUE(shown.on_surface) << p.name;
        std::printf("ENC-MIRROR-SYMM %s: %.2f lux shown, %.2f expected\n", p.name, double(luminance(shown.irradiance)),
                    p.total);
        EXPECT_NEAR(luminance(shown.irradiance) / p.total, 1.0, 0.01) << p.name;
    }
    EXPECT_NEAR(s.solution->statistics.energy.defect, 0.0, 0.02);
    for (const CausticRecord& r : s.solution->caustic_records) { // images of lamps leave particles nothing to carry
        EXPECT_EQ(r.power_mesh + r.power_texture, 0.0) << r.why;
    }
}

// What stays on the mesh of what a dull mirror spreads is at the vertices, no more and no less.
TEST(SpecularRooms, VerticesHoldThePowerOfTheMesh) {
    Scene scene = half_room(0.4F);
    Solved s = test::solve(scene, SolverSettings::Quality::Normal);
    ASSERT_TRUE(s.solution);
    double landed = 0.0;
    for (const CausticRecord& r : s.solution->caustic_records) {
        landed += r.power_mesh;
    }
    double shown = 0.0;
    for (const auto& layer : s.solution->surfaces) {
        const std::vector<std::uint32_t>& v = layer->mesh->indices;
        for (std::size_t t = 0; t + 2 < v.size() && !layer->caustic_front.empty(); t += 3) {
            const auto& p = layer->mesh->positions;
            const double third = double(glm::length(glm::cross(p[v[t + 1]] - p[v[t]], p[v[t + 2]] - p[v[t]]))) / 6.0;
            for (std::size_t k = 0; k < 3; ++k) {
                shown += third * luminance(layer->caustic_front[v[t + k]]);
            }
        }
    }
    EXPECT_GT(landed, 0.0);
    EXPECT_NEAR(shown, landed, 1e-4 * landed);
}

// ENC-FURNACE with things in it that absorb nothing: radiance, and so irradiance, is the same everywhere.
TEST(SpecularRooms, FurnaceWithMirrorAndGlassCloses) {
    constexpr float kRho = 0.5F;
    Scene scene;
    test::add_room(scene, 4, 3, 4, add_material(scene, kRho, 1.0F));
    add_shape(scene, "ball of metal", Sphere{0.5F}, {1.2, 1.0, 1.2}, add_metal(scene, 1.0F, 0.0F));
    add_shape(scene, "ball of glass", Sphere{0.5F}, {2.8, 1.0, 2.8}, add_solid_glass(scene, 1.5F));
    Solved s = test::solve(scene, SolverSettings::Quality::Normal);
    ASSERT_TRUE(s.solution);
    const double expected = 1.0 / (1.0 - double(kRho)); // B = M + rho E, E = B
    for (const auto& layer : s.solution->surfaces) {
        const Node& node = *scene.nodes.find(layer->node);
        if (node.name.starts_with("ball")) {
            continue;
        }
        for (const Rgb& e : layer->irradiance_front) {
            EXPECT_NEAR(luminance(e) / expected, 1.0, 0.03) << node.name;
        }
    }
    EXPECT_NEAR(s.solution->statistics.energy.defect, 0.0, 0.01);
    EXPECT_EQ(s.solution->statistics.particles_emitted, 0U); // no light stands out: the rays of the gather see over mirrors
}

// X-TIR: an isotropic source in the middle of a lossless cube of glass. Faces keep the size of each component of a
// direction, so what lies in the cone of one face leaves by it in the end, and all else stays inside for ever: six cones of
// (1 - cos 41.81 deg) / 2 = 12.7322 % come out.
TEST(SpecularRooms, GlassCubeLetsSixConesOut) {
    Scene scene;
    test::add_room(scene, 3, 3, 3, add_material(scene, 0.0F));
    add_shape(scene, "cube", Box{vec3(0.5F)}, {1.5, 1.5, 1.5}, add_solid_glass(scene, 1.5F));
    test::add_point_light(scene, {1.5, 1.5, 1.5}, 1000.0);
    const Solved s = test::solve(scene, SolverSettings::Quality::Draft);
    ASSERT_TRUE(s.solution);
    double flux = 0.0;
    for (int wall = 0; wall < 6; ++wall) {
        flux += 9.0 * test::mean_irradiance(scene, *s.solution, scene.roots[std::size_t(wall)]);
    }
    std::printf("out of the cube: %.2f lm of 1000, expected 763.93\n", flux);
    EXPECT_NEAR(flux, 763.932, 0.01 * 763.932);
}

} // namespace
} // namespace atrium
