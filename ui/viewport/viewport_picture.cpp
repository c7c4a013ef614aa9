// One frame of the viewport: picture, figures and words over it.
#include "ui/viewport/viewport_impl.h"

#include "ui/viewport/legend.h"

#include <QOpenGLContext>
#include <QOpenGLVersionFunctionsFactory>

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr double kLegendMargin = 12.0; ///< logical pixels

} // namespace

void ViewportWidget::Impl::collect_plates() {
    plates.clear();
    const double ratio = widget.devicePixelRatioF();
    if (const auto wanted = wanted_legend()) {
        if (legend_of != wanted) {
            legend_of = wanted;
            legend_image = Legend(wanted->scale, wanted->title, wanted->bars, widget.font(), widget.palette()).image(ratio);
        }
        const dvec2 size = dvec2(legend_image.width(), legend_image.height()) / ratio;
        plates.push_back(
            {legend_image,
             {widget.width() - size.x - kLegendMargin, std::max(kLegendMargin, 0.5 * (widget.height() - size.y))}});
    }
    collect_labels(ratio);
    if (const QStringList lines = inspector.words(doc.scene()); !lines.isEmpty() && !walking) {
        const QImage image = label_image(lines, widget.font(), widget.palette(), ratio);
        plates.push_back({image, {kLegendMargin, kLegendMargin}});
    }
}

std::optional<ViewportWidget::Impl::LegendOf> ViewportWidget::Impl::wanted_legend() const {
    const QString style =
        widget.font().key() + QString::number(widget.palette().cacheKey()) + QString::number(widget.devicePixelRatioF());
    if (const auto elements = inspector.scale()) {
        return LegendOf{elements->scale, elements->title, {}, style};
    }
    if (false_color) {
        return LegendOf{*false_color, Legend::light_title(false_color->quantity), inspector.bars(), style};
    }
    return std::nullopt;
}

void ViewportWidget::Impl::draw_points() {
    for (const MeasuringPoints::Point& point : points.points()) {
        const auto at = point.reading ? controller.project(point.reading->point) : std::nullopt;
        if (!at) {
            continue;
        }
        const float alpha = point.hidden ? 0.35F : 1.0F;
        overlay.disc(*at, 5.5, vec4(0.0F, 0.0F, 0.0F, 0.75F * alpha));
        overlay.disc(*at, 4.0, vec4(1.0F, 1.0F, 1.0F, alpha));
        overlay.disc(*at, 2.0, vec4(0.85F, 0.1F, 0.1F, alpha));
    }
}

void ViewportWidget::Impl::collect_labels(double ratio) {
    const auto label = [&](const QStringList& lines, const dvec2& at, double gap) {
        const QImage image = label_image(lines, widget.font(), widget.palette(), ratio);
        const dvec2 size = dvec2(image.width(), image.height()) / ratio;
        dvec2 place(at.x + gap, at.y - 0.5 * size.y);
        if (place.x + size.x > widget.width()) {
            place.x = at.x - gap - size.x;
        }
        place = glm::clamp(place, dvec2(0.0), glm::max(dvec2(widget.width(), widget.height()) - size, dvec2(0.0)));
        plates.push_back({image, place});
    };
    for (const MeasuringPoints::Point& point : points.points()) {
        const auto at = point.reading && !point.hidden ? controller.project(point.reading->point) : std::nullopt;
        if (at && at->x > 0.0 && at->y > 0.0 && at->x < widget.width() && at->y < widget.height()) {
            QStringList lines = reading_lines(point.reading->light);
            lines[0] = QStringLiteral("%1:  %2").arg(point.number).arg(lines[0]);
            label(lines.mid(0, 2), *at, 10.0);
        }
    }
    if (tool_kind == ToolKind::Measure && measure->cursor() && navigation == Navigation::None && !walking) {
        if (const auto reading = read_light(*measure->cursor())) {
            label(reading_lines(reading->light), *measure->cursor(), 18.0);
        }
    }
}

void ViewportWidget::initializeGL() {
    disconnect(impl_->context_gone);
    impl_->context_gone = connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
        makeCurrent();
        impl_->renderer.release();
        doneCurrent();
    });
    impl_->gl = QOpenGLVersionFunctionsFactory::get<QOpenGLFunctions_3_3_Core>(context());
    if (impl_->gl == nullptr || !impl_->gl->initializeOpenGLFunctions() || !impl_->renderer.initialize(*impl_->gl)) {
        impl_->renderer.release();
        impl_->gl = nullptr;
        Q_EMIT message(tr("The 3D view needs OpenGL 3.3. Update the graphics driver, or start with software rendering: "
                          "LIBGL_ALWAYS_SOFTWARE=1"));
        return;
    }
    impl_->probe_changed();
}

void ViewportWidget::paintGL() {
    if (impl_->gl == nullptr) {
        return;
    }
    impl_->controller.set_viewport(width(), height());
    impl_->sync();
    impl_->overlay.clear();
    const auto selected = [this](NodeId id) { return impl_->selected.contains(id); };
    if (impl_->view.items().empty()) {
        draw_grid(impl_->overlay, impl_->controller);
    }
    if (!impl_->walking) {
        draw_markers(impl_->overlay, impl_->markers, impl_->controller, selected, impl_->hovered_node);
        impl_->tool().draw(impl_->overlay);
    }
    impl_->inspector.draw(impl_->overlay, impl_->controller);
    impl_->draw_points();
    draw_axes(impl_->overlay, impl_->controller);
    impl_->collect_plates();
    const std::vector<ShownFigures> figures = impl_->inspector.figures();
    const double ratio = devicePixelRatioF();
    FrameInput in{impl_->doc.scene(),
                  impl_->view,
                  impl_->controller,
                  impl_->overlay,
                  impl_->selected,
                  impl_->hovered,
                  impl_->scale(),
                  impl_->shares,
                  impl_->wireframe,
                  impl_->caustic_boxes,
                  impl_->texel_grid,
                  impl_->landings && impl_->solution ? impl_->solution->landings : nullptr,
                  figures,
                  impl_->false_color,
                  impl_->plates,
                  impl_->refine,
                  std::max(1, int(std::lround(width() * ratio))),
                  std::max(1, int(std::lround(height() * ratio))),
                  ratio,
                  defaultFramebufferObject(),
                  impl_->specular.pixels()};
    impl_->renderer.paint(in);
    if (impl_->renderer.incomplete()) {
        QTimer::singleShot(0, this, [this] { update(); }); // after the events that wait
    }
    if (impl_->renderer.wants_refining() && !impl_->refine) {
        impl_->refine_timer.start();
    }
}

void ViewportWidget::refine_now() {
    impl_->refine_timer.stop();
    impl_->refine = true;
    impl_->renderer.take_time();
    update();
}

void ViewportWidget::resizeGL(int /*width*/, int /*height*/) {
    impl_->controller.set_viewport(width(), height());
    impl_->picture_changed();
}

} // namespace atrium::ui
