// Which leaves are enclosed, and which lie in rooms that no light can reach.
#include "engine/radiosity/leaf_surroundings.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace atrium {
namespace {

using namespace test;

/// Two rooms with a two-sided wall between them in which there may be a door; a glowing panel in the first.
enum class Wall { Whole, Door, Glass, Missing };
Scene two_rooms(Wall wall) {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    add_room(scene, 8, 3, 4, m);
    add_rectangle(scene, "panel", {2, 2.99, 2}, {0, -1, 0}, {1, 0, 0}, 1, 1, add_material(scene, 0.0F, 1000.0F));
    Material both;
    both.double_sided = true;
    both.transmission = wall == Wall::Glass ? 1.0F : 0.0F;
    const MaterialId material = scene.materials.insert(both);
    if (wall != Wall::Missing) {
        const NodeId id = add_rectangle(scene, "wall", {4, 1.5, 2}, {1, 0, 0}, {0, 0, 1}, 4, 3, material);
        if (wall == Wall::Door) {
            auto& polygon = std::get<Polygon>(scene.shapes.find(scene.nodes.find(id)->shape)->geometry);
            polygon.holes = {{{-0.4F, -1.4F}, {0.4F, -1.4F}, {0.4F, 0.6F}, {-0.4F, 0.6F}}};
        }
    }
    return scene;
}

struct Counts {
    int enclosed = 0, dark = 0, leaves = 0, dark_in_second = 0, in_second = 0;
};
Counts look(const Scene& scene) {
    const RayScene rays(scene);
    Hierarchy h = build_hierarchy(rays, {0.1F, 0.05F});
    // A few levels of quarters, so that floor and ceiling have leaves on either side of the wall alone.
    for (int level = 0; level < 4; ++level) {
        for (const std::uint32_t leaf : h.leaves()) {
            if (h.can_split(leaf)) {
                h.split(leaf, rays);
            }
        }
    }
    const std::vector<std::uint32_t> leaves = h.leaves();
    const LeafSurroundings around = look_around(h, rays, leaves, RunContext{});
    Counts out;
    out.leaves = int(leaves.size());
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const Element& e = h.elements[leaves[i]];
        const bool second = e.centre.x + float(rays.origin().x) > 4.3F;
        out.enclosed += around.enclosed[i];
        out.dark += around.dark[i];
        out.in_second += second ? 1 : 0;
        out.dark_in_second += second && around.dark[i] != 0 ? 1 : 0;
        h.elements[leaves[i]].radiosity = Rgb(1.0F);
    }
    h.pull_radiosity();
    darken(h, leaves, around);
    float sum = 0.0F;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        EXPECT_EQ(h.elements[leaves[i]].radiosity.r, around.dark[i] != 0 ? 0.0F : 1.0F);
        sum += h.elements[leaves[i]].radiosity.r * h.elements[leaves[i]].area;
    }
    EXPECT_NEAR(h.elements[0].radiosity.r * h.elements[0].area, sum, 1e-3F * sum) << "pulled up again";
    return out;
}

TEST(LeafSurroundings, OneRoomIsEnclosedAndLit) {
    const Counts c = look(two_rooms(Wall::Missing));
    EXPECT_GT(c.leaves, 1000);
    // The panel hangs a centimetre below the ceiling: the few leaves right above it see nothing but its culled back.
    EXPECT_LT(c.dark, 16);
    EXPECT_EQ(c.dark_in_second, 0);
    EXPECT_GT(c.enclosed, c.leaves * 9 / 10);
}

TEST(LeafSurroundings, LightComesThroughDoorsAndGlass) {
    EXPECT_EQ(look(two_rooms(Wall::Door)).dark_in_second, 0);
    const Counts glass = look(two_rooms(Wall::Glass));
    EXPECT_EQ(glass.dark_in_second, 0);
    EXPECT_LT(glass.enclosed, glass.leaves);
}

TEST(LeafSurroundings, WithoutAnyLightEverythingIsDarkAndWithoutARoofNothingIsEnclosed) {
    Scene scene;
    add_room(scene, 4, 3, 4, add_material(scene, 0.5F));
    Counts c = look(scene);
    EXPECT_EQ(c.dark, c.leaves);
    EXPECT_EQ(c.enclosed, c.leaves);
    scene.nodes.erase(scene.roots[1]);
    scene.roots.erase(scene.roots.begin() + 1);
    c = look(scene);
    EXPECT_LT(c.enclosed, c.leaves / 10);
}

TEST(LeafSurroundings, BehindAWholeWallItIsDark) {
    // Floor and ceiling run through below the wall; leaves that straddle it would join the rooms, so they end at it here.
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    add_room(scene, 4, 3, 4, m);
    const std::size_t first = scene.roots.size();
    add_room(scene, 4, 3, 4, m);
    for (std::size_t i = first; i < scene.roots.size(); ++i) {
        scene.nodes.find(scene.roots[i])->transform.translation.x += 4;
    }
    add_rectangle(scene, "panel", {2, 2.99, 2}, {0, -1, 0}, {1, 0, 0}, 1, 1, add_material(scene, 0.0F, 1000.0F));
    const Counts c = look(scene);
    EXPECT_GT(c.in_second, 300);
    EXPECT_EQ(c.dark_in_second, c.in_second);
    EXPECT_LT(c.dark, c.leaves * 6 / 10);
}

} // namespace
} // namespace atrium
