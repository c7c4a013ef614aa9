#include "engine/geometry/polygon_triangulation.h"

#include <algorithm>
#include <numeric>

namespace atrium {
namespace {

double cross(const vec2& a, const vec2& b, const vec2& c) {
    return (double(b.x) - a.x) * (double(c.y) - a.y) - (double(b.y) - a.y) * (double(c.x) - a.x);
}

double signed_area(const std::vector<vec2>& points, const std::vector<std::uint32_t>& ring) {
    double sum = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const vec2& p = points[ring[i]];
        const vec2& q = points[ring[(i + 1) % ring.size()]];
        sum += double(p.x) * q.y - double(q.x) * p.y;
    }
    return 0.5 * sum;
}

bool in_triangle(const vec2& a, const vec2& b, const vec2& c, const vec2& p) {
    return cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0;
}

// Vertex of `ring` that the hole's rightmost point `m` can be joined to without crossing an edge.
std::size_t bridge_vertex(const std::vector<vec2>& points, const std::vector<std::uint32_t>& ring, const vec2& m) {
    std::size_t best = ring.size();
    double best_x = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const vec2& p = points[ring[i]];
        const vec2& q = points[ring[(i + 1) % ring.size()]];
        if ((p.y <= m.y && q.y >= m.y) || (q.y <= m.y && p.y >= m.y)) {
            const double dy = double(q.y) - p.y;
            const double x = dy == 0.0 ? std::max(p.x, q.x) : p.x + (double(m.y) - p.y) / dy * (double(q.x) - p.x);
            if (x >= m.x && x < best_x) {
                best_x = x;
                best = p.x > q.x ? i : (i + 1) % ring.size();
            }
        }
    }
    if (best == ring.size()) {
        return 0; // hole outside the outer ring: any bridge will do
    }
    // A reflex vertex inside the triangle (m, hit, candidate) hides the candidate: take the one at the smallest angle.
    const vec2 hit(float(best_x), m.y);
    const vec2 candidate = points[ring[best]];
    double best_slope = std::numeric_limits<double>::infinity();
    std::size_t chosen = best;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const vec2& p = points[ring[i]];
        if (p == candidate || p.x < m.x) {
            continue;
        }
        const bool inside = candidate.y > m.y ? in_triangle(m, hit, candidate, p) : in_triangle(m, candidate, hit, p);
        const double slope = std::abs(double(p.y) - m.y) / std::max(double(p.x) - m.x, 1e-30);
        if (inside && slope < best_slope) {
            best_slope = slope;
            chosen = i;
        }
    }
    return chosen;
}

} // namespace

PolygonTriangles triangulate(const Polygon& polygon) {
    PolygonTriangles out;
    const auto add_ring = [&](const std::vector<vec2>& ring, bool counter_clockwise) {
        std::vector<std::uint32_t> indices(ring.size());
        std::iota(indices.begin(), indices.end(), std::uint32_t(out.points.size()));
        out.points.insert(out.points.end(), ring.begin(), ring.end());
        if ((signed_area(out.points, indices) > 0.0) != counter_clockwise) {
            std::reverse(indices.begin(), indices.end());
        }
        return indices;
    };
    if (polygon.outer.size() < 3) {
        return out;
    }
    std::vector<std::uint32_t> ring = add_ring(polygon.outer, true);
    std::vector<std::vector<std::uint32_t>> holes;
    for (const auto& hole : polygon.holes) {
        std::vector<std::uint32_t> indices = add_ring(hole, false);
        if (indices.size() >= 3) {
            const auto rightmost = std::max_element(indices.begin(), indices.end(),
                                                    [&](auto a, auto b) { return out.points[a].x < out.points[b].x; });
            std::rotate(indices.begin(), rightmost, indices.end());
            holes.push_back(std::move(indices));
        }
    }
    std::stable_sort(holes.begin(), holes.end(),
                     [&](const auto& a, const auto& b) { return out.points[a[0]].x > out.points[b[0]].x; });
    for (const auto& hole : holes) {
        const std::size_t at = bridge_vertex(out.points, ring, out.points[hole[0]]);
        std::vector<std::uint32_t> insert(hole.begin(), hole.end());
        insert.push_back(hole[0]);
        insert.push_back(ring[at]);
        ring.insert(ring.begin() + std::ptrdiff_t(at) + 1, insert.begin(), insert.end());
    }

    while (ring.size() >= 3) {
        const std::size_t n = ring.size();
        std::size_t ear = n;
        std::size_t fallback = 0; // the most convex corner, for rings that cross themselves
        double fallback_area = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < n && ear == n; ++i) {
            const vec2& a = out.points[ring[(i + n - 1) % n]];
            const vec2& b = out.points[ring[i]];
            const vec2& c = out.points[ring[(i + 1) % n]];
            const double area = cross(a, b, c);
            if (area > fallback_area) {
                fallback_area = area;
                fallback = i;
            }
            if (area <= 0.0) {
                continue;
            }
            bool clear = true;
            for (std::size_t k = 0; k < n && clear; ++k) {
                const vec2& p = out.points[ring[k]];
                clear = p == a || p == b || p == c || !in_triangle(a, b, c, p);
            }
            if (clear) {
                ear = i;
            }
        }
        if (ear == n) {
            ear = fallback;
        }
        const std::uint32_t a = ring[(ear + n - 1) % n];
        const std::uint32_t b = ring[ear];
        const std::uint32_t c = ring[(ear + 1) % n];
        if (cross(out.points[a], out.points[b], out.points[c]) > 0.0) {
            out.indices.insert(out.indices.end(), {a, b, c});
        }
        ring.erase(ring.begin() + std::ptrdiff_t(ear));
    }
    return out;
}

} // namespace atrium
