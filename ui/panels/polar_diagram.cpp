#include "ui/panels/polar_diagram.h"

#include "engine/base/units.h"
#include "engine/scene/photometric_web.h"

#include <QLocale>
#include <QPainter>

#include <algorithm>

namespace atrium::ui {

namespace {

constexpr int kSteps = 360; // of a curve, all round
constexpr double kMargin = 4.0;

/// Intensity over the peak in a plane, `degrees` from straight down, negative on the side of plane + 180.
double share_at(const PhotometricWeb& web, double plane, double degrees) {
    const double v = radians_from_degrees(degrees);
    const double h = radians_from_degrees(plane);
    return double(web.relative(vec3(dvec3(std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), -std::cos(v)))));
}

/// A round number of candela for the outer ring, at least the greatest of what is drawn.
double ring_end(double peak) {
    const double magnitude = std::pow(10.0, std::floor(std::log10(peak)));
    for (const double factor : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
        if (peak <= factor * magnitude) {
            return factor * magnitude;
        }
    }
    return 10.0 * magnitude;
}

} // namespace

PolarDiagram::PolarDiagram(QWidget* parent) : QWidget(parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setAccessibleName(tr("Polar diagram"));
    setToolTip(tr("Luminous intensity over directions; straight down is at the bottom"));
}

void PolarDiagram::set_photometry(const Photometry& photometry) {
    if (photometry_ == photometry) {
        return;
    }
    photometry_ = photometry;
    updateGeometry();
    update();
}

QSize PolarDiagram::sizeHint() const { return {260, 190}; }

void PolarDiagram::paintEvent(QPaintEvent* /*event*/) {
    if (!photometry_) {
        return;
    }
    const PhotometricWeb& web = *photometry_.web;
    double above = 0.0, below = 0.0;
    for (int k = 0; k <= 90; ++k) {
        for (const double plane : {0.0, 90.0, 180.0, 270.0}) {
            below = std::max(below, share_at(web, plane, k));
            above = std::max(above, share_at(web, plane, 180.0 - k));
        }
    }
    // What shines one way only has half a diagram, twice as large.
    constexpr double kLittle = 0.02;
    const bool up = above > kLittle, down = below > kLittle || !up;

    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QFont small = font();
    small.setPointSizeF(std::max(small.pointSizeF() * 0.8, 6.0));
    painter.setFont(small);
    const QFontMetricsF metrics(small);
    const double legend = metrics.height() + 4.0;
    const double height = double(rect().height()) - legend - 2.0 * kMargin - metrics.height();
    const double radius =
        std::min(0.5 * double(rect().width()) - metrics.horizontalAdvance(QStringLiteral("90°")) - 2.0 * kMargin,
                 up && down ? 0.5 * height : height - metrics.height());
    if (radius < 20.0) {
        return;
    }
    const double top = kMargin + (up ? (down ? radius : radius + metrics.height()) : metrics.height());
    const QPointF centre(0.5 * double(rect().width()), top);
    const auto point = [&](double degrees, double share) { // 0 = straight down, clockwise negative
        const double a = radians_from_degrees(degrees);
        return centre + radius * share * QPointF(std::sin(a), std::cos(a));
    };

    QColor grid = palette().color(QPalette::WindowText);
    grid.setAlpha(60);
    QColor text = palette().color(QPalette::WindowText);
    text.setAlpha(170);
    painter.setPen(QPen(grid, 1.0));
    // The greatest intensity may lie between the planes that are drawn.
    const double most = std::max(above, below) > 0.0 ? std::max(above, below) : 1.0;
    const double end = ring_end(most * double(web.peak()));
    const int start = down ? (up ? 0 : 180) : 0; // Qt counts from 3 o'clock, counter-clockwise, in sixteenths
    const int span = up && down ? 360 : 180;
    for (int ring = 1; ring <= 4; ++ring) {
        const double r = radius * ring / 4.0;
        painter.drawArc(QRectF(centre.x() - r, centre.y() - r, 2.0 * r, 2.0 * r), 16 * start, 16 * span);
    }
    for (int degrees = -150; degrees <= 180; degrees += 30) {
        const bool shown = std::abs(degrees) == 90 || (std::abs(degrees) < 90 ? down : up);
        if (shown) {
            painter.drawLine(centre, point(degrees, 1.0));
        }
    }
    painter.setPen(text);
    for (const int degrees : {-90, -60, -30, 30, 60, 90}) {
        if (std::abs(degrees) < 90 && !down) {
            continue;
        }
        const QString label = QStringLiteral("%1°").arg(std::abs(degrees));
        const QPointF at = point(degrees, 1.0 + 8.0 / radius);
        const QSizeF size(metrics.horizontalAdvance(label), metrics.height());
        const double left = degrees < 0 ? at.x() - size.width() : at.x();
        painter.drawText(QRectF(QPointF(left, at.y() - 0.5 * size.height()), size), Qt::AlignCenter, label);
    }

    const auto curve = [&](double plane) {
        QPolygonF out;
        for (int k = 0; k <= kSteps; ++k) {
            const double degrees = -180.0 + 360.0 * k / kSteps;
            out << point(degrees, share_at(web, plane, degrees) * double(web.peak()) / end);
        }
        return out;
    };
    const QColor line = palette().color(QPalette::Highlight);
    QColor fill = line;
    fill.setAlpha(50);
    const QPolygonF across = curve(0.0), along = curve(90.0);
    painter.setPen(QPen(line, 1.6));
    painter.setBrush(fill);
    painter.drawPolygon(across);
    const bool same = web.symmetry() == PhotometricWeb::Symmetry::Axial && web.data().type == PhotometryType::C;
    if (!same) {
        painter.setBrush(Qt::NoBrush);
        QPen dashed(palette().color(QPalette::WindowText), 1.4, Qt::DashLine);
        painter.setPen(dashed);
        painter.drawPolygon(along);
    }

    // Legend, and what the outer ring stands for.
    const double base = double(rect().height()) - 0.5 * legend;
    painter.setPen(text);
    const QString scale = tr("ring %1 cd").arg(QLocale().toString(end, 'g', 6));
    painter.drawText(QRectF(0.0, base - 0.5 * legend, double(rect().width()) - kMargin, legend),
                     Qt::AlignRight | Qt::AlignVCenter, scale);
    double x = kMargin;
    const auto entry = [&](const QPen& pen, const QString& label) {
        painter.setPen(pen);
        painter.drawLine(QPointF(x, base), QPointF(x + 16.0, base));
        painter.setPen(text);
        painter.drawText(QRectF(x + 20.0, base - 0.5 * legend, 120.0, legend), Qt::AlignLeft | Qt::AlignVCenter, label);
        x += 30.0 + metrics.horizontalAdvance(label);
    };
    entry(QPen(line, 2.0), same ? tr("all planes") : QStringLiteral("C0–C180"));
    if (!same) {
        entry(QPen(palette().color(QPalette::WindowText), 1.4, Qt::DashLine), QStringLiteral("C90–C270"));
    }
}

} // namespace atrium::ui
