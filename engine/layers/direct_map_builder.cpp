#include "engine/layers/direct_map_builder.h"

#include "engine/base/checks.h"
#include "engine/layers/light_map_assembly.h"
#include "engine/layers/light_part.h"

#include <algorithm>
#include <cmath>

namespace atrium {
namespace {

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

class DirectMapBuild {
public:
    DirectMapBuild(const RayScene& rays, std::span<const SurfaceCharts> charts,
                   const std::function<bool(std::uint32_t)>& back_lit, const DirectMapSettings& settings,
                   const RunContext& context)
        : charts_(charts), sheets_(rays, charts, back_lit, context), settings_(settings), context_(context),
          budget_(settings.max_samples) {
        for (const LightSheet& s : sheets_.sheets()) {
            for (const std::uint8_t used : s.used) {
                budget_.add_tile(std::min(settings.first_level, settings.max_level), used != 0);
            }
        }
    }

    DirectMaps run(std::span<const DirectPart> lights, double from, double to) {
        parts_.reserve(lights.size());
        for (std::size_t i = 0; i < lights.size(); ++i) {
            LightPart part(sheets_, lights[i], parts_, settings_, budget_, context_);
            const double step = (to - from) / double(lights.size());
            if (!part.run(from + step * double(i), from + step * double(i + 1))) {
                return {};
            }
            parts_.push_back(std::move(part));
        }
        return finish(to);
    }

private:
    DirectMaps finish(double to) {
        DirectMaps out;
        out.front.resize(charts_.size());
        out.back.resize(charts_.size());
        out.limited_tiles = budget_.limited();
        ErrorSum error;
        std::vector<LightCells*> cells;
        for (LightPart& part : parts_) {
            out.evaluations += part.evaluations();
            error.add(part, sheets_, settings_.light_floor);
            cells.push_back(&part.cells());
        }
        out.error_estimate = error.area > 0.0 ? std::sqrt(error.weighted / error.area) : 0.0;
        const auto& sheets = sheets_.sheets();
        std::vector<std::uint8_t> lit(sheets.size(), 0);
        std::vector<SheetPlace> places;
        for (std::uint32_t i = 0; i < sheets.size(); ++i) {
            const Chart& c = *sheets[i].chart;
            places.push_back({i, c.tile_u, c.tile_v, c.tiles_u, c.tiles_v});
        }
        for (LightCells* part : cells) {
            for (const LightNode& n : part->nodes) {
                lit[n.sheet] |= max_component(n.irradiance) > 0.0F ? 1 : 0;
            }
            fill_unknown_nodes(*part, places);
        }
        for (std::size_t begin = 0; begin < sheets.size();) {
            const std::uint32_t surface = sheets[begin].surface;
            std::size_t end = begin;
            std::array<std::vector<SheetPlace>, 2> side;
            std::array<bool, 2> any{false, false};
            for (; end < sheets.size() && sheets[end].surface == surface; ++end) {
                const std::size_t k = sheets[end].back ? 1 : 0;
                side[k].push_back(places[end]);
                any[k] = any[k] || lit[end] != 0;
            }
            for (std::size_t k = 0; k < 2; ++k) {
                if (any[k]) {
                    auto map = std::make_shared<LightMap>(
                        assemble_light_map(cells, side[k], charts_[surface].width, charts_[surface].height, context_));
                    out.samples += used_texels(*map);
                    (k == 0 ? out.front : out.back)[surface] = std::move(map);
                }
            }
            begin = end;
        }
        if (context_.should_stop()) {
            return {};
        }
        context_.progress("direct", to);
        out.complete = true;
        return out;
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
    LightSheets sheets_;
    const DirectMapSettings& settings_;
    const RunContext& context_;
    TileBudget budget_;
    std::vector<LightPart> parts_;
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

DirectMaps build_direct_maps(const RayScene& rays, std::span<const SurfaceCharts> charts, std::span<const DirectPart> parts,
                             const std::function<bool(std::uint32_t)>& back_lit, const DirectMapSettings& settings,
                             const RunContext& context, double progress_from, double progress_to) {
    ATRIUM_CHECK(charts.size() == rays.surfaces().size());
    return DirectMapBuild(rays, charts, back_lit, settings, context).run(parts, progress_from, progress_to);
}

DirectMaps build_direct_maps(const RayScene& rays, std::span<const SurfaceCharts> charts, const DirectFunction& direct,
                             const std::function<bool(std::uint32_t)>& back_lit, const DirectMapSettings& settings,
                             const RunContext& context, double progress_from, double progress_to) {
    const DirectPart part{direct, false};
    return build_direct_maps(rays, charts, std::span(&part, 1), back_lit, settings, context, progress_from, progress_to);
}

} // namespace atrium
