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

// A focus a thousand times as bright as the light around it: the box ends in that light, and must not show.
TEST(CausticTextures, BoxesFadeIntoTheLightAroundThem) {
    const Charted c(rectangle(3, 3));
    constexpr float kCore = 0.02F, kEnd = 1.2F;
    constexpr std::uint32_t kN = 60'000;
    const float whole = 1.0F - 1.0F / std::sqrt(1.0F + kEnd * kEnd / (kCore * kCore));
    // Lumen per square metre at a distance of the middle: (1 + r^2 / core^2)^-1.5, one lumen in all.
    const auto density = [&](float r) {
        return std::pow(1.0F + r * r / (kCore * kCore), -1.5F) / (2.0F * kPi * kCore * kCore * whole);
    };
    std::vector<CausticLanding> landings;
    for (std::uint32_t i = 0; i < kN; ++i) {
        const vec2 u = sobol_owen2(i, 0, 11);
        const float left = 1.0F - u.x * whole;
        const float r = kCore * std::sqrt(std::max(1.0F / (left * left) - 1.0F, 0.0F));
        const vec2 p = vec2(1.5F) + r * vec2(std::cos(2.0F * kPi * u.y), std::sin(2.0F * kPi * u.y));
        landings.push_back(at_place(c, p, 1.0F / float(kN), 1.5F / std::sqrt(float(kN) * density(r))));
    }
    const CausticSide side = c.build(landings);
    ASSERT_EQ(side.textures.size(), 2U) << "the focus, and what is around it";
    EXPECT_NEAR(power_of(side, landings), 1.0, 1e-5);
    const auto fine = [](const CausticTexture& t) { return (t.high.x - t.low.x) / float(t.width); };
    EXPECT_LT(2.0F * fine(*side.textures[0]), fine(*side.textures[1]));
    // All round at the distances where the focus' box ends: neither a dent nor a ridge.
    const float half = 0.5F * (side.textures[0]->high.x - side.textures[0]->low.x) * c.charts.charts[0].scale.x;
    ASSERT_LT(half, 0.5F);
    for (const float part : {0.5F, 0.7F, 0.8F, 0.9F, 0.95F, 1.0F, 1.05F, 1.1F, 1.2F, 1.5F, 2.0F}) {
        double sum = 0.0;
        constexpr int kAround = 400;
        for (int i = 0; i < kAround; ++i) {
            const float angle = 2.0F * kPi * float(i) / kAround;
            const vec2 p = vec2(1.5F) + part * half * vec2(std::cos(angle), std::sin(angle));
            for (const auto& t : side.textures) {
                sum += t->irradiance(at_place(c, p, 0, 0).uv).g;
            }
        }
        EXPECT_NEAR(sum / kAround / density(part * half), 1.0, 0.08) << part;
    }
    // Nothing is left of the focus' light where its box ends.
    const CausticTexture& t = *side.textures[0];
    for (std::uint32_t k = 0; k < t.width; ++k) {
        EXPECT_EQ(t.image[k].g, 0.0F);
        EXPECT_EQ(t.image[std::size_t(t.height - 1) * t.width + k].g, 0.0F);
        EXPECT_LT(t.image[std::size_t(2) * t.width + k].g, 0.5F * density(half));
    }
}

// Spots of light of all colours and powers on every chart, over faint even light, with footprints of all shapes and none.
std::vector<CausticLanding> motley(const Charted& c, std::size_t n, std::uint32_t seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    std::lognormal_distribution<float> power(-8.0F, 1.5F);
    std::vector<CausticLanding> out;
    for (std::size_t i = 0; i < n; ++i) {
        CausticLanding l = c.landing(uniform(engine), vec2(uniform(engine), uniform(engine)));
        if (i % 8 != 0) { // close to one corner of a triangle
            l = c.landing(0.37F * float(i % 3), vec2(uniform(engine), uniform(engine)));
            l.barycentric *= 0.05F;
            c.place(l);
        }
        l.power = Rgb(uniform(engine), uniform(engine), uniform(engine)) * power(engine);
        if (i % 16 != 5) {
            l.axis_a = vec2(uniform(engine), uniform(engine)) * 0.2F;
            l.axis_b = vec2(uniform(engine), -uniform(engine)) * 0.2F;
        }
        out.push_back(l);
    }
    return out;
}

std::vector<Geometry> shapes() {
    return {rectangle(4, 4),
            rectangle(8, 0.5F),
            Polygon{{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, {}},
            Polygon{{{0, 0}, {5, 0}, {4.9F, 1.3F}}, {}},
            Polygon{{{0, 0}, {3, 0}, {3, 3}, {0, 3}}, {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}}},
            Sphere{1.0F},
            Cylinder{0.5F, 2.0F, true},
            Cone{1.0F, 0.0F, 1.5F, true},
            Disc{1.5F},
            Box{{1, 2, 0.5F}}};
}

// A result without indices: what must not depend on the order of the landings.
struct Comparable {
    std::vector<CausticTexture> textures;
    std::vector<CausticRecord> records;
    std::vector<std::array<float, 3>> on_mesh; ///< uv and power
    Comparable(const CausticSide& side, const std::vector<CausticLanding>& landings) : records(side.records) {
        for (const auto& t : side.textures) {
            textures.push_back(*t);
        }
        for (const std::uint32_t i : side.on_mesh) {
            on_mesh.push_back({landings[i].uv.x, landings[i].uv.y, landings[i].power.g});
        }
        std::sort(on_mesh.begin(), on_mesh.end());
    }
    friend bool operator==(const Comparable&, const Comparable&) = default;
};

TEST(CausticTextures, SameForAnyOrderAndAnyNumberOfThreads) {
    std::size_t textures = 0;
    for (const Geometry& shape : {rectangle(4, 4), Geometry(Sphere{1.0F}), Geometry(Box{{1, 2, 0.5F}})}) {
        const Charted c(shape);
        for (const std::size_t n : {2000U, 250'000U}) { // of the many each thread has sums of its own
            auto landings = motley(c, n, 1);
            for (const bool paper : {false, true}) {
                CausticSettings settings;
                settings.paper = paper;
                const Comparable first(c.build(landings, settings), landings);
                textures += first.textures.size();
                std::mt19937 engine(5);
                for (const unsigned threads : {1U, 2U, 8U}) {
                    std::shuffle(landings.begin(), landings.end(), engine);
                    set_thread_limit(threads);
                    const CausticSide again = c.build(landings, settings);
                    set_thread_limit(0);
                    EXPECT_TRUE(first == Comparable(again, landings)) << n << (paper ? " paper, " : " ") << threads;
                    EXPECT_TRUE(std::is_sorted(again.on_mesh.begin(), again.on_mesh.end()));
                }
            }
        }
    }
    EXPECT_GE(textures, 12U);
}

TEST(CausticTextures, TexturesAndMeshHoldThePowerOnEveryShape) {
    std::size_t textures = 0;
    for (const Geometry& shape : shapes()) {
        const Charted c(shape);
        const std::vector<ChartDomain> domains = chart_domains(c.charts, c.mesh->positions, c.triangles);
        for (const std::size_t n : {300U, 20'000U}) {
            const auto landings = motley(c, n, 2);
            dvec3 all(0.0);
            for (const CausticLanding& l : landings) {
                all += dvec3(l.power);
            }
            for (const bool paper : {false, true}) {
                CausticSettings settings;
                settings.paper = paper;
                const CausticSide side = c.build(landings, settings);
                textures += side.textures.size();
                dvec3 found(0.0);
                double recorded = 0.0;
                std::size_t next = 0;
                for (const CausticRecord& r : side.records) {
                    dvec3 own(0.0);
                    for (const vec4& box : r.boxes) {
                        EXPECT_TRUE(box.x < box.z && box.y < box.w) << "empty or inverted";
                        EXPECT_TRUE(box.x >= -1e-5F && box.y >= -1e-5F && box.z <= 1.00001F && box.w <= 1.00001F);
                        const CausticTexture& t = *side.textures.at(next++);
                        const TexelGrid grid = make_grid(domains[r.chart], c.charts, c.mesh->positions, c.triangles, t.low,
                                                         t.high, t.width, t.height);
                        for (std::size_t i = 0; i < t.image.size(); ++i) {
                            EXPECT_TRUE(is_finite(t.image[i]) && t.image[i].r >= 0.0F);
                            own += dvec3(t.image[i]) * grid.area[i];
                        }
                    }
                    EXPECT_NEAR(double(luminance(Rgb(own))), r.power_texture, 1e-5 * (r.power_texture + r.power_mesh));
                    found += own;
                    recorded += r.power_texture + r.power_mesh;
                }
                EXPECT_EQ(next, side.textures.size());
                for (const std::uint32_t i : side.on_mesh) {
                    found += dvec3(landings[i].power);
                }
                for (int k = 0; k < 3; ++k) {
                    EXPECT_NEAR(found[k], all[k], 1e-5 * all[k]) << shape.index() << (paper ? " paper " : " ") << n;
                }
                EXPECT_NEAR(recorded, double(luminance(Rgb(all))), 1e-5 * double(luminance(Rgb(all))));
            }
        }
    }
    EXPECT_GE(textures, 40U);
}

TEST(CausticTextures, MemoryIsBounded) {
    const Charted c(Box{{1, 2, 0.5F}});
    const auto landings = motley(c, 50'000, 3);
    for (const std::uint32_t most : {4096U, 65'536U}) {
        for (const bool paper : {false, true}) {
            CausticSettings settings;
            settings.paper = paper;
            settings.most_texels = most;
            const CausticSide side = c.build(landings, settings);
            std::size_t texels = 0, rings = 0;
            for (const auto& t : side.textures) {
                texels += t->image.size();
                rings += 2 * (std::size_t(t->width) + t->height) + 4; // black ones around
            }
            EXPECT_LE(texels, most + rings + 6 * 256)
                << most << (paper ? " paper" : ""); // little for each chart in any case
            EXPECT_GT(texels, 0U);
        }
    }
}

TEST(CausticTextures, WhatHasNoChartGoesToTheMesh) {
    ChartSettings none;
    none.smallest_extent = 100.0F;
    Charted c(rectangle(2, 2));
    const auto landings = spot(c, 1000, {1.0F, 1.0F}, 0.1F);
    c.charts = build_charts(c.mesh->positions, c.triangles, {}, none);
    const CausticSide side = c.build(landings);
    EXPECT_TRUE(side.textures.empty());
    EXPECT_EQ(side.on_mesh.size(), landings.size());
    ASSERT_EQ(side.records.size(), 1U);
    EXPECT_EQ(side.records[0].decision, CausticRecord::Decision::Uncharted);
    EXPECT_EQ(side.records[0].chart, SurfaceCharts::kNone);
    EXPECT_EQ(side.records[0].particles, 1000U);
    EXPECT_NEAR(side.records[0].power_mesh, 1.0, 1e-5);
}

TEST(CausticTextures, TakingALandingAwayRestoresTheBits) {
    const Charted c(Cone{1.0F, 0.0F, 1.5F, true}); // areas that differ
    const auto landings = motley(c, 2000, 4);
    const std::vector<ChartDomain> domains = chart_domains(c.charts, c.mesh->positions, c.triangles);
    for (const ChartDomain& d : domains) {
        const TexelGrid grid = make_grid(d, c.charts, c.mesh->positions, c.triangles, d.low, d.high, 64, 64);
        LitRange range;
        range.last = {64, 64};
        range.edge_low = vec2(0.0F);
        range.edge_high = vec2(64.0F);
        const auto fresh = [&](const std::vector<std::uint8_t>& in) {
            CausticAccumulator sums(grid.size());
            for (std::size_t i = 0; i < in.size(); ++i) {
                if (in[i] != 0) {
                    splat(landings[i], grid, range, {}, sums);
                }
            }
            return sums;
        };
        // A thousand times one in or out; then as if those that are left had been added alone.
        std::vector<std::uint8_t> in(landings.size(), 0);
        CausticAccumulator sums(grid.size());
        std::mt19937 engine(6);
        for (int step = 0; step < 1000; ++step) {
            const std::size_t i = engine() % landings.size();
            splat(landings[i], grid, range, {}, sums, in[i] != 0 ? -1.0 : 1.0);
            in[i] ^= 1U;
        }
        EXPECT_TRUE(sums == fresh(in));
        EXPECT_FALSE(sums == CausticAccumulator(grid.size()));
        for (std::size_t i = 0; i < in.size(); ++i) {
            if (in[i] != 0) {
                splat(landings[i], grid, range, {}, sums, -1.0);
            }
        }
        EXPECT_TRUE(sums == CausticAccumulator(grid.size()));
    }
}

TEST(CausticTextures, TexelAreasAreThoseOfTheSurface) {
    for (const Geometry& g : shapes()) {
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
    // Far more light in one place than there can be: finite all the same, and none of it lost.
    for (const float power : {1e-6F, 1e3F, 1e9F}) {
        const std::vector<CausticLanding> landings(1000, at_place(c, {0.5F, 0.5F}, power, 0.0F));
        const CausticSide side = c.build(landings);
        EXPECT_NEAR(power_of(side, landings), 1000.0 * double(power), 1e-5 * 1000.0 * double(power));
        for (const auto& t : side.textures) {
            double sum = 0.0;
            for (const Rgb& p : t->image) {
                EXPECT_GE(p.g, 0.0F);
                sum += double(p.g);
            }
            const vec2 size = (t->high - t->low) * c.charts.charts[0].scale;
            EXPECT_NEAR(sum * double(size.x) * double(size.y) / double(t->image.size()), side.records[0].power_texture,
                        1e-4 * side.records[0].power_texture);
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
