// Rays against small scenes whose answers are plain to see.
#include "engine/base/float_traps.h"
#include "engine/raycast/ray_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <random>

namespace atrium {
namespace {

using namespace test;

NodeId add_node(Scene& scene, const Geometry& geometry, const dvec3& at, MaterialId material,
                const dvec3& scale = dvec3(1.0)) {
    Shape shape;
    shape.geometry = geometry;
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = {material};
    node.transform.translation = at;
    node.transform.scale = scale;
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

TEST(RayScene, NearestHitDistanceSideAndNormal) {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    const NodeId box = add_node(scene, Box{vec3(2.0F)}, {0, 0, 0}, m);
    add_node(scene, Box{vec3(2.0F)}, {0, 0, -6}, m);
    const RayScene rays(scene);
    const vec3 o(rays.origin());
    const Hit hit = rays.nearest({vec3(0.3F, 0.2F, 5) - o, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit.t, 4.0F, 1e-5F);
    EXPECT_EQ(rays.surfaces()[hit.surface].node, box);
    EXPECT_TRUE(hit.front);
    EXPECT_LT(glm::length(hit.geometric_normal - vec3(0, 0, 1)), 1e-5F);
    EXPECT_LT(glm::length(rays.shading_normal(hit) - vec3(0, 0, 1)), 1e-5F);
    const Hit inside = rays.nearest({-o, {0, 0, -1}});
    ASSERT_TRUE(inside);
    EXPECT_FALSE(inside.front);
    EXPECT_NEAR(inside.t, 1.0F, 1e-5F);
    EXPECT_LT(glm::length(inside.geometric_normal - vec3(0, 0, -1)), 1e-5F) << "normals are those of the front side";
    EXPECT_FALSE(rays.nearest({vec3(5, 5, 5) - o, {0, 0, -1}}));
    EXPECT_FALSE(rays.nearest({vec3(0, 0, 5) - o, {0, 0, -1}, 3.9F})) << "tmax";
    // The barycentric weights give the point that was hit.
    const auto p = rays.triangle(hit.surface, hit.triangle);
    const vec3 point =
        p[0] * (1.0F - hit.barycentric.x - hit.barycentric.y) + p[1] * hit.barycentric.x + p[2] * hit.barycentric.y;
    EXPECT_LT(glm::length(point - (vec3(0.3F, 0.2F, 1) - o)), 1e-5F);
}

TEST(RayScene, OccludedStrictlyBetween) {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    add_rectangle(scene, "wall", {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 2, 2, m);
    const RayScene rays(scene);
    EXPECT_TRUE(rays.occluded({0.1F, 0.2F, 1}, {0.1F, 0.2F, -1}));
    EXPECT_TRUE(rays.occluded({0.1F, 0.2F, -1}, {0.1F, 0.2F, 1})) << "from behind as well";
    EXPECT_FALSE(rays.occluded({0.1F, 0.2F, 1}, {0.1F, 0.2F, 0})) << "the surface a segment ends on does not count";
    EXPECT_FALSE(rays.occluded({0.1F, 0.2F, 0}, {0.1F, 0.2F, 1}));
    EXPECT_FALSE(rays.occluded({1.1F, 0.2F, 1}, {1.1F, 0.2F, -1}));
    EXPECT_FALSE(rays.occluded({0.1F, 0.2F, 0}, {0.1F, 0.2F, 0})) << "no length";
    EXPECT_EQ(rays.transmittance({0.1F, 0.2F, 1}, {0.1F, 0.2F, -1}), Rgb(0.0F));
    EXPECT_EQ(rays.transmittance_to_infinity({0.1F, 0.2F, 1}, {0, 0, -1}), Rgb(0.0F));
    EXPECT_EQ(rays.transmittance_to_infinity({0.1F, 0.2F, 1}, {0, 0, 1}), Rgb(1.0F));
}

TEST(RayScene, MirroredNodesKeepTheirFrontSide) {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    add_node(scene, Box{vec3(2.0F)}, {0, 0, 0}, m, {-1, 1, 1});
    add_node(scene, Polygon{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {}}, {10, 0, 0}, m, {1, -2, 1});
    add_node(scene, Sphere{1.0F}, {20, 0, 0}, m, {1, 1, -3});
    const RayScene rays(scene);
    const vec3 o(rays.origin());
    for (const auto& s : rays.surfaces()) {
        EXPECT_TRUE(s.mirrored);
    }
    for (const float x : {0.1F, 10.1F, 20.1F}) {
        const Hit hit = rays.nearest({vec3(x, 0.15F, 9) - o, {0, 0, -1}});
        ASSERT_TRUE(hit) << x;
        EXPECT_TRUE(hit.front) << x;
        EXPECT_GT(hit.geometric_normal.z, 0.9F) << x;
        EXPECT_GT(glm::dot(rays.shading_normal(hit), hit.geometric_normal), 0.9F) << x;
    }
}

// Unpolarised Fresnel reflectance from Snell's law and the angle forms (independent of the engine's cosine form).
double fresnel(double angle, double n) {
    if (angle == 0.0) {
        return (n - 1) * (n - 1) / ((n + 1) * (n + 1));
    }
    const double t = std::asin(std::sin(angle) / n);
    const double s = std::sin(angle - t) / std::sin(angle + t);
    const double p = std::tan(angle - t) / std::tan(angle + t);
    return 0.5 * (s * s + p * p);
}

TEST(RayScene, ThinGlassTransmittanceFollowsFresnel) {
    for (const float ior : {1.0F, 1.3F, 1.5F, 1.9F}) {
        Scene scene;
        Material glass;
        glass.base_color = Rgb(1.0F, 0.5F, 0.25F);
        glass.transmission = 1.0F;
        glass.roughness = 0.0F;
        glass.ior = ior;
        add_rectangle(scene, "pane", {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 100, 100, scene.materials.insert(glass));
        const RayScene rays(scene);
        for (const double degrees : {0.0, 20.0, 45.0, 60.0, 75.0, 85.0}) {
            const double a = degrees * kPiD / 180.0;
            const vec3 d(float(std::sin(a)), 0, float(-std::cos(a)));
            const vec3 point(0.3F, 0.4F, 0);
            const double f = ior == 1.0F ? 0.0 : fresnel(a, ior);
            const Rgb t = rays.transmittance(point - d, point + d);
            EXPECT_NEAR(t.r, (1 - f) / (1 + f), 2e-5) << ior << " at " << degrees;
            EXPECT_NEAR(t.g, 0.5 * t.r, 1e-6);
            EXPECT_NEAR(t.b, 0.25 * t.r, 1e-6);
            EXPECT_LT(glm::length(rays.transmittance(point + d, point - d) - t), 1e-6F) << "the same both ways";
            EXPECT_FALSE(rays.occluded(point - d, point + d));
        }
    }
}

TEST(RayScene, PanesInARowMultiplyAndAWallBehindThemStops) {
    Scene scene;
    Material glass;
    glass.base_color = Rgb(0.9F);
    glass.transmission = 1.0F;
    glass.roughness = 0.0F;
    const MaterialId m = scene.materials.insert(glass);
    for (int i = 0; i < 5; ++i) {
        add_rectangle(scene, "pane", {0, 0, 0.1 * i}, {0, 0, 1}, {1, 0, 0}, 4, 4, m);
    }
    add_rectangle(scene, "wall", {0, 0, -1}, {0, 0, 1}, {1, 0, 0}, 4, 4, add_material(scene, 0.5F));
    const RayScene rays(scene);
    const vec3 o(rays.origin());
    const double one = 0.9 * (1 - 0.04) / (1 + 0.04);
    EXPECT_NEAR(rays.transmittance(vec3(0.1F, 0.2F, 2) - o, vec3(0.1F, 0.2F, -0.5F) - o).r, std::pow(one, 5), 1e-5);
    EXPECT_EQ(rays.transmittance(vec3(0.1F, 0.2F, 2) - o, vec3(0.1F, 0.2F, -2) - o), Rgb(0.0F));
}

TEST(RayScene, CoplanarLampIsNotHiddenByItsCeiling) {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    add_room(scene, 4, 3, 4, m);
    const NodeId lamp =
        add_rectangle(scene, "lamp", {2, 3, 2}, {0, -1, 0}, {1, 0, 0}, 1, 1, add_material(scene, 0.0F, 100.0F));
    const RayScene rays(scene);
    const vec3 o(rays.origin());
    std::mt19937 random(7);
    std::uniform_real_distribution<float> u(0.0F, 1.0F);
    for (int i = 0; i < 2000; ++i) {
        const vec3 on_lamp(1.5F + u(random), 3, 1.5F + u(random));
        const vec3 on_floor(4 * u(random), 0, 4 * u(random));
        EXPECT_FALSE(rays.occluded(on_floor - o, on_lamp - o));
        EXPECT_FALSE(rays.occluded(on_lamp - o, on_floor - o));
    }
    EXPECT_TRUE(scene.nodes.contains(lamp));
}

Scene masked_scene(Material::Alpha mode) {
    // Left half of the picture is see-through (alpha 0), right half opaque.
    Scene scene;
    auto image = std::make_shared<Image>();
    image->width = 2;
    image->height = 1;
    image->channels = 4;
    image->bytes = {255, 255, 255, 0, 255, 255, 255, 255};
    Texture texture;
    texture.image = image;
    texture.nearest = true;
    texture.wrap_u = texture.wrap_v = Texture::Wrap::ClampToEdge;
    Material leaf;
    leaf.base_color = Rgb(1.0F);
    leaf.alpha_mode = mode;
    leaf.base_color_texture.texture = scene.textures.insert(texture);
    add_rectangle(scene, "leaf", {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 2, 2, scene.materials.insert(leaf));
    add_rectangle(scene, "wall", {0, 0, -1}, {0, 0, 1}, {1, 0, 0}, 2, 2, add_material(scene, 0.5F));
    return scene;
}

TEST(RayScene, AlphaMaskIsCutOut) {
    const RayScene rays(masked_scene(Material::Alpha::Mask));
    const vec3 o(rays.origin());
    const Hit through = rays.nearest({vec3(-0.7F, 0.1F, 1) - o, {0, 0, -1}});
    ASSERT_TRUE(through);
    EXPECT_NEAR(through.t, 2.0F, 1e-5F) << "the wall behind the cut-out";
    EXPECT_NEAR(rays.nearest({vec3(0.7F, 0.1F, 1) - o, {0, 0, -1}}).t, 1.0F, 1e-5F);
    EXPECT_EQ(rays.transmittance(vec3(-0.7F, 0.1F, 1) - o, vec3(-0.7F, 0.1F, -0.9F) - o), Rgb(1.0F));
    EXPECT_EQ(rays.transmittance(vec3(0.7F, 0.1F, 1) - o, vec3(0.7F, 0.1F, -0.9F) - o), Rgb(0.0F));
    EXPECT_TRUE(rays.occluded(vec3(-0.7F, 0.1F, 1) - o, vec3(-0.7F, 0.1F, -2) - o));
}

TEST(RayScene, BlendedSurfaceLetsItsShareThrough) {
    const RayScene rays(masked_scene(Material::Alpha::Blend));
    const vec3 o(rays.origin());
    EXPECT_EQ(rays.transmittance(vec3(-0.7F, 0.1F, 1) - o, vec3(-0.7F, 0.1F, -0.9F) - o), Rgb(1.0F));
    EXPECT_EQ(rays.transmittance(vec3(0.7F, 0.1F, 1) - o, vec3(0.7F, 0.1F, -0.9F) - o), Rgb(0.0F));
}

TEST(RayScene, DegenerateAndNonFiniteTrianglesAreDroppedAndCounted) {
    const FloatTrapsOff no_number_on_purpose;
    Scene scene;
    auto data = std::make_shared<MeshData>();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    data->positions = {{0, 0, 0}, {1, 0, 0},   {0, 1, 0},
                       {2, 0, 0}, {nan, 0, 0}, {std::numeric_limits<float>::infinity(), 0, 0}};
    data->indices = {0, 1, 2, 0, 1, 3, 0, 0, 1, 1, 1, 1, 0, 1, 4, 0, 2, 5};
    data->parts = {{0, std::uint32_t(data->indices.size())}};
    add_node(scene, Mesh{data}, {0, 0, 0}, add_material(scene, 0.5F));
    const RayScene rays(scene);
    EXPECT_EQ(rays.triangle_count(), 1U);
    EXPECT_EQ(rays.dropped_triangles(), 5U);
    EXPECT_TRUE(is_finite(rays.bounds().min) && is_finite(rays.bounds().max));
    EXPECT_TRUE(is_finite(rays.origin()));
    const Hit hit = rays.nearest({vec3(0.2F, 0.2F, 1) - vec3(rays.origin()), {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit.t, 1.0F, 1e-5F);
    // Scaled to nothing in one direction: nothing is left, nothing breaks.
    Scene flat;
    add_node(flat, Box{}, {0, 0, 0}, add_material(flat, 0.5F), {0, 0, 1});
    EXPECT_EQ(RayScene(flat).triangle_count(), 0U);
    EXPECT_EQ(RayScene(flat).dropped_triangles(), 12U);
}

TEST(RayScene, HiddenNodesAndTheirChildrenAreAbsent) {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    const NodeId parent = add_node(scene, Box{}, {0, 0, 0}, m);
    const NodeId child = add_node(scene, Box{}, {3, 0, 0}, m);
    scene.roots.pop_back();
    scene.nodes.find(child)->parent = parent;
    scene.nodes.find(parent)->children = {child};
    add_node(scene, Box{}, {9, 0, 0}, m);
    EXPECT_EQ(RayScene(scene).triangle_count(), 36U);
    scene.nodes.find(parent)->visible = false;
    const RayScene rays(scene);
    EXPECT_EQ(rays.triangle_count(), 12U);
    EXPECT_FALSE(rays.nearest({vec3(0, 0, 5) - vec3(rays.origin()), {0, 0, -1}}));
    EXPECT_FALSE(rays.nearest({vec3(3, 0, 5) - vec3(rays.origin()), {0, 0, -1}}));
}

TEST(RayScene, EmptySceneAnswersEverything) {
    const RayScene rays{Scene{}};
    EXPECT_TRUE(rays.bounds().empty());
    EXPECT_FALSE(rays.nearest({vec3(0), {0, 0, 1}}));
    EXPECT_FALSE(rays.occluded(vec3(0), vec3(1)));
    EXPECT_EQ(rays.transmittance_to_infinity(vec3(0), {0, 0, 1}), Rgb(1.0F));
    EXPECT_EQ(rays.triangle_count(), 0U);
}

TEST(RayScene, OffsetOfAThousandKilometresChangesNoHit) {
    const auto build = [](const dvec3& offset) {
        Scene scene;
        const MaterialId m = add_material(scene, 0.5F);
        add_room(scene, 4, 3, 5, m);
        add_node(scene, Sphere{0.4F}, {1.3, 0.4, 2.1}, m);
        add_node(scene, Box{{0.3F, 0.7F, 0.9F}}, {3.1, 0.35, 3.3}, m);
        for (const NodeId id : scene.roots) {
            scene.nodes.find(id)->transform.translation += offset;
        }
        return scene;
    };
    const RayScene near(build(dvec3(0.0)));
    const RayScene far(build({1e6, 2e6, -1e6}));
    EXPECT_EQ(far.origin() - near.origin(), dvec3(1e6, 2e6, -1e6));
    std::mt19937 random(3);
    std::uniform_real_distribution<float> u(-1.0F, 1.0F);
    for (int i = 0; i < 3000; ++i) {
        const vec3 from(1.9F * u(random), 1.4F * u(random), 2.4F * u(random));
        const vec3 d = glm::normalize(vec3(u(random), u(random), u(random)) + vec3(1e-3F));
        const Hit a = near.nearest({from, d});
        const Hit b = far.nearest({from, d});
        ASSERT_EQ(a.surface, b.surface);
        if (a) {
            EXPECT_NEAR(a.t, b.t, 1e-4F);
        }
    }
}

// Two rooms side by side, [0,4] and [4,8] plus the wall's thickness, each closed by its own faces.
Scene two_rooms(double thickness, bool one_wall) {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    add_room(scene, 4, 3, 4, m);
    const std::size_t first = scene.roots.size();
    add_room(scene, 4, 3, 4, m);
    for (std::size_t i = first; i < scene.roots.size(); ++i) {
        scene.nodes.find(scene.roots[i])->transform.translation.x += 4 + thickness;
    }
    if (one_wall) { // the shared wall is a single rectangle that faces the first room
        scene.nodes.erase(scene.roots[first + 2]);
        scene.roots.erase(scene.roots.begin() + std::ptrdiff_t(first + 2));
    }
    return scene;
}

TEST(RayScene, NoLeakThroughSharedWalls) {
    struct Case {
        double thickness;
        bool one_wall;
    };
    for (const Case& c : {Case{0.0, true}, Case{0.0, false}, Case{1e-3, false}}) {
        const RayScene rays(two_rooms(c.thickness, c.one_wall));
        const dvec3 o = rays.origin();
        std::mt19937 random(11);
        std::uniform_real_distribution<double> u(0.0, 1.0);
        int leaks = 0;
        for (int i = 0; i < 20000; ++i) {
            // Surfaces and edges count as much as the inside; near the wall no nearer than a display vertex is pulled in.
            const auto coordinate = [&](double size, double margin) {
                const double v = u(random);
                return v < 0.15 ? margin : (v > 0.85 ? size - margin : margin + (size - 2 * margin) * u(random));
            };
            const dvec3 a(coordinate(4, 1e-3), coordinate(3, 1e-5), coordinate(4, 1e-5));
            const dvec3 b(4 + c.thickness + coordinate(4, 1e-3), coordinate(3, 1e-5), coordinate(4, 1e-5));
            leaks += rays.occluded(vec3(a - o), vec3(b - o)) ? 0 : 1;
        }
        EXPECT_EQ(leaks, 0) << "thickness " << c.thickness << (c.one_wall ? ", one wall" : ", two walls");
    }
}

TEST(RayScene, NoLeakFromPointsOnTheWallItself) {
    const RayScene rays(two_rooms(1e-3, false));
    const dvec3 o = rays.origin();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> u(0.01, 0.99);
    for (int i = 0; i < 5000; ++i) {
        const dvec3 wall_of_dark_room(4.001, 3 * u(random), 4 * u(random));
        const dvec3 in_lit_room(4 * u(random), 3 * u(random), 4 * u(random));
        EXPECT_TRUE(rays.occluded(vec3(wall_of_dark_room - o), vec3(in_lit_room - o)));
    }
}

TEST(RayScene, CountsTheRaysItTraced) {
    Scene scene;
    add_node(scene, Box{}, {0, 0, 0}, add_material(scene, 0.5F));
    const RayScene rays(scene);
    EXPECT_EQ(rays.rays_traced(), 0U);
    for (int i = 0; i < 10; ++i) {
        EXPECT_TRUE(rays.nearest({{0, 0, 5}, {0, 0, -1}}));
    }
    EXPECT_EQ(rays.rays_traced(), 10U);
    EXPECT_GT(rays.memory_bytes(), 0U);
}

} // namespace
} // namespace atrium
