// Solution::insides and what engine/debug tells of it: elements, links, ways of particles, what an update changed.
#include "engine/debug/element_view.h"
#include "engine/debug/octree_view.h"
#include "engine/debug/particle_view.h"
#include "engine/debug/update_view.h"
#include "engine/solver/gi_engine.h"
#include "engine/solver/insides.h"
#include "tests/support/moving_caustics.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include <map>

namespace atrium {
namespace {

using namespace test;

SolveOptions looked_at() {
    SolveOptions options;
    options.quality = SolverSettings::Quality::Draft;
    options.keep_for_updates = true;
    options.keep_insides = true;
    return options;
}

std::shared_ptr<const Solution> solve(GiEngine& engine, const Scene& scene, const SolveOptions& options) {
    auto r = engine.solve(scene, options, {});
    return r ? *r : nullptr;
}

double area_of(const std::array<vec3, 3>& t) { return 0.5 * double(glm::length(glm::cross(t[1] - t[0], t[2] - t[0]))); }

TEST(Insides, ElementsCoverEverySideThatIsLitAndNothingElse) {
    Scene scene;
    const MaterialId grey = add_material(scene, 0.5F);
    add_room(scene, 4, 3, 5, grey);
    add_point_light(scene, {1.0, 2.5, 1.2}, 2000.0);
    Shape shape; // an L: cells that its rectangle has and it has not are no elements
    shape.geometry = Polygon{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}};
    Node node;
    node.name = "L";
    node.shape = scene.shapes.insert(shape);
    node.materials = {grey};
    node.transform.translation = {1.0, 0.5, 2.0};
    const NodeId corner = scene.nodes.insert(node);
    scene.roots.push_back(corner);
    GiEngine engine;
    const auto solution = solve(engine, scene, looked_at());
    ASSERT_TRUE(solution && solution->insides);
    const auto view = view_elements(*solution);
    ASSERT_TRUE(view);
    std::map<std::string, double> area;
    for (const SurfaceElements& s : view->surfaces) {
        for (std::size_t i = 0; i < s.triangles.size(); ++i) {
            const auto& t = s.triangles[i];
            EXPECT_NEAR(t[0].z, 0.0, 1e-4) << "node coordinates of a polygon";
            if (glm::cross(t[1] - t[0], t[2] - t[0]).z > 0.0F) { // its front
                area[scene.nodes.find(s.node)->name] += area_of(t);
            }
        }
        for (std::size_t i = 0; i < s.lines.size(); ++i) {
            EXPECT_NEAR(std::abs(s.line_normal[i].z), 1.0, 1e-4);
        }
    }
    EXPECT_NEAR(area["floor"], 20.0, 1e-3);
    EXPECT_NEAR(area["wall x1"], 15.0, 1e-3);
    EXPECT_NEAR(area["L"], 3.0, 1e-3);
    double all = 0.0;
    for (const LeafFigures& leaf : view->leaves) {
        all += double(leaf.area);
    }
    EXPECT_GT(view->leaves.size(), 50U);
    EXPECT_NEAR(all, 2.0 * (20.0 + 15.0 + 12.0) + 2.0 * 3.0, 6.5) << "one-sided or two-sided, but no more than that";
    // The leaf at a point is the one whose triangles hold it.
    for (const SurfaceElements& s : view->surfaces) {
        for (std::size_t i = 0; i < s.triangles.size(); i += 7) {
            const auto& t = s.triangles[i];
            const bool back = glm::cross(t[1] - t[0], t[2] - t[0]).z < 0.0F;
            const auto found = leaf_at(*solution, s.node, s.part, (t[0] + t[1] + t[2]) / 3.0F, back);
            ASSERT_TRUE(found);
            EXPECT_EQ(*found, s.triangle_leaf[i]);
        }
    }
    EXPECT_FALSE(leaf_at(*solution, corner, 0, {1.5F, 1.5F, 0.0F}, false)) << "beside the L";
}

TEST(Insides, LinksOfAFurnaceBringItsLight) {
    // All walls send out M and reflect rho: everywhere B = E rho + M and E = B, so E = M / (1 - rho).
    Scene scene;
    add_room(scene, 3, 3, 3, add_material(scene, 0.5F, 100.0F));
    GiEngine engine;
    const auto solution = solve(engine, scene, looked_at());
    ASSERT_TRUE(solution && solution->insides);
    const auto view = view_elements(*solution);
    const NodeId floor = scene.roots[0];
    const auto leaf = leaf_at(*solution, floor, 0, {0.3F, -0.4F, 0.0F}, false);
    ASSERT_TRUE(leaf);
    const ElementLinks links = links_of(*solution, *leaf);
    EXPECT_EQ(links.links.size(), view->leaves[*leaf].links);
    EXPECT_NEAR(links.over_links, 200.0, 2.0);
    EXPECT_EQ(links.direct, 0.0);
    double share = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < links.links.size(); ++i) {
        share += links.links[i].share;
        sum += links.links[i].brings;
        EXPECT_TRUE(i == 0 || links.links[i - 1].brings >= links.links[i].brings);
        EXPECT_NE(links.links[i].end.node, floor) << "a flat floor does not see itself";
        EXPECT_FALSE(links.links[i].end.outline.empty());
    }
    EXPECT_NEAR(share, 1.0, 1e-9);
    EXPECT_NEAR(sum, links.over_links, 1e-9);
    EXPECT_NEAR(links.receiver.centre.y, 0.0, 1e-6);
    EXPECT_NEAR(links.open, 0.0, 1e-3) << "the room is closed";
}

TEST(Insides, AreThereWhenAskedForAndCostNoRays) {
    Scene scene;
    add_room(scene, 4, 3, 4, add_material(scene, 0.6F));
    const NodeId box = test::add_shape(scene, Box{vec3(0.4F)}, {1.0, 0.21, 1.0}, add_material(scene, 0.4F));
    add_point_light(scene, {2.0, 2.5, 2.0}, 2000.0);
    GiEngine engine;
    SolveOptions options = looked_at();
    options.keep_insides = false;
    const auto plain = solve(engine, scene, options);
    ASSERT_TRUE(plain);
    EXPECT_FALSE(plain->insides);
    EXPECT_FALSE(view_elements(*plain));
    EXPECT_FALSE(leaf_at(*plain, scene.roots[0], 0, vec3(0.0F), false));
    options.keep_insides = true;
    const auto told = solve(engine, scene, options);
    ASSERT_TRUE(told && told->insides);
    EXPECT_EQ(told->surfaces, plain->surfaces) << "nothing is computed anew";
    scene.nodes.find(box)->transform.translation.x += 0.4;
    const auto hurried = engine.update(scene, options, {});
    ASSERT_TRUE(hurried);
    EXPECT_EQ((*hurried)->insides, told->insides) << "a hand does not wait for copies";
    options.settle = true;
    const auto settled = engine.update(scene, options, {});
    ASSERT_TRUE(settled && (*settled)->insides);
    EXPECT_NE((*settled)->insides, told->insides);
    options.keep_insides = false;
    const auto without = engine.update(scene, options, {});
    ASSERT_TRUE(without);
    EXPECT_FALSE((*without)->insides);
}

TEST(Insides, WaysOfParticlesGoFromTheLampOverTheBallToWhereTheyLand) {
    Scene scene;
    const MaterialId matt = add_material(scene, 0.6F);
    const NodeId floor = add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4.0F, 4.0F, matt);
    const NodeId far_floor = add_rectangle(scene, "shelf", {0, -5, 0}, {0, 1, 0}, {1, 0, 0}, 0.1F, 0.1F, matt);
    const dvec3 centre(0.3, 0.6, -0.2);
    const NodeId ball = test::add_shape(scene, Sphere{0.3F}, centre, add_specular(scene, false));
    const dvec3 lamp(-0.8, 1.6, 0.5);
    add_point_light(scene, lamp, 3000.0);
    GiEngine engine;
    const auto solution = solve(engine, scene, looked_at());
    ASSERT_TRUE(solution && solution->insides);
    for (const NodeId of : {floor, ball}) {
        const ParticleView view = view_particles(*solution, {of});
        ASSERT_GT(view.ways.size(), 50U);
        ASSERT_LE(view.ways.size(), Insides::kWays);
        EXPECT_GT(view.particles, view.ways.size());
        std::size_t from_lamp = 0;
        for (const ParticlePolyline& way : view.ways) {
            ASSERT_EQ(way.points.size(), 3U) << "one reflection on a convex mirror";
            if (glm::length(way.points[0] - lamp) < 1e-3) {
                ++from_lamp;
            } else {
                EXPECT_NEAR(way.points[0].y, 0.0, 1e-3) << "the lit floor sends some too";
            }
            const dvec3 radius = way.points[1] - centre;
            EXPECT_NEAR(glm::length(radius), 0.3, 0.003) << "on the facets of the ball";
            EXPECT_NEAR(way.points[2].y, 0.0, 1e-3);
            // Mirrored about the normal, as far as facets have that of the ball.
            const dvec3 in = glm::normalize(way.points[1] - way.points[0]),
                        out = glm::normalize(way.points[2] - way.points[1]);
            EXPECT_GT(glm::dot(glm::reflect(in, glm::normalize(radius)), out), 0.99);
            EXPECT_GT(luminance(way.power), 0.0F);
        }
        EXPECT_GT(from_lamp, 50U);
    }
    EXPECT_TRUE(view_particles(*solution, {far_floor}).ways.empty());
    EXPECT_EQ(view_particles(*solution, {floor}, 20).ways.size(), 20U);
    EXPECT_EQ(view_particles(*solution, {}).passage_cells, 0U) << "the editor's solutions have no octree";
}

TEST(Insides, TheOctreeAroundAnObjectHoldsWhatCrossesIt) {
    Scene scene;
    const MaterialId matt = add_material(scene, 0.6F);
    add_rectangle(scene, "floor", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4.0F, 4.0F, matt);
    const NodeId shelf = add_rectangle(scene, "shelf", {0, -5, 0}, {0, 1, 0}, {1, 0, 0}, 0.1F, 0.1F, matt);
    const dvec3 centre(0.3, 0.6, -0.2);
    const NodeId ball = test::add_shape(scene, Sphere{0.3F}, centre, add_specular(scene, false));
    const NodeId group = scene.nodes.insert(Node{});
    scene.roots.push_back(group);
    add_point_light(scene, {-0.8, 1.6, 0.5}, 3000.0);
    GiEngine engine;
    const auto solution = solve(engine, scene, looked_at());
    ASSERT_TRUE(solution && solution->insides && solution->insides->paths);
    const OctreeView view = view_octree(*solution, {ball});
    EXPECT_EQ(view.particles, solution->insides->paths->size());
    EXPECT_GT(view.touched, 1000U) << "what was aimed at it";
    EXPECT_GE(view.scan, view.touched) << "each is in a cell, those on a border in two";
    ASSERT_GT(view.cells.size(), 7U);
    std::size_t fullest = 0;
    const DBox3 body{centre - 0.3, centre + 0.3};
    for (const OctreeCell& cell : view.cells) {
        fullest = std::max(fullest, cell.particles);
        EXPECT_TRUE(glm::all(glm::lessThan(cell.box.min, body.max + 1e-3)) &&
                    glm::all(glm::greaterThan(cell.box.max, body.min - 1e-3)))
            << "around it and nowhere else";
        if (cell.particles > 256) {
            EXPECT_LE(cell.box.size().x, 0.62) << "as small as what moves";
        }
    }
    EXPECT_GT(fullest, 256U);
    for (int k = 0; k < 200; ++k) { // its bounds are covered
        const dvec3 p = body.min + body.size() * dvec3((k % 5) / 4.0, (k / 5 % 5) / 4.0, (k / 25) / 7.0);
        EXPECT_TRUE(std::any_of(view.cells.begin(), view.cells.end(), [&](const OctreeCell& cell) {
            return glm::all(glm::lessThanEqual(cell.box.min, p + 1e-6)) &&
                   glm::all(glm::greaterThanEqual(cell.box.max, p - 1e-6));
        }));
    }
    // The answer of the scan, particle by particle.
    std::size_t crossing = 0;
    const Box3 wide{vec3(body.min - solution->insides->origin) - 1e-3F, vec3(body.max - solution->insides->origin) + 1e-3F};
    for (std::size_t i = 0; i < solution->insides->paths->size(); ++i) {
        crossing += solution->insides->paths->crosses(i, std::array{wide}) ? 1 : 0;
    }
    EXPECT_NEAR(double(view.touched), double(crossing), 0.01 * double(crossing)) << "a facet or two beside the sphere";
    EXPECT_EQ(view_octree(*solution, {shelf}).touched, 0U);
    EXPECT_TRUE(view_octree(*solution, {group}).cells.empty()) << "it has no surface";
    EXPECT_TRUE(view_octree(*solution, {}).cells.empty());
}

TEST(Insides, WhatAnUpdateChangedIsWhereTheLightIsAnother) {
    Scene scene;
    add_room(scene, 4, 3, 4, add_material(scene, 0.5F));
    const NodeId box = test::add_shape(scene, Box{vec3(0.4F)}, {1.0, 0.21, 1.0}, add_material(scene, 0.4F));
    add_point_light(scene, {2.0, 2.5, 2.0}, 2000.0);
    GiEngine engine;
    const auto before = solve(engine, scene, looked_at());
    ASSERT_TRUE(before);
    const UpdateView none = view_update(*before, *before);
    EXPECT_EQ(none.texels + none.vertices + none.textures, 0U);
    EXPECT_GT(none.all_texels, 0U);
    EXPECT_GT(none.all_vertices, 0U);
    scene.nodes.find(box)->transform.translation.x += 0.3;
    const auto after = engine.update(scene, looked_at(), {});
    ASSERT_TRUE(after);
    const UpdateView view = view_update(*before, **after);
    EXPECT_GT(view.texels, 0U);
    EXPECT_LT(view.texels, view.all_texels / 2) << "a small box shades little";
    std::vector<SensorPlace> places;
    for (const ChangedSurface& s : view.surfaces) {
        EXPECT_EQ(s.texels.size(), s.texel_normals.size());
        if (s.node != scene.roots[0]) {
            continue;
        }
        const dmat4 world = scene.world_matrix(s.node);
        for (const vec3& p : s.texels) {
            places.push_back({dvec3(world * dvec4(dvec3(p), 1.0)), {0, 1, 0}});
        }
    }
    ASSERT_GT(places.size(), 20U) << "the shadow on the floor";
    const auto was = read_surfaces(scene, *before, places), is = read_surfaces(scene, **after, places);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_NEAR(places[i].point.y, 0.0, 1e-4);
        differ += was[i].irradiance != is[i].irradiance ? 1 : 0;
    }
    EXPECT_GT(double(differ), 0.98 * double(places.size()));
}

} // namespace
} // namespace atrium
