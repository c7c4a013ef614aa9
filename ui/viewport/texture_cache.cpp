#include "ui/viewport/texture_cache.h"

#include <QElapsedTimer>

#include <algorithm>
#include <vector>

namespace atrium::ui {
namespace {

/// Pictures are halved until no side is longer: a room has dozens of textures, and no screen shows more of one.
constexpr int kLargestSide = 4096;

/// Uploads of one frame, milliseconds; one texture is always taken, so that all get their turn.
constexpr double kUploadMs = 20.0;

GLint wrap_mode(Texture::Wrap wrap) {
    switch (wrap) {
    case Texture::Wrap::Repeat: return GL_REPEAT;
    case Texture::Wrap::MirroredRepeat: return GL_MIRRORED_REPEAT;
    case Texture::Wrap::ClampToEdge: return GL_CLAMP_TO_EDGE;
    }
    return GL_REPEAT;
}

/// RGBA samples of a picture with 1 (grey), 2 (grey, alpha), 3 or 4 channels, every `step`-th row and column.
template <class T> std::vector<T> to_rgba(const std::vector<T>& samples, const Image& image, int step, T opaque) {
    const int width = image.width / step;
    const int height = image.height / step;
    std::vector<T> out(std::size_t(width) * std::size_t(height) * 4);
    T* to = out.data();
    const auto channels = std::size_t(image.channels);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x, to += 4) {
            const T* from = &samples[(std::size_t(y * step) * std::size_t(image.width) + std::size_t(x * step)) * channels];
            const bool grey = channels < 3;
            to[0] = from[0];
            to[1] = from[grey ? 0 : 1];
            to[2] = from[grey ? 0 : 2];
            to[3] = channels == 4 ? from[3] : (channels == 2 ? from[1] : opaque);
        }
    }
    return out;
}

} // namespace

void TextureCache::begin_frame() {
    spent_ms_ = 0;
    pending_ = false;
}

unsigned TextureCache::get(Gl& gl, const Scene& scene, TextureId id) {
    const Texture* texture = scene.textures.find(id);
    if (texture == nullptr || !texture->image) {
        return 0;
    }
    const Image& image = *texture->image;
    const auto samples = std::size_t(std::max(image.width, 0)) * std::size_t(std::max(image.height, 0)) *
                         std::size_t(std::max(image.channels, 0));
    if (samples == 0 || image.channels > 4 || std::max(image.bytes.size(), image.floats.size()) < samples) {
        return 0;
    }
    Entry& entry = entries_[id];
    if (entry.name != 0 && entry.image == texture->image && entry.wrap_u == texture->wrap_u &&
        entry.wrap_v == texture->wrap_v && entry.nearest == texture->nearest) {
        return entry.name;
    }
    if (spent_ms_ > kUploadMs) {
        pending_ = true;
        return 0;
    }
    QElapsedTimer clock;
    clock.start();
    gl.glDeleteTextures(1, &entry.name);
    entry = {texture->image, texture->wrap_u, texture->wrap_v, texture->nearest, 0};
    gl.glGenTextures(1, &entry.name);
    gl.glBindTexture(GL_TEXTURE_2D, entry.name);
    gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    int step = 1;
    while (std::max(image.width, image.height) / step > kLargestSide && std::min(image.width, image.height) / step > 1) {
        step *= 2;
    }
    const int width = image.width / step;
    const int height = image.height / step;
    if (!image.bytes.empty()) {
        const auto rgba = to_rgba<std::uint8_t>(image.bytes, image, step, 255);
        gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    } else {
        const auto rgba = to_rgba<float>(image.floats, image, step, 1.0F);
        gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, width, height, 0, GL_RGBA, GL_FLOAT, rgba.data());
    }
    gl.glGenerateMipmap(GL_TEXTURE_2D);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap_mode(texture->wrap_u));
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap_mode(texture->wrap_v));
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                       texture->nearest ? GL_NEAREST_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_LINEAR);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, texture->nearest ? GL_NEAREST : GL_LINEAR);
    spent_ms_ += double(clock.nsecsElapsed()) * 1e-6;
    return entry.name;
}

void TextureCache::collect(Gl& gl, const Scene& scene) {
    std::erase_if(entries_, [&](auto& item) {
        const bool gone = !scene.textures.contains(item.first);
        if (gone) {
            gl.glDeleteTextures(1, &item.second.name);
        }
        return gone;
    });
}

void TextureCache::release(Gl& gl) {
    for (auto& [id, entry] : entries_) {
        gl.glDeleteTextures(1, &entry.name);
    }
    entries_.clear();
}

} // namespace atrium::ui
