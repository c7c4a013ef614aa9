// Direct light of one side of a surface at texel resolution: square tiles over the surface's chart space, each as fine as
// the light on it asks for.
#pragma once

#include "engine/base/units.h"

#include <cstdint>
#include <vector>

namespace atrium {

/// Immutable once built. Chart-space coordinates are in tiles: tile (i, j) covers [i, i+1] x [j, j+1]. A tile of level k has
/// 2^k + 1 samples a side, on its corners and edges included, so that neighbours of one level meet without a seam and
/// bilinear interpolation never reads another tile's samples.
struct LightMap {
    struct Tile {
        std::uint16_t x = 0; ///< first sample in the image
        std::uint16_t y = 0;
        std::uint16_t level = 0;
        std::uint16_t used = 0; ///< 0: no part of the surface lies here
    };
    std::uint32_t width = 0; ///< of the chart space, tiles
    std::uint32_t height = 0;
    std::vector<Tile> tiles; ///< row by row, width * height
    std::uint32_t image_width = 0;
    std::uint32_t image_height = 0;
    std::vector<Rgb> image; ///< irradiance, lux, row by row; the tiles' samples packed together

    [[nodiscard]] bool empty() const { return tiles.empty(); }
    /// Irradiance at chart-space coordinates, lux; outside the map or on an unused tile: the nearest used tile among the
    /// eight around, else 0.
    [[nodiscard]] Rgb irradiance(const vec2& uv) const;
    /// Mean irradiance over the rectangle between two chart-space positions (lo <= hi): the exact integral of what
    /// irradiance() interpolates. Unused tiles do not count; 0 where no other is met. Without area: irradiance(lo).
    [[nodiscard]] Rgb mean(const vec2& lo, const vec2& hi) const;
    [[nodiscard]] std::size_t memory_bytes() const { return tiles.size() * sizeof(Tile) + image.size() * sizeof(Rgb); }
    friend bool operator==(const LightMap&, const LightMap&) = default;
};
inline bool operator==(const LightMap::Tile& a, const LightMap::Tile& b) {
    return a.x == b.x && a.y == b.y && a.level == b.level && a.used == b.used;
}

} // namespace atrium
