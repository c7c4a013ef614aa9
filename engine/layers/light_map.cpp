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

namespace {

// Integral of the hat function around sample i (unit spacing) over [a, b].
float hat_integral(int i, float a, float b) {
    const float x0 = std::max(a - float(i), -1.0F), x1 = std::min(b - float(i), 1.0F);
    const auto from_left = [](float x) { return x < 0.0F ? 0.5F * (1.0F + x) * (1.0F + x) : 0.5F + x - 0.5F * x * x; };
    return x1 > x0 ? from_left(x1) - from_left(x0) : 0.0F;
}

} // namespace

Rgb LightMap::mean(const vec2& lo, const vec2& hi) const {
    if (!(hi.x > lo.x) || !(hi.y > lo.y)) {
        return irradiance(lo);
    }
    const auto inside = [](float x, std::uint32_t count) { return std::clamp(int(std::floor(x)), 0, int(count) - 1); };
    dvec3 sum(0.0);
    double area = 0.0;
    for (int v = inside(lo.y, height); v <= inside(hi.y, height) && !tiles.empty(); ++v) {
        for (int u = inside(lo.x, width); u <= inside(hi.x, width); ++u) {
            const Tile& tile = tiles[std::size_t(v) * width + std::size_t(u)];
            const float n = float(1 << tile.level);
            const vec2 a = glm::clamp(lo - vec2(float(u), float(v)), vec2(0.0F), vec2(1.0F)) * n;
            const vec2 b = glm::clamp(hi - vec2(float(u), float(v)), vec2(0.0F), vec2(1.0F)) * n;
            if (tile.used == 0 || !(b.x > a.x) || !(b.y > a.y)) {
                continue;
            }
            dvec3 part(0.0);
            for (int j = int(a.y); j <= int(std::ceil(b.y)); ++j) {
                const Rgb* row = &image[(std::size_t(tile.y) + std::size_t(j)) * image_width + tile.x];
                dvec3 along(0.0);
                for (int i = int(a.x); i <= int(std::ceil(b.x)); ++i) {
                    along += dvec3(row[i]) * double(hat_integral(i, a.x, b.x));
                }
                part += along * double(hat_integral(j, a.y, b.y));
            }
            sum += part / (double(n) * n);
            area += double(b.x - a.x) * double(b.y - a.y) / (double(n) * n);
        }
    }
    return area > 0.0 ? Rgb(sum / area) : Rgb(0.0F);
}

} // namespace atrium
