#include "engine/layers/light_map.h"

#include <algorithm>

namespace atrium {

Rgb LightMap::irradiance(const vec2& uv) const {
    if (tiles.empty()) {
        return Rgb(0.0F);
    }
    const auto inside = [](float x, std::uint32_t count) { return std::clamp(int(std::floor(x)), 0, int(count) - 1); };
    int tu = inside(uv.x, width), tv = inside(uv.y, height);
    const auto tile_at = [&](int u, int v) -> const Tile& { return tiles[std::size_t(v) * width + std::size_t(u)]; };
    if (tile_at(tu, tv).used == 0) {
        float nearest = std::numeric_limits<float>::infinity();
        int best_u = -1, best_v = -1;
        for (int v = std::max(tv - 1, 0); v <= std::min(tv + 1, int(height) - 1); ++v) {
            for (int u = std::max(tu - 1, 0); u <= std::min(tu + 1, int(width) - 1); ++u) {
                const vec2 d = uv - glm::clamp(uv, vec2(float(u), float(v)), vec2(float(u + 1), float(v + 1)));
                const float distance = d.x * d.x + d.y * d.y;
                if (tile_at(u, v).used != 0 && distance < nearest) {
                    nearest = distance;
                    best_u = u;
                    best_v = v;
                }
            }
        }
        if (best_u < 0) {
            return Rgb(0.0F);
        }
        tu = best_u;
        tv = best_v;
    }
    const Tile& tile = tile_at(tu, tv);
    const int n = 1 << tile.level;
    const float x = std::clamp(uv.x - float(tu), 0.0F, 1.0F) * float(n);
    const float y = std::clamp(uv.y - float(tv), 0.0F, 1.0F) * float(n);
    const int ix = std::min(int(x), n - 1), iy = std::min(int(y), n - 1);
    const float fx = x - float(ix), fy = y - float(iy);
    const Rgb* row = &image[(std::size_t(tile.y) + std::size_t(iy)) * image_width + tile.x + std::size_t(ix)];
    const Rgb* next = row + image_width;
    return (row[0] * (1.0F - fx) + row[1] * fx) * (1.0F - fy) + (next[0] * (1.0F - fx) + next[1] * fx) * fy;
}

} // namespace atrium
