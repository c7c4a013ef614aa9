// Meshes that have triangles more than once: doubles count once, and twins that face apart are two sides of one surface.
#include "engine/geometry/repeated_triangles.h"

#include "engine/raycast/ray_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <random>

namespace atrium {
namespace {

using namespace test;

/// Adds triangles that share no corners' indices, as files with normals of their own for each have them.
void add(MeshData& mesh, const std::vector<std::array<vec3, 3>>& triangles) {
    const auto first = std::uint32_t(mesh.indices.size());
    for (const auto& triangle : triangles) {
        for (const vec3& p : triangle) {
            mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
            mesh.positions.push_back(p);
        }
    }
    mesh.parts.push_back({first, std::uint32_t(mesh.indices.size()) - first});
}

std::array<vec3, 3> turned(const std::array<vec3, 3>& t) { return {t[1], t[0], t[2]}; }

const std::array<vec3, 3> kA{vec3{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}}, kB{vec3{-1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};

NodeId add_mesh(Scene& scene, MeshData mesh, std::vector<MaterialId> materials) {
    Shape shape;
    shape.geometry = Mesh{std::make_shared<const MeshData>(std::move(mesh))};
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = std::move(materials);
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

TEST(RepeatedTriangles, TellsDoublesFromTurnedTwinsInOnePartAndInTwo) {
    MeshData mesh;
    // Rotated corners are the same way round; -0 is 0.
    add(mesh, {kA, kB, turned(kA), {kA[1], kA[2], kA[0]}, turned(kA), kB, {vec3(0, 0, 1), {1, 0, 1}, {0, 1, 1}}});
    add(mesh, {{vec3(-1, -1, -0.0F), {1, -1, 0}, {1, 1, 0}}, turned(kB), turned(kB)});
    const RepeatedTriangles found = repeated_triangles(mesh);
    ASSERT_EQ(found.parts.size(), 2U);
    EXPECT_EQ(found.parts[0].turned, std::vector<std::uint32_t>{2});
    EXPECT_EQ(found.parts[0].same, (std::vector<std::uint32_t>{3, 4, 5}));
    EXPECT_TRUE(found.parts[1].turned.empty()) << "of another part: its material may be another";
    EXPECT_EQ(found.parts[1].same, std::vector<std::uint32_t>{2});
    EXPECT_TRUE(found.twins);
    MeshData plain;
    add(plain, {kA, kB, kB});
    EXPECT_FALSE(repeated_triangles(plain).twins);
}

// The answer to brute force over random triangles of few corners, so that many coincide.
TEST(RepeatedTriangles, AgreesWithComparingAll) {
    std::mt19937 random(7);
    MeshData mesh;
    std::vector<std::array<vec3, 3>> triangles;
    for (int i = 0; i < 400; ++i) {
        const auto corner = [&] { return vec3(float(random() % 3), float(random() % 2), float(random() % 2)); };
        triangles.push_back({corner(), corner(), corner()});
    }
    add(mesh, triangles);
    std::vector<std::uint32_t> same;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const auto& a = triangles[t];
        // Two corners in one place: no way round to tell apart.
        const bool flat = a[0] == a[1] || a[1] == a[2] || a[2] == a[0];
        for (std::uint32_t s = 0; s < t; ++s) {
            const auto& b = triangles[s];
            if (!flat &&
                (b == a || b == std::array<vec3, 3>{a[1], a[2], a[0]} || b == std::array<vec3, 3>{a[2], a[0], a[1]})) {
                same.push_back(t);
                break;
            }
        }
    }
    std::vector<std::uint32_t> found;
    const RepeatedTriangles repeated = repeated_triangles(mesh);
    for (const std::uint32_t t : repeated.parts[0].same) {
        const auto& a = triangles[t];
        if (a[0] != a[1] && a[1] != a[2] && a[2] != a[0]) {
            found.push_back(t);
        }
    }
    EXPECT_GT(same.size(), 50U);
    EXPECT_EQ(found, same);
}

// A ray meets the side that faces it: of twins in one part, in two with materials of their own, and after a move.
TEST(RepeatedTriangles, RaysMeetTheTwinThatFacesThem) {
    Scene scene;
    const MaterialId red = add_material(scene, 0.5F), blue = add_material(scene, 0.2F);
    MeshData one, two;
    add(one, {kA, kB, turned(kA), turned(kB), kA});
    add(two, {turned(kA), turned(kB)});
    add(two, {kA, kB});
    const NodeId first = add_mesh(scene, one, {red}), second = add_mesh(scene, two, {blue, red});
    const auto look = [&](const RayScene& rays, bool before) {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> any(-0.95F, 0.95F);
        for (int i = 0; i < 400; ++i) {
            for (const NodeId id : {first, second}) {
                const vec3 centre(scene.nodes.find(id)->transform.translation - rays.origin());
                const vec3 at = centre + vec3(any(random), any(random), 0);
                const vec3 from = centre + vec3(any(random), any(random), (i & 1) != 0 ? 2.0F : -2.0F);
                const Ray ray{from, glm::normalize(at - from)};
                const Hit hit = before ? rays.nearest_before(ray) : rays.nearest(ray);
                ASSERT_TRUE(hit);
                EXPECT_TRUE(hit.front) << i;
                EXPECT_LT(glm::dot(hit.geometric_normal, ray.direction), 0.0F);
                EXPECT_LT(glm::length(from + hit.t * ray.direction - at), 1e-5F);
                if (id == second && !before) {
                    EXPECT_EQ(rays.surfaces()[hit.surface].material, (i & 1) != 0 ? red : blue);
                }
            }
        }
    };
    scene.nodes.find(second)->transform.translation = {3, 0, 0};
    RayScene rays(scene);
    EXPECT_EQ(rays.triangle_count(), 8U) << "the double counts once";
    EXPECT_EQ(rays.dropped_triangles(), 1U);
    look(rays, false);
    const Scene was = scene;
    scene.nodes.find(second)->transform.translation = {3, 0.5, 7};
    scene.nodes.find(first)->transform.translation = {-1, 0.25, 0};
    ASSERT_TRUE(rays.move_to(scene));
    look(rays, false);
    ASSERT_TRUE(rays.look_back());
    scene = was;
    look(rays, true);
}

// Materials that show both sides anyway need no twins: one surface with two sides, one pane with two faces.
TEST(RepeatedTriangles, TwinsOfTwoSidedMaterialsAreLeftOut) {
    Scene scene;
    Material cloth;
    cloth.double_sided = true;
    Material pane;
    pane.transmission = 1.0F;
    pane.roughness = 0.0F;
    pane.base_color = Rgb(1.0F);
    MeshData mesh, again;
    add(mesh, {kA, kB, turned(kA), turned(kB)});
    add(again, {kA, kB, turned(kA), turned(kB)});
    add_mesh(scene, mesh, {scene.materials.insert(cloth)});
    scene.nodes.find(add_mesh(scene, again, {scene.materials.insert(pane)}))->transform.translation = {3, 0, 0};
    const RayScene rays(scene);
    ASSERT_EQ(rays.surfaces().size(), 2U);
    EXPECT_EQ(rays.triangle_count(), 4U);
    EXPECT_TRUE(rays.surfaces()[0].back_side);
    const vec3 o(rays.origin());
    EXPECT_FALSE(rays.nearest({vec3(0.2F, 0.1F, -1) - o, {0, 0, 1}}).front);
    const double f = 0.04; // of both faces with their inner reflections: (1 - f) / (1 + f)
    EXPECT_NEAR(rays.transmittance(vec3(3.2F, 0.1F, -1) - o, vec3(3.2F, 0.1F, 1) - o).r, (1 - f) / (1 + f), 1e-4);
}

// A lamp and a room of which every triangle is there three times, once turned round, give the light of those that are not.
TEST(RepeatedTriangles, LightIsThatOfSurfacesListedOnce) {
    double lux[2][2];
    for (int times = 0; times < 2; ++times) {
        Scene scene;
        MeshData room, lamp;
        const auto quad = [&](MeshData& out, const vec3& a, const vec3& b, const vec3& c, const vec3& d) {
            const std::array<vec3, 3> p{a, b, c}, q{a, c, d};
            times == 0 ? add(out, {p, q}) : add(out, {turned(p), p, q, p, turned(q), q});
        };
        const vec3 low(-2, 0, -1.5F), high(2, 2.5F, 1.5F);
        const auto at = [&](int x, int y, int z) {
            return vec3(x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z);
        };
        quad(room, at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0));
        quad(room, at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1));
        quad(room, at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0));
        quad(room, at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1));
        quad(room, at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1));
        quad(room, at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0));
        // It hangs a hand below the ceiling: its turned side shines too, on the ceiling above it.
        quad(lamp, vec3(-0.5F, 2.4F, -0.2F), vec3(0.5F, 2.4F, -0.2F), vec3(0.5F, 2.4F, 0.2F), vec3(-0.5F, 2.4F, 0.2F));
        Material shining = *scene.materials.find(add_material(scene, 0.0F, 1000.0F));
        shining.double_sided = true;
        const MaterialId white = add_material(scene, 0.6F);
        add_mesh(scene, room, std::vector<MaterialId>(room.parts.size(), white));
        add_mesh(scene, lamp, {scene.materials.insert(shining)});
        const Solved s = solve(scene, SolverSettings::Quality::Draft);
        ASSERT_TRUE(s.solution);
        const auto read = [&](const dvec3& place, const dvec3& normal) {
            const SensorReading reading = read_surface(scene, *s.solution, place, normal);
            EXPECT_TRUE(reading.on_surface);
            return double(luminance(reading.irradiance));
        };
        lux[times][0] = read({1.2, 0.0, 0.7}, {0, 1, 0});
        lux[times][1] = read({0.9, 2.5, 0.1}, {0, -1, 0});
    }
    EXPECT_GT(lux[0][0], 10.0);
    EXPECT_NEAR(lux[1][0] / lux[0][0], 1.0, 0.03) << "two seeds of a draft are as far apart";
    EXPECT_NEAR(lux[1][1] / lux[0][1], 1.0, 0.03);
}

} // namespace
} // namespace atrium
