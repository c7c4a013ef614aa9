#include "ui/panels/caustic_preview.h"

#include "engine/view/tone.h"
#include "ui/document/background.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace atrium::ui {

namespace {

constexpr double kMargin = 14.0;   ///< logical pixels around what is fitted
constexpr double kFoot = 20.0;     ///< of these below, for the caption
constexpr double kStep = 1.25;     ///< zoom of a notch of the wheel
constexpr double kGridFrom = 9.0;  ///< pixels a texel from which lines between them are drawn
constexpr double kLargest = 200.0; ///< pixels a texel at most

/// Half of the size, texels averaged; the last row and column of odd sizes stand alone.
CausticTexture halved(const CausticTexture& t) {
    CausticTexture out;
    out.low = t.low;
    out.high = t.high;
    out.width = (t.width + 1) / 2;
    out.height = (t.height + 1) / 2;
    out.image.assign(std::size_t(out.width) * out.height, Rgb(0.0F));
    for (std::uint32_t y = 0; y < out.height; ++y) {
        for (std::uint32_t x = 0; x < out.width; ++x) {
            Rgb sum(0.0F);
            float n = 0.0F;
            for (std::uint32_t j = 2 * y; j < std::min(2 * y + 2, t.height); ++j) {
                for (std::uint32_t i = 2 * x; i < std::min(2 * x + 2, t.width); ++i) {
                    sum += t.image[std::size_t(j) * t.width + i];
                    n += 1.0F;
                }
            }
            out.image[std::size_t(y) * out.width + x] = sum / n;
        }
    }
    return out;
}

QImage picture_of(const CausticTexture& t, float scale) {
    QImage out(int(t.width), int(t.height), QImage::Format_RGB32);
    for (std::uint32_t y = 0; y < t.height; ++y) {
        auto* line = reinterpret_cast<QRgb*>(out.scanLine(int(t.height - 1 - y)));
        for (std::uint32_t x = 0; x < t.width; ++x) {
            const Rgb c = display_color(t.image[std::size_t(y) * t.width + x], scale) * 255.0F;
            line[x] = qRgb(int(c.r + 0.5F), int(c.g + 0.5F), int(c.b + 0.5F));
        }
    }
    return out;
}

/// Factor that brings all but the brightest per cent of the lit texels below white.
float exposure_for(const std::vector<std::shared_ptr<const CausticTexture>>& textures) {
    std::vector<float> lit;
    for (const auto& t : textures) {
        const std::size_t step = std::max<std::size_t>(t->image.size() / 200'000, 1);
        for (std::size_t i = 0; i < t->image.size(); i += step) {
            if (const float l = luminance(t->image[i]); l > 0.0F) {
                lit.push_back(l);
            }
        }
    }
    if (lit.empty()) {
        return 1.0F;
    }
    const auto at = lit.begin() + std::ptrdiff_t(double(lit.size() - 1) * 0.99);
    std::nth_element(lit.begin(), at, lit.end());
    constexpr float kNearWhite = 1.5F; // the filmic curve is at 0.9 there, so that what is brighter still differs
    return *at > 0.0F ? kNearWhite / *at : 1.0F;
}

} // namespace

std::vector<TexturePictures> make_texture_pictures(const std::vector<std::shared_ptr<const CausticTexture>>& textures) {
    const float scale = exposure_for(textures);
    std::vector<TexturePictures> out;
    for (const auto& texture : textures) {
        TexturePictures pictures;
        pictures.levels.push_back(picture_of(*texture, scale));
        CausticTexture smaller = *texture;
        while (std::max(smaller.width, smaller.height) > 64) {
            smaller = halved(smaller);
            pictures.levels.push_back(picture_of(smaller, scale));
        }
        out.push_back(std::move(pictures));
    }
    return out;
}

CausticPreview::CausticPreview(QWidget* parent) : QWidget(parent) {
    setObjectName(QStringLiteral("caustic_preview"));
    setAccessibleName(tr("Picture of the caustic textures"));
    setMinimumSize(150, 120);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setToolTip(tr("Wheel: zoom. Drag: shift. Double click: all boxes, then the whole piece."));
}

void CausticPreview::show_row(std::optional<CausticRow> row) {
    const bool same_place = row && row_ && row->same_place(*row_);
    const bool same = same_place && *row == *row_;
    if (same || (!row && !row_)) {
        return;
    }
    const bool keep_view = same_place && row->record.extent == row_->record.extent && fit_ == Fit::None;
    row_ = std::move(row);
    const int request = ++asked_;
    if (!same_place) {
        pictures_.clear();
        fit_ = Fit::Boxes;
        box_ = -1;
    }
    making_ = row_ && !row_->textures.empty();
    if (making_) {
        run_in_background(
            this,
            [textures = row_->textures]() -> Result<std::vector<TexturePictures>> {
                return make_texture_pictures(textures);
            },
            [this, request](Result<std::vector<TexturePictures>> made) {
                if (request != asked_) {
                    return; // another row is shown by now
                }
                making_ = false;
                pictures_ = made ? std::move(*made) : std::vector<TexturePictures>();
                update();
                Q_EMIT pictures_ready();
            });
    } else {
        pictures_.clear();
    }
    if (row_ && box_ >= int(row_->record.boxes.size())) {
        box_ = -1;
        fit_ = Fit::Boxes;
    }
    if (!keep_view) {
        refit();
    }
    update();
}

QRectF CausticPreview::box_rectangle(int box) const {
    const vec4& b = row_->record.boxes[std::size_t(box)];
    const vec2& size = row_->record.extent;
    return {QPointF(double(b.x * size.x), double(b.y * size.y)), QPointF(double(b.z * size.x), double(b.w * size.y))};
}

QPointF CausticPreview::pixel_at(const QPointF& piece) const {
    return {origin_.x() + piece.x() * scale_, origin_.y() - piece.y() * scale_};
}
QPointF CausticPreview::piece_at(const QPointF& pixel) const {
    return {(pixel.x() - origin_.x()) / scale_, (origin_.y() - pixel.y()) / scale_};
}

void CausticPreview::fit(const QRectF& metres) {
    const double w = std::max(double(width()) - 2.0 * kMargin, 10.0);
    const double h = std::max(double(height()) - 2.0 * kMargin - kFoot, 10.0);
    const double x = std::max(metres.width(), 1e-6), y = std::max(metres.height(), 1e-6);
    scale_ = std::min(w / x, h / y);
    const QPointF middle(0.5 * width(), kMargin + 0.5 * h);
    origin_ = {middle.x() - metres.center().x() * scale_, middle.y() + metres.center().y() * scale_};
    update();
}

void CausticPreview::refit() {
    if (!row_) {
        return;
    }
    const QRectF piece(QPointF(0, 0), QPointF(double(row_->record.extent.x), double(row_->record.extent.y)));
    QRectF boxes;
    for (int i = 0; i < int(row_->record.boxes.size()); ++i) {
        boxes = boxes.isNull() ? box_rectangle(i) : boxes.united(box_rectangle(i));
    }
    switch (fit_) {
    case Fit::Boxes: fit(boxes.isNull() ? piece : boxes); break;
    case Fit::Piece: fit(piece); break;
    case Fit::Box: fit(box_rectangle(box_)); break;
    case Fit::None: break;
    }
}

void CausticPreview::show_box(int box) {
    if (row_ && box >= 0 && box < int(row_->record.boxes.size())) {
        box_ = box;
        fit_ = Fit::Box;
        refit();
    }
}
void CausticPreview::fit_boxes() {
    fit_ = Fit::Boxes;
    box_ = -1;
    refit();
    update();
}
void CausticPreview::fit_piece() {
    fit_ = Fit::Piece;
    refit();
}

void CausticPreview::zoom_by(double factor, const QPointF& at) {
    if (!row_) {
        return;
    }
    const double texel = row_->texel() > 0.0 ? row_->texel() : 0.01;
    const double least = 0.2 * std::min(width() / std::max(double(row_->record.extent.x), 1e-6),
                                        height() / std::max(double(row_->record.extent.y), 1e-6));
    const QPointF kept = piece_at(at);
    scale_ = std::clamp(scale_ * factor, std::min(least, scale_), std::max(kLargest / texel, least));
    origin_ = {at.x() - kept.x() * scale_, at.y() + kept.y() * scale_};
    fit_ = Fit::None;
    update();
}

QString CausticPreview::caption() const {
    if (!row_) {
        return {};
    }
    if (making_ && pictures_.empty()) {
        return tr("Making the picture...");
    }
    if (!row_->has_texture()) {
        return tr("No texture: all of it is on the mesh");
    }
    if (cursor_) {
        const QPointF at = piece_at(*cursor_);
        const vec2 share(float(at.x() / double(row_->record.extent.x)), float(at.y() / double(row_->record.extent.y)));
        double lux = 0.0;
        for (std::size_t i = 0; i < std::min(row_->textures.size(), row_->record.boxes.size()); ++i) {
            const vec4& b = row_->record.boxes[i];
            const CausticTexture& t = *row_->textures[i];
            if (share.x >= b.x && share.x <= b.z && share.y >= b.y && share.y <= b.w) {
                const vec2 inside = (share - vec2(b.x, b.y)) / vec2(b.z - b.x, b.w - b.y);
                lux += double(luminance(t.irradiance(t.low + inside * (t.high - t.low))));
            }
        }
        if (at.x() >= 0.0 && at.y() >= 0.0 && share.x <= 1.0F && share.y <= 1.0F) {
            return tr("%1 m, %2 m: %3 lx in textures")
                .arg(QLocale().toString(at.x(), 'f', 3), QLocale().toString(at.y(), 'f', 3),
                     QLocale().toString(lux, 'f', lux < 100.0 ? 1 : 0));
        }
    }
    const double pixels = row_->texel() * scale_;
    return pixels >= 1.0 ? tr("1 texel = %1 pixels").arg(QLocale().toString(pixels, 'f', pixels < 10.0 ? 1 : 0))
                         : tr("1 pixel = %1 texels").arg(QLocale().toString(1.0 / pixels, 'f', 1));
}

void CausticPreview::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    // The same grey in light and dark: what lies around a picture must not change how it looks.
    painter.fillRect(rect(), QColor(58, 58, 58));
    if (!row_) {
        return;
    }
    const auto to_pixels = [this](const QRectF& metres) {
        return QRectF(pixel_at(metres.topLeft()), pixel_at(metres.bottomRight())).normalized();
    };
    const QRectF piece = to_pixels({QPointF(0, 0), QPointF(double(row_->record.extent.x), double(row_->record.extent.y))});
    painter.fillRect(piece, QColor(20, 20, 20));
    painter.setPen(QPen(QColor(130, 130, 130), 1, Qt::DotLine));
    painter.drawRect(piece);
    const std::size_t boxes = std::min(pictures_.size(), row_->record.boxes.size());
    for (std::size_t i = 0; i < boxes; ++i) {
        const QRectF target = to_pixels(box_rectangle(int(i)));
        const auto& levels = pictures_[i].levels;
        if (levels.empty() || !target.intersects(QRectF(rect()))) {
            continue;
        }
        // The finest whose texels are at least a pixel: what is smaller would be picked by chance.
        std::size_t level = 0;
        while (level + 1 < levels.size() && target.width() * devicePixelRatioF() < double(levels[level].width())) {
            ++level;
        }
        painter.drawImage(target, levels[level], QRectF(levels[level].rect()));
        const double texel = target.width() / levels.front().width();
        if (texel >= kGridFrom) {
            painter.setPen(QPen(QColor(255, 255, 255, 45), 1));
            const QRectF seen = target.intersected(QRectF(rect()));
            const double row_height = target.height() / levels.front().height();
            for (double x = std::ceil((seen.left() - target.left()) / texel); target.left() + x * texel <= seen.right();
                 x += 1.0) {
                const double at = target.left() + x * texel;
                painter.drawLine(QPointF(at, seen.top()), QPointF(at, seen.bottom()));
            }
            for (double y = std::ceil((seen.top() - target.top()) / row_height);
                 target.top() + y * row_height <= seen.bottom(); y += 1.0) {
                const double at = target.top() + y * row_height;
                painter.drawLine(QPointF(seen.left(), at), QPointF(seen.right(), at));
            }
        }
    }
    for (int i = 0; i < int(row_->record.boxes.size()); ++i) {
        const QRectF target = to_pixels(box_rectangle(i));
        painter.setPen(QPen(QColor(0, 0, 0, 160), 3));
        painter.drawRect(target);
        painter.setPen(QPen(i == box_ ? QColor(255, 190, 60) : QColor(Qt::white), i == box_ ? 2 : 1));
        painter.drawRect(target);
        if (row_->record.boxes.size() > 1) {
            const QString label = QString::number(i + 1);
            const QRectF at(target.topLeft() + QPointF(3, 2), QSizeF(40, 16));
            painter.setPen(QColor(0, 0, 0, 200));
            painter.drawText(at.translated(1, 1), Qt::AlignLeft | Qt::AlignTop, label);
            painter.setPen(Qt::white);
            painter.drawText(at, Qt::AlignLeft | Qt::AlignTop, label);
        }
    }
    const QRectF foot(0, height() - kFoot, width(), kFoot);
    painter.fillRect(foot, QColor(40, 40, 40, 220));
    painter.setPen(QColor(225, 225, 225));
    painter.drawText(foot.adjusted(6, 0, -6, 0), Qt::AlignVCenter | Qt::AlignLeft,
                     painter.fontMetrics().elidedText(caption(), Qt::ElideRight, int(foot.width()) - 12));
    if (hasFocus()) {
        painter.setPen(QPen(palette().color(QPalette::Highlight), 2));
        painter.drawRect(rect().adjusted(1, 1, -1, -1));
    }
}

void CausticPreview::resizeEvent(QResizeEvent* /*event*/) { refit(); }

void CausticPreview::wheelEvent(QWheelEvent* event) {
    zoom_by(std::pow(kStep, event->angleDelta().y() / 120.0), event->position());
    event->accept();
}
void CausticPreview::mousePressEvent(QMouseEvent* event) { dragged_from_ = event->position(); }
void CausticPreview::mouseMoveEvent(QMouseEvent* event) {
    cursor_ = event->position();
    if (event->buttons() != Qt::NoButton) {
        origin_ += event->position() - dragged_from_;
        dragged_from_ = event->position();
        fit_ = Fit::None;
    }
    update();
}
void CausticPreview::mouseDoubleClickEvent(QMouseEvent* /*event*/) { fit_ == Fit::Boxes ? fit_piece() : fit_boxes(); }
void CausticPreview::leaveEvent(QEvent* /*event*/) {
    cursor_.reset();
    update();
}

void CausticPreview::keyPressEvent(QKeyEvent* event) {
    const QPointF middle(0.5 * width(), 0.5 * height());
    const double step = 40.0;
    switch (event->key()) {
    case Qt::Key_Plus:
    case Qt::Key_Equal: zoom_by(kStep, middle); return;
    case Qt::Key_Minus: zoom_by(1.0 / kStep, middle); return;
    case Qt::Key_Left: origin_ += QPointF(step, 0); break;
    case Qt::Key_Right: origin_ -= QPointF(step, 0); break;
    case Qt::Key_Up: origin_ += QPointF(0, step); break;
    case Qt::Key_Down: origin_ -= QPointF(0, step); break;
    case Qt::Key_Return:
    case Qt::Key_Enter: fit_ == Fit::Boxes ? fit_piece() : fit_boxes(); return;
    default: QWidget::keyPressEvent(event); return;
    }
    fit_ = Fit::None;
    update();
}

} // namespace atrium::ui
