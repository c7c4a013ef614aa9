// What the left mouse button drives: press, move, release, cancel.
#pragma once

#include "ui/document/document.h"
#include "ui/tools/snapping.h"
#include "ui/viewport/light_meter.h"
#include "ui/viewport/overlay_batch.h"
#include "ui/viewport/view_scene.h"

#include <QString>

namespace atrium::ui {

/// Mouse as a tool sees it: logical pixels from the view's top left corner.
struct Pointer {
    dvec2 position{0.0};
    Qt::KeyboardModifiers modifiers;
};

/// What a tool may ask of the view it works in.
class ToolHost {
public:
    virtual ~ToolHost() = default;
    virtual Document& document() = 0;
    [[nodiscard]] virtual const CameraController& camera() const = 0;
    /// Surface, light or camera icon under a point; none for the background.
    [[nodiscard]] virtual std::optional<PickHit> pick(const dvec2& point) const = 0;
    /// What is shown, for questions about surfaces.
    [[nodiscard]] virtual const ViewScene& view_scene() const = 0;
    [[nodiscard]] virtual const Snapping& snapping() const = 0;
    virtual void show_message(const QString& text) = 0;
    /// The light on the surface under a point; none where there is nothing to be measured.
    [[nodiscard]] virtual std::optional<MeterReading> read_light(const dvec2& point) const = 0;
    virtual MeasuringPoints& measuring_points() = 0;
};

/// UI thread only. A drag lasts from press() to release() or cancel().
class Tool {
public:
    explicit Tool(ToolHost& host) : host_(host) {}
    virtual ~Tool() = default;
    Tool(const Tool&) = delete;
    Tool& operator=(const Tool&) = delete;

    virtual void press(const Pointer& pointer) = 0;
    virtual void move(const Pointer& pointer) = 0;
    virtual void release(const Pointer& pointer) = 0;
    /// Esc, lost focus, another tool: as if press() had never been.
    virtual void cancel() = 0;
    [[nodiscard]] virtual bool active() const = 0; ///< between press and release
    /// Key during a drag (typed numbers); true when used.
    virtual bool key(int /*key*/, const QString& /*text*/) { return false; }
    /// Mouse moved without a button; true when what draw() shows changed.
    virtual bool hover(const Pointer& /*pointer*/) { return false; }
    virtual void leave() {} ///< the mouse left the view
    virtual void draw(OverlayBatch& /*batch*/) const {}

protected:
    ToolHost& host_;
};

/// Movement below this many logical pixels is a click.
inline constexpr double kClickRadius = 4.0;

} // namespace atrium::ui
