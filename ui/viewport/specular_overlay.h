// Mirrors, metals and glass of a view at rest, traced in the background and laid over the rasterised picture.
#pragma once

#include "engine/view/specular_pixels.h"
#include "ui/viewport/gl.h"

#include <QObject>
#include <QTimer>

#include <functional>
#include <memory>
#include <optional>

namespace atrium::ui {

/// Looks after the pixels. UI thread only; rays run on the pool. In a scene without mirrors and glass nothing is built.
class SpecularOverlay : public QObject {
    Q_OBJECT
public:
    struct Request {
        Scene scene;
        std::uint64_t revision = 0; ///< of the document
        std::shared_ptr<const Solution> solution;
        ViewCamera camera;
        int width = 1; ///< device pixels
        int height = 1;
        LightShares shares;
    };
    /// `ask` tells what is to be seen now, or nothing while that would be of no use (during a drag, in false colour).
    explicit SpecularOverlay(std::function<std::optional<Request>()> ask, QObject* parent = nullptr);
    ~SpecularOverlay() override;

    /// Camera, scene, light or size changed: what was traced is of no use; starts anew after some rest.
    void changed();
    /// What is there for the picture as it is; may be null.
    [[nodiscard]] const std::shared_ptr<const SpecularPixels>& pixels() const { return pixels_; }

Q_SIGNALS:
    void ready(); ///< pixels() are there or better than before

private:
    void start();

    std::function<std::optional<Request>()> ask_;
    QTimer rest_;
    StopFlag stop_;
    unsigned number_ = 0; ///< of the newest run; answers of older ones are dropped
    std::shared_ptr<const SpecularPixels> pixels_;
    std::shared_ptr<const SpecularView> view_; ///< of the scene and light that it was made for
    std::shared_ptr<const Solution> view_solution_;
    std::uint64_t view_revision_ = 0;
};

/// Draws them. Context current in every function but the constructor.
class SpecularLayer {
public:
    bool initialize(Gl& gl);
    void release();
    /// Over the whole view of width x height device pixels in the bound framebuffer.
    void draw(const std::shared_ptr<const SpecularPixels>& pixels, int width, int height, float exposure);

private:
    Gl* gl_ = nullptr;
    std::unique_ptr<QOpenGLShaderProgram> program_;
    unsigned texture_ = 0;
    unsigned array_ = 0;
    std::shared_ptr<const SpecularPixels> uploaded_;
};

} // namespace atrium::ui
