#include "ui/viewport/viewport_widget.h"

#include "ui/viewport/viewport_impl.h"

namespace atrium::ui {

ViewportWidget::ViewportWidget(Document& document, EngineLink& engine, QWidget* parent)
    : QOpenGLWidget(parent), impl_(std::make_unique<Impl>(*this, document, engine)) {
    QSurfaceFormat wanted = format();
    wanted.setVersion(3, 3);
    wanted.setProfile(QSurfaceFormat::CoreProfile);
    wanted.setSamples(0); // smoothing happens in our own target, where the picture is kept
    setFormat(wanted);
    setFocusPolicy(Qt::StrongFocus);
    setAcceptDrops(true);
    setMouseTracking(true);
    setMinimumSize(160, 120);
    setAccessibleName(tr("3D view"));
    impl_->solution = engine.solution();
    if (!document.scene().roots.empty()) {
        const auto solution = impl_->solution;
        impl_->document_reset();
        impl_->solution = solution;
        if (solution) {
            impl_->take_solution();
        }
    } else {
        impl_->open_view();
    }
}

ViewportWidget::~ViewportWidget() {
    disconnect(impl_->context_gone); // it would come after impl_ is gone
    impl_->place_tool.cancel();
    impl_->tool().cancel();
    makeCurrent();
    impl_->renderer.release();
    doneCurrent();
}

void ViewportWidget::set_tool(ToolKind kind) {
    if (kind == impl_->tool_kind) {
        return;
    }
    impl_->cancel();
    impl_->tool().leave();
    impl_->tool_kind = kind;
    impl_->set_hovered({});
    setCursor(kind == ToolKind::Measure ? Qt::CrossCursor : Qt::ArrowCursor);
    update();
    Q_EMIT tool_changed(kind);
}

ToolKind ViewportWidget::tool() const { return impl_->tool_kind; }
void ViewportWidget::set_exposure(float ev) {
    if (ev != impl_->exposure_ev && std::isfinite(ev)) {
        impl_->exposure_ev = ev;
        impl_->picture_changed();
    }
}

float ViewportWidget::exposure() const { return impl_->exposure_ev; }
void ViewportWidget::set_wireframe(bool on) {
    if (on != impl_->wireframe) {
        impl_->wireframe = on;
        impl_->picture_changed();
    }
}

void ViewportWidget::set_caustic_boxes(bool on) {
    if (on != impl_->caustic_boxes) {
        impl_->caustic_boxes = on;
        impl_->picture_changed();
    }
}

void ViewportWidget::set_texel_grid(bool on) {
    if (on != impl_->texel_grid) {
        impl_->texel_grid = on;
        impl_->picture_changed();
    }
}

void ViewportWidget::set_landings(bool on) {
    if (on != impl_->landings) {
        impl_->landings = on;
        impl_->picture_changed();
    }
}

void ViewportWidget::set_caustic_view(CausticView view) {
    if (view != impl_->caustic_view) {
        impl_->caustic_view = view;
        impl_->take_solution();
    }
}

CausticView ViewportWidget::caustic_view() const { return impl_->caustic_view; }
std::shared_ptr<const Solution> ViewportWidget::shown_solution() const { return impl_->solution; }
void ViewportWidget::set_cut_walls(bool on) {
    if (on != impl_->cut_walls) {
        impl_->cut_walls = on;
        impl_->picture_changed();
    }
}

void ViewportWidget::set_light_shares(const LightShares& shares) {
    if (!(shares == impl_->shares)) {
        impl_->shares = shares;
        impl_->inspector.measure(impl_->false_color, shares);
        impl_->probe_changed();
        impl_->picture_changed();
    }
}

LightShares ViewportWidget::light_shares() const { return impl_->shares; }
void ViewportWidget::set_false_color(const std::optional<FalseColor>& scale) {
    const auto valid = scale ? std::optional(valid_scale(*scale)) : scale;
    if (valid != impl_->false_color) {
        impl_->false_color = valid;
        impl_->inspector.measure(valid, impl_->shares);
        impl_->picture_changed();
    }
}

const std::optional<FalseColor>& ViewportWidget::false_color() const { return impl_->false_color; }
void ViewportWidget::set_inspection(const InspectionChoice& choice) { impl_->inspector.set_choice(choice); }
const LightInspector& ViewportWidget::inspector() const { return impl_->inspector; }
bool ViewportWidget::inspect_element(const QPointF& point) {
    impl_->sync();
    if (impl_->inspector.choose(impl_->doc.scene(), impl_->view.pick(impl_->controller.ray(to_vec(point))))) {
        update();
    }
    return impl_->inspector.links().has_value();
}

const MeasuringPoints& ViewportWidget::measuring_points() const {
    impl_->sync();
    return impl_->points;
}

void ViewportWidget::clear_measuring_points() {
    impl_->points.clear();
    update();
}

bool ViewportWidget::add_measuring_point(const QPointF& point) {
    const auto reading = light_at(point);
    if (reading) {
        impl_->measuring_points().add(impl_->doc.scene(), *reading);
        update();
    }
    return reading.has_value();
}

std::optional<MeterReading> ViewportWidget::light_at(const QPointF& point) {
    impl_->sync();
    return impl_->read_light(to_vec(point));
}

void ViewportWidget::set_snapping(const Snapping& snapping) { impl_->snapping_choice = snapping; }
const Snapping& ViewportWidget::snapping() const { return impl_->snapping_choice; }
void ViewportWidget::set_orbit_selection(bool on) { impl_->orbit_selection = on; }

} // namespace atrium::ui
