// A ray scene whose objects were moved in place answers as one that is built anew.
#include "engine/base/float_traps.h"
#include "engine/raycast/ray_scene.h"
#include "engine/scene/scene_edit.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <functional>
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

void expect_lists_what_moved(const std::vector<RaySurface>& before, const std::vector<RaySurface>& after,
                             const std::vector<MovedSurface>& moved) {
    const auto bounds = [](const RaySurface& s) {
        Box3 out;
        for (const uvec3& t : s.triangles) {
            for (int k = 0; k < 3; ++k) {
                out.add((*s.positions)[t[k]]);
            }
        }
        return out;
    };
    const auto same = [](const Box3& a, const Box3& b) { return a.min == b.min && a.max == b.max; };
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < before.size(); ++i) {
        const bool listed = next < moved.size() && moved[next].surface == i;
        EXPECT_EQ(listed, before[i].to_engine != after[i].to_engine);
        EXPECT_EQ(listed, before[i].positions != after[i].positions) << "a new vector";
        if (listed) {
            EXPECT_TRUE(same(moved[next].before, bounds(before[i])));
            EXPECT_TRUE(same(moved[next].after, bounds(after[i])));
            ++next;
        }
    }
    EXPECT_EQ(next, moved.size());
}

TEST(RaySceneMove, AnswersAsOneThatIsBuiltAnew) {
    for (const unsigned seed : {1U, 2U}) {
        Random random(seed);
        RayScene rays(random.scene);
        const RaySurface* first = rays.surfaces().data();
        const Material* material = &rays.material(0);
        for (int move = 0; move < 30; ++move) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", move " << move);
            random.move_one();
            if (move % 7 == 0) {
                random.move_one();
            }
            const std::vector<RaySurface> before = rays.surfaces();
            const auto moved = rays.move_to(random.scene);
            ASSERT_TRUE(moved);
            EXPECT_EQ(rays.surfaces().data(), first);
            EXPECT_EQ(&rays.material(0), material);
            expect_lists_what_moved(before, rays.surfaces(), *moved);
            if (move % 16 == 12) {
                rays.settle();
            }
            const RayScene fresh(random.scene);
            expect_same_surfaces(rays, fresh);
            expect_same_answers(rays, fresh, random, move % 10 == 0 ? 2000 : 200);
            if (testing::Test::HasFailure()) {
                return;
            }
        }
    }
}

TEST(RaySceneMove, ManyTrianglesThatMovedOneAfterTheOtherAreBuiltIn) {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    add_rectangle(scene, "below", {0, -20, 0}, {0, 1, 0}, {1, 0, 0}, 40, 40, m);
    add_rectangle(scene, "above", {0, 20, 0}, {0, -1, 0}, {1, 0, 0}, 40, 40, m);
    Shape ball;
    ball.geometry = Sphere{0.4F};
    const ShapeId shape = scene.shapes.insert(ball);
    std::vector<NodeId> balls;
    for (int i = 0; i < 12; ++i) {
        Node node;
        node.shape = shape;
        node.materials = {m};
        node.transform.translation = {0.9 * (i % 4) - 1.5, 0.9 * (i / 4) - 1.0, 0.0};
        scene.roots.push_back(scene.nodes.insert(node));
        balls.push_back(scene.roots.back());
    }
    RayScene rays(scene);
    const std::size_t built = rays.memory_bytes();
    Random random(7);
    std::size_t most = 0;
    for (const NodeId id : balls) {
        for (int step = 0; step < 3; ++step) {
            scene.nodes.find(id)->transform.translation.z += 0.11;
            ASSERT_TRUE(rays.move_to(scene));
            most = std::max(most, rays.memory_bytes());
            expect_same_answers(rays, RayScene(scene), random, 100);
        }
    }
    EXPECT_GT(most, built);
    EXPECT_LT(most, 3 * built) << "what moved does not pile up";
    rays.settle();
    EXPECT_LT(double(rays.memory_bytes()), 1.05 * double(built)) << "as if it never moved";
}

// What rays met before the moves is still known, and where they may meet something else now.
TEST(RaySceneMove, LooksBack) {
    Random r(7);
    RayScene scene(r.scene);
    std::vector<Ray> rays;
    for (int i = 0; i < 4000; ++i) {
        rays.push_back({r.point(4.0), glm::normalize(r.point(1.0) + vec3(1e-3F))});
    }
    std::vector<Hit> first;
    for (const Ray& ray : rays) {
        first.push_back(scene.nearest(ray));
    }
    int moves = 0;
    for (int i = 0; i < 12; ++i) {
        r.move_one();
        moves += scene.move_to(r.scene) ? 1 : 0;
        ASSERT_TRUE(scene.look_back());
    }
    ASSERT_GT(moves, 3);
    int changed = 0, told = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit before = scene.nearest_before(rays[i]);
        const Hit now = scene.nearest(rays[i]);
        EXPECT_EQ(before.surface, first[i].surface);
        if (before && first[i].surface == before.surface) {
            EXPECT_EQ(before.triangle, first[i].triangle);
            EXPECT_EQ(before.t, first[i].t);
            EXPECT_EQ(before.front, first[i].front);
            EXPECT_LT(glm::length(before.geometric_normal - first[i].geometric_normal), 1e-4F);
        }
        const bool differs = now.surface != before.surface || now.t != before.t;
        changed += differs ? 1 : 0;
        told += scene.meets_moved(rays[i]) ? 1 : 0;
        EXPECT_TRUE(!differs || scene.meets_moved(rays[i]));
    }
    EXPECT_GT(changed, 100);
    EXPECT_LT(told, 2500) << "most rays have nothing to do with what moved";
    scene.settle();
    EXPECT_FALSE(scene.meets_moved(rays.front()));
}

TEST(RaySceneMove, NothingDiffers) {
    Random random(4);
    RayScene rays(random.scene);
    const auto moved = rays.move_to(random.scene);
    ASSERT_TRUE(moved);
    EXPECT_TRUE(moved->empty());
    random.scene.name = "another";
    random.scene.nodes.find(random.movable[0])->name = "another";
    random.scene.settings.seed = 7;
    add_point_light(random.scene, {0, 1, 0}, 100);
    EXPECT_TRUE(rays.move_to(random.scene)) << "rays meet neither names nor lights";
    random.scene.nodes.find(random.movable[1])->transform.translation.x += 1.0;
    EXPECT_TRUE(rays.move_to(random.scene)) << "with a node that was not there when the rays were built";
    expect_same_surfaces(rays, RayScene(random.scene));
}

TEST(RaySceneMove, GroupsThatComeAndGoOnlyPlace) {
    Random random(5);
    RayScene rays(random.scene);
    Scene& scene = random.scene;
    Node group;
    group.transform.translation = {0.2, 0.1, -0.3};
    const NodeId inner = scene.roots.back();
    scene.roots.pop_back();
    group.children = {inner};
    const NodeId id = scene.nodes.insert(group);
    scene.nodes.find(inner)->parent = id;
    scene.roots.push_back(id);
    for (int i = 0; i < 3; ++i) {
        const auto moved = rays.move_to(scene);
        ASSERT_TRUE(moved);
        EXPECT_FALSE(moved->empty());
        const RayScene fresh(scene);
        expect_same_surfaces(rays, fresh);
        expect_same_answers(rays, fresh, random, 200);
        scene.nodes.find(id)->transform.translation.x += 0.2;
    }
}

// Hidden or taken out of the tree: rays pass as if it had never been there. Back again, here or elsewhere, all is as if
// built so.
TEST(RaySceneMove, WhatGoesIsNotThereUntilItComesBack) {
    for (const bool hide : {true, false}) {
        Random random(6);
        const Scene original = random.scene;
        const NodeId gone = random.movable[0];
        RayScene rays(random.scene);
        if (hide) {
            random.scene.nodes.find(gone)->visible = false;
        } else {
            const auto removed = apply(random.scene, SceneEdit{RemoveNode{gone}});
            ASSERT_TRUE(removed);
        }
        const auto moved = rays.move_to(random.scene);
        ASSERT_TRUE(moved);
        ASSERT_FALSE(moved->empty());
        for (const MovedSurface& m : *moved) {
            EXPECT_TRUE(m.came_or_went && m.absent && m.shown_before());
            EXPECT_TRUE(rays.absent(m.surface));
        }
        const RayScene fresh(random.scene);
        ASSERT_EQ(rays.origin(), fresh.origin());
        EXPECT_EQ(rays.bounds().min, fresh.bounds().min);
        EXPECT_EQ(rays.bounds().max, fresh.bounds().max);
        int differ = 0;
        for (int i = 0; i < 2000; ++i) {
            const vec3 from = random.point(3.0);
            const vec3 to = random.point(2.0);
            const Ray ray{from, glm::normalize(to - from)};
            const Hit a = rays.nearest(ray);
            const Hit b = fresh.nearest(ray);
            differ += bool(a) != bool(b) || a.t != b.t ||
                      (b && rays.surfaces()[a.surface].node != fresh.surfaces()[b.surface].node);
            differ += rays.transmittance(from, to) != fresh.transmittance(from, to);
        }
        EXPECT_EQ(differ, 0);
        EXPECT_TRUE(rays.move_to(random.scene)->empty()) << "it is gone already";
        random.scene = original;
        random.scene.nodes.find(gone)->transform.translation.x += 0.2;
        const auto back = rays.move_to(random.scene);
        ASSERT_TRUE(back);
        for (const MovedSurface& m : *back) {
            EXPECT_TRUE(m.came_or_went && !m.absent && !m.shown_before());
            EXPECT_FALSE(rays.absent(m.surface));
        }
        const RayScene again(random.scene);
        expect_same_surfaces(rays, again);
        expect_same_answers(rays, again, random, 500);
    }
}

TEST(RaySceneMove, RefusesWhatIsMoreThanAMove) {
    const FloatTrapsOff no_number_on_purpose;
    using Change = std::function<void(Random&, Node&)>;
    const std::vector<std::pair<const char*, Change>> changes = {
        {"another shape",
         [](Random& r, Node& n) {
             Shape other;
             other.geometry = Sphere{0.1F};
             n.shape = r.scene.shapes.insert(other);
         }},
        {"another size",
         [](Random& r, Node& n) {
             r.scene.shapes.find(n.shape)->geometry = Box{{0.1F, 0.2F, 0.3F}};
         }},
        {"another material", [](Random&, Node& n) { n.materials = {}; }},
        {"a material's colour",
         [](Random& r, Node& n) { r.scene.materials.find(n.materials[0])->base_color = Rgb(0.123F); }},
        {"a texture",
         [](Random& r, Node&) {
             r.scene.textures.for_each([&](TextureId id, const Texture&) { r.scene.textures.find(id)->nearest = true; });
         }},
        {"new",
         [](Random& r, Node& n) {
             const Node copy = n;
             r.scene.roots.push_back(r.scene.nodes.insert(copy));
         }},
        {"other order", [](Random& r, Node&) { std::swap(r.scene.roots[0], r.scene.roots[1]); }},
        {"mirrored", [](Random&, Node& n) { n.transform.scale.x *= -1.0; }},
        {"flat",
         [](Random&, Node& n) {
             n.transform.scale = {0.0, 0.0, 1.0};
         }},
        {"no number", [](Random&, Node& n) { n.transform.translation.y = std::nan(""); }},
        {"far away, so that all is small beside the whole", [](Random&, Node& n) { n.transform.translation.x = 1e6; }},
    };
    for (const auto& [name, change] : changes) {
        SCOPED_TRACE(name);
        Random random(6);
        // A ball, which is a solid, too large here for its inside to stay dark.
        Shape shape;
        shape.geometry = Sphere{12.0F};
        Node large;
        large.shape = random.scene.shapes.insert(shape);
        random.scene.materials.for_each([&](MaterialId id, const Material& m) {
            if (m.double_sided) {
                large.materials = {id};
            }
        });
        random.scene.roots.insert(random.scene.roots.begin(), random.scene.nodes.insert(large));
        NodeId changed;
        for (const NodeId id : random.scene.roots) {
            const Node& n = *random.scene.nodes.find(id);
            changed = n.shape && !n.materials.empty() ? id : changed;
        }
        RayScene rays(random.scene);
        const Scene original = random.scene;
        random.scene.nodes.find(random.movable[0])->transform.translation.x += 0.3;
        change(random, *random.scene.nodes.find(changed));
        EXPECT_FALSE(rays.move_to(random.scene));
        const RayScene fresh(original);
        expect_same_surfaces(rays, fresh);
        expect_same_answers(rays, fresh, random, 100);
        // And it still takes what it can.
        random.scene = original;
        random.scene.nodes.find(changed)->transform.translation.x += 0.3;
        EXPECT_TRUE(rays.move_to(random.scene));
        expect_same_surfaces(rays, RayScene(random.scene));
    }
}

// Surfaces stand in another order than in a scene that is built anew, but rays meet the same things.
void expect_same_but_order(const RayScene& moved, const RayScene& fresh, Random& random, int rays) {
    EXPECT_EQ(moved.bounds().min, fresh.bounds().min);
    EXPECT_EQ(moved.bounds().max, fresh.bounds().max);
    int differ = 0;
    for (int i = 0; i < rays; ++i) {
        const vec3 from = random.point(3.0);
        const vec3 to = random.point(2.0);
        const vec3 direction = glm::normalize(to - from);
        const Hit a = moved.nearest({from, direction});
        const Hit b = fresh.nearest({from, direction});
        differ += bool(a) != bool(b);
        differ += moved.transmittance(from, to) != fresh.transmittance(from, to);
        if (!a || !b) {
            continue;
        }
        const RaySurface& of_a = moved.surfaces()[a.surface];
        const RaySurface& of_b = fresh.surfaces()[b.surface];
        differ += of_a.node != of_b.node || of_a.part != of_b.part || of_a.back_side != of_b.back_side ||
                  of_a.pane != of_b.pane || a.triangle != b.triangle || a.t != b.t || a.front != b.front;
        differ += !(moved.material(a.surface) == fresh.material(b.surface));
        differ +=
            moved.base_color(a.surface, a.triangle, a.barycentric) != fresh.base_color(b.surface, b.triangle, b.barycentric);
        differ += moved.absent(a.surface);
    }
    EXPECT_EQ(differ, 0);
}

// Things that are new, stretched, given another shape or material, taken away and put back: added behind all others.
TEST(RaySceneMove, TakesNewThings) {
    for (const unsigned seed : {11U, 12U, 13U}) {
        Random r(seed);
        RayScene rays(r.scene);
        std::vector<std::pair<NodeId, Node>> gone;
        for (int step = 0; step < 24; ++step) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", step " << step);
            const NodeId some = r.movable[r.random() % r.movable.size()];
            Node* node = r.scene.nodes.find(some);
            const Node first = *r.scene.nodes.find(r.scene.roots.front());
            switch (step % 6) {
            case 0: { // with a material that was not there
                Material m;
                m.base_color = Rgb(float(r.number(0.1, 0.9)));
                m.double_sided = true;
                Shape shape;
                shape.geometry = Sphere{float(r.number(0.2, 0.5))};
                Node added;
                added.shape = r.scene.shapes.insert(shape);
                added.materials = {r.scene.materials.insert(m)};
                added.transform = r.anywhere();
                const NodeId id = r.scene.nodes.insert(added);
                r.scene.roots.insert(r.scene.roots.begin() + std::ptrdiff_t(r.random() % r.scene.roots.size()), id);
                break;
            }
            case 1: node->transform.scale *= dvec3(r.number(0.8, 1.2), 1.0, r.number(0.8, 1.2)); break;
            case 2: node->visible = !node->visible; break;
            case 3: node->materials = {first.materials[0], first.materials[0]}; break;
            case 4: r.move_one(); break;
            default: // the last one that was added goes, with what only it had
                for (const NodeId id : std::vector<NodeId>(r.scene.roots)) {
                    if (const Node& n = *r.scene.nodes.find(id); n.children.empty() && id.slot > 42 && gone.size() < 3) {
                        gone.emplace_back(id, n);
                        r.scene.materials.erase(n.materials[0]);
                        r.scene.shapes.erase(n.shape);
                        r.scene.nodes.erase(id);
                        std::erase(r.scene.roots, id);
                        break;
                    }
                }
            }
            ASSERT_TRUE(rays.move_to(r.scene, NewThings::Append));
            expect_same_but_order(rays, RayScene(r.scene), r, 300);
        }
        const std::size_t before = rays.surfaces().size();
        const auto nothing = rays.move_to(r.scene, NewThings::Append);
        ASSERT_TRUE(nothing);
        EXPECT_TRUE(nothing->empty());
        EXPECT_EQ(rays.surfaces().size(), before);
    }
}

// What comes back is the very thing that went, and what is stretched and stretched back too: nothing piles up.
TEST(RaySceneMove, NewThingsThatComeBackAreNotAddedAgain) {
    Random r(14);
    RayScene rays(r.scene);
    const std::size_t built = rays.surfaces().size();
    Material m;
    Shape shape;
    shape.geometry = Box{vec3(0.3F)};
    Node node;
    node.shape = r.scene.shapes.insert(shape);
    node.materials = {r.scene.materials.insert(m)};
    const NodeId id = r.scene.nodes.insert(node);
    const Scene without = r.scene;
    r.scene.roots.push_back(id);
    const Scene with = r.scene;
    auto moved = rays.move_to(with, NewThings::Append);
    ASSERT_TRUE(moved);
    ASSERT_EQ(moved->size(), 1U);
    EXPECT_TRUE(moved->front().added);
    EXPECT_TRUE(moved->front().before.empty());
    EXPECT_FALSE(moved->front().shown_before());
    EXPECT_EQ(rays.surfaces().size(), built + 1);
    ASSERT_TRUE(rays.look_back());
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(rays.move_to(without, NewThings::Append));
        EXPECT_TRUE(rays.absent(std::uint32_t(built)));
        moved = rays.move_to(with, NewThings::Append);
        ASSERT_TRUE(moved);
        ASSERT_EQ(moved->size(), 1U);
        EXPECT_FALSE(moved->front().added) << "it is known";
    }
    EXPECT_EQ(rays.surfaces().size(), built + 1);
    Scene larger = with;
    larger.nodes.find(id)->transform.scale = dvec3(1.5);
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(rays.move_to(larger, NewThings::Append));
        EXPECT_TRUE(rays.absent(std::uint32_t(built)));
        ASSERT_TRUE(rays.move_to(with, NewThings::Append));
        EXPECT_FALSE(rays.absent(std::uint32_t(built)));
    }
    EXPECT_EQ(rays.surfaces().size(), built + 2);
    // Looking back it was never there.
    const RayScene first(without);
    for (int i = 0; i < 500; ++i) {
        const Ray ray{r.point(3.0), glm::normalize(r.point(1.0) + vec3(1e-3F))};
        EXPECT_EQ(rays.nearest_before(ray).surface, first.nearest(ray).surface);
    }
}

// A sheet of glass that becomes too thick for a pane stops light from then on, and the other way.
TEST(RaySceneMove, ScaleMakesPanesAndUndoesThem) {
    Scene scene;
    add_rectangle(scene, "below", {0, -20, 0}, {0, 1, 0}, {1, 0, 0}, 40, 40, add_material(scene, 0.5F));
    add_rectangle(scene, "above", {0, 20, 0}, {0, -1, 0}, {1, 0, 0}, 40, 40, add_material(scene, 0.5F));
    Material glass;
    glass.transmission = 1.0F;
    glass.roughness = 0.0F;
    glass.thickness = 0.01F;
    Shape shape;
    shape.geometry = Box{{1.0F, 1.0F, 0.02F}};
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = {scene.materials.insert(glass)};
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    RayScene rays(scene);
    const vec3 from(0.1F, 0.2F, 3.0F);
    const vec3 to(0.1F, 0.2F, -3.0F);
    for (int round = 0; round < 2; ++round) {
        scene.nodes.find(id)->transform.scale = {1.0, 1.0, 1.0};
        ASSERT_TRUE(rays.move_to(scene));
        EXPECT_TRUE(rays.surfaces()[2].slab && rays.surfaces()[2].pane);
        EXPECT_GT(rays.transmittance(from, to).g, 0.5F);
        scene.nodes.find(id)->transform.scale = {1.0, 1.0, 10.0};
        ASSERT_TRUE(rays.move_to(scene));
        EXPECT_FALSE(rays.surfaces()[2].slab || rays.surfaces()[2].pane);
        EXPECT_TRUE(rays.occluded(from, to));
        scene.nodes.find(id)->transform.scale = {0.2, 0.2, 1.0};
        ASSERT_TRUE(rays.move_to(scene));
        EXPECT_TRUE(rays.surfaces()[2].slab && !rays.surfaces()[2].pane);
    }
}

} // namespace
} // namespace atrium
