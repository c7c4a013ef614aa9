// Light between leaves against closed forms: form factors, furnaces, a manufactured solution.
#include "engine/base/rng.h"
#include "engine/geometry/form_factor.h"
#include "engine/radiosity/leaf_exchange.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace test;

/// A scene whose patches are all split `levels` times.
struct Leaves {
    RayScene rays;
    Hierarchy hierarchy;
    std::vector<std::uint32_t> leaves;

    Leaves(const Scene& scene, int levels, std::uint32_t seed = 1)
        : rays(scene), hierarchy(build_hierarchy(rays, {1e-3F, 1e-3F, seed})) {
        for (int level = 0; level < levels; ++level) {
            for (const std::uint32_t leaf : hierarchy.leaves()) {
                hierarchy.split(leaf, rays);
            }
        }
        leaves = hierarchy.leaves();
    }
    [[nodiscard]] LeafExchange exchange(std::uint32_t per_leaf = 64) const {
        return {hierarchy, leaves, look_around(hierarchy, rays, leaves, {per_leaf, {}}, RunContext{})};
    }
    [[nodiscard]] vec3 origin() const { return vec3(rays.origin()); }
};

// Mean form factor between two nodes' surfaces, from where radiosity is 1 on the second.
double factor(const Leaves& s, const LeafExchange& exchange, std::uint32_t from, std::uint32_t to) {
    std::vector<Rgb> b(s.leaves.size(), Rgb(0.0F));
    std::vector<Rgb> e;
    for (std::size_t i = 0; i < s.leaves.size(); ++i) {
        b[i] = Rgb(s.hierarchy.elements[s.leaves[i]].surface == to ? 1.0F : 0.0F);
    }
    exchange.apply(b, e);
    double sum = 0.0;
    double area = 0.0;
    for (std::size_t i = 0; i < s.leaves.size(); ++i) {
        const Element& element = s.hierarchy.elements[s.leaves[i]];
        if (element.surface == from) {
            sum += double(element.area) * e[i].r;
            area += element.area;
        }
    }
    return sum / area;
}

// Unit cube: 0.199825 between opposite faces, 0.200044 between neighbours (Howell C-11, C-14).
TEST(LeafExchange, FormFactorsOfACubeAndTheirReciprocity) {
    Scene scene;
    add_room(scene, 1, 1, 1, add_material(scene, 0.5F));
    const Leaves s(scene, 3);
    const LeafExchange exchange = s.exchange();
    EXPECT_NEAR(factor(s, exchange, 0, 1), 0.199825, 0.004);
    EXPECT_NEAR(factor(s, exchange, 0, 2), 0.200044, 0.004);
    EXPECT_NEAR(factor(s, exchange, 0, 3), factor(s, exchange, 3, 0), 1e-6);
    for (const float sum : exchange.row_sums()) {
        EXPECT_NEAR(sum, 1.0F, 1e-4F);
    }
}

// Two unit squares that face each other a unit apart, nothing else: rows sum to what is open.
TEST(LeafExchange, OpenRowsAreNeitherClosedNorShort) {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    add_rectangle(scene, "low", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 1, 1, m);
    add_rectangle(scene, "high", {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, 1, 1, m);
    double mean = 0.0;
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        const Leaves s(scene, 3, seed);
        mean += factor(s, s.exchange(), 0, 1) / 4.0;
    }
    EXPECT_NEAR(mean, 0.199825, 0.001);
}

// Through a clear pane halfway the same light arrives, less what the pane takes; the pane itself reflects nothing.
TEST(LeafExchange, LightGoesOnThroughGlass) {
    Scene scene;
    const MaterialId m = add_material(scene, 0.5F);
    add_rectangle(scene, "low", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, 1, 1, m);
    add_rectangle(scene, "high", {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, 1, 1, m);
    Material glass;
    glass.transmission = 1.0F;
    glass.base_color = Rgb(1.0F);
    glass.ior = 1.5F;
    glass.roughness = 0.0F;
    glass.double_sided = true;
    add_rectangle(scene, "pane", {0, 0.5, 0}, {0, 1, 0}, {1, 0, 0}, 3, 3, scene.materials.insert(glass));
    const Leaves s(scene, 3);
    const LeafExchange exchange = s.exchange(256);
    // Double area integral with the transmittance of a pane by Fresnel's formulas and its inner reflections, midpoints.
    double expected = 0.0;
    constexpr int kCells = 16;
    for (int i = 0; i < kCells * kCells * kCells * kCells; ++i) {
        const auto at = [&](int digit) { return (((i >> (4 * digit)) & 15) + 0.5) / kCells; };
        const double d2 = 1.0 + (at(0) - at(1)) * (at(0) - at(1)) + (at(2) - at(3)) * (at(2) - at(3));
        const double ci = 1.0 / std::sqrt(d2);
        const double ct = std::sqrt(1.0 - (1.0 - ci * ci) / 2.25);
        const double rs = (ci - 1.5 * ct) / (ci + 1.5 * ct);
        const double rp = (1.5 * ci - ct) / (1.5 * ci + ct);
        const double r = 0.5 * (rs * rs + rp * rp);
        expected += (1.0 - r) / (1.0 + r) / (kPiD * d2 * d2) / (double(kCells) * kCells * kCells * kCells);
    }
    EXPECT_NEAR(factor(s, exchange, 0, 1) / expected, 1.0, 0.01);
    for (std::size_t i = 0; i < s.leaves.size(); ++i) {
        EXPECT_LE(exchange.row_sums()[i], 1.0001F);
        const bool pane = s.hierarchy.elements[s.leaves[i]].surface == 2;
        EXPECT_EQ(exchange.opacity()[i] < 1.0F, pane);
        EXPECT_LT(exchange.opacity()[i], pane ? 0.35F : 1.1F);
    }
}

// ENC-FURNACE, and X-RHO where 1 - rho is 1e-4: B = M / (1 - rho) everywhere, in few sweeps whatever the reflectance.
class FurnaceSweeps : public testing::TestWithParam<float> {};

TEST_P(FurnaceSweeps, HardlyGrowWithReflectance) {
    const float rho = GetParam();
    Scene scene;
    const MaterialId m = add_material(scene, rho, 1.0F);
    add_room(scene, 4, 3, 5, m);
    Material both = *scene.materials.find(m);
    both.double_sided = true;
    add_rectangle(scene, "screen", {2, 1, 2}, {1, 0, 0}, {0, 0, 1}, 1, 1.8F, scene.materials.insert(both));
    Leaves s(scene, 3);
    const SolveReport report = solve_radiosity(s.hierarchy, s.exchange(), 1e-4, 400, RunContext{});
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.iterations, 25);
    double worst = 0.0;
    for (const std::uint32_t leaf : s.leaves) {
        worst = std::max(worst, std::abs(double(s.hierarchy.elements[leaf].radiosity.r) * (1.0 - double(rho)) - 1.0));
    }
    EXPECT_LT(worst, rho < 0.9995F ? 1e-3 : 1e-2);
    std::printf("furnace rho %.4f: %d sweeps, worst leaf off by %.2e\n", double(rho), report.iterations, worst);
}
INSTANTIATE_TEST_SUITE_P(Reflectances, FurnaceSweeps, testing::Values(0.0F, 0.5F, 0.9F, 0.99F, 0.999F, 0.9999F));

// A lamp on part of one wall, walls of different greys: no symmetry helps the solver.
TEST(LeafExchange, AnUnevenRoomOfHighReflectanceTakesFewSweepsToo) {
    Scene scene;
    const std::array<MaterialId, 6> m{add_material(scene, 0.999F),       add_material(scene, 0.999F),
                                      add_material(scene, 0.99F, 10.0F), add_material(scene, 0.999F),
                                      add_material(scene, 0.999F),       add_material(scene, 0.995F)};
    add_room(scene, 4, 3, 8, m);
    Leaves s(scene, 3);
    const SolveReport report = solve_radiosity(s.hierarchy, s.exchange(), 1e-4, 400, RunContext{});
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.iterations, 25);
    double emitted = 0.0;
    double absorbed = 0.0;
    for (const std::uint32_t leaf : s.leaves) {
        const Element& e = s.hierarchy.elements[leaf];
        emitted += double(e.area) * e.emitted.r;
        absorbed += double(e.area) * (1.0 - double(e.rho.r)) * e.irradiance.r;
    }
    EXPECT_NEAR(absorbed / emitted, 1.0, 0.01);
    std::printf("uneven room: %d sweeps, absorbed / emitted = %.5f\n", report.iterations, absorbed / emitted);
}

// ENC-MMS-CUBE: emission chosen so that every face has one radiosity. Their z is our y.
struct Manufactured {
    std::array<double, 6> radiosity{4, 5, 6, 5, 4, 6}; // floor, ceiling, x0, x1, y0, y1 in the order of add_room
    static const std::vector<std::array<vec3, 4>>& faces() {
        static const std::vector<std::array<vec3, 4>> all{
            {{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}}, {{{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}},
            {{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}}, {{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}},
            {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}}};
        return all;
    }
    [[nodiscard]] double irradiance(const vec3& p, const vec3& n, std::size_t own) const {
        double sum = 0.0;
        for (std::size_t f = 0; f < 6; ++f) {
            sum += f == own ? 0.0 : radiosity[f] * form_factor_to_polygon(p, n, faces()[f]);
        }
        return sum;
    }
};

// Gives every leaf its mean emission: 3 x 3 Gauss points.
void emit(Leaves& s, const Manufactured& truth, float rho) {
    constexpr std::array<float, 3> kAt{0.112701665F, 0.5F, 0.887298335F};
    constexpr std::array<double, 3> kWeight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    for (const std::uint32_t leaf : s.leaves) {
        Element& e = s.hierarchy.elements[leaf];
        const auto& c = s.hierarchy.corners(e);
        double received = 0.0;
        for (std::size_t i = 0; i < 9; ++i) {
            const std::size_t u = i % 3, v = i / 3;
            const vec3 p = c[0] + (c[1] - c[0]) * kAt[u] + (c[3] - c[0]) * kAt[v] + s.origin();
            received += kWeight[u] * kWeight[v] * truth.irradiance(p, e.normal, e.surface);
        }
        e.emitted = Rgb(float(truth.radiosity[e.surface] - double(rho) * received));
    }
}

// What a viewer gets: light gathered at points from the leaves by exact form factors; mean square of its relative error.
// Points keep `margin` off the edges, along which single elements fill half the view.
double gathered_error(const Leaves& s, const Manufactured& truth, float margin) {
    double error = 0.0;
    constexpr std::uint32_t kPoints = 192;
    for (std::uint32_t i = 0; i < kPoints; ++i) {
        const std::size_t face = i % 6;
        const auto& c = Manufactured::faces()[face];
        const vec2 u = sobol_owen2(i, 0, 3U) * (1.0F - 2.0F * margin) + vec2(margin);
        const vec3 p = c[0] + (c[1] - c[0]) * u.x + (c[3] - c[0]) * u.y;
        const vec3 n = glm::normalize(glm::cross(c[1] - c[0], c[3] - c[0]));
        double sum = 0.0;
        for (const std::uint32_t leaf : s.leaves) {
            const Element& e = s.hierarchy.elements[leaf];
            if (e.surface != face) {
                sum += double(e.radiosity.r) * form_factor_to_polygon(p - s.origin(), n, s.hierarchy.corners(e));
            }
        }
        const double d = sum / truth.irradiance(p, n, face) - 1.0;
        error += d * d / kPoints;
    }
    return error;
}

TEST(LeafExchange, ManufacturedSolutionConvergesWithElementSize) {
    constexpr float kRho = 0.5F;
    const Manufactured truth;
    EXPECT_NEAR(truth.irradiance({0.5F, 0, 0.5F}, {0, 1, 0}, 0), 5.19013588238, 1e-6);
    EXPECT_NEAR(truth.irradiance({0.9F, 0, 0.1F}, {0, 1, 0}, 0), 4.79962653931, 1e-6);
    Scene scene;
    add_room(scene, 1, 1, 1, add_material(scene, kRho));
    std::printf("ENC-MMS-CUBE: elements  edge      leaf rms   leaf bias  gathered rms  at edges too  estimate  sweeps\n");
    std::vector<double> gathered;
    for (int level = 1; level <= 4; ++level) {
        // As the qualities do, half the size goes with twice the rays.
        const std::uint32_t per_leaf = 16U << level;
        // Chance has its share: the mean square over four sets of rays.
        constexpr std::uint32_t kSeeds = 4;
        double square = 0.0;
        double bias = 0.0;
        double error = 0.0;
        double everywhere = 0.0;
        double estimate = 0.0;
        std::size_t count = 0;
        int sweeps = 0;
        for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
            Leaves s(scene, level, seed);
            count = s.leaves.size();
            emit(s, truth, kRho);
            const LeafExchange exchange = s.exchange(per_leaf);
            const SolveReport report = solve_radiosity(s.hierarchy, exchange, 1e-5, 100, RunContext{});
            sweeps = std::max(sweeps, report.iterations);
            for (const std::uint32_t leaf : s.leaves) {
                const Element& e = s.hierarchy.elements[leaf];
                const double d = double(e.radiosity.r) / truth.radiosity[e.surface] - 1.0;
                square += d * d / double(count * kSeeds);
                bias += d / double(count * kSeeds);
            }
            error += gathered_error(s, truth, 0.1F) / kSeeds;
            everywhere += gathered_error(s, truth, 1e-3F) / kSeeds;
            const double own = exchange.error_estimate(s.hierarchy, report);
            estimate += own * own / kSeeds;
        }
        gathered.push_back(std::sqrt(error));
        estimate = std::sqrt(estimate);
        everywhere = std::sqrt(everywhere);
        std::printf("              %9zu  1/%-4d  %10.2e  %+10.2e  %12.2e  %12.2e  %8.2e  %6d\n", count, 1 << level,
                    std::sqrt(square), bias, gathered.back(), everywhere, estimate, sweeps);
        EXPECT_GT(estimate, 0.5 * everywhere);
        EXPECT_LT(estimate, 2.0 * everywhere);
    }
    // At least linear over three halvings, and 1e-3 in the end, as the case asks.
    EXPECT_LT(gathered.back(), gathered.front() / 8.0);
    EXPECT_LT(gathered.back(), 1e-3);
}

} // namespace
} // namespace atrium
