#include "ui/viewport/legend.h"

#include <QCoreApplication>
#include <QFontMetricsF>
#include <QLocale>
#include <QPainter>
#include <QPainterPath>

#include <algorithm>
#include <cmath>

namespace atrium::ui {
namespace {

constexpr double kMargin = 9.0; ///< all in logical pixels
constexpr double kColumn = 16.0;
constexpr double kGap = 6.0;
constexpr double kTick = 4.0;
constexpr double kRadius = 4.0;
constexpr double kLines = 15.0; ///< lines of text that the column is high
constexpr double kBars = 56.0;  ///< width of the longest bar, with its gap

QString tr_legend(const char* text) { return QCoreApplication::translate("Legend", text); }

void plate(QPainter& painter, const QRectF& area, const QPalette& palette) {
    QColor ground = palette.color(QPalette::Active, QPalette::Base);
    ground.setAlphaF(0.9F);
    QColor rim = palette.color(QPalette::Active, QPalette::Text);
    rim.setAlphaF(0.35F);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(rim, 1.0));
    painter.setBrush(ground);
    painter.drawRoundedRect(area.adjusted(0.5, 0.5, -0.5, -0.5), kRadius, kRadius);
}

QImage clear_image(const QSizeF& size, double pixel_ratio) {
    QImage out((size * pixel_ratio).toSize(), QImage::Format_RGBA8888_Premultiplied);
    out.setDevicePixelRatio(pixel_ratio);
    out.fill(Qt::transparent);
    return out;
}

} // namespace

QString quantity_text(LightQuantity quantity) {
    return quantity == LightQuantity::Illuminance ? tr_legend(QT_TRANSLATE_NOOP("Legend", "Illuminance"))
                                                  : tr_legend(QT_TRANSLATE_NOOP("Legend", "Luminance"));
}

QString amount_text(double amount) {
    const QLocale locale;
    const double size = std::abs(amount);
    if (size >= 1000.0) {
        const double unit = std::pow(10.0, std::floor(std::log10(size)) - 2.0);
        return locale.toString(std::round(amount / unit) * unit, 'f', 0);
    }
    if (size > 0.0 && size < 0.01) {
        return locale.toString(amount, 'g', 2);
    }
    const int digits = size >= 100.0 ? 0 : size >= 10.0 ? 1 : size >= 1.0 ? 2 : 3;
    QString text = locale.toString(amount, 'f', digits);
    if (text.contains(locale.decimalPoint())) {
        while (text.endsWith(locale.zeroDigit())) {
            text.chop(1);
        }
        if (text.endsWith(locale.decimalPoint())) {
            text.chop(1);
        }
    }
    return text;
}

QString Legend::light_title(LightQuantity quantity) {
    return QStringLiteral("%1\n%2").arg(quantity_text(quantity), QString::fromUtf8(unit_name(quantity)));
}

Legend::Legend(const FalseColor& scale, const QFont& font, const QPalette& palette)
    : Legend(scale, light_title(scale.quantity), {}, font, palette) {}

Legend::Legend(const FalseColor& scale, const QString& title, const std::vector<float>& bars, const QFont& font,
               const QPalette& palette)
    : scale_(valid_scale(scale)), font_(font), palette_(palette), values_(round_values(scale_)), title_(title), bars_(bars) {
    const QFontMetricsF metrics(font_);
    line_ = metrics.height();
    // The ends are always written, and round amounts where they leave them room.
    const double column = kLines * line_;
    const auto height_of = [&](double value) { return double(scale_place(scale_, value)) * column; };
    std::erase_if(values_, [&](double value) {
        const double at = height_of(value);
        const bool low = at < line_ && value != scale_.minimum;
        const bool high = at > column - line_ && value != scale_.maximum;
        return low || high;
    });
    if (values_.empty() || values_.front() != scale_.minimum) {
        values_.insert(values_.begin(), scale_.minimum);
    }
    if (values_.back() != scale_.maximum) {
        values_.push_back(scale_.maximum);
    }
    double below = -1e9; // amounts that crowd on a logarithmic scale
    std::erase_if(values_, [&](double value) {
        const double at = height_of(value);
        if (at - below < 0.95 * line_ && value != scale_.maximum) {
            return true;
        }
        below = at;
        return false;
    });
    const double beside = bars_.empty() ? 0.0 : kBars;
    double widest = -kColumn - kGap - beside;
    for (const QString& line : title_.split(QLatin1Char('\n'))) {
        widest = std::max(widest, metrics.horizontalAdvance(line) - kColumn - kGap - beside);
    }
    for (const double value : values_) {
        texts_.append(amount_text(value));
        widest = std::max(widest, metrics.horizontalAdvance(texts_.back()));
    }
    size_ =
        QSizeF(std::ceil(2.0 * kMargin + beside + kColumn + kGap + widest), std::ceil(2.0 * kMargin + 3.0 * line_ + column));
}

void Legend::paint(QPainter& painter, const QPointF& top_left) const {
    painter.save();
    painter.translate(top_left);
    plate(painter, QRectF(QPointF(0, 0), size_), palette_);
    const QColor text = palette_.color(QPalette::Active, QPalette::Text);
    painter.setFont(font_);
    painter.setPen(text);
    painter.drawText(QRectF(kMargin, kMargin - 1.0, size_.width() - 2.0 * kMargin, 2.0 * line_),
                     Qt::AlignLeft | Qt::AlignTop, title_);
    const double beside = bars_.empty() ? 0.0 : kBars;
    const QRectF column(kMargin + beside, kMargin + 2.5 * line_, kColumn, kLines * line_);
    QImage colors(1, int(kMapColors), QImage::Format_RGB32);
    for (int i = 0; i < int(kMapColors); ++i) {
        colors.setPixel(0, i, 0xFF000000U | color_map()[kMapColors - 1 - std::size_t(i)]);
    }
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(column, colors);
    QColor rim = text;
    rim.setAlphaF(0.6F);
    const double step = column.height() / double(std::max<std::size_t>(bars_.size(), 1));
    for (std::size_t i = 0; i < bars_.size(); ++i) {
        const double length = double(std::clamp(bars_[i], 0.0F, 1.0F)) * (kBars - 2.0);
        const double low = column.bottom() - double(i) * step;
        painter.fillRect(QRectF(column.left() - 1.0 - length, low - step, length, step), rim);
    }
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(rim, 1.0));
    painter.drawRect(column);
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const double y = column.bottom() - double(scale_place(scale_, values_[i])) * column.height();
        painter.setPen(QPen(rim, 1.0));
        painter.drawLine(QPointF(column.right(), y), QPointF(column.right() + kTick, y));
        painter.setPen(text);
        painter.drawText(QRectF(column.right() + kGap, y - line_, size_.width(), 2.0 * line_),
                         Qt::AlignLeft | Qt::AlignVCenter, texts_[qsizetype(i)]);
    }
    painter.restore();
}

QImage Legend::image(double pixel_ratio) const {
    QImage out = clear_image(size_, pixel_ratio);
    QPainter painter(&out);
    paint(painter, {0, 0});
    return out;
}

QImage label_image(const QStringList& lines, const QFont& font, const QPalette& palette, double pixel_ratio) {
    const QFontMetricsF metrics(font);
    double width = 0.0;
    for (const QString& line : lines) {
        width = std::max(width, metrics.horizontalAdvance(line));
    }
    const QSizeF size(std::ceil(width + 14.0), std::ceil(double(lines.size()) * metrics.height() + 8.0));
    QImage out = clear_image(size, pixel_ratio);
    QPainter painter(&out);
    plate(painter, QRectF(QPointF(0, 0), size), palette);
    painter.setFont(font);
    painter.setPen(palette.color(QPalette::Active, QPalette::Text));
    for (qsizetype i = 0; i < lines.size(); ++i) {
        painter.drawText(QRectF(7.0, 4.0 + double(i) * metrics.height(), size.width(), metrics.height()),
                         Qt::AlignLeft | Qt::AlignVCenter, lines[i]);
    }
    return out;
}

} // namespace atrium::ui
