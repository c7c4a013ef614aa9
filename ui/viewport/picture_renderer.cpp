#include "ui/viewport/picture_renderer.h"

#include "engine/view/tone.h"

#include <QElapsedTimer>

#include <array>
#include <cstddef>
#include <string_view>

namespace atrium::ui {
namespace {

constexpr int kSamples = 4;           ///< of a picture in motion
constexpr int kRefinedScale = 2;      ///< of one at rest
constexpr float kOutlineWidth = 2.0F; ///< logical pixels

} // namespace

bool PictureRenderer::initialize(Gl& gl) {
    gl_ = &gl;
    const char* renderer = reinterpret_cast<const char*>(gl.glGetString(GL_RENDERER));
    software_ = renderer != nullptr && (std::string_view(renderer).find("llvmpipe") != std::string_view::npos ||
                                        std::string_view(renderer).find("softpipe") != std::string_view::npos);
    outline_ = load_program("outline.vert", "outline.frag");
    overlay_ = load_program("overlay.vert", "overlay.frag");
    plate_ = load_program("plate.vert", "plate.frag");
    if (!gpu_.initialize(gl) || !figures_.initialize(gl) || !specular_.initialize(gl) || !outline_ || !overlay_ || !plate_) {
        return false;
    }
    gl.glGenVertexArrays(1, &empty_array_);
    gl.glGenVertexArrays(1, &overlay_array_);
    gl.glGenBuffers(1, &overlay_buffer_);
    plate_texture_ = new_texture(gl, GL_NEAREST);
    gl.glBindVertexArray(overlay_array_);
    gl.glBindBuffer(GL_ARRAY_BUFFER, overlay_buffer_);
    gl.glEnableVertexAttribArray(0);
    gl.glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(OverlayVertex), nullptr);
    gl.glEnableVertexAttribArray(1);
    gl.glVertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, sizeof(OverlayVertex),
                             reinterpret_cast<const void*>(offsetof(OverlayVertex, color)));
    gl.glBindVertexArray(0);
    picture_good_ = mask_good_ = items_good_ = false;
    probe_face_ = 0;
    return true;
}

void PictureRenderer::release() {
    if (gl_ == nullptr) {
        return;
    }
    gpu_.release();
    figures_.release();
    specular_.release();
    picture_.release(*gl_);
    resolved_.release(*gl_);
    mask_.release(*gl_);
    gl_->glDeleteVertexArrays(1, &empty_array_);
    gl_->glDeleteVertexArrays(1, &overlay_array_);
    gl_->glDeleteBuffers(1, &overlay_buffer_);
    gl_->glDeleteTextures(1, &plate_texture_);
    empty_array_ = overlay_array_ = overlay_buffer_ = plate_texture_ = 0;
    outline_.reset();
    overlay_.reset();
    plate_.reset();
    gl_ = nullptr;
}

void PictureRenderer::paint(const FrameInput& in) {
    if (gl_ == nullptr) {
        return;
    }
    Gl& gl = *gl_;
    if (!items_good_) {
        gpu_.collect(in.view, in.scene);
        items_good_ = true;
    }
    DrawView from;
    from.projection = in.camera.projection();
    from.rotation = in.camera.rotation();
    from.eye = in.camera.eye();
    from.exposure = in.exposure;
    from.cutaway = in.view.cutaway();
    from.shares = in.shares;
    const bool large = in.refine && (!software_ || unhurried_);
    const int samples = large || (software_ && !in.refine) ? 0 : kSamples;
    const bool resized = picture_width_ != in.width || picture_height_ != in.height;
    const bool better = !picture_refined_ && (large || samples > picture_samples_);
    if (!picture_good_ || resized || better) {
        draw_picture(in, from, samples, large ? kRefinedScale : 1);
        mask_good_ = mask_good_ && !resized;
    }
    const GlTarget& shown = picture_samples_ > 0 || picture_refined_ ? resolved_ : picture_;
    gl.glBindFramebuffer(GL_READ_FRAMEBUFFER, shown.framebuffer());
    gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER, in.framebuffer);
    gl.glBlitFramebuffer(0, 0, in.width, in.height, 0, 0, in.width, in.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, in.framebuffer);
    gl.glViewport(0, 0, in.width, in.height);
    specular_.draw(in.specular, in.width, in.height, in.exposure);
    draw_outlines(in, from);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, in.framebuffer);
    gl.glViewport(0, 0, in.width, in.height);
    draw_overlay(in);
    draw_plates(in);
}

bool PictureRenderer::step_probe(const ViewScene& view, const Scene& scene, float exposure, const LightShares& shares) {
    if (gl_ == nullptr || probe_face_ >= kProbeFaces) {
        return false;
    }
    if (probe_face_ == 0 && !gpu_.begin_probe(view, robust_bounds(scene))) {
        probe_face_ = kProbeFaces;
        return false;
    }
    gpu_.draw_probe_face(view, scene, probe_face_++, exposure, shares);
    if (probe_face_ == kProbeFaces) {
        invalidate_picture();
        return false;
    }
    return true;
}

void PictureRenderer::draw_picture(const FrameInput& in, const DrawView& from, int samples, int scale) {
    Gl& gl = *gl_;
    QElapsedTimer clock;
    clock.start();
    // At rest the picture is drawn larger and averaged. Several samples a pixel smooth edges for less, but have one light
    // for all of them: that of the pixel's middle, which may lie behind what is seen (the floor under a skirting board, the
    // wall behind a book), so that bright and dark dots stand along edges.
    const int width = scale * in.width, height = scale * in.height;
    const double ratio = scale * in.pixel_ratio;
    picture_.resize(gl, width, height, samples, GL_RGBA8, true);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, picture_.framebuffer());
    gl.glViewport(0, 0, width, height);
    const Rgb sky = in.scene.environment.sky_radiance;
    // Without a sky the surroundings are a neutral grey, not the black that would be true: one has to find the model.
    const bool lit_sky = max_component(sky) > 0.0F;
    Rgb ground(0.27F);
    if (!in.false_color) {
        ground = lit_sky ? display_color(sky, in.exposure) : ground;
    } else if (lit_sky && in.shares.direct && in.false_color->quantity == LightQuantity::Luminance) {
        ground = false_color(*in.false_color, double(luminance(sky)));
    }
    gl.glClearColor(ground.r, ground.g, ground.b, 1.0F);
    gl.glDepthMask(GL_TRUE);
    gl.glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    DrawView with_background = from;
    with_background.background = ground;
    with_background.false_color = in.false_color ? &*in.false_color : nullptr;
    with_background.line_width = 1.5F * float(ratio);
    with_background.caustic_boxes = in.caustic_boxes;
    with_background.texel_grid = in.texel_grid ? &in.selected : nullptr;
    gpu_.begin_frame();
    gpu_.draw(in.view, in.scene, with_background);
    if (in.wireframe) {
        gpu_.draw_edges(in.view, from);
    }
    gpu_.draw_landings(in.view, from, in.landings, in.selected, float(ratio));
    figures_.draw(in.view, from, in.figures, vec2(width, height), float(ratio));
    if (samples > 0 || scale > 1) {
        resolved_.resize(gl, in.width, in.height, 0, GL_RGBA8, false);
        gl.glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_.framebuffer());
        gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.framebuffer());
        // Halved, a linear filter is the mean of the four.
        gl.glBlitFramebuffer(0, 0, width, height, 0, 0, in.width, in.height, GL_COLOR_BUFFER_BIT,
                             scale > 1 ? GL_LINEAR : GL_NEAREST);
    }
    if (software_) {
        gl.glFinish(); // the work is done on this processor anyway
        if (samples == 0 && scale == 1) {
            picture_milliseconds_ = double(clock.nsecsElapsed()) * 1e-6;
        }
    }
    picture_samples_ = samples;
    picture_refined_ = scale > 1;
    picture_width_ = in.width;
    picture_height_ = in.height;
    picture_good_ = !gpu_.uploads_pending();
    ++pictures_drawn_;
}

void PictureRenderer::draw_outlines(const FrameInput& in, const DrawView& from) {
    if (in.selected.empty() && in.hovered.empty()) {
        return;
    }
    Gl& gl = *gl_;
    gl.glDisable(GL_DEPTH_TEST);
    gl.glDisable(GL_BLEND);
    if (!mask_good_) {
        mask_.resize(gl, in.width, in.height, 0, GL_RG8, false);
        gl.glBindFramebuffer(GL_FRAMEBUFFER, mask_.framebuffer());
        gl.glViewport(0, 0, in.width, in.height);
        gl.glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
        gl.glClear(GL_COLOR_BUFFER_BIT);
        gpu_.draw_mask(in.view, from, vec4(0.0F, 1.0F, 0.0F, 0.0F), [&](const ViewItem& item) {
            return in.hovered.contains(item.node) && !in.selected.contains(item.node);
        });
        gpu_.draw_mask(in.view, from, vec4(1.0F, 0.0F, 0.0F, 0.0F),
                       [&](const ViewItem& item) { return in.selected.contains(item.node); });
        mask_good_ = true;
    }
    gl.glBindFramebuffer(GL_FRAMEBUFFER, in.framebuffer);
    gl.glViewport(0, 0, in.width, in.height);
    // Only the part of the view that the marked things cover.
    bool whole = false;
    dvec2 low(1e30);
    dvec2 high(-1e30);
    for (const ViewItem& item : in.view.items()) {
        if (!in.selected.contains(item.node) && !in.hovered.contains(item.node)) {
            continue;
        }
        const Box3& b = item.bvh->bounds();
        for (int corner = 0; corner < 8; ++corner) {
            const dvec4 p((corner & 1) != 0 ? b.max.x : b.min.x, (corner & 2) != 0 ? b.max.y : b.min.y,
                          (corner & 4) != 0 ? b.max.z : b.min.z, 1.0);
            const auto s = in.camera.project(dvec3(item.world * p));
            whole = whole || !s;
            if (s) {
                low = glm::min(low, *s);
                high = glm::max(high, *s);
            }
        }
    }
    if (!whole) {
        if (low.x > high.x) {
            return;
        }
        const dvec2 limit(in.camera.width(), in.camera.height());
        low = glm::clamp(low - 6.0, dvec2(0.0), limit) * in.pixel_ratio;
        high = glm::clamp(high + 6.0, dvec2(0.0), limit) * in.pixel_ratio;
        gl.glEnable(GL_SCISSOR_TEST);
        gl.glScissor(int(low.x), in.height - int(high.y) - 1, int(high.x - low.x) + 2, int(high.y - low.y) + 2);
    }
    gl.glEnable(GL_BLEND);
    gl.glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    outline_->bind();
    outline_->setUniformValue("u_mask", 0);
    outline_->setUniformValue("u_radius", float(kOutlineWidth * float(in.pixel_ratio)));
    gl.glActiveTexture(GL_TEXTURE0);
    gl.glBindTexture(GL_TEXTURE_2D, mask_.texture());
    gl.glBindVertexArray(empty_array_);
    gl.glDrawArrays(GL_TRIANGLES, 0, 3);
    gl.glBindVertexArray(0);
    outline_->release();
    gl.glDisable(GL_SCISSOR_TEST);
    gl.glDisable(GL_BLEND);
}

void PictureRenderer::draw_overlay(const FrameInput& in) {
    const auto& vertices = in.overlay.vertices();
    if (vertices.empty()) {
        return;
    }
    Gl& gl = *gl_;
    gl.glDisable(GL_DEPTH_TEST);
    gl.glDisable(GL_CULL_FACE);
    gl.glEnable(GL_BLEND);
    gl.glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    overlay_->bind();
    overlay_->setUniformValue("u_size", float(in.camera.width()), float(in.camera.height()));
    gl.glBindVertexArray(overlay_array_);
    gl.glBindBuffer(GL_ARRAY_BUFFER, overlay_buffer_);
    gl.glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(vertices.size() * sizeof(OverlayVertex)), vertices.data(), GL_STREAM_DRAW);
    gl.glDrawArrays(GL_TRIANGLES, 0, GLsizei(vertices.size()));
    gl.glBindVertexArray(0);
    overlay_->release();
    gl.glDisable(GL_BLEND);
}

void PictureRenderer::draw_plates(const FrameInput& in) {
    if (in.plates.empty()) {
        return;
    }
    Gl& gl = *gl_;
    gl.glDisable(GL_DEPTH_TEST);
    gl.glDisable(GL_CULL_FACE);
    gl.glEnable(GL_BLEND);
    gl.glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    plate_->bind();
    plate_->setUniformValue("u_picture", 0);
    gl.glActiveTexture(GL_TEXTURE0);
    gl.glBindTexture(GL_TEXTURE_2D, plate_texture_);
    gl.glBindVertexArray(empty_array_);
    for (const Plate& plate : in.plates) {
        // On whole pixels: text stays sharp.
        const double left = std::round(plate.top_left.x * in.pixel_ratio);
        const double top = std::round(plate.top_left.y * in.pixel_ratio);
        const auto x = [&](double pixel) { return float(2.0 * pixel / in.width - 1.0); };
        const auto y = [&](double pixel) { return float(1.0 - 2.0 * pixel / in.height); };
        gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, plate.image.width(), plate.image.height(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                        plate.image.constBits());
        plate_->setUniformValue("u_area", x(left), y(top), x(left + plate.image.width()), y(top + plate.image.height()));
        gl.glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
    gl.glBindVertexArray(0);
    plate_->release();
    gl.glDisable(GL_BLEND);
}

} // namespace atrium::ui
