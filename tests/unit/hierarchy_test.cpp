// The element hierarchy, its links and the transport on them keep what their headers promise.
#include "engine/base/rng.h"
#include "engine/io/scene_file.h"
#include "engine/radiosity/direct_light.h"
#include "engine/radiosity/validate.h"
#include "tests/support/rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

namespace atrium {
namespace {

using namespace test;
using testing::IsEmpty;

NodeId add_node(Scene& scene, const Geometry& geometry, const dvec3& at, MaterialId material) {
    Shape shape;
    shape.geometry = geometry;
    Node node;
    node.shape = scene.shapes.insert(shape);
    node.materials = {material};
    node.transform.translation = at;
    const NodeId id = scene.nodes.insert(node);
    scene.roots.push_back(id);
    return id;
}

Scene empty_room() {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    add_room(scene, 4, 2.5F, 3, m);
    add_rectangle(scene, "panel", {2, 2.5, 1.5}, {0, -1, 0}, {1, 0, 0}, 1, 1, add_material(scene, 0.2F, 1000.0F));
    return scene;
}

Scene furnished_room() {
    Scene scene = empty_room();
    const MaterialId m = scene.materials.keys().front();
    Material both;
    both.double_sided = true;
    const MaterialId two_sided = scene.materials.insert(both);
    add_node(scene, Box{{0.6F, 0.5F, 0.7F}}, {1.1, 0.25, 1.3}, m);
    add_node(scene, Sphere{0.2F}, {2.5, 0.2, 1.0}, m); // small triangles: face groups
    add_node(scene, Cylinder{0.05F, 0.6F, false}, {3.0, 0.3, 2.0}, two_sided);
    add_rectangle(scene, "screen", {1.9, 0.6, 1.5}, {0, 0, 1}, {1, 0, 0}, 1, 1, two_sided);
    return scene;
}

/// A scene taken through refinement as the engine does it.
struct Refined {
    RayScene rays;
    DirectLight direct;
    Hierarchy hierarchy;
    LinkSet links;

    Refined(const Scene& scene, const HierarchySettings& settings, float threshold, int rounds = 2)
        : rays(scene), direct(scene, rays), hierarchy(build_hierarchy(rays, settings)), links(hierarchy) {
        for (const std::uint32_t leaf : hierarchy.leaves()) {
            hierarchy.elements[leaf].radiosity = hierarchy.elements[leaf].emitted;
        }
        hierarchy.pull_radiosity();
        for (int round = 0; round < rounds; ++round) {
            RefineSettings refine;
            refine.flux_threshold = threshold;
            refine.rays = 4;
            links.refine(hierarchy, rays, refine, RunContext{});
            Transport transport(hierarchy, links.links());
            solve_radiosity(hierarchy, transport, 1e-3, 50, RunContext{});
        }
    }
};

constexpr HierarchySettings kCoarse{0.3F, 0.15F};

TEST(Hierarchy, IsSoundBeforeAndAfterRefinement) {
    for (const Scene& scene : {empty_room(), furnished_room()}) {
        const RayScene rays(scene);
        const Hierarchy fresh = build_hierarchy(rays, kCoarse);
        EXPECT_THAT(check_hierarchy(fresh, rays), IsEmpty());
        const Refined refined(scene, kCoarse, 1e-3F);
        EXPECT_GT(refined.hierarchy.elements.size(), fresh.elements.size());
        EXPECT_THAT(check_hierarchy(refined.hierarchy, refined.rays), IsEmpty());
    }
}

TEST(Hierarchy, HasEveryKindOfElementInAFurnishedRoom) {
    const RayScene rays(furnished_room());
    const Hierarchy h = build_hierarchy(rays, kCoarse);
    std::array<int, 3> kinds{};
    int back = 0;
    for (const Element& e : h.elements) {
        ++kinds[std::size_t(e.kind)];
        back += e.kind == Element::Kind::Patch && e.back ? 1 : 0;
    }
    EXPECT_GT(kinds[0], 5);
    EXPECT_GT(kinds[1], 5);
    EXPECT_GT(kinds[2], 20);
    EXPECT_GT(back, 0) << "the screen's back";
    EXPECT_EQ(h.elements[0].child_count, 2) << "what emits and what does not are apart";
}

TEST(Hierarchy, LinksCoverEveryPairOfLeavesOnce) {
    for (const float threshold : {1.0F, 3e-2F, 3e-3F}) { // from hardly refined to finely
        const Refined empty(empty_room(), kCoarse, threshold);
        EXPECT_THAT(check_links(empty.hierarchy, empty.links.links()), IsEmpty()) << threshold;
        const Refined furnished(furnished_room(), kCoarse, threshold);
        ASSERT_LT(furnished.hierarchy.leaves().size(), 8000U);
        EXPECT_THAT(check_links(furnished.hierarchy, furnished.links.links()), IsEmpty()) << threshold;
    }
}

TEST(Hierarchy, LinksStayCompleteWithinTheirBudgetAndLoseTheWeakestFirst) {
    const Scene scene = furnished_room();
    const RayScene rays(scene);
    struct Outcome {
        std::size_t links;
        bool reached;
        double worst; // transfer error that was let be: B times solid angle, over links
        std::size_t leaves;
    };
    const auto refine = [&](std::size_t most) {
        Hierarchy h = build_hierarchy(rays, {0.05F, 0.15F});
        for (Element& e : h.elements) {
            e.radiosity = e.emitted + Rgb(30.0F); // as if light had gone round
        }
        h.pull_radiosity();
        LinkSet links(h);
        RefineSettings settings;
        settings.flux_threshold = 1e-4F;
        settings.rays = 0;
        settings.max_links = most;
        links.refine(h, rays, settings, RunContext{});
        EXPECT_THAT(check_links(h, links.links()), IsEmpty()) << most;
        // Between patches: flux that goes over a link times how much of it depends on where on the elements one is.
        double worst = 0.0;
        for (const Link& link : links.links()) {
            const Element& a = h.elements[link.a];
            const Element& b = h.elements[link.b];
            if (a.kind == Element::Kind::Patch && b.kind == Element::Kind::Patch) {
                const float r = std::max(glm::length(a.centre - b.centre), 1e-6F);
                const float ratio = std::min(std::max(a.radius, b.radius) / r, 1.0F);
                const float areas = a.area * b.area / (kPi * r * r + std::max(a.area, b.area));
                worst = std::max(worst,
                                 double(areas * ratio * ratio * max_component(a.rho * b.radiosity + b.rho * a.radiosity)));
            }
        }
        return Outcome{links.links().size(), links.budget_reached(), worst, h.leaves().size()};
    };
    const Outcome all = refine(20'000'000);
    EXPECT_FALSE(all.reached);
    EXPECT_GT(all.links, 5'000U);
    double before = all.worst;
    std::size_t finer = all.leaves;
    for (const double share : {0.5, 0.25, 0.125}) {
        const auto most = std::size_t(double(all.links) * share);
        const Outcome some = refine(most);
        EXPECT_TRUE(some.reached);
        EXPECT_LE(some.links, most);
        EXPECT_GT(some.links, most * 3 / 4) << "and it is made use of";
        EXPECT_LE(some.leaves, finer);
        EXPECT_LT(some.worst, 6.0 * before) << "halving the budget costs no more than a level or two";
        std::printf("link budget %zu: %zu links, %zu leaves, worst transfer let be %.3g lm\n", most, some.links, some.leaves,
                    some.worst);
        before = std::max(some.worst, before);
        finer = some.leaves;
    }
}

TEST(Hierarchy, TransportIsSymmetricAndClosedRowsSumToOne) {
    Refined room(empty_room(), kCoarse, 3e-3F);
    Transport open(room.hierarchy, room.links.links());
    EXPECT_THAT(check_transport(room.hierarchy, open, false, 1e-2), IsEmpty());
    Transport closed(room.hierarchy, room.links.links());
    closed.close_rows(std::vector<std::uint8_t>(closed.leaves().size(), 1));
    EXPECT_THAT(check_transport(room.hierarchy, closed, true, 2e-2), IsEmpty());
    int near_one = 0;
    for (const float sum : closed.row_sums()) {
        near_one += std::abs(sum - 1.0F) < 1e-3F ? 1 : 0;
    }
    EXPECT_GT(near_one, int(0.98 * double(closed.leaves().size())));

    Refined furnished(furnished_room(), kCoarse, 3e-3F);
    Transport transport(furnished.hierarchy, furnished.links.links());
    transport.close_rows(std::vector<std::uint8_t>(transport.leaves().size(), 0));
    EXPECT_THAT(check_transport(furnished.hierarchy, transport, true, 3e-2), IsEmpty());
}

TEST(Hierarchy, AWallIsOnePatchAndSplitsIntoQuartersOrHalves) {
    Scene scene = empty_room(); // 4 m x 2.5 m x 3 m, a panel of 1 m x 1 m
    const RayScene rays(scene);
    Hierarchy h = build_hierarchy(rays, kCoarse);
    ASSERT_EQ(h.leaves().size(), 7U);
    std::multiset<int> parts;
    for (const std::uint32_t leaf : h.leaves()) {
        ASSERT_TRUE(h.can_split(leaf));
        const Element parent = h.elements[leaf];
        h.split(leaf, rays);
        EXPECT_FALSE(h.can_split(leaf)) << "it is no leaf any more";
        const int count = h.elements[leaf].child_count;
        parts.insert(count);
        double area = 0.0;
        vec3 centre(0.0F);
        for (std::uint32_t k = 0; k < std::uint32_t(count); ++k) {
            const Element& child = h.elements[h.elements[leaf].first_child + k];
            EXPECT_NEAR(child.area, parent.area / float(count), 1e-5F);
            EXPECT_EQ(child.normal, parent.normal);
            EXPECT_EQ(child.rho, parent.rho);
            EXPECT_LT(child.radius, (count == 4 ? 0.51F : 0.8F) * parent.radius);
            area += child.area;
            centre += child.centre / float(count);
        }
        EXPECT_NEAR(area, parent.area, 1e-5);
        EXPECT_LT(glm::length(centre - parent.centre), 1e-5F);
    }
    EXPECT_EQ(parts.count(2), 2U) << "the walls of 4 m x 2.5 m";
    EXPECT_EQ(parts.count(4), 5U);
    while (h.can_split(std::uint32_t(h.elements.size() - 1))) {
        h.split(std::uint32_t(h.elements.size() - 1), rays);
    }
    const auto& corner = h.corners(h.elements.back());
    const float longer = std::max(glm::length(corner[1] - corner[0]), glm::length(corner[2] - corner[1]));
    EXPECT_LE(longer, 2 * kCoarse.smallest_patch);
    EXPECT_GE(longer, kCoarse.smallest_patch * 0.99F);
    EXPECT_THAT(check_hierarchy(h, rays), IsEmpty());
}

// A surface with a hole, round and slanted edges, cut into any triangles: what cells cover must be what is there.
TEST(Hierarchy, CellsCoverJustTheSurface) {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    const Polygon holed{{{0, 0}, {3, 0}, {3, 2}, {1, 3}, {0, 2}},
                        {{{0.5F, 0.5F}, {0.5F, 1.5F}, {1.5F, 1.5F}, {1.5F, 0.5F}}}};
    add_node(scene, holed, {0, 0, 0}, m);
    add_node(scene, Disc{1.0F}, {6, 0, 0}, m);
    add_node(scene, Polygon{{{0, 0}, {2, 0}, {0, 1}}, {}}, {10, 0, 0}, m);
    const RayScene rays(scene);
    Hierarchy h = build_hierarchy(rays, {0.05F, 0.03F});
    ASSERT_EQ(h.leaves().size(), 3U);
    EXPECT_THAT(check_hierarchy(h, rays), IsEmpty());
    for (std::uint32_t i = 0; i < h.elements.size(); ++i) {
        if (h.can_split(i)) {
            h.split(i, rays);
        }
    }
    EXPECT_THAT(check_hierarchy(h, rays), IsEmpty());
    // Uniform points of every patch lie on the surface and in its own leaves; their mean is the patch's centroid.
    for (std::uint32_t i = 1; i < h.elements.size(); i += i < 60 ? 1 : 17) {
        const Element& e = h.elements[i];
        if (e.kind != Element::Kind::Patch) {
            continue;
        }
        vec3 mean(0.0F);
        constexpr unsigned kCount = 256;
        for (unsigned k = 0; k < kCount; ++k) {
            const SurfacePoint p = sample_point(h, rays, i, sobol_owen2(k, 0, 5U), false);
            mean += p.position / float(kCount);
            const Hit hit = rays.nearest({p.position + 0.5F * p.normal, -p.normal});
            ASSERT_TRUE(hit);
            ASSERT_EQ(hit.surface, e.surface) << i;
            std::uint32_t up = h.leaf_at(hit.surface, hit.triangle, false, hit.barycentric);
            while (up != Element::kNone && up != i) {
                up = h.elements[up].parent;
            }
            ASSERT_EQ(up, i);
        }
        EXPECT_LT(glm::length(mean - e.centre), 0.03F * e.radius) << i;
    }
}

TEST(Hierarchy, FineTrianglesCostWhatTheirShapeDeserves) {
    // A wall and a ball of 20 cm, coarse and a thousand times as fine: as many elements, give or take.
    std::array<std::size_t, 2> elements{};
    for (const int fine : {0, 1}) {
        Scene scene;
        auto mesh = std::make_shared<MeshData>();
        const auto grid = [&](int n, const auto& at) {
            const auto first = std::uint32_t(mesh->positions.size());
            for (int j = 0; j <= n; ++j) {
                for (int i = 0; i <= n; ++i) {
                    mesh->positions.push_back(at(float(i) / float(n), float(j) / float(n)));
                }
            }
            for (int j = 0; j < n; ++j) {
                for (int i = 0; i < n; ++i) {
                    const std::uint32_t a = first + std::uint32_t(j * (n + 1) + i), c = a + std::uint32_t(n) + 1;
                    mesh->indices.insert(mesh->indices.end(), {a, a + 1, c + 1, a, c + 1, c});
                }
            }
        };
        grid(fine != 0 ? 300 : 1, [](float u, float v) { return vec3(4.0F * u, 2.5F * v, 0.0F); });
        grid(fine != 0 ? 300 : 10, [](float u, float v) {
            const float a = 2.0F * kPi * u, b = kPi * v;
            return vec3(2, 1, 1) + 0.1F * vec3(std::sin(b) * std::sin(a), std::cos(b), std::sin(b) * std::cos(a));
        });
        mesh->parts = {{0, std::uint32_t(mesh->indices.size())}};
        add_node(scene, Mesh{mesh}, {0, 0, 0}, add_material(scene, 0.5F));
        const RayScene rays(scene);
        const Hierarchy h = build_hierarchy(rays, {0.2F, 0.1F});
        EXPECT_THAT(check_hierarchy(h, rays), IsEmpty());
        elements[std::size_t(fine)] = h.elements.size();
    }
    EXPECT_GT(elements[0], 10U);
    EXPECT_LT(double(elements[1]), 1.5 * double(elements[0]));
}

TEST(Hierarchy, PullGivesAreaMeansAndTheSpreadBoundsWhatIsBelow) {
    Refined room(furnished_room(), kCoarse, 1e-2F);
    Hierarchy& h = room.hierarchy;
    std::uint32_t state = 9;
    for (const std::uint32_t leaf : h.leaves()) {
        state = state * 1664525U + 1013904223U;
        h.elements[leaf].radiosity = Rgb(float(state >> 8) / float(1 << 24), 0.5F, float(leaf % 3));
        h.elements[leaf].irradiance = Rgb(float(leaf % 5));
        h.elements[leaf].direct = Rgb(float(leaf % 7));
    }
    h.pull_radiosity();
    Rgb power(0.0F), irradiance(0.0F);
    for (const std::uint32_t leaf : h.leaves()) {
        const Element& e = h.elements[leaf];
        power += e.radiosity * e.area;
        irradiance += e.irradiance * e.area;
        EXPECT_NEAR(e.power, e.area * luminance(e.radiosity), 1e-5F);
        for (std::uint32_t up = e.parent; up != Element::kNone; up = h.elements[up].parent) {
            const float difference = std::abs(luminance(e.radiosity) - luminance(h.elements[up].radiosity));
            ASSERT_LE(difference, h.elements[up].spread + 1e-4F);
        }
    }
    const Element& root = h.elements[0];
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(root.radiosity[c] * root.area / power[c], 1.0F, 1e-3F);
        EXPECT_NEAR(root.irradiance[c] * root.area / irradiance[c], 1.0F, 1e-3F);
    }
    // The root's emission harmonics: the mean over all directions of the projected radiosity is a quarter of the sum.
    EXPECT_NEAR(h.harmonics[root.harmonics].emission[0].g * 0.282094792F / (0.25F * power.g), 1.0F, 1e-3F);
}

TEST(Hierarchy, SamplePointsLieOnTheElementTheyAreAskedOf) {
    const Refined room(furnished_room(), kCoarse, 1e-2F);
    const Hierarchy& h = room.hierarchy;
    for (std::uint32_t i = 0; i < h.elements.size(); i += 7) {
        const Element& e = h.elements[i];
        for (const vec2& u : {vec2(0, 0), vec2(0.3F, 0.6F), vec2(0.99F, 0.98F), vec2(0.99999994F, 0.99999994F)}) {
            for (const bool by_power : {false, true}) {
                const SurfacePoint p = sample_point(h, room.rays, i, u, by_power);
                EXPECT_LE(glm::length(p.position - e.centre), e.radius * 1.001F + 1e-5F) << i;
                EXPECT_NEAR(glm::length(p.normal), 1.0F, 1e-3F);
                if (e.kind == Element::Kind::Patch) {
                    EXPECT_NEAR(glm::dot(p.position - e.centre, e.normal), 0.0F, 1e-4F);
                    EXPECT_EQ(p.normal, e.normal);
                }
            }
        }
    }
}

TEST(Hierarchy, EmptySceneHasNone) {
    const RayScene rays{Scene{}};
    Hierarchy h = build_hierarchy(rays, kCoarse);
    EXPECT_TRUE(h.empty());
    EXPECT_TRUE(h.leaves().empty());
    h.pull_radiosity();
    LinkSet links(h);
    EXPECT_EQ(links.refine(h, rays, {}, RunContext{}), 0U);
}

TEST(Hierarchy, TheCheckerFindsFaults) {
    Refined room(furnished_room(), kCoarse, 1e-2F);
    const auto broken = [&](const auto& change) {
        Hierarchy h = room.hierarchy;
        change(h);
        return !check_hierarchy(h, room.rays).empty();
    };
    const std::uint32_t leaf = room.hierarchy.leaves()[5];
    EXPECT_TRUE(broken([&](Hierarchy& h) { h.elements[leaf].area *= 1.1F; }));
    EXPECT_TRUE(broken([&](Hierarchy& h) { h.elements[leaf].parent = leaf + 1; }));
    EXPECT_TRUE(broken([&](Hierarchy& h) { h.elements[0].radius *= 0.4F; }));
    EXPECT_TRUE(broken([&](Hierarchy& h) { h.elements[leaf].path = h.elements[0].path; }));
    EXPECT_TRUE(broken([&](Hierarchy& h) { h.harmonics[h.elements[0].harmonics].projected_area[0] *= 1.1F; }));
    EXPECT_TRUE(broken([&](Hierarchy& h) { h.elements[leaf].rho = Rgb(1.2F); }));
    EXPECT_TRUE(broken([&](Hierarchy& h) { h.patches[3].corner[0] += vec3(0.5F); }));
    EXPECT_TRUE(broken([&](Hierarchy& h) { h.patches[3].sheet ^= 1U; }));
    EXPECT_TRUE(broken([&](Hierarchy& h) { std::swap(h.top.front(), h.top.back()); })) << "triangles lead elsewhere";
    const auto cut = std::find_if(room.hierarchy.steps.begin(), room.hierarchy.steps.end(),
                                  [](const CellStep& step) { return step.first_child != Element::kNone; });
    ASSERT_NE(cut, room.hierarchy.steps.end());
    const auto place = std::size_t(cut - room.hierarchy.steps.begin());
    EXPECT_TRUE(broken([&](Hierarchy& h) { h.steps[place].middle += vec2(0.1F); })) << "points lead to the wrong part";
    EXPECT_TRUE(broken([&](Hierarchy& h) { h.faces.back().triangle -= 1; })) << "a triangle twice, another never";
    std::vector<Link> links = room.links.links();
    ASSERT_FALSE(links.empty());
    links.push_back(links[links.size() / 2]);
    EXPECT_FALSE(check_links(room.hierarchy, links).empty()) << "a pair twice";
    links = room.links.links();
    const auto patches = std::find_if(links.begin(), links.end(), [&](const Link& l) { return l.weight > 0.01F; });
    ASSERT_NE(patches, links.end());
    links.erase(patches);
    EXPECT_FALSE(check_links(room.hierarchy, links).empty()) << "a pair missing";
}

TEST(Hierarchy, IsSoundOnARealInterior) {
    const auto file = std::filesystem::path(ATRIUM_SHARED_DIR) / "scenes" / "interiors" / "office_simple.glb";
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << "the shared scenes are absent";
    }
    const auto loaded = read_scene(file);
    ASSERT_TRUE(loaded) << loaded.error().message();
    const RayScene rays(loaded->scene);
    const float unit = rays.bounds().diagonal() / 10.0F;
    const Hierarchy fresh = build_hierarchy(rays, {0.4F * unit, 0.2F * unit});
    EXPECT_GT(fresh.elements.size(), 1000U);
    EXPECT_THAT(check_hierarchy(fresh, rays), IsEmpty());
    Refined refined(loaded->scene, {0.6F * unit, 0.3F * unit}, 1e-2F, 1);
    EXPECT_THAT(check_hierarchy(refined.hierarchy, refined.rays), IsEmpty());
    EXPECT_THAT(check_links(refined.hierarchy, refined.links.links()), IsEmpty());
}

} // namespace
} // namespace atrium
