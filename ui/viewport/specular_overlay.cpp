#include "ui/viewport/specular_overlay.h"

#include <QCoreApplication>
#include <QOpenGLShaderProgram>
#include <QPointer>
#include <QThreadPool>

#include <cmath>

namespace atrium::ui {
namespace {

constexpr int kRestMs = 120; ///< before rays are worth it
constexpr int kSamples = 2;  ///< a pixel's side

} // namespace

SpecularOverlay::SpecularOverlay(std::function<std::optional<Request>()> ask, QObject* parent)
    : QObject(parent), ask_(std::move(ask)) {
    rest_.setSingleShot(true);
    rest_.setInterval(kRestMs);
    connect(&rest_, &QTimer::timeout, this, &SpecularOverlay::start);
}

SpecularOverlay::~SpecularOverlay() { stop_.request_stop(); }

void SpecularOverlay::changed() {
    stop_.request_stop();
    ++number_;
    pixels_.reset();
    rest_.start();
}

void SpecularOverlay::start() {
    std::optional<Request> wanted = ask_();
    if (!wanted || !wanted->solution || !SpecularView::any(wanted->scene)) {
        view_.reset();
        view_solution_.reset();
        return;
    }
    if (view_solution_ != wanted->solution || view_revision_ != wanted->revision) {
        view_.reset();
    }
    view_solution_ = wanted->solution;
    view_revision_ = wanted->revision;
    stop_ = StopFlag();
    RunContext context;
    context.stop = stop_;
    // The answer comes back as events: nothing here is touched by the pool, and a widget that is gone gets none.
    const QPointer<SpecularOverlay> self(this);
    QThreadPool::globalInstance()->start(
        [self, request = std::move(*wanted), view = view_, context, number = number_]() mutable {
            try {
                if (!view) {
                    view = std::make_shared<const SpecularView>(request.scene, *request.solution);
                    // Kept even if the view moves on before anything is traced: the scene stays the same.
                    QMetaObject::invokeMethod(
                        QCoreApplication::instance(),
                        [self, view, solution = request.solution, revision = request.revision] {
                            if (self && self->view_solution_ == solution && self->view_revision_ == revision) {
                                self->view_ = view;
                            }
                        },
                        Qt::QueuedConnection);
                }
                const auto hand_back = [&](SpecularPixels made) {
                    auto pixels = std::make_shared<const SpecularPixels>(std::move(made));
                    QMetaObject::invokeMethod(
                        QCoreApplication::instance(),
                        [self, pixels, number] {
                            if (self && self->number_ == number) {
                                self->pixels_ = pixels;
                                Q_EMIT self->ready();
                            }
                        },
                        Qt::QueuedConnection);
                };
                view->look(request.camera, request.width, request.height, kSamples, request.shares, context, hand_back);
            } catch (const std::exception& e) { // no memory: the rasterised mirrors stay
                qWarning("Mirrors and glass of the view could not be traced: %s", e.what());
            }
        });
}

bool SpecularLayer::initialize(Gl& gl) {
    gl_ = &gl;
    program_ = load_program("plate.vert", "specular.frag");
    gl.glGenVertexArrays(1, &array_);
    texture_ = new_texture(gl, GL_NEAREST);
    return program_ != nullptr;
}

void SpecularLayer::release() {
    if (gl_ == nullptr) {
        return;
    }
    gl_->glDeleteVertexArrays(1, &array_);
    gl_->glDeleteTextures(1, &texture_);
    array_ = texture_ = 0;
    program_.reset();
    uploaded_.reset();
    gl_ = nullptr;
}

void SpecularLayer::draw(const std::shared_ptr<const SpecularPixels>& pixels, int width, int height, float exposure) {
    if (gl_ == nullptr || !pixels || pixels->pixels.empty()) {
        uploaded_.reset();
        return;
    }
    Gl& gl = *gl_;
    gl.glActiveTexture(GL_TEXTURE0);
    gl.glBindTexture(GL_TEXTURE_2D, texture_);
    if (uploaded_ != pixels) {
        uploaded_ = pixels;
        gl.glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, pixels->width, pixels->height, 0, GL_RGBA, GL_FLOAT,
                        pixels->pixels.data());
    }
    gl.glDisable(GL_DEPTH_TEST);
    gl.glDisable(GL_CULL_FACE);
    gl.glEnable(GL_BLEND);
    gl.glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    program_->bind();
    program_->setUniformValue("u_picture", 0);
    program_->setUniformValue("u_exposure", exposure);
    const auto x = [&](int pixel) { return 2.0F * float(pixel) / float(width) - 1.0F; };
    const auto y = [&](int pixel) { return 1.0F - 2.0F * float(pixel) / float(height); };
    program_->setUniformValue("u_area", x(pixels->left), y(pixels->top), x(pixels->left + pixels->width),
                              y(pixels->top + pixels->height));
    gl.glBindVertexArray(array_);
    gl.glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl.glBindVertexArray(0);
    program_->release();
    gl.glDisable(GL_BLEND);
}

} // namespace atrium::ui
