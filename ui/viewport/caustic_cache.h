// Caustic textures on the GPU: all of a surface side in one image and a small table of their rectangles.
#pragma once

#include "engine/layers/surface_layer.h"
#include "ui/viewport/gl.h"

#include <QElapsedTimer>

#include <map>
#include <memory>
#include <set>
#include <vector>

namespace atrium::ui {

/// The textures of one surface side, as SurfaceLayer holds them.
using CausticList = std::vector<std::shared_ptr<const CausticTexture>>;

/// Where textures lie in an image that holds them all, texels.
struct CausticPlaces {
    struct Place {
        std::uint32_t x = 0, y = 0;
    };
    std::vector<Place> places; ///< by texture; empty = they do not fit
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};
/// Packs textures on shelves of an image about as wide as high, at most `largest_side`.
CausticPlaces place_caustics(const CausticList& list, std::uint32_t largest_side);

/// Holds nothing, and does nothing, for sides without textures. All functions need the context current, but for those that
/// say otherwise. UI thread only.
class CausticCache {
public:
    /// A side's textures ready to be sampled.
    struct Texture {
        unsigned image = 0;         ///< RGB16F: irradiance / scale, bilinear
        unsigned boxes = 0;         ///< RGBA32F, two texels a row: rectangle (low, high), place in the image (x, y, w, h)
        float scale = 0.0F;         ///< lux per unit of the image
        int count = 0;              ///< of rectangles
        vec2 low{0.0F}, high{0.0F}; ///< around all rectangles
    };

    void initialize(Gl& gl);
    void release(Gl& gl);

    /// Starts a frame: uploads may take a little time again.
    void begin_frame();
    /// True when a side was left for the next frame.
    [[nodiscard]] bool pending() const { return pending_; }
    /// The side's textures, uploaded on first use; null without any, while this frame's time does not suffice, and for more
    /// than a texture of this driver holds (see too_large()).
    const Texture* get(Gl& gl, const CausticList& list);
    /// Works on an upload for a few milliseconds; true when the side is ready (or too large).
    bool upload_some(Gl& gl, const CausticList& list);
    /// True when the side is on the GPU or never will be. Needs no context.
    [[nodiscard]] bool ready(const CausticList& list) const;
    /// True for what no texture of this driver holds. Needs no context.
    [[nodiscard]] bool too_large(const CausticList& list) const;

    /// Frees the sides that are not in `wanted`.
    void collect(Gl& gl, const std::set<CausticList>& wanted);
    [[nodiscard]] std::size_t size() const { return entries_.size(); }

private:
    struct Entry {
        Texture texture;
        CausticPlaces places;
        float largest = 0.0F;           ///< of the textures looked at, lux
        std::size_t scanned = 0;        ///< textures looked at as a whole
        std::size_t texels_scanned = 0; ///< of the next one
        std::size_t sent = 0;           ///< textures sent as a whole
        std::uint32_t rows_sent = 0;    ///< of the next one
        bool complete = false;
    };
    void work(Gl& gl, const CausticList& list, Entry& entry, double budget_ms);

    /// The key keeps the textures alive, so that an address is never taken for another.
    std::map<CausticList, Entry> entries_;
    std::vector<std::uint16_t> halves_; ///< of one slice
    std::uint32_t largest_side_ = 0;
    double spent_ms_ = 0; ///< on uploads in this frame
    bool pending_ = false;
};

} // namespace atrium::ui
