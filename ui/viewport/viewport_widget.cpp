// Longer than most: all that reaches the widget from outside (events, document, engine) is answered here and passed on.
#include "ui/viewport/viewport_widget.h"

#include "engine/view/tone.h"
#include "ui/document/background.h"
#include "ui/document/insert_commands.h"
#include "ui/document/scene_commands.h"
#include "ui/document/scene_mime.h"
#include "ui/tools/measure_tool.h"
#include "ui/tools/place_tool.h"
#include "ui/tools/surface.h"
#include "ui/tools/transform_tool.h"
#include "ui/viewport/legend.h"
#include "ui/viewport/look_at.h"
#include "ui/viewport/markers.h"
#include "ui/viewport/picture_renderer.h"

#include <QDragEnterEvent>
#include <QElapsedTimer>
#include <QLocale>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QOpenGLContext>
#include <QOpenGLVersionFunctionsFactory>
#include <QSet>
#include <QTimer>
#include <QWheelEvent>

#include <algorithm>
#include <array>
#include <unordered_set>

namespace atrium::ui {
namespace {

constexpr int kRefineAfterMs = 350;
constexpr int kProbeAfterMs = 150; ///< of rest; then a face at a time
constexpr int kWalkTickMs = 16;
constexpr double kLegendMargin = 12.0; ///< logical pixels
constexpr double kPinchSteps = 6.0;    ///< dolly steps for a pinch to twice the size

// Of lamps that are put there, metres.
constexpr double kBelowCeiling = 0.02;
constexpr double kBeforeWall = 0.1;

/// A new mean is taken over at rest when it differs by more than this factor: somebody switched the lights.
constexpr double kMeanJump = 8.0;

dvec2 to_vec(const QPointF& p) { return {p.x(), p.y()}; }

} // namespace

struct ViewportWidget::Impl : ToolHost {
    enum class Navigation : std::uint8_t { None, Orbit, Pan, Look };

    ViewportWidget& widget;
    Document& doc;
    EngineLink& engine;
    CameraController controller;
    ViewScene view;
    PictureRenderer renderer;
    Gl* gl = nullptr;
    OverlayBatch overlay;
    std::vector<Marker> markers;
    std::shared_ptr<const Solution> solution; ///< shown
    std::shared_ptr<const Solution> awaited;  ///< shown as soon as its light maps are uploaded

    std::array<std::unique_ptr<Tool>, 5> tools;
    MeasureTool* measure = nullptr; ///< one of them
    MeasuringPoints points;
    ToolKind tool_kind = ToolKind::Select;
    PlaceTool place_tool{*this};
    Snapping snapping_choice;
    bool orbit_selection = false;
    float exposure_ev = 0;
    double mean_radiance = 0;
    bool mean_is_final = false;
    bool wireframe = false;
    bool caustic_boxes = false;
    bool texel_grid = false;
    bool landings = false;
    CausticView caustic_view = CausticView::Texture;
    bool deriving = false;   ///< the light is being made ready for caustic_view
    int document_number = 0; ///< rises with every other document
    bool cut_walls = true;
    LightShares shares;
    std::optional<FalseColor> false_color;
    std::vector<Plate> plates;
    std::optional<FalseColor> legend_of; ///< that legend_image shows
    QString legend_style;                ///< likewise: font, palette, pixel ratio
    QImage legend_image;
    bool refine = false;
    bool items_dirty = true;
    bool markers_dirty = true;

    std::unordered_set<NodeId> selected;
    std::unordered_set<NodeId> hovered;
    NodeId hovered_node;

    Navigation navigation = Navigation::None;
    Qt::MouseButton pressed = Qt::NoButton;
    dvec3 pivot{0.0};
    dvec2 last_point{0.0};
    /// Newest mouse position that nothing has answered yet: moves are answered once per turn of the event loop.
    std::optional<Pointer> pending;
    QTimer pending_timer;
    QTimer refine_timer;
    QTimer probe_timer;
    QTimer upload_timer;
    SpecularOverlay specular{[this] { return specular_request(); }};
    QMetaObject::Connection context_gone;

    bool walking = false;
    QSet<int> walk_keys;
    bool walk_fast = false;
    double eye_height = CameraController::kEyeHeight;
    QTimer walk_timer;
    QElapsedTimer walk_clock;

    Impl(ViewportWidget& w, Document& d, EngineLink& e) : widget(w), doc(d), engine(e) {
        tools[0] = std::make_unique<SelectTool>(*this);
        tools[1] = std::make_unique<MoveTool>(*this);
        tools[2] = std::make_unique<RotateTool>(*this);
        tools[3] = std::make_unique<ScaleTool>(*this);
        auto measuring = std::make_unique<MeasureTool>(*this);
        measure = measuring.get();
        tools[4] = std::move(measuring);
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
        QObject::connect(&engine, &EngineLink::solution_changed, &widget, [this] { take_solution(); });
    }

    /// Where a lamp hangs over a point on a floor: no higher than a ceiling lets it.
    [[nodiscard]] dvec3 lamp_above(const dvec3& floor) const {
        const auto ceiling = view.pick({floor + dvec3(0.0, 0.01, 0.0), dvec3(0.0, 1.0, 0.0)});
        const double room = ceiling ? ceiling->point.y - floor.y - kBelowCeiling : kLampHeight;
        return floor + dvec3(0.0, room > 0.1 ? std::min(kLampHeight, room) : kLampHeight, 0.0);
    }

    // ---- ToolHost ----
    Document& document() override { return doc; }
    [[nodiscard]] const CameraController& camera() const override { return controller; }
    void show_message(const QString& text) override { Q_EMIT widget.message(text); }
    [[nodiscard]] const ViewScene& view_scene() const override { return view; }
    [[nodiscard]] const Snapping& snapping() const override { return snapping_choice; }
    /// What is added while some objects are shown alone is shown, too.
    void note_isolated(const SceneEdit& edit) {
        if (!view.isolated()) {
            return;
        }
        if (const auto* group = std::get_if<EditGroup>(&edit.value)) {
            for (const SceneEdit& one : group->edits) {
                note_isolated(one);
            }
        } else if (const auto* added = std::get_if<AddNode>(&edit.value)) {
            auto nodes = *view.isolated();
            nodes.insert(added->id);
            view.set_isolated(std::move(nodes));
        }
    }
    void isolate(std::optional<std::unordered_set<NodeId>> nodes) {
        if (!nodes && !view.isolated()) {
            return;
        }
        const bool on = nodes.has_value();
        view.set_isolated(std::move(nodes));
        scene_changed();
        Q_EMIT widget.isolated_changed(on);
    }
    /// Middle of what is selected, for turning about it.
    [[nodiscard]] std::optional<dvec3> selection_centre() const {
        DBox3 box;
        for (const NodeId id : doc.selection()->nodes()) {
            const DBox3 one = doc.scene().subtree_bounds(id);
            if (!one.empty()) {
                box.add(one);
            } else if (doc.scene().nodes.contains(id)) {
                box.add(dvec3(doc.scene().world_matrix(id)[3]));
            }
        }
        return box.empty() ? std::nullopt : std::optional(box.centre());
    }
    bool answer_drag(QDropEvent* event, bool drop) {
        if (!place_tool.active()) {
            return false;
        }
        sync();
        const Pointer pointer{to_vec(event->position()), event->modifiers()};
        const bool good = drop ? place_tool.drop(pointer) : place_tool.move(pointer);
        set_hovered(place_tool.target());
        widget.update();
        return good;
    }
    [[nodiscard]] std::optional<PickHit> pick(const dvec2& point) const override {
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

    [[nodiscard]] std::optional<MeterReading> read_light(const dvec2& point) const override {
        return solution ? read_along(view, doc.scene(), *solution, controller.ray(point)) : std::nullopt;
    }
    MeasuringPoints& measuring_points() override {
        markers_dirty = true; // what is changed about them is looked at again
        return points;
    }

    [[nodiscard]] Tool& tool() { return *tools[std::size_t(tool_kind)]; }
    [[nodiscard]] float scale() const { return exposure_scale(mean_radiance, exposure_ev); }

    // ---- what changed ----
    void picture_changed() {
        renderer.invalidate_picture();
        markers_dirty = true;
        refine = false;
        specular.changed();
        widget.update();
    }
    /// What is traced over the picture once it rests: mirrors and glass as a still shows them.
    [[nodiscard]] std::optional<SpecularOverlay::Request> specular_request() {
        if (gl == nullptr || !solution || pressed != Qt::NoButton || doc.in_gesture() || false_color || wireframe ||
            view.isolated()) {
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
    /// Mirrors follow when everything else has rested a little.
    void probe_changed() {
        renderer.invalidate_probe();
        probe_timer.start(kProbeAfterMs);
    }
    void step_probe() {
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
    void scene_changed() {
        items_dirty = true;
        picture_changed();
    }
    void selection_changed() {
        selected.clear();
        for (const NodeId id : doc.selection()->nodes()) {
            for (const NodeId below : doc.scene().in_tree_order(id)) {
                selected.insert(below);
            }
        }
        renderer.invalidate_mask();
        if (texel_grid || landings) {
            renderer.invalidate_picture();
        }
        widget.update();
    }
    void set_hovered(NodeId id) {
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
    void document_reset() {
        cancel();
        ++document_number;
        view.clear();
        place_tool.cancel();
        isolate(std::nullopt);
        points.clear();
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
    void open_view() {
        if (doc.scene().bounds().empty()) {
            ViewCamera start;
            start.to_world = dmat4(dvec4(0.8, 0.0, -0.6, 0.0), dvec4(-0.18, 0.954, -0.24, 0.0),
                                   dvec4(0.572, 0.3, 0.763, 0.0), dvec4(4.0, 2.6, 5.3, 1.0));
            controller.set_camera(start);
            return;
        }
        controller.set_camera(initial_view(doc.scene()));
    }
    void stop_awaiting() {
        upload_timer.stop();
        awaited.reset();
        renderer.forget_awaited();
    }
    /// The old light stays until the new one's maps are uploaded, a slice in each turn of the event loop: a wall that waits
    /// for its sun would flicker.
    void take_solution() {
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
            [newest, view_as = caustic_view]() -> Result<std::shared_ptr<const Solution>> {
                return shown_as(*newest, view_as);
            },
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
    void take(std::shared_ptr<const Solution> light) {
        awaited = std::move(light);
        if (!awaited || renderer.uploaded(*awaited)) {
            show_awaited();
        } else {
            upload_timer.start();
        }
    }
    void step_upload() {
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
    void show_awaited() {
        solution = std::move(awaited);
        stop_awaiting();
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
    /// Brings the items up to date before anything is asked of them.
    void sync() {
        if (items_dirty) {
            items_dirty = false;
            view.sync(doc.scene(), solution);
            renderer.invalidate_items();
            markers = find_markers(doc.scene());
            if (view.isolated()) {
                std::erase_if(markers, [this](const Marker& m) { return !view.isolated()->contains(m.node); });
            }
            points.read(view, doc.scene(), solution);
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

    // ---- words over the picture ----
    void collect_plates() {
        plates.clear();
        const double ratio = widget.devicePixelRatioF();
        if (false_color) {
            const QString style =
                widget.font().key() + QString::number(widget.palette().cacheKey()) + QString::number(ratio);
            if (legend_of != false_color || legend_style != style) {
                legend_of = false_color;
                legend_style = style;
                legend_image = Legend(*false_color, widget.font(), widget.palette()).image(ratio);
            }
            const dvec2 size = dvec2(legend_image.width(), legend_image.height()) / ratio;
            plates.push_back(
                {legend_image,
                 {widget.width() - size.x - kLegendMargin, std::max(kLegendMargin, 0.5 * (widget.height() - size.y))}});
        }
        collect_labels(ratio);
    }

    void draw_points() {
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
    /// Labels beside the points, where they are in sight, and beside the cursor.
    void collect_labels(double ratio) {
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

    // ---- mouse ----
    [[nodiscard]] dvec3 point_under(const dvec2& point) const {
        const Ray ray = controller.ray(point);
        const auto hit = view.pick(ray);
        if (hit) {
            return hit->point;
        }
        const DBox3 box = doc.scene().subtree_bounds(doc.selection()->active());
        if (doc.selection()->active() && !box.empty()) {
            return box.centre();
        }
        return ray.at(controller.focus_distance());
    }
    void flush() {
        pending_timer.stop();
        if (!pending) {
            return;
        }
        const Pointer pointer = *pending;
        pending.reset();
        sync();
        if (navigation != Navigation::None) {
            navigate(pointer.position);
        } else if (tool().active()) {
            tool().move(pointer);
            widget.update();
        } else {
            if (tool().hover(pointer)) {
                widget.update();
            }
            const auto hit = tool_kind == ToolKind::Measure ? std::nullopt : pick(pointer.position);
            set_hovered(hit ? hit->node : NodeId{});
        }
    }
    void navigate(const dvec2& point) {
        const dvec2 delta = point - last_point;
        last_point = point;
        if (glm::length(delta) == 0.0) {
            return;
        }
        switch (navigation) {
        case Navigation::Orbit: controller.orbit(delta, pivot); break;
        case Navigation::Pan: controller.pan(delta, pivot); break;
        case Navigation::Look: controller.look(delta); break;
        case Navigation::None: return;
        }
        picture_changed();
    }
    [[nodiscard]] Navigation navigation_for(const QMouseEvent& event) const {
        const bool inside = [&] {
            const DBox3 box = robust_bounds(doc.scene());
            const dvec3 e = controller.eye();
            return !box.empty() && glm::all(glm::greaterThan(e, box.min)) && glm::all(glm::lessThan(e, box.max));
        }();
        switch (event.button()) {
        case Qt::MiddleButton: return event.modifiers().testFlag(Qt::ShiftModifier) ? Navigation::Pan : Navigation::Orbit;
        case Qt::LeftButton:
            if (event.modifiers().testFlag(Qt::AltModifier)) {
                return event.modifiers().testFlag(Qt::ShiftModifier) ? Navigation::Pan : Navigation::Orbit;
            }
            return walking ? Navigation::Look : Navigation::None;
        case Qt::RightButton: return walking || inside ? Navigation::Look : Navigation::Orbit;
        default: return Navigation::None;
        }
    }
    void cancel() {
        pending.reset();
        navigation = Navigation::None;
        pressed = Qt::NoButton;
        tool().cancel();
        widget.update();
    }

    // ---- walking ----
    static bool is_walk_key(int key) {
        switch (key) {
        case Qt::Key_W:
        case Qt::Key_A:
        case Qt::Key_S:
        case Qt::Key_D:
        case Qt::Key_Q:
        case Qt::Key_E:
        case Qt::Key_Up:
        case Qt::Key_Down:
        case Qt::Key_Left:
        case Qt::Key_Right: return true;
        default: return false;
        }
    }
    [[nodiscard]] WalkInput walk_input() const {
        const auto held = [this](int a, int b) { return walk_keys.contains(a) || walk_keys.contains(b) ? 1.0 : 0.0; };
        WalkInput input;
        input.forward = held(Qt::Key_W, Qt::Key_Up) - held(Qt::Key_S, Qt::Key_Down);
        input.right = held(Qt::Key_D, Qt::Key_Right) - held(Qt::Key_A, Qt::Key_Left);
        input.up = held(Qt::Key_E, Qt::Key_E) - held(Qt::Key_Q, Qt::Key_Q);
        input.fast = walk_fast;
        return input;
    }
    void start_walk_timer() {
        if (!walk_timer.isActive()) {
            walk_clock.restart();
            walk_timer.start();
        }
    }
    void walk_step() {
        // A slow frame must not become a leap through a wall.
        const double seconds = std::min(double(walk_clock.restart()) / 1000.0, 0.15);
        sync();
        WalkInput input = walk_input();
        eye_height = std::clamp(eye_height + input.up * seconds, 0.4, 3.0);
        input.up = 0;
        const dvec3 before = controller.eye();
        controller.walk(input, seconds);
        const auto floor = view.pick({controller.eye(), dvec3(0.0, -1.0, 0.0)});
        if (floor) {
            controller.settle_on_floor(floor->point.y, seconds, eye_height);
        } else {
            input.up = walk_input().up;
            controller.walk(WalkInput{0, 0, input.up, input.fast}, seconds);
        }
        if (glm::length(controller.eye() - before) > 1e-4) {
            picture_changed();
        } else if (walk_keys.isEmpty()) {
            walk_timer.stop();
        }
    }
    void frame(const DBox3& box) {
        controller.frame(box);
        picture_changed();
    }
};

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

void ViewportWidget::frame_selection() {
    const Scene& scene = impl_->doc.scene();
    DBox3 box;
    for (const NodeId id : impl_->doc.selection()->nodes()) {
        const DBox3 b = scene.subtree_bounds(id);
        if (!b.empty()) {
            box.add(b);
        } else if (scene.nodes.contains(id)) {
            const dvec3 place(scene.world_matrix(id)[3]);
            box.add(place - 0.5);
            box.add(place + 0.5);
        }
    }
    if (box.empty()) {
        frame_all();
    } else {
        impl_->frame(box);
    }
}
void ViewportWidget::look_at(const DBox3& box, const dvec3& focus, const dvec3& normal) {
    if (box.empty()) {
        return;
    }
    impl_->sync();
    if (const auto camera = camera_towards(impl_->controller, impl_->view, box, focus, normal)) {
        set_camera(*camera);
    } else {
        impl_->frame(box);
    }
}
void ViewportWidget::frame_all() { impl_->frame(robust_bounds(impl_->doc.scene())); }

void ViewportWidget::set_walk_mode(bool on) {
    if (on == impl_->walking) {
        return;
    }
    impl_->cancel();
    impl_->walking = on;
    impl_->walk_keys.clear();
    impl_->eye_height = CameraController::kEyeHeight;
    if (on) {
        setFocus(Qt::OtherFocusReason);
        impl_->start_walk_timer();
        Q_EMIT message(tr("Walk: W A S D to go, drag to look, Q E lower or raise the eye, Shift faster, Esc leaves"));
    } else {
        impl_->walk_timer.stop();
        Q_EMIT message(QString());
    }
    Q_EMIT walk_mode_changed(on);
}
bool ViewportWidget::walk_mode() const { return impl_->walking; }

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
        impl_->probe_changed();
        impl_->picture_changed();
    }
}
LightShares ViewportWidget::light_shares() const { return impl_->shares; }

void ViewportWidget::set_false_color(const std::optional<FalseColor>& scale) {
    const auto valid = scale ? std::optional(valid_scale(*scale)) : scale;
    if (valid != impl_->false_color) {
        impl_->false_color = valid;
        impl_->picture_changed();
    }
}
const std::optional<FalseColor>& ViewportWidget::false_color() const { return impl_->false_color; }

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

ViewCamera ViewportWidget::camera() const {
    ViewCamera out = impl_->controller.camera();
    out.lens.exposure_ev = impl_->exposure_ev;
    return out;
}
void ViewportWidget::set_camera(const ViewCamera& camera) {
    impl_->controller.set_camera(camera);
    impl_->picture_changed();
}

dvec3 ViewportWidget::placement_point() const {
    impl_->sync();
    const CameraController& camera = impl_->controller;
    const Ray ray = camera.ray({0.5 * camera.width(), 0.5 * camera.height()});
    const dvec3 down(0.0, -1.0, 0.0);
    if (const auto hit = impl_->view.pick(ray)) {
        if (hit->normal.y > 0.7) {
            return hit->point;
        }
        // A wall or a ceiling: the floor in front of it.
        const auto floor = impl_->view.pick({hit->point + hit->normal * 0.5 - ray.direction * 0.01, down});
        return floor ? floor->point : hit->point;
    }
    if (const auto ground = meet_plane(ray, dvec3(0.0), dvec3(0.0, 1.0, 0.0));
        ground && glm::length(*ground - ray.origin) < 50.0) {
        return *ground;
    }
    const dvec3 ahead = ray.at(std::min(camera.focus_distance(), 5.0));
    const auto floor = impl_->view.pick({ahead, down});
    return floor ? floor->point : ahead;
}

void ViewportWidget::place(const std::shared_ptr<const LibraryItem>& item) {
    impl_->cancel();
    impl_->sync();
    const CameraController& camera = impl_->controller;
    const Pointer middle{{0.5 * camera.width(), 0.5 * camera.height()}, {}};
    impl_->place_tool.begin(item);
    if (impl_->place_tool.active() && !impl_->place_tool.drop(middle) && item->scene) {
        Q_EMIT message(tr("There is no surface in the middle of the view."));
    }
    update();
}

dmat4 ViewportWidget::placement_for(const DBox3& bounds) const {
    impl_->sync();
    const CameraController& camera = impl_->controller;
    const Ray ray = camera.ray({0.5 * camera.width(), 0.5 * camera.height()});
    const auto found = placement_under(impl_->view, ray, Mount::Stand, bounds, {}, 0.0);
    return found ? *found : place_on(bounds, Mount::Stand, placement_point(), dvec3(0, 1, 0));
}

void ViewportWidget::set_snapping(const Snapping& snapping) { impl_->snapping_choice = snapping; }
const Snapping& ViewportWidget::snapping() const { return impl_->snapping_choice; }

void ViewportWidget::set_orbit_selection(bool on) { impl_->orbit_selection = on; }

void ViewportWidget::drop_to_surface() {
    Document& doc = impl_->doc;
    if (doc.in_gesture()) {
        return;
    }
    impl_->sync();
    std::vector<SceneEdit> edits;
    double most = 0;
    std::size_t without = 0;
    for (const NodeId id : doc.selection()->top_level(doc.scene())) {
        const Node* node = doc.scene().nodes.find(id);
        const std::optional<double> found = node->locked ? std::nullopt : fall_distance(impl_->view, doc.scene(), id);
        const double fall = found.value_or(0.0);
        const dmat4 parent = doc.scene().world_matrix(node->parent);
        if (!found || !(std::abs(glm::determinant(dmat3(parent))) > 0.0)) {
            ++without;
            continue;
        }
        Transform next = node->transform;
        next.translation += dvec3(glm::inverse(parent) * dvec4(0.0, -fall, 0.0, 0.0));
        edits.push_back(SceneEdit{SetTransform{id, next}});
        most = std::abs(fall) > std::abs(most) ? fall : most;
    }
    if (edits.empty()) {
        Q_EMIT message(without == 0 ? tr("Select an object first.")
                                    : tr("Nothing lies below the selection, or it is locked."));
        return;
    }
    const auto done = doc.apply(as_one(std::move(edits)), tr("Drop to surface"));
    Q_EMIT message(!done                   ? QString::fromStdString(done.error().message())
                   : std::abs(most) < 5e-4 ? tr("The selection rests already.")
                                           : tr("Lowered by %1 m").arg(QLocale().toString(most, 'f', 3)));
}

void ViewportWidget::set_isolated(bool on) {
    if (!on) {
        impl_->isolate(std::nullopt);
        return;
    }
    std::unordered_set<NodeId> nodes;
    for (const NodeId id : impl_->doc.selection()->nodes()) {
        for (const NodeId below : impl_->doc.scene().in_tree_order(id)) {
            nodes.insert(below);
        }
    }
    if (nodes.empty()) {
        Q_EMIT message(tr("Select an object first."));
        Q_EMIT isolated_changed(false);
        return;
    }
    impl_->isolate(std::move(nodes));
    Q_EMIT message(tr("Only the selection is shown; its light is that of the whole scene."));
}

void ViewportWidget::dragEnterEvent(QDragEnterEvent* event) {
    const auto* mime = qobject_cast<const SceneMime*>(event->mimeData());
    if (mime != nullptr && mime->item()) {
        impl_->cancel();
        impl_->place_tool.begin(mime->item());
        event->setDropAction(Qt::CopyAction);
        event->accept();
    } else {
        event->ignore();
    }
}

void ViewportWidget::dragMoveEvent(QDragMoveEvent* event) {
    event->setDropAction(Qt::CopyAction);
    event->setAccepted(impl_->answer_drag(event, false));
}

void ViewportWidget::dragLeaveEvent(QDragLeaveEvent* /*event*/) {
    impl_->place_tool.cancel();
    impl_->set_hovered({});
    update();
}

void ViewportWidget::dropEvent(QDropEvent* event) {
    event->setDropAction(Qt::CopyAction);
    event->setAccepted(impl_->answer_drag(event, true));
    impl_->set_hovered({});
    setFocus(Qt::OtherFocusReason);
}

dvec3 ViewportWidget::lamp_place() const { return impl_->lamp_above(placement_point()); }

ViewportWidget::DropPlace ViewportWidget::drop_place(const QPointF& point) const {
    impl_->sync();
    const auto hit = impl_->pick({point.x(), point.y()});
    if (!hit) {
        return {{}, lamp_place()};
    }
    DropPlace out{hit->node, hit->point};
    if (hit->normal.y < -0.5) {
        out.lamp += hit->normal * kBelowCeiling;
    } else if (hit->normal.y > 0.5) {
        out.lamp = impl_->lamp_above(hit->point);
    } else {
        out.lamp += hit->normal * kBeforeWall;
    }
    return out;
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
    impl_->draw_points();
    draw_axes(impl_->overlay, impl_->controller);
    impl_->collect_plates();
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

void ViewportWidget::resizeGL(int /*width*/, int /*height*/) {
    impl_->controller.set_viewport(width(), height());
    impl_->picture_changed();
}

void ViewportWidget::mousePressEvent(QMouseEvent* event) {
    impl_->flush();
    if (impl_->pressed != Qt::NoButton) {
        return; // a second button changes nothing about a drag
    }
    setFocus(Qt::MouseFocusReason);
    impl_->sync();
    const dvec2 point = to_vec(event->position());
    impl_->pressed = event->button();
    impl_->navigation = impl_->navigation_for(*event);
    impl_->refine_timer.stop();
    if (impl_->navigation != Impl::Navigation::None) {
        impl_->last_point = point;
        impl_->pivot = impl_->point_under(point);
        if (impl_->orbit_selection && impl_->navigation == Impl::Navigation::Orbit) {
            impl_->pivot = impl_->selection_centre().value_or(impl_->pivot);
        }
        impl_->set_hovered({});
    } else if (event->button() == Qt::LeftButton) {
        if (event->type() == QEvent::MouseButtonDblClick && impl_->tool_kind != ToolKind::Measure) {
            if (const auto hit = impl_->pick(point)) {
                impl_->doc.selection()->set({hit->node});
                frame_selection();
            }
            impl_->pressed = Qt::NoButton;
            return;
        }
        impl_->set_hovered({});
        impl_->tool().press({point, event->modifiers()});
        update();
    } else {
        impl_->pressed = Qt::NoButton;
    }
}

void ViewportWidget::mouseMoveEvent(QMouseEvent* event) {
    impl_->pending = Pointer{to_vec(event->position()), event->modifiers()};
    if (!impl_->pending_timer.isActive()) {
        impl_->pending_timer.start();
    }
}

void ViewportWidget::mouseReleaseEvent(QMouseEvent* event) {
    impl_->flush();
    if (event->button() != impl_->pressed) {
        return;
    }
    const dvec2 point = to_vec(event->position());
    impl_->pressed = Qt::NoButton;
    if (impl_->navigation != Impl::Navigation::None) {
        impl_->navigate(point);
        impl_->navigation = Impl::Navigation::None;
    } else if (impl_->tool().active()) {
        impl_->sync();
        impl_->tool().release({point, event->modifiers()});
        update();
    }
}

void ViewportWidget::wheelEvent(QWheelEvent* event) {
    impl_->flush();
    impl_->sync();
    // Trackpads send pixels, mice eighths of a degree (120 to a notch).
    const double steps = event->pixelDelta().isNull() ? event->angleDelta().y() / 120.0 : event->pixelDelta().y() / 60.0;
    if (steps != 0.0) {
        impl_->controller.dolly(steps, impl_->point_under(to_vec(event->position())));
        impl_->picture_changed();
    }
    event->accept();
}

void ViewportWidget::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape && impl_->tool().active()) {
        impl_->cancel();
    } else if (event->key() == Qt::Key_Escape && impl_->walking) {
        set_walk_mode(false);
    } else if (impl_->tool().active() && impl_->tool().key(event->key(), event->text())) {
        update();
    } else if (impl_->walking && (Impl::is_walk_key(event->key()) || event->key() == Qt::Key_Shift)) {
        impl_->walk_fast = event->modifiers().testFlag(Qt::ShiftModifier);
        if (!event->isAutoRepeat() && event->key() != Qt::Key_Shift) {
            impl_->walk_keys.insert(event->key());
            impl_->start_walk_timer();
        }
    } else {
        QOpenGLWidget::keyPressEvent(event);
    }
}

void ViewportWidget::keyReleaseEvent(QKeyEvent* event) {
    impl_->walk_fast = event->modifiers().testFlag(Qt::ShiftModifier) && event->key() != Qt::Key_Shift;
    if (impl_->walking && Impl::is_walk_key(event->key())) {
        if (!event->isAutoRepeat()) {
            impl_->walk_keys.remove(event->key());
        }
        return;
    }
    QOpenGLWidget::keyReleaseEvent(event);
}

void ViewportWidget::focusOutEvent(QFocusEvent* event) {
    impl_->walk_keys.clear();
    if (impl_->tool().active()) {
        impl_->cancel();
    }
    QOpenGLWidget::focusOutEvent(event);
}

bool ViewportWidget::event(QEvent* event) {
    switch (event->type()) {
    case QEvent::ShortcutOverride: {
        const auto* key = static_cast<QKeyEvent*>(event);
        const bool walk_key = impl_->walking && (key->key() == Qt::Key_Escape || Impl::is_walk_key(key->key()));
        if (impl_->tool().active() || walk_key) {
            event->accept();
            return true;
        }
        break;
    }
    case QEvent::Leave:
        impl_->pending.reset();
        impl_->set_hovered({});
        impl_->tool().leave();
        update();
        break;
    case QEvent::NativeGesture: {
        const auto* gesture = static_cast<QNativeGestureEvent*>(event);
        if (gesture->gestureType() == Qt::ZoomNativeGesture) {
            impl_->sync();
            impl_->controller.dolly(gesture->value() * kPinchSteps, impl_->point_under(to_vec(gesture->position())));
            impl_->picture_changed();
            return true;
        }
        break;
    }
    default: break;
    }
    return QOpenGLWidget::event(event);
}

} // namespace atrium::ui
