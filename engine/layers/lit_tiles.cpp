#include "engine/layers/lit_tiles.h"

#include "engine/base/parallel.h"

#include <algorithm>

namespace atrium {
namespace {

struct Tile {
    std::uint32_t sheet = 0, u = 0, v = 0;
    float light = 0.0F; ///< no more than this, lux
};

} // namespace

std::vector<LightCell> cells_within_reach(const LightSheets& sheets, const DirectPart& part, unsigned level,
                                          unsigned max_level, std::size_t most_tiles, const RunContext& context) {
    std::vector<Tile> tiles;
    std::vector<Box3> bounds; // of sheets that are not plane: all of the surface at once
    for (std::uint32_t i = 0; i < sheets.sheets().size(); ++i) {
        const LightSheet& sheet = sheets.sheets()[i];
        Box3 box;
        if (!sheet.chart->planar) {
            for (const vec3& p : *sheets.rays().surfaces()[sheet.surface].positions) {
                box.add(p);
            }
        }
        bounds.push_back(box);
        for (std::uint32_t t = 0; t < sheet.used.size() && !sheets.rays().absent(sheet.surface); ++t) {
            if (sheet.used[t] != 0) {
                tiles.push_back({i, t % sheet.chart->tiles_u, t / sheet.chart->tiles_u});
            }
        }
    }
    parallel_chunks(tiles.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t k = begin; k < end && !context.should_stop(); ++k) {
            Tile& t = tiles[k];
            const LightSheet& sheet = sheets.sheets()[t.sheet];
            const Chart& chart = *sheet.chart;
            if (!part.most) {
                t.light = 1.0F;
            } else if (chart.planar) {
                const vec2 middle = (vec2(float(t.u), float(t.v)) + 0.5F) * chart.scale;
                const vec3 centre = chart.origin + chart.axis_u * middle.x + chart.axis_v * middle.y;
                t.light = part.most(centre, 0.5F * glm::length(chart.scale), sheet.back ? -chart.normal : chart.normal);
            } else {
                t.light = part.most(bounds[t.sheet].centre(), 0.5F * bounds[t.sheet].diagonal(), vec3(0.0F));
            }
        }
    });
    std::erase_if(tiles, [](const Tile& t) { return !(t.light > 0.0F); });
    if (most_tiles > 0 && tiles.size() > most_tiles) {
        std::stable_sort(tiles.begin(), tiles.end(), [](const Tile& a, const Tile& b) { return a.light > b.light; });
        tiles.resize(most_tiles);
    }
    std::vector<LightCell> out;
    for (const Tile& t : tiles) {
        for (unsigned l = 0; l < level; ++l) {
            const std::uint32_t n = 1U << l, edge = 1U << (max_level - l);
            for (std::uint32_t c = 0; c < n * n; ++c) {
                out.push_back({t.sheet, (t.u << max_level) + c % n * edge, (t.v << max_level) + c / n * edge, l});
            }
        }
    }
    return out;
}

} // namespace atrium
