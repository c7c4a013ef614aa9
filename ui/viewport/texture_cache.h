// Textures of the scene on the GPU: sRGB decoding and mipmaps by the hardware, rows as in glTF (v = 0 is the first row).
#pragma once

#include "engine/scene/scene.h"
#include "ui/viewport/gl.h"

#include <unordered_map>

namespace atrium::ui {

/// All functions need the context current.
class TextureCache {
public:
    /// Starts a frame: uploads may take a little time again.
    void begin_frame();
    /// True when a texture was left for the next frame.
    [[nodiscard]] bool pending() const { return pending_; }
    /// GL name of a texture, uploaded on first use or when its image was exchanged; 0 when it has no image, or when this
    /// frame has spent its time on others.
    unsigned get(Gl& gl, const Scene& scene, TextureId id);
    /// Drops textures that the scene no longer has.
    void collect(Gl& gl, const Scene& scene);
    void release(Gl& gl);

private:
    struct Entry {
        std::shared_ptr<const Image> image;
        Texture::Wrap wrap_u = Texture::Wrap::Repeat;
        Texture::Wrap wrap_v = Texture::Wrap::Repeat;
        bool nearest = false;
        unsigned name = 0;
    };
    std::unordered_map<TextureId, Entry> entries_;
    double spent_ms_ = 0; ///< on uploads in this frame
    bool pending_ = false;
};

} // namespace atrium::ui
