#include "engine/solver/light_map_codec.h"

#include "engine/base/half.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace atrium {
namespace {

/// One channel of the image, as integers that are alike where the light is. Halves of one sign are in the order of their
/// bits, so differences of bits are small where differences of light are.
using Channel = std::vector<std::int16_t>;

/// What a sample probably is, from those before it: the median of left, above, and the plane through left, above and the
/// one between them (as in lossless JPEG). It follows slopes and jumps to the other side of an edge at once.
int predicted(const Channel& channel, std::size_t width, std::size_t x, std::size_t y) {
    const std::size_t at = y * width + x;
    if (x == 0 || y == 0) {
        return x != 0 ? channel[at - 1] : (y != 0 ? channel[at - width] : 0);
    }
    const int left = channel[at - 1], above = channel[at - width], corner = channel[at - width - 1];
    return std::clamp(left + above - corner, std::min(left, above), std::max(left, above));
}

// Small differences of either sign become small numbers: their upper byte is 0.
std::uint16_t folded(std::int16_t v) { return std::uint16_t((std::uint32_t(v) << 1U) ^ (v < 0 ? 0xFFFFU : 0U)); }
std::int16_t unfolded(std::uint16_t v) { return std::int16_t((v >> 1U) ^ ((v & 1U) != 0 ? 0xFFFFU : 0U)); }

} // namespace

void write_light_map(ByteWriter& out, const LightMap& map) {
    float largest = 0.0F;
    for (const Rgb& e : map.image) {
        for (int c = 0; c < 3; ++c) {
            largest = std::max(largest, std::abs(e[c]));
        }
    }
    const int exponent = half_scale_exponent(largest);
    const float scale = std::ldexp(1.0F, -exponent);
    out.value(map.width);
    out.value(map.height);
    out.planes(std::span<const LightMap::Tile>(map.tiles));
    out.value(map.image_width);
    out.value(map.image_height);
    out.value(std::int32_t(exponent));
    // Green, then red and blue less green: under white light these are zero.
    const std::size_t count = map.image.size();
    Channel channel(count);
    std::vector<std::uint16_t> residuals(count);
    for (const int c : {1, 0, 2}) {
        for (std::size_t i = 0; i < count; ++i) {
            const Rgb e = map.image[i] * scale;
            const int base = c == 1 ? 0 : half_from_float(e.g);
            channel[i] = std::int16_t(std::uint16_t(half_from_float(e[c]) - base));
        }
        for (std::size_t y = 0, i = 0; y < map.image_height; ++y) {
            for (std::size_t x = 0; x < map.image_width; ++x, ++i) {
                residuals[i] = folded(std::int16_t(std::uint16_t(channel[i] - predicted(channel, map.image_width, x, y))));
            }
        }
        out.planes(std::span<const std::uint16_t>(residuals));
    }
}

bool read_light_map(ByteReader& in, LightMap& map) {
    std::int32_t exponent = 0;
    if (!in.value(map.width) || !in.value(map.height) ||
        !in.planes(map.tiles, std::uint64_t(map.width) * std::uint64_t(map.height)) || !in.value(map.image_width) ||
        !in.value(map.image_height) || !in.value(exponent) || exponent < -110 || exponent > 113) {
        return false;
    }
    for (const LightMap::Tile& tile : map.tiles) {
        if (tile.used != 0 && (tile.level > kFinestLevel || std::uint32_t(tile.x) + (1U << tile.level) >= map.image_width ||
                               std::uint32_t(tile.y) + (1U << tile.level) >= map.image_height)) {
            return false;
        }
    }
    const std::uint64_t count = std::uint64_t(map.image_width) * std::uint64_t(map.image_height);
    std::array<std::vector<std::uint16_t>, 3> residuals;
    for (auto& one : residuals) {
        if (!in.planes(one, count)) {
            return false;
        }
    }
    const double scale = std::ldexp(1.0, exponent);
    map.image.resize(count);
    std::vector<std::uint16_t> green(count);
    Channel channel(count);
    for (const int c : {1, 0, 2}) {
        const auto& residual = residuals[c == 1 ? 0 : (c == 0 ? 1 : 2)];
        for (std::size_t y = 0, i = 0; y < map.image_height; ++y) {
            for (std::size_t x = 0; x < map.image_width; ++x, ++i) {
                channel[i] = std::int16_t(std::uint16_t(predicted(channel, map.image_width, x, y) + unfolded(residual[i])));
                const auto bits = std::uint16_t(channel[i] + (c == 1 ? 0 : green[i]));
                if (c == 1) {
                    green[i] = bits;
                }
                if (!half_is_finite(bits)) {
                    return false;
                }
                const double value = double(float_from_half(bits)) * scale;
                if (std::abs(value) > double(std::numeric_limits<float>::max())) {
                    return false;
                }
                map.image[i][c] = float(value);
            }
        }
    }
    return true;
}

} // namespace atrium
