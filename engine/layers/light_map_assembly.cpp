#include "engine/layers/light_map_assembly.h"

#include "engine/base/checks.h"
#include "engine/base/parallel.h"

#include <algorithm>

namespace atrium {
namespace {

using State = LightNode::State;

struct OpenCell {
    std::array<std::uint32_t, 4> corner;
};

// Rounds of one step outwards each, among cells with a corner in `state`.
void flood(LightCells& cells, std::vector<OpenCell> open, State state,
           std::vector<std::pair<std::uint32_t, LightNode>>& before) {
    std::vector<Rgb> sum(open.empty() ? 0 : cells.nodes.size(), Rgb(0.0F));
    std::vector<std::uint16_t> count(sum.size(), 0);
    std::vector<std::uint32_t> reached;
    while (!open.empty()) {
        reached.clear();
        for (const OpenCell& c : open) {
            for (std::size_t k = 0; k < 4; ++k) {
                const std::uint32_t to = c.corner[k];
                if (cells.nodes[to].state != state) {
                    continue;
                }
                for (const std::size_t other : {k ^ 1U, k ^ 2U}) {
                    const LightNode& from = cells.nodes[c.corner[other]];
                    if (from.known()) {
                        if (count[to] == 0) {
                            reached.push_back(to);
                        }
                        sum[to] += from.irradiance;
                        ++count[to];
                    }
                }
            }
        }
        if (reached.empty()) {
            return;
        }
        for (const std::uint32_t n : reached) {
            before.emplace_back(n, cells.nodes[n]);
            cells.nodes[n].irradiance = sum[n] / float(count[n]);
            cells.nodes[n].state = State::Known;
        }
        std::erase_if(open, [&](const OpenCell& c) {
            return std::none_of(c.corner.begin(), c.corner.end(),
                                [&](std::uint32_t n) { return cells.nodes[n].state == state; });
        });
    }
}

/// Places tiles in an image: rows of tiles of one size, the largest first.
class Packing {
public:
    Packing(LightMap& map, std::vector<std::size_t> used) : map_(map) {
        std::stable_sort(used.begin(), used.end(),
                         [&](std::size_t a, std::size_t b) { return map.tiles[a].level > map.tiles[b].level; });
        double area = 0.0;
        for (const std::size_t t : used) {
            area += double(edge(t)) * edge(t);
        }
        constexpr double kMostWide = 8192.0; // graphics cards' textures
        const auto wide = std::uint32_t(std::min(std::ceil(std::sqrt(area)), kMostWide));
        const std::uint32_t width = used.empty() ? 0 : std::max(wide, edge(used.front()));
        std::uint32_t x = 0, y = 0, row = 0;
        for (const std::size_t t : used) {
            if (x + edge(t) > width) {
                y += row;
                x = 0;
                row = 0;
            }
            ATRIUM_CHECK(y + edge(t) <= 65535U);
            map.tiles[t].x = std::uint16_t(x);
            map.tiles[t].y = std::uint16_t(y);
            x += edge(t);
            row = std::max(row, edge(t));
            map.image_width = std::max(map.image_width, x);
        }
        map.image_height = y + row;
        map.image.assign(std::size_t(map.image_width) * map.image_height, Rgb(0.0F));
    }

private:
    [[nodiscard]] std::uint32_t edge(std::size_t tile) const { return (1U << map_.tiles[tile].level) + 1; }
    LightMap& map_;
};

Rgb& texel(LightMap& map, const LightMap::Tile& tile, std::uint32_t x, std::uint32_t y) {
    return map.image[(std::size_t(tile.y) + y) * map.image_width + tile.x + x];
}

// Adds every cell of the tile at the tile's own resolution. Fine cells come last: their nodes are better than what coarse
// ones interpolate on a common edge.
void fill_tile(const LightCells& cells, const SheetPlace& s, std::uint32_t u, std::uint32_t v, LightMap& map,
               const LightMap::Tile& tile) {
    std::vector<LightCell> leaves;
    cells.leaves(s.sheet, u, v, leaves);
    const std::uint32_t step = cells.steps(tile.level), edge = (1U << tile.level) + 1;
    const std::uint32_t x0 = u << cells.max_level(), y0 = v << cells.max_level();
    std::vector<Rgb> part(std::size_t(edge) * edge);
    for (const LightCell& c : leaves) {
        const auto corner = cells.corners(c);
        const std::uint32_t n = cells.steps(c.level) / step;
        for (std::uint32_t j = 0; j <= n; ++j) {
            const float fy = float(j) / float(n);
            const Rgb left = cells.nodes[corner[0]].irradiance * (1.0F - fy) + cells.nodes[corner[2]].irradiance * fy;
            const Rgb right = cells.nodes[corner[1]].irradiance * (1.0F - fy) + cells.nodes[corner[3]].irradiance * fy;
            Rgb* row = &part[std::size_t((c.y - y0) / step + j) * edge + (c.x - x0) / step];
            for (std::uint32_t i = 0; i <= n; ++i) {
                const float fx = float(i) / float(n);
                row[i] = left * (1.0F - fx) + right * fx;
            }
        }
    }
    for (std::uint32_t y = 0; y < edge; ++y) {
        for (std::uint32_t x = 0; x < edge; ++x) {
            texel(map, tile, x, y) += part[std::size_t(y) * edge + x];
        }
    }
}

// Makes two tiles agree along their common edge: at the coarser one's samples the mean of what both say (the same but where
// one interpolates and the other has looked closer), between them the straight line that the coarser one shows.
void stitch(const SheetPlace& s, LightMap& map, std::uint32_t u, std::uint32_t v, bool upwards) {
    const auto tile_at = [&](std::uint32_t i, std::uint32_t j) -> const LightMap::Tile& {
        return map.tiles[std::size_t(s.tile_v + j) * map.width + s.tile_u + i];
    };
    const LightMap::Tile& a = tile_at(u, v);
    const LightMap::Tile& b = tile_at(upwards ? u : u + 1, upwards ? v + 1 : v);
    if (a.used == 0 || b.used == 0) {
        return;
    }
    const std::uint32_t na = 1U << a.level, nb = 1U << b.level, n = std::min(na, nb);
    const auto of_a = [&](std::uint32_t i) -> Rgb& { return upwards ? texel(map, a, i, na) : texel(map, a, na, i); };
    const auto of_b = [&](std::uint32_t i) -> Rgb& { return upwards ? texel(map, b, i, 0) : texel(map, b, 0, i); };
    for (std::uint32_t i = 1; i < n; ++i) { // corners are nodes that all four tiles share
        Rgb& pa = of_a(i * (na / n));
        Rgb& pb = of_b(i * (nb / n));
        pa = pb = 0.5F * (pa + pb);
    }
    const auto straighten = [&](auto&& of, std::uint32_t fine) {
        const std::uint32_t ratio = fine / n;
        for (std::uint32_t i = 0; i < fine; ++i) {
            if (i % ratio != 0) {
                const float f = float(i % ratio) / float(ratio);
                const std::uint32_t below = i / ratio * ratio;
                of(i) = of(below) * (1.0F - f) + of(below + ratio) * f;
            }
        }
    };
    straighten(of_a, na);
    straighten(of_b, nb);
}

} // namespace

std::vector<std::pair<std::uint32_t, LightNode>> fill_unknown_nodes(LightCells& cells, std::span<const SheetPlace> sheets,
                                                                    std::vector<std::uint8_t>& marks) {
    std::vector<OpenCell> covered, away;
    std::vector<LightCell> leaves;
    for (const SheetPlace& s : sheets) {
        for (std::uint32_t v = 0; v < s.tiles_v; ++v) {
            for (std::uint32_t u = 0; u < s.tiles_u; ++u) {
                if ((marks[cells.tile_index(s.sheet, u, v)] & LightCells::kOpen) == 0) {
                    continue;
                }
                cells.leaves(s.sheet, u, v, leaves);
                for (const LightCell& c : leaves) {
                    const OpenCell open{cells.corners(c)};
                    const auto any = [&](State state) {
                        return std::any_of(open.corner.begin(), open.corner.end(),
                                           [&](std::uint32_t n) { return cells.nodes[n].state == state; });
                    };
                    if (any(State::Covered)) {
                        covered.push_back(open);
                    }
                    if (any(State::Void)) {
                        away.push_back(open);
                    }
                }
            }
        }
    }
    std::vector<std::pair<std::uint32_t, LightNode>> before;
    flood(cells, std::move(covered), State::Covered, before);
    flood(cells, std::move(away), State::Void, before);
    for (const auto& [node, was] : before) {
        if (max_component(cells.nodes[node].irradiance) > 0.0F) {
            cells.mark_tiles(cells.nodes[node], LightCells::kLit, marks);
        }
    }
    return before;
}

LightMap assemble_light_map(std::span<const PartCells> parts, std::span<LightCells* const> all,
                            std::span<const SheetPlace> sheets, std::uint32_t width, std::uint32_t height,
                            const RunContext& context) {
    LightMap map;
    map.width = width;
    map.height = height;
    map.tiles.resize(std::size_t(width) * height);
    struct Place {
        std::size_t sheet;
        std::uint32_t u, v;
        std::size_t tile;
    };
    std::vector<Place> places;
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        const SheetPlace& s = sheets[i];
        for (std::uint32_t v = 0; v < s.tiles_v; ++v) {
            for (std::uint32_t u = 0; u < s.tiles_u; ++u) {
                std::uint32_t level = 0;
                bool any = false;
                for (const LightCells* part : all) {
                    const std::uint32_t own = part->tile_level(part->tile_index(s.sheet, u, v));
                    any = any || own != LightCells::kNone;
                    level = own != LightCells::kNone ? std::max(level, own) : level;
                }
                if (any) {
                    const std::size_t tile = std::size_t(s.tile_v + v) * width + s.tile_u + u;
                    map.tiles[tile].level = std::uint16_t(level);
                    map.tiles[tile].used = 1;
                    places.push_back({i, u, v, tile});
                    used.push_back(tile);
                }
            }
        }
    }
    const Packing packed(map, used);
    parallel_chunks(places.size(), 4, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            const Place& p = places[i];
            for (const PartCells& part : parts) {
                if ((part.marks[part.cells->tile_index(sheets[p.sheet].sheet, p.u, p.v)] & LightCells::kLit) != 0) {
                    fill_tile(*part.cells, sheets[p.sheet], p.u, p.v, map, map.tiles[p.tile]);
                }
            }
        }
    });
    for (const Place& p : places) {
        const SheetPlace& s = sheets[p.sheet];
        if (p.u + 1 < s.tiles_u) {
            stitch(s, map, p.u, p.v, false);
        }
        if (p.v + 1 < s.tiles_v) {
            stitch(s, map, p.u, p.v, true);
        }
    }
    return map;
}

} // namespace atrium
