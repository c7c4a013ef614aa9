// Caustic textures: chosen, sized, filled and restricted; energy kept, uniform light left alone.
#include "engine/base/parallel.h"
#include "engine/caustics/reconstruction.h"
#include "engine/caustics/resolution.h"
#include "engine/caustics/restriction.h"
#include "tests/support/charted.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace atrium {
namespace {

using test::at_place;
using test::Charted;
using test::power_of;
using test::rectangle;
using test::spot;

TEST(CausticResolution, Equation7) { // PAPER-TEXRES
    struct Case {
        double n, epsilon;
        int level;
    };
    for (const Case& c : {Case{10, 1, 0}, Case{100, 1, 2}, Case{1000, 1, 3}, Case{10000, 1, 5}, Case{100000, 1, 7},
                          Case{1000000, 1, 8}, Case{10000, 0.1, 3}}) {
        EXPECT_EQ(caustic_level(c.n, c.epsilon), c.level) << c.n;
    }
    EXPECT_EQ(caustic_level(0, 1), 0);
    EXPECT_EQ(caustic_level(1e300, 1), 15);
}

TEST(CausticResolution, TexelsAreNearlySquare) {
    for (const vec2& extent : {vec2(1, 1), vec2(4, 1), vec2(1, 16), vec2(3, 1)}) {
        const TexelCount c = paper_resolution(6, extent);
        const double ratio = (extent.x / float(c.width)) / (extent.y / float(c.height));
        EXPECT_GE(ratio, 0.49);
        EXPECT_LE(ratio, 2.01);
        EXPECT_EQ(c.width * c.height, 4096U);
    }
}

TEST(CausticTextures, SpotGetsATextureThatFitsIt) {
    const Charted c(rectangle(4, 4));
    const auto landings = spot(c, 20'000, {1.0F, 1.5F}, 0.2F);
    for (const bool paper : {false, true}) {
        CausticSettings settings;
        settings.paper = paper;
        const CausticSide side = c.build(landings, settings);
        ASSERT_EQ(side.textures.size(), 1U) << paper;
        ASSERT_EQ(side.records.size(), 1U);
        EXPECT_EQ(side.records[0].decision, CausticRecord::Decision::Texture);
        EXPECT_NEAR(power_of(side, landings), 1.0, 1e-5);
        const CausticTexture& t = *side.textures[0];
        const vec2 size = (t.high - t.low) * c.charts.charts[0].scale;
        EXPECT_LT(std::max(size.x, size.y), paper ? 0.8F : 0.6F);
        EXPECT_GE(std::min(size.x, size.y), 0.4F);
        const float expected = 1.0F / (kPi * 0.2F * 0.2F);
        const CausticLanding middle = at_place(c, {1.0F, 1.5F}, 0, 0);
        EXPECT_NEAR(t.irradiance(middle.uv).g, expected, (paper ? 0.5F : 0.05F) * expected);
        // The integral of what is shown is the power: on a flat chart all texels have one area.
        double sum = 0.0;
        for (const Rgb& p : t.image) {
            sum += p.g;
        }
        const double texel = double(size.x) * size.y / double(t.image.size());
        EXPECT_NEAR(sum * texel, side.records[0].power_texture, 1e-4);
    }
}

TEST(CausticTextures, TwoSpotsGetTwoBoxes) {
    const Charted c(rectangle(4, 4));
    auto landings = spot(c, 5000, {0.6F, 0.6F}, 0.15F);
    const auto more = spot(c, 5000, {3.2F, 3.0F}, 0.15F, 2);
    landings.insert(landings.end(), more.begin(), more.end());
    const CausticSide side = c.build(landings);
    ASSERT_EQ(side.textures.size(), 2U);
    EXPECT_NEAR(power_of(side, landings), 2.0, 1e-5);
    for (const vec4& box : side.records[0].boxes) {
        EXPECT_LT(box.x, box.z);
        EXPECT_LT(box.y, box.w);
        EXPECT_GE(box.x, 0.0F);
        EXPECT_LE(box.z, 1.0F);
    }
}

TEST(CausticTextures, EdgesOfTheChartDoNotDarken) {
    // Half of the wall is lit, up to its edges.
    const Charted c(rectangle(1, 1));
    std::vector<CausticLanding> landings;
    constexpr std::uint32_t kN = 40'000;
    for (std::uint32_t i = 0; i < kN; ++i) {
        const vec2 u = sobol_owen2(i, 0, 3);
        landings.push_back(at_place(c, {0.5F * u.x, u.y}, 0.5F / float(kN), 1.5F * std::sqrt(0.5F / float(kN))));
    }
    const CausticSide side = c.build(landings);
    ASSERT_EQ(side.textures.size(), 1U);
    const auto mean_along = [&](const vec2& from, const vec2& to) {
        double sum = 0.0;
        for (int i = 0; i < 64; ++i) {
            const vec2 p = from + (to - from) * ((float(i) + 0.5F) / 64.0F);
            sum += side.textures[0]->irradiance(at_place(c, p, 0, 0).uv).g;
        }
        return sum / 64.0;
    };
    EXPECT_NEAR(mean_along({0.001F, 0.0F}, {0.001F, 1.0F}), 1.0, 0.05);
    EXPECT_NEAR(mean_along({0.0F, 0.999F}, {0.45F, 0.999F}), 1.0, 0.05);
    EXPECT_NEAR(mean_along({0.25F, 0.0F}, {0.25F, 1.0F}), 1.0, 0.03);
    EXPECT_NEAR(side.textures[0]->irradiance(at_place(c, {0.6F, 0.5F}, 0, 0).uv).g, 0.0F, 1e-3F);
}

TEST(CausticTextures, SameForAnyOrderAndAnyNumberOfThreads) {
    const Charted c(rectangle(4, 4));
    auto landings = spot(c, 20'000, {1.0F, 1.5F}, 0.2F);
    const CausticSide first = c.build(landings);
    std::mt19937 engine(5);
    for (const unsigned threads : {1U, 2U, 8U}) {
        std::shuffle(landings.begin(), landings.end(), engine);
        set_thread_limit(threads);
        const CausticSide again = c.build(landings);
        set_thread_limit(0);
        ASSERT_EQ(first.textures.size(), again.textures.size());
        for (std::size_t i = 0; i < first.textures.size(); ++i) {
            EXPECT_EQ(*first.textures[i], *again.textures[i]);
        }
    }
}

TEST(CausticTextures, TakingALandingAwayRestoresTheBits) {
    const Charted c(rectangle(2, 2));
    const auto landings = spot(c, 2000, {1.0F, 1.0F}, 0.5F);
    const std::vector<ChartDomain> domains = chart_domains(c.charts, c.mesh->positions, c.triangles);
    const TexelGrid grid =
        make_grid(domains[0], c.charts, c.mesh->positions, c.triangles, domains[0].low, domains[0].high, 64, 64);
    CausticAccumulator half(grid.size());
    LitRange range;
    range.last = {64, 64};
    for (std::size_t i = 0; i < 1000; ++i) {
        splat(landings[i], grid, range, {}, half);
    }
    CausticAccumulator sums = half;
    for (std::size_t i = 1000; i < 2000; ++i) {
        splat(landings[i], grid, range, {}, sums);
    }
    EXPECT_FALSE(sums == half);
    for (std::size_t i = 2000; i-- > 1000;) {
        splat(landings[i], grid, range, {}, sums, -1.0);
    }
    EXPECT_TRUE(sums == half);
}

TEST(CausticTextures, TexelAreasAreThoseOfTheSurface) {
    for (const Geometry& g : {Geometry(Polygon{{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, {}}),
                              Geometry(Sphere{1.0F}), Geometry(Cone{1.0F, 0.2F, 1.0F, true}), Geometry(Disc{1.0F})}) {
        const Charted c(g);
        for (const ChartDomain& d : chart_domains(c.charts, c.mesh->positions, c.triangles)) {
            const TexelGrid grid = make_grid(d, c.charts, c.mesh->positions, c.triangles, d.low, d.high, 37, 23);
            double sum = 0.0;
            for (const double a : grid.area) {
                sum += a;
            }
            EXPECT_NEAR(sum, d.area, 1e-4 * d.area);
        }
    }
}

TEST(CausticTextures, ExtremeInput) { // X-TEXTURE-0
    const Charted c(rectangle(1, 1));
    for (const bool paper : {false, true}) {
        CausticSettings settings;
        settings.paper = paper;
        for (const std::size_t n : {0U, 1U, 9U, 10U, 11U, 1000U}) {
            // All in one place; on the border; without a footprint.
            for (const vec2& place : {vec2(0.5F, 0.5F), vec2(0.0F, 0.0F), vec2(1.0F, 0.3F)}) {
                for (const float radius : {0.0F, 0.01F, 1e9F}) {
                    std::vector<CausticLanding> landings(n, at_place(c, place, 1.0F, radius));
                    const CausticSide side = c.build(landings, settings);
                    EXPECT_NEAR(power_of(side, landings), double(n), 1e-5 * double(n)) << n;
                    if (n < 10) {
                        EXPECT_TRUE(side.textures.empty());
                    }
                    for (const auto& t : side.textures) {
                        EXPECT_LT(t->low.x, t->high.x);
                        EXPECT_LT(t->low.y, t->high.y);
                        for (const Rgb& p : t->image) {
                            EXPECT_TRUE(is_finite(p) && p.r >= 0.0F);
                        }
                    }
                }
            }
        }
    }
    // Scaled flat: nothing to land on, nothing to divide by.
    const Charted flat(rectangle(1, 1e-12F));
    EXPECT_TRUE(flat.build({}).textures.empty());
}

TEST(CausticRestriction, ComponentsAndMerging) {
    const std::vector<std::uint8_t> marked = {1, 1, 0, 0, 0, //
                                              0, 0, 1, 0, 0, //
                                              0, 0, 0, 0, 1};
    const std::vector<CellBox> boxes = component_boxes(marked, 5, 3);
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_EQ(boxes[0], (CellBox{0, 0, 3, 2}));
    EXPECT_EQ(boxes[1], (CellBox{4, 2, 5, 3}));
    EXPECT_EQ(merge_boxes(boxes, 1.2, 16).size(), 2U);
    EXPECT_EQ(merge_boxes(boxes, 1.2, 1).size(), 1U);
    EXPECT_EQ(merge_boxes({{0, 0, 4, 4}, {2, 2, 6, 6}}, 1.2, 16), (std::vector<CellBox>{{0, 0, 6, 6}}));
}

} // namespace
} // namespace atrium
