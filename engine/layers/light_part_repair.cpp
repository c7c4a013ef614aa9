// Looking again at the samples of a part of the direct light that a change may reach.
#include "engine/base/parallel.h"
#include "engine/layers/light_part.h"
#include "engine/radiosity/light_shafts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace atrium {
namespace {

using State = LightNode::State;

/// Samples of one repair of a part. Where more are touched, those of the finest level of nodes that has no more stand for
/// the others, of light that costs many rays a smaller number; soft light is looked at on the probes' level in any case.
struct Most {
    std::size_t sharp; ///< where a sample is a few rays
    std::size_t dear;
    std::size_t coarse; ///< of dear and soft light, standing for more
};
constexpr Most kInAHurry{16384, 2048, 512};
constexpr Most kExact{1U << 20, 32768, 16384};

constexpr std::uint32_t kBlocks = 4; // of a tile, each way
constexpr std::size_t kScouted = 4;  // times the samples: from where what moved is looked for in a hurry

const vec3 kUnknownPlace(std::numeric_limits<float>::quiet_NaN());
const vec3 kNoPlace(std::numeric_limits<float>::infinity());

} // namespace

// Where a place lies, by the chart's plane: enough to tell whether a change may reach it.
std::optional<vec3> LightPart::place_of(std::uint32_t sheet, const vec2& steps) const {
    const LightSheet& s = sheets_.sheets()[sheet];
    const vec2 at = steps * metres_per_step(sheet);
    if (s.chart->planar) {
        return s.chart->origin + s.chart->axis_u * at.x + s.chart->axis_v * at.y;
    }
    const auto place = sheets_.locate(sheet, at, std::max(s.chart->scale.x, s.chart->scale.y));
    return place ? std::optional(place->point) : std::nullopt;
}

bool LightPart::may_change(const LightChange& change, std::uint32_t sheet, const vec2& steps, float radius) const {
    if (change.moved[sheets_.sheets()[sheet].surface] != 0 || !part_.touched) {
        return true;
    }
    const auto point = place_of(sheet, steps);
    return point && may_change_at(change, *point, radius);
}

bool LightPart::may_change_at(const LightChange& change, const vec3& point, float radius) const {
    return std::any_of(change.boxes.begin(), change.boxes.end(), [&](const Box3& box) {
        return distance_to(box, point) <= settings_.cover_reach + radius || part_.touched(point, radius, box);
    });
}

// Whether what moved can be met from there, on the way to a source; beside it anything may have happened.
bool LightPart::meets_moved(const LightChange& change, std::uint32_t sheet, const vec3& point) const {
    if (!part_.meets_moved || std::any_of(change.boxes.begin(), change.boxes.end(), [&](const Box3& box) {
            return distance_to(box, point) <= settings_.cover_reach;
        })) {
        return true;
    }
    const LightSheet& s = sheets_.sheets()[sheet];
    const vec3 normal = s.chart->planar ? (s.back ? -s.chart->normal : s.chart->normal) : vec3(0.0F);
    return part_.meets_moved({point, normal}, change.boxes, change.exact);
}

// Where nodes of round charts lie is looked up once, until their surface moves. Called for different nodes at once.
bool LightPart::node_may_change(const LightChange& change, std::uint32_t node) {
    const LightNode& n = cells_.nodes[node];
    const LightSheet& sheet = sheets_.sheets()[n.sheet];
    const vec2 steps(float(n.x), float(n.y));
    const bool moved = change.moved[sheet.surface] != 0 || !part_.touched;
    if (moved && !sheet.chart->planar && !round_places_.empty()) {
        round_places_[node] = kUnknownPlace;
    }
    if (moved) {
        differs_[node] = 1;
        return true;
    }
    std::optional<vec3> place;
    if (sheet.chart->planar) {
        place = place_of(n.sheet, steps);
    } else {
        vec3& known = round_places_[node];
        if (std::isnan(known.x)) {
            known = place_of(n.sheet, steps).value_or(kNoPlace);
        }
        place = known.x < kNoPlace.x ? std::optional(known) : std::nullopt;
    }
    if (!place || !may_change_at(change, *place, 0.0F)) {
        return false;
    }
    // What met something when it was looked at last, and meets nothing now, gets back the light that it had.
    const bool met = meets_moved(change, n.sheet, *place);
    const bool asks = met || differs_[node] != 0 || stale_[node] != 0;
    differs_[node] = met ? 1 : 0;
    return asks;
}

// Round charts bend away from any plane: all of the surface at once.
bool LightPart::may_change_round(const LightChange& change, std::uint32_t surface) const {
    if (change.moved[surface] != 0 || !part_.touched) {
        return true;
    }
    Box3 bounds;
    for (const vec3& p : *sheets_.rays().surfaces()[surface].positions) {
        bounds.add(p);
    }
    const float radius = 0.5F * bounds.diagonal() + settings_.cover_reach;
    return std::any_of(change.boxes.begin(), change.boxes.end(),
                       [&](const Box3& box) { return part_.touched(bounds.centre(), radius, box); });
}

bool LightPart::tile_sees(BoxSight& sight, std::uint32_t sheet, std::uint32_t u, std::uint32_t v) const {
    const Chart& chart = *sheets_.sheets()[sheet].chart;
    const float size = glm::length(chart.scale);
    const auto from = [&](const vec2& on_tile) {
        const auto place = sheets_.locate(sheet, (vec2(float(u), float(v)) + on_tile) * chart.scale, size);
        return place && sight.any({place->point, place->normal}, size);
    };
    constexpr std::array<vec2, 5> kOnTile{{{0.5F, 0.5F}, {0.1F, 0.1F}, {0.9F, 0.9F}, {0.9F, 0.1F}, {0.1F, 0.9F}}};
    return std::any_of(kOnTile.begin(), kOnTile.end(), from);
}

// Per tile over all sheets: in which of its blocks any place may change, by bits, row by row.
std::vector<std::uint16_t> LightPart::blocks_to_look_at(const LightChange& change, BoxSight& sight) {
    struct Tile {
        std::uint32_t sheet, u, v;
    };
    std::vector<Tile> tiles;
    for (std::uint32_t i = 0; i < sheets_.sheets().size(); ++i) {
        const Chart& chart = *sheets_.sheets()[i].chart;
        for (std::uint32_t k = 0; k < chart.tiles_u * chart.tiles_v; ++k) {
            tiles.push_back({i, k % chart.tiles_u, k / chart.tiles_u});
        }
    }
    if (!part_.over.empty() && !over_sight_) {
        over_sight_ = std::make_unique<BoxSight>(sheets_.rays(), tiles.size());
        over_sight_->about(part_.over, false);
    }
    BoxSight* sees = part_.straight ? &sight : change.mirror_moved ? nullptr : over_sight_.get();
    std::vector<std::uint16_t> out(tiles.size(), 0);
    const auto edge = float(cells_.steps_per_tile());
    parallel_chunks(tiles.size(), 16, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const Tile& t = tiles[i];
            const LightSheet& sheet = sheets_.sheets()[t.sheet];
            if (sheet.used[t.v * sheet.chart->tiles_u + t.u] == 0) {
                continue;
            }
            if (!sheet.chart->planar || change.moved[sheet.surface] != 0) {
                out[i] = may_change_round(change, sheet.surface) ? 0xFFFF : 0;
                continue;
            }
            const vec2 corner = vec2(float(t.u), float(t.v)) * edge;
            const float radius = 0.5F * glm::length(sheet.chart->scale);
            const bool blind =
                change.looks_back && sees != nullptr && !sees->sees(i, [&] { return tile_sees(*sees, t.sheet, t.u, t.v); });
            if (blind || !may_change(change, t.sheet, corner + 0.5F * edge, radius)) {
                continue;
            }
            for (std::uint32_t k = 0; k < kBlocks * kBlocks; ++k) {
                const vec2 middle = vec2(float(k % kBlocks) + 0.5F, float(k / kBlocks) + 0.5F) * (edge / kBlocks);
                const bool may = may_change(change, t.sheet, corner + middle, radius / kBlocks);
                out[i] = std::uint16_t(out[i] | (may ? 1U << k : 0U));
            }
        }
    });
    return out;
}

// Soft light costs many rays: of very many nodes those from where what moved looks largest, in order of index. What moved
// sees itself best of all and has half of them at most, or nothing would be left for its surroundings.
void LightPart::keep_most_seen(const LightChange& change, std::size_t most, std::vector<std::uint32_t>& nodes) const {
    if (nodes.size() <= most) {
        return;
    }
    std::vector<std::pair<float, std::uint32_t>> own, around;
    for (const std::uint32_t i : nodes) {
        const LightNode& n = cells_.nodes[i];
        float angle = 0.0F;
        const auto point = place_of(n.sheet, vec2(float(n.x), float(n.y)));
        for (const Box3& box : change.boxes) {
            angle = point ? std::max(angle, box.diagonal() / std::max(glm::length(box.centre() - *point), 1e-3F)) : angle;
        }
        (change.moved[sheets_.sheets()[n.sheet].surface] != 0 ? own : around).emplace_back(-angle, i);
    }
    const std::size_t of_own = std::min(own.size(), std::max(most / 2, most - std::min(most, around.size())));
    nodes.clear();
    for (auto& [seen, count] : {std::pair(&own, of_own), std::pair(&around, std::min(around.size(), most - of_own))}) {
        std::nth_element(seen->begin(), seen->begin() + std::ptrdiff_t(count), seen->end());
        for (std::size_t k = 0; k < count; ++k) {
            nodes.push_back((*seen)[k].second);
        }
    }
    std::sort(nodes.begin(), nodes.end());
}

// Requests for the nodes and probes that a change may reach; the nodes.
std::vector<std::uint32_t> LightPart::ask_again(const LightChange& change, BoxSight& sight) {
    const Most& most = change.exact ? kExact : kInAHurry;
    const std::vector<std::uint16_t> tiles = blocks_to_look_at(change, sight);
    const std::uint32_t coarse = cells_.steps(probe_level_) - 1;
    // Nodes on a common edge belong to the tile or block behind it; what lies before it is asked too.
    const auto on_tile = [&](std::uint32_t sheet, std::uint32_t x, std::uint32_t y) {
        const Chart& chart = *sheets_.sheets()[sheet].chart;
        const unsigned shift = cells_.max_level();
        const std::uint32_t inside = cells_.steps_per_tile() - 1, of_block = std::max((inside + 1) / kBlocks, 1U);
        bool any = false;
        for (std::uint32_t k = 0; k < 4 && !any; ++k) {
            const std::uint32_t dx = k & 1U, dy = k >> 1U;
            if (x >= dx && y >= dy && (x - dx) >> shift < chart.tiles_u && (y - dy) >> shift < chart.tiles_v) {
                const std::uint32_t bits = tiles[cells_.tile_index(sheet, (x - dx) >> shift, (y - dy) >> shift)];
                const std::uint32_t u = ((x - dx) & inside) / of_block, v = ((y - dy) & inside) / of_block;
                any = (bits >> (v * kBlocks + u) & 1U) != 0;
            }
        }
        return any;
    };
    std::vector<std::uint8_t> sheet_may(sheets_.sheets().size(), 0);
    for (std::uint32_t i = 0, tile = 0; i < sheet_may.size(); ++i) {
        for (const std::size_t end = tile + sheets_.sheets()[i].used.size(); tile < end; ++tile) {
            sheet_may[i] |= tiles[tile] != 0 ? 1 : 0;
        }
    }
    stale_.resize(cells_.nodes.size(), 0);
    differs_.resize(cells_.nodes.size(), 1);
    const auto& sheets = sheets_.sheets();
    if (std::any_of(sheets.begin(), sheets.end(), [](const LightSheet& s) { return !s.chart->planar; })) {
        round_places_.resize(cells_.nodes.size(), kUnknownPlace);
    }
    const auto stale = [&](std::size_t i) { return change.exact && stale_[i] != 0; }; // asks, whatever has moved
    std::vector<std::uint8_t> hit(cells_.nodes.size(), 0);
    parallel_chunks(hit.size(), 1024, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context_->should_stop(); ++i) {
            const LightNode& n = cells_.nodes[i];
            const bool may =
                stale(i) || (n.state != State::Void && (differs_[i] != 0 || stale_[i] != 0 ||
                                                        (sheet_may[n.sheet] != 0 && on_tile(n.sheet, n.x, n.y))));
            hit[i] = may && !(part_.soft && ((n.x | n.y) & coarse) != 0) ? 1 : 0;
        }
    });
    std::vector<std::uint32_t> asked;
    for (std::uint32_t i = 0; i < hit.size(); ++i) {
        if (hit[i] != 0) {
            asked.push_back(i);
        }
    }
    repair_level_ = part_.soft ? probe_level_ : cells_.max_level();
    const auto at_most = [&](std::size_t limit) {
        while (asked.size() > limit && repair_level_ > probe_level_) {
            --repair_level_;
            const std::uint32_t between = cells_.steps(repair_level_) - 1;
            std::erase_if(asked, [&](std::uint32_t i) { return ((cells_.nodes[i].x | cells_.nodes[i].y) & between) != 0; });
        }
        keep_most_seen(change, limit, asked);
    };
    const std::size_t limit = part_.sharp ? most.sharp : most.coarse;
    coarse_repair_ = part_.soft;
    if (!change.exact &&
        asked.size() > std::max(limit, kScouted * most.coarse)) { // even to scout from all of them is too much
        at_most(std::max(limit, kScouted * most.coarse));
        coarse_repair_ = true;
    }
    hit.assign(asked.size(), 0);
    parallel_chunks(asked.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t k = begin; k < end && !context_->should_stop(); ++k) {
            hit[k] = stale(asked[k]) || node_may_change(change, asked[k]) ? 1 : 0;
        }
    });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < asked.size(); ++k) {
        if (hit[k] != 0) {
            asked[kept++] = asked[k];
        }
    }
    asked.resize(kept);
    for (const std::uint32_t i : asked) {
        stale_[i] = 1; // until it is really looked at
    }
    coarse_repair_ = coarse_repair_ || asked.size() > (part_.sharp ? most.sharp : most.dear);
    if (coarse_repair_) {
        at_most(limit);
    }
    for (const std::uint32_t i : asked) {
        const LightNode& n = cells_.nodes[i];
        Request r;
        r.sheet = n.sheet;
        r.index = i;
        r.at = vec2(float(n.x), float(n.y)) * metres_per_step(n.sheet);
        r.reach = glm::length(metres_per_step(n.sheet)) * float(cells_.steps(cells_.first_level()));
        requests_.push_back(r);
    }
    if (coarse_repair_) {
        return asked;
    }
    std::vector<std::uint8_t> probe_hit(probes_.size(), 0);
    probe_differs_.resize(probes_.size(), effort_ == Effort::Build ? 0 : 1);
    parallel_chunks(first_probe_.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (auto sheet = std::uint32_t(begin); sheet < end && !context_->should_stop(); ++sheet) {
            const std::size_t last = sheet + 1 < first_probe_.size() ? first_probe_[sheet + 1] : probes_.size();
            for (std::size_t i = first_probe_[sheet]; i < last; ++i) {
                const Probe& probe = probes_[i];
                const bool touched = (probe.seen.known || probe.covered) &&
                                     on_tile(sheet, std::uint32_t(probe.at.x), std::uint32_t(probe.at.y)) &&
                                     may_change(change, sheet, probe.at, 0.0F);
                if (touched) {
                    const auto place = place_of(sheet, probe.at);
                    const bool met =
                        change.moved[sheets_.sheets()[sheet].surface] != 0 || !place || meets_moved(change, sheet, *place);
                    probe_hit[i] = met || probe_differs_[i] != 0 ? 1 : 0;
                    probe_differs_[i] = met ? 1 : 0;
                }
            }
        }
    });
    for (std::uint32_t sheet = 0; sheet < first_probe_.size(); ++sheet) {
        const std::size_t last = sheet + 1 < first_probe_.size() ? first_probe_[sheet + 1] : probes_.size();
        for (std::size_t i = first_probe_[sheet]; i < last; ++i) {
            if (probe_hit[i] != 0) {
                Request r;
                r.sheet = sheet;
                r.index = std::uint32_t(i);
                r.probe = true;
                r.at = probes_[i].at * metres_per_step(sheet);
                r.reach = glm::length(metres_per_step(sheet)) * float(cells_.steps(cells_.first_level()));
                requests_.push_back(r);
            }
        }
    }
    return asked;
}

// What the nodes of repair_level_ say of the change, the finer ones between them follow.
void LightPart::spread_change(const std::vector<std::uint32_t>& asked, const std::vector<LightNode>& before) {
    std::vector<std::uint32_t> place(cells_.nodes.size(), LightCells::kNone); // of a node in `asked`
    for (std::uint32_t k = 0; k < asked.size(); ++k) {
        place[asked[k]] = k;
    }
    const auto difference = [&](std::uint32_t n) {
        if (n == LightCells::kNone || place[n] == LightCells::kNone || !cells_.nodes[n].known() ||
            !before[place[n]].known()) {
            return Rgb(0.0F);
        }
        return cells_.nodes[n].irradiance - before[place[n]].irradiance;
    };
    const std::uint32_t finest = cells_.steps(repair_level_) - 1;
    std::vector<std::uint8_t> changed(sheets_.sheets().size(), 0);
    for (const std::uint32_t i : asked) {
        changed[cells_.nodes[i].sheet] |= difference(i) != Rgb(0.0F) ? 1 : 0;
    }
    parallel_chunks(cells_.nodes.size(), 1024, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context_->should_stop(); ++i) {
            LightNode& n = cells_.nodes[i];
            if (changed[n.sheet] == 0 || ((n.x | n.y) & finest) == 0 || !n.known()) {
                continue;
            }
            // The smallest cell of the coarse levels around it that was ever there.
            for (unsigned level = repair_level_;; --level) {
                const std::uint32_t s = cells_.steps(level);
                const LightCell cell{n.sheet, n.x & ~(s - 1), n.y & ~(s - 1), level};
                const auto corner = cells_.corners(cell);
                if (level > cells_.first_level() &&
                    std::find(corner.begin(), corner.end(), LightCells::kNone) != corner.end()) {
                    continue;
                }
                const float fx = float(n.x - cell.x) / float(s), fy = float(n.y - cell.y) / float(s);
                const Rgb d = (difference(corner[0]) * (1.0F - fx) + difference(corner[1]) * fx) * (1.0F - fy) +
                              (difference(corner[2]) * (1.0F - fx) + difference(corner[3]) * fx) * fy;
                if (d != Rgb(0.0F)) {
                    n.irradiance = glm::max(n.irradiance + d, Rgb(0.0F));
                    differs_[i] = 1;
                    stale_[i] = part_.soft ? 0 : 1; // steps of soft light add up to what the coarse nodes came to
                }
                break;
            }
        }
    });
}

// The undivided cells that meet at nodes, each once.
std::vector<LightCell> LightPart::cells_around(const std::vector<std::uint32_t>& changed) const {
    std::vector<LightCell> out;
    for (const std::uint32_t i : changed) {
        const LightNode& n = cells_.nodes[i];
        for (std::int64_t k = 0; k < 4; ++k) {
            if (const auto cell = cells_.leaf(n.sheet, std::int64_t(n.x) - (k & 1), std::int64_t(n.y) - (k >> 1))) {
                out.push_back(*cell);
            }
        }
    }
    const auto key = [](const LightCell& c) { return std::tuple(c.sheet, c.y, c.x, c.level); };
    std::sort(out.begin(), out.end(), [&](const LightCell& a, const LightCell& b) { return key(a) < key(b); });
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

// Whole tiles and their halves are too coarse for light beside what comes to stand there: their nodes take what was
// interpolated, and are then looked at like all others.
void LightPart::divide_around(const LightChange& change) {
    const auto close_to = [&](const LightCell& c) {
        const float half = 0.5F * float(cells_.steps(c.level));
        const auto middle = place_of(c.sheet, vec2(float(c.x), float(c.y)) + half);
        const float close = 1.5F * edge_metres(c);
        return middle && std::any_of(change.boxes.begin(), change.boxes.end(),
                                     [&](const Box3& box) { return distance_to(box, *middle) < close; });
    };
    std::vector<LightCell> leaves;
    for (std::uint32_t sheet = 0; sheet < sheets_.sheets().size(); ++sheet) {
        const LightSheet& of = sheets_.sheets()[sheet];
        for (std::uint32_t tile = 0; tile < of.used.size() && of.chart->planar; ++tile) {
            const std::uint32_t u = tile % of.chart->tiles_u, v = tile / of.chart->tiles_u;
            const LightCell whole{sheet, u << cells_.max_level(), v << cells_.max_level(), 0};
            if (of.used[tile] == 0 || !close_to(whole)) {
                continue;
            }
            cells_.leaves(sheet, u, v, leaves);
            for (std::size_t i = 0; i < leaves.size(); ++i) {
                if (leaves[i].level < probe_level_ && close_to(leaves[i])) {
                    const auto quarters = divide_smoothly(leaves[i]);
                    leaves.insert(leaves.end(), quarters.begin(), quarters.end());
                }
            }
        }
    }
    asked_ = sampled_ = cells_.nodes.size();
}

// Divides a cell; its new nodes have what its known corners showed where they are.
std::array<LightCell, 4> LightPart::divide_smoothly(const LightCell& cell) {
    const auto corner = cells_.corners(cell);
    std::array<LightNode, 4> at;
    for (std::size_t k = 0; k < 4; ++k) {
        at[k] = cells_.nodes[corner[k]];
    }
    const std::size_t first_new = cells_.nodes.size();
    const auto quarters = cells_.split(cell);
    const auto edge = float(cells_.steps(cell.level));
    for (std::size_t i = first_new; i < cells_.nodes.size(); ++i) {
        LightNode& n = cells_.nodes[i];
        const float fx = float(n.x - cell.x) / edge, fy = float(n.y - cell.y) / edge;
        const std::array<float, 4> w{(1.0F - fx) * (1.0F - fy), fx * (1.0F - fy), (1.0F - fx) * fy, fx * fy};
        float known = 0.0F;
        n.state = at[0].state;
        for (std::size_t k = 0; k < 4; ++k) {
            if (at[k].known() && w[k] > 0.0F) {
                n.irradiance += w[k] * at[k].irradiance;
                n.variance += w[k] * at[k].variance;
                n.state = State::Known;
                known += w[k];
            }
        }
        n.irradiance /= std::max(known, 1e-6F);
        n.variance /= std::max(known, 1e-6F);
    }
    return quarters;
}

bool LightPart::repair(const LightChange& change, BoxSight& sight, std::span<const LightPart* const> all,
                       const RunContext& context, std::vector<std::uint8_t>& changed_sheets) {
    context_ = &context;
    repairing_ = true;
    judged_by_ = change.exact ? std::span<const LightPart* const>(before_) : all;
    if (change.boxes.empty() && !change.exact) {
        return true;
    }
    if (differs_.empty()) { // the first repair
        differs_.assign(cells_.nodes.size(), effort_ == Effort::Build ? 0 : 1);
    }
    if (part_.soft && cells_.first_level() < probe_level_) {
        divide_around(change);
    }
    const std::vector<std::uint32_t> asked = ask_again(change, sight);
    std::vector<LightNode> before;
    before.reserve(asked.size());
    for (const std::uint32_t i : asked) {
        before.push_back(cells_.nodes[i]);
    }
    bool going_on = sample(0.0, 0.0);
    for (const std::uint32_t i : asked) {
        stale_[i] = !going_on || !change.exact ? 1 : 0; // stopped: nobody knows which were looked at
    }
    std::vector<std::uint32_t> changed;
    for (std::size_t k = 0; k < asked.size(); ++k) {
        const LightNode& now = cells_.nodes[asked[k]];
        if (now.irradiance != before[k].irradiance || now.state != before[k].state) {
            changed.push_back(asked[k]);
            changed_sheets[now.sheet] = 1;
        }
    }
    if (coarse_repair_) {
        if (going_on && !changed.empty()) {
            spread_change(asked, before);
        }
        return going_on;
    }
    std::vector<LightCell> fresh = cells_around(changed);
    std::vector<Rough> rough;
    while (going_on && !(fresh.empty() && rough.empty())) {
        examine(fresh, rough);
        fresh = divide(rough);
        rough.clear();
        const std::size_t first_new = sampled_;
        going_on = sample(0.0, 0.0);
        look_beside(first_new, rough);
    }
    return going_on;
}

std::size_t LightPart::memory_bytes() const {
    return cells_.memory_bytes() + probes_.size() * sizeof(Probe) + first_probe_.size() * sizeof(std::size_t) +
           round_places_.size() * sizeof(vec3) + stale_.size() + differs_.size() + probe_differs_.size();
}

} // namespace atrium
