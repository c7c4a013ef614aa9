#include "ui/panels/color_button.h"

#include <QColorDialog>
#include <QPaintEvent>
#include <QPainter>
#include <QStyle>
#include <QStyleOptionFocusRect>

#include <algorithm>

namespace atrium::ui {

QColor display_swatch(const Rgb& linear) {
    const auto channel = [](float v) { return std::clamp(linear_to_srgb(std::clamp(v, 0.0F, 1.0F)), 0.0F, 1.0F); };
    return QColor::fromRgbF(channel(linear.r), channel(linear.g), channel(linear.b));
}

Rgb linear_from_color(const QColor& color) {
    return {srgb_to_linear(float(color.redF())), srgb_to_linear(float(color.greenF())),
            srgb_to_linear(float(color.blueF()))};
}

ColorButton::ColorButton(QWidget* parent) : QToolButton(parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setMinimumHeight(24);
    setFocusPolicy(Qt::StrongFocus);
    setToolTip(tr("Choose a colour"));
    connect(this, &QToolButton::clicked, this, &ColorButton::open_dialog);
}

void ColorButton::set_color(const Rgb& linear, bool mixed) {
    color_ = linear;
    mixed_ = mixed;
    const QColor shown = display_swatch(linear);
    setAccessibleDescription(mixed ? tr("mixed") : shown.name());
    update();
}

void ColorButton::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const QRect area = rect().adjusted(1, 1, -2, -2);
    painter.setPen(palette().color(QPalette::Mid));
    painter.setBrush(isEnabled() && !mixed_ ? QBrush(display_swatch(color_)) : QBrush(palette().color(QPalette::Window)));
    painter.drawRoundedRect(area, 3, 3);
    if (mixed_) {
        painter.setPen(palette().color(QPalette::Text));
        painter.drawText(area, Qt::AlignCenter, tr("mixed"));
    }
    if (hasFocus()) {
        painter.setPen(QPen(palette().color(QPalette::Highlight), 2));
        painter.setBrush(Qt::NoBrush);
        painter.drawRoundedRect(area, 3, 3);
    }
}

void ColorButton::open_dialog() {
    auto* dialog = new QColorDialog(display_swatch(color_), this);
    dialog->setObjectName(QStringLiteral("color_dialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(accessibleName());
    dialog->setOption(QColorDialog::DontUseNativeDialog); // the native one does not report while choosing
    Q_EMIT started();
    connect(dialog, &QColorDialog::currentColorChanged, this,
            [this](const QColor& color) { Q_EMIT edited(linear_from_color(color)); });
    connect(dialog, &QDialog::finished, this, [this](int result) {
        if (result == QDialog::Accepted) {
            Q_EMIT finished();
        } else {
            Q_EMIT cancelled();
        }
    });
    dialog->open();
}

} // namespace atrium::ui
