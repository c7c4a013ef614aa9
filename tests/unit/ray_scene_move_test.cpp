// A ray scene whose objects were moved in place answers as one that is built anew.
#include "engine/raycast/ray_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <random>

namespace atrium {
namespace {

using namespace test;

// Opaque, glass and cut-out objects within two plates far away, which keep origin and size whatever moves between them.
struct Random {
    std::mt19937 random;
    Scene scene;
    std::vector<NodeId> movable;

    explicit Random(unsigned seed) : random(seed) {
        Material plain;
        plain.double_sided = true;
        Material clear;
        clear.transmission = 1.0F;
        clear.roughness = 0.0F;
        clear.base_color = Rgb(0.9F, 0.8F, 0.7F);
        Material solid = clear;
        solid.thickness = 0.01F;
        solid.attenuation_color = Rgb(0.5F, 0.9F, 0.6F);
        solid.attenuation_distance = 0.05F;
        Material leaves;
        leaves.alpha_mode = Material::Alpha::Mask;
        leaves.base_color_texture.texture = scene.textures.insert(holes());
        Material veil;
        veil.alpha_mode = Material::Alpha::Blend;
        veil.alpha = 0.6F;
        const std::vector<MaterialId> materials = {scene.materials.insert(plain), scene.materials.insert(clear),
                                                   scene.materials.insert(solid), scene.materials.insert(leaves),
                                                   scene.materials.insert(veil)};
        add_rectangle(scene, "below", {0, -20, 0}, {0, 1, 0}, {1, 0, 0}, 40, 40, materials[0]);
        add_rectangle(scene, "above", {0, 20, 0}, {0, -1, 0}, {1, 0, 0}, 40, 40, materials[0]);
        std::vector<ShapeId> shapes;
        for (const Geometry& geometry :
             {Geometry{Sphere{0.4F}}, Geometry{Box{{0.6F, 0.5F, 0.4F}}}, Geometry{Box{{1.0F, 0.9F, 0.01F}}},
              Geometry{Cylinder{0.2F, 0.8F}}, Geometry{Mesh{two_parts()}}, Geometry{Disc{0.5F}}}) {
            Shape shape;
            shape.geometry = geometry;
            shapes.push_back(scene.shapes.insert(shape));
        }
        for (int i = 0; i < 40; ++i) {
            Node node;
            if (i % 5 != 0) {
                node.shape = shapes[random() % shapes.size()];
                node.materials = {materials[random() % materials.size()], materials[random() % materials.size()]};
            }
            node.transform = anywhere();
            if (i % 3 == 1 && !movable.empty()) {
                node.parent = movable[random() % movable.size()];
            }
            const NodeId id = scene.nodes.insert(node);
            (node.parent ? scene.nodes.find(node.parent)->children : scene.roots).push_back(id);
            movable.push_back(id);
        }
    }

    double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }
    vec3 point(double within) {
        return vec3(dvec3(number(-within, within), number(-within, within), number(-within, within)));
    }
    dquat turn() { return glm::normalize(dquat(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1))); }
    Transform anywhere() { return {dvec3(point(1.5)), turn(), dvec3(number(0.7, 1.3), number(0.7, 1.3), number(0.7, 1.3))}; }

    NodeId move_one() {
        const NodeId id = movable[random() % movable.size()];
        Transform& t = scene.nodes.find(id)->transform;
        switch (random() % 4) {
        case 0: t.translation = dvec3(point(1.5)); break;
        case 1: t.rotation = turn(); break;
        case 2: t.scale = dvec3(number(0.5, 1.5), number(0.5, 1.5), number(0.5, 1.5)); break;
        default: t = anywhere();
        }
        return id;
    }

    static Texture holes() {
        auto image = std::make_shared<Image>();
        image->width = image->height = 8;
        image->channels = 4;
        for (int i = 0; i < 64; ++i) {
            const std::uint8_t alpha = (i / 2 + i / 16) % 2 == 0 ? 255 : 0;
            image->bytes.insert(image->bytes.end(), {200, 180, 160, alpha});
        }
        Texture out;
        out.image = image;
        return out;
    }
    // A bent sheet, its halves with materials of their own; the third part has no area.
    static std::shared_ptr<const MeshData> two_parts() {
        auto mesh = std::make_shared<MeshData>();
        mesh->positions = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {1, 0, 0.4F}, {1, 1, 0.4F}};
        mesh->texcoords0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {0, 1}};
        mesh->indices = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2, 1, 1, 2};
        mesh->parts = {{0, 6}, {6, 6}, {12, 3}};
        return mesh;
    }
};

void expect_same_surfaces(const RayScene& moved, const RayScene& fresh) {
    ASSERT_EQ(moved.origin(), fresh.origin()) << "the test needs scenes that keep their origin";
    ASSERT_EQ(moved.surfaces().size(), fresh.surfaces().size());
    EXPECT_EQ(moved.bounds().min, fresh.bounds().min);
    EXPECT_EQ(moved.bounds().max, fresh.bounds().max);
    EXPECT_EQ(moved.triangle_count(), fresh.triangle_count());
    EXPECT_EQ(moved.dropped_triangles(), fresh.dropped_triangles());
    for (std::size_t i = 0; i < fresh.surfaces().size(); ++i) {
        const RaySurface& a = moved.surfaces()[i];
        const RaySurface& b = fresh.surfaces()[i];
        ASSERT_EQ(a.node, b.node);
        ASSERT_EQ(a.part, b.part);
        EXPECT_EQ(a.material, b.material);
        EXPECT_EQ(a.triangles, b.triangles);
        EXPECT_EQ(*a.positions, *b.positions);
        EXPECT_EQ(a.to_engine, b.to_engine);
        EXPECT_EQ(a.normal_matrix, b.normal_matrix);
        EXPECT_EQ(a.mirrored, b.mirrored);
        EXPECT_EQ(a.back_side, b.back_side);
        EXPECT_EQ(a.slab, b.slab);
        EXPECT_EQ(a.slab_thickness, b.slab_thickness);
        EXPECT_EQ(a.pane, b.pane);
        EXPECT_EQ(moved.material(std::uint32_t(i)), fresh.material(std::uint32_t(i)));
    }
}

void expect_same_answers(const RayScene& moved, const RayScene& fresh, Random& random, int rays) {
    int differ = 0;
    for (int i = 0; i < rays; ++i) {
        const vec3 from = random.point(3.0);
        const vec3 to = random.point(2.0);
        const vec3 direction = glm::normalize(to - from);
        const Hit a = moved.nearest({from, direction});
        const Hit b = fresh.nearest({from, direction});
        differ += a.surface != b.surface || a.triangle != b.triangle || a.t != b.t || a.barycentric != b.barycentric ||
                  a.geometric_normal != b.geometric_normal || a.front != b.front;
        if (b) {
            differ += moved.shading_normal(a) != fresh.shading_normal(b);
            differ += moved.straight_through(a, direction) != fresh.straight_through(b, direction);
        }
        differ += moved.occluded(from, to) != fresh.occluded(from, to);
        differ += moved.transmittance(from, to) != fresh.transmittance(from, to);
        differ += moved.transmittance({from, direction, 2.0F}) != fresh.transmittance({from, direction, 2.0F});
        differ += moved.transmittance_to_infinity(from, direction) != fresh.transmittance_to_infinity(from, direction);
    }
    EXPECT_EQ(differ, 0);
    for (int i = 0; i < rays / 20; ++i) {
        const vec3 from = random.point(2.0);
        std::vector<vec3> directions(19);
        for (vec3& d : directions) { // off the plates
            d = glm::normalize(random.point(1.0) * vec3(1.0F, 0.2F, 1.0F));
        }
        std::vector<SkyRay> a(directions.size());
        std::vector<SkyRay> b(directions.size());
        moved.look_at_sky(from, directions, a);
        fresh.look_at_sky(from, directions, b);
        for (std::size_t k = 0; k < directions.size(); ++k) {
            differ += a[k].through != b[k].through || a[k].first_pane != b[k].first_pane;
        }
    }
    EXPECT_EQ(differ, 0) << "looking at the sky";
}

TEST(RaySceneMove, AnswersAsOneThatIsBuiltAnew) {
    for (const unsigned seed : {1U, 2U, 3U}) {
        Random random(seed);
        RayScene rays(random.scene);
        const RaySurface* first = rays.surfaces().data();
        for (int move = 0; move < 60; ++move) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", move " << move);
            const NodeId top = random.move_one();
            if (move % 7 == 0) {
                random.move_one();
            }
            const auto before = rays.surfaces();
            const auto moved = rays.move_to(random.scene);
            ASSERT_TRUE(moved);
            EXPECT_EQ(rays.surfaces().data(), first);
            const RayScene fresh(random.scene);
            expect_same_surfaces(rays, fresh);
            std::size_t next = 0;
            for (std::uint32_t i = 0; i < before.size(); ++i) {
                const bool listed = next < moved->size() && (*moved)[next].surface == i;
                EXPECT_EQ(listed, before[i].to_engine != rays.surfaces()[i].to_engine);
                EXPECT_EQ(listed, before[i].positions != rays.surfaces()[i].positions);
                if (!listed) {
                    continue;
                }
                Box3 was;
                Box3 is;
                for (const uvec3& t : before[i].triangles) {
                    for (int k = 0; k < 3; ++k) {
                        was.add((*before[i].positions)[t[k]]);
                        is.add((*rays.surfaces()[i].positions)[t[k]]);
                    }
                }
                EXPECT_TRUE((*moved)[next].before.min == was.min && (*moved)[next].before.max == was.max);
                EXPECT_TRUE((*moved)[next].after.min == is.min && (*moved)[next].after.max == is.max);
                ++next;
            }
            EXPECT_EQ(next, moved->size());
            static_cast<void>(top);
            expect_same_answers(rays, fresh, random, 2000);
            if (testing::Test::HasFailure()) {
                return;
            }
        }
    }
}

} // namespace
} // namespace atrium
