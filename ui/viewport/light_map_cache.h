// Light maps on the GPU: an image of the samples and a small table of the tiles, uploaded a slice at a time.
#pragma once

#include "engine/layers/light_map.h"
#include "ui/viewport/gl.h"

#include <QElapsedTimer>

#include <memory>
#include <unordered_map>
#include <unordered_set>

namespace atrium::ui {

/// All functions need the context current, but for those that say otherwise. UI thread only.
class LightMapCache {
public:
    /// A map ready to be sampled.
    struct Texture {
        unsigned image = 0; ///< RGB16F: irradiance / scale, bilinear
        unsigned tiles = 0; ///< RGBA16UI, one texel per tile: x, y, level, used
        float scale = 0.0F; ///< lux per unit of the image
    };

    /// Asks the driver for its limits and makes the texture of no light.
    void initialize(Gl& gl);
    void release(Gl& gl);

    /// Starts a frame: uploads may take a little time again.
    void begin_frame();
    /// True when a map was left for the next frame.
    [[nodiscard]] bool pending() const { return pending_; }
    /// The map's textures, uploaded on first use; null while this frame's time does not suffice, and for a map that is
    /// larger than the driver's textures (see too_large()).
    const Texture* get(Gl& gl, const std::shared_ptr<const LightMap>& map);
    /// Works on an upload for a few milliseconds; true when the map is ready (or too large). For light that is shown once
    /// all of it is there.
    bool upload_some(Gl& gl, const std::shared_ptr<const LightMap>& map);

    /// True when the map is on the GPU or never will be. Needs no context.
    [[nodiscard]] bool ready(const LightMap& map) const;
    /// True for a map whose image no texture of this driver holds. Needs no context.
    [[nodiscard]] bool too_large(const LightMap& map) const;
    /// Stands for a side without direct light: one unused tile.
    [[nodiscard]] const Texture& dark() const { return dark_; }

    /// Frees the maps that are not in `wanted`.
    void collect(Gl& gl, const std::unordered_set<const LightMap*>& wanted);

private:
    struct Entry {
        std::shared_ptr<const LightMap> map; ///< keeps the key alive, so that an address is never taken for another
        Texture texture;
        float largest = 0.0F;           ///< of the rows looked at, lux
        std::uint32_t rows_scanned = 0; ///< first all rows are looked at: they share one scale
        std::uint32_t rows_sent = 0;
        [[nodiscard]] bool complete() const { return texture.image != 0 && rows_sent == map->image_height; }
    };
    /// Goes on with an upload until it is complete or `budget_ms` are spent on the clock.
    void work(Gl& gl, Entry& entry, const QElapsedTimer& clock, double budget_ms);
    static void free(Gl& gl, const Entry& entry);

    std::unordered_map<const LightMap*, Entry> entries_;
    std::vector<std::uint16_t> halves_; ///< of one slice
    Texture dark_;
    int largest_side_ = 0;
    double spent_ms_ = 0; ///< on uploads in this frame
    bool pending_ = false;
};

} // namespace atrium::ui
