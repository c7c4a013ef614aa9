#include "engine/layers/direct_map_builder.h"

#include "engine/base/checks.h"
#include "engine/base/parallel.h"
#include "engine/layers/chart_lookup.h"
#include "engine/layers/covered_points.h"
#include "engine/layers/light_cells.h"
#include "engine/layers/light_map_assembly.h"

#include <algorithm>
#include <cmath>

namespace atrium {
namespace {

using State = LightNode::State;

// Metres that a sample keeps from the border of its chart: walls that meet there must not hide it. Above the rounding of
// coordinates and the offset of rays, below what an eye sees of a shadow.
constexpr float kPullIn = 0.002F;
// Metres: cells that a covered place and an open one share are divided down to this, since a shadow may begin between them.
constexpr float kCoverEdge = 0.04F;
constexpr std::size_t kGrain = 32;

/// One side of a chart.
struct Sheet {
    std::uint32_t surface = 0;
    bool back = false;
    const Chart* chart = nullptr;
    std::size_t lookup = 0;
    SheetPlace place;
    std::size_t first_probe = 0; ///< one probe per cell of the first level, row by row over the whole sheet
};

/// A sample to take.
struct Request {
    std::uint32_t sheet = 0;
    std::uint32_t index = 0; ///< of its node, or of its probe
    bool probe = false;
    vec2 at{0.0F};      ///< metres along the chart
    float reach = 0.0F; ///< metres: with no triangle within them the place is away from the surface
};

struct Probe {
    vec2 at{0.0F}; ///< steps
    LightGuess seen;
    bool covered = false;
};

/// A cell that ought to be divided, and how far it is off.
struct Rough {
    LightCell cell;
    float error = 0.0F;
};

class DirectMapBuild {
public:
    DirectMapBuild(const RayScene& rays, std::span<const SurfaceCharts> charts, const DirectFunction& direct,
                   const DirectMapSettings& settings, const RunContext& context)
        : rays_(rays), charts_(charts), direct_(direct), settings_(settings), context_(context),
          cells_(settings.first_level, settings.max_level) {}

    DirectMaps run(const std::function<bool(std::uint32_t)>& back_lit, double from, double to) {
        for (std::uint32_t s = 0; s < charts_.size(); ++s) {
            collect(s, back_lit);
        }
        std::vector<LightCell> fresh = first_cells();
        double at = from + 0.5 * (to - from);
        bool going_on = sample(from, at);
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
        return going_on ? finish(to) : DirectMaps{};
    }

private:
    // ---- sheets and their first cells

    void collect(std::uint32_t surface, const std::function<bool(std::uint32_t)>& back_lit) {
        const SurfaceCharts& charts = charts_[surface];
        if (charts.empty()) {
            return;
        }
        const bool back = rays_.surfaces()[surface].back_side && back_lit(surface);
        std::vector<std::vector<std::uint32_t>> members(charts.charts.size());
        for (std::uint32_t t = 0; t < charts.chart_of_triangle.size(); ++t) {
            if (charts.chart_of_triangle[t] != SurfaceCharts::kNone) {
                members[charts.chart_of_triangle[t]].push_back(t);
            }
        }
        for (std::size_t c = 0; c < charts.charts.size(); ++c) {
            const Chart& chart = charts.charts[c];
            lookups_.emplace_back(charts, chart, members[c]);
            const ChartLookup& lookup = lookups_.back();
            std::vector<std::uint8_t> used(std::size_t(chart.tiles_u) * chart.tiles_v);
            for (std::uint32_t v = 0; v < chart.tiles_v; ++v) {
                for (std::uint32_t u = 0; u < chart.tiles_u; ++u) {
                    used[std::size_t(v) * chart.tiles_u + u] = lookup.touches_tile(u, v) ? 1 : 0;
                }
            }
            for (int side = 0; side < (back ? 2 : 1); ++side) {
                Sheet sheet;
                sheet.surface = surface;
                sheet.back = side == 1;
                sheet.chart = &chart;
                sheet.lookup = lookups_.size() - 1;
                sheet.place = {cells_.add_sheet(chart.tiles_u, chart.tiles_v, used), chart.tile_u, chart.tile_v,
                               chart.tiles_u, chart.tiles_v};
                sheet.first_probe = probes_.size();
                probes_.resize(probes_.size() + (used.size() << (2 * cells_.first_level())));
                sheets_.push_back(sheet);
                const std::size_t edge = (std::size_t(1) << cells_.first_level()) + 1;
                samples_ += edge * edge * std::size_t(std::count(used.begin(), used.end(), std::uint8_t(1)));
            }
        }
    }

    std::vector<LightCell> first_cells() {
        std::vector<LightCell> fresh;
        std::vector<LightCell> leaves;
        for (std::uint32_t i = 0; i < sheets_.size(); ++i) {
            const SheetPlace& p = sheets_[i].place;
            for (std::uint32_t v = 0; v < p.tiles_v; ++v) {
                for (std::uint32_t u = 0; u < p.tiles_u; ++u) {
                    cells_.leaves(p.sheet, u, v, leaves);
                    for (const LightCell& c : leaves) {
                        const std::uint32_t s = cells_.steps(c.level);
                        for (std::uint32_t k = 0; k < 4; ++k) {
                            cells_.find_or_add(p.sheet, c.x + (k & 1U) * s, c.y + (k >> 1U) * s);
                        }
                        ask_for_nodes(c.level);
                        ask_for_probe(c);
                        fresh.push_back(c);
                    }
                }
            }
        }
        return fresh;
    }

    [[nodiscard]] vec2 metres_per_step(const Sheet& sheet) const {
        return sheet.chart->scale / float(cells_.steps_per_tile());
    }
    [[nodiscard]] float edge_metres(const LightCell& cell) const {
        const vec2 step = metres_per_step(sheets_[cell.sheet]);
        return float(cells_.steps(cell.level)) * std::max(step.x, step.y);
    }
    [[nodiscard]] std::size_t probe_index(const LightCell& cell) const {
        const Sheet& s = sheets_[cell.sheet];
        const std::uint32_t first = cells_.steps(cells_.first_level());
        return s.first_probe + std::size_t(cell.y / first) * (s.place.tiles_u << cells_.first_level()) + cell.x / first;
    }

    // Nodes that were added since the last call; `level` is that of the cells they were added for.
    void ask_for_nodes(unsigned level) {
        for (; asked_ < cells_.nodes.size(); ++asked_) {
            const LightNode& n = cells_.nodes[asked_];
            const vec2 step = metres_per_step(sheets_[n.sheet]);
            Request r;
            r.sheet = n.sheet;
            r.index = std::uint32_t(asked_);
            r.at = vec2(float(n.x), float(n.y)) * step;
            r.reach = glm::length(step) * float(cells_.steps(level)); // a cell's diagonal
            requests_.push_back(r);
        }
    }

    // Somewhere in a cell of the first level, by a plastic-number lattice: along any row and any column of cells the places
    // are spread evenly, so that a streak of light between the nodes is soon met whichever way it runs.
    void ask_for_probe(const LightCell& c) {
        const auto s = float(cells_.steps(c.level));
        const float i = float(c.x) / s, j = float(c.y) / s;
        const auto fraction = [](double x) { return float(x - std::floor(x)); };
        const vec2 inside(fraction(0.5 + 0.7548776662 * i + 0.6180339887 * j),
                          fraction(0.5 + 0.6180339887 * i + 0.5698402910 * j));
        const auto index = std::uint32_t(probe_index(c));
        probes_[index].at = vec2(float(c.x), float(c.y)) + inside * s;
        Request r;
        r.sheet = c.sheet;
        r.index = index;
        r.probe = true;
        r.at = probes_[index].at * metres_per_step(sheets_[c.sheet]);
        requests_.push_back(r);
    }

    // ---- sampling

    // Takes the samples asked for; false when asked to stop.
    bool sample(double from, double to) {
        // In slices, so that progress can be told between parallel loops.
        const std::size_t slice = std::max<std::size_t>(requests_.size() / 20 + 1, 1024);
        for (std::size_t start = 0; start < requests_.size(); start += slice) {
            if (context_.should_stop()) {
                return false;
            }
            const std::size_t end = std::min(start + slice, requests_.size());
            parallel_chunks(end - start, kGrain, [&](std::size_t b, std::size_t e, std::size_t) {
                if (context_.should_stop()) {
                    return;
                }
                for (std::size_t i = start + b; i < start + e; ++i) {
                    take(requests_[i]);
                }
            });
            context_.progress("direct", from + (to - from) * double(end) / double(requests_.size()));
        }
        requests_.clear();
        sampled_ = cells_.nodes.size();
        return !context_.should_stop();
    }

    void take(const Request& request) {
        const Sheet& sheet = sheets_[request.sheet];
        DirectSample light;
        State state = State::Void;
        vec3 p(0.0F), n(0.0F);
        if (locate(sheet, request, p, n)) {
            light = direct_(p, n);
            const bool dark = luminance(light.irradiance) < settings_.light_floor;
            state = dark && is_covered(rays_, p, n, settings_.cover_reach) ? State::Covered : State::Known;
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

    // Where a sample is taken and the normal of its side; false away from the surface.
    bool locate(const Sheet& sheet, const Request& request, vec3& point, vec3& normal) const {
        const ChartPoint on = lookups_[sheet.lookup].nearest_inside(request.at, request.reach, kPullIn);
        if (!on || on.distance > request.reach) {
            return false;
        }
        const auto corner = rays_.triangle(sheet.surface, on.triangle);
        const vec3 w(1.0F - on.barycentric.x - on.barycentric.y, on.barycentric.x, on.barycentric.y);
        point = corner[0] * w.x + corner[1] * w.y + corner[2] * w.z;
        if (sheet.chart->planar) {
            normal = sheet.back ? -sheet.chart->normal : sheet.chart->normal;
            return true;
        }
        Hit hit;
        hit.surface = sheet.surface;
        hit.triangle = on.triangle;
        hit.geometric_normal = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
        // Files with normals on the wrong side are lit by the side that the winding says.
        const auto side_normal = [&](const vec2& barycentric) {
            hit.barycentric = barycentric;
            const vec3 n = rays_.shading_normal(hit);
            return (glm::dot(n, hit.geometric_normal) < 0.0F) != sheet.back ? -n : n;
        };
        normal = side_normal(on.barycentric);
        // Up from the flat triangle to the round surface that it stands for: its own facets must not shade it.
        const vec2 at_corner[3] = {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}};
        vec3 lift(0.0F);
        for (int k = 0; k < 3; ++k) {
            const vec3 n = side_normal(at_corner[k]);
            lift -= n * (w[k] * std::min(glm::dot(point - corner[std::size_t(k)], n), 0.0F));
        }
        point += lift;
        return true;
    }

    // ---- which cells are rough

    // A difference that the samples' own noise explains is no reason to look closer: it would be noise again.
    [[nodiscard]] float relative(float difference, float variance, float light) const {
        return difference > 2.0F * std::sqrt(variance) ? difference / std::max(light, settings_.light_floor) : 0.0F;
    }

    // Error of linear interpolation from a to b, judged by the nodes before and behind them: half the lesser of the two
    // bends is right for an edge or a kink between a and b, and too much only for smooth curves. The greater one may be
    // another cell's edge.
    [[nodiscard]] float bend(const LightCell& c, const LightGuess& a, const LightGuess& b, int ax, int ay, bool along_u,
                             float light) const {
        const int s = int(cells_.steps(c.level));
        const int dx = along_u ? s : 0, dy = along_u ? 0 : s;
        const LightGuess before = cells_.guess(c.sheet, ax - dx, ay - dy);
        const LightGuess behind = cells_.guess(c.sheet, ax + 2 * dx, ay + 2 * dy);
        const float first = std::abs(before.light - 2.0F * a.light + b.light);
        const float second = std::abs(a.light - 2.0F * b.light + behind.light);
        float least = std::abs(b.light - a.light);
        if (before.known && behind.known) {
            least = std::min(first, second);
        } else if (before.known || behind.known) {
            least = before.known ? first : second;
        }
        return relative(0.3F * least, 0.25F * (a.variance + b.variance), light);
    }

    // How far interpolation in a cell is off, relative to the light; above settings_.contrast it is to be divided.
    [[nodiscard]] float error(const LightCell& c) const {
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
        const Probe& probe = probes_[probe_index(c)];
        const vec2 at = probe.at - vec2(float(c.x), float(c.y));
        const bool probed = at.x >= 0.0F && at.y >= 0.0F && at.x < float(s) && at.y < float(s);
        const bool wide = edge_metres(c) > kCoverEdge;
        float worst = wide && (covered > 0 || (probed && probe.covered)) ? 2.0F * settings_.contrast : 0.0F;
        // Edges of the cell as pairs of corners: two along u, two along v.
        static constexpr std::size_t kEdges[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
        for (std::size_t e = 0; e < 4; ++e) {
            const LightGuess& a = g[kEdges[e][0]];
            const LightGuess& b = g[kEdges[e][1]];
            if (!a.known || !b.known) {
                continue;
            }
            const LightNode& start = cells_.nodes[corner[kEdges[e][0]]];
            worst = std::max(worst, bend(c, a, b, int(start.x), int(start.y), e < 2, light));
            const std::uint32_t middle = cells_.find(c.sheet, start.x + (e < 2 ? s / 2 : 0), start.y + (e < 2 ? 0 : s / 2));
            if (middle != LightCells::kNone && cells_.nodes[middle].known()) {
                const LightNode& m = cells_.nodes[middle];
                const float there = luminance(m.irradiance);
                worst = std::max(worst, relative(std::abs(there - 0.5F * (a.light + b.light)),
                                                 m.variance + 0.25F * (a.variance + b.variance), std::max(light, there)));
            }
        }
        if (probed && probe.seen.known) {
            worst = std::max(worst, off(c, probe.seen, at.x, at.y));
        }
        return worst;
    }

    // How far interpolation in a cell is off what was seen at a place in it (steps from its corner).
    [[nodiscard]] float off(const LightCell& c, const LightGuess& seen, float dx, float dy) const {
        const LightGuess guess = cells_.interpolate(c, dx, dy);
        return guess.known ? relative(std::abs(seen.light - guess.light), seen.variance + guess.variance,
                                      std::max(seen.light, guess.light))
                           : 0.0F;
    }

    // Adds the rough ones among new cells.
    void examine(const std::vector<LightCell>& fresh, std::vector<Rough>& rough) const {
        std::vector<float> errors(fresh.size(), 0.0F);
        parallel_chunks(fresh.size(), 256, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end && !context_.should_stop(); ++i) {
                errors[i] = fresh[i].level < cells_.max_level() ? error(fresh[i]) : 0.0F;
            }
        });
        for (std::size_t i = 0; i < fresh.size(); ++i) {
            if (errors[i] > settings_.contrast) {
                rough.push_back({fresh[i], errors[i]});
            }
        }
    }

    // New nodes on the edges of cells that are not divided: where these did not expect them, an edge runs on into them.
    void look_beside(std::size_t first_new, std::vector<Rough>& rough) const {
        const std::size_t count = cells_.nodes.size() - first_new;
        std::vector<std::array<Rough, 4>> found(count);
        parallel_chunks(count, 256, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end && !context_.should_stop(); ++i) {
                const LightNode& n = cells_.nodes[first_new + i];
                for (std::size_t k = 0; k < 4; ++k) {
                    found[i][k] = beside(n, k);
                }
            }
        });
        for (const auto& four : found) {
            for (const Rough& r : four) {
                if (r.error > settings_.contrast) {
                    rough.push_back(r);
                }
            }
        }
    }
    [[nodiscard]] Rough beside(const LightNode& n, std::size_t quadrant) const {
        const auto cell = cells_.leaf(n.sheet, std::int64_t(n.x) - std::int64_t(quadrant & 1U),
                                      std::int64_t(n.y) - std::int64_t(quadrant >> 1U));
        if (!cell || cell->level >= cells_.max_level() || n.state == State::Void) {
            return {};
        }
        const std::uint32_t s = cells_.steps(cell->level), dx = n.x - cell->x, dy = n.y - cell->y;
        if (dx % s == 0 && dy % s == 0) {
            return {}; // its own corner
        }
        if (n.state == State::Covered) {
            return {*cell, edge_metres(*cell) > kCoverEdge ? 2.0F * settings_.contrast : 0.0F};
        }
        return {*cell, off(*cell, {luminance(n.irradiance), n.variance, true}, float(dx), float(dy))};
    }

    // ---- dividing

    // Divides rough cells as far as the budget goes and asks for the new nodes; returns the new cells.
    std::vector<LightCell> divide(std::vector<Rough>& rough) {
        const auto place = [](const LightCell& c) { return std::tuple(c.sheet, c.y, c.x); };
        const auto tile = [&](const Rough& r) { return cells_.tile_index(r.cell); };
        std::stable_sort(rough.begin(), rough.end(), [&](const Rough& a, const Rough& b) {
            const std::uint32_t ta = tile(a), tb = tile(b);
            return ta != tb ? ta < tb : (place(a.cell) != place(b.cell) ? place(a.cell) < place(b.cell) : a.error > b.error);
        });
        rough.erase(std::unique(rough.begin(), rough.end(), [](const Rough& a, const Rough& b) { return a.cell == b.cell; }),
                    rough.end());
        keep_to_budget(rough);
        std::vector<LightCell> fresh;
        fresh.reserve(4 * rough.size());
        for (const Rough& r : rough) {
            const auto quarters = cells_.split(r.cell);
            ask_for_nodes(r.cell.level + 1);
            fresh.insert(fresh.end(), quarters.begin(), quarters.end());
        }
        return fresh;
    }

    // A tile grows as a whole: cells whose tile would have to, and may not, are left out; strongest contrasts first.
    void keep_to_budget(std::vector<Rough>& rough) {
        struct Growth {
            std::uint32_t tile;
            std::uint32_t level; ///< the highest asked for
            float error;
        };
        std::vector<Growth> growths;
        for (const Rough& r : rough) {
            const std::uint32_t tile = cells_.tile_index(r.cell);
            if (r.cell.level + 1 <= cells_.tile_level(tile)) {
                continue;
            }
            if (growths.empty() || growths.back().tile != tile) {
                growths.push_back({tile, 0, 0.0F});
            }
            growths.back().level = std::max(growths.back().level, r.cell.level + 1);
            growths.back().error = std::max(growths.back().error, r.error);
        }
        const auto texels = [](std::uint32_t level) {
            const std::size_t edge = (std::size_t(1) << level) + 1;
            return edge * edge;
        };
        std::size_t more = 0;
        for (const Growth& g : growths) {
            more += texels(g.level) - texels(cells_.tile_level(g.tile));
        }
        if (samples_ + more <= settings_.max_samples) {
            samples_ += more;
            return;
        }
        std::stable_sort(growths.begin(), growths.end(), [](const Growth& a, const Growth& b) { return a.error > b.error; });
        std::vector<std::uint32_t> refused;
        for (const Growth& g : growths) {
            const std::size_t grown = texels(g.level) - texels(cells_.tile_level(g.tile));
            if (samples_ + grown <= settings_.max_samples) {
                samples_ += grown;
            } else {
                refused.push_back(g.tile);
            }
        }
        std::sort(refused.begin(), refused.end());
        std::erase_if(rough, [&](const Rough& r) {
            const std::uint32_t tile = cells_.tile_index(r.cell);
            return r.cell.level + 1 > cells_.tile_level(tile) && std::binary_search(refused.begin(), refused.end(), tile);
        });
        std::vector<std::uint32_t> all;
        std::set_union(limited_.begin(), limited_.end(), refused.begin(), refused.end(), std::back_inserter(all));
        limited_.swap(all);
    }

    // ---- the result

    // Area-weighted RMS of the relative standard errors of the samples.
    [[nodiscard]] double standard_error(const std::vector<SheetPlace>& places) const {
        double sum = 0.0, area_sum = 0.0;
        std::vector<LightCell> leaves;
        for (const SheetPlace& p : places) {
            for (std::uint32_t v = 0; v < p.tiles_v; ++v) {
                for (std::uint32_t u = 0; u < p.tiles_u; ++u) {
                    cells_.leaves(p.sheet, u, v, leaves);
                    for (const LightCell& c : leaves) {
                        const vec2 edge = metres_per_step(sheets_[c.sheet]) * float(cells_.steps(c.level));
                        for (const std::uint32_t n : cells_.corners(c)) {
                            const LightNode& node = cells_.nodes[n];
                            if (node.known()) {
                                const double level = double(luminance(node.irradiance)) + settings_.light_floor;
                                const double area = 0.25 * double(edge.x) * edge.y;
                                sum += level > 0.0 ? area * node.variance / (level * level) : 0.0;
                                area_sum += area;
                            }
                        }
                    }
                }
            }
        }
        return area_sum > 0.0 ? std::sqrt(sum / area_sum) : 0.0;
    }

    DirectMaps finish(double to) {
        DirectMaps out;
        out.front.resize(rays_.surfaces().size());
        out.back.resize(rays_.surfaces().size());
        out.evaluations = cells_.nodes.size();
        for (const Probe& p : probes_) {
            out.evaluations += p.seen.known || p.covered ? 1 : 0;
        }
        out.evaluations -= std::size_t(std::count_if(cells_.nodes.begin(), cells_.nodes.end(),
                                                     [](const LightNode& n) { return n.state == State::Void; }));
        out.limited_tiles = limited_.size();
        std::vector<std::uint8_t> lit(sheets_.size(), 0);
        for (const LightNode& n : cells_.nodes) {
            lit[n.sheet] |= max_component(n.irradiance) > 0.0F ? 1 : 0;
        }
        std::vector<SheetPlace> places;
        for (const Sheet& s : sheets_) {
            places.push_back(s.place);
        }
        out.error_estimate = standard_error(places);
        fill_unknown_nodes(cells_, places);
        for (std::uint32_t s = 0; s < charts_.size(); ++s) {
            for (const bool back : {false, true}) {
                std::vector<SheetPlace> side;
                bool any = false;
                for (std::size_t i = first_sheet(s); i < sheets_.size() && sheets_[i].surface == s; ++i) {
                    if (sheets_[i].back == back) {
                        side.push_back(sheets_[i].place);
                        any = any || lit[i] != 0;
                    }
                }
                if (any) {
                    auto map = std::make_shared<LightMap>(
                        assemble_light_map(cells_, side, charts_[s].width, charts_[s].height, context_));
                    for (const LightMap::Tile& t : map->tiles) {
                        const std::size_t edge = (std::size_t(1) << t.level) + 1;
                        out.samples += t.used != 0 ? edge * edge : 0;
                    }
                    (back ? out.back : out.front)[s] = std::move(map);
                }
            }
        }
        out.complete = !context_.should_stop();
        context_.progress("direct", to);
        return out.complete ? out : DirectMaps{};
    }
    [[nodiscard]] std::size_t first_sheet(std::uint32_t surface) const {
        return std::size_t(std::lower_bound(sheets_.begin(), sheets_.end(), surface,
                                            [](const Sheet& s, std::uint32_t wanted) { return s.surface < wanted; }) -
                           sheets_.begin());
    }

    const RayScene& rays_;
    std::span<const SurfaceCharts> charts_;
    const DirectFunction& direct_;
    const DirectMapSettings& settings_;
    const RunContext& context_;
    std::vector<Sheet> sheets_; ///< by surface
    std::vector<ChartLookup> lookups_;
    LightCells cells_;
    std::vector<Probe> probes_;
    std::vector<Request> requests_;
    std::size_t asked_ = 0;   ///< nodes that were asked for
    std::size_t sampled_ = 0; ///< nodes that were sampled
    std::size_t samples_ = 0; ///< texels of all tiles at their present levels
    std::vector<std::uint32_t> limited_;
};

} // namespace

std::size_t DirectMaps::memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto* side : {&front, &back}) {
        for (const auto& map : *side) {
            bytes += map ? map->memory_bytes() : 0;
        }
    }
    return bytes;
}

DirectMaps build_direct_maps(const RayScene& rays, std::span<const SurfaceCharts> charts, const DirectFunction& direct,
                             const std::function<bool(std::uint32_t)>& back_lit, const DirectMapSettings& settings,
                             const RunContext& context, double progress_from, double progress_to) {
    ATRIUM_CHECK(charts.size() == rays.surfaces().size());
    return DirectMapBuild(rays, charts, direct, settings, context).run(back_lit, progress_from, progress_to);
}

} // namespace atrium
