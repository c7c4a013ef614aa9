// Move, rotate and scale by handles (and, when moving, by the object itself): one gesture, one undo entry.
#pragma once

#include "ui/document/gesture.h"
#include "ui/tools/gizmo.h"
#include "ui/tools/select_tool.h"

#include <QString>

#include <memory>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

namespace atrium::ui {

/// Common to the three: finds the targets, opens the gesture, follows the mouse, snaps, takes typed numbers.
/// Snaps by the steps of ToolHost::snapping(), Ctrl turns snapping round; Shift moves ten times finer, Esc restores.
class TransformTool : public SelectTool {
public:
    TransformTool(ToolHost& host, GizmoKind kind) : SelectTool(host), kind_(kind) {}

    void press(const Pointer& pointer) override;
    void move(const Pointer& pointer) override;
    void release(const Pointer& pointer) override;
    void cancel() override;
    [[nodiscard]] bool active() const override { return drag_ != nullptr || armed_ || SelectTool::active(); }
    bool key(int key, const QString& text) override;
    bool hover(const Pointer& pointer) override;
    void draw(OverlayBatch& batch) const override;

    /// The gizmo for the present selection; none when nothing movable is selected.
    [[nodiscard]] std::optional<Gizmo> gizmo() const;

protected:
    struct Target {
        NodeId node;
        Transform start;
        dmat4 parent{1.0}; ///< world matrix of the parent when the drag began
        dmat4 parent_inverse{1.0};
    };
    struct Drag {
        std::unique_ptr<Gesture> gesture;
        std::vector<Target> targets;
        Gizmo gizmo; ///< as it stood when the drag began
        Handle handle = Handle::None;
        dvec3 normal{0.0, 1.0, 0.0}; ///< of the plane that the mouse is followed in
        dvec3 grabbed{0.0};          ///< point under the cursor at the start
        dvec2 last_point{0.0};
        dvec3 last_raw{0.0};
        dvec3 amount{0.0}; ///< before snapping: metres per gizmo axis, radians in x, or factors - 1
        bool has_raw = false;
        bool body = false;               ///< dragged by the object itself, not by a handle
        DBox3 bounds;                    ///< of all targets in the world when the drag began; may be empty
        std::unordered_set<NodeId> own;  ///< targets and all below them
        std::vector<DBox3> others;       ///< bounds of everything else that is shown
        std::vector<dvec3> corners;      ///< of the bounds in the first target's own axes, world scale, about its origin
        std::optional<dvec3> slide_from; ///< normal of the surface that the slide began on
        dvec3 slide_offset{0.0};         ///< along that surface, from under the cursor to where the object stands
    };

    /// Unsnapped amount for a mouse position, measured from the start; none where the geometry gives no answer.
    virtual std::optional<dvec3> measure(const Drag& drag, const Ray& ray, const dvec2& point) const = 0;
    /// `amount` in steps; may leave lines to show in hints_.
    [[nodiscard]] virtual dvec3 snapped(const Drag& drag, const dvec3& amount) = 0;
    /// Amount that a typed number stands for.
    [[nodiscard]] virtual dvec3 from_number(const Drag& drag, double number) const = 0;
    [[nodiscard]] virtual Transform moved(const Drag& drag, const Target& target, const dvec3& amount) const = 0;
    [[nodiscard]] virtual QString read_out(const Drag& drag, const dvec3& amount) const = 0;
    [[nodiscard]] virtual QString undo_text() const = 0;
    /// Whether a drag that begins on a node moves it.
    [[nodiscard]] virtual bool drags_body(NodeId /*node*/, const Pointer& /*pointer*/) const { return false; }
    [[nodiscard]] virtual bool has_handles() const { return true; }
    /// The node, or one above it, is selected.
    [[nodiscard]] bool in_selection(NodeId node) const;

    /// Writes a signed number with the user's decimal separator.
    static QString number(double value, int decimals);

    /// World lines that say what the drag has snapped to, and the same in words.
    std::vector<std::pair<dvec3, dvec3>> hints_;
    QString hint_text_;

private:
    [[nodiscard]] Handle handle_at(const dvec2& point) const;
    [[nodiscard]] std::vector<NodeId> targets() const;
    bool begin(Handle handle, const dvec2& point, std::optional<dvec3> body);
    void apply(const dvec3& amount);
    void remember_bounds(Drag& drag) const;
    bool slide(const Pointer& pointer);
    void finish();

    GizmoKind kind_;
    std::unique_ptr<Drag> drag_;
    bool armed_ = false; ///< pressed on an object: a click or the start of a body drag
    dvec2 press_point_{0.0};
    std::optional<PickHit> press_hit_;
    Handle hovered_ = Handle::None;
    QString typed_;
};

class MoveTool : public TransformTool {
public:
    explicit MoveTool(ToolHost& host) : TransformTool(host, GizmoKind::Move) {}

protected:
    std::optional<dvec3> measure(const Drag& drag, const Ray& ray, const dvec2& point) const override;
    [[nodiscard]] dvec3 snapped(const Drag& drag, const dvec3& amount) override;
    [[nodiscard]] dvec3 from_number(const Drag& drag, double number) const override;
    [[nodiscard]] Transform moved(const Drag& drag, const Target& target, const dvec3& amount) const override;
    [[nodiscard]] QString read_out(const Drag& drag, const dvec3& amount) const override;
    [[nodiscard]] QString undo_text() const override;
    [[nodiscard]] bool drags_body(NodeId /*node*/, const Pointer& /*pointer*/) const override { return true; }
};

/// The select tool: a drag that begins on something selected moves the selection as the move tool does, one that begins
/// anywhere else spans a box; with Ctrl or Shift held it is a box everywhere.
class SelectAndMoveTool : public MoveTool {
public:
    using MoveTool::MoveTool;
    /// A drag from there would move the selection.
    [[nodiscard]] bool grabs(NodeId node) const { return in_selection(node) && gizmo().has_value(); }

protected:
    [[nodiscard]] bool drags_body(NodeId node, const Pointer& pointer) const override {
        return (pointer.modifiers & (Qt::ControlModifier | Qt::ShiftModifier)) == 0 && grabs(node);
    }
    [[nodiscard]] bool has_handles() const override { return false; }
};

class RotateTool : public TransformTool {
public:
    explicit RotateTool(ToolHost& host) : TransformTool(host, GizmoKind::Rotate) {}

protected:
    std::optional<dvec3> measure(const Drag& drag, const Ray& ray, const dvec2& point) const override;
    [[nodiscard]] dvec3 snapped(const Drag& drag, const dvec3& amount) override;
    [[nodiscard]] dvec3 from_number(const Drag& drag, double number) const override;
    [[nodiscard]] Transform moved(const Drag& drag, const Target& target, const dvec3& amount) const override;
    [[nodiscard]] QString read_out(const Drag& drag, const dvec3& amount) const override;
    [[nodiscard]] QString undo_text() const override;
};

class ScaleTool : public TransformTool {
public:
    explicit ScaleTool(ToolHost& host) : TransformTool(host, GizmoKind::Scale) {}

protected:
    std::optional<dvec3> measure(const Drag& drag, const Ray& ray, const dvec2& point) const override;
    [[nodiscard]] dvec3 snapped(const Drag& drag, const dvec3& amount) override;
    [[nodiscard]] dvec3 from_number(const Drag& drag, double number) const override;
    [[nodiscard]] Transform moved(const Drag& drag, const Target& target, const dvec3& amount) const override;
    [[nodiscard]] QString read_out(const Drag& drag, const dvec3& amount) const override;
    [[nodiscard]] QString undo_text() const override;
};

} // namespace atrium::ui
