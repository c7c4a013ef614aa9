// The scale of a picture in false colour, drawn over views and into exported pictures.
#pragma once

#include "engine/view/false_color.h"

#include <QFont>
#include <QImage>
#include <QPalette>
#include <QStringList>

class QPainter;

namespace atrium::ui {

/// "Illuminance" or "Luminance", translated.
QString quantity_text(LightQuantity quantity);
/// An amount of light for reading: three digits at most after rounding, with thousands kept whole; no unit.
QString amount_text(double amount);

/// A column of colours with round amounts beside it and the unit above, on a plate in the palette's colours.
class Legend {
public:
    Legend(const FalseColor& scale, const QFont& font, const QPalette& palette);
    /// The scale of something else than light: `title` has two lines, a name and a unit. `bars`: from the low end to the
    /// high one, 0 to 1, drawn beside the column; none where empty.
    Legend(const FalseColor& scale, const QString& title, const std::vector<float>& bars, const QFont& font,
           const QPalette& palette);
    /// "Illuminance" and below it "lx".
    static QString light_title(LightQuantity quantity);
    [[nodiscard]] QSizeF size() const { return size_; } ///< logical pixels
    void paint(QPainter& painter, const QPointF& top_left) const;
    [[nodiscard]] QImage image(double pixel_ratio) const;
    [[nodiscard]] const std::vector<double>& values() const { return values_; } ///< that are written beside the column

private:
    FalseColor scale_;
    QFont font_;
    QPalette palette_;
    std::vector<double> values_;
    QStringList texts_;
    QString title_;
    std::vector<float> bars_;
    QSizeF size_;
    double line_ = 0; ///< height of a line of text
};

/// Lines of text on a rounded plate in the palette's colours, for labels over the view.
QImage label_image(const QStringList& lines, const QFont& font, const QPalette& palette, double pixel_ratio);

} // namespace atrium::ui
