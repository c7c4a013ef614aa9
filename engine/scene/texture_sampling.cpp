#include "engine/scene/texture_sampling.h"

#include <algorithm>
#include <array>

namespace atrium {
namespace {

const std::array<float, 256>& srgb_table() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i) {
            t[i] = srgb_to_linear(float(i) / 255.0F);
        }
        return t;
    }();
    return table;
}

int wrap(int i, int size, Texture::Wrap mode) {
    switch (mode) {
    case Texture::Wrap::ClampToEdge: return std::clamp(i, 0, size - 1);
    case Texture::Wrap::MirroredRepeat: {
        const int period = ((i % (2 * size)) + 2 * size) % (2 * size);
        return period < size ? period : 2 * size - 1 - period;
    }
    case Texture::Wrap::Repeat: break;
    }
    return ((i % size) + size) % size;
}

vec4 texel(const Image& image, int x, int y) {
    const std::size_t at = (std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * std::size_t(image.channels);
    vec4 c(0.0F, 0.0F, 0.0F, 1.0F);
    if (!image.bytes.empty()) {
        const auto color = [&](int k) { return srgb_table()[image.bytes[at + std::size_t(k)]]; };
        c = image.channels >= 3 ? vec4(color(0), color(1), color(2), 1.0F) : vec4(vec3(color(0)), 1.0F);
        if (image.channels == 4 || image.channels == 2) {
            c.a = float(image.bytes[at + std::size_t(image.channels) - 1]) / 255.0F;
        }
    } else {
        const auto value = [&](int k) { return image.floats[at + std::size_t(k)]; };
        c = image.channels >= 3 ? vec4(value(0), value(1), value(2), 1.0F) : vec4(vec3(value(0)), 1.0F);
        if (image.channels == 4 || image.channels == 2) {
            c.a = value(image.channels - 1);
        }
    }
    return c;
}

} // namespace

vec4 sample_texture(const Texture& texture, const vec2& uv) {
    if (!texture.image || texture.image->width <= 0 || texture.image->height <= 0 || !is_finite(uv)) {
        return vec4(1.0F);
    }
    const Image& image = *texture.image;
    // Whole periods are taken off first, so that large coordinates stay exact enough and inside int.
    const vec2 wrapped = uv - vec2(texture.wrap_u == Texture::Wrap::ClampToEdge ? 0.0F : 2.0F * std::floor(uv.x * 0.5F),
                                   texture.wrap_v == Texture::Wrap::ClampToEdge ? 0.0F : 2.0F * std::floor(uv.y * 0.5F));
    const float x = std::clamp(wrapped.x, -4.0F, 4.0F) * float(image.width) - 0.5F;
    const float y = std::clamp(wrapped.y, -4.0F, 4.0F) * float(image.height) - 0.5F;
    const auto at = [&](int i, int j) {
        return texel(image, wrap(i, image.width, texture.wrap_u), wrap(j, image.height, texture.wrap_v));
    };
    if (texture.nearest) {
        return at(int(std::floor(x + 0.5F)), int(std::floor(y + 0.5F)));
    }
    const int i = int(std::floor(x));
    const int j = int(std::floor(y));
    const float fx = x - float(i);
    const float fy = y - float(j);
    return (at(i, j) * (1.0F - fx) + at(i + 1, j) * fx) * (1.0F - fy) +
           (at(i, j + 1) * (1.0F - fx) + at(i + 1, j + 1) * fx) * fy;
}

} // namespace atrium
