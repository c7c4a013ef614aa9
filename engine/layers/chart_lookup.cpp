#include "engine/layers/chart_lookup.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr float kInside = 1e-5F; // metres outside an edge that still count as inside: rounding of coordinates
constexpr int kMostBinsPerTile = 16;

float cross2(const vec2& a, const vec2& b) { return a.x * b.y - a.y * b.x; }

// Separating axes of a triangle and a box: true when they overlap or touch.
bool overlap(const vec2 (&t)[3], const vec2& lo, const vec2& hi) {
    const vec2 least = glm::min(t[0], glm::min(t[1], t[2])), most = glm::max(t[0], glm::max(t[1], t[2]));
    if (least.x > hi.x || least.y > hi.y || most.x < lo.x || most.y < lo.y) {
        return false;
    }
    for (int k = 0; k < 3; ++k) {
        const vec2 edge = t[(k + 1) % 3] - t[k];
        const vec2 n(-edge.y, edge.x);
        const float own = glm::dot(n, t[k]), other = glm::dot(n, t[(k + 2) % 3]);
        const vec2 towards(n.x > 0.0F ? hi.x : lo.x, n.y > 0.0F ? hi.y : lo.y);
        const vec2 away(n.x > 0.0F ? lo.x : hi.x, n.y > 0.0F ? lo.y : hi.y);
        if (glm::dot(n, away) > std::max(own, other) || glm::dot(n, towards) < std::min(own, other)) {
            return false;
        }
    }
    return true;
}

struct Weights {
    vec3 corner{0.0F}; ///< barycentric
    vec3 height{0.0F}; ///< signed distance from the opposite edge, metres
    bool flat = true;  ///< no area: the weights mean nothing
};
Weights weights(const vec2 (&t)[3], const vec2& p) {
    Weights out;
    const float area2 = cross2(t[1] - t[0], t[2] - t[0]);
    if (area2 == 0.0F) {
        return out;
    }
    out.flat = false;
    for (int k = 0; k < 3; ++k) {
        const vec2 edge = t[(k + 2) % 3] - t[(k + 1) % 3];
        const float twice = cross2(edge, p - t[(k + 1) % 3]);
        out.corner[k] = twice / area2;
        out.height[k] = std::copysign(1.0F, area2) * twice / glm::length(edge);
    }
    return out;
}

// Nearest point of a triangle's border as weights of the corners.
vec3 nearest_on_border(const vec2 (&t)[3], const vec2& p, float& distance) {
    vec3 best(1.0F, 0.0F, 0.0F);
    distance = std::numeric_limits<float>::infinity();
    for (int k = 0; k < 3; ++k) {
        const vec2 a = t[k], edge = t[(k + 1) % 3] - a;
        const float length2 = glm::dot(edge, edge);
        const float s = length2 > 0.0F ? std::clamp(glm::dot(p - a, edge) / length2, 0.0F, 1.0F) : 0.0F;
        const float d = glm::length(p - (a + edge * s));
        if (d < distance) {
            distance = d;
            best = vec3(0.0F);
            best[k] = 1.0F - s;
            best[(k + 1) % 3] = s;
        }
    }
    return best;
}

} // namespace

ChartLookup::ChartLookup(const SurfaceCharts& charts, const Chart& chart, std::span<const std::uint32_t> triangles)
    : chart_(chart), touched_(std::size_t(chart.tiles_u) * chart.tiles_v, 0) {
    const vec2 corner(float(chart.tile_u), float(chart.tile_v));
    flat_.reserve(triangles.size());
    for (const std::uint32_t t : triangles) {
        Flat f{{}, t};
        for (std::size_t k = 0; k < 3; ++k) {
            f.corner[k] = (charts.uv[t][k] - corner) * chart.scale;
        }
        flat_.push_back(f);
    }
    int per_tile = 1;
    while (per_tile < kMostBinsPerTile && touched_.size() * std::size_t(per_tile * per_tile) < triangles.size()) {
        per_tile *= 2;
    }
    bins_x_ = int(chart.tiles_u) * per_tile;
    bins_y_ = int(chart.tiles_v) * per_tile;
    bin_ = chart.scale / float(per_tile);
    add_to_bins();
}

int ChartLookup::bin_x(float x) const { return std::clamp(int(std::floor(x / bin_.x)), 0, bins_x_ - 1); }
int ChartLookup::bin_y(float y) const { return std::clamp(int(std::floor(y / bin_.y)), 0, bins_y_ - 1); }

void ChartLookup::add_to_bins() {
    const auto each = [&](const Flat& f, const vec2& size, int count_x, int count_y, float margin, auto&& visit) {
        const vec2 least = glm::min(f.corner[0], glm::min(f.corner[1], f.corner[2]));
        const vec2 most = glm::max(f.corner[0], glm::max(f.corner[1], f.corner[2]));
        const auto place = [](float x, int count) { return std::clamp(int(std::floor(x)), 0, count - 1); };
        for (int y = place(least.y / size.y - 0.01F, count_y); y <= place(most.y / size.y + 0.01F, count_y); ++y) {
            for (int x = place(least.x / size.x - 0.01F, count_x); x <= place(most.x / size.x + 0.01F, count_x); ++x) {
                const vec2 lo = vec2(float(x), float(y)) * size;
                if (overlap(f.corner, lo - margin * size, lo + (1.0F + margin) * size)) {
                    visit(std::size_t(y) * std::size_t(count_x) + std::size_t(x));
                }
            }
        }
    };
    first_.assign(std::size_t(bins_x_) * std::size_t(bins_y_) + 1, 0);
    for (const Flat& f : flat_) {
        each(f, bin_, bins_x_, bins_y_, 1e-4F, [&](std::size_t bin) { ++first_[bin + 1]; });
        each(f, chart_.scale, int(chart_.tiles_u), int(chart_.tiles_v), -1e-4F, [&](std::size_t t) { touched_[t] = 1; });
    }
    for (std::size_t i = 1; i < first_.size(); ++i) {
        first_[i] += first_[i - 1];
    }
    members_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < flat_.size(); ++i) {
        each(flat_[i], bin_, bins_x_, bins_y_, 1e-4F, [&](std::size_t bin) { members_[next[bin]++] = i; });
    }
}

ChartPoint ChartLookup::containing(const vec2& at) const {
    const std::size_t bin = std::size_t(bin_y(at.y)) * std::size_t(bins_x_) + std::size_t(bin_x(at.x));
    for (std::uint32_t i = first_[bin]; i < first_[bin + 1]; ++i) {
        const Flat& f = flat_[members_[i]];
        const Weights w = weights(f.corner, at);
        if (!w.flat && std::min({w.height.x, w.height.y, w.height.z}) >= -kInside) {
            const vec3 inside = glm::max(w.corner, vec3(0.0F));
            const float sum = inside.x + inside.y + inside.z;
            return {f.triangle, vec2(inside.y, inside.z) / sum, 0.0F};
        }
    }
    return {};
}

ChartPoint ChartLookup::nearest(const vec2& at, float reach) const {
    if (const ChartPoint inside = containing(at)) {
        return inside;
    }
    ChartPoint best;
    best.distance = std::numeric_limits<float>::infinity();
    const int cx = bin_x(at.x), cy = bin_y(at.y);
    const float step = std::min(bin_.x, bin_.y);
    const int rings = std::max(bins_x_, bins_y_);
    for (int ring = 0; ring < rings; ++ring) {
        // Whatever lies in this ring or beyond is at least ring - 1 whole bins away.
        const float least = step * float(ring - 1);
        if (least > reach || best.distance <= least) {
            break;
        }
        for (int y = std::max(cy - ring, 0); y <= std::min(cy + ring, bins_y_ - 1); ++y) {
            const bool whole_row = y == cy - ring || y == cy + ring;
            for (int x = cx - ring; x <= cx + ring; x += whole_row ? 1 : std::max(2 * ring, 1)) {
                if (x < 0 || x >= bins_x_) {
                    continue;
                }
                const std::size_t bin = std::size_t(y) * std::size_t(bins_x_) + std::size_t(x);
                for (std::uint32_t i = first_[bin]; i < first_[bin + 1]; ++i) {
                    const Flat& f = flat_[members_[i]];
                    float distance = 0.0F;
                    const vec3 w = nearest_on_border(f.corner, at, distance);
                    // Equal distances are common at shared corners: the first triangle of the surface wins.
                    if (distance < best.distance || (distance == best.distance && f.triangle < best.triangle)) {
                        best = {f.triangle, vec2(w.y, w.z), distance};
                    }
                }
            }
        }
    }
    return best;
}

ChartPoint ChartLookup::nearest_inside(const vec2& at, float reach, float pull) const {
    const ChartPoint on = nearest(at, reach);
    if (!on) {
        return on;
    }
    const auto f = std::lower_bound(flat_.begin(), flat_.end(), on.triangle,
                                    [](const Flat& a, std::uint32_t triangle) { return a.triangle < triangle; });
    const vec2(&t)[3] = f->corner;
    const vec2 p = t[0] + (t[1] - t[0]) * on.barycentric.x + (t[2] - t[0]) * on.barycentric.y;
    const Weights w = weights(t, p);
    if (!w.flat && std::min({w.height.x, w.height.y, w.height.z}) > pull) {
        return on;
    }
    // Looking about: where the triangles go on is inside, whatever their edges.
    vec2 inwards(0.0F);
    int inside = 0;
    for (int k = 0; k < 8; ++k) {
        const float angle = 2.0F * kPi * float(k) / 8.0F;
        const vec2 way(std::cos(angle), std::sin(angle));
        if (containing(p + way * pull)) {
            inwards += way;
            ++inside;
        }
    }
    const float length = glm::length(inwards);
    if (inside == 8 || length < 0.1F) {
        return on;
    }
    ChartPoint moved = containing(p + inwards * (pull / length));
    if (!moved) {
        return on;
    }
    moved.distance = on.distance;
    return moved;
}

} // namespace atrium
