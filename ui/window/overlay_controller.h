// View > Overlays: turns the overlays of the viewport on and off, and tells why one cannot be had.
#pragma once

#include "ui/actions/actions.h"
#include "ui/document/engine_link.h"

#include <QObject>

class QMenu;

namespace atrium::ui {

class ViewportWidget;

/// UI thread only. What is on lasts as long as the window; solutions are asked for what is needed, and no longer than that.
class OverlayController : public QObject {
    Q_OBJECT
public:
    OverlayController(const Actions& actions, EngineLink& engine, ViewportWidget& viewport, QObject* parent);
    void fill(QMenu* menu) const;
    /// Why overlays that look into the solver cannot be turned on now; empty = they can.
    [[nodiscard]] QString refusal() const;

private:
    void apply();
    void refresh();
    const Actions& actions_;
    EngineLink& engine_;
    ViewportWidget& viewport_;
};

} // namespace atrium::ui
