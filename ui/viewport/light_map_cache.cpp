#include "ui/viewport/light_map_cache.h"

#include "engine/base/half.h"

#include <algorithm>
#include <array>

namespace atrium::ui {
namespace {

/// Uploads of one frame, or of one turn of the event loop, milliseconds.
constexpr double kUploadMs = 6.0;

/// Samples between two looks at the clock: well below a millisecond.
constexpr std::uint32_t kSlice = 1U << 15U;

double milliseconds(const QElapsedTimer& clock) { return double(clock.nsecsElapsed()) * 1e-6; }

/// LightMap::Tile is four 16-bit numbers in a row: a texel as it is.
unsigned tile_table(Gl& gl, std::uint32_t width, std::uint32_t height, const LightMap::Tile* tiles) {
    static_assert(sizeof(LightMap::Tile) == 4 * sizeof(std::uint16_t));
    const unsigned name = new_texture(gl, GL_NEAREST);
    gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16UI, GLsizei(width), GLsizei(height), 0, GL_RGBA_INTEGER, GL_UNSIGNED_SHORT,
                    tiles);
    return name;
}

} // namespace

void LightMapCache::initialize(Gl& gl) {
    gl.glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest_side_);
    const LightMap::Tile unused;
    const std::array<std::uint16_t, 3> black{};
    dark_.tiles = tile_table(gl, 1, 1, &unused);
    dark_.image = new_texture(gl, GL_LINEAR);
    gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB16F, 1, 1, 0, GL_RGB, GL_HALF_FLOAT, black.data());
}

void LightMapCache::free(Gl& gl, const Entry& entry) {
    gl.glDeleteTextures(1, &entry.texture.image);
    gl.glDeleteTextures(1, &entry.texture.tiles);
}

void LightMapCache::release(Gl& gl) {
    for (auto& [key, entry] : entries_) {
        free(gl, entry);
    }
    entries_.clear();
    gl.glDeleteTextures(1, &dark_.image);
    gl.glDeleteTextures(1, &dark_.tiles);
    dark_ = {};
}

void LightMapCache::begin_frame() {
    spent_ms_ = 0;
    pending_ = false;
}

bool LightMapCache::too_large(const LightMap& map) const {
    const auto most = std::uint32_t(largest_side_);
    return std::max(map.image_width, map.image_height) > most || std::max(map.width, map.height) > most;
}

bool LightMapCache::ready(const LightMap& map) const {
    const auto found = entries_.find(&map);
    return map.image.empty() || too_large(map) || (found != entries_.end() && found->second.complete());
}

const LightMapCache::Texture* LightMapCache::get(Gl& gl, const std::shared_ptr<const LightMap>& map) {
    if (!map || map->image.empty() || too_large(*map)) {
        return nullptr;
    }
    Entry& entry = entries_[map.get()];
    entry.map = map;
    if (!entry.complete() && spent_ms_ < kUploadMs) {
        QElapsedTimer clock;
        clock.start();
        work(gl, entry, clock, kUploadMs - spent_ms_);
        spent_ms_ += milliseconds(clock);
    }
    if (!entry.complete()) {
        pending_ = true;
        return nullptr;
    }
    return &entry.texture;
}

bool LightMapCache::upload_some(Gl& gl, const std::shared_ptr<const LightMap>& map) {
    if (!ready(*map)) {
        QElapsedTimer clock;
        clock.start();
        Entry& entry = entries_[map.get()];
        entry.map = map;
        work(gl, entry, clock, kUploadMs);
    }
    return ready(*map);
}

void LightMapCache::work(Gl& gl, Entry& entry, const QElapsedTimer& clock, double budget_ms) {
    const LightMap& map = *entry.map;
    const std::uint32_t rows = std::max(kSlice / std::max(map.image_width, 1U), 1U);
    const auto end_of = [&](std::uint32_t row) { return std::min(row + rows, map.image_height); };
    while (entry.rows_scanned < map.image_height) {
        const std::uint32_t end = end_of(entry.rows_scanned);
        for (std::size_t i = std::size_t(entry.rows_scanned) * map.image_width; i < std::size_t(end) * map.image_width;
             ++i) {
            entry.largest = std::max(entry.largest, max_component(map.image[i]));
        }
        entry.rows_scanned = end;
        if (milliseconds(clock) > budget_ms) {
            return;
        }
    }
    const int exponent = half_scale_exponent(entry.largest);
    const float inverse = std::ldexp(1.0F, -exponent);
    if (entry.texture.image == 0) {
        entry.texture.scale = std::ldexp(1.0F, exponent);
        entry.texture.tiles = tile_table(gl, map.width, map.height, map.tiles.data());
        entry.texture.image = new_texture(gl, GL_LINEAR);
        gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB16F, GLsizei(map.image_width), GLsizei(map.image_height), 0, GL_RGB,
                        GL_HALF_FLOAT, nullptr);
    }
    gl.glBindTexture(GL_TEXTURE_2D, entry.texture.image);
    gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    while (entry.rows_sent < map.image_height && milliseconds(clock) <= budget_ms) {
        const std::uint32_t end = end_of(entry.rows_sent);
        halves_.clear();
        for (std::size_t i = std::size_t(entry.rows_sent) * map.image_width; i < std::size_t(end) * map.image_width; ++i) {
            for (int c = 0; c < 3; ++c) {
                halves_.push_back(half_from_float(map.image[i][c] * inverse));
            }
        }
        gl.glTexSubImage2D(GL_TEXTURE_2D, 0, 0, GLint(entry.rows_sent), GLsizei(map.image_width),
                           GLsizei(end - entry.rows_sent), GL_RGB, GL_HALF_FLOAT, halves_.data());
        entry.rows_sent = end;
    }
}

void LightMapCache::collect(Gl& gl, const std::unordered_set<const LightMap*>& wanted) {
    std::erase_if(entries_, [&](auto& item) {
        const bool gone = !wanted.contains(item.first);
        if (gone) {
            free(gl, item.second);
        }
        return gone;
    });
}

} // namespace atrium::ui
