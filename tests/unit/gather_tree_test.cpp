// What is gathered by name: nothing that shines is lost by what is left out of the tree.
#include "engine/radiosity/gather_tree.h"

#include "engine/radiosity/light_split.h"
#include "engine/radiosity/point_gather.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace atrium {
namespace {

using namespace test;

/// A furnished room of which some leaves shine: boxes, a ball of many faces, parts of walls.
struct Spots {
    Spots() {
        Scene scene;
        const MaterialId grey = add_material(scene, 0.5F);
        add_room(scene, 4, 2.5F, 3, grey);
        for (const auto& [geometry, at] : {std::pair(Geometry(Box{{0.5F, 0.7F, 0.4F}}), dvec3(1, 0.35, 1)),
                                           std::pair(Geometry(Sphere{0.3F}), dvec3(2.5, 0.8, 1.6)),
                                           std::pair(Geometry(Box{{0.2F, 1.5F, 0.6F}}), dvec3(3.2, 0.75, 2.2))}) {
            Shape shape;
            shape.geometry = geometry;
            Node node;
            node.transform.translation = at;
            node.shape = scene.shapes.insert(shape);
            node.materials = {grey};
            scene.roots.push_back(scene.nodes.insert(node));
        }
        rays = std::make_unique<RayScene>(scene);
        Hierarchy whole = build_hierarchy(*rays, {0.15F, 0.1F});
        for (int round = 0; round < 3; ++round) {
            for (const std::uint32_t leaf : whole.leaves()) {
                if (whole.can_split(leaf)) {
                    whole.split(leaf, *rays);
                }
            }
        }
        LeafFlags shines(whole.elements.size(), 0);
        Hierarchy lit = whole;
        for (std::size_t i = 0; i < shines.size(); ++i) {
            shines[i] = whole.elements[i].leaf() && random() % 3 == 0 ? 1 : 0;
            lit.elements[i].radiosity = Rgb(1.0F + float(random() % 100));
        }
        spots = only_flagged(lit, shines, false);
        for (std::uint32_t i = 0; i < shines.size(); ++i) {
            if (shines[i] != 0) {
                bright.insert(i);
            }
        }
    }
    vec3 place() {
        std::uniform_real_distribution<float> u(0.0F, 1.0F);
        const vec3 low = rays->bounds().min;
        return low + vec3(u(random), u(random), u(random)) * rays->bounds().size();
    }
    /// Some of the leaf faces the point.
    [[nodiscard]] bool faces(const Element& e, const vec3& p) const {
        if (e.kind == Element::Kind::Patch) {
            return glm::dot(p - e.centre, e.normal) > 1e-3F;
        }
        for (std::uint32_t f = e.triangle; f < e.triangle + e.face_count; ++f) {
            const auto corner = rays->triangle(spots.faces[f].surface, spots.faces[f].triangle);
            if (glm::dot(p - corner[0], spots.faces[f].normal) > 1e-3F) {
                return true;
            }
        }
        return false;
    }
    std::mt19937 random{7};
    std::unique_ptr<RayScene> rays;
    Hierarchy spots;
    std::set<std::uint32_t> bright; ///< leaves that shine
};

// Calls visit(node, leaves below) for every branch; returns the leaves below `node`.
template <class Visit> std::vector<std::uint32_t> walk(const GatherTree& tree, const GatherNode& node, const Visit& visit) {
    std::vector<std::uint32_t> below;
    for (const GatherNode& child : tree.children(node)) {
        const auto of_child = walk(tree, child, visit);
        below.insert(below.end(), of_child.begin(), of_child.end());
    }
    if (node.child_count == 0) {
        below.push_back(node.element);
    }
    visit(node, below);
    return below;
}

TEST(GatherTree, HoldsWhatShinesOnceAndNothingElse) {
    const Spots s;
    const GatherTree tree(s.spots);
    ASSERT_GT(s.bright.size(), 100U);
    const auto all = walk(tree, tree.root(), [&](const GatherNode& node, const std::vector<std::uint32_t>& below) {
        EXPECT_NE(node.child_count, 1U) << "a branch with one child says what the child says";
        for (const std::uint32_t leaf : below) {
            const Element& e = s.spots.elements[leaf];
            EXPECT_LE(glm::length(e.centre - node.centre) + e.radius, node.radius * 1.001F + 1e-5F);
            EXPECT_LE(e.radius, node.largest);
        }
    });
    EXPECT_EQ(std::set<std::uint32_t>(all.begin(), all.end()), s.bright);
    EXPECT_EQ(all.size(), s.bright.size());
    EXPECT_LT(tree.size(), 2 * s.bright.size());
    EXPECT_TRUE(GatherTree(Hierarchy{}).empty());
    EXPECT_TRUE(GatherTree(only_flagged(s.spots, LeafFlags(s.spots.elements.size(), 0), false)).empty());
}

TEST(GatherTree, LeavesOutOnlyWhatCannotShineOnAPoint) {
    Spots s;
    const GatherTree tree(s.spots);
    std::size_t away = 0, opened = 0, left = 0;
    for (int i = 0; i < 300; ++i) {
        const vec3 p = s.place();
        walk(tree, tree.root(), [&](const GatherNode& node, const std::vector<std::uint32_t>& below) {
            const bool turned = node.turns_away_from(p), near = node.may_be_near(p, 1.5F);
            away += turned ? 1 : 0;
            opened += near ? 1 : 0;
            left += near ? 0 : 1;
            for (const std::uint32_t leaf : below) {
                EXPECT_FALSE(turned && s.faces(s.spots.elements[leaf], p)) << "leaf " << leaf;
                EXPECT_TRUE(near || !too_near(s.spots.elements[leaf], p, 1.5F)) << "leaf " << leaf;
            }
        });
    }
    EXPECT_GT(away, 1000U) << "of what faces elsewhere";
    EXPECT_GT(left, 10 * opened) << "few branches are near to a point";
}

} // namespace
} // namespace atrium
