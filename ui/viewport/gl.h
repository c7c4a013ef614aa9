// OpenGL 3.3 core functions and small owners of GL objects.
#pragma once

#include <QByteArray>
#include <QOpenGLFunctions_3_3_Core>
#include <QOpenGLShaderProgram>

#include <memory>

namespace atrium::ui {

using Gl = QOpenGLFunctions_3_3_Core;

/// Program from ":/shaders/<vertex>" and ":/shaders/<fragment>", with `defines` (whole lines) put below the fragment
/// shader's #version; null (with Qt's log printed) when it does not link.
std::unique_ptr<QOpenGLShaderProgram> load_program(const char* vertex, const char* fragment, const QByteArray& defines = {});

/// New two-dimensional texture without levels, clamped to its edge, bound to GL_TEXTURE_2D; `filter` both ways. Context
/// current.
unsigned new_texture(Gl& gl, GLint filter);

/// Off-screen picture with depth and stencil. All functions need the context current.
class GlTarget {
public:
    /// (Re)creates the target where size, samples or format changed. True when complete.
    bool resize(Gl& gl, int width, int height, int samples, unsigned color_format, bool with_depth);
    void release(Gl& gl);
    [[nodiscard]] unsigned framebuffer() const { return framebuffer_; }
    [[nodiscard]] unsigned texture() const { return texture_; } ///< 0 when multisampled
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

private:
    unsigned framebuffer_ = 0;
    unsigned texture_ = 0;
    unsigned color_ = 0;
    unsigned depth_ = 0;
    int width_ = 0;
    int height_ = 0;
    int samples_ = -1;
};

} // namespace atrium::ui
