#include "engine/radiosity/validate.h"

#include "engine/base/rng.h"

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
    faults.require(e.kind != Kind::Patch || e.child_count == 4, "patch {} has {} parts", i, e.child_count);
    double area = 0.0;
    Sh sum{};
    for (std::uint32_t k = 0; k < e.child_count; ++k) {
        const Element& child = h.elements[e.first_child + k];
        faults.require(child.parent == i, "element {} does not know its parent {}", e.first_child + k, i);
        area += child.area;
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

// Corners of a leaf: of its own triangle or of all its faces.
std::vector<vec3> corners_of(const Hierarchy& h, const RayScene& rays, const Element& e) {
    std::vector<vec3> out(e.corner.begin(), e.corner.end());
    if (e.kind == Kind::Faces) {
        out.clear();
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

void check_cover(const Hierarchy& h, const RayScene& rays, Faults& faults) {
    std::map<Side, double> covered;
    for (const Element& e : h.elements) {
        if (!e.leaf()) {
            continue;
        }
        if (e.kind == Kind::Patch) {
            covered[{e.surface, e.triangle, e.back}] += e.area;
        } else {
            for (std::uint32_t f = e.triangle; f < e.triangle + e.face_count; ++f) {
                covered[{h.faces[f].surface, h.faces[f].triangle, h.faces[f].back}] += h.faces[f].area;
            }
        }
    }
    std::size_t sides = 0;
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        for (std::uint32_t t = 0; t < rays.surfaces()[s].triangles.size(); ++t) {
            const auto p = rays.triangle(s, t);
            const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
            for (const bool back : {false, true}) {
                if (back && !rays.surfaces()[s].back_side) {
                    continue;
                }
                ++sides;
                const auto it = covered.find({s, t, back});
                faults.require(it != covered.end() && near(it->second, area, 1e-3),
                               "triangle {} of surface {} is covered by {} of {} m2", t, s,
                               it != covered.end() ? it->second : 0.0, area);
            }
        }
    }
    faults.require(covered.size() == sides, "leaves lie on {} triangle sides, the scene has {}", covered.size(), sides);
}

void leaves_below(const Hierarchy& h, std::uint32_t i, std::vector<std::uint32_t>& out) {
    if (h.elements[i].leaf()) {
        out.push_back(i);
    }
    for (std::uint32_t k = 0; k < h.elements[i].child_count; ++k) {
        leaves_below(h, h.elements[i].first_child + k, out);
    }
}

bool in_front(const Element& what, const Element& of) {
    const float margin = 1e-4F * (what.radius + of.radius);
    return std::any_of(what.corner.begin(), what.corner.end(),
                       [&](const vec3& p) { return glm::dot(p - of.corner[0], of.normal) > margin; });
}

} // namespace

std::vector<std::string> check_hierarchy(const Hierarchy& h, const RayScene& rays) {
    Faults faults;
    std::set<std::uint64_t> paths;
    std::set<std::uint32_t> harmonics;
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
            const vec3 cross = glm::cross(e.corner[1] - e.corner[0], e.corner[2] - e.corner[0]);
            faults.require(near(0.5F * glm::length(cross), e.area, 2e-3), "area of patch {} is not its corners'", i);
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
            const bool facing = a.kind == Kind::Patch && b.kind == Kind::Patch && in_front(a, b) && in_front(b, a);
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
