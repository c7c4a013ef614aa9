// Triangles of the primitives against closed forms; triangulation of polygons that files really hold.
#include "engine/geometry/mesh_topology.h"
#include "engine/geometry/polygon_triangulation.h"
#include "engine/geometry/tessellate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

namespace atrium {
namespace {

double area_of(const MeshData& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        sum += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return sum;
}

struct PrimitiveCase {
    const char* name;
    Geometry geometry;
    double area;
    double volume; ///< 0 = not a solid
    double tolerance;
};

void PrintTo(const PrimitiveCase& c, std::ostream* out) { *out << c.name; }

std::vector<PrimitiveCase> primitive_cases() {
    const double pi = kPiD;
    const double slant = std::sqrt(0.3 * 0.3 + 1.5 * 1.5);
    return {
        {"polygon", Polygon{{{0, 0}, {2, 0}, {2, 3}, {0, 3}}, {}}, 6.0, 0.0, 1e-6},
        {"box", Box{{1, 2, 3}}, 22.0, 6.0, 1e-6},
        {"flat_box", Box{{4, 0.02F, 3}}, 2 * (12 + 0.06 + 0.08), 0.24, 1e-5},
        // A polyhedron inscribed with 32 segments falls short of the curved surface by up to 1.5 %, the volume by up to 2 %.
        {"sphere", Sphere{0.7F}, 4 * pi * 0.49, 4.0 / 3 * pi * 0.343, 0.02},
        {"cylinder", Cylinder{0.5F, 2.0F, true}, 2 * pi * 0.5 * 2 + 2 * pi * 0.25, pi * 0.25 * 2, 0.01},
        {"tube", Cylinder{0.5F, 2.0F, false}, 2 * pi * 0.5 * 2, 0.0, 0.01},
        {"cone", Cone{0.6F, 0.0F, 0.8F, true}, pi * 0.6 * 1.0 + pi * 0.36, pi * 0.36 * 0.8 / 3, 0.01},
        {"frustum", Cone{0.6F, 0.3F, 1.5F, true}, pi * (0.9 * slant + 0.36 + 0.09), pi * 1.5 / 3 * (0.36 + 0.18 + 0.09),
         0.01},
        {"inverted_cone", Cone{0.0F, 0.6F, 0.8F, true}, pi * 0.6 * 1.0 + pi * 0.36, pi * 0.36 * 0.8 / 3, 0.01},
        {"funnel", Cone{0.3F, 0.6F, 1.5F, false}, pi * 0.9 * slant, 0.0, 0.01},
        {"disc", Disc{0.4F}, pi * 0.16, 0.0, 0.01},
    };
}

class Primitive : public testing::TestWithParam<PrimitiveCase> {};

TEST_P(Primitive, AreaVolumeAndClosedness) {
    const PrimitiveCase& c = GetParam();
    const auto mesh = tessellate(c.geometry);
    EXPECT_NEAR(area_of(*mesh) / c.area, 1.0, c.tolerance);
    EXPECT_EQ(is_closed(*mesh), c.volume > 0.0);
    if (c.volume > 0.0) {
        EXPECT_GT(signed_volume(*mesh), 0.0);
        EXPECT_NEAR(signed_volume(*mesh) / c.volume, 1.0, c.tolerance);
    }
    ASSERT_EQ(mesh->parts.size(), 1U);
    EXPECT_EQ(mesh->parts[0].index_count, mesh->indices.size());
}

TEST_P(Primitive, FinerTessellationComesCloser) {
    const PrimitiveCase& c = GetParam();
    for (const int segments : {8, 13, 200}) { // odd numbers too: no hidden symmetry is needed
        const auto mesh = tessellate(c.geometry, {segments});
        EXPECT_EQ(is_closed(*mesh), c.volume > 0.0) << segments;
        const double error = std::abs(area_of(*mesh) / c.area - 1.0);
        EXPECT_LT(error, std::max(12.0 / (segments * segments), 2e-6)) << segments;
    }
    const auto coarse = tessellate(c.geometry, {1});
    EXPECT_EQ(coarse->indices, tessellate(c.geometry, {8})->indices) << "never fewer than 8 segments";
}

TEST_P(Primitive, NormalsAgreeWithTheWindingAndUvsStayInTheUnitSquare) {
    const PrimitiveCase& c = GetParam();
    const auto mesh = tessellate(c.geometry);
    ASSERT_EQ(mesh->normals.size(), mesh->positions.size());
    ASSERT_EQ(mesh->texcoords0.size(), mesh->positions.size());
    for (std::size_t i = 0; i < mesh->positions.size(); ++i) {
        EXPECT_TRUE(is_finite(mesh->positions[i]));
        EXPECT_NEAR(glm::length(mesh->normals[i]), 1.0F, 1e-4F);
        for (int k = 0; k < 2; ++k) {
            EXPECT_GE(mesh->texcoords0[i][k], 0.0F);
            EXPECT_LE(mesh->texcoords0[i][k], 1.0F);
        }
    }
    for (std::size_t i = 0; i + 2 < mesh->indices.size(); i += 3) {
        const std::uint32_t* t = &mesh->indices[i];
        const vec3 cross =
            glm::cross(mesh->positions[t[1]] - mesh->positions[t[0]], mesh->positions[t[2]] - mesh->positions[t[0]]);
        ASSERT_GT(glm::length(cross), 1e-12F) << "degenerate triangle " << i / 3;
        for (int k = 0; k < 3; ++k) {
            EXPECT_GT(glm::dot(glm::normalize(cross), mesh->normals[t[k]]), 0.5F);
        }
    }
}

TEST_P(Primitive, LiesWithinItsLocalBounds) {
    const PrimitiveCase& c = GetParam();
    const Box3 bounds = local_bounds(c.geometry);
    Box3 mesh_bounds;
    const auto mesh = tessellate(c.geometry);
    for (const vec3& p : mesh->positions) {
        mesh_bounds.add(p);
    }
    EXPECT_LT(glm::length(bounds.min - mesh_bounds.min) + glm::length(bounds.max - mesh_bounds.max), 1e-5F);
}

INSTANTIATE_TEST_SUITE_P(All, Primitive, testing::ValuesIn(primitive_cases()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(Tessellate, SolidsFaceOutward) {
    // For convex solids about the origin, outward means away from it.
    for (const PrimitiveCase& c : primitive_cases()) {
        if (c.volume <= 0.0) {
            continue;
        }
        const auto mesh = tessellate(c.geometry);
        for (std::size_t i = 0; i + 2 < mesh->indices.size(); i += 3) {
            const vec3 a = mesh->positions[mesh->indices[i]];
            const vec3 n = glm::cross(mesh->positions[mesh->indices[i + 1]] - a, mesh->positions[mesh->indices[i + 2]] - a);
            EXPECT_GT(glm::dot(n, a), 0.0F) << c.name;
        }
    }
}

TEST(Tessellate, DegenerateInputGivesEmptyDataAndNoNan) {
    const std::vector<Geometry> shapes{
        Polygon{},    Polygon{{{0, 0}, {1, 0}}, {}}, Polygon{{{0, 0}, {1, 1}, {2, 2}}, {}}, Box{vec3(0.0F)},
        Sphere{0.0F}, Cylinder{0.0F, 0.0F, true},    Cone{0.0F, 0.0F, 1.0F, true},          Cone{0.5F, 0.5F, 0.0F, false},
        Disc{0.0F}};
    for (const Geometry& shape : shapes) {
        const auto mesh = tessellate(shape);
        EXPECT_TRUE(mesh->indices.empty()) << shape.index();
        for (std::size_t i = 0; i < mesh->positions.size(); ++i) {
            EXPECT_TRUE(is_finite(mesh->positions[i]) && is_finite(mesh->normals[i]) && is_finite(mesh->texcoords0[i]))
                << shape.index();
        }
        EXPECT_FALSE(is_closed(*mesh));
        EXPECT_EQ(signed_volume(*mesh), 0.0);
    }
}

TEST(Tessellate, AMeshIsSharedAsItIs) {
    const auto data = tessellate(Box{});
    EXPECT_EQ(tessellate(Mesh{data}), data);
}

TEST(Closedness, HolesFlippedFacesAndDoubledFacesAreNotClosed) {
    MeshData mesh = *tessellate(Box{});
    ASSERT_TRUE(is_closed(mesh));
    MeshData open = mesh;
    open.indices.resize(open.indices.size() - 3);
    EXPECT_FALSE(is_closed(open));
    MeshData flipped = mesh;
    std::swap(flipped.indices[0], flipped.indices[1]);
    EXPECT_FALSE(is_closed(flipped));
    MeshData doubled = mesh;
    doubled.indices.insert(doubled.indices.end(), mesh.indices.begin(), mesh.indices.end());
    EXPECT_FALSE(is_closed(doubled));
    MeshData inward = mesh;
    for (std::size_t i = 0; i < inward.indices.size(); i += 3) {
        std::swap(inward.indices[i], inward.indices[i + 1]);
    }
    EXPECT_TRUE(is_closed(inward));
    EXPECT_NEAR(signed_volume(inward), -1.0, 1e-6);
}

TEST(Closedness, VolumeSurvivesLargeCoordinates) {
    MeshData mesh = *tessellate(Box{vec3(2.0F)});
    for (vec3& p : mesh.positions) {
        p += vec3(65536.0F, 0.0F, -65536.0F);
    }
    EXPECT_NEAR(signed_volume(mesh), 8.0, 1e-6);
}

// ---- polygons ----

double triangle_area(const PolygonTriangles& t) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < t.indices.size(); i += 3) {
        const dvec2 a(t.points[t.indices[i]]), b(t.points[t.indices[i + 1]]), c(t.points[t.indices[i + 2]]);
        const double area = 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
        EXPECT_GT(area, 0.0) << "triangles are counter-clockwise";
        sum += area;
    }
    return sum;
}

// Share of the points of a grid over [lo, hi]^2 for which exactly one triangle covers what `inside` says, none elsewhere.
void expect_covers(const PolygonTriangles& t, float lo, float hi, const std::function<bool(const dvec2&)>& inside) {
    int wrong = 0;
    constexpr int kGrid = 61;
    for (int i = 0; i < kGrid * kGrid; ++i) {
        // Off every lattice line that a test's corners lie on.
        const dvec2 p(lo + (hi - lo) * (i % kGrid + 0.3711) / kGrid, lo + (hi - lo) * (i / kGrid + 0.6177) / kGrid);
        int covering = 0;
        for (std::size_t k = 0; k + 2 < t.indices.size(); k += 3) {
            bool in = true;
            for (std::size_t e = 0; e < 3; ++e) {
                const dvec2 a(t.points[t.indices[k + e]]), b(t.points[t.indices[k + (e + 1) % 3]]);
                in = in && (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0.0;
            }
            covering += in ? 1 : 0;
        }
        wrong += covering != (inside(p) ? 1 : 0) ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0);
}

std::vector<vec2> rectangle(float x0, float y0, float x1, float y1, bool clockwise = false) {
    std::vector<vec2> ring{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    if (clockwise) {
        std::reverse(ring.begin(), ring.end());
    }
    return ring;
}
bool in_box(const dvec2& p, double x0, double y0, double x1, double y1) {
    return p.x > x0 && p.x < x1 && p.y > y0 && p.y < y1;
}

TEST(PolygonTriangulation, EitherOrientationOfOuterRingAndHoles) {
    for (const bool outer_clockwise : {false, true}) {
        for (const bool hole_clockwise : {false, true}) {
            const Polygon polygon{rectangle(0, 0, 4, 3, outer_clockwise), {rectangle(1, 1, 2, 2, hole_clockwise)}};
            const PolygonTriangles t = triangulate(polygon);
            EXPECT_NEAR(triangle_area(t), 11.0, 1e-9);
            expect_covers(t, -1, 5, [](const dvec2& p) { return in_box(p, 0, 0, 4, 3) && !in_box(p, 1, 1, 2, 2); });
        }
    }
}

TEST(PolygonTriangulation, WallWithFourWindowsInARow) {
    Polygon wall{rectangle(0, 0, 8, 3), {}};
    for (int i = 0; i < 4; ++i) { // equal heights: every bridge runs through the next window's corner level
        const float x = 0.5F + 2.0F * float(i);
        wall.holes.push_back(rectangle(x, 1, x + 1, 2, i % 2 == 0));
    }
    const PolygonTriangles t = triangulate(wall);
    EXPECT_NEAR(triangle_area(t), 20.0, 1e-9);
    expect_covers(t, -1, 9, [](const dvec2& p) {
        bool window = false;
        for (int i = 0; i < 4; ++i) {
            window = window || in_box(p, 0.5 + 2 * i, 1, 1.5 + 2 * i, 2);
        }
        return in_box(p, 0, 0, 8, 3) && !window;
    });
}

TEST(PolygonTriangulation, GridOfWindows) {
    Polygon wall{rectangle(0, 0, 6, 6), {}};
    for (int i = 0; i < 9; ++i) {
        const auto x = float(i % 3) * 2.0F + 0.5F;
        const auto y = float(i / 3) * 2.0F + 0.5F;
        wall.holes.push_back(rectangle(x, y, x + 1, y + 1));
    }
    const PolygonTriangles t = triangulate(wall);
    EXPECT_NEAR(triangle_area(t), 27.0, 1e-9);
    expect_covers(t, -1, 7, [](const dvec2& p) {
        bool window = false;
        for (int i = 0; i < 9; ++i) {
            const double x = i % 3 * 2 + 0.5, y = int(i / 3) * 2 + 0.5;
            window = window || in_box(p, x, y, x + 1, y + 1);
        }
        return in_box(p, 0, 0, 6, 6) && !window;
    });
}

TEST(PolygonTriangulation, HolesThatTouchInACornerAndTouchTheOuterRing) {
    const Polygon corner{rectangle(0, 0, 4, 4), {rectangle(1, 1, 2, 2), rectangle(2, 2, 3, 3)}};
    const PolygonTriangles t = triangulate(corner);
    EXPECT_NEAR(triangle_area(t), 14.0, 1e-9);
    expect_covers(t, -1, 5,
                  [](const dvec2& p) { return in_box(p, 0, 0, 4, 4) && !in_box(p, 1, 1, 2, 2) && !in_box(p, 2, 2, 3, 3); });
    // A door: the hole's lower edge lies on the outer ring.
    const Polygon door{rectangle(0, 0, 4, 3), {rectangle(1, 0, 2, 2)}};
    const PolygonTriangles d = triangulate(door);
    EXPECT_NEAR(triangle_area(d), 10.0, 1e-6);
    expect_covers(d, -1, 5, [](const dvec2& p) { return in_box(p, 0, 0, 4, 3) && !in_box(p, 1, 0, 2, 2); });
}

TEST(PolygonTriangulation, HolesWithACommonEdge) {
    const Polygon wall{rectangle(0, 0, 4, 3), {rectangle(1, 1, 2, 2), rectangle(2, 1, 3, 2)}};
    const PolygonTriangles t = triangulate(wall);
    EXPECT_NEAR(triangle_area(t), 10.0, 1e-6);
    expect_covers(t, -1, 5, [](const dvec2& p) { return in_box(p, 0, 0, 4, 3) && !in_box(p, 1, 1, 3, 2); });
}

TEST(PolygonTriangulation, ConcaveRings) {
    const Polygon l_room{{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, {}};
    const PolygonTriangles t = triangulate(l_room);
    EXPECT_NEAR(triangle_area(t), 7.0, 1e-9);
    expect_covers(t, -1, 5, [](const dvec2& p) { return in_box(p, 0, 0, 4, 1) || in_box(p, 0, 0, 1, 4); });
    // A comb of 12 teeth with a hole in its spine.
    Polygon comb;
    comb.outer = {{0, 0}, {12, 0}};
    for (int i = 11; i >= 0; --i) {
        const auto x = float(i);
        comb.outer.insert(comb.outer.end(), {{x + 1, 4}, {x + 0.5F, 4}, {x + 0.5F, 1}, {x, 1}});
    }
    comb.holes = {rectangle(3.2F, 0.25F, 7.9F, 0.75F)};
    const PolygonTriangles c = triangulate(comb);
    EXPECT_NEAR(triangle_area(c), 12.0 + 12 * 0.5 * 3.0 - 4.7 * 0.5, 1e-5);
    // A star with its reflex corners.
    Polygon star;
    double expected = 0.0;
    for (int i = 0; i < 10; ++i) {
        const float r = i % 2 == 0 ? 1.0F : 0.4F;
        star.outer.emplace_back(r * std::cos(0.2F * kPi * float(i)), r * std::sin(0.2F * kPi * float(i)));
        expected += 0.5 * 0.4 * std::sin(0.2 * kPiD);
    }
    EXPECT_NEAR(triangle_area(triangulate(star)), expected, 1e-6);
}

TEST(PolygonTriangulation, CollinearAndRepeatedPoints) {
    const Polygon polygon{{{0, 0}, {1, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {3, 2}, {1.5F, 2}, {0, 2}, {0, 2}, {0, 1}}, {}};
    const PolygonTriangles t = triangulate(polygon);
    EXPECT_NEAR(triangle_area(t), 6.0, 1e-9);
    expect_covers(t, -1, 4, [](const dvec2& p) { return in_box(p, 0, 0, 3, 2); });
}

TEST(PolygonTriangulation, PointsAreTheInputsInOrder) {
    const Polygon polygon{rectangle(0, 0, 4, 3, true), {rectangle(1, 1, 2, 2)}};
    const PolygonTriangles t = triangulate(polygon);
    ASSERT_EQ(t.points.size(), 8U);
    EXPECT_EQ(t.points[1], polygon.outer[1]);
    EXPECT_EQ(t.points[6], polygon.holes[0][2]);
}

TEST(PolygonTriangulation, SelfIntersectingAndHopelessInputEnds) {
    const std::vector<Polygon> bad{
        {{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}},                                  // bow tie
        {{{0, 0}, {1, 0}, {1, 0}, {0, 0}}, {}},                                  // no area
        {rectangle(0, 0, 1, 1), {rectangle(2, 2, 3, 3)}},                        // hole outside
        {rectangle(0, 0, 1, 1), {rectangle(-1, -1, 2, 2)}},                      // hole larger than the ring
        {rectangle(0, 0, 4, 4), {rectangle(1, 1, 3, 3), rectangle(2, 2, 5, 5)}}, // holes that cross each other and the ring
        {rectangle(0, 0, 4, 4), {{{1, 1}, {2, 2}}, {}}},                         // holes without area
    };
    for (const Polygon& polygon : bad) {
        const PolygonTriangles t = triangulate(polygon);
        for (const std::uint32_t i : t.indices) {
            ASSERT_LT(i, t.points.size());
        }
        EXPECT_EQ(t.indices.size() % 3, 0U);
    }
    EXPECT_NEAR(triangle_area(triangulate(bad.back())), 16.0, 1e-9);
    // Many points in a random tangle.
    Polygon tangle;
    std::uint32_t state = 1;
    for (int i = 0; i < 200; ++i) {
        state = state * 1664525U + 1013904223U;
        const float x = float(state >> 8) / float(1 << 24);
        state = state * 1664525U + 1013904223U;
        tangle.outer.emplace_back(x, float(state >> 8) / float(1 << 24));
    }
    EXPECT_LE(triangulate(tangle).indices.size(), 3U * 198U);
}

} // namespace
} // namespace atrium
