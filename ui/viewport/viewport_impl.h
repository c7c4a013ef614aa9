// What the viewport holds; for the viewport_*.cpp files beside it and nobody else. Their names tell what each does.
#pragma once

#include "engine/view/tone.h"
#include "ui/tools/measure_tool.h"
#include "ui/tools/place_tool.h"
#include "ui/tools/transform_tool.h"
#include "ui/viewport/light_inspector.h"
#include "ui/viewport/markers.h"
#include "ui/viewport/picture_renderer.h"
#include "ui/viewport/specular_overlay.h"
#include "ui/viewport/viewport_widget.h"

#include <QElapsedTimer>
#include <QSet>
#include <QTimer>

#include <array>
#include <unordered_set>

class QDropEvent;
class QMouseEvent;

namespace atrium::ui {

inline dvec2 to_vec(const QPointF& p) { return {p.x(), p.y()}; }

struct ViewportWidget::Impl final : ToolHost {
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
    SelectAndMoveTool* select = nullptr; ///< one of them
    MeasureTool* measure = nullptr;      ///< another
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
    LightInspector inspector;
    /// What legend_image shows.
    struct LegendOf {
        FalseColor scale;
        QString title;
        std::vector<float> bars;
        QString style; ///< font, palette, pixel ratio
        friend bool operator==(const LegendOf&, const LegendOf&) = default;
    };
    std::optional<LegendOf> legend_of;
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

    Impl(ViewportWidget& w, Document& d, EngineLink& e);

    /// Where a lamp hangs over a point on a floor: no higher than a ceiling lets it.
    [[nodiscard]] dvec3 lamp_above(const dvec3& floor) const;

    // ---- ToolHost ----
    Document& document() override { return doc; }
    [[nodiscard]] const CameraController& camera() const override { return controller; }
    void show_message(const QString& text) override { Q_EMIT widget.message(text); }
    [[nodiscard]] const ViewScene& view_scene() const override { return view; }
    [[nodiscard]] const Snapping& snapping() const override { return snapping_choice; }
    /// What is added while some objects are shown alone is shown, too.
    void note_isolated(const SceneEdit& edit);
    void isolate(std::optional<std::unordered_set<NodeId>> nodes);
    /// Middle of what is selected, for turning about it.
    [[nodiscard]] std::optional<dvec3> selection_centre() const;
    bool answer_drag(QDropEvent* event, bool drop);
    [[nodiscard]] std::optional<PickHit> pick(const dvec2& point) const override;

    [[nodiscard]] std::optional<MeterReading> read_light(const dvec2& point) const override;
    MeasuringPoints& measuring_points() override;
    /// Of the light on show; null where it is not known.
    [[nodiscard]] std::shared_ptr<const LocalError> local_error() const;

    [[nodiscard]] Tool& tool() { return *tools[std::size_t(tool_kind)]; }
    [[nodiscard]] float scale() const { return exposure_scale(mean_radiance, exposure_ev); }

    // ---- what changed ----
    void picture_changed();
    /// What is traced over the picture once it rests: mirrors and glass as a still shows them.
    [[nodiscard]] std::optional<SpecularOverlay::Request> specular_request();
    /// Mirrors follow when everything else has rested a little.
    void probe_changed();
    void step_probe();
    void scene_changed();
    void selection_changed();
    void set_hovered(NodeId id);
    void document_reset();
    void open_view();
    void stop_awaiting();
    /// The old light stays until the new one's maps are uploaded, a slice in each turn of the event loop: a wall that waits
    /// for its sun would flicker.
    void take_solution();
    void take(std::shared_ptr<const Solution> light);
    void step_upload();
    void show_awaited();
    /// Brings the items up to date before anything is asked of them.
    void sync();

    // ---- words over the picture ----
    void collect_plates();
    [[nodiscard]] std::optional<LegendOf> wanted_legend() const;
    void draw_points();
    /// Labels beside the points, where they are in sight, and beside the cursor.
    void collect_labels(double ratio);

    // ---- mouse ----
    [[nodiscard]] dvec3 point_under(const dvec2& point) const;
    void flush();
    void navigate(const dvec2& point);
    [[nodiscard]] Navigation navigation_for(const QMouseEvent& event) const;
    void cancel();

    // ---- walking ----
    static bool is_walk_key(int key);
    [[nodiscard]] WalkInput walk_input() const;
    void start_walk_timer();
    void walk_step();
    void frame(const DBox3& box);
};

} // namespace atrium::ui
