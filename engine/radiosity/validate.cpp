#include "engine/radiosity/validate.h"

#include "engine/base/rng.h"
#include "engine/radiosity/patch_cells.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <tuple>

namespace atrium {
namespace {

using Kind = Element::Kind;
constexpr std::size_t kMostFaults = 20;

class Faults {
public:
    template <class... Args> void require(bool good, fmt::format_string<Args...> text, Args&&... args) {
        if (!good && list.size() < kMostFaults) {
            list.push_back(fmt::format(text, std::forward<Args>(args)...));
        }
    }
    std::vector<std::string> list;
};

bool near(double a, double b, double tolerance) {
    return std::abs(a - b) <= tolerance * std::max({std::abs(a), std::abs(b), 1e-12});
}

bool same_harmonics(const Sh& a, const Sh& b, float area) {
    for (std::size_t i = 0; i < kShCount; ++i) {
        if (std::abs(a[i] - b[i]) > 1e-3F * area) {
            return false;
        }
    }
    return true;
}

Sh projected(const Hierarchy& h, const Element& e) {
    return e.kind == Kind::Patch ? sh_clamped_cosine(e.normal, e.area) : h.harmonics[e.harmonics].projected_area;
}

void check_children(const Hierarchy& h, std::uint32_t i, Faults& faults) {
    const Element& e = h.elements[i];
    if (e.leaf()) {
        faults.require(e.kind != Kind::Cluster, "cluster {} has no children", i);
        return;
    }
    if (e.first_child <= i || e.first_child + e.child_count > h.elements.size()) {
        faults.require(false, "children of {} do not follow it in the array", i);
        return;
    }
    faults.require(e.kind != Kind::Faces, "faces {} have children", i);
    faults.require(e.kind != Kind::Patch || e.child_count <= 4, "patch {} has {} parts", i, e.child_count);
    if (e.kind == Kind::Patch) {
        const PatchCell& cell = h.patches[e.patch];
        const CellStep& step = h.steps[e.patch];
        unsigned present = 0;
        for (std::uint32_t k = 0; k < e.child_count; ++k) {
            const std::uint32_t part = h.elements[e.first_child + k].patch;
            faults.require(part == step.first_cell + k, "cells of the parts of {} are not in order", i);
            present |= 1U << h.patches[part].quadrant;
        }
        const vec2 off = glm::abs(step.middle - 0.5F * (cell.low + cell.high));
        faults.require(step.first_child == e.first_child && step.present == present && off.x + off.y < 1e-4F * e.radius,
                       "points of patch {} are led to the wrong part", i);
    }
    double area = 0.0;
    Sh sum{};
    for (std::uint32_t k = 0; k < e.child_count; ++k) {
        const Element& child = h.elements[e.first_child + k];
        faults.require(child.parent == i, "element {} does not know its parent {}", e.first_child + k, i);
        area += child.area;
        if (e.kind == Kind::Patch) {
            const PatchCell& outer = h.patches[e.patch];
            const PatchCell& inner = h.patches[child.patch];
            const bool within = inner.low.x >= outer.low.x && inner.low.y >= outer.low.y && inner.high.x <= outer.high.x &&
                                inner.high.y <= outer.high.y;
            faults.require(child.kind == Kind::Patch && child.back == e.back && inner.sheet == outer.sheet && within,
                           "part {} is not within patch {}", e.first_child + k, i);
        }
        if (e.kind == Kind::Cluster) {
            const Sh part = projected(h, child);
            for (std::size_t s = 0; s < kShCount; ++s) {
                sum[s] += part[s];
            }
        }
    }
    faults.require(near(area, e.area, 1e-4), "areas below {} add up to {}, not {}", i, area, e.area);
    if (e.kind == Kind::Cluster && e.harmonics < h.harmonics.size()) {
        faults.require(same_harmonics(sum, h.harmonics[e.harmonics].projected_area, e.area),
                       "harmonics below cluster {} do not add up", i);
    }
}

// Corners of a leaf: of its own cell or of all its faces; points of a cell that is not filled.
std::vector<vec3> corners_of(const Hierarchy& h, const RayScene& rays, const Element& e) {
    std::vector<vec3> out;
    if (e.kind == Kind::Patch && h.patches[e.patch].shape == PatchCell::Shape::Partial) {
        for (std::uint32_t i = 0; i < 16; ++i) {
            out.push_back(point_in_cell(h, h.patches[e.patch], sobol_owen2(i, 0, 3U)).position);
        }
    } else if (e.kind == Kind::Patch) {
        out.assign(h.corners(e).begin(), h.corners(e).end());
    } else {
        for (std::uint32_t f = e.triangle; f < e.triangle + e.face_count; ++f) {
            const auto p = rays.triangle(h.faces[f].surface, h.faces[f].triangle);
            out.insert(out.end(), p.begin(), p.end());
        }
    }
    return out;
}

void check_leaf(const Hierarchy& h, const RayScene& rays, std::uint32_t i, Faults& faults) {
    const std::vector<vec3> corners = corners_of(h, rays, h.elements[i]);
    for (std::uint32_t up = i; up != Element::kNone; up = h.elements[up].parent) {
        const Element& ball = h.elements[up];
        for (const vec3& p : corners) {
            const float distance = glm::length(p - ball.centre);
            faults.require(distance <= ball.radius * 1.0001F + 1e-5F, "ball {} does not hold leaf {}: {} > {}", up, i,
                           distance, ball.radius);
        }
    }
}

using Side = std::tuple<std::uint32_t, std::uint32_t, bool>;

// The leaf that the hierarchy names for a point of a triangle side must lie there. `group`: the Faces that list the side,
// kNone where none does.
void check_leaf_at(const Hierarchy& h, const RayScene& rays, const Side& side, std::uint32_t group, Faults& faults) {
    const auto [s, t, back] = side;
    const auto p = rays.triangle(s, t);
    for (const vec2& b : {vec2(1.0F / 3.0F), vec2(0.05F, 0.05F), vec2(0.9F, 0.05F), vec2(0.05F, 0.9F)}) {
        const std::uint32_t leaf = h.leaf_at(s, t, back, b);
        if (leaf >= h.elements.size() || !h.elements[leaf].leaf()) {
            faults.require(false, "no leaf holds side {} of triangle {} of surface {}", back ? "back" : "front", t, s);
            return;
        }
        const Element& e = h.elements[leaf];
        const vec3 point = p[0] + (p[1] - p[0]) * b.x + (p[2] - p[0]) * b.y;
        const float distance = glm::length(point - e.centre);
        faults.require(distance <= e.radius * 1.001F + 2e-3F, "triangle {} of surface {} is not in its leaf {}: {} > {}", t,
                       s, leaf, distance, e.radius);
        if (e.kind == Kind::Patch) {
            const std::array<vec2, 3>& corner = h.sheet_triangles[h.on_sheet[h.first_triangle[s] + t]].uv;
            const vec2 uv = corner[0] + (corner[1] - corner[0]) * b.x + (corner[2] - corner[0]) * b.y;
            const PatchCell& cell = h.patches[e.patch];
            const vec2 outside = glm::abs(uv - glm::clamp(uv, cell.low, cell.high));
            faults.require(outside.x + outside.y <= 1e-3F * e.radius, "triangle {} of surface {} is not in cell {}", t, s,
                           e.patch);
            faults.require(e.surface == s && e.back == back, "leaf {} is of another side than triangle {} of surface {}",
                           leaf, t, s);
        } else {
            faults.require(leaf == group, "faces {} do not have triangle {} of surface {}", leaf, t, s);
        }
    }
}

void check_cover(const Hierarchy& h, const RayScene& rays, Faults& faults) {
    struct Listed {
        int times = 0;
        std::uint32_t leaf = Element::kNone;
    };
    std::map<Side, Listed> faces;
    std::map<std::pair<std::uint32_t, bool>, double> on_sheets;
    for (std::uint32_t i = 0; i < h.elements.size(); ++i) {
        const Element& e = h.elements[i];
        if (e.leaf() && e.kind == Kind::Patch) {
            on_sheets[{h.patches[e.patch].sheet, e.back}] += e.area;
        }
        for (std::uint32_t f = e.triangle; e.kind == Kind::Faces && f < e.triangle + e.face_count; ++f) {
            Listed& listed = faces[{h.faces[f].surface, h.faces[f].triangle, h.faces[f].back}];
            ++listed.times;
            listed.leaf = i;
        }
    }
    std::size_t in_faces = 0, sheet_sides = 0;
    std::map<std::uint32_t, double> sheet_area;
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        for (std::uint32_t t = 0; t < rays.surfaces()[s].triangles.size(); ++t) {
            const auto p = rays.triangle(s, t);
            const std::uint32_t place = h.on_sheet[h.first_triangle[s] + t];
            if (place != Element::kNone) {
                const auto sheet = std::upper_bound(h.sheets.begin(), h.sheets.end(), place,
                                                    [](std::uint32_t at, const Sheet& x) { return at < x.first; });
                const auto index = std::uint32_t(sheet - h.sheets.begin() - 1);
                faults.require(h.sheet_triangles[place].triangle == t && h.sheets[index].surface == s,
                               "triangle {} of surface {} is not where it is said to be", t, s);
                sheet_area[index] += 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
            }
            for (const bool back : {false, true}) {
                if (back && !rays.surfaces()[s].back_side) {
                    continue;
                }
                const auto it = faces.find({s, t, back});
                const Listed listed = it != faces.end() ? it->second : Listed{};
                in_faces += std::size_t(listed.times);
                faults.require(listed.times == (place == Element::kNone ? 1 : 0),
                               "triangle {} of surface {} is {} times in groups", t, s, listed.times);
                check_leaf_at(h, rays, {s, t, back}, listed.leaf, faults);
            }
        }
    }
    for (std::uint32_t i = 0; i < h.sheets.size(); ++i) {
        for (const bool back : {false, true}) {
            if (back && !rays.surfaces()[h.sheets[i].surface].back_side) {
                continue;
            }
            ++sheet_sides;
            const auto it = on_sheets.find({i, back});
            const double covered = it != on_sheets.end() ? it->second : 0.0;
            faults.require(near(covered, sheet_area[i], 1e-3), "sheet {} is covered by {} of {} m2", i, covered,
                           sheet_area[i]);
        }
    }
    faults.require(on_sheets.size() == sheet_sides, "patches lie on {} sheet sides of {}", on_sheets.size(), sheet_sides);
    faults.require(faces.size() == in_faces, "groups have {} triangle sides, {} of the scene's", faces.size(), in_faces);
}

void leaves_below(const Hierarchy& h, std::uint32_t i, std::vector<std::uint32_t>& out) {
    if (h.elements[i].leaf()) {
        out.push_back(i);
    }
    for (std::uint32_t k = 0; k < h.elements[i].child_count; ++k) {
        leaves_below(h, h.elements[i].first_child + k, out);
    }
}

bool in_front(const Hierarchy& h, const Element& what, const Element& of) {
    const float margin = 1e-4F * (what.radius + of.radius);
    return std::any_of(h.corners(what).begin(), h.corners(what).end(),
                       [&](const vec3& p) { return glm::dot(p - of.centre, of.normal) > margin; });
}

} // namespace

std::vector<std::string> check_hierarchy(const Hierarchy& h, const RayScene& rays) {
    Faults faults;
    std::set<std::uint64_t> paths;
    std::set<std::uint32_t> harmonics;
    std::set<std::uint32_t> cells;
    for (std::uint32_t i = 0; i < h.elements.size(); ++i) {
        const Element& e = h.elements[i];
        faults.require(i == 0 ? e.parent == Element::kNone : e.parent < i, "parent of {} does not precede it", i);
        faults.require(paths.insert(e.path).second, "element {} shares its random stream with another", i);
        faults.require(e.area > 0.0F && e.radius > 0.0F && is_finite(e.centre), "element {} has no extent", i);
        for (int c = 0; c < 3; ++c) {
            faults.require(e.rho[c] >= 0.0F && e.rho[c] < 1.0F, "reflectance {} of element {}", e.rho[c], i);
            faults.require(e.emitted[c] >= 0.0F && std::isfinite(e.emitted[c]), "emission {} of element {}", e.emitted[c],
                           i);
        }
        if (e.kind == Kind::Patch) {
            faults.require(e.harmonics == Element::kNone, "patch {} has harmonics", i);
            if (e.patch >= h.patches.size() || !cells.insert(e.patch).second) {
                faults.require(false, "the cell of patch {} is not its own", i);
                continue;
            }
            const std::array<vec3, 4>& p = h.corners(e);
            const vec3 cross = glm::cross(p[2] - p[0], p[3] - p[1]); // twice the area of a quadrangle
            const double covered = 0.5 * double(glm::length(cross)) * double(h.coverage(e));
            faults.require(near(covered, e.area, 2e-3), "area of patch {} is not what it covers of its corners", i);
            faults.require(glm::dot(cross, e.normal) > 0.0F && near(glm::length(e.normal), 1.0, 1e-4),
                           "normal of patch {} is not on its front", i);
        } else {
            faults.require(e.harmonics < h.harmonics.size() && harmonics.insert(e.harmonics).second,
                           "harmonics of element {} are not its own", i);
        }
        check_children(h, i, faults);
        if (e.leaf() && faults.list.empty()) {
            check_leaf(h, rays, i, faults);
        }
    }
    if (faults.list.empty()) {
        check_cover(h, rays, faults);
    }
    return faults.list;
}

std::vector<std::string> check_links(const Hierarchy& h, const std::vector<Link>& links) {
    Faults faults;
    const std::vector<std::uint32_t> leaves = h.leaves();
    std::vector<std::uint32_t> order(h.elements.size(), 0);
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
        order[leaves[i]] = i;
    }
    const std::size_t n = leaves.size();
    std::vector<std::uint8_t> count(n * n, 0);
    for (const Link& link : links) {
        faults.require(std::isfinite(link.weight) && link.weight >= 0.0F, "link {}-{} weighs {}", link.a, link.b,
                       link.weight);
        std::vector<std::uint32_t> a, b;
        leaves_below(h, link.a, a);
        leaves_below(h, link.b, b);
        for (const std::uint32_t i : a) {
            for (const std::uint32_t j : b) {
                auto& c = count[std::min(order[i], order[j]) * n + std::max(order[i], order[j])];
                c = std::uint8_t(std::min(c + 1, 200));
            }
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        faults.require(count[i * n + i] == 0, "leaf {} is linked with itself", leaves[i]);
        const Element& a = h.elements[leaves[i]];
        for (std::size_t j = i + 1; j < n; ++j) {
            const Element& b = h.elements[leaves[j]];
            const int times = count[i * n + j];
            faults.require(times <= 1, "leaves {} and {} are linked {} times", leaves[i], leaves[j], times);
            const bool facing = a.kind == Kind::Patch && b.kind == Kind::Patch && in_front(h, a, b) && in_front(h, b, a);
            faults.require(times == 1 || !facing, "leaves {} and {} face each other without a link", leaves[i], leaves[j]);
        }
    }
    return faults.list;
}

std::vector<std::string> check_transport(const Hierarchy& h, Transport& transport, bool closed, double symmetry) {
    Faults faults;
    const std::vector<std::uint32_t>& leaves = transport.leaves();
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const float sum = transport.row_sums()[i];
        faults.require(std::isfinite(sum) && sum >= 0.0F && (!closed || sum <= 1.0F + 1e-4F), "row sum {} of leaf {}", sum,
                       leaves[i]);
    }
    const auto random = [&](std::uint32_t seed) {
        std::vector<Rgb> out(leaves.size());
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = Rgb(float(hash64(hash_combine(seed, i)) >> 40) / float(1 << 24));
        }
        return out;
    };
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
        const std::vector<Rgb> x = random(2 * seed), y = random(2 * seed + 1);
        std::vector<Rgb> tx, ty;
        transport.apply(x, tx);
        transport.apply(y, ty);
        double xty = 0.0, ytx = 0.0;
        for (std::size_t i = 0; i < leaves.size(); ++i) {
            const double area = h.elements[leaves[i]].area;
            // The harmonics of nine numbers dip below zero by this much; the solver clamps what is left of it.
            faults.require(is_finite(tx[i]) && tx[i].r >= -0.02F, "leaf {} receives {}", leaves[i], tx[i].r);
            xty += area * double(x[i].r) * ty[i].r;
            ytx += area * double(y[i].r) * tx[i].r;
        }
        faults.require(near(xty, ytx, symmetry), "the transport is not symmetric: {} and {}", xty, ytx);
    }
    return faults.list;
}

} // namespace atrium
