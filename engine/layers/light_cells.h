// The grid on which direct light is looked for: square cells over charts, divided into quarters where the light changes.
#pragma once

#include "engine/base/units.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace atrium {

/// A corner of cells, shared by all cells of its sheet that meet there. Coordinates are in steps, 2^max_level to a tile.
struct LightNode {
    enum class State : std::uint8_t {
        Unknown, ///< not sampled yet
        Known,
        Covered, ///< something rests on the surface here: neither lit nor dark, nobody can see it
        Void     ///< away from the surface: only there to fill the corner of a cell
    };
    std::uint32_t sheet = 0;
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    Rgb irradiance{0.0F};  ///< lux
    float variance = 0.0F; ///< of its luminance, lux^2
    State state = State::Unknown;
    [[nodiscard]] bool known() const { return state == State::Known; }
};

/// A square of a sheet; its edge is 2^(max_level - level) steps.
struct LightCell {
    std::uint32_t sheet = 0;
    std::uint32_t x = 0; ///< corner of least coordinates, steps
    std::uint32_t y = 0;
    std::uint32_t level = 0;
    friend bool operator==(const LightCell&, const LightCell&) = default;
};

/// What the grid says of the light at a place.
struct LightGuess {
    float light = 0.0F;    ///< luminance of the irradiance, lux
    float variance = 0.0F; ///< lux^2
    bool known = false;    ///< false outside, and wherever a corner needed for it is not known
};

/// Cells and nodes of many sheets (a sheet is one side of one chart). Reading is safe from any thread while nothing is
/// added.
class LightCells {
public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    /// Cells start at `first_level` and may be divided down to `max_level` (at most 12).
    LightCells(unsigned first_level, unsigned max_level);

    /// A sheet of tiles_u * tiles_v tiles of which those marked in `used` have cells; returns its number.
    std::uint32_t add_sheet(std::uint32_t tiles_u, std::uint32_t tiles_v, const std::vector<std::uint8_t>& used);

    [[nodiscard]] unsigned first_level() const { return first_level_; }
    [[nodiscard]] unsigned max_level() const { return max_level_; }
    [[nodiscard]] std::uint32_t steps(unsigned level) const { return 1U << (max_level_ - level); } ///< along a cell's edge
    [[nodiscard]] std::uint32_t steps_per_tile() const { return 1U << max_level_; }
    [[nodiscard]] std::uint32_t tile_index(const LightCell& cell) const; ///< over all sheets
    /// Level of the finest cell of a tile; kNone where it is not used.
    [[nodiscard]] std::uint32_t tile_level(std::uint32_t tile) const;
    [[nodiscard]] std::uint32_t tile_index(std::uint32_t sheet, std::uint32_t u, std::uint32_t v) const {
        return sheets_[sheet].first_tile + v * sheets_[sheet].tiles_u + u;
    }

    [[nodiscard]] std::size_t memory_bytes() const {
        return nodes.size() * sizeof(LightNode) + tiles_.size() * sizeof(TileState) + bits_.size() * 8 + table_.size() * 4;
    }

    static constexpr std::uint8_t kLit = 1;  ///< some node of a tile shines
    static constexpr std::uint8_t kOpen = 2; ///< some node of it is covered or away from the surface
    /// Which of these hold, per tile over all sheets.
    [[nodiscard]] std::vector<std::uint8_t> tile_marks() const;
    /// Sets marks of the tiles (up to four) that a node lies on.
    void mark_tiles(const LightNode& node, std::uint8_t mark, std::vector<std::uint8_t>& marks) const;

    std::vector<LightNode> nodes;
    /// Node at a place; kNone where there is none.
    [[nodiscard]] std::uint32_t find(std::uint32_t sheet, std::uint32_t x, std::uint32_t y) const;
    /// The same, added with state Unknown where there is none.
    std::uint32_t find_or_add(std::uint32_t sheet, std::uint32_t x, std::uint32_t y);
    /// Nodes at (x, y), (x+s, y), (x, y+s), (x+s, y+s). Every cell that is not divided has all four.
    [[nodiscard]] std::array<std::uint32_t, 4> corners(const LightCell& cell) const;

    /// The undivided cell that holds the unit square whose least corner is (x, y) in steps; none outside used tiles.
    [[nodiscard]] std::optional<LightCell> leaf(std::uint32_t sheet, std::int64_t x, std::int64_t y) const;
    /// All undivided cells of a tile, coarse ones first.
    void leaves(std::uint32_t sheet, std::uint32_t u, std::uint32_t v, std::vector<LightCell>& out) const;
    /// Divides a cell, adds the nodes that its quarters need and returns these quarters.
    std::array<LightCell, 4> split(const LightCell& cell);

    /// Bilinear interpolation in a cell at a place given in steps from its corner.
    [[nodiscard]] LightGuess interpolate(const LightCell& cell, float dx, float dy) const;
    /// The node at a place or, where there is none, interpolation in the cell there.
    [[nodiscard]] LightGuess guess(std::uint32_t sheet, std::int64_t x, std::int64_t y) const;

private:
    struct Sheet {
        std::uint32_t tiles_u = 0;
        std::uint32_t tiles_v = 0;
        std::uint32_t first_tile = 0;
    };
    struct TileState {
        std::uint32_t level = kNone;
        std::uint32_t bits = kNone; ///< first word of its division bits; kNone while nothing is divided
    };
    [[nodiscard]] std::size_t bit(const LightCell& cell) const;
    [[nodiscard]] bool divided(const TileState& tile, const LightCell& cell) const;
    [[nodiscard]] std::size_t slot(std::uint32_t sheet, std::uint32_t x, std::uint32_t y) const;
    void grow_table();

    unsigned first_level_;
    unsigned max_level_;
    std::vector<Sheet> sheets_;
    std::vector<TileState> tiles_;
    std::vector<std::uint64_t> bits_;
    std::vector<std::uint32_t> table_; ///< open addressing, indices into nodes
};

} // namespace atrium
