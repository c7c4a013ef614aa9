// Light maps and layers made by hand: what shows and stores light is tested without what computes it.
#pragma once

#include "engine/layers/surface_layer.h"

#include <functional>
#include <memory>

namespace atrium::test {

/// Samples `light` on a map of width x height tiles; `level(u, v)` of each tile, below 0 = unused. The image has `margin`
/// rows and columns of glaring samples between the tiles: whoever reads past a tile's edge shows it.
inline LightMap sampled_map(std::uint32_t width, std::uint32_t height, const std::function<int(int u, int v)>& level,
                            const std::function<Rgb(const vec2& uv)>& light, std::uint32_t margin = 1) {
    LightMap map;
    map.width = width;
    map.height = height;
    std::uint32_t x = 0, y = 0, row = 0;
    constexpr std::uint32_t kWidth = 300;
    for (int v = 0; v < int(height); ++v) {
        for (int u = 0; u < int(width); ++u) {
            LightMap::Tile tile;
            if (const int k = level(u, v); k >= 0) {
                const std::uint32_t side = (1U << unsigned(k)) + 1;
                if (x + side > kWidth) {
                    x = 0;
                    y += row + margin;
                    row = 0;
                }
                tile = {std::uint16_t(x), std::uint16_t(y), std::uint16_t(k), 1};
                x += side + margin;
                row = std::max(row, side);
            }
            map.tiles.push_back(tile);
        }
    }
    map.image_width = kWidth;
    map.image_height = y + row;
    map.image.assign(std::size_t(map.image_width) * map.image_height, Rgb(90'000.0F, 0.0F, 90'000.0F));
    for (std::size_t t = 0; t < map.tiles.size(); ++t) {
        const LightMap::Tile& tile = map.tiles[t];
        const std::uint32_t n = 1U << tile.level;
        for (std::uint32_t j = 0; tile.used != 0 && j <= n; ++j) {
            for (std::uint32_t i = 0; i <= n; ++i) {
                const vec2 uv(float(t % width) + float(i) / float(n), float(t / width) + float(j) / float(n));
                map.image[(tile.y + j) * std::size_t(map.image_width) + tile.x + i] = light(uv);
            }
        }
    }
    return map;
}

/// Gives the vertices of a mesh in its own plane z = 0 chart coordinates: (position.xy - corner) * tiles_per_metre.
inline void chart_plane(DisplayMesh& mesh, const vec2& corner, float tiles_per_metre) {
    mesh.light_uv.clear();
    for (const vec3& p : mesh.positions) {
        mesh.light_uv.push_back((vec2(p.x, p.y) - corner) * tiles_per_metre);
    }
}

/// Irradiance on a vertex with everything that reaches it, also from the light map.
inline Rgb light_on(const SurfaceLayer& layer, std::size_t vertex, bool back = false) {
    const auto i = std::uint32_t(vertex);
    return irradiance_at(layer, {i, i, i}, vec3(1.0F, 0.0F, 0.0F), back);
}

} // namespace atrium::test
