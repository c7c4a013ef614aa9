// How fine each tile of all light maps is, and how many texels that makes together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace atrium {

/// A wish that a tile have cells of some level.
struct TileGrowth {
    std::uint32_t tile = 0; ///< over all sheets
    std::uint32_t level = 0;
    float error = 0.0F; ///< what makes one wish stronger than another
};

/// Levels of the tiles that all parts of the light share, within a bound for their texels. Not safe from several threads.
class TileBudget {
public:
    explicit TileBudget(std::size_t max_samples) : max_samples_(max_samples) {}

    /// Adds a tile that has this level at least, budget or not; unused tiles count nothing.
    void add_tile(std::uint32_t level, bool used);
    [[nodiscard]] std::uint32_t level(std::uint32_t tile) const { return levels_[tile]; }
    /// Grows tiles, those of the greatest errors first, as far as the budget goes (several wishes for a tile: in ascending
    /// order of tiles). Returns the tiles that could not grow, ascending.
    std::vector<std::uint32_t> grow(const std::vector<TileGrowth>& wishes);
    /// Texels of all tiles.
    [[nodiscard]] std::size_t samples() const { return samples_; }
    /// From now on so many texels at most.
    void allow(std::size_t max_samples) { max_samples_ = max_samples; }
    /// Tiles that once could not grow.
    [[nodiscard]] std::size_t limited() const { return limited_.size(); }

private:
    std::size_t max_samples_;
    std::size_t samples_ = 0;
    std::vector<std::uint32_t> levels_;
    std::vector<std::uint32_t> limited_; ///< ascending
};

} // namespace atrium
