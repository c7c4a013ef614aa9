#include "engine/layers/light_part.h"

#include "engine/base/parallel.h"
#include "engine/layers/covered_points.h"

#include <algorithm>
#include <cmath>

namespace atrium {
namespace {

using State = LightNode::State;

constexpr std::size_t kGrain = 32;

} // namespace

LightPart::LightPart(const LightSheets& sheets, const DirectPart& part, std::vector<const LightPart*> before,
                     const std::vector<LightCell>& near, const DirectMapSettings& settings, TileBudget& budget,
                     const RunContext& context, Effort effort)
    : sheets_(sheets), part_(part), before_(std::move(before)), near_(near), settings_(settings), budget_(budget),
      context_(&context), effort_(effort),
      finest_(part.soft || effort == Effort::Hurried
                  ? std::max(settings.first_level, settings.max_level - std::min(settings.max_level, 2U))
                  : settings.max_level),
      probe_level_(std::min(settings.first_level, settings.max_level)),
      cells_(part.soft || effort != Effort::Build ? 0 : settings.first_level, settings.max_level) {
    judged_by_ = before_;
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
        if (probes(c)) {
            ask_for_probe(c);
        }
    }
    return fresh;
}

// Whether a first cell is probed: where tiles start whole, large cells are those of soft light, or those without light.
bool LightPart::probes(const LightCell& c) const {
    switch (effort_) {
    case Effort::Build: return !part_.soft || c.level < probe_level_;
    case Effort::Anew: return c.level == probe_level_;
    case Effort::Hurried: break;
    }
    return false;
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
            const bool hidden = is_out_of_sight(sheets_.rays(), place->point, place->normal, settings_.cover_reach);
            state = hidden ? State::Covered : State::Known;
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
    for (const LightPart* other : before_) {
        const LightPart& part = *other;
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
