// Mesh or texture: uniform light never gets a texture, light finer than the mesh does.
#include "engine/caustics/choice.h"
#include "tests/support/charted.h"

#include <gtest/gtest.h>

#include <random>

namespace atrium {
namespace {

using test::at_place;
using test::Charted;
using test::rectangle;
using test::spot;

Geometry l_shape() { return Polygon{{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, {}}; }
Geometry sail() { return Polygon{{{0, 0}, {5, 0}, {4.9F, 1.3F}}, {}}; } // slivers along its edges, no right angle

// A folded sheet of many triangles, uneven in size.
Geometry sheet() {
    auto mesh = std::make_shared<MeshData>();
    constexpr int kN = 40;
    for (int j = 0; j <= kN; ++j) {
        for (int i = 0; i <= kN; ++i) {
            const float x = 3.0F * std::pow(float(i) / kN, 1.5F), y = 2.0F * float(j) / kN;
            mesh->positions.emplace_back(x, y, std::max(x - 1.5F, 0.0F));
        }
    }
    for (std::uint32_t j = 0; j < kN; ++j) {
        for (std::uint32_t i = 0; i < kN; ++i) {
            const std::uint32_t v = j * (kN + 1) + i;
            for (const std::uint32_t k : {v, v + 1, v + kN + 2, v, v + kN + 2, v + kN + 1}) {
                mesh->indices.push_back(k);
            }
        }
    }
    mesh->parts.push_back({0, std::uint32_t(mesh->indices.size())});
    return Mesh{mesh};
}

TEST(CausticChoice, Equation2) { // PAPER-UNIFORMITY
    EXPECT_FLOAT_EQ(caustic_contrast(0, 1), 1.0F);
    EXPECT_NEAR(caustic_contrast(9, 10), 0.1F, 1e-6F);
    EXPECT_FLOAT_EQ(caustic_contrast(5, 5), 0.0F);
    EXPECT_FLOAT_EQ(caustic_contrast(0, 0), 0.0F);
}

TEST(CausticChoice, DispersionIsANormalDeviate) {
    // By chance alone: mean 0, deviation 1 and no outliers, for few and many particles, bins of any shares (one of them a
    // sliver) and powers that differ.
    std::mt19937 engine(11);
    for (const int kind : {0, 1, 2}) {
        for (const std::size_t n : {10U, 30U, 300U, 3000U}) {
            std::vector<double> share;
            for (std::size_t i = 0; i < std::max<std::size_t>(n / 16, 9); ++i) {
                share.push_back(kind == 0 ? 1.0 : 0.3 + 0.1 * double(i % 20));
            }
            share.push_back(kind == 0 ? 1.0 : 1e-3);
            std::discrete_distribution<std::size_t> bin(share.begin(), share.end());
            std::exponential_distribution<double> power(8.0);
            double sum = 0.0, squares = 0.0, most = 0.0;
            constexpr int kTrials = 2000;
            for (int trial = 0; trial < kTrials; ++trial) {
                std::vector<double> seen(share.size(), 0.0);
                double s2 = 0.0, s4 = 0.0;
                for (std::size_t i = 0; i < n; ++i) {
                    const double w = kind == 2 ? power(engine) : 1.0;
                    seen[bin(engine)] += w;
                    s2 += w * w;
                    s4 += w * w * w * w;
                }
                const double z = dispersion(seen, share, s2, s4);
                sum += z;
                squares += z * z;
                most = std::max(most, z);
            }
            EXPECT_NEAR(sum / kTrials, 0.0, 0.15) << kind << ", " << n;
            EXPECT_NEAR(std::sqrt(squares / kTrials), 1.0, 0.2) << kind << ", " << n;
            EXPECT_LT(most, 5.2) << kind << ", " << n; // 1e-7 a trial
        }
    }
    // Nothing to say.
    EXPECT_EQ(dispersion(std::vector<double>{1.0}, std::vector<double>{1.0}, 1.0, 1.0), 0.0);
    EXPECT_EQ(dispersion(std::vector<double>{0.0, 0.0}, std::vector<double>{1.0, 1.0}, 0.0, 0.0), 0.0);
    EXPECT_EQ(dispersion(std::vector<double>{1.0, 0.0}, std::vector<double>{1.0, 1.0}, 1.0, 1.0), 0.0);
}

TEST(CausticChoice, UniformLightNeverGetsATexture) {
    const std::vector<Geometry> shapes = {rectangle(3, 3),
                                          rectangle(6, 0.5F),
                                          l_shape(),
                                          sail(),
                                          Sphere{1.0F},
                                          Disc{1.0F},
                                          sheet(),
                                          Cylinder{0.5F, 2.0F, false},
                                          Cone{1.0F, 0.0F, 1.5F, true}};
    enum Placing { Random, Stratified, RandomPower };
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const Charted c(shapes[s]);
        for (const std::size_t n : {10U, 11U, 30U, 100U, 300U, 1000U, 3000U, 10'000U, 100'000U, 1'000'000U}) {
            if (n == 1'000'000U && s > 0) {
                continue;
            }
            for (std::uint32_t seed = 1; seed <= (n <= 1000U ? 20U : n <= 10'000U ? 4U : 1U); ++seed) {
                for (const Placing placing : {Random, Stratified, RandomPower}) {
                    std::mt19937 engine(seed);
                    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
                    std::lognormal_distribution<float> power(0.0F, 1.0F);
                    std::vector<CausticLanding> landings;
                    for (std::size_t i = 0; i < n; ++i) {
                        const auto k = std::uint32_t(i);
                        const float pick = placing == Stratified ? sobol_owen(k, 2, seed) : uniform(engine);
                        const vec2 u =
                            placing == Stratified ? sobol_owen2(k, 0, seed) : vec2(uniform(engine), uniform(engine));
                        landings.push_back(c.landing(pick, u));
                        landings.back().power = Rgb((placing == RandomPower ? power(engine) : 1.0F) / float(n));
                    }
                    for (const bool paper : {false, true}) {
                        CausticSettings settings;
                        settings.paper = paper;
                        const CausticSide side = c.build(landings, settings);
                        EXPECT_TRUE(side.textures.empty()) << "shape " << s << ", " << n << " particles, seed " << seed
                                                           << ", placing " << placing << (paper ? ", paper" : "");
                        EXPECT_EQ(side.on_mesh.size(), n);
                    }
                }
            }
        }
    }
}

TEST(CausticChoice, ThresholdOfParticles) { // X-TEXTURE-0
    const Charted c(rectangle(2, 2));
    using Decision = CausticRecord::Decision;
    for (const vec2& place : {vec2(0.7F, 1.1F), vec2(0.0F, 0.0F), vec2(2.0F, 1.0F), vec2(1.0F, 1.0F)}) {
        for (const std::size_t n : {9U, 10U, 11U}) {
            const std::vector<CausticLanding> landings(n, at_place(c, place, 1.0F, 0.02F));
            const CausticSide side = c.build(landings);
            ASSERT_EQ(side.records.size(), 1U);
            EXPECT_EQ(side.records[0].decision, n < 10 ? Decision::TooFew : Decision::Texture) << n;
            EXPECT_EQ(side.textures.empty(), n < 10);
        }
    }
    // Without power nothing is decided by division by zero.
    const std::vector<CausticLanding> dark(100, at_place(c, {1, 1}, 0.0F, 0.02F));
    for (const bool paper : {false, true}) {
        CausticSettings settings;
        settings.paper = paper;
        const CausticSide side = c.build(dark, settings);
        EXPECT_TRUE(side.textures.empty());
        EXPECT_EQ(side.records.at(0).contrast, 0.0F);
    }
}

TEST(CausticChoice, SmoothLightStaysOnTheMesh) {
    // A lobe whose width is several edges of the mesh, against one of less than an edge.
    const Charted c(rectangle(4, 4));
    for (const std::size_t n : {300U, 1000U, 10'000U, 100'000U, 1'000'000U}) {
        for (const float width : {0.6F, 0.03F}) {
            std::mt19937 engine(3);
            std::normal_distribution<float> offset(0.0F, width);
            std::vector<CausticLanding> landings;
            while (landings.size() < n) {
                const vec2 p(2.0F + offset(engine), 2.0F + offset(engine));
                if (p.x > 0.0F && p.y > 0.0F && p.x < 4.0F && p.y < 4.0F) {
                    landings.push_back(at_place(c, p, 1.0F / float(n), 1.5F * width * std::sqrt(6.0F / float(n))));
                }
            }
            const CausticSide side = c.build(landings);
            EXPECT_EQ(side.records.at(0).decision,
                      width > 0.1F ? CausticRecord::Decision::Coarse : CausticRecord::Decision::Texture)
                << n << " particles, " << width << " m";
            EXPECT_GT(side.records.at(0).dispersion, 6.0F);
        }
    }
}

TEST(CausticChoice, FaintFineLightOverSmoothLightIsSeen) {
    // Half of the power in a disc of a hundredth of the wall, half spread evenly.
    const Charted c(rectangle(2, 2));
    auto landings = spot(c, 5000, {1.0F, 1.0F}, 0.11F);
    for (std::uint32_t i = 0; i < 5000; ++i) {
        landings.push_back(at_place(c, 2.0F * sobol_owen2(i, 0, 7), 1.0F / 5000.0F, 0.05F));
    }
    EXPECT_EQ(c.build(landings).records.at(0).decision, CausticRecord::Decision::Texture);
}

} // namespace
} // namespace atrium
