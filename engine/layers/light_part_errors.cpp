// Which cells of a part of the direct light are rough: where interpolation between its samples is off.
#include "engine/base/parallel.h"
#include "engine/layers/light_part.h"

#include <algorithm>
#include <cmath>

namespace atrium {
namespace {

using State = LightNode::State;

// Large cells of soft parts are few: their light may as well be right, so they are judged by less than the contrast asked
// for and in dimmer light.
constexpr float kLargeCells = 0.5F;
// Metres: cells that a covered place and an open one share are divided down to this, since a shadow may begin between them.
constexpr float kCoverEdge = 0.04F;

} // namespace

// Error of the interpolation in a cell, relative to the light there, that asks for no division yet.
float LightPart::allowed(const LightCell& c) const {
    return c.level < probe_level_ ? kLargeCells * settings_.contrast : settings_.contrast;
}

// A difference that the samples' own noise explains is no reason to look closer: it would be noise again.
float LightPart::relative(const LightCell& cell, float difference, float variance, float light) const {
    const float floor = cell.level < probe_level_ ? kLargeCells * floor_[cell.sheet] : floor_[cell.sheet];
    return difference > 2.0F * std::sqrt(variance) ? difference / std::max(light, floor) : 0.0F;
}

// Error of linear interpolation from a to b, judged by the nodes before and behind them: half the lesser of the two
// bends is right for an edge or a kink between a and b, and too much only for smooth curves. The greater one may be
// another cell's edge.
float LightPart::bend(const LightCell& c, const LightGuess& a, const LightGuess& b, const LightNode& start, bool along_u,
                      float light) const {
    const auto s = std::int64_t(cells_.steps(c.level));
    const std::int64_t dx = along_u ? s : 0, dy = along_u ? 0 : s, x = start.x, y = start.y;
    const LightGuess before = cells_.guess(c.sheet, x - dx, y - dy);
    const LightGuess behind = cells_.guess(c.sheet, x + 2 * dx, y + 2 * dy);
    const float first = std::abs(before.light - 2.0F * a.light + b.light);
    const float second = std::abs(a.light - 2.0F * b.light + behind.light);
    float least = std::abs(b.light - a.light);
    if (before.known && behind.known) {
        least = std::min(first, second);
    } else if (before.known || behind.known) {
        least = before.known ? first : second;
    }
    return relative(c, 0.3F * least, 0.25F * (a.variance + b.variance), light);
}

// Whether this part shines at a cell or one beside it: only there can an edge begin at what covers the surface.
bool LightPart::lit_around(const LightCell& c) const {
    const std::int64_t s = cells_.steps(c.level);
    for (std::int64_t k = 0; k < 16; ++k) {
        const LightGuess g = cells_.guess(c.sheet, c.x + (k % 4 - 1) * s, c.y + (k / 4 - 1) * s);
        if (g.known && g.light > 0.0F) {
            return true;
        }
    }
    return false;
}

// Where a covered node follows a known one, an edge that comes in beside them may run on under the cover, or may not: how
// much the light changes on the way to the known one.
float LightPart::change_at_cover(const LightCell& c, std::uint32_t known, std::uint32_t covered, float light) const {
    const LightNode& k = cells_.nodes[known];
    const LightNode& v = cells_.nodes[covered];
    const LightGuess before =
        cells_.guess(c.sheet, 2 * std::int64_t(k.x) - std::int64_t(v.x), 2 * std::int64_t(k.y) - std::int64_t(v.y));
    if (v.state != State::Covered || !before.known) {
        return 0.0F;
    }
    const float there = luminance(k.irradiance);
    return relative(c, 0.3F * std::abs(before.light - there), 0.1F * (before.variance + k.variance),
                    std::max(light, before.light));
}

// How far interpolation in a cell is off, relative to the light; above allowed() it is to be divided.
float LightPart::error(const LightCell& c) const {
    const auto corner = cells_.corners(c);
    const std::uint32_t s = cells_.steps(c.level);
    LightGuess g[4];
    float light = 0.0F;
    int known = 0, covered = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const LightNode& n = cells_.nodes[corner[k]];
        g[k] = {luminance(n.irradiance), n.variance, n.known()};
        light = n.known() ? std::max(light, g[k].light) : light;
        known += n.known() ? 1 : 0;
        covered += n.state == State::Covered ? 1 : 0;
    }
    if (known == 0) {
        return 0.0F;
    }
    const float others = other_light(c);
    light += others;
    bool hidden = covered > 0;
    float worst = 0.0F;
    for_probes(c, [&](const Probe& probe, const vec2& at) {
        hidden = hidden || probe.covered;
        worst = probe.seen.known ? std::max(worst, off(c, probe.seen, at.x, at.y)) : worst;
    });
    if (hidden && edge_metres(c) > kCoverEdge && lit_around(c)) {
        worst = std::max(worst, 2.0F * allowed(c));
    }
    // Edges of the cell as pairs of corners: two along u, two along v.
    static constexpr std::size_t kEdges[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
    for (std::size_t e = 0; e < 4; ++e) {
        const LightGuess& a = g[kEdges[e][0]];
        const LightGuess& b = g[kEdges[e][1]];
        if (a.known != b.known) {
            worst = std::max(
                worst, change_at_cover(c, corner[kEdges[e][a.known ? 0 : 1]], corner[kEdges[e][a.known ? 1 : 0]], light));
        }
        if (!a.known || !b.known) {
            continue;
        }
        const LightNode& start = cells_.nodes[corner[kEdges[e][0]]];
        worst = std::max(worst, bend(c, a, b, start, e < 2, light));
        const std::uint32_t middle = cells_.find(c.sheet, start.x + (e < 2 ? s / 2 : 0), start.y + (e < 2 ? 0 : s / 2));
        if (middle != LightCells::kNone && cells_.nodes[middle].known()) {
            const LightNode& m = cells_.nodes[middle];
            const float there = luminance(m.irradiance);
            worst =
                std::max(worst, relative(c, std::abs(there - 0.5F * (a.light + b.light)),
                                         m.variance + 0.25F * (a.variance + b.variance), std::max(light, there + others)));
        }
    }
    return worst;
}

// How far interpolation in a cell is off what was seen at a place in it (steps from its corner).
float LightPart::off(const LightCell& c, const LightGuess& seen, float dx, float dy) const {
    const LightGuess guess = cells_.interpolate(c, dx, dy);
    return guess.known ? relative(c, std::abs(seen.light - guess.light), seen.variance + guess.variance,
                                  std::max(seen.light, guess.light) + other_light(c))
                       : 0.0F;
}

// The least light of the parts that it is judged by at a cell's corners, lux.
float LightPart::other_light(const LightCell& c) const {
    const std::int64_t s = cells_.steps(c.level);
    float sum = 0.0F;
    for (const LightPart* part : judged_by_) {
        float least = std::numeric_limits<float>::infinity();
        for (std::int64_t k = 0; k < 4; ++k) {
            const LightGuess g = part->cells_.guess(c.sheet, c.x + (k & 1) * s, c.y + (k >> 1) * s);
            least = std::min(least, g.known ? g.light : 0.0F);
        }
        sum += least;
    }
    return sum;
}

// Adds the rough ones among new cells.
void LightPart::examine(const std::vector<LightCell>& fresh, std::vector<Rough>& rough) const {
    std::vector<float> errors(fresh.size(), 0.0F);
    parallel_chunks(fresh.size(), 256, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context_->should_stop(); ++i) {
            errors[i] = fresh[i].level < finest_ ? error(fresh[i]) : 0.0F;
        }
    });
    for (std::size_t i = 0; i < fresh.size(); ++i) {
        if (errors[i] > allowed(fresh[i])) {
            rough.push_back({fresh[i], errors[i]});
        }
    }
}

// New nodes on the edges of cells that are not divided: where these did not expect them, an edge runs on into them.
void LightPart::look_beside(std::size_t first_new, std::vector<Rough>& rough) const {
    const std::size_t count = cells_.nodes.size() - first_new;
    std::vector<std::array<Rough, 4>> found(count);
    parallel_chunks(count, 256, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context_->should_stop(); ++i) {
            const LightNode& n = cells_.nodes[first_new + i];
            for (std::size_t k = 0; k < 4; ++k) {
                found[i][k] = beside(n, k);
            }
        }
    });
    for (const auto& four : found) {
        for (const Rough& r : four) {
            if (r.error > allowed(r.cell)) {
                rough.push_back(r);
            }
        }
    }
}
LightPart::Rough LightPart::beside(const LightNode& n, std::size_t quadrant) const {
    const auto cell = cells_.leaf(n.sheet, std::int64_t(n.x) - std::int64_t(quadrant & 1U),
                                  std::int64_t(n.y) - std::int64_t(quadrant >> 1U));
    if (!cell || cell->level >= finest_ || n.state == State::Void) {
        return {};
    }
    const std::uint32_t s = cells_.steps(cell->level), dx = n.x - cell->x, dy = n.y - cell->y;
    if (dx % s == 0 && dy % s == 0) {
        return {}; // its own corner
    }
    if (n.state == State::Covered) {
        return {*cell, edge_metres(*cell) > kCoverEdge && lit_around(*cell) ? 2.0F * allowed(*cell) : 0.0F};
    }
    return {*cell, off(*cell, {luminance(n.irradiance), n.variance, true}, float(dx), float(dy))};
}

} // namespace atrium
