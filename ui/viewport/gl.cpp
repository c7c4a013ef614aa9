#include "ui/viewport/gl.h"

#include <QFile>
#include <QString>

// The linker drops a static library's resources unless somebody asks for them; the macro must stand in no namespace.
static void keep_resources() { Q_INIT_RESOURCE(atrium); }

namespace atrium::ui {

std::unique_ptr<QOpenGLShaderProgram> load_program(const char* vertex, const char* fragment, const QByteArray& defines) {
    keep_resources();
    auto program = std::make_unique<QOpenGLShaderProgram>();
    QFile file(QStringLiteral(":/shaders/") + QString::fromLatin1(fragment));
    QByteArray source = file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    source.insert(source.indexOf('\n') + 1, defines);
    const QString folder = QStringLiteral(":/shaders/");
    const bool good = program->addShaderFromSourceFile(QOpenGLShader::Vertex, folder + QString::fromLatin1(vertex)) &&
                      program->addShaderFromSourceCode(QOpenGLShader::Fragment, source) && program->link();
    return good ? std::move(program) : nullptr;
}

unsigned new_texture(Gl& gl, GLint filter) {
    unsigned name = 0;
    gl.glGenTextures(1, &name);
    gl.glBindTexture(GL_TEXTURE_2D, name);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return name;
}

bool GlTarget::resize(Gl& gl, int width, int height, int samples, unsigned color_format, bool with_depth) {
    if (framebuffer_ != 0 && width == width_ && height == height_ && samples == samples_) {
        return true;
    }
    release(gl);
    width_ = width;
    height_ = height;
    samples_ = samples;
    gl.glGenFramebuffers(1, &framebuffer_);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    if (samples > 0) {
        gl.glGenRenderbuffers(1, &color_);
        gl.glBindRenderbuffer(GL_RENDERBUFFER, color_);
        gl.glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, color_format, width, height);
        gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
    } else {
        gl.glGenTextures(1, &texture_);
        gl.glBindTexture(GL_TEXTURE_2D, texture_);
        gl.glTexImage2D(GL_TEXTURE_2D, 0, GLint(color_format), width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        gl.glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    }
    if (with_depth) {
        gl.glGenRenderbuffers(1, &depth_);
        gl.glBindRenderbuffer(GL_RENDERBUFFER, depth_);
        gl.glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH24_STENCIL8, width, height);
        gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth_);
    }
    return gl.glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

void GlTarget::release(Gl& gl) {
    gl.glDeleteFramebuffers(1, &framebuffer_);
    gl.glDeleteTextures(1, &texture_);
    gl.glDeleteRenderbuffers(1, &color_);
    gl.glDeleteRenderbuffers(1, &depth_);
    framebuffer_ = texture_ = color_ = depth_ = 0;
    samples_ = -1;
}

} // namespace atrium::ui
