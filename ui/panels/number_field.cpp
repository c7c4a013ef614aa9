#include "ui/panels/number_field.h"

#include <QFocusEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QToolTip>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace atrium::ui {

namespace {
constexpr int kBurstPauseMs = 500; // wheel notches closer than this are one undo entry
constexpr double kPixelsPerStep = 8.0;
constexpr int kTextMargins = 10; ///< frame and margins of the text, both sides
} // namespace

NumberFormat NumberFormat::length(double minimum) {
    return {length_units(), QStringLiteral(" m"), 4, minimum, 1e6, 0.05, false, 1.0};
}
NumberFormat NumberFormat::angle() { return {angle_units(), QStringLiteral("\u00b0"), 2, -1e5, 1e5, 5.0, false, 1.0}; }
NumberFormat NumberFormat::share() { return {plain_units(), {}, 3, 0.0, 1.0, 0.05, false, 1.0}; }
NumberFormat NumberFormat::plain(double minimum, double maximum, int decimals, const QString& suffix) {
    return {plain_units(suffix.trimmed().toStdString()), suffix, decimals, minimum, maximum, 1.0, false, 1.0};
}

NumberField::NumberField(NumberFormat format, QWidget* parent) : QLineEdit(parent), format_(std::move(format)) {
    setAlignment(Qt::AlignRight);
    setMinimumWidth(56);
    setFocusPolicy(Qt::StrongFocus); // not WheelFocus: scrolling the panel must change no number
    burst_end_.setSingleShot(true);
    burst_end_.setInterval(kBurstPauseMs);
    connect(&burst_end_, &QTimer::timeout, this, [this] { end_burst(true); });
    connect(this, &QLineEdit::textEdited, this, [this] {
        typing_ = true;
        setProperty("refused", false);
        show_tip();
    });
    show_value();
}

void NumberField::set_value(double value) {
    value_ = value;
    mixed_ = false;
    if (!typing_) {
        show_value();
    }
}

void NumberField::set_mixed() {
    mixed_ = true;
    if (!typing_) {
        show_value();
    }
}

void NumberField::set_suffix(const QString& suffix, const UnitSet& units) {
    if (format_.suffix != suffix) {
        format_.suffix = suffix;
        format_.units = units;
        if (!typing_) {
            show_value();
        }
    }
}

void NumberField::set_absent(double value, const QString& text) {
    absent_ = value;
    absent_text_ = text;
    if (!typing_) {
        show_value();
    }
}

void NumberField::attach_label(QLabel* label) {
    label_ = label;
    label->setCursor(Qt::SizeHorCursor);
    label->setBuddy(this);
    label->installEventFilter(this);
}

void NumberField::set_hint(const QString& hint) {
    if (hint != hint_) {
        hint_ = hint;
        show_tip();
    }
}

QString NumberField::text_of(double value, int decimals) const {
    return QString::fromStdString(format_number(value * format_.display_factor, decimals)) + format_.suffix;
}

int NumberField::fitting_decimals(double value) const {
    if (!testAttribute(Qt::WA_WState_Created) && !isVisible()) {
        return format_.decimals; // has no place yet
    }
    const int room = width() - kTextMargins;
    int decimals = format_.decimals;
    while (decimals > 0 && fontMetrics().horizontalAdvance(text_of(value, decimals)) > room) {
        --decimals;
    }
    return decimals;
}

void NumberField::resizeEvent(QResizeEvent* event) {
    QLineEdit::resizeEvent(event);
    if (!typing_) {
        show_value();
    }
}

void NumberField::show_tip() {
    if (property("refused").toBool()) {
        return; // the problem stays until something is typed
    }
    const bool whole = mixed_ || typing_ || shown_decimals_ == format_.decimals;
    const QString number = whole ? QString() : text_of(value_, format_.decimals);
    setToolTip(number.isEmpty() || hint_.isEmpty() ? number + hint_ : number + QLatin1Char('\n') + hint_);
}

void NumberField::show_value() {
    const bool absent = !mixed_ && absent_ && value_ == *absent_;
    shown_decimals_ = mixed_ || absent ? format_.decimals : fitting_decimals(value_);
    const QString text = mixed_ || absent ? QString() : text_of(value_, shown_decimals_);
    show_tip();
    setPlaceholderText(mixed_ ? tr("mixed") : absent ? absent_text_ : QString());
    if (text != this->text()) {
        setText(text);
        setCursorPosition(0);
    }
}

void NumberField::show_problem(const QString& why) {
    setToolTip(why);
    setProperty("refused", true);
    QToolTip::showText(mapToGlobal(QPoint(0, height())), why, this);
    Q_EMIT refused(why);
}

bool NumberField::commit_text() {
    if (!typing_) {
        return true;
    }
    if (mixed_ && text().trimmed().isEmpty()) {
        typing_ = false;
        return true;
    }
    const auto parsed = absent_ && text().trimmed().isEmpty()
                            ? tl::expected<double, std::string>(*absent_ * format_.display_factor)
                            : parse_quantity(text().toStdString(), format_.units);
    if (!parsed) {
        show_problem(tr("Not changed: %1.").arg(QString::fromStdString(parsed.error())));
        return false;
    }
    const double value = *parsed / format_.display_factor;
    if (value < format_.minimum || value > format_.maximum) {
        show_problem(tr("Not changed: the value must lie between %1 and %2.")
                         .arg(text_of(format_.minimum, format_.decimals), text_of(format_.maximum, format_.decimals)));
        return false;
    }
    typing_ = false;
    // What is shown is rounded: typing the same text again must not round the value behind it.
    const bool same = !mixed_ && (value == value_ || (text_of(value, format_.decimals) == text_of(value_, shown_decimals_) &&
                                                      std::abs(value - value_) < 0.51 * std::pow(10.0, -shown_decimals_)));
    if (!same) {
        value_ = value;
        mixed_ = false;
        Q_EMIT started();
        Q_EMIT edited(value);
        Q_EMIT finished();
    }
    show_value();
    return true;
}

bool NumberField::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && !typing_) {
        auto* key = static_cast<QKeyEvent*>(event);
        // With nothing half typed, undo means the document's, not the text's.
        if (key->matches(QKeySequence::Undo) || key->matches(QKeySequence::Redo)) {
            event->ignore();
            return false;
        }
    }
    return QLineEdit::event(event);
}

void NumberField::focusInEvent(QFocusEvent* event) {
    QLineEdit::focusInEvent(event);
    if (event->reason() == Qt::MouseFocusReason) {
        QTimer::singleShot(0, this, &QLineEdit::selectAll); // after the press has placed the cursor
    }
}

void NumberField::focusOutEvent(QFocusEvent* event) {
    QLineEdit::focusOutEvent(event);
    end_burst(true);
    if (event->reason() == Qt::PopupFocusReason || event->reason() == Qt::ActiveWindowFocusReason) {
        return; // still being typed: a menu or another program came in between
    }
    if (!commit_text()) {
        typing_ = false;
        setProperty("refused", false);
        show_value();
    }
}

void NumberField::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
    case Qt::Key_Return:
    case Qt::Key_Enter:
        if (commit_text()) {
            selectAll();
        }
        event->accept();
        return;
    case Qt::Key_Escape:
        if (dragging_ || burst_) {
            dragging_ = false;
            end_burst(false);
        }
        typing_ = false;
        setProperty("refused", false);
        show_value();
        selectAll();
        event->accept();
        return;
    case Qt::Key_Up: step_by(event->modifiers() & Qt::ShiftModifier ? 0.1 : 1.0); return;
    case Qt::Key_Down: step_by(event->modifiers() & Qt::ShiftModifier ? -0.1 : -1.0); return;
    default: QLineEdit::keyPressEvent(event);
    }
}

void NumberField::wheelEvent(QWheelEvent* event) {
    if (!hasFocus() || event->angleDelta().y() == 0) {
        event->ignore(); // the panel scrolls instead
        return;
    }
    step_by(event->angleDelta().y() / 120.0 * (event->modifiers() & Qt::ShiftModifier ? 0.1 : 1.0));
    event->accept();
}

void NumberField::step_by(double steps) {
    if (isReadOnly() || mixed_ || (absent_ && value_ == *absent_ && !typing_)) {
        return; // there is nothing to step from
    }
    if (typing_ && !commit_text()) {
        return;
    }
    const double step = format_.proportional ? std::max(std::abs(value_) * 0.1, format_.step) : format_.step;
    const double next = std::clamp(value_ + steps * step, format_.minimum, format_.maximum);
    if (next == value_) {
        return;
    }
    begin_burst();
    value_ = next;
    show_value();
    Q_EMIT edited(next);
    burst_end_.start();
}

void NumberField::begin_burst() {
    if (!burst_) {
        burst_ = true;
        Q_EMIT started();
    }
}

void NumberField::end_burst(bool keep) {
    burst_end_.stop();
    if (burst_) {
        burst_ = false;
        if (keep) {
            Q_EMIT finished();
        } else {
            Q_EMIT cancelled();
        }
    }
}

bool NumberField::eventFilter(QObject* watched, QEvent* event) {
    if (watched != label_ || !isEnabled() || mixed_ || (absent_ && value_ == *absent_)) {
        return QLineEdit::eventFilter(watched, event);
    }
    if (event->type() == QEvent::MouseButtonPress) {
        auto* mouse = static_cast<QMouseEvent*>(event);
        if (mouse->button() == Qt::LeftButton) {
            setFocus(Qt::OtherFocusReason); // Esc during the drag comes here
            end_burst(true);
            dragging_ = true;
            drag_x_ = mouse->globalPosition().x();
            drag_value_ = value_;
            return true;
        }
    } else if (event->type() == QEvent::MouseMove && dragging_) {
        auto* mouse = static_cast<QMouseEvent*>(event);
        const double fine = mouse->modifiers() & Qt::ShiftModifier ? 0.1 : 1.0;
        const double step = format_.proportional ? std::max(std::abs(drag_value_) * 0.1, format_.step) : format_.step;
        const double steps = std::trunc((mouse->globalPosition().x() - drag_x_) / kPixelsPerStep / 0.1) * 0.1;
        const double next = std::clamp(drag_value_ + steps * step * fine, format_.minimum, format_.maximum);
        if (next != value_) {
            begin_burst();
            burst_end_.stop();
            value_ = next;
            show_value();
            Q_EMIT edited(next);
        }
        return true;
    } else if (event->type() == QEvent::MouseButtonRelease && dragging_) {
        dragging_ = false;
        end_burst(true);
        return true;
    }
    return QLineEdit::eventFilter(watched, event);
}

} // namespace atrium::ui
