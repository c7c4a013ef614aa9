// What the viewport shows: it follows document, selection and light.
#include "ui/viewport/viewport_impl.h"

#include "ui/document/background.h"
#include "ui/viewport/look_at.h"

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr int kRefineAfterMs = 350;
constexpr int kProbeAfterMs = 150; ///< of rest; then a face at a time
constexpr int kWalkTickMs = 16;

/// A new mean is taken over at rest when it differs by more than this factor: somebody switched the lights.
constexpr double kMeanJump = 8.0;

} // namespace

ViewportWidget::Impl::Impl(ViewportWidget& w, Document& d, EngineLink& e)
    : widget(w), doc(d), engine(e),
      inspector([this]() -> const Scene& { return doc.scene(); }, [this] { return local_error(); }, &w) {
    auto selecting = std::make_unique<SelectAndMoveTool>(*this);
    select = selecting.get();
    tools[0] = std::move(selecting);
    tools[1] = std::make_unique<MoveTool>(*this);
    tools[2] = std::make_unique<RotateTool>(*this);
    tools[3] = std::make_unique<ScaleTool>(*this);
    auto measuring = std::make_unique<MeasureTool>(*this);
    measure = measuring.get();
    tools[4] = std::move(measuring);
    for (const auto& [timer, name] : {std::pair{&pending_timer, "mouse"},
                                      {&refine_timer, "refine"},
                                      {&probe_timer, "probe"},
                                      {&upload_timer, "upload"},
                                      {&walk_timer, "walk"}}) {
        timer->setObjectName(QLatin1StringView(name)); // who is told to have held the window
    }
    pending_timer.setSingleShot(true);
    pending_timer.setInterval(0);
    refine_timer.setSingleShot(true);
    refine_timer.setInterval(kRefineAfterMs);
    probe_timer.setSingleShot(true);
    upload_timer.setSingleShot(true);
    upload_timer.setInterval(0);
    walk_timer.setInterval(kWalkTickMs);
    QObject::connect(&probe_timer, &QTimer::timeout, &widget, [this] { step_probe(); });
    QObject::connect(&upload_timer, &QTimer::timeout, &widget, [this] { step_upload(); });
    QObject::connect(&pending_timer, &QTimer::timeout, &widget, [this] { flush(); });
    QObject::connect(&specular, &SpecularOverlay::ready, &widget, [this] { widget.update(); });
    QObject::connect(&refine_timer, &QTimer::timeout, &widget, [this] {
        refine = true;
        widget.update();
    });
    QObject::connect(&walk_timer, &QTimer::timeout, &widget, [this] { walk_step(); });
    QObject::connect(&doc, &Document::reset_done, &widget, [this] { document_reset(); });
    QObject::connect(&doc, &Document::edited, &widget, [this](const SceneEdit& edit) {
        view.note_edit(doc.scene(), edit, doc.revision());
        note_isolated(edit);
        scene_changed();
        if (!doc.in_gesture()) {
            selection_changed(); // what lies below the selected nodes may be other nodes now
            probe_changed();
        }
    });
    QObject::connect(&doc, &Document::gesture_finished, &widget, [this] {
        probe_changed();
        picture_changed();
    });
    QObject::connect(doc.selection(), &Selection::changed, &widget, [this] { selection_changed(); });
    QObject::connect(&inspector, &LightInspector::changed, &widget, [this] { widget.update(); });
    QObject::connect(&inspector, &LightInspector::figures_changed, &widget, [this] { picture_changed(); });
    QObject::connect(&engine, &EngineLink::solution_changed, &widget, [this] { take_solution(); });
}

std::optional<PickHit> ViewportWidget::Impl::pick(const dvec2& point) const {
    const Ray ray = controller.ray(point);
    const Marker* marker =
        marker_at(markers, controller, point, [this](NodeId id) { return doc.selection()->contains(id); });
    if (marker != nullptr) {
        PickHit hit;
        hit.node = marker->node;
        hit.point = marker->position;
        hit.distance = glm::length(marker->position - ray.origin);
        return hit;
    }
    return view.pick(ray);
}

std::optional<MeterReading> ViewportWidget::Impl::read_light(const dvec2& point) const {
    const auto error = local_error();
    return solution ? read_along(view, doc.scene(), *solution, controller.ray(point), error.get()) : std::nullopt;
}

std::shared_ptr<const LocalError> ViewportWidget::Impl::local_error() const {
    const auto newest = engine.solution(); // may wait for its light maps to be uploaded
    return solution && newest && solution->surfaces == newest->surfaces ? engine.local_error() : nullptr;
}

MeasuringPoints& ViewportWidget::Impl::measuring_points() {
    markers_dirty = true; // what is changed about them is looked at again
    return points;
}

void ViewportWidget::Impl::picture_changed() {
    renderer.invalidate_picture();
    markers_dirty = true;
    refine = false;
    specular.changed();
    widget.update();
}

std::optional<SpecularOverlay::Request> ViewportWidget::Impl::specular_request() {
    if (gl == nullptr || !solution || pressed != Qt::NoButton || doc.in_gesture() || false_color || wireframe ||
        view.isolated() || inspector.choice().colors != ElementColors::None) {
        return std::nullopt;
    }
    sync();
    if (view.cutaway().active()) {
        return std::nullopt; // rays would end at walls that the picture leaves out
    }
    const double ratio = widget.devicePixelRatioF();
    return SpecularOverlay::Request{doc.scene(),
                                    doc.revision(),
                                    solution,
                                    widget.camera(),
                                    std::max(1, int(std::lround(widget.width() * ratio))),
                                    std::max(1, int(std::lround(widget.height() * ratio))),
                                    shares};
}

void ViewportWidget::Impl::probe_changed() {
    renderer.invalidate_probe();
    probe_timer.start(kProbeAfterMs);
}

void ViewportWidget::Impl::step_probe() {
    if (pressed != Qt::NoButton || doc.in_gesture()) {
        probe_timer.start(kProbeAfterMs);
        return;
    }
    if (gl == nullptr) {
        return; // not shown yet: initializeGL() starts over
    }
    sync();
    widget.makeCurrent();
    const bool more = renderer.step_probe(view, doc.scene(), scale(), shares);
    widget.doneCurrent();
    if (more) {
        probe_timer.start(0);
    } else {
        widget.update();
    }
}

void ViewportWidget::Impl::scene_changed() {
    items_dirty = true;
    picture_changed();
}

void ViewportWidget::Impl::selection_changed() {
    selected.clear();
    for (const NodeId id : doc.selection()->nodes()) {
        for (const NodeId below : doc.scene().in_tree_order(id)) {
            selected.insert(below);
        }
    }
    inspector.select(selected);
    renderer.invalidate_mask();
    if (texel_grid || landings) {
        renderer.invalidate_picture();
    }
    widget.update();
}

void ViewportWidget::Impl::set_hovered(NodeId id) {
    if (id == hovered_node) {
        return;
    }
    hovered_node = id;
    hovered.clear();
    if (id) {
        hovered.insert(id);
    }
    renderer.invalidate_mask();
    widget.update();
}

void ViewportWidget::Impl::document_reset() {
    cancel();
    ++document_number;
    view.clear();
    place_tool.cancel();
    isolate(std::nullopt);
    points.clear();
    inspector.clear();
    solution.reset();
    stop_awaiting();
    mean_radiance = 0;
    mean_is_final = false;
    set_hovered({});
    items_dirty = true;
    probe_changed();
    controller.set_scene_bounds(robust_bounds(doc.scene()));
    open_view();
    selection_changed();
    picture_changed();
}

void ViewportWidget::Impl::open_view() {
    if (doc.scene().bounds().empty()) {
        ViewCamera start;
        start.to_world = dmat4(dvec4(0.8, 0.0, -0.6, 0.0), dvec4(-0.18, 0.954, -0.24, 0.0), dvec4(0.572, 0.3, 0.763, 0.0),
                               dvec4(4.0, 2.6, 5.3, 1.0));
        controller.set_camera(start);
        return;
    }
    controller.set_camera(initial_view(doc.scene()));
}

void ViewportWidget::Impl::stop_awaiting() {
    upload_timer.stop();
    awaited.reset();
    renderer.forget_awaited();
}

void ViewportWidget::Impl::take_solution() {
    const std::shared_ptr<const Solution> newest = engine.solution();
    if (caustic_view == CausticView::Texture || !newest) {
        take(newest);
        return;
    }
    if (deriving) {
        return; // it looks again when it is done
    }
    deriving = true;
    run_in_background(
        &widget,
        [newest, view_as = caustic_view]() -> Result<std::shared_ptr<const Solution>> { return shown_as(*newest, view_as); },
        [this, newest, view_as = caustic_view,
         number = document_number](const Result<std::shared_ptr<const Solution>>& made) {
            deriving = false;
            if (!made) {
                take(engine.solution());
                return;
            }
            const bool wanted = view_as == caustic_view && number == document_number;
            if (wanted) {
                take(*made);
            }
            if (!wanted || newest != engine.solution()) {
                take_solution();
            }
        });
}

void ViewportWidget::Impl::take(std::shared_ptr<const Solution> light) {
    awaited = std::move(light);
    if (!awaited || renderer.uploaded(*awaited)) {
        show_awaited();
    } else {
        upload_timer.start();
    }
}

void ViewportWidget::Impl::step_upload() {
    if (!awaited) {
        return;
    }
    widget.makeCurrent();
    const bool done = renderer.upload_ahead(*awaited);
    widget.doneCurrent();
    if (done) {
        show_awaited();
    } else {
        upload_timer.start();
    }
}

void ViewportWidget::Impl::show_awaited() {
    solution = std::move(awaited);
    stop_awaiting();
    inspector.take(solution);
    if (solution && solution->mean_radiance > 0.0) {
        // The picture must not pump while one edits: the mean is taken over while the first picture converges,
        // and afterwards only when the light has changed out of all proportion.
        const double ratio = mean_radiance > 0.0 ? solution->mean_radiance / mean_radiance : 0.0;
        const bool jump = ratio > kMeanJump || ratio < 1.0 / kMeanJump;
        if (!mean_is_final || (jump && solution->final && !doc.in_gesture())) {
            mean_radiance = solution->mean_radiance;
            mean_is_final = solution->final;
        }
    }
    probe_changed();
    scene_changed();
}

void ViewportWidget::Impl::sync() {
    if (items_dirty) {
        items_dirty = false;
        view.sync(doc.scene(), solution);
        renderer.invalidate_items();
        markers = find_markers(doc.scene());
        if (view.isolated()) {
            std::erase_if(markers, [this](const Marker& m) { return !view.isolated()->contains(m.node); });
        }
        points.read(view, doc.scene(), solution, local_error().get());
        markers_dirty = true;
        if (!doc.in_gesture()) {
            controller.set_scene_bounds(robust_bounds(doc.scene()));
        }
    }
    view.set_cutaway(cut_walls ? Cutaway(controller.scene_bounds(), controller.eye()) : Cutaway());
    if (markers_dirty) {
        markers_dirty = false;
        find_hidden(markers, view, controller);
        points.look(view, controller);
    }
}

} // namespace atrium::ui
