#include "engine/layers/light_cells.h"

#include "engine/base/checks.h"
#include "engine/base/rng.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr unsigned kFinestLevel = 12;

// Number of cells at all levels from `first` to before `level`.
std::size_t cells_before(unsigned first, unsigned level) {
    return ((std::size_t(1) << (2 * level)) - (std::size_t(1) << (2 * first))) / 3;
}

LightGuess guess_of(const LightNode& node) { return {luminance(node.irradiance), node.variance, node.known()}; }

} // namespace

LightCells::LightCells(unsigned first_level, unsigned max_level)
    : first_level_(std::min(first_level, max_level)), max_level_(max_level), table_(1024, kNone) {
    ATRIUM_CHECK(max_level <= kFinestLevel);
}

std::uint32_t LightCells::add_sheet(std::uint32_t tiles_u, std::uint32_t tiles_v, const std::vector<std::uint8_t>& used) {
    sheets_.push_back({tiles_u, tiles_v, std::uint32_t(tiles_.size())});
    for (const std::uint8_t u : used) {
        tiles_.push_back({u != 0 ? first_level_ : kNone, kNone});
    }
    return std::uint32_t(sheets_.size() - 1);
}

std::uint32_t LightCells::tile_index(const LightCell& cell) const {
    return tile_index(cell.sheet, cell.x >> max_level_, cell.y >> max_level_);
}

std::vector<std::uint8_t> LightCells::tile_marks() const {
    std::vector<std::uint8_t> out(tiles_.size(), 0);
    for (const LightNode& n : nodes) {
        const bool open = n.state == LightNode::State::Covered || n.state == LightNode::State::Void;
        const auto mark = std::uint8_t((max_component(n.irradiance) > 0.0F ? kLit : 0U) | (open ? kOpen : 0U));
        if (mark != 0) {
            mark_tiles(n, mark, out);
        }
    }
    return out;
}

void LightCells::mark_tiles(const LightNode& n, std::uint8_t mark, std::vector<std::uint8_t>& marks) const {
    const Sheet& s = sheets_[n.sheet];
    const std::uint32_t inside = steps_per_tile() - 1;
    const std::uint32_t u = n.x >> max_level_, v = n.y >> max_level_;
    for (std::uint32_t k = 0; k < 4; ++k) { // on an edge it belongs to the tile before it too
        const std::uint32_t du = k & 1U, dv = k >> 1U;
        if ((du != 0 && ((n.x & inside) != 0 || u == 0)) || (dv != 0 && ((n.y & inside) != 0 || v == 0))) {
            continue;
        }
        if (u - du < s.tiles_u && s.first_tile + (v - dv) * s.tiles_u + u - du < marks.size()) {
            marks[s.first_tile + (v - dv) * s.tiles_u + u - du] |= mark;
        }
    }
}

std::uint32_t LightCells::tile_level(std::uint32_t tile) const { return tiles_[tile].level; }

std::size_t LightCells::slot(std::uint32_t sheet, std::uint32_t x, std::uint32_t y) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t i = hash64(std::uint64_t(sheet) << 42 ^ std::uint64_t(x) << 21 ^ y) & mask;
    while (table_[i] != kNone) {
        const LightNode& n = nodes[table_[i]];
        if (n.sheet == sheet && n.x == x && n.y == y) {
            break;
        }
        i = (i + 1) & mask;
    }
    return i;
}

void LightCells::grow_table() {
    table_.assign(2 * table_.size(), kNone);
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        table_[slot(nodes[i].sheet, nodes[i].x, nodes[i].y)] = i;
    }
}

std::uint32_t LightCells::find(std::uint32_t sheet, std::uint32_t x, std::uint32_t y) const {
    return table_[slot(sheet, x, y)];
}

std::uint32_t LightCells::find_or_add(std::uint32_t sheet, std::uint32_t x, std::uint32_t y) {
    const std::size_t at = slot(sheet, x, y);
    if (table_[at] != kNone) {
        return table_[at];
    }
    const auto index = std::uint32_t(nodes.size());
    table_[at] = index;
    LightNode node;
    node.sheet = sheet;
    node.x = x;
    node.y = y;
    nodes.push_back(node);
    if (nodes.size() * 2 > table_.size()) {
        grow_table();
    }
    return index;
}

std::array<std::uint32_t, 4> LightCells::corners(const LightCell& c) const {
    const std::uint32_t s = steps(c.level);
    return {find(c.sheet, c.x, c.y), find(c.sheet, c.x + s, c.y), find(c.sheet, c.x, c.y + s),
            find(c.sheet, c.x + s, c.y + s)};
}

std::size_t LightCells::bit(const LightCell& c) const {
    const std::uint32_t in_tile = steps_per_tile() - 1;
    const unsigned down = max_level_ - c.level;
    return cells_before(first_level_, c.level) + (std::size_t((c.y & in_tile) >> down) << c.level) +
           ((c.x & in_tile) >> down);
}

bool LightCells::divided(const TileState& tile, const LightCell& cell) const {
    if (tile.bits == kNone || cell.level >= tile.level) {
        return false;
    }
    const std::size_t b = bit(cell);
    return (bits_[tile.bits + b / 64] >> (b % 64) & 1U) != 0;
}

std::optional<LightCell> LightCells::leaf(std::uint32_t sheet, std::int64_t x, std::int64_t y) const {
    const Sheet& s = sheets_[sheet];
    if (x < 0 || y < 0 || x >= (std::int64_t(s.tiles_u) << max_level_) || y >= (std::int64_t(s.tiles_v) << max_level_)) {
        return std::nullopt;
    }
    const TileState& tile = tiles_[tile_index(sheet, std::uint32_t(x >> max_level_), std::uint32_t(y >> max_level_))];
    if (tile.level == kNone) {
        return std::nullopt;
    }
    for (unsigned level = first_level_;; ++level) {
        const std::uint32_t mask = ~(steps(level) - 1);
        const LightCell cell{sheet, std::uint32_t(x) & mask, std::uint32_t(y) & mask, level};
        if (!divided(tile, cell)) {
            return cell;
        }
    }
}

void LightCells::leaves(std::uint32_t sheet, std::uint32_t u, std::uint32_t v, std::vector<LightCell>& out) const {
    out.clear();
    const TileState& tile = tiles_[tile_index(sheet, u, v)];
    if (tile.level == kNone) {
        return;
    }
    // Level by level; cells that are divided make room for their quarters.
    std::vector<LightCell> cells;
    const std::uint32_t s = steps(first_level_);
    for (std::uint32_t y = 0; y < steps_per_tile(); y += s) {
        for (std::uint32_t x = 0; x < steps_per_tile(); x += s) {
            cells.push_back({sheet, (u << max_level_) + x, (v << max_level_) + y, first_level_});
        }
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const LightCell c = cells[i];
        if (!divided(tile, c)) {
            out.push_back(c);
            continue;
        }
        const std::uint32_t h = steps(c.level + 1);
        cells.insert(cells.end(), {{sheet, c.x, c.y, c.level + 1},
                                   {sheet, c.x + h, c.y, c.level + 1},
                                   {sheet, c.x, c.y + h, c.level + 1},
                                   {sheet, c.x + h, c.y + h, c.level + 1}});
    }
}

std::array<LightCell, 4> LightCells::split(const LightCell& c) {
    ATRIUM_CHECK(c.level < max_level_);
    TileState& tile = tiles_[tile_index(c)];
    if (tile.bits == kNone) {
        tile.bits = std::uint32_t(bits_.size());
        bits_.resize(bits_.size() + (cells_before(first_level_, max_level_) + 63) / 64, 0);
    }
    const std::size_t b = bit(c);
    bits_[tile.bits + b / 64] |= std::uint64_t(1) << (b % 64);
    tile.level = std::max(tile.level, c.level + 1);
    const std::uint32_t h = steps(c.level + 1);
    for (std::uint32_t y = 0; y < 3; ++y) {
        for (std::uint32_t x = 0; x < 3; ++x) {
            find_or_add(c.sheet, c.x + x * h, c.y + y * h);
        }
    }
    return {{{c.sheet, c.x, c.y, c.level + 1},
             {c.sheet, c.x + h, c.y, c.level + 1},
             {c.sheet, c.x, c.y + h, c.level + 1},
             {c.sheet, c.x + h, c.y + h, c.level + 1}}};
}

LightGuess LightCells::interpolate(const LightCell& cell, float dx, float dy) const {
    const float s = 1.0F / float(steps(cell.level));
    const float fx = dx * s, fy = dy * s;
    const std::array<float, 4> w{(1.0F - fx) * (1.0F - fy), fx * (1.0F - fy), (1.0F - fx) * fy, fx * fy};
    const auto corner = corners(cell);
    LightGuess out;
    out.known = true;
    for (std::size_t k = 0; k < 4; ++k) {
        if (w[k] <= 0.0F) {
            continue;
        }
        const LightGuess g = guess_of(nodes[corner[k]]);
        out.light += w[k] * g.light;
        out.variance += w[k] * w[k] * g.variance;
        out.known = out.known && g.known;
    }
    return out;
}

LightGuess LightCells::guess(std::uint32_t sheet, std::int64_t x, std::int64_t y) const {
    if (x < 0 || y < 0) {
        return {};
    }
    if (const std::uint32_t n = find(sheet, std::uint32_t(x), std::uint32_t(y)); n != kNone) {
        return guess_of(nodes[n]);
    }
    for (const auto& [ax, ay] : {std::pair<int, int>{0, 0}, {-1, 0}, {0, -1}, {-1, -1}}) {
        if (const auto cell = leaf(sheet, x + ax, y + ay)) {
            return interpolate(*cell, float(x - cell->x), float(y - cell->y));
        }
    }
    return {};
}

} // namespace atrium
