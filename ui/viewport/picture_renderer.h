// One frame of the viewport: the scene's picture (kept while nothing changes), outlines and flat overlays over it.
#pragma once

#include "ui/viewport/gpu_scene.h"
#include "ui/viewport/overlay_batch.h"
#include "ui/viewport/scene_figures.h"
#include "ui/viewport/specular_overlay.h"

#include <QImage>

#include <optional>
#include <span>
#include <unordered_set>

namespace atrium::ui {

/// A small picture over the view: a legend, a label.
struct Plate {
    QImage image;        ///< device pixels, Format_RGBA8888_Premultiplied
    dvec2 top_left{0.0}; ///< logical pixels from the view's top left corner
};

/// What paint() needs to know; references are good for the call only.
struct FrameInput {
    const Scene& scene;
    const ViewScene& view;
    const CameraController& camera;
    const OverlayBatch& overlay;
    const std::unordered_set<NodeId>& selected; ///< with everything below them
    const std::unordered_set<NodeId>& hovered;
    float exposure = 1.0F; ///< factor on radiance
    LightShares shares;    ///< of the light to show
    bool wireframe = false;
    bool caustic_boxes = false; ///< outline the caustic textures
    bool texel_grid = false;    ///< and the texels of those of the selected nodes
    std::shared_ptr<const std::vector<SurfaceLandings>>
        landings;                          ///< of which those of the selected nodes are drawn; or null
    std::span<const ShownFigures> figures; ///< in the scene
    std::optional<FalseColor> false_color; ///< amounts of light instead of the picture
    std::span<const Plate> plates;         ///< over everything else, in this order
    bool refine = false;                   ///< edges as smooth and clean as there is time for when the view rests
    int width = 1;                         ///< device pixels
    int height = 1;
    double pixel_ratio = 1.0;
    unsigned framebuffer = 0;                            ///< to draw into
    std::shared_ptr<const SpecularPixels> specular = {}; ///< traced mirrors and glass of this very view; or null
};

/// Context current in every function but the constructor and the invalidate functions. UI thread only.
class PictureRenderer {
public:
    bool initialize(Gl& gl);
    void release();

    void invalidate_picture() { picture_good_ = mask_good_ = unhurried_ = false; } ///< camera, geometry, light, exposure
    void invalidate_mask() { mask_good_ = false; }                                 ///< selection or hover changed
    void invalidate_probe() { probe_face_ = 0; }                                   ///< what mirrors show changed
    void invalidate_items() { items_good_ = false; }                               ///< the view scene was synchronised

    void paint(const FrameInput& in);

    /// Does a part of the work on the reflection probe; call until it returns false.
    bool step_probe(const ViewScene& view, const Scene& scene, float exposure, const LightShares& shares);

    /// Uploads a solution's light maps and caustics before it is shown, a few milliseconds at a time; true when all are
    /// there.
    bool upload_ahead(const Solution& solution) { return gl_ == nullptr || gpu_.upload_ahead(solution); }
    /// True when nothing of it is left to be uploaded ahead. Needs no context.
    [[nodiscard]] bool uploaded(const Solution& solution) const { return gl_ == nullptr || gpu_.uploaded(solution); }
    /// Nothing is awaited any more. Needs no context.
    void forget_awaited() { gpu_.forget_awaited(); }

    /// True on a software rasteriser, where the interactive picture has no smoothed edges.
    [[nodiscard]] bool software() const { return software_; }
    /// True when the last picture lacks something that the next one shows.
    [[nodiscard]] bool incomplete() const { return !picture_good_; }
    /// True when the last picture would gain from `refine` and is quick enough to draw that nobody waits for it.
    [[nodiscard]] bool wants_refining() const {
        return !picture_refined_ && (!software_ || (picture_samples_ == 0 && picture_milliseconds_ < kQuickEnough));
    }
    /// The next refined picture takes the time that it takes, also on a software rasteriser; until something changes.
    void take_time() { unhurried_ = true; }
    /// Number of times that the scene itself was drawn, for tests and measurements.
    [[nodiscard]] int pictures_drawn() const { return pictures_drawn_; }

private:
    void draw_picture(const FrameInput& in, const DrawView& from, int samples, int scale);
    void draw_outlines(const FrameInput& in, const DrawView& from);
    void draw_overlay(const FrameInput& in);
    void draw_plates(const FrameInput& in);

    static constexpr unsigned kProbeFaces = 6;
    /// Milliseconds of a picture without smoothed edges on a software rasteriser, below which it is smoothed at rest: by
    /// several samples a pixel, for at twice the size it would take four times as long.
    static constexpr double kQuickEnough = 150.0;
    Gl* gl_ = nullptr;
    GpuScene gpu_;
    SceneFigures figures_;
    GlTarget picture_;
    GlTarget resolved_;
    GlTarget mask_;
    SpecularLayer specular_;
    std::unique_ptr<QOpenGLShaderProgram> outline_;
    std::unique_ptr<QOpenGLShaderProgram> overlay_;
    std::unique_ptr<QOpenGLShaderProgram> plate_;
    unsigned plate_texture_ = 0;
    unsigned overlay_array_ = 0;
    unsigned overlay_buffer_ = 0;
    unsigned empty_array_ = 0;
    bool software_ = false;
    bool picture_good_ = false;
    bool mask_good_ = false;
    unsigned probe_face_ = 0; ///< next face to draw; kProbeFaces = up to date
    bool items_good_ = false;
    int picture_samples_ = 0;
    int picture_width_ = 0; ///< as shown
    int picture_height_ = 0;
    bool picture_refined_ = false; ///< drawn at twice the size
    int pictures_drawn_ = 0;
    double picture_milliseconds_ = 0; ///< of the last picture without smoothed edges on a software rasteriser
    bool unhurried_ = false;
};

} // namespace atrium::ui
