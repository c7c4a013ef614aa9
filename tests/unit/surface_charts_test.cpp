// Charts against the triangles they are made of: area, coordinates that lead back to the surface, one piece per plane.
#include "engine/geometry/surface_charts.h"
#include "engine/geometry/tessellate.h"
#include "engine/geometry/welding.h"
#include "engine/io/scene_file.h"
#include "engine/raycast/scene_charts.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <random>
#include <set>

namespace atrium {
namespace {

struct Soup {
    std::vector<vec3> positions;
    std::vector<uvec3> triangles;

    std::uint32_t point(const vec3& p) {
        positions.push_back(p);
        return std::uint32_t(positions.size() - 1);
    }
    void triangle(const vec3& a, const vec3& b, const vec3& c) {
        const std::uint32_t first = point(a);
        point(b);
        point(c);
        triangles.emplace_back(first, first + 1, first + 2);
    }
    // Corners of their own, as files with a normal per face have them.
    void rectangle(const vec3& corner, const vec3& u, const vec3& v, int nu = 1, int nv = 1) {
        for (int j = 0; j < nv; ++j) {
            for (int i = 0; i < nu; ++i) {
                const auto at = [&](int a, int b) {
                    return corner + u * (float(a) / float(nu)) + v * (float(b) / float(nv));
                };
                triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
                triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
            }
        }
    }
    [[nodiscard]] SurfaceCharts charts(const ChartSettings& settings = {}) const {
        return build_charts(positions, triangles, {}, settings);
    }
    [[nodiscard]] double area(std::size_t t) const {
        const dvec3 a(positions[triangles[t].x]), b(positions[triangles[t].y]), c(positions[triangles[t].z]);
        return 0.5 * glm::length(glm::cross(b - a, c - a));
    }
};

// What every set of charts must satisfy; the share of the surface's area that is charted. `unevenness` of its planes,
// metres.
double check(const Soup& soup, const SurfaceCharts& charts, double unevenness = 0.0) {
    EXPECT_EQ(charts.chart_of_triangle.size(), soup.triangles.size());
    EXPECT_LE(std::uint64_t(charts.width) * charts.height, 65535U);
    std::vector<double> area(charts.charts.size(), 0.0);
    double all = 0.0, charted = 0.0;
    Box3 box;
    for (const vec3& p : soup.positions) {
        box.add(p);
    }
    double worst = 0.0;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        all += soup.area(t);
        const std::uint32_t id = charts.chart_of_triangle[t];
        if (id == SurfaceCharts::kNone) {
            continue;
        }
        const Chart& chart = charts.charts.at(id);
        area[id] += soup.area(t);
        charted += soup.area(t);
        for (int k = 0; k < 3; ++k) {
            const vec2 uv = charts.uv[t][std::size_t(k)];
            EXPECT_GT(uv.x, float(chart.tile_u));
            EXPECT_GT(uv.y, float(chart.tile_v));
            EXPECT_LT(uv.x, float(chart.tile_u + chart.tiles_u));
            EXPECT_LT(uv.y, float(chart.tile_v + chart.tiles_v));
            if (chart.planar) {
                const vec2 metres = (uv - vec2(float(chart.tile_u), float(chart.tile_v))) * chart.scale;
                const vec3 back = chart.origin + metres.x * chart.axis_u + metres.y * chart.axis_v;
                worst = std::max(worst, double(glm::length(back - soup.positions[soup.triangles[t][k]])));
            }
        }
        if (chart.planar) {
            EXPECT_GT(glm::dot(glm::cross(chart.axis_u, chart.axis_v), chart.normal), 0.9999F);
            const auto& uv = charts.uv[t];
            const vec2 d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
            EXPECT_GT(d1.x * d2.y - d1.y * d2.x, -1e-3F) << "turned over: " << t;
        }
    }
    EXPECT_LE(worst, unevenness + 1e-4 * double(box.diagonal()));
    for (std::size_t i = 0; i < area.size(); ++i) {
        EXPECT_NEAR(area[i], charts.charts[i].area, 1e-4 * area[i]);
        EXPECT_GT(area[i], 0.0);
    }
    // Rectangles lie in the chart space and apart.
    std::set<std::pair<std::uint32_t, std::uint32_t>> taken;
    for (const Chart& c : charts.charts) {
        EXPECT_LE(c.tile_u + c.tiles_u, charts.width);
        EXPECT_LE(c.tile_v + c.tiles_v, charts.height);
        for (std::uint32_t v = c.tile_v; v < c.tile_v + c.tiles_v; ++v) {
            for (std::uint32_t u = c.tile_u; u < c.tile_u + c.tiles_u; ++u) {
                EXPECT_TRUE(taken.emplace(u, v).second);
            }
        }
    }
    return charted / all;
}

TEST(SurfaceCharts, AWallIsOneChartHoweverFinelyItIsCut) {
    for (const int n : {1, 100}) {
        Soup wall;
        wall.rectangle({1, 0, 2}, {4, 0, 0}, {0, 2.5F, 0}, n, n);
        const SurfaceCharts charts = wall.charts();
        ASSERT_EQ(charts.charts.size(), 1U) << n;
        EXPECT_NEAR(check(wall, charts), 1.0, 1e-9);
        const Chart& chart = charts.charts[0];
        EXPECT_EQ(chart.tiles_u, 13U); // 4 m and 2.5 m in tiles of 0.32 m
        EXPECT_EQ(chart.tiles_v, 8U);
        EXPECT_NEAR(glm::length(chart.origin - vec3(1, 0, 2)) * glm::length(chart.origin - vec3(5, 2.5F, 2)), 0.0, 1e-4);
        EXPECT_NEAR(chart.normal.z, 1.0, 1e-6);
        EXPECT_NEAR(chart.area, 10.0, 1e-4);
    }
}

TEST(SurfaceCharts, WholeTilesStayWhole) {
    Soup wall;
    wall.rectangle({-3, 1, 7}, {3.2F, 0, 0}, {0, 0.64F, 0}, 7, 3);
    const SurfaceCharts charts = wall.charts();
    ASSERT_EQ(charts.charts.size(), 1U);
    EXPECT_EQ(charts.charts[0].tiles_u, 10U);
    EXPECT_EQ(charts.charts[0].tiles_v, 2U);
    check(wall, charts);
}

TEST(SurfaceCharts, ABoxHasSix) {
    const auto mesh = tessellate(Box{{1, 2, 3}});
    Soup box{mesh->positions, {}};
    for (std::size_t i = 0; i < mesh->indices.size(); i += 3) {
        box.triangles.emplace_back(mesh->indices[i], mesh->indices[i + 1], mesh->indices[i + 2]);
    }
    const SurfaceCharts charts = box.charts();
    EXPECT_EQ(charts.charts.size(), 6U);
    EXPECT_NEAR(check(box, charts), 1.0, 1e-9);
}

TEST(SurfaceCharts, PiecesOfOnePlaneShareOnlyWhereTheyTouch) {
    Soup apart;
    apart.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    apart.rectangle({2, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(apart.charts().charts.size(), 2U);
    check(apart, apart.charts());

    // No corner of the upper row is one of the lower row: a T-vertex at every joint.
    Soup bricks;
    bricks.rectangle({0, 0, 0}, {3, 0, 0}, {0, 1, 0}, 3, 1);
    bricks.rectangle({0, 1, 0}, {3, 0, 0}, {0, 1, 0}, 4, 1);
    EXPECT_EQ(bricks.charts().charts.size(), 1U);
    EXPECT_NEAR(check(bricks, bricks.charts()), 1.0, 1e-9);

    Soup back_to_back;
    back_to_back.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    back_to_back.rectangle({0, 0, 0}, {0, 1, 0}, {1, 0, 0});
    EXPECT_EQ(back_to_back.charts().charts.size(), 2U);

    Soup step;
    step.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    step.rectangle({1, 0, 0.01F}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(step.charts().charts.size(), 2U);
}

TEST(SurfaceCharts, AnEdgeOfManyTrianglesJoinsThoseOfOnePlane) {
    Soup fins;
    fins.rectangle({-1, 0, 0}, {1, 0, 0}, {0, 1, 0});
    for (int i = 1; i < 6; ++i) {
        const float angle = kPi * float(i) / 6.0F;
        fins.rectangle({0, 0, 0}, {std::cos(angle), 0, std::sin(angle)}, {0, 1, 0});
    }
    fins.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const SurfaceCharts charts = fins.charts();
    EXPECT_EQ(charts.charts.size(), 6U);
    EXPECT_EQ(charts.chart_of_triangle.front(), charts.chart_of_triangle.back());
    check(fins, charts);
}

TEST(SurfaceCharts, TurnedPlanesFarFromTheOriginHaveTightRectangles) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    for (int i = 0; i < 50; ++i) {
        const vec3 n = glm::normalize(vec3(uniform(random), uniform(random), uniform(random)));
        vec3 t, b;
        make_frame(n, t, b);
        const float turn = uniform(random);
        const vec3 u = std::cos(turn) * t + std::sin(turn) * b;
        Soup wall;
        wall.rectangle(vec3(uniform(random), uniform(random), uniform(random)) * 50.0F, 3.0F * u, 2.0F * glm::cross(n, u),
                       20, 30);
        const SurfaceCharts charts = wall.charts();
        ASSERT_EQ(charts.charts.size(), 1U) << i;
        EXPECT_NEAR(check(wall, charts), 1.0, 1e-9);
        EXPECT_EQ(charts.charts[0].tiles_u, 10U); // 3 m and 2 m in tiles of 0.32 m
        EXPECT_EQ(charts.charts[0].tiles_v, 7U);
        EXPECT_GT(std::abs(glm::dot(charts.charts[0].axis_u, u)), 0.9999F);
    }
}

TEST(SurfaceCharts, SmallNarrowAndEmptyPiecesAreLeftOut) {
    Soup soup;
    soup.rectangle({0, 0, 0}, {0.1F, 0, 0}, {0, 0.1F, 0});
    soup.rectangle({0, 0, 1}, {2, 0, 0}, {0, 0.004F, 0});
    soup.triangle({0, 0, 2}, {1, 0, 2}, {2, 0, 2});
    soup.triangle({0, 0, 3}, {0, 0, 3}, {2, 0, 3});
    soup.triangle({0, 0, 4}, {5, 1e-6F, 4}, {9, 0, 4});
    const SurfaceCharts charts = soup.charts();
    EXPECT_TRUE(charts.empty());
    EXPECT_EQ(charts.width, 0U);
    soup.rectangle({0, 0, 5}, {2, 0, 0}, {0, 1, 0});
    const SurfaceCharts one = soup.charts();
    EXPECT_EQ(one.charts.size(), 1U);
    check(soup, one);
    EXPECT_TRUE(build_charts({}, {}, {}, {}).empty());
}

TEST(SurfaceCharts, AnySoupKeepsItsAreaAndPlaces) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    const auto any = [&] { return vec3(uniform(random), uniform(random), uniform(random)); };
    Soup soup;
    for (int i = 0; i < 3000; ++i) {
        const vec3 p = 5.0F * any();
        soup.triangle(p, p + any(), p + any());
    }
    for (int i = 0; i < 3000; ++i) { // many on one plane, over each other, some on edge
        const vec3 p = vec3(4, 4, 0) * any();
        const vec3 a = vec3(1, 1, 0) * any(), b = vec3(1, 1, 0) * any();
        a.x* b.y - a.y* b.x > 0.0F ? soup.triangle(p, p + a, p + b) : soup.triangle(p, p + b, p + a);
    }
    ChartSettings settings;
    settings.smallest_extent = 0.0F;
    settings.smallest_width = 0.0F;
    const SurfaceCharts charts = soup.charts(settings);
    EXPECT_NEAR(check(soup, charts), 1.0, 1e-9);
    EXPECT_LT(charts.charts.size(), 3100U);
}

TEST(SurfaceCharts, LargeSurfacesGetLargerTiles) {
    Soup field;
    field.rectangle({0, 0, 0}, {900, 0, 0}, {0, 0, -700});
    const SurfaceCharts charts = field.charts();
    EXPECT_FLOAT_EQ(charts.tile_edge, 0.32F * 16.0F);
    EXPECT_FLOAT_EQ(charts.charts[0].scale.x, charts.tile_edge);
    check(field, charts);
}

TEST(SurfaceCharts, AFinelyCutCylinderIsNoPlane) {
    // 720 flat strips, each half a degree from the next: strips may join, the round may not.
    Soup tube;
    for (int i = 0; i < 720; ++i) {
        const auto at = [](int k) { return vec3(std::cos(kPi * float(k) / 360.0F), 0, std::sin(kPi * float(k) / 360.0F)); };
        tube.rectangle(3.0F * at(i), 3.0F * (at((i + 1) % 720) - at(i)), {0, 2, 0});
    }
    const SurfaceCharts charts = tube.charts();
    EXPECT_GE(charts.charts.size(), 120U);
    check(tube, charts);
}

struct CurvedCase {
    const char* name;
    Geometry geometry;
    vec2 size; ///< of the rolled-out side, metres
    std::size_t flat_ends;
};
void PrintTo(const CurvedCase& c, std::ostream* out) { *out << c.name; }

class Curved : public testing::TestWithParam<CurvedCase> {};

TEST_P(Curved, SidesRollOutAndEndsAreFlat) {
    const CurvedCase& c = GetParam();
    const auto mesh = tessellate(c.geometry);
    Soup soup{mesh->positions, {}};
    for (std::size_t i = 0; i < mesh->indices.size(); i += 3) {
        soup.triangles.emplace_back(mesh->indices[i], mesh->indices[i + 1], mesh->indices[i + 2]);
    }
    const std::vector<vec2> domain = curved_domain(c.geometry, *mesh);
    const SurfaceCharts charts = build_charts(soup.positions, soup.triangles, domain, {});
    EXPECT_NEAR(check(soup, charts), 1.0, 1e-9);
    std::size_t flat = 0;
    for (const Chart& chart : charts.charts) {
        flat += chart.planar ? 1 : 0;
        if (!chart.planar) {
            const vec2 metres = vec2(float(chart.tiles_u), float(chart.tiles_v)) * chart.scale;
            EXPECT_NEAR(metres.x, c.size.x, 0.01F * c.size.x);
            EXPECT_NEAR(metres.y, c.size.y, 0.01F * c.size.y);
        }
    }
    EXPECT_EQ(flat, c.flat_ends);
    EXPECT_EQ(charts.charts.size(), flat + (domain.empty() ? 0 : 1));
    // No triangle goes over the seam: each is one segment of 32 wide on the rolled-out side.
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const Chart& chart = charts.charts[charts.chart_of_triangle[t]];
        const auto [low, high] = std::minmax({charts.uv[t][0].x, charts.uv[t][1].x, charts.uv[t][2].x});
        if (!chart.planar) {
            EXPECT_NEAR(high - low, float(chart.tiles_u) / 32.0F, 1e-3F);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Primitives, Curved,
                         testing::Values(CurvedCase{"sphere", Sphere{0.5F}, {kPi, kPi / 2}, 0}, //
                                         CurvedCase{"cylinder", Cylinder{0.4F, 2.0F, true}, {0.8F * kPi, 2.0F}, 2},
                                         CurvedCase{"tube", Cylinder{0.4F, 2.0F, false}, {0.8F * kPi, 2.0F}, 0},
                                         CurvedCase{"cone", Cone{0.6F, 0.0F, 0.8F, true}, {1.2F * kPi, 1.0F}, 1},
                                         CurvedCase{"frustum", Cone{0.6F, 0.3F, 0.4F, true}, {1.2F * kPi, 0.5F}, 2},
                                         CurvedCase{"disc", Disc{0.5F}, {}, 1}),
                         [](const auto& param) { return std::string(param.param.name); });

TEST(SurfaceCharts, AMillionTrianglesTakeSecondsAndNotMinutes) {
    Soup relief; // half a plane, half waves of 10 cm height
    const int n = 708;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            const float x = 10.0F * float(i) / float(n), z = 10.0F * float(j) / float(n);
            relief.point({x, x < 5.0F ? 0.0F : 0.1F * std::sin(3.0F * x) * std::sin(4.0F * z), z});
        }
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const auto at = [&](int a, int b) { return std::uint32_t(b * (n + 1) + a); };
            relief.triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j + 1));
            relief.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i + 1, j));
        }
    }
    const std::clock_t start = std::clock();
    const SurfaceCharts charts = relief.charts();
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("%zu triangles, %zu charts: %.3f s\n", relief.triangles.size(), charts.charts.size(), seconds);
    EXPECT_LT(seconds, 8.0); // half a second; sanitizers and a busy machine take their share
    ASSERT_FALSE(charts.empty());
    EXPECT_GT(charts.charts[charts.chart_of_triangle[0]].area, 49.0F);
}

TEST(Welding, PointsWithinTheToleranceAreOne) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    Soup soup;
    for (int i = 0; i < 2000; ++i) {
        const vec3 p(std::floor(uniform(random) * 8.0F), std::floor(uniform(random) * 8.0F),
                     std::floor(uniform(random) * 8.0F));
        const auto off = [&] { return 0.4e-3F * vec3(uniform(random), uniform(random), uniform(random)); };
        soup.triangle(p + off(), p + vec3(1, 0, 0) + off(), p + vec3(0, 1, 0) + off());
    }
    const WeldedTriangles welded = weld(soup.positions, soup.triangles, 1e-3F);
    EXPECT_LE(welded.points.size(), 17U * 17U * 16U);
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const vec3 d = welded.points[welded.triangles[t][k]] - soup.positions[soup.triangles[t][k]];
            EXPECT_LE(max_component(glm::abs(d)), 1e-3F);
        }
    }
    std::set<std::array<float, 3>> rounded;
    for (const vec3& p : welded.points) {
        EXPECT_TRUE(rounded.insert({std::round(p.x), std::round(p.y), std::round(p.z)}).second);
    }
}

TEST(SceneCharts, SharedInteriorsAreChartedByTheirWalls) {
    const std::filesystem::path folder = std::filesystem::path(ATRIUM_SHARED_DIR) / "scenes" / "interiors";
    if (!std::filesystem::is_directory(folder)) {
        GTEST_SKIP() << "no shared interiors";
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".glb") {
            continue;
        }
        const auto loaded = read_scene(entry.path());
        ASSERT_TRUE(loaded) << entry.path();
        const RayScene rays(loaded->scene);
        const std::clock_t start = std::clock();
        const std::vector<SurfaceCharts> charts = chart_surfaces(rays, {});
        const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
        ASSERT_EQ(charts.size(), rays.surfaces().size());
        std::size_t count = 0, tiles = 0, charted_triangles = 0;
        double all = 0.0, charted = 0.0;
        for (std::size_t s = 0; s < charts.size(); ++s) {
            const Soup soup{*rays.surfaces()[s].positions, rays.surfaces()[s].triangles};
            double own = 0.0;
            for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
                own += soup.area(t);
                charted_triangles += charts[s].chart_of_triangle[t] != SurfaceCharts::kNone ? 1 : 0;
            }
            charted += own * check(soup, charts[s], 3.0 * double(ChartSettings{}.flatness));
            all += own;
            count += charts[s].charts.size();
            tiles += std::size_t(charts[s].width) * charts[s].height;
        }
        std::printf("%-28s %7zu triangles, %6zu of them in %5zu charts of %6zu tiles, %5.1f %% of the area, %.3f s\n",
                    entry.path().filename().c_str(), rays.triangle_count(), charted_triangles, count, tiles,
                    100.0 * charted / all, seconds);
        EXPECT_GT(charted / all, 0.5) << entry.path();
    }
}

} // namespace
} // namespace atrium
