#include "engine/layers/direct_map_builder.h"

#include "engine/base/checks.h"
#include "engine/base/parallel.h"
#include "engine/layers/light_map_assembly.h"
#include "engine/layers/light_part.h"
#include "engine/layers/lit_tiles.h"
#include "engine/layers/near_things.h"

#include <algorithm>
#include <cmath>

namespace atrium {
namespace {

// Of a part that is looked at anew in a hurry.
constexpr std::size_t kMostSamples = 40'000;     // on the first grid
constexpr std::size_t kMostFineTexels = 300'000; // beyond it

// Sums over a part's cells, for the area-weighted mean of the relative variances of its samples.
struct ErrorSum {
    double weighted = 0.0;
    double area = 0.0;

    void add(const LightPart& part, const LightSheets& sheets, float floor) {
        const LightCells& cells = part.cells();
        std::vector<LightCell> leaves;
        for (std::uint32_t i = 0; i < sheets.sheets().size(); ++i) {
            const Chart& chart = *sheets.sheets()[i].chart;
            const vec2 step = chart.scale / float(cells.steps_per_tile());
            for (std::uint32_t tile = 0; tile < chart.tiles_u * chart.tiles_v; ++tile) {
                cells.leaves(i, tile % chart.tiles_u, tile / chart.tiles_u, leaves);
                for (const LightCell& c : leaves) {
                    const double edge = cells.steps(c.level);
                    for (const std::uint32_t n : cells.corners(c)) {
                        const LightNode& node = cells.nodes[n];
                        const double level = double(luminance(node.irradiance)) + floor;
                        if (node.known() && level > 0.0) {
                            const double quarter = 0.25 * edge * edge * double(step.x) * step.y;
                            weighted += quarter * node.variance / (level * level);
                            area += quarter;
                        }
                    }
                }
            }
        }
    }
};

} // namespace

struct LiveDirectMaps::Impl {
    Impl(const RayScene& rays, std::span<const SurfaceCharts> charts, std::vector<DirectPart> lights,
         const std::function<bool(std::uint32_t)>& back_lit, const DirectMapSettings& settings, const RunContext& context)
        : charts_(charts), sheets_(rays, charts, back_lit, context), settings_(settings), context_(&context),
          budget_(settings.max_samples) {
        for (DirectPart& part : lights) {
            lights_.push_back(std::make_unique<DirectPart>(std::move(part)));
        }
        for (const LightSheet& s : sheets_.sheets()) {
            const Chart& c = *s.chart;
            places_.push_back({std::uint32_t(places_.size()), c.tile_u, c.tile_v, c.tiles_u, c.tiles_v});
            for (const std::uint8_t used : s.used) {
                budget_.add_tile(std::min(settings.first_level, settings.max_level), used != 0);
            }
        }
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    DirectMaps build(double from, double to) {
        const bool soft = std::any_of(lights_.begin(), lights_.end(), [](const auto& p) { return p->soft; });
        if (soft && settings_.first_level > 0) {
            near_ = cells_near_things(sheets_, std::min(settings_.first_level, settings_.max_level), settings_.max_level,
                                      *context_);
        }
        for (std::size_t i = 0; i < lights_.size(); ++i) {
            std::vector<const LightPart*> before;
            for (const auto& part : parts_) {
                before.push_back(part.get());
            }
            auto part = std::make_unique<LightPart>(sheets_, *lights_[i], before, near_, settings_, budget_, *context_);
            const double step = (to - from) / double(lights_.size());
            if (!part->run(from + step * double(i), from + step * double(i + 1))) {
                return {};
            }
            parts_.push_back(std::move(part));
        }
        return finish(to);
    }

    RepairReport repair(const LightChange& change, DirectMaps& maps, const RunContext& context) {
        context_ = &context;
        RepairReport out;
        changed_.resize(sheets_.sheets().size(), 0);
        std::vector<const LightPart*> all;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (i != change.anew) { // which may be empty
                all.push_back(parts_[i].get());
            }
        }
        if (!sight_) {
            std::size_t tiles = 0;
            for (const LightSheet& s : sheets_.sheets()) {
                tiles += s.used.size();
            }
            sight_ = std::make_unique<BoxSight>(sheets_.rays(), tiles);
        }
        sight_->about(change.boxes, !change.exact);
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const std::size_t before = i == change.anew ? 0 : parts_[i]->samples_taken();
            if (i == change.anew ? !look_anew(i, change.exact)
                                 : !parts_[i]->repair(change, *sight_, all, context, changed_)) {
                return out;
            }
            out.samples += parts_[i]->samples_taken() - before;
        }
        std::vector<std::uint8_t> of_surface(charts_.size(), 0);
        for (std::size_t i = 0; i < changed_.size(); ++i) {
            of_surface[sheets_.sheets()[i].surface] |= changed_[i];
        }
        assemble([&](std::uint32_t surface) { return of_surface[surface] != 0; }, maps);
        for (std::uint32_t s = 0; s < of_surface.size(); ++s) {
            if (of_surface[s] != 0) {
                out.surfaces.push_back(s);
            }
        }
        out.complete = !context.should_stop();
        if (out.complete) {
            changed_.clear();
        }
        return out;
    }

    std::optional<SourceLight> light_of(std::span<const PartSource> source, const Rgb& brightness,
                                        const RunContext& context) {
        SourceLight out;
        out.front.resize(charts_.size());
        out.back.resize(charts_.size());
        for (const PartSource& in : source) {
            out.nodes.emplace_back(in.part, parts_[in.part]->light_of(in.light, brightness, context));
            if (context.should_stop()) {
                return std::nullopt;
            }
        }
        // Its light in the place of all light, for as long as the maps of it are put together.
        std::vector<LightCells*> cells;
        std::vector<std::vector<Rgb>> before;
        for (const auto& [part, light] : out.nodes) {
            std::vector<LightNode>& nodes = parts_[part]->cells().nodes;
            cells.push_back(&parts_[part]->cells());
            std::vector<Rgb>& kept = before.emplace_back(nodes.size());
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                kept[i] = nodes[i].irradiance;
                nodes[i].irradiance = light[i];
            }
        }
        context_ = &context;
        assemble([](std::uint32_t) { return true; }, cells, out.front, out.back);
        for (std::size_t k = 0; k < cells.size(); ++k) {
            for (std::size_t i = 0; i < before[k].size(); ++i) {
                cells[k]->nodes[i].irradiance = before[k][i];
            }
        }
        return context.should_stop() ? std::nullopt : std::optional(std::move(out));
    }

    void add_light(const SourceLight& source, const Rgb& change) {
        for (const auto& [part, light] : source.nodes) {
            parts_[part]->add_light(light, change);
        }
    }

    bool take_out(std::span<const LeavingLight> leaving, const RunContext& context) {
        std::vector<std::vector<Rgb>> light;
        for (const LeavingLight& l : leaving) {
            light.push_back(parts_[l.part]->all_light_of(l.light, context));
        }
        if (context.should_stop()) {
            return false;
        }
        changed_.resize(sheets_.sheets().size(), 0);
        for (std::size_t k = 0; k < light.size(); ++k) {
            LightPart& part = *parts_[leaving[k].part];
            mark_lit(part.cells(), light[k]);
            part.add_light(light[k], Rgb(-1.0F));
        }
        return true;
    }

    std::size_t add_part(DirectPart part, const RunContext& context) {
        lights_.push_back(std::make_unique<DirectPart>(std::move(part)));
        parts_.push_back(std::make_unique<LightPart>(sheets_, *lights_.back(), std::vector<const LightPart*>{}, near_,
                                                     settings_, budget_, context, LightPart::Effort::Hurried));
        return parts_.size() - 1;
    }

    // What sheets point at are single charts, which stay where they are.
    void charts_are(std::span<const SurfaceCharts> charts) { charts_ = charts; }

    [[nodiscard]] std::size_t memory_bytes() const {
        std::size_t bytes = 0;
        for (const auto& part : parts_) {
            bytes += part->memory_bytes();
        }
        return bytes;
    }

private:
    using Maps = std::vector<std::shared_ptr<const LightMap>>;

    // Samples a part from nothing. Judged as when all was built: against its own light and that of the first part. False
    // when asked to stop: the part stays as it was.
    bool look_anew(std::size_t index, bool exact) {
        const unsigned first = std::min(settings_.first_level, settings_.max_level);
        auto budget = std::make_unique<TileBudget>(0);
        std::uint32_t tile = 0;
        for (const LightSheet& s : sheets_.sheets()) {
            for (const std::uint8_t used : s.used) {
                std::uint32_t level = first;
                for (std::size_t i = 0; exact && used != 0 && i < parts_.size(); ++i) {
                    const std::uint32_t own = i == index ? LightCells::kNone : parts_[i]->cells().tile_level(tile);
                    level = own != LightCells::kNone ? std::max(level, own) : level;
                }
                budget->add_tile(level, used != 0);
                ++tile;
            }
        }
        budget->allow(exact ? std::max(settings_.max_samples, budget->samples()) : budget->samples() + kMostFineTexels);
        const std::size_t most_tiles = exact ? 0 : std::max<std::size_t>(kMostSamples >> (2 * first), 1);
        near_anew_ = cells_within_reach(sheets_, *lights_[index], first, settings_.max_level, most_tiles, *context_);
        std::vector<const LightPart*> before;
        if (index > 0) {
            before.push_back(parts_.front().get());
        }
        auto part = std::make_unique<LightPart>(sheets_, *lights_[index], before, near_anew_, settings_, *budget, *context_,
                                                exact ? LightPart::Effort::Anew : LightPart::Effort::Hurried);
        if (!part->run(0.0, 0.0)) {
            return false;
        }
        for (const LightPart* p : {parts_[index].get(), part.get()}) {
            mark_lit(p->cells(), {});
        }
        parts_[index] = std::move(part);
        budget_anew_ = std::move(budget);
        return true;
    }

    // Sheets on which `light` (per node; empty: that of the nodes) shines have changed.
    void mark_lit(const LightCells& cells, const std::vector<Rgb>& light) {
        for (std::size_t i = 0; i < cells.nodes.size(); ++i) {
            const LightNode& n = cells.nodes[i];
            changed_[n.sheet] |= max_component(light.empty() ? n.irradiance : light[i]) > 0.0F ? 1 : 0;
        }
    }

    DirectMaps finish(double to) {
        DirectMaps out;
        out.front.resize(charts_.size());
        out.back.resize(charts_.size());
        out.limited_tiles = budget_.limited();
        ErrorSum error;
        for (const auto& part : parts_) {
            out.evaluations += part->evaluations();
            error.add(*part, sheets_, settings_.light_floor);
        }
        out.error_estimate = error.area > 0.0 ? std::sqrt(error.weighted / error.area) : 0.0;
        assemble([](std::uint32_t) { return true; }, out);
        if (context_->should_stop()) {
            return {};
        }
        for (const auto* side : {&out.front, &out.back}) {
            for (const auto& map : *side) {
                out.samples += map ? used_texels(*map) : 0;
            }
        }
        context_->progress("direct", to);
        out.complete = true;
        return out;
    }

    template <class Wanted> void assemble(const Wanted& wanted, DirectMaps& out) {
        std::vector<LightCells*> cells;
        for (const auto& part : parts_) {
            cells.push_back(&part->cells());
        }
        assemble(wanted, cells, out.front, out.back);
    }

    // Maps of the surfaces that are wanted, of the light that these parts' cells hold now.
    template <class Wanted>
    void assemble(const Wanted& wanted, const std::vector<LightCells*>& cells, Maps& front, Maps& back) {
        const auto& sheets = sheets_.sheets();
        std::vector<SheetPlace> places;
        for (const SheetPlace& p : places_) {
            if (wanted(sheets[p.sheet].surface)) {
                places.push_back(p);
            }
        }
        std::vector<std::uint8_t> lit(sheets.size(), 0);
        std::vector<LightCells*> all;
        for (const auto& part : parts_) {
            all.push_back(&part->cells());
        }
        std::vector<std::vector<std::pair<std::uint32_t, LightNode>>> filled(cells.size());
        std::vector<PartCells> parts(cells.size());
        std::vector<std::vector<std::uint8_t>> lit_sheets(cells.size(), lit);
        parallel_chunks(cells.size(), 1, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t i = first; i < last; ++i) {
                parts[i] = {cells[i], cells[i]->tile_marks()};
                for (const LightNode& n : cells[i]->nodes) {
                    lit_sheets[i][n.sheet] |= max_component(n.irradiance) > 0.0F ? 1 : 0;
                }
                filled[i] = fill_unknown_nodes(*cells[i], places, parts[i].marks);
            }
        });
        for (const std::vector<std::uint8_t>& of_part : lit_sheets) {
            for (std::size_t i = 0; i < lit.size(); ++i) {
                lit[i] |= of_part[i];
            }
        }
        for (std::size_t begin = 0; begin < places.size();) {
            const std::uint32_t surface = sheets[places[begin].sheet].surface;
            std::size_t end = begin;
            std::array<std::vector<SheetPlace>, 2> side;
            std::array<bool, 2> any{false, false};
            for (; end < places.size() && sheets[places[end].sheet].surface == surface; ++end) {
                const std::size_t k = sheets[places[end].sheet].back ? 1 : 0;
                side[k].push_back(places[end]);
                any[k] = any[k] || lit[places[end].sheet] != 0;
            }
            for (std::size_t k = 0; k < 2; ++k) {
                auto& map = (k == 0 ? front : back)[surface];
                map = any[k] ? std::make_shared<LightMap>(assemble_light_map(parts, all, side[k], charts_[surface].width,
                                                                             charts_[surface].height, *context_))
                             : nullptr;
            }
            begin = end;
        }
        for (std::size_t i = 0; i < cells.size(); ++i) {
            for (const auto& [node, before] : filled[i]) {
                cells[i]->nodes[node] = before;
            }
        }
    }
    static std::size_t used_texels(const LightMap& map) {
        std::size_t sum = 0;
        for (const LightMap::Tile& t : map.tiles) {
            const std::size_t edge = (std::size_t(1) << t.level) + 1;
            sum += t.used != 0 ? edge * edge : 0;
        }
        return sum;
    }

    std::span<const SurfaceCharts> charts_;
    std::vector<std::unique_ptr<DirectPart>> lights_;
    LightSheets sheets_;
    DirectMapSettings settings_;
    const RunContext* context_; ///< of the call at hand
    TileBudget budget_;
    std::unique_ptr<TileBudget> budget_anew_; ///< of the part that was looked at anew
    std::vector<LightCell> near_;             ///< that soft parts divide at once
    std::vector<LightCell> near_anew_;        ///< that a part divides at once that is looked at anew
    std::vector<std::unique_ptr<LightPart>> parts_;
    std::vector<SheetPlace> places_;    ///< of all sheets
    std::vector<std::uint8_t> changed_; ///< per sheet: samples are new that no map shows yet
    std::unique_ptr<BoxSight> sight_;   ///< of tiles, once something moved
};

LiveDirectMaps::LiveDirectMaps(const RayScene& rays, std::span<const SurfaceCharts> charts, std::vector<DirectPart> parts,
                               const std::function<bool(std::uint32_t)>& back_lit, const DirectMapSettings& settings,
                               const RunContext& context)
    : impl_(std::make_unique<Impl>(rays, charts, std::move(parts), back_lit, settings, context)) {
    ATRIUM_CHECK(charts.size() == rays.surfaces().size());
}
LiveDirectMaps::~LiveDirectMaps() = default;
DirectMaps LiveDirectMaps::build(double from, double to) { return impl_->build(from, to); }
RepairReport LiveDirectMaps::repair(const LightChange& change, DirectMaps& maps, const RunContext& context) {
    return impl_->repair(change, maps, context);
}
std::optional<SourceLight> LiveDirectMaps::light_of(std::span<const PartSource> source, const Rgb& brightness,
                                                    const RunContext& context) {
    return impl_->light_of(source, brightness, context);
}
bool LiveDirectMaps::take_out(std::span<const LeavingLight> light, const RunContext& context) {
    return impl_->take_out(light, context);
}
std::size_t LiveDirectMaps::add_part(DirectPart part, const RunContext& context) {
    return impl_->add_part(std::move(part), context);
}
void LiveDirectMaps::charts_are(std::span<const SurfaceCharts> charts) { impl_->charts_are(charts); }
void LiveDirectMaps::add_light(const SourceLight& source, const Rgb& change) { impl_->add_light(source, change); }
std::size_t LiveDirectMaps::memory_bytes() const { return impl_->memory_bytes(); }

std::size_t SourceLight::memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto& [part, light] : nodes) {
        bytes += light.size() * sizeof(Rgb);
    }
    for (const auto* side : {&front, &back}) {
        for (const auto& map : *side) {
            bytes += map ? map->memory_bytes() : 0;
        }
    }
    return bytes;
}

std::size_t DirectMaps::memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto* side : {&front, &back}) {
        for (const auto& map : *side) {
            bytes += map ? map->memory_bytes() : 0;
        }
    }
    return bytes;
}

DirectMaps build_direct_maps(const RayScene& rays, std::span<const SurfaceCharts> charts, std::span<const DirectPart> parts,
                             const std::function<bool(std::uint32_t)>& back_lit, const DirectMapSettings& settings,
                             const RunContext& context, double progress_from, double progress_to) {
    return LiveDirectMaps(rays, charts, {parts.begin(), parts.end()}, back_lit, settings, context)
        .build(progress_from, progress_to);
}

DirectMaps build_direct_maps(const RayScene& rays, std::span<const SurfaceCharts> charts, const DirectFunction& direct,
                             const std::function<bool(std::uint32_t)>& back_lit, const DirectMapSettings& settings,
                             const RunContext& context, double progress_from, double progress_to) {
    const DirectPart part{direct, false, false, {}};
    return build_direct_maps(rays, charts, std::span(&part, 1), back_lit, settings, context, progress_from, progress_to);
}

} // namespace atrium
