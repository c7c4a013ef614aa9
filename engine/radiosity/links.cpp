#include "engine/radiosity/links.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/geometry/form_factor.h"
#include "engine/radiosity/patch_cells.h"

#include <algorithm>
#include <queue>
#include <tuple>

namespace atrium {
namespace {

using Kind = Element::Kind;

// Signed distance range of a patch's corners from another's plane, with a tolerance for coplanar neighbours.
bool wholly_behind(const Hierarchy& h, const Element& what, const Element& plane) {
    const float tolerance = 1e-5F * (what.radius + plane.radius);
    const std::array<vec3, 4>& corners = h.corners(what);
    return std::all_of(corners.begin(), corners.end(),
                       [&](const vec3& p) { return glm::dot(p - plane.centre, plane.normal) <= tolerance; });
}

// Farthest that anything of `what` (a ball) may lie in front of a patch's plane.
bool ball_behind(const Element& what, const Element& patch) {
    return glm::dot(what.centre - patch.centre, patch.normal) <= -what.radius;
}

/// What refinement needs to know about a pair before any ray is shot.
struct PairEstimate {
    bool exchange = true;  ///< false: neither can see the other's front
    float transfer = 0.0F; ///< unoccluded flux that one sends and the other reflects, lumen; the larger direction
    float ratio = 1.0F;    ///< larger radius over distance, at most 1
    bool overlap = false;  ///< balls meet: no single number describes the pair
};

PairEstimate estimate(const Hierarchy& h, const Element& a, const Element& b) {
    PairEstimate out;
    const bool pa = a.kind == Kind::Patch;
    const bool pb = b.kind == Kind::Patch;
    if ((pa && pb && (wholly_behind(h, a, b) || wholly_behind(h, b, a))) || (pa && !pb && ball_behind(b, a)) ||
        (pb && !pa && ball_behind(a, b))) {
        out.exchange = false;
        return out;
    }
    const vec3 d = b.centre - a.centre;
    const float r = glm::length(d);
    const float reach = std::max(a.radius, b.radius);
    out.overlap = r < a.radius + b.radius;
    out.ratio = std::min(1.0F, reach / std::max(r, 1e-9F));
    // An upper estimate of A_a F_ab: projected areas where they are known for a direction, whole areas when close.
    float k = 0.0F;
    if (out.overlap) {
        k = std::min(a.area, b.area);
    } else {
        const vec3 w = d / r;
        const float slack = out.ratio; // cosines change by about this much over the pair
        const float area_a = std::min(projected_area(h, a, w) + slack * a.area * 0.5F, a.area);
        const float area_b = std::min(projected_area(h, b, -w) + slack * b.area * 0.5F, b.area);
        k = area_a * area_b / (kPi * r * r + std::max(a.area, b.area));
    }
    const Rgb sent_to_a = a.rho * b.radiosity;
    const Rgb sent_to_b = b.rho * a.radiosity;
    out.transfer = k * std::max(max_component(sent_to_a), max_component(sent_to_b));
    return out;
}

vec3 point_on(const Hierarchy& h, const Element& patch, const vec2& u) {
    return point_in_cell(h, h.patches[patch.patch], u).position;
}

float patch_pair_weight(const Hierarchy& h, const RayScene& rays, const Element& a, const Element& b, unsigned ray_count) {
    // Sample points on the smaller patch, closed form over the larger: the closed form carries the strong variation.
    const bool a_small = a.area <= b.area;
    const Element& from = a_small ? a : b;
    const Element& to = a_small ? b : a;
    const std::array<vec3, 4>& to_corners = h.corners(to);
    const float r = glm::length(a.centre - b.centre);
    const float ratio = std::max(a.radius, b.radius) / std::max(r, 1e-9F);
    const unsigned points = ratio < 0.1F ? 1U : (ratio < 0.35F ? 4U : 16U);
    double factor = 0.0;
    for (unsigned i = 0; i < points; ++i) {
        const vec3 x = points == 1 ? from.centre : point_on(h, from, sobol_owen2(i, 0, 17U));
        if (glm::dot(x - to.centre, to.normal) > 0.0F) {
            factor += form_factor_to_polygon(x, from.normal, to_corners);
        }
    }
    factor *= double(h.coverage(to)) / points;
    if (factor <= 0.0) {
        return 0.0F;
    }
    const auto seed = std::uint32_t(hash_combine(a.path, b.path));
    double seen = 0.0;
    double total = 0.0;
    for (unsigned i = 0; i < ray_count; ++i) {
        const vec3 x = point_on(h, a, sobol_owen2(i, 0, seed));
        const vec3 y = point_on(h, b, sobol_owen2(i, 2, seed));
        const vec3 d = y - x;
        const float d2 = glm::dot(d, d);
        const float ca = glm::dot(d, a.normal);
        const float cb = -glm::dot(d, b.normal);
        if (ca <= 0.0F || cb <= 0.0F) {
            continue;
        }
        const double kernel = double(ca) * cb / (double(d2) * (kPi * d2 + from.area));
        total += kernel;
        seen += kernel * luminance(rays.transmittance(x, y));
    }
    return total > 0.0 ? float(double(from.area) * factor * (seen / total)) : 0.0F;
}

float general_weight(const Hierarchy& h, const RayScene& rays, std::uint32_t ia, std::uint32_t ib, unsigned ray_count) {
    const Element& a = h.elements[ia];
    const Element& b = h.elements[ib];
    const float r = glm::length(a.centre - b.centre);
    // Balls that meet: the distance of two typical points inside keeps the kernel finite.
    const float safe_r2 = std::max(r * r, 0.25F * (a.radius + b.radius) * (a.radius + b.radius));
    const auto seed = std::uint32_t(hash_combine(a.path, b.path));
    double seen = 0.0;
    double total = 0.0;
    for (unsigned i = 0; i < ray_count; ++i) {
        const SurfacePoint x = sample_point(h, rays, ia, sobol_owen2(i, 0, seed), false);
        const SurfacePoint y = sample_point(h, rays, ib, sobol_owen2(i, 2, seed), false);
        const vec3 d = y.position - x.position;
        const float ca = glm::dot(d, x.normal);
        const float cb = -glm::dot(d, y.normal);
        if (ca <= 0.0F || cb <= 0.0F) {
            continue; // points that face away are not part of the projected areas
        }
        const double kernel = double(ca) * cb / std::max(double(glm::dot(d, d)), 1e-12);
        total += kernel;
        seen += kernel * luminance(rays.transmittance(x.position, y.position));
    }
    const double visible = total > 0.0 ? seen / total : 0.0;
    return float(visible / (kPiD * safe_r2));
}

/// Flux of each room that has light of its own, and where its elements are. Without light or walls between: one for all.
class RoomFlux {
public:
    explicit RoomFlux(const Hierarchy& h) {
        std::vector<double> flux(h.room.empty() ? 0 : 1 + *std::max_element(h.room.begin(), h.room.end(), less), 0.0);
        for (std::size_t i = 0; i < h.elements.size(); ++i) {
            const Element& e = h.elements[i];
            if (e.leaf()) {
                const double sent = double(e.area) * luminance(e.emitted + e.rho * e.direct);
                all_ += sent;
                if (!flux.empty() && h.room[i] != Element::kNone) {
                    flux[h.room[i]] += sent;
                }
            }
        }
        if (std::count_if(flux.begin(), flux.end(), [](double f) { return f > 0.0; }) < 2) {
            return;
        }
        flux_ = std::move(flux);
        where_.assign(h.elements.size(), kNowhere);
        for (std::size_t i = h.elements.size(); i-- > 0;) { // children come after their parent
            const Element& e = h.elements[i];
            if (e.leaf()) {
                where_[i] = h.room[i] != Element::kNone && flux_[h.room[i]] > 0.0 ? h.room[i] : kNowhere;
            }
            for (std::uint32_t k = 0; k < e.child_count; ++k) {
                const std::uint32_t below = where_[e.first_child + k];
                where_[i] = where_[i] == kNowhere || below == where_[i] ? below : (below == kNowhere ? where_[i] : kSeveral);
            }
        }
    }
    /// Flux by which a transfer between two elements is judged, lumen.
    [[nodiscard]] double of_pair(std::uint32_t a, std::uint32_t b) const {
        const bool one = !where_.empty() && where_[a] == where_[b] && where_[a] != kNowhere && where_[a] != kSeveral;
        return one ? flux_[where_[a]] : all_;
    }
    /// The element reaches over several rooms and may see light of the other.
    [[nodiscard]] bool reaches_over(std::uint32_t element, std::uint32_t other) const {
        return !where_.empty() && where_[element] == kSeveral && where_[other] != kNowhere;
    }
    /// Parts of an element are new.
    void inherit(const Hierarchy& h, std::uint32_t parent) {
        if (!where_.empty()) {
            where_.resize(h.elements.size(), where_[parent]);
        }
    }

private:
    static constexpr std::uint32_t kNowhere = 0xFFFFFFFFU; // in no room with light
    static constexpr std::uint32_t kSeveral = 0xFFFFFFFEU;
    static bool less(std::uint32_t a, std::uint32_t b) { return a + 1 < b + 1; } // kNone comes first
    double all_ = 0.0;
    std::vector<double> flux_;
    std::vector<std::uint32_t> where_; // per element; empty: one room
};

} // namespace

float projected_area(const Hierarchy& hierarchy, const Element& element, const vec3& d) {
    if (element.kind == Kind::Patch) {
        return element.area * std::max(glm::dot(element.normal, d), 0.0F);
    }
    return std::max(sh_dot(hierarchy.harmonics[element.harmonics].projected_area, sh_basis(d)), 0.0F);
}

LinkSet::LinkSet(const Hierarchy& hierarchy) {
    if (!hierarchy.empty()) {
        self_pairs_.push_back(0);
    }
}

std::size_t LinkSet::refine(Hierarchy& h, const RayScene& rays, const RefineSettings& settings, const RunContext& context) {
    RoomFlux rooms(h);
    struct Fresh {
        std::size_t link;
        unsigned rays;
    };
    // A pair that should be divided; links that were there before keep their weight if the budget ends first.
    struct Open {
        float urgency = 0.0F; // uncertain part of the transfer over what is let be
        std::uint32_t a = 0;
        std::uint32_t b = 0;
        float transfer = 0.0F; // over what is let be
        float weight = -1.0F;  // of an old link
        bool operator<(const Open& other) const {
            return std::tie(urgency, other.a, other.b) < std::tie(other.urgency, a, b);
        }
    };
    std::vector<Link> kept;
    std::vector<Fresh> fresh;
    kept.reserve(links_.size());
    std::priority_queue<Open> open;
    const auto divisible = [&](std::uint32_t i) { return !h.elements[i].leaf() || h.can_split(i); };
    const auto keep = [&](const Open& pair) {
        if (pair.weight < 0.0F) {
            const unsigned half = std::max(settings.rays / 2, 1U);
            fresh.push_back({kept.size(), pair.transfer > 2.0F    ? settings.rays * 4
                                          : pair.transfer > 0.25F ? settings.rays
                                                                  : half});
        }
        kept.push_back({pair.a, pair.b, std::max(pair.weight, 0.0F)});
    };
    // Sorts a pair in: nothing to exchange, good as a link, or to be divided.
    const auto consider = [&](std::uint32_t ia, std::uint32_t ib, float weight) {
        const PairEstimate pair = estimate(h, h.elements[ia], h.elements[ib]);
        if (!pair.exchange) {
            return;
        }
        const auto threshold = float(rooms.of_pair(ia, ib) * settings.flux_threshold);
        const bool both_patches = h.elements[ia].kind == Kind::Patch && h.elements[ib].kind == Kind::Patch;
        // Uncertain share of the transfer: grows with the solid angle; clusters are described by fewer numbers than patches.
        const float uncertain = std::min(1.0F, (both_patches ? 1.0F : 4.0F) * pair.ratio * pair.ratio + 0.02F);
        const bool meets = pair.overlap && !both_patches;
        const bool apart = rooms.reaches_over(ia, ib) || rooms.reaches_over(ib, ia); // what is in one room stays in it
        const bool too_coarse =
            apart || pair.transfer * uncertain > threshold || (meets && pair.transfer > 0.05F * threshold);
        const float scale = threshold > 0.0F ? 1.0F / threshold : 0.0F;
        Open at{pair.transfer * scale * (meets ? 1.0F : uncertain), std::min(ia, ib), std::max(ia, ib),
                pair.transfer * scale, weight};
        if (apart) {
            at.urgency = std::numeric_limits<float>::infinity();
        }
        if (too_coarse && (divisible(ia) || divisible(ib))) {
            open.push(at);
        } else {
            keep(at);
        }
    };
    for (const Link& link : links_) {
        consider(link.a, link.b, link.weight);
    }
    // Exchange inside an element: opened down to the leaves, which do not light themselves.
    while (!self_pairs_.empty()) {
        const std::uint32_t i = self_pairs_.back();
        self_pairs_.pop_back();
        const Element e = h.elements[i];
        if (e.kind != Kind::Cluster) {
            continue; // patches are flat; the inner exchange of a handful of faces is below what we resolve
        }
        for (std::uint32_t k = 0; k < e.child_count; ++k) {
            self_pairs_.push_back(e.first_child + k);
            for (std::uint32_t l = k + 1; l < e.child_count; ++l) {
                consider(e.first_child + k, e.first_child + l, -1.0F);
            }
        }
    }
    budget_reached_ = false;
    while (!open.empty()) {
        const Open pair = open.top();
        open.pop();
        std::uint32_t first = h.elements[pair.a].radius >= h.elements[pair.b].radius ? pair.a : pair.b;
        std::uint32_t second = first == pair.a ? pair.b : pair.a;
        if (!divisible(first) || (rooms.reaches_over(second, first) && !rooms.reaches_over(first, second))) {
            std::swap(first, second);
        }
        const std::size_t parts = h.elements[first].leaf() ? 4 : h.elements[first].child_count;
        if (kept.size() + open.size() + parts > settings.max_links) {
            budget_reached_ = true;
            keep(pair);
            continue;
        }
        if (h.elements[first].leaf()) {
            const Rgb radiosity = h.elements[first].radiosity;
            h.split(first, rays);
            rooms.inherit(h, first);
            for (std::uint32_t k = 0; k < h.elements[first].child_count; ++k) {
                h.elements[h.elements[first].first_child + k].radiosity = radiosity;
            }
        }
        for (std::uint32_t k = 0; k < h.elements[first].child_count; ++k) {
            consider(h.elements[first].first_child + k, second, -1.0F);
        }
    }

    parallel_chunks(settings.rays > 0 ? fresh.size() : 0, 64, [&](std::size_t begin, std::size_t end, std::size_t) {
        if (context.should_stop()) {
            return;
        }
        for (std::size_t i = begin; i < end; ++i) {
            Link& link = kept[fresh[i].link];
            const Element& a = h.elements[link.a];
            const Element& b = h.elements[link.b];
            link.weight = a.kind == Kind::Patch && b.kind == Kind::Patch
                              ? patch_pair_weight(h, rays, a, b, fresh[i].rays)
                              : general_weight(h, rays, link.a, link.b, fresh[i].rays);
        }
    });
    links_ = std::move(kept);
    return fresh.size();
}

} // namespace atrium
