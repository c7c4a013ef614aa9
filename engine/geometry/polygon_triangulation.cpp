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

using Ring = std::vector<std::uint32_t>;

// Corner i of a ring whose inside lies to the left of its edges: does direction `to` - corner point inside (or along an
// edge)?
bool in_cone(const std::vector<vec2>& points, const Ring& ring, std::size_t i, const vec2& to) {
    const vec2& v = points[ring[i]];
    const vec2& previous = points[ring[(i + ring.size() - 1) % ring.size()]];
    const vec2& next = points[ring[(i + 1) % ring.size()]];
    if (cross(previous, v, next) > 0.0) {
        return cross(v, next, to) >= 0.0 && cross(v, to, previous) >= 0.0;
    }
    return !(cross(v, previous, to) > 0.0 && cross(v, to, next) > 0.0);
}

// True when the open segment s-t meets an edge of the ring: crosses it or runs through one of its corners.
bool crosses(const std::vector<vec2>& points, const Ring& ring, const vec2& s, const vec2& t) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const vec2& p = points[ring[i]];
        const vec2& q = points[ring[(i + 1) % ring.size()]];
        const double side_p = cross(s, t, p);
        const double side_q = cross(s, t, q);
        if (side_p == 0.0) {
            const vec2 from_s = p - s;
            const vec2 from_t = p - t;
            if (p != s && p != t && from_s.x * from_t.x + from_s.y * from_t.y < 0.0F) {
                return true;
            }
        } else if (side_q != 0.0 && (side_p > 0.0) != (side_q > 0.0)) {
            const double side_s = cross(p, q, s);
            const double side_t = cross(p, q, t);
            if ((side_s > 0.0 && side_t < 0.0) || (side_s < 0.0 && side_t > 0.0)) {
                return true;
            }
        }
    }
    return false;
}

// Joins holes[index] to `ring` by the shortest bridge from one of its corners that meets nothing on its way. Windows in a
// row have corners of equal height and share bridge ends, so corners are judged by where they are in the ring, not by their
// coordinates. A hole that no bridge reaches lies outside and cuts nothing.
void join_hole(const std::vector<vec2>& points, Ring& ring, const std::vector<Ring>& holes, std::size_t index) {
    const Ring& hole = holes[index];
    std::vector<std::pair<double, std::size_t>> nearest(ring.size());
    for (std::size_t h = 0; h < hole.size(); ++h) { // the first, the rightmost corner, nearly always finds one
        const vec2& m = points[hole[h]];
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const dvec2 d = dvec2(points[ring[i]]) - dvec2(m);
            nearest[i] = {glm::dot(d, d), i};
        }
        std::sort(nearest.begin(), nearest.end());
        for (const auto& [distance, i] : nearest) {
            const vec2& v = points[ring[i]];
            bool open = false;
            if (v == m) { // they touch here: both edges of the hole must lead inside
                open = in_cone(points, ring, i, points[hole[(h + 1) % hole.size()]]) &&
                       in_cone(points, ring, i, points[hole[(h + hole.size() - 1) % hole.size()]]);
            } else {
                open = in_cone(points, ring, i, m) && in_cone(points, hole, h, v) && !crosses(points, ring, v, m);
                for (std::size_t k = index; k < holes.size() && open; ++k) {
                    open = !crosses(points, holes[k], v, m);
                }
            }
            if (open) {
                Ring insert(hole.begin() + std::ptrdiff_t(h), hole.end());
                insert.insert(insert.end(), hole.begin(), hole.begin() + std::ptrdiff_t(h) + 1);
                insert.push_back(ring[i]);
                ring.insert(ring.begin() + std::ptrdiff_t(i) + 1, insert.begin(), insert.end());
                return;
            }
        }
    }
}

// An ear can be cut off when nothing of the ring lies in it. Corners at the ear's own points do no harm unless they stand at
// its tip and an edge of theirs leaves through the ear.
bool is_clear_ear(const std::vector<vec2>& points, const Ring& ring, std::size_t i) {
    const std::size_t n = ring.size();
    const vec2& a = points[ring[(i + n - 1) % n]];
    const vec2& b = points[ring[i]];
    const vec2& c = points[ring[(i + 1) % n]];
    for (std::size_t k = 0; k < n; ++k) {
        const vec2& p = points[ring[k]];
        if (p == a || p == c || k == i) {
            continue;
        }
        if (p == b) {
            for (const std::size_t other : {(k + 1) % n, (k + n - 1) % n}) {
                const vec2& q = points[ring[other]];
                if (cross(b, c, q) > 0.0 && cross(b, q, a) > 0.0) {
                    return false;
                }
            }
        } else if (in_triangle(a, b, c, p)) {
            return false;
        }
    }
    return true;
}

// A corner that encloses nothing: a point given twice, or a spike such as an emptied bridge.
bool is_spike(const vec2& a, const vec2& b, const vec2& c) {
    return a == b || b == c || (cross(a, b, c) == 0.0 && glm::dot(dvec2(a) - dvec2(b), dvec2(c) - dvec2(b)) > 0.0);
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
    for (std::size_t h = 0; h < holes.size(); ++h) {
        join_hole(out.points, ring, holes, h);
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
            if (is_spike(a, b, c) || (area > 0.0 && is_clear_ear(out.points, ring, i))) {
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
