// Particles against closed forms: what a mirror, a ring and a ball of glass throw on a screen.
#include "engine/base/parallel.h"
#include "engine/particles/particle_map.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <cstring>

namespace atrium {
namespace {

using test::add_material;
using test::add_point_light;
using test::add_rectangle;

MaterialId add_mirror(Scene& scene, float rho) {
    Material m;
    m.base_color = Rgb(rho);
    m.metallic = 1.0F;
    m.roughness = 0.0F;
    return scene.materials.insert(m);
}

MaterialId add_glass(Scene& scene, float ior) {
    Material m;
    m.base_color = Rgb(1.0F);
    m.roughness = 0.0F;
    m.transmission = 1.0F;
    m.thickness = 1.0F;
    m.ior = ior;
    return scene.materials.insert(m);
}

// A parallel beam (or a disc) along `direction`, `lux` on a plane that faces it.
void add_sun(Scene& scene, const dvec3& direction, float lux, float degrees = 0.0F) {
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

void add_node(Scene& scene, const Geometry& geometry, const dvec3& at, MaterialId material) {
    Shape shape;
    shape.geometry = geometry;
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = {material};
    node.transform.translation = at;
    scene.roots.push_back(scene.nodes.insert(node));
}

struct Traced {
    explicit Traced(const Scene& scene, std::uint32_t count, std::uint32_t seed = 1)
        : rays(scene), targets(rays), direct(scene, rays),
          map(rays, targets, direct, {}, {}, ParticleSettings{count, 256, seed}, RunContext{}) {}
    [[nodiscard]] vec3 position(const Landing& l) const {
        const auto p = rays.triangle(l.surface, l.triangle);
        return vec3(dvec3(p[0] + (p[1] - p[0]) * l.barycentric.x + (p[2] - p[0]) * l.barycentric.y) + rays.origin());
    }
    [[nodiscard]] double power() const {
        double sum = 0.0;
        for (const Landing& l : map.landings()) {
            sum += luminance(map.power(l));
        }
        return sum;
    }
    RayScene rays;
    SpecularTargets targets;
    DirectLight direct;
    ParticleMap map;
};

void expect_balance(const ParticleEnergy& e) {
    EXPECT_NEAR(e.emitted, e.absorbed + e.escaped + e.stored + e.imaged + e.cut, 1e-6 * e.emitted);
}

// CAUSTIC-PLANE-MIRROR: x, y, z of the case are our x, z, y.
Scene plane_mirror() {
    Scene scene;
    add_point_light(scene, {1.0, 1.5, 2.0}, 1000.0);
    add_rectangle(scene, "mirror", {0.0, 1.5, 2.0}, {1, 0, 0}, {0, 0, 1}, 2.0F, 1.0F, add_mirror(scene, 0.9F));
    add_rectangle(scene, "wall", {4.0, 1.5, 2.0}, {-1, 0, 0}, {0, 0, 1}, 40.0F, 40.0F, add_material(scene, 0.0F));
    return scene;
}

TEST(Particles, PlaneMirrorLightsItsRectangleWithItsFlux) {
    const Traced t(plane_mirror(), 100'000);
    ASSERT_TRUE(t.map.complete());
    EXPECT_NEAR(t.power(), 92.17474411461005, 0.005 * 92.17);
    for (const Landing& l : t.map.landings()) {
        const vec3 p = t.position(l);
        EXPECT_NEAR(p.x, 4.0F, 1e-4F);
        EXPECT_GT(p.z, -3.001F);
        EXPECT_LT(p.z, 7.001F);
        EXPECT_GT(p.y, -1.001F);
        EXPECT_LT(p.y, 4.001F);
    }
    expect_balance(t.map.energy());
    EXPECT_NEAR(t.map.energy().stored, t.power(), 1e-6 * t.power());
}

TEST(Particles, WhatMirrorImagesCarryIsLeftOut) {
    const Scene scene = plane_mirror();
    const RayScene rays(scene);
    const SpecularTargets targets(rays);
    const DirectLight direct(scene, rays);
    const ParticleMap map(
        rays, targets, direct, {}, [](const Hit&) { return true; }, {1000, 256, 1}, RunContext{});
    EXPECT_TRUE(map.complete());
    EXPECT_TRUE(map.links().empty());
    EXPECT_TRUE(map.landings().empty());
}

// CAUSTIC-NEPHROID: x, y, z of the case are our x, -z, y. Light along +x, 45 degrees down.
Scene nephroid(float lux) {
    auto mesh = std::make_shared<MeshData>();
    constexpr int kSteps = 480;
    for (int i = 0; i <= kSteps; ++i) {
        const double phi = radians_from_degrees(-60.0 + 120.0 * i / kSteps);
        for (const float y : {0.0F, 1.0F}) {
            mesh->positions.push_back(vec3(dvec3(std::cos(phi), double(y), -std::sin(phi))));
            mesh->normals.push_back(vec3(dvec3(-std::cos(phi), 0.0, std::sin(phi))));
        }
        if (i > 0) {
            const auto a = std::uint32_t(2 * (i - 1));
            mesh->indices.insert(mesh->indices.end(), {a, a + 1, a + 2, a + 1, a + 3, a + 2});
        }
    }
    mesh->parts = {{0, std::uint32_t(mesh->indices.size())}};
    Scene scene;
    add_node(scene, Mesh{mesh}, {0.0, 0.0, 0.0}, add_mirror(scene, 1.0F));
    add_rectangle(scene, "floor", {0.0, 0.0, 0.0}, {0, 1, 0}, {1, 0, 0}, 12.0F, 12.0F, add_material(scene, 0.5F));
    add_sun(scene, {1.0, -1.0, 0.0}, lux);
    return scene;
}

TEST(Particles, RingThrowsTheNephroid) {
    constexpr float kLux = 1000.0F;
    const Traced t(nephroid(kLux), 2'000'000);
    ASSERT_TRUE(t.map.complete());
    expect_balance(t.map.energy());
    struct Gain {
        double x, y, gain;
    };
    // gain = reflected irradiance over that of the sun on the floor, where the formula has one pre-image or none
    for (const Gain& g : {Gain{0.2, 0.1, 1.4753095421930873}, Gain{0.35, 0.2, 1.2750833391797565},
                          Gain{0.5, 0.25, 0.9078782566787292}, Gain{0.6, 0.25, 0.7454791965006323}, Gain{0.4, 0.45, 0.0}}) {
        constexpr double kHalf = 0.01;
        double flux = 0.0;
        for (const Landing& l : t.map.landings()) {
            const vec3 p = t.position(l);
            if (std::abs(p.x - g.x) < kHalf && std::abs(-p.z - g.y) < kHalf) {
                flux += luminance(t.map.power(l));
            }
        }
        const double measured = flux / (4.0 * kHalf * kHalf) / (kLux * std::sqrt(0.5));
        EXPECT_NEAR(measured, g.gain, 0.03) << g.x << " " << g.y;
    }
}

// CAUSTIC-BALL-AXIS: light along +x; a screen far behind takes all that goes through.
TEST(Particles, BallSendsOnWhatFresnelLeaves) {
    for (const auto& [ior, fraction] : {std::pair{1.33F, 0.88451275}, std::pair{1.5F, 0.84061075}}) {
        Scene scene;
        add_node(scene, Sphere{1.0F}, {0.0, 0.0, 0.0}, add_glass(scene, ior));
        add_rectangle(scene, "screen", {1.2, 0.0, 0.0}, {-1, 0, 0}, {0, 1, 0}, 20.0F, 20.0F, add_material(scene, 0.0F));
        add_sun(scene, {1.0, 0.0, 0.0}, 1000.0F);
        const Traced t(scene, 200'000);
        ASSERT_TRUE(t.map.complete());
        double through = 0.0;
        double rim = 0.0;
        for (const Landing& l : t.map.landings()) {
            through += l.bends == 2 ? double(luminance(t.map.power(l))) : 0.0;
            const vec3 p = t.position(l);
            rim = l.bends == 2 ? std::max(rim, double(std::hypot(p.y, p.z))) : rim;
        }
        EXPECT_NEAR(through / (1000.0 * kPiD), fraction, 0.01) << ior; // the ball is of facets: its outline is smaller
        expect_balance(t.map.energy());
    }
}

TEST(Particles, SameForAnyNumberOfThreads) {
    const Scene scene = nephroid(1000.0F);
    std::vector<Landing> first;
    for (const unsigned threads : {1U, 2U, 8U}) {
        set_thread_limit(threads);
        const Traced t(scene, 20'000);
        set_thread_limit(0);
        if (first.empty()) {
            first = t.map.landings();
            ASSERT_FALSE(first.empty());
            continue;
        }
        ASSERT_EQ(first.size(), t.map.landings().size());
        for (std::size_t i = 0; i < first.size(); ++i) {
            const Landing& a = first[i];
            const Landing& b = t.map.landings()[i];
            ASSERT_TRUE(a.throughput == b.throughput && a.barycentric == b.barycentric && a.triangle == b.triangle &&
                        a.axis_a == b.axis_a && a.axis_b == b.axis_b);
        }
    }
}

TEST(Particles, StreamsAreNested) {
    const Scene scene = nephroid(1000.0F);
    const Traced few(scene, 4096);
    const Traced many(scene, 8192);
    ASSERT_EQ(few.map.links().size(), 1U);
    ASSERT_EQ(many.map.links().front().count, 2 * few.map.links().front().count);
    for (std::size_t i = 0; i < few.map.landings().size(); ++i) {
        EXPECT_EQ(few.map.landings()[i].barycentric, many.map.landings()[i].barycentric);
    }
}

// Footprints are derivatives of where particles land: neighbours in the stream's square lie where they say.
TEST(Particles, FootprintsAreTheDistanceToNeighbours) {
    const Traced t(plane_mirror(), 100'000);
    double area = 0.0;
    for (const Landing& l : t.map.landings()) {
        area += kPiD * glm::length(glm::cross(l.axis_a, l.axis_b));
    }
    // Kernels have a diameter of three mean distances: together they cover the patch pi 9 / 4 times.
    EXPECT_NEAR(area / (10.0 * 5.0), kPiD * 9.0 / 4.0, 0.1 * kPiD * 9.0 / 4.0);
}

TEST(Particles, NothingSpecularNothingDone) {
    Scene scene;
    add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 1.0F, 1.0F, add_material(scene, 0.5F));
    add_point_light(scene, {0, 1, 0}, 100.0);
    const RayScene rays(scene);
    const SpecularTargets targets(rays);
    EXPECT_TRUE(targets.empty());
    const DirectLight direct(scene, rays);
    const std::uint64_t before = rays.rays_traced();
    const ParticleMap map(rays, targets, direct, {}, {}, {}, RunContext{});
    EXPECT_TRUE(map.complete());
    EXPECT_EQ(map.memory_bytes(), 0U);
    EXPECT_EQ(rays.rays_traced(), before);
}

} // namespace
} // namespace atrium
