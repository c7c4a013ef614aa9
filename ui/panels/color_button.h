// A swatch of a linear colour that opens the colour dialog; every colour tried in it is shown at once.
#pragma once

#include "engine/base/units.h"

#include <QToolButton>

class QColorDialog;

namespace atrium::ui {

/// Nearest 8-bit sRGB colour of a linear one, clamped.
QColor display_swatch(const Rgb& linear);
Rgb linear_from_color(const QColor& color);

/// UI thread only. Signals as NumberField's: one gesture from opening the dialog to closing it.
class ColorButton : public QToolButton {
    Q_OBJECT
public:
    explicit ColorButton(QWidget* parent = nullptr);
    void set_color(const Rgb& linear, bool mixed);

Q_SIGNALS:
    void started();
    void edited(const atrium::Rgb& linear);
    void finished();
    void cancelled();

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void open_dialog();
    Rgb color_{0.0F};
    bool mixed_ = false;
};

} // namespace atrium::ui
