// The way: scouts on the surfaces look at a grid of directions over their hemisphere. Where a direction that sees the sky
// has a neighbour that does not, halving the angle between them finds a point of the rim of what the sky is seen through. An
// opening's rim lies in a plane (of a thick wall's two rims one is taken), so planes through three rim points that have many
// others in them are candidates, and those are openings through which most of the light that reaches them comes from the
// sky, the tightest first.
#include "engine/radiosity/sky_openings.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::uint32_t kScouts = 320;
constexpr int kRings = 16, kSectors = 32, kCells = kRings * kSectors; // of a scout's cosine-weighted hemisphere
constexpr float kOutside = 0.5F;     // share of sky seen by a scout that looks at it not through anything
constexpr std::size_t kMostRim = 32; // rim points of one patch of sky
constexpr int kHalvings = 16;        // 0.2 radians to a few millionths
constexpr std::size_t kLeastRim = 6; // rim points that make a plane
constexpr std::size_t kMostCandidates = 96;
constexpr std::size_t kMostWindows = 32;
constexpr float kInPlane = 5e-4F; // off a plane that counts as in it, relative to the distance seen from
constexpr float kMargin = 1e-4F;  // openings are larger than what was seen by this share: rim points may be off by as much
constexpr float kSky = std::numeric_limits<float>::infinity();
constexpr float kThroughGlass = 1e30F; // metres: as far as a ray gets that sees the sky through a pane

// A rectangle in a plane, from rim points seen by one or more scouts.
struct Candidate {
    vec3 normal{0.0F}; // unit, the way out
    float offset = 0.0F;
    vec3 u{0.0F}, v{0.0F}; // unit, in the plane
    vec2 low{0.0F}, high{0.0F};
    std::size_t votes = 0; // rim points in it

    [[nodiscard]] float area() const { return (high.x - low.x) * (high.y - low.y); }
    [[nodiscard]] vec2 at(const vec3& p) const { return {glm::dot(p, u), glm::dot(p, v)}; }
};

struct Scout {
    vec3 point{0.0F}, normal{0.0F, 1.0F, 0.0F};
    std::vector<vec3> directions;
    std::vector<float> reach; // how far each direction's ray gets; kSky = sees it through no pane
    bool inside = false;
    std::vector<Candidate> candidates;
};

// Places on all fronts: evenly, but no triangle counts for more than a hundredth of all, or a lawn would get them all.
std::vector<Scout> place_scouts(const RayScene& rays) {
    struct Piece {
        std::uint32_t surface, triangle;
        double sum; // of areas up to and with this one
    };
    std::vector<Piece> pieces;
    double total = 0.0;
    const auto area = [&](std::uint32_t s, std::uint32_t t) {
        const auto p = rays.triangle(s, t);
        return 0.5 * double(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
    };
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        for (std::uint32_t t = 0; t < rays.surfaces()[s].triangles.size(); ++t) {
            total += area(s, t);
        }
    }
    double sum = 0.0;
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        for (std::uint32_t t = 0; !rays.surfaces()[s].pane && t < rays.surfaces()[s].triangles.size(); ++t) {
            sum += std::min(area(s, t), 0.01 * total);
            pieces.push_back({s, t, sum});
        }
    }
    std::vector<Scout> scouts(pieces.empty() ? 0 : kScouts);
    for (std::uint32_t i = 0; i < scouts.size(); ++i) {
        const double wanted = (double(i) + 0.5) / double(kScouts) * sum;
        const auto piece = std::lower_bound(pieces.begin(), pieces.end(), wanted,
                                            [](const Piece& p, double value) { return p.sum < value; });
        const auto p = rays.triangle(piece->surface, piece->triangle);
        const vec2 x = sobol_owen2(i, 0, 0x5C0U);
        const float a = std::sqrt(x.x);
        scouts[i].point = p[0] * (1.0F - a) + p[1] * (a * (1.0F - x.y)) + p[2] * (a * x.y);
        scouts[i].normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
        if (rays.surfaces()[piece->surface].back_side && (i & 1U) != 0) {
            scouts[i].normal = -scouts[i].normal;
        }
    }
    return scouts;
}

bool sees_sky(const SkyRay& ray) { return max_component(ray.through) > 0.0F && !std::isfinite(ray.first_pane); }

void look_around(const RayScene& rays, Scout& scout, std::uint32_t index) {
    vec3 t;
    vec3 b;
    make_frame(scout.normal, t, b);
    const float turn = unit_float(std::uint32_t(hash64(index) >> 32)); // so that no two look the same ways
    scout.directions.resize(kCells);
    for (int i = 0; i < kCells; ++i) {
        const float u = (float(i / kSectors) + 0.5F) / float(kRings), r = std::sqrt(u);
        const float angle = 2.0F * kPi * (float(i % kSectors) + turn) / float(kSectors);
        scout.directions[std::size_t(i)] =
            glm::normalize((r * std::cos(angle)) * t + (r * std::sin(angle)) * b + std::sqrt(1.0F - u) * scout.normal);
    }
    std::vector<SkyRay> seen(kCells);
    rays.look_at_sky(scout.point, scout.directions, seen);
    scout.reach.assign(kCells, kSky);
    const float start = 1e-4F * (1.0F + glm::length(scout.point));
    std::size_t open = 0;
    for (std::size_t i = 0; i < kCells; ++i) {
        if (sees_sky(seen[i])) {
            ++open;
        } else if (std::isfinite(seen[i].first_pane)) {
            scout.reach[i] = kThroughGlass;
        } else {
            const Hit hit = rays.nearest({scout.point + start * scout.directions[i], scout.directions[i]});
            scout.reach[i] = hit ? start + hit.t : 0.0F;
        }
    }
    scout.inside = open > 0 && float(open) < kOutside * kCells;
}

// A patch of sky: cells side by side that see it. `done` marks those that belong to one already.
std::vector<int> patch_of_sky(const Scout& scout, int first, std::vector<std::uint8_t>& done) {
    std::vector<int> patch{first};
    done[std::size_t(first)] = 1;
    for (std::size_t k = 0; k < patch.size(); ++k) {
        const int ring = patch[k] / kSectors, sector = patch[k] % kSectors;
        const auto visit = [&](int r, int s) {
            const int cell = r * kSectors + (s + kSectors) % kSectors;
            if (r >= 0 && r < kRings && done[std::size_t(cell)] == 0 && scout.reach[std::size_t(cell)] == kSky) {
                done[std::size_t(cell)] = 1;
                patch.push_back(cell);
            }
        };
        visit(ring - 1, sector);
        visit(ring + 1, sector);
        visit(ring, sector - 1);
        visit(ring, sector + 1);
    }
    return patch;
}

// Points of the scene at which a patch of sky begins.
std::vector<vec3> rim_of_patch(const RayScene& rays, const Scout& scout, const std::vector<int>& patch) {
    std::vector<std::pair<int, int>> pairs; // a cell that sees the sky, one beside it that does not
    for (const int cell : patch) {
        const int ring = cell / kSectors, sector = cell % kSectors;
        const auto visit = [&](int r, int s) {
            const int other = r * kSectors + (s + kSectors) % kSectors;
            if (r >= 0 && r < kRings && scout.reach[std::size_t(other)] != kSky) {
                pairs.emplace_back(cell, other);
            }
        };
        visit(ring - 1, sector);
        visit(ring + 1, sector);
        visit(ring, sector - 1);
        visit(ring, sector + 1);
    }
    const std::size_t count = std::min(pairs.size(), kMostRim);
    std::vector<vec3> open(count), shut(count), middle(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto& [cell, other] = pairs[i * pairs.size() / count];
        open[i] = scout.directions[std::size_t(cell)];
        shut[i] = scout.directions[std::size_t(other)];
    }
    std::vector<SkyRay> seen(count);
    for (int k = 0; k < kHalvings; ++k) {
        for (std::size_t i = 0; i < count; ++i) {
            middle[i] = glm::normalize(open[i] + shut[i]);
        }
        rays.look_at_sky(scout.point, middle, seen);
        for (std::size_t i = 0; i < count; ++i) {
            (sees_sky(seen[i]) ? open[i] : shut[i]) = middle[i];
        }
    }
    std::vector<vec3> rim;
    const float start = 1e-4F * (1.0F + glm::length(scout.point));
    for (const vec3& direction : shut) {
        const vec3 from = scout.point + start * direction;
        if (const Hit hit = rays.nearest({from, direction})) {
            rim.push_back(from + hit.t * direction);
        }
    }
    return rim;
}

// Axes in a plane: level and upright; in a level plane along most of the rim.
void set_axes(Candidate& plane, const std::vector<vec3>& points) {
    if (std::abs(plane.normal.y) < 0.99F) {
        plane.u = glm::normalize(glm::cross(vec3(0.0F, 1.0F, 0.0F), plane.normal));
        plane.v = glm::cross(plane.normal, plane.u);
        return;
    }
    make_frame(plane.normal, plane.u, plane.v);
    const vec3 t = plane.u, b = plane.v;
    // Neighbours on the rim are mostly on one edge: their line is its direction, of which a quarter turn is as good.
    std::vector<vec2> ways; // cosine and sine of four times the angle
    for (std::size_t i = 0; i < points.size(); ++i) {
        const vec3 along = points[(i + 1) % points.size()] - points[i];
        const vec2 flat(glm::dot(along, t), glm::dot(along, b));
        if (glm::length(flat) > 0.0F) {
            const float angle = 4.0F * std::atan2(flat.y, flat.x);
            ways.emplace_back(std::cos(angle), std::sin(angle));
        }
    }
    std::size_t most = 0;
    for (const vec2& way : ways) {
        const auto same = std::size_t(
            std::count_if(ways.begin(), ways.end(), [&](const vec2& other) { return glm::length(other - way) < 0.01F; }));
        if (same > most) {
            most = same;
            vec2 mean(0.0F);
            for (const vec2& other : ways) {
                mean += glm::length(other - way) < 0.01F ? other : vec2(0.0F);
            }
            const float angle = 0.25F * std::atan2(mean.y, mean.x);
            plane.u = std::cos(angle) * t + std::sin(angle) * b;
            plane.v = std::cos(angle) * b - std::sin(angle) * t;
        }
    }
}

// Takes the plane with the most points out of `rim`; false where there is none with enough.
bool take_plane(const Scout& scout, std::vector<vec3>& rim, Candidate& out) {
    if (rim.size() < kLeastRim) {
        return false;
    }
    constexpr std::uint32_t kTries = 96;
    std::size_t most = 0;
    float largest = 0.0F;
    const auto is_in = [&](const vec3& p, const vec3& normal, float offset) {
        return std::abs(glm::dot(p, normal) - offset) <= kInPlane * glm::length(p - scout.point);
    };
    for (std::uint32_t k = 0; k < kTries; ++k) {
        const auto pick = [&](std::uint64_t salt) { return rim[std::size_t(hash64(3 * k + salt) % rim.size())]; };
        const vec3 a = pick(0), b = pick(1), c = pick(2);
        const vec3 cross = glm::cross(b - a, c - a);
        const float twice = glm::length(cross), edge = std::max(glm::length(b - a), glm::length(c - a));
        if (!(twice > 0.05F * edge * edge)) {
            continue; // nearly in a line
        }
        const vec3 normal = cross / twice;
        const float offset = glm::dot(normal, a);
        if (std::abs(offset - glm::dot(normal, scout.point)) < 0.02F * glm::length(a - scout.point)) {
            continue; // seen edge on
        }
        const auto in =
            std::size_t(std::count_if(rim.begin(), rim.end(), [&](const vec3& p) { return is_in(p, normal, offset); }));
        if (in > most || (in == most && twice > largest)) {
            most = in;
            largest = twice;
            out.normal = normal;
            out.offset = offset;
        }
    }
    if (most < std::max(kLeastRim, rim.size() / 4)) {
        return false;
    }
    if (glm::dot(out.normal, scout.point) > out.offset) {
        out.normal = -out.normal;
        out.offset = -out.offset;
    }
    const auto rest =
        std::stable_partition(rim.begin(), rim.end(), [&](const vec3& p) { return is_in(p, out.normal, out.offset); });
    const std::vector<vec3> points(rim.begin(), rest);
    rim.erase(rim.begin(), rest);
    set_axes(out, points);
    out.low = vec2(kSky);
    out.high = vec2(-kSky);
    for (const vec3& p : points) {
        out.low = glm::min(out.low, out.at(p));
        out.high = glm::max(out.high, out.at(p));
    }
    out.votes = points.size();
    return out.area() > 0.0F;
}

void propose(const RayScene& rays, Scout& scout) {
    std::vector<std::uint8_t> done(kCells, 0);
    for (int cell = 0; cell < kCells; ++cell) {
        if (done[std::size_t(cell)] != 0 || scout.reach[std::size_t(cell)] != kSky) {
            continue;
        }
        std::vector<vec3> rim = rim_of_patch(rays, scout, patch_of_sky(scout, cell, done));
        Candidate plane;
        while (take_plane(scout, rim, plane)) {
            scout.candidates.push_back(plane);
        }
    }
}

// Joins what is seen of one opening from several places.
std::vector<Candidate> join(const std::vector<Scout>& scouts, float extent) {
    std::vector<Candidate> out;
    for (const Scout& s : scouts) {
        for (const Candidate& c : s.candidates) {
            const auto one = std::find_if(out.begin(), out.end(), [&](const Candidate& o) {
                const float same = std::abs(glm::dot(o.u, c.u)), across = std::abs(glm::dot(o.u, c.v));
                if (glm::dot(o.normal, c.normal) < 0.99999F || std::abs(o.offset - c.offset) > 2e-4F * extent ||
                    std::min(same, across) > 2e-3F) {
                    return false;
                }
                // The other's corners along these axes.
                const vec3 a = c.u * c.low.x + c.v * c.low.y, b = c.u * c.high.x + c.v * c.high.y;
                const vec3 base = c.normal * c.offset;
                const vec2 low = glm::min(o.at(base + a), o.at(base + b)), high = glm::max(o.at(base + a), o.at(base + b));
                const vec2 common = glm::min(o.high, high) - glm::max(o.low, low);
                return common.x > 0.0F && common.y > 0.0F && common.x * common.y > 0.3F * std::min(o.area(), c.area());
            });
            if (one == out.end()) {
                out.push_back(c);
                continue;
            }
            const vec3 a = c.u * c.low.x + c.v * c.low.y, b = c.u * c.high.x + c.v * c.high.y;
            const vec3 base = c.normal * c.offset;
            one->low = glm::min(one->low, glm::min(one->at(base + a), one->at(base + b)));
            one->high = glm::max(one->high, glm::max(one->at(base + a), one->at(base + b)));
            one->votes += c.votes;
        }
    }
    std::stable_sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) { return a.votes > b.votes; });
    out.resize(std::min(out.size(), kMostCandidates));
    return out;
}

SkyWindow window_of(const Candidate& c) {
    const vec2 margin = kMargin * (c.high - c.low);
    const vec2 low = c.low - margin, high = c.high + margin;
    const auto corner = [&](float x, float y) { return c.normal * c.offset + c.u * x + c.v * y; };
    SkyWindow w;
    w.corners = {corner(low.x, low.y), corner(high.x, low.y), corner(high.x, high.y), corner(low.x, high.y)};
    w.normal = c.normal;
    w.opening = true;
    return w;
}

// The rays of one scout that cross a window outwards.
struct Crossings {
    std::vector<std::uint16_t> sky; // cells that see the sky
    std::size_t reaching = 0;       // all that get as far as the window
    std::size_t heading = 0;        // all that would if nothing stood before it
};

Crossings crossings(const Scout& scout, const SkyWindow& window) {
    Crossings out;
    for (std::size_t i = 0; i < scout.reach.size(); ++i) {
        const float t = window.crossing(scout.point, scout.directions[i]);
        if (!std::isfinite(t)) {
            continue;
        }
        ++out.heading;
        // What ends in the plane itself counts: it met the wall around the hole. So does what came through glass: a hole
        // before or behind a pane has no light of its own.
        out.reaching += scout.reach[i] >= t * (1.0F - 1e-3F) ? 1 : 0;
        if (scout.reach[i] == kSky) {
            out.sky.push_back(std::uint16_t(i));
        }
    }
    return out;
}

// How good a window is, from what all scouts see through it.
struct Worth {
    std::size_t rays = 0; // that see the sky and that no window before it explains
    std::size_t sky = 0, reaching = 0;
    float value = 0.0F; // sum over the scouts inside of: share of their sky that it explains, times share of it that is sky
};

Worth worth_of(const std::vector<Scout>& scouts, const std::vector<Crossings>& through,
               const std::vector<std::uint8_t>& unexplained, const std::vector<std::size_t>& sky_cells) {
    Worth out;
    for (std::size_t s = 0; s < scouts.size(); ++s) {
        const Crossings& c = through[s];
        const auto fresh = std::size_t(
            std::count_if(c.sky.begin(), c.sky.end(), [&](std::uint16_t i) { return unexplained[s * kCells + i] != 0; }));
        out.rays += fresh;
        out.sky += c.sky.size();
        out.reaching += c.reaching;
        if (scouts[s].inside && fresh > 0) {
            out.value += float(fresh) / float(sky_cells[s]) * float(c.sky.size()) / float(c.heading);
        }
    }
    return out;
}

} // namespace

SkyOpenings find_sky_openings(const RayScene& rays, const RunContext& context) {
    std::vector<Scout> scouts = place_scouts(rays);
    parallel_chunks(scouts.size(), 4, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            look_around(rays, scouts[i], std::uint32_t(i));
            if (scouts[i].inside) {
                propose(rays, scouts[i]);
            }
        }
    });
    SkyOpenings out;
    if (context.should_stop()) {
        return out;
    }
    std::vector<std::uint8_t> unexplained(scouts.size() * kCells, 0);
    std::vector<std::size_t> sky_cells(scouts.size(), 0);
    for (std::size_t s = 0; s < scouts.size(); ++s) {
        for (std::size_t i = 0; i < kCells; ++i) {
            unexplained[s * kCells + i] = scouts[s].reach[i] == kSky ? 1 : 0;
            sky_cells[s] += unexplained[s * kCells + i];
        }
    }
    std::vector<SkyWindow> windows;
    for (const Candidate& c : join(scouts, rays.bounds().diagonal())) {
        windows.push_back(window_of(c));
    }
    std::vector<std::vector<Crossings>> through(windows.size());
    parallel_chunks(windows.size(), 1, [&](std::size_t w, std::size_t, std::size_t) {
        for (const Scout& s : scouts) {
            through[w].push_back(context.should_stop() ? Crossings{} : crossings(s, windows[w]));
        }
    });
    // The best comes first; what it explains counts for no other.
    while (out.windows.size() < kMostWindows && !context.should_stop()) {
        constexpr float kLeastClear = 0.5F; // of the light that reaches an opening, from the sky
        constexpr float kLeastValue = 0.5F;
        constexpr std::size_t kLeastRays = 8;
        std::size_t best = windows.size();
        float most = kLeastValue;
        for (std::size_t i = 0; i < windows.size(); ++i) {
            const Worth w = worth_of(scouts, through[i], unexplained, sky_cells);
            if (w.rays >= kLeastRays && float(w.sky) >= kLeastClear * float(w.reaching) && w.value > most) {
                most = w.value;
                best = i;
            }
        }
        if (best == windows.size()) {
            break;
        }
        out.windows.push_back(windows[best]);
        for (std::size_t s = 0; s < scouts.size(); ++s) {
            for (const std::uint16_t cell : through[best][s].sky) {
                unexplained[s * kCells + cell] = 0;
            }
        }
    }
    out.elsewhere = scouts.empty() || std::any_of(unexplained.begin(), unexplained.end(), [](auto u) { return u != 0; });
    return out;
}

} // namespace atrium
