// Changed sight: what surfaces see otherwise than before, against rays all round in both scenes.
#include "engine/base/rng.h"
#include "engine/radiosity/sight_change.h"
#include "tests/support/light_cases.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace test;

/// A room whose walls send 1 and in which a box that sends 0.2 was moved.
struct Moved {
    Scene scene;
    NodeId box;
    std::unique_ptr<RayScene> rays;
    Hierarchy hierarchy;
    std::vector<std::uint8_t> moved;
    std::vector<Displacement> displaced;

    explicit Moved(const dvec3& by) {
        add_room(scene, 4, 3, 4, add_material(scene, 0.5F));
        box = add_shape(scene, "box", Box{vec3(0.5F, 0.8F, 0.5F)}, {1.2, 0.6, 1.3}, add_material(scene, 0.4F));
        rays = std::make_unique<RayScene>(scene);
        hierarchy = build_hierarchy(*rays, {});
        moved.assign(rays->surfaces().size(), 0);
        scene.nodes.find(box)->transform.translation += by;
        const auto what = rays->move_to(scene);
        EXPECT_TRUE(what);
        for (const MovedSurface& m : *what) {
            moved[m.surface] = 1;
            displaced.push_back({m.before, m.after});
        }
        EXPECT_TRUE(rays->look_back());
        for (std::uint32_t i = 0; i < hierarchy.elements.size(); ++i) {
            Element& e = hierarchy.elements[i];
            e.radiosity = Rgb(0.0F);
            if (e.leaf()) {
                const std::uint32_t surface =
                    e.kind == Element::Kind::Patch ? e.surface : hierarchy.faces[e.triangle].surface;
                e.radiosity = Rgb(moved.at(surface) != 0 ? 0.2F : 1.0F);
            }
        }
    }
    [[nodiscard]] float sent(const Hit& hit) const {
        if (!hit) {
            return 0.0F;
        }
        const std::uint32_t leaf = hierarchy.leaf_at(hit.surface, hit.triangle, !hit.front, hit.barycentric);
        return leaf == Element::kNone ? 0.0F : hierarchy.elements[leaf].radiosity.r;
    }
    /// Irradiance now less that before, by rays all round.
    [[nodiscard]] double all_round(const SurfacePoint& p) const {
        constexpr std::uint32_t kRays = 1U << 16U;
        vec3 t, b;
        make_frame(p.normal, t, b);
        double sum = 0.0;
        for (std::uint32_t k = 0; k < kRays; ++k) {
            const vec2 u = sobol_owen2(k, 0, 99U);
            const float r = std::sqrt(u.x), a = 2.0F * kPi * u.y;
            const Ray ray{p.position + p.normal * 1e-4F,
                          glm::normalize(t * (r * std::cos(a)) + b * (r * std::sin(a)) + p.normal * std::sqrt(1.0F - u.x))};
            sum += double(sent(rays->nearest(ray))) - sent(rays->nearest_before(ray));
        }
        return sum / kRays;
    }
};

constexpr SightChange::Effort kMany{16384.0F, 256, 16384};

TEST(SightChange, IsWhatRaysAllRoundSay) {
    const Moved m({0.9, 0.1, 0.7});
    const SightChange sight(m.hierarchy, *m.rays, m.displaced, m.moved);
    const auto radiosity = [&](const Hit& hit) { return Rgb(m.sent(hit)); };
    for (const SurfacePoint& p : {SurfacePoint{{1.25F, 0.0F, 1.3F}, {0, 1, 0}}, SurfacePoint{{2.1F, 0.0F, 2.0F}, {0, 1, 0}},
                                  SurfacePoint{{3.5F, 0.0F, 0.4F}, {0, 1, 0}}, SurfacePoint{{0.0F, 1.0F, 1.6F}, {1, 0, 0}},
                                  SurfacePoint{{1.9F, 3.0F, 1.9F}, {0, -1, 0}}}) {
        const SurfacePoint at{p.position - vec3(dvec3(m.rays->origin())), p.normal};
        const double truth = m.all_round(at);
        const double got = sight.irradiance(at, kMany, radiosity).r;
        EXPECT_NEAR(got, truth, 0.002 + 0.02 * std::abs(truth));
        EXPECT_GE(sight.share(at.position, at.normal), std::abs(truth) / 0.8 * 0.99) << "its bound holds";
    }
}

TEST(SightChange, AThingThatCameBackChangesNothing) {
    Moved m({0.9, 0.0, 0.7});
    m.scene.nodes.find(m.box)->transform.translation -= dvec3(0.9, 0.0, 0.7);
    ASSERT_TRUE(m.rays->move_to(m.scene));
    m.displaced.front().now = m.displaced.front().before;
    const SightChange sight(m.hierarchy, *m.rays, m.displaced, m.moved);
    for (const vec3& p : {vec3(-0.7F, -1.0F, -0.7F), vec3(0.5F, -1.5F, 0.2F)}) {
        EXPECT_EQ(sight.irradiance({p, {0, 1, 0}}, kMany, [&](const Hit& hit) { return Rgb(m.sent(hit)); }), Rgb(0.0F));
    }
}

// Rows of leaves: the same sums, in a closed room none of which is more than 1.
TEST(SightChange, RowsOfLeavesCloseAndSolve) {
    Moved m({0.9, 0.1, 0.7});
    const std::vector<std::uint32_t> leaves = m.hierarchy.leaves();
    const SightChange sight(m.hierarchy, *m.rays, m.displaced, m.moved);
    LookSettings look;
    look.rays = 256;
    const auto anew = [&](std::uint32_t leaf) {
        const Element& e = m.hierarchy.elements[leaf];
        return m.moved[e.kind == Element::Kind::Patch ? e.surface : m.hierarchy.faces[e.triangle].surface] != 0;
    };
    const SightChange::Rows rows = sight.rows(m.hierarchy, leaves, {1024.0F, 64, 1024}, anew, look, {});
    std::vector<Rgb> ones(leaves.size(), Rgb(1.0F)), sums(leaves.size(), Rgb(1.0F));
    rows.apply(ones, sums);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const bool shut = m.hierarchy.elements[leaves[i]].back; // backs of walls see nothing
        if (!shut && rows.first[i + 1] > rows.first[i]) {
            EXPECT_NEAR(sums[i].r, 1.0F, 0.03F) << "what is hidden here is seen there";
            ++changed;
        }
    }
    EXPECT_GT(changed, 8U);
    // Radiosities that all are 1 under walls that absorb what they send: still all 1 whatever stands where.
    for (const std::uint32_t leaf : leaves) {
        Element& e = m.hierarchy.elements[leaf];
        e.rho = Rgb(0.7F);
        e.emitted = Rgb(0.3F);
        e.direct = e.caustic = Rgb(0.0F);
        e.irradiance = Rgb(1.0F);
        e.radiosity = Rgb(0.5F);
    }
    const LeafSurroundings around = look_around(m.hierarchy, *m.rays, leaves, look, {});
    const LeafExchange exchange(m.hierarchy, leaves, around);
    SightChange::Rows nothing;
    nothing.first.assign(leaves.size() + 1, 0);
    nothing.whole.assign(leaves.size(), 0);
    const std::vector<Rgb> beside = solve_with_changed_sight(m.hierarchy, exchange, nothing, 1e-6, 200, {});
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        EXPECT_EQ(beside[i], Rgb(0.0F));
        if (exchange.row_sums()[i] > 0.999F) {
            EXPECT_NEAR(m.hierarchy.elements[leaves[i]].radiosity.r, 1.0F, 2e-3F);
        }
    }
}

} // namespace
} // namespace atrium
