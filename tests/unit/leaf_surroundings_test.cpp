// What leaves see around them, which of them are in one room, and that no light gets into closed ones.
#include "engine/radiosity/leaf_exchange.h"
#include "engine/radiosity/light_split.h"
#include "engine/radiosity/links.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

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
    both.roughness = wall == Wall::Glass ? 0.0F : 0.6F;
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

struct Looked {
    RayScene rays;
    Hierarchy hierarchy;
    std::vector<std::uint32_t> leaves;
    LeafSurroundings around;

    explicit Looked(const Scene& scene) : rays(scene), hierarchy(build_hierarchy(rays, {0.1F, 0.05F})) {
        // A few levels of quarters, so that floor and ceiling have leaves on either side of the wall alone.
        for (int level = 0; level < 4; ++level) {
            for (const std::uint32_t leaf : hierarchy.leaves()) {
                if (hierarchy.can_split(leaf)) {
                    hierarchy.split(leaf, rays);
                }
            }
        }
        leaves = hierarchy.leaves();
        around = look_around(hierarchy, rays, leaves, {64, {}}, RunContext{});
        mark_rooms(hierarchy, leaves, around);
    }
    [[nodiscard]] float x(std::uint32_t leaf) const { return hierarchy.elements[leaf].centre.x + float(rays.origin().x); }
};

struct Counts {
    int enclosed = 0, leaves = 0, dark_in_second = 0, in_second = 0, rooms = 0;
};
Counts look(const Scene& scene) {
    Looked s(scene);
    Counts out;
    out.leaves = int(s.leaves.size());
    solve_radiosity(s.hierarchy, LeafExchange(s.hierarchy, s.leaves, s.around), 1e-3, 100, RunContext{});
    std::set<std::uint32_t> rooms(s.hierarchy.room.begin(), s.hierarchy.room.end());
    rooms.erase(Element::kNone);
    out.rooms = int(rooms.size());
    for (std::size_t i = 0; i < s.leaves.size(); ++i) {
        const bool second = s.x(s.leaves[i]) > 4.3F;
        out.enclosed += s.around.share[i] == 1.0F ? 1 : 0;
        out.in_second += second ? 1 : 0;
        out.dark_in_second += second && max_component(s.hierarchy.elements[s.leaves[i]].irradiance) <= 0.0F ? 1 : 0;
    }
    return out;
}

TEST(LeafSurroundings, OneRoomIsEnclosedAndLit) {
    const Counts c = look(two_rooms(Wall::Missing));
    EXPECT_GT(c.leaves, 1000);
    EXPECT_EQ(c.dark_in_second, 0);
    EXPECT_EQ(c.rooms, 0) << "a single one is not marked";
    // The panel hangs a centimetre below the ceiling: its culled back is no part of the hierarchy.
    EXPECT_GT(c.enclosed, c.leaves * 9 / 10);
}

TEST(LeafSurroundings, LightComesThroughDoorsAndGlass) {
    EXPECT_EQ(look(two_rooms(Wall::Door)).dark_in_second, 0);
    EXPECT_EQ(look(two_rooms(Wall::Glass)).dark_in_second, 0);
}

TEST(LeafSurroundings, WithoutARoofNothingIsEnclosedAndRowsAreOpen) {
    Scene scene;
    add_room(scene, 4, 3, 4, add_material(scene, 0.5F));
    Counts c = look(scene);
    EXPECT_EQ(c.enclosed, c.leaves);
    scene.nodes.erase(scene.roots[1]);
    scene.roots.erase(scene.roots.begin() + 1);
    c = look(scene);
    EXPECT_LT(c.enclosed, c.leaves / 10);
    // What the floor sends out at the open top: the form factor of two 4 x 4 m squares 3 m apart (Howell C-11).
    const Looked s(scene);
    double open = 0.0;
    double area = 0.0;
    for (std::size_t i = 0; i < s.leaves.size(); ++i) {
        const Element& e = s.hierarchy.elements[s.leaves[i]];
        if (e.normal.y > 0.5F) {
            open += double(e.area) * (1.0 - double(s.around.share[i]));
            area += e.area;
        }
    }
    const double x = 4.0 / 3.0;
    const double r = std::sqrt(1.0 + x * x);
    const double factor =
        2.0 / (kPiD * x * x) *
        (0.5 * std::log(r * r * r * r / (1.0 + 2.0 * x * x)) + 2.0 * x * r * std::atan(x / r) - 2.0 * x * std::atan(x));
    EXPECT_NEAR(open / area / factor, 1.0, 0.01);
}

TEST(LeafSurroundings, CoveredPartsNeitherSendNorReceive) {
    Scene scene;
    add_room(scene, 4, 3, 4, add_material(scene, 0.5F));
    const RayScene rays(scene);
    const Hierarchy h = build_hierarchy(rays, {0.5F, 0.1F});
    const std::vector<std::uint32_t> leaves = h.leaves();
    const float middle = 2.0F - float(rays.origin().x);
    const LeafSurroundings around =
        look_around(h, rays, leaves, {64, [&](const SurfacePoint& p) { return p.position.x > middle; }}, RunContext{});
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const vec3& n = h.elements[leaves[i]].normal;
        const float expected = n.x > 0.5F ? 1.0F : (n.x < -0.5F ? 0.5F / 64.0F : 0.5F); // walls at x = 0, at x = 4, others
        EXPECT_NEAR(around.open[i], expected, 0.02F);
        EXPECT_EQ(around.share[i], n.x < -0.5F ? 0.0F : 1.0F);
    }
}

/// Two closed rooms beside each other with lamps of these exitances, or ceilings that shine; the second alone when the first
/// is negative.
enum class Lamp { Panel, Ceiling };
Scene closed_rooms(float first, float second, Lamp lamp = Lamp::Panel) {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    for (int k = first < 0.0F ? 1 : 0; k < 2; ++k) {
        const std::size_t begin = scene.roots.size();
        const float exitance = k == 0 ? first : second;
        if (lamp == Lamp::Ceiling) {
            add_room(scene, 4, 3, 4, {m, add_material(scene, 0.5F, exitance), m, m, m, m});
        } else {
            add_room(scene, 4, 3, 4, m);
            add_rectangle(scene, "panel", {1, 2.99, 2}, {0, -1, 0}, {1, 0, 0}, 1, 1, add_material(scene, 0.0F, exitance));
        }
        for (std::size_t i = begin; i < scene.roots.size(); ++i) {
            scene.nodes.find(scene.roots[i])->transform.translation.x += 4.5 * k;
        }
    }
    return scene;
}

TEST(LeafSurroundings, BehindAWholeWallItIsDark) {
    const Counts c = look(closed_rooms(1000.0F, 0.0F));
    EXPECT_GT(c.in_second, 300);
    EXPECT_EQ(c.dark_in_second, c.in_second);
    EXPECT_EQ(c.rooms, 2);
}

TEST(LeafSurroundings, LampsStandOutInTheirOwnRoom) {
    Looked s(closed_rooms(1e8F, 1.0F));
    const LeafFlags named = named_emitters(s.hierarchy, s.hierarchy.room, 4.0F);
    const LeafFlags lost = named_emitters(s.hierarchy, {}, 4.0F);
    int weak = 0;
    int weak_lost = 0;
    for (const std::uint32_t leaf : s.leaves) {
        const bool lamp = s.x(leaf) > 4.3F && max_component(s.hierarchy.elements[leaf].emitted) > 0.0F;
        weak += lamp && named[leaf] != 0 ? 1 : 0;
        weak_lost += lamp && lost[leaf] != 0 ? 1 : 0;
    }
    EXPECT_GT(weak, 0);
    EXPECT_EQ(weak_lost, 0) << "which is why rooms are told apart";
}

// X-DYNAMIC: beside a room eight orders of magnitude brighter a dim one is divided as if it stood alone.
TEST(LeafSurroundings, ADimRoomIsRefinedAsIfItStoodAlone) {
    struct Face {
        double flux = 0.0;
        std::size_t leaves = 0;
    };
    const auto refined = [](const Scene& scene, std::size_t& links_in_second) {
        const RayScene rays(scene);
        Hierarchy h = build_hierarchy(rays, {0.1F, 0.05F});
        const std::vector<std::uint32_t> first = h.leaves();
        mark_rooms(h, first, look_around(h, rays, first, {64, {}}, RunContext{}));
        LinkSet links(h);
        for (int round = 0; round < 2; ++round) {
            for (Element& e : h.elements) {
                e.radiosity = e.leaf() ? e.emitted + e.rho * e.irradiance : Rgb(0.0F);
            }
            h.pull_radiosity();
            RefineSettings settings;
            settings.flux_threshold = 1e-3F;
            settings.rays = 0;
            links.refine(h, rays, settings, RunContext{});
            const std::vector<std::uint32_t> leaves = h.leaves();
            const LeafExchange exchange(h, leaves, look_around(h, rays, leaves, {256, {}}, RunContext{}));
            solve_radiosity(h, exchange, 1e-4, 100, RunContext{});
        }
        const auto in_second = [&](std::uint32_t i) {
            return h.elements[i].centre.x - h.elements[i].radius + float(rays.origin().x) > 3.0F &&
                   h.elements[i].centre.x + float(rays.origin().x) > 4.3F;
        };
        std::map<std::array<int, 3>, Face> light; // by normal
        for (const std::uint32_t leaf : h.leaves()) {
            const Element& e = h.elements[leaf];
            if (in_second(leaf)) {
                Face& face =
                    light[{int(std::lround(e.normal.x)), int(std::lround(e.normal.y)), int(std::lround(e.normal.z))}];
                face.flux += double(e.area) * e.irradiance.r;
                ++face.leaves;
            }
        }
        links_in_second = std::size_t(std::count_if(links.links().begin(), links.links().end(),
                                                    [&](const Link& l) { return in_second(l.a) && in_second(l.b); }));
        return light;
    };
    std::size_t links_alone = 0;
    std::size_t links_beside = 0;
    const auto alone = refined(closed_rooms(-1.0F, 1.0F, Lamp::Ceiling), links_alone);
    const auto beside = refined(closed_rooms(1e8F, 1.0F, Lamp::Ceiling), links_beside);
    ASSERT_EQ(alone.size(), 6U);
    ASSERT_EQ(beside.size(), 6U);
    EXPECT_NEAR(double(links_beside) / double(links_alone), 1.0, 0.1);
    double worst = 0.0;
    for (const auto& [normal, face] : alone) {
        const Face& other = beside.at(normal);
        EXPECT_NEAR(double(other.leaves) / double(face.leaves), 1.0, 0.2);
        EXPECT_NEAR(other.flux / face.flux, 1.0, 0.02) << "rays of other leaves: apart by their chance alone";
        worst = std::max(worst, std::abs(other.flux / face.flux - 1.0));
    }
    std::printf("dim room: %zu links alone, %zu beside; flux on a face apart by at most %.2f %%\n", links_alone,
                links_beside, 100.0 * worst);
}

} // namespace
} // namespace atrium
