// Which solid glass counts as a flat pane, and what goes straight through glass of every kind.
#include "engine/optics/specular.h"
#include "engine/raycast/ray_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <memory>

namespace atrium {
namespace {

Material clear_glass(float thickness) {
    Material m;
    m.base_color = Rgb(1.0F);
    m.transmission = 1.0F;
    m.roughness = 0.0F;
    m.thickness = thickness;
    return m;
}

NodeId add(Scene& scene, const Geometry& geometry, const Material& material, const Transform& transform = {}) {
    Shape shape;
    shape.geometry = geometry;
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = {scene.materials.insert(material)};
    node.transform = transform;
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

float thickness_of(const Geometry& geometry, const Transform& transform = {}, const Material& m = clear_glass(0.01F)) {
    Scene scene;
    add(scene, geometry, m, transform);
    const RayScene rays(scene);
    EXPECT_EQ(rays.surfaces()[0].slab, rays.surfaces()[0].slab_thickness > 0.0F);
    return rays.surfaces()[0].slab_thickness;
}

/// Two coaxial walls with their rims: a glass tube of the facets given.
Mesh tube(float outer, float inner, float height, int facets) {
    auto data = std::make_shared<MeshData>();
    for (int i = 0; i < facets; ++i) {
        const float a = 2.0F * kPi * float(i) / float(facets);
        for (const float r : {outer, inner}) {
            for (const float y : {0.0F, height}) {
                data->positions.emplace_back(r * std::cos(a), y, r * std::sin(a));
            }
        }
    }
    const auto quad = [&](unsigned a, unsigned b, unsigned c, unsigned d) {
        for (const unsigned k : {a, b, c, a, c, d}) {
            data->indices.push_back(k);
        }
    };
    for (unsigned i = 0; i < unsigned(facets); ++i) {
        const unsigned p = 4 * i;
        const unsigned q = 4 * ((i + 1) % unsigned(facets));
        quad(p, p + 1, q + 1, q);
        quad(q + 2, q + 3, p + 3, p + 2);
        quad(p + 1, p + 3, q + 3, q + 1);
        quad(q, q + 2, p + 2, p);
    }
    data->parts = {{0, std::uint32_t(data->indices.size())}};
    return {data};
}

TEST(Slabs, FlatPanesOfSolidGlass) {
    EXPECT_NEAR(thickness_of(Box{{1.2F, 0.8F, 0.006F}}), 0.006F, 1e-5F);
    EXPECT_NEAR(thickness_of(Cylinder{0.5F, 0.02F, true}), 0.02F, 1e-4F) << "a round table top";
    Transform placed;
    placed.translation = {40, 3, -70};
    placed.rotation = glm::normalize(dquat(0.9, 0.2, -0.3, 0.1));
    placed.scale = {1.0, 2.0, 0.5};
    EXPECT_NEAR(thickness_of(Box{{1.2F, 0.8F, 0.02F}}, placed), 0.01F, 1e-4F) << "as placed, not as modelled";
    placed.scale.x = -1.0;
    EXPECT_NEAR(thickness_of(Box{{1.2F, 0.8F, 0.02F}}, placed), 0.01F, 1e-4F) << "mirrored";
}

TEST(Slabs, BlocksBallsAndShellsAreNone) {
    EXPECT_EQ(thickness_of(Box{vec3(0.05F)}), 0.0F) << "as thick as wide";
    EXPECT_EQ(thickness_of(Box{{2, 2, 0.1F}}), 0.0F) << "too thick to look through straight";
    EXPECT_EQ(thickness_of(Sphere{0.02F}), 0.0F);
    EXPECT_EQ(thickness_of(Sphere{2.0F}), 0.0F);
    EXPECT_EQ(thickness_of(Cylinder{0.02F, 1.0F, true}), 0.0F) << "a rod";
    EXPECT_EQ(thickness_of(tube(0.1F, 0.097F, 0.3F, 48)), 0.0F) << "a vase";
    EXPECT_EQ(thickness_of(Polygon{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {}}), 0.0F) << "no other face";
    Transform wedge;
    wedge.rotation = glm::angleAxis(radians_from_degrees(30), dvec3(0, 0, 1));
    EXPECT_EQ(thickness_of(Cylinder{0.05F, 0.2F, false}, wedge), 0.0F);
    Material other = clear_glass(0.01F);
    other.roughness = 0.3F;
    EXPECT_EQ(thickness_of(Box{{1, 1, 0.01F}}, {}, other), 0.0F) << "frosted";
    EXPECT_EQ(thickness_of(Box{{1, 1, 0.01F}}, {}, clear_glass(0.0F)), 0.0F) << "a sheet, each face by itself";
    EXPECT_EQ(thickness_of(Box{{1, 1, 0.01F}}, {}, Material{}), 0.0F) << "no glass";
}

Rgb straight(const Geometry& geometry, const Material& m, bool occluded, float degrees = 0.0F) {
    Scene scene;
    add(scene, geometry, m);
    const RayScene rays(scene);
    const float a = float(radians_from_degrees(degrees));
    const vec3 d(std::sin(a), 0.0F, -std::cos(a));
    const vec3 middle = vec3(0.03F, 0.02F, 0.0F) - vec3(rays.origin());
    EXPECT_EQ(rays.occluded(middle - d, middle + d), occluded);
    const Rgb out = rays.transmittance(middle - d, middle + d);
    EXPECT_LT(glm::length(out - rays.transmittance_to_infinity(middle - d, d)), 1e-6F);
    std::array<SkyRay, 1> sky;
    rays.look_at_sky(middle - d, {&d, 1}, sky);
    EXPECT_LT(glm::length(out - sky[0].through), 1e-6F);
    EXPECT_EQ(std::isfinite(sky[0].first_pane), !occluded);
    const Hit hit = rays.nearest({middle - d, d});
    EXPECT_EQ(max_component(rays.straight_through(hit, d)) > 0.0F, !occluded);
    return out;
}

TEST(Slabs, LightGoesStraightThroughPanesAndThroughNoOtherGlass) {
    const float face = 0.04F;
    const Polygon sheet{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {}};
    EXPECT_NEAR(straight(sheet, clear_glass(0), false).g, (1 - face) / (1 + face), 1e-5F);
    EXPECT_NEAR(straight(Box{{2, 2, 0.01F}}, clear_glass(0.01F), false).g, (1 - face) * (1 - face), 1e-5F);
    EXPECT_EQ(straight(Sphere{0.5F}, clear_glass(0.5F), true), Rgb(0.0F));
    EXPECT_EQ(straight(Box{vec3(0.5F)}, clear_glass(0.5F), true), Rgb(0.0F));
    for (const float thickness : {0.0F, 0.01F}) {
        Material frosted = clear_glass(thickness);
        frosted.roughness = 0.2F;
        EXPECT_EQ(straight(sheet, frosted, true), Rgb(0.0F));
        EXPECT_EQ(straight(Box{{2, 2, 0.01F}}, frosted, true), Rgb(0.0F));
    }
}

TEST(Slabs, AbsorbAlongTheBentWay) {
    Material m = clear_glass(0.02F);
    m.attenuation_color = Rgb(0.5F, 0.25F, 1.0F);
    m.attenuation_distance = 0.02F;
    const Rgb down = straight(Box{{2, 2, 0.02F}}, m, false);
    EXPECT_NEAR(down.r / down.b, 0.5F, 1e-4F);
    EXPECT_NEAR(down.g / down.b, 0.25F, 1e-4F);
    const Rgb aslant = straight(Box{{2, 2, 0.02F}}, m, false, 60.0F);
    const double path = 1.0 / std::cos(std::asin(std::sin(radians_from_degrees(60)) / 1.5));
    EXPECT_NEAR(aslant.r / aslant.b, std::pow(0.5, path), 1e-3);
    const double face = 0.089186713; // of n = 1.5 at 60 degrees
    EXPECT_NEAR(aslant.b, (1 - face) * (1 - face), 1e-4);
}

TEST(Slabs, CurtainsStillLetLightThrough) {
    Material cloth;
    cloth.base_color = Rgb(0.8F);
    cloth.transmission = 0.3F;
    cloth.roughness = 0.9F;
    Scene scene;
    add(scene, Polygon{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {}}, cloth);
    const RayScene rays(scene);
    EXPECT_NEAR(rays.transmittance(vec3(0.1F, 0.2F, 1), vec3(0.1F, 0.2F, -1)).g, 0.3F * 0.8F * 0.96F / 1.04F, 1e-5F);
}

} // namespace
} // namespace atrium
