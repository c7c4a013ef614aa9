// The way: straight stretches of the outlines of all sheets; pairs of them that face each other across a narrow gap; and
// those of the gaps through which a lamp is seen that reaches places where it is not seen in another way.
#include "engine/radiosity/lamp_slits.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>

namespace atrium {
namespace {

constexpr float kNarrow = 0.004F;  // width of a gap over the size of the largest lamp: rays find wider ones, more or less
constexpr float kLong = 4.0F;      // least length of a gap over its width
constexpr float kParallel = 0.01F; // sine of the largest angle between two edges, and slope of a gap over its length
constexpr float kTurned = 0.5F;    // cosine of the largest angle between a sheet's way out and the way across the gap
constexpr float kThrough = 20.0F;  // widths that light must get beyond a gap to have come through it
constexpr std::size_t kMostCandidates = 512;
constexpr std::size_t kMostSlits = 16;

/// A straight piece of a sheet's outline.
struct Stretch {
    vec3 start{0.0F};
    vec3 along{0.0F}; // unit
    vec3 out{0.0F};   // unit, in the sheet's plane, away from it
    float length = 0.0F;
    std::uint32_t sheet = 0;

    [[nodiscard]] vec3 end() const { return start + length * along; }
};

// Pieces of edges on one line, from one end to the other.
struct Piece {
    float from = 0.0F, to = 0.0F;
};
struct Line {
    vec2 way{0.0F}; // unit
    float offset = 0.0F;
    std::vector<Piece> pieces;
};

// Outline of a sheet, pieces of one line joined. Edges that two triangles share lie within it.
void add_outline(const Hierarchy& h, std::uint32_t index, float least_length, StopCheck& stop, std::vector<Stretch>& out) {
    const Sheet& sheet = h.sheets[index];
    constexpr float kSame = 2e-5F; // metres: corners of one place
    using Corner = std::pair<std::int64_t, std::int64_t>;
    const auto corner = [](const vec2& p) { return Corner(std::llround(p.x / kSame), std::llround(p.y / kSame)); };
    std::map<std::pair<Corner, Corner>, std::pair<int, std::array<vec2, 2>>> edges; // times it is there; as it was first
    for (std::uint32_t t = sheet.first; t < sheet.first + sheet.count && !stop(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::array<vec2, 2> ends{h.sheet_triangles[t].uv[k], h.sheet_triangles[t].uv[(k + 1) % 3]};
            Corner a = corner(ends[0]), b = corner(ends[1]);
            if (b < a) {
                std::swap(a, b);
            }
            auto& edge = edges.try_emplace({a, b}, std::pair{0, ends}).first->second;
            ++edge.first;
        }
    }
    // Lines by their direction and distance from the sheet's corner, both rounded.
    std::map<std::pair<std::int64_t, std::int64_t>, Line> lines;
    for (const auto& [key, edge] : edges) {
        const vec2 d = edge.second[1] - edge.second[0];
        const float length = glm::length(d);
        if (edge.first != 1 || !(length > 0.0F)) {
            continue;
        }
        const vec2 way = d / length;
        const vec2 across(way.y, -way.x); // right of the way: outside
        const float offset = glm::dot(edge.second[0], across);
        const std::pair rounded(std::llround(std::atan2(way.y, way.x) * 2e3F), std::llround(offset / kSame));
        Line& line = lines.try_emplace(rounded, Line{way, offset, {}}).first->second;
        const float from = glm::dot(edge.second[0], line.way);
        line.pieces.push_back({from, from + length});
    }
    for (auto& [rounded, line] : lines) {
        const vec2 way = line.way, across(way.y, -way.x);
        std::vector<Piece>& pieces = line.pieces;
        std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.from < b.from; });
        for (std::size_t i = 0; i < pieces.size();) {
            Piece whole = pieces[i];
            for (++i; i < pieces.size() && pieces[i].from <= whole.to + kSame; ++i) {
                whole.to = std::max(whole.to, pieces[i].to);
            }
            if (whole.to - whole.from < least_length) {
                continue;
            }
            const auto in_space = [&](const vec2& v) { return sheet.axis_u * v.x + sheet.axis_v * v.y; };
            Stretch s;
            s.start = sheet.origin + in_space(way * whole.from + across * line.offset);
            s.along = in_space(way);
            s.out = in_space(across);
            s.length = whole.to - whole.from;
            s.sheet = index;
            out.push_back(s);
        }
    }
}

// The rectangle between two stretches that face each other; none where they do not, or too far apart.
std::optional<SkyWindow> gap_between(const Stretch& a, const Stretch& b, float widest) {
    if (glm::length(glm::cross(a.along, b.along)) > kParallel) {
        return std::nullopt;
    }
    const float first = glm::dot(b.start - a.start, a.along), last = glm::dot(b.end() - a.start, a.along);
    const float from = std::max(std::min(first, last), 0.0F), to = std::min(std::max(first, last), a.length);
    if (!(to > from)) {
        return std::nullopt;
    }
    const auto across_at = [&](float t) { // from the one to the other, at a right angle to the first
        return b.start + b.along * ((t - first) / (last - first) * b.length) - (a.start + a.along * t);
    };
    const vec3 at_start = across_at(from), at_end = across_at(to), middle = 0.5F * (at_start + at_end);
    const float width = glm::length(middle);
    const float least = 0.1F * shadow_offset(a.start); // narrower gaps are cracks between surfaces that were meant to meet
    if (!(width > least) || width > widest || to - from < kLong * width ||
        glm::length(at_end - at_start) > kParallel * (to - from)) {
        return std::nullopt;
    }
    const vec3 way = middle / width;
    if (glm::dot(a.out, way) < kTurned || -glm::dot(b.out, way) < kTurned) {
        return std::nullopt;
    }
    // A little wider: what lies beyond the edges is dark for all who look there.
    constexpr float kMargin = 1e-3F;
    const float low = -kMargin * width;
    const float high = std::max(glm::dot(at_start, way), glm::dot(at_end, way)) + kMargin * width;
    const vec3 corner = a.start + a.along * from + way * low, u = a.along * (to - from), v = way * (high - low);
    SkyWindow out;
    out.corners = {corner, corner + u, corner + u + v, corner + v};
    out.normal = glm::normalize(glm::cross(a.along, way));
    return out;
}

float area_of(const SkyWindow& w) {
    return glm::length(w.corners[1] - w.corners[0]) * glm::length(w.corners[3] - w.corners[0]);
}

// The plane of a stretch's sheet, whichever side is its front. Rounded to lengths that nobody builds in.
std::array<std::int64_t, 4> plane_of(const Stretch& s) {
    constexpr float kAngle = 0.0371F, kOffset = 0.00437F;
    vec3 n = glm::cross(s.along, s.out);
    const float sign = std::abs(n.x) > 0.5F ? n.x : (std::abs(n.y) > 0.5F ? n.y : n.z);
    n = sign < 0.0F ? -n : n;
    return {std::llround(n.x / kAngle), std::llround(n.y / kAngle), std::llround(n.z / kAngle),
            std::llround(glm::dot(n, s.start) / kOffset)};
}

// All gaps between stretches whose bounds are near each other, the largest first.
std::vector<SkyWindow> gaps(const std::vector<Stretch>& stretches, float widest, StopCheck& stop) {
    struct Bounds {
        Box3 box;
        std::uint32_t stretch;
        std::array<std::int64_t, 4> plane; // rounded: only what lies in one plane is compared
    };
    std::vector<Bounds> all;
    Box3 around;
    for (std::uint32_t i = 0; i < stretches.size(); ++i) {
        Box3 box;
        box.add(stretches[i].start);
        box.add(stretches[i].end());
        around.add(box);
        all.push_back({box, i, plane_of(stretches[i])});
    }
    if (all.empty()) {
        return {};
    }
    const vec3 size = around.max - around.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    std::stable_sort(all.begin(), all.end(), [axis](const Bounds& a, const Bounds& b) {
        return a.plane != b.plane ? a.plane < b.plane : a.box.min[axis] < b.box.min[axis];
    });
    std::vector<SkyWindow> out;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t k = i + 1;
             k < all.size() && all[k].plane == all[i].plane && all[k].box.min[axis] <= all[i].box.max[axis] + widest; ++k) {
            if (stop()) {
                return {};
            }
            const vec3 apart = glm::max(all[k].box.min - all[i].box.max, all[i].box.min - all[k].box.max);
            if (max_component(apart) > widest) {
                continue;
            }
            if (const auto gap = gap_between(stretches[all[i].stretch], stretches[all[k].stretch], widest)) {
                out.push_back(*gap);
            }
        }
    }
    std::stable_sort(out.begin(), out.end(), [](const SkyWindow& a, const SkyWindow& b) { return area_of(a) > area_of(b); });
    out.resize(std::min(out.size(), kMostCandidates));
    return out;
}

// The parts of a gap that nothing lies in: other surfaces may fill some of its length.
std::vector<SkyWindow> open_parts(const RayScene& rays, const SkyWindow& gap) {
    constexpr int kLooks = 64, kHalvings = 12;
    const vec3 u = gap.corners[1] - gap.corners[0], v = gap.corners[3] - gap.corners[0];
    const float width = glm::length(v);
    const auto open_at = [&](float t) {
        const vec3 place = gap.corners[0] + u * t + 0.5F * v;
        return max_component(rays.transmittance(Ray{place + gap.normal * width, -gap.normal, 2.0F * width})) > 0.0F;
    };
    const auto border = [&](float open, float shut) {
        for (int i = 0; i < kHalvings; ++i) {
            const float middle = 0.5F * (open + shut);
            (open_at(middle) ? open : shut) = middle;
        }
        return 0.5F * (open + shut);
    };
    const auto at = [](int i) { return (float(i) + 0.5F) / float(kLooks); };
    std::vector<SkyWindow> out;
    for (int i = 0; i < kLooks; ++i) {
        if (!open_at(at(i))) {
            continue;
        }
        const float from = i == 0 ? 0.0F : border(at(i), at(i - 1));
        while (i + 1 < kLooks && open_at(at(i + 1))) {
            ++i;
        }
        const float to = i + 1 == kLooks ? 1.0F : border(at(i), at(i + 1));
        SkyWindow part = gap;
        part.corners = {gap.corners[0] + u * from, gap.corners[0] + u * to, gap.corners[0] + u * to + v,
                        gap.corners[0] + u * from + v};
        out.push_back(part);
    }
    return out;
}

// How much light comes through a gap that comes no other way, up to a factor common to all.
float worth_of(const RayScene& rays, const Hierarchy& lamps, const SkyWindow& gap, std::uint32_t index) {
    constexpr std::uint32_t kPlaces = 64, kLooks = 8;
    constexpr std::uint32_t kScouts = 16; // of which none came through: the others would not either
    constexpr std::uint32_t kLeast = 4;   // ways through that are dark otherwise
    const vec3 u = gap.corners[1] - gap.corners[0], v = gap.corners[3] - gap.corners[0];
    const float width = glm::length(v);
    std::uint32_t through = 0, lit_anyway = 0;
    float light = 0.0F;
    for (std::uint32_t i = 0; i < kPlaces && (i != kScouts || through + lit_anyway > 0); ++i) {
        const vec2 at = sobol_owen2(i, 0, index), on = sobol_owen2(i, 2, index);
        const vec3 place = gap.corners[0] + u * at.x + v * at.y;
        const SurfacePoint lamp = sample_point(lamps, rays, 0, on, true);
        const vec3 d = lamp.position - place;
        const float distance = glm::length(d), cosine = -glm::dot(d, lamp.normal) / std::max(distance, 1e-30F);
        if (!(cosine > 0.0F) || !(distance > width) || max_component(rays.transmittance(place, lamp.position)) <= 0.0F) {
            continue;
        }
        const vec3 on_way = -d / distance;
        const Hit hit = rays.nearest({place, on_way});
        if (hit && hit.t < kThrough * width) {
            continue;
        }
        // The place behind: in sight of the lamps in another way? Where the way leads out of the scene it is not known.
        const vec3 behind = place + on_way * hit.t;
        const vec3 normal = hit.front ? hit.geometric_normal : -hit.geometric_normal;
        bool dark = true;
        for (std::uint32_t k = 0; hit && k < kLooks && dark; ++k) {
            const SurfacePoint other = sample_point(lamps, rays, 0, sobol_owen2(k, 2, index), true);
            const vec3 to = other.position - behind;
            dark = glm::dot(to, normal) <= 0.0F || glm::dot(to, other.normal) >= 0.0F ||
                   std::isfinite(gap.crossing(behind, glm::normalize(to))) || rays.occluded(behind, other.position);
        }
        lit_anyway += dark ? 0 : 1;
        if (dark) {
            ++through;
            light += std::abs(glm::dot(d, gap.normal)) / distance * cosine / (distance * distance);
        }
    }
    return through >= kLeast && lit_anyway <= through ? light * area_of(gap) : 0.0F;
}

// Largest of what shines as one piece.
float largest_lamp(const Hierarchy& lamps) {
    float out = 0.0F;
    for (const Element& e : lamps.elements) {
        out = e.leaf() && e.power > 0.0F ? std::max(out, 2.0F * e.radius) : out;
    }
    return out;
}

} // namespace

std::vector<SkyWindow> find_lamp_slits(const RayScene& rays, const Hierarchy& lamps, const RunContext& context) {
    const float widest = lamps.empty() ? 0.0F : kNarrow * largest_lamp(lamps);
    if (!(widest > 0.0F)) {
        return {};
    }
    StopCheck stop(context, kMeshStride);
    std::vector<Stretch> stretches;
    for (std::uint32_t s = 0; s < lamps.sheets.size(); ++s) {
        add_outline(lamps, s, lamps.settings.group_size, stop, stretches);
    }
    const std::vector<SkyWindow> candidates = gaps(stretches, widest, stop);
    struct Slit {
        SkyWindow window;
        float worth = 0.0F;
    };
    std::vector<std::vector<Slit>> found(candidates.size());
    parallel_chunks(candidates.size(), 8, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            for (const SkyWindow& part : open_parts(rays, candidates[i])) {
                if (const float worth = worth_of(rays, lamps, part, std::uint32_t(i)); worth > 0.0F) {
                    found[i].push_back({part, worth});
                }
            }
        }
    });
    if (context.should_stop()) {
        return {};
    }
    std::vector<Slit> slits;
    for (const std::vector<Slit>& parts : found) {
        slits.insert(slits.end(), parts.begin(), parts.end());
    }
    std::stable_sort(slits.begin(), slits.end(), [](const Slit& a, const Slit& b) { return a.worth > b.worth; });
    std::vector<SkyWindow> out;
    const auto middle = [](const SkyWindow& w) { return 0.5F * (w.corners[0] + w.corners[2]); };
    for (const Slit& slit : slits) {
        const SkyWindow& gap = slit.window;
        const float width = glm::length(gap.corners[3] - gap.corners[0]);
        const bool again = std::any_of(out.begin(), out.end(), [&](const SkyWindow& o) { // edges that are there twice
            return glm::length(middle(o) - middle(gap)) < 0.5F * width;
        });
        if (!again && out.size() < kMostSlits) {
            out.push_back(gap);
        }
    }
    return out;
}

} // namespace atrium
