#include "engine/layers/light_part.h"

#include "engine/base/parallel.h"
#include "engine/layers/covered_points.h"

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
constexpr std::size_t kGrain = 32;

} // namespace

LightPart::LightPart(const LightSheets& sheets, const DirectPart& part, const std::vector<LightPart>& before,
                     const std::vector<LightCell>& near, const DirectMapSettings& settings, TileBudget& budget,
                     const RunContext& context)
    : sheets_(sheets), part_(part), before_(before), near_(near), settings_(settings), budget_(budget), context_(&context),
      finest_(part.soft ? std::max(settings.first_level, settings.max_level - std::min(settings.max_level, 2U))
                        : settings.max_level),
      probe_level_(std::min(settings.first_level, settings.max_level)),
      cells_(part.soft ? 0 : settings.first_level, settings.max_level) {
    for (const LightSheet& s : sheets.sheets()) {
        cells_.add_sheet(s.chart->tiles_u, s.chart->tiles_v, s.used);
        first_probe_.push_back(probes_.size());
        probes_.resize(probes_.size() + (s.used.size() << (2 * probe_level_)));
    }
}

bool LightPart::run(double from, double to) {
    std::vector<LightCell> fresh = first_cells();
    double at = from + 0.5 * (to - from);
    bool going_on = sample(from, at);
    find_floors();
    leave_out_dark_sheets(fresh);
    std::vector<Rough> rough;
    while (going_on && !(fresh.empty() && rough.empty())) {
        examine(fresh, rough);
        fresh = divide(rough);
        rough.clear();
        const std::size_t first_new = sampled_;
        const double next = at + 0.3 * (to - at); // how many rounds there will be nobody knows
        going_on = sample(at, next);
        at = next;
        look_beside(first_new, rough);
    }
    return going_on;
}

// A room with a night light beside a sunlit one: what is dark there would not be seen here.
void LightPart::find_floors() {
    constexpr float kOfBrightest = 0.2F;
    floor_.assign(sheets_.sheets().size(), 0.0F);
    for (const LightNode& n : cells_.nodes) {
        floor_[n.sheet] = std::max(floor_[n.sheet], luminance(n.irradiance));
    }
    for (float& floor : floor_) {
        floor = std::min(settings_.light_floor, kOfBrightest * floor);
    }
}

// Where no sample on a whole sheet is lit there is no edge to look for.
void LightPart::leave_out_dark_sheets(std::vector<LightCell>& fresh) const {
    std::vector<std::uint8_t> lit(sheets_.sheets().size(), 0);
    for (const LightNode& n : cells_.nodes) {
        lit[n.sheet] |= max_component(n.irradiance) > 0.0F ? 1 : 0;
    }
    for (const LightCell& c : fresh) {
        for_probes(c, [&](const Probe& p, const vec2&) { lit[c.sheet] |= p.seen.light > 0.0F ? 1 : 0; });
    }
    std::erase_if(fresh, [&](const LightCell& c) { return lit[c.sheet] == 0; });
}

std::size_t LightPart::evaluations() const {
    const auto sampled = [](const LightNode& n) { return n.state != State::Void; };
    std::size_t count = std::size_t(std::count_if(cells_.nodes.begin(), cells_.nodes.end(), sampled));
    for (const Probe& p : probes_) {
        count += p.seen.known || p.covered ? 1 : 0;
    }
    return count;
}

// ---- where to sample

std::vector<LightCell> LightPart::first_cells() {
    std::vector<LightCell> fresh;
    const unsigned level = cells_.first_level();
    const std::uint32_t s = cells_.steps(level), n = 1U << level;
    for (std::uint32_t i = 0; i < sheets_.sheets().size() && !context_->should_stop(); ++i) {
        const LightSheet& sheet = sheets_.sheets()[i];
        for (std::uint32_t tile = 0; tile < sheet.used.size(); ++tile) {
            if (sheet.used[tile] == 0) {
                continue;
            }
            const std::uint32_t x = tile % sheet.chart->tiles_u * n * s, y = tile / sheet.chart->tiles_u * n * s;
            for (std::uint32_t k = 0; k < (n + 1) * (n + 1); ++k) {
                cells_.find_or_add(i, x + k % (n + 1) * s, y + k / (n + 1) * s);
            }
            ask_for_nodes(level);
            for (std::uint32_t k = 0; k < n * n; ++k) {
                fresh.push_back({i, x + k % n * s, y + k / n * s, level});
            }
        }
    }
    if (level < probe_level_) {
        divide_near_things(fresh);
    }
    for (const LightCell& c : fresh) {
        if (!part_.soft || c.level < probe_level_) {
            ask_for_probe(c);
        }
    }
    return fresh;
}

// Replaces whole tiles by their parts where things stand close.
void LightPart::divide_near_things(std::vector<LightCell>& fresh) {
    for (const LightCell& c : near_) {
        cells_.split(c);
        ask_for_nodes(c.level + 1);
    }
    std::vector<LightCell> leaves;
    std::vector<LightCell> out;
    for (const LightCell& tile : fresh) {
        cells_.leaves(tile.sheet, tile.x >> cells_.max_level(), tile.y >> cells_.max_level(), leaves);
        out.insert(out.end(), leaves.begin(), leaves.end());
    }
    fresh.swap(out);
}

vec2 LightPart::metres_per_step(std::uint32_t sheet) const {
    return sheets_.sheets()[sheet].chart->scale / float(cells_.steps_per_tile());
}

float LightPart::edge_metres(const LightCell& cell) const {
    const vec2 step = metres_per_step(cell.sheet);
    return float(cells_.steps(cell.level)) * std::max(step.x, step.y);
}

std::size_t LightPart::probe_index(std::uint32_t sheet, std::uint32_t x, std::uint32_t y) const {
    const std::uint32_t edge = cells_.steps(probe_level_);
    const std::size_t row = std::size_t(sheets_.sheets()[sheet].chart->tiles_u) << probe_level_;
    return first_probe_[sheet] + y / edge * row + x / edge;
}

template <class Visit> void LightPart::for_probes(const LightCell& c, const Visit& visit) const {
    const std::uint32_t s = cells_.steps(c.level), edge = cells_.steps(probe_level_);
    for (std::uint32_t y = c.y; y < c.y + s; y += edge) {
        for (std::uint32_t x = c.x; x < c.x + s; x += edge) {
            const Probe& probe = probes_[probe_index(c.sheet, x, y)];
            const vec2 at = probe.at - vec2(float(c.x), float(c.y));
            if (at.x >= 0.0F && at.y >= 0.0F && at.x < float(s) && at.y < float(s)) {
                visit(probe, at);
            }
        }
    }
}

// Nodes that were added since the last call; `level` is that of the cells they were added for.
void LightPart::ask_for_nodes(unsigned level) {
    for (; asked_ < cells_.nodes.size(); ++asked_) {
        const LightNode& n = cells_.nodes[asked_];
        const vec2 step = metres_per_step(n.sheet);
        Request r;
        r.sheet = n.sheet;
        r.index = std::uint32_t(asked_);
        r.at = vec2(float(n.x), float(n.y)) * step;
        r.reach = glm::length(step) * float(cells_.steps(level)); // a cell's diagonal
        requests_.push_back(r);
    }
}

// Somewhere in a cell, by a plastic-number lattice: along any row and any column of cells the places
// are spread evenly, so that a streak of light between the nodes is soon met whichever way it runs.
void LightPart::ask_for_probe(const LightCell& c) {
    const auto s = float(cells_.steps(c.level));
    const float i = float(c.x) / s, j = float(c.y) / s;
    const auto fraction = [](double x) { return float(x - std::floor(x)); };
    const vec2 inside(fraction(0.5 + 0.7548776662 * i + 0.6180339887 * j),
                      fraction(0.5 + 0.6180339887 * i + 0.5698402910 * j));
    const vec2 at = vec2(float(c.x), float(c.y)) + inside * s;
    const auto index = std::uint32_t(probe_index(c.sheet, std::uint32_t(at.x), std::uint32_t(at.y)));
    probes_[index].at = at;
    Request r;
    r.sheet = c.sheet;
    r.index = index;
    r.probe = true;
    r.at = probes_[index].at * metres_per_step(c.sheet);
    requests_.push_back(r);
}

// ---- sampling

// Takes the samples asked for; false when asked to stop.
bool LightPart::sample(double from, double to) {
    // In slices, so that progress can be told between parallel loops.
    const std::size_t slice = std::max<std::size_t>(requests_.size() / 20 + 1, 1024);
    for (std::size_t start = 0; start < requests_.size(); start += slice) {
        if (context_->should_stop()) {
            return false;
        }
        const std::size_t end = std::min(start + slice, requests_.size());
        parallel_chunks(end - start, kGrain, [&](std::size_t b, std::size_t e, std::size_t) {
            if (context_->should_stop()) {
                return;
            }
            for (std::size_t i = start + b; i < start + e; ++i) {
                take(requests_[i]);
            }
        });
        context_->progress("direct", from + (to - from) * double(end) / double(requests_.size()));
    }
    taken_ += requests_.size();
    requests_.clear();
    sampled_ = cells_.nodes.size();
    return !context_->should_stop();
}

void LightPart::take(const Request& request) {
    DirectSample light;
    State state = State::Void;
    if (const auto place = sheets_.locate(request.sheet, request.at, request.reach)) {
        // Bright or dark: what shines into the gap under a lamp that lies on a ceiling is not the light of the ceiling.
        state = state_of_other_parts(request);
        if (state == State::Unknown) {
            state = is_covered(sheets_.rays(), place->point, place->normal, settings_.cover_reach) ? State::Covered
                                                                                                   : State::Known;
        }
        light = state == State::Known ? part_.light(place->point, place->normal) : DirectSample{};
    }
    if (request.probe) {
        probes_[request.index].seen = {luminance(light.irradiance), light.variance, state == State::Known};
        probes_[request.index].covered = state == State::Covered;
        return;
    }
    LightNode& node = cells_.nodes[request.index];
    node.irradiance = light.irradiance;
    node.variance = light.variance;
    node.state = state;
}

// Whether a place is covered, from the parts that were sampled there before this one; Unknown where none was.
LightNode::State LightPart::state_of_other_parts(const Request& request) const {
    if (repairing_) {
        return State::Unknown; // they need not have looked again
    }
    for (const LightPart& part : before_) {
        if (request.probe) {
            if (part.probe_level_ == probe_level_ && part.probes_[request.index].at == probes_[request.index].at) {
                const Probe& there = part.probes_[request.index];
                return there.covered ? State::Covered : there.seen.known ? State::Known : State::Unknown;
            }
            continue;
        }
        const LightNode& own = cells_.nodes[request.index];
        const std::uint32_t n = part.cells_.find(own.sheet, own.x, own.y);
        if (n != LightCells::kNone &&
            (part.cells_.nodes[n].state == State::Known || part.cells_.nodes[n].state == State::Covered)) {
            return part.cells_.nodes[n].state;
        }
    }
    return State::Unknown;
}

// ---- which cells are rough

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

// The least light of the parts that are done at a cell's corners, lux.
float LightPart::other_light(const LightCell& c) const {
    const std::int64_t s = cells_.steps(c.level);
    float sum = 0.0F;
    for (const LightPart& part : before_) {
        float least = std::numeric_limits<float>::infinity();
        for (std::int64_t k = 0; k < 4; ++k) {
            const LightGuess g = part.cells_.guess(c.sheet, c.x + (k & 1) * s, c.y + (k >> 1) * s);
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

// ---- dividing

// Divides rough cells as far as the budget goes and asks for the new nodes; returns the new cells.
std::vector<LightCell> LightPart::divide(std::vector<Rough>& rough) {
    const auto place = [&](const LightCell& c) { return std::tuple(cells_.tile_index(c), c.y, c.x); };
    std::stable_sort(rough.begin(), rough.end(), [&](const Rough& a, const Rough& b) {
        const auto pa = place(a.cell), pb = place(b.cell);
        return pa != pb ? pa < pb : a.error > b.error;
    });
    const auto same = [](const Rough& a, const Rough& b) { return a.cell == b.cell; };
    rough.erase(std::unique(rough.begin(), rough.end(), same), rough.end());
    std::vector<TileGrowth> wishes;
    for (const Rough& r : rough) {
        wishes.push_back({cells_.tile_index(r.cell), r.cell.level + 1, r.error});
    }
    budget_.grow(wishes);
    std::vector<LightCell> fresh;
    fresh.reserve(4 * rough.size());
    for (std::size_t i = 0; i < rough.size(); ++i) {
        if (i % 4096 == 0 && context_->should_stop()) {
            break;
        }
        const Rough& r = rough[i];
        const std::uint32_t tile = cells_.tile_index(r.cell);
        if (r.cell.level + 1 > budget_.level(tile)) {
            continue; // a tile grows as a whole, and this one may not
        }
        const auto quarters = cells_.split(r.cell);
        ask_for_nodes(r.cell.level + 1);
        fresh.insert(fresh.end(), quarters.begin(), quarters.end());
    }
    return fresh;
}

} // namespace atrium
