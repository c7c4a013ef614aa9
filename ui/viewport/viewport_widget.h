// The OpenGL viewport: thin. Camera, picking, drawing and tools live in their own classes beside it.
#pragma once

#include "engine/view/false_color.h"
#include "engine/view/still.h"
#include "ui/document/document.h"
#include "ui/document/engine_link.h"
#include "ui/document/library.h"
#include "ui/tools/snapping.h"
#include "ui/viewport/light_inspector.h"
#include "ui/viewport/light_meter.h"
#include "ui/viewport/light_views.h"

#include <QOpenGLWidget>

#include <memory>
#include <optional>

namespace atrium::ui {

/// Which tool the left button drives.
enum class ToolKind : std::uint8_t { Select, Move, Rotate, Scale, Measure };

/// UI thread only.
class ViewportWidget : public QOpenGLWidget {
    Q_OBJECT
public:
    ViewportWidget(Document& document, EngineLink& engine, QWidget* parent = nullptr);
    ~ViewportWidget() override;

    void set_tool(ToolKind tool);
    [[nodiscard]] ToolKind tool() const;
    void frame_selection(); ///< or everything when nothing is selected
    void frame_all();
    /// Looks at `focus` on a surface with this normal (world, unit; zero: the direction of view stays) from where most of
    /// `box` is in sight and nothing stands between; nothing happens when the box is empty.
    void look_at(const DBox3& box, const dvec3& focus, const dvec3& normal);
    void set_walk_mode(bool on); ///< WASD and mouse look, eye at 1.6 m above the floor below; Esc leaves
    [[nodiscard]] bool walk_mode() const;
    void set_exposure(float ev); ///< stops, added to automatic exposure; never reaches the solver
    [[nodiscard]] float exposure() const;
    void set_wireframe(bool on);     ///< the display mesh's edges over the picture
    void set_caustic_boxes(bool on); ///< outlines of the caustic textures over the picture
    void set_texel_grid(bool on);    ///< texels of the selected objects' caustic textures, where they are large enough
    void set_landings(bool on);      ///< particles where they landed on the selected objects, as far as the light tells
    void set_caustic_view(CausticView view); ///< the light as it is, or as other ways to show it would have it
    [[nodiscard]] CausticView caustic_view() const;
    [[nodiscard]] std::shared_ptr<const Solution> shown_solution() const; ///< the light in the picture; may be null
    void set_cut_walls(bool on); ///< from outside, leave out the walls and the ceiling in front of the room (the default)
    void set_light_shares(const LightShares& shares); ///< what of the light is shown; all by default
    [[nodiscard]] LightShares light_shares() const;
    /// Amounts of light on this scale, with its legend, instead of the picture; none for the picture.
    void set_false_color(const std::optional<FalseColor>& scale);
    [[nodiscard]] const std::optional<FalseColor>& false_color() const;
    /// Overlays by which the light is inspected. What they need of solutions is asked for by whoever turns them on
    /// (EngineLink::keep_insides).
    void set_inspection(const InspectionChoice& choice);
    [[nodiscard]] const LightInspector& inspector() const;
    /// Draws the links of the element under a point of the view, logical pixels, as a click does; false where there is none.
    bool inspect_element(const QPointF& point);
    /// What the measuring tool left behind, with readings of the light that is shown. They last as long as the document.
    [[nodiscard]] const MeasuringPoints& measuring_points() const;
    void clear_measuring_points();
    /// Puts one at a point of the view, logical pixels; false where there is nothing to be measured.
    bool add_measuring_point(const QPointF& point);
    /// The light under a point of the view, logical pixels; none where there is nothing to be measured.
    [[nodiscard]] std::optional<MeterReading> light_at(const QPointF& point);
    /// The next frame has the smooth edges of a view at rest, however long that takes here; until something changes.
    void refine_now();
    [[nodiscard]] ViewCamera camera() const; ///< as seen now, for "export picture"
    void set_camera(const ViewCamera& camera);
    /// Point on the floor or nearest surface in the middle of the view: where new objects are placed, world metres.
    [[nodiscard]] dvec3 placement_point() const;
    /// Puts a library object on the surface in the middle of the view and selects it: one undo entry.
    void place(const std::shared_ptr<const LibraryItem>& item);
    /// World placement of an object with these bounds on the surface in the middle of the view.
    [[nodiscard]] dmat4 placement_for(const DBox3& bounds) const;
    void set_snapping(const Snapping& snapping);
    [[nodiscard]] const Snapping& snapping() const;
    /// Lets the selected objects fall until they rest on something: one undo entry.
    void drop_to_surface();
    /// Shows the selected objects alone, or everything again; the light stays that of the whole scene.
    void set_isolated(bool on);
    void set_orbit_selection(bool on); ///< turn about what is selected instead of about the point under the cursor

    /// What lies under a point of the widget, for something that is dropped there.
    struct DropPlace {
        NodeId node;     ///< the object or lamp there; none beside everything
        dvec3 lamp{0.0}; ///< where a lamp would hang: below a ceiling, before a wall, above a floor; world metres
    };
    [[nodiscard]] DropPlace drop_place(const QPointF& point) const;
    [[nodiscard]] dvec3 lamp_place() const; ///< above placement_point(), below the ceiling, world metres

Q_SIGNALS:
    void tool_changed(atrium::ui::ToolKind tool);
    void walk_mode_changed(bool on);
    void isolated_changed(bool on);
    void message(const QString& text); ///< for the status bar: drag read-outs ("x +0.25 m"), hints

protected:
    void initializeGL() override;
    void paintGL() override;
    void resizeGL(int width, int height) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override; ///< library entries; files go on to the window
    void dragMoveEvent(QDragMoveEvent* event) override;
    void dragLeaveEvent(QDragLeaveEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    bool event(QEvent* event) override; ///< keys that a drag or walking needs before shortcuts, pinch, leave

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace atrium::ui
