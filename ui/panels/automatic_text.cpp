#include "ui/panels/automatic_text.h"

#include <QEvent>

#include <algorithm>

namespace atrium::ui {

namespace {
constexpr int kTextMargins = 14; ///< frame and margins of the text, both sides, and the cursor
} // namespace

AutomaticText::AutomaticText(NumberField* field, double absent, QString hint)
    : QObject(field), field_(field), absent_(absent), hint_(std::move(hint)) {
    field->installEventFilter(this);
    show();
}

void AutomaticText::set_amount(const QString& amount) {
    if (amount != amount_) {
        amount_ = amount;
        show();
    }
}

bool AutomaticText::eventFilter(QObject* watched, QEvent* event) {
    if (watched == field_ && (event->type() == QEvent::Resize || event->type() == QEvent::FontChange)) {
        show();
    }
    return QObject::eventFilter(watched, event);
}

void AutomaticText::show() {
    const QStringList texts = amount_.isEmpty()
                                  ? QStringList{tr("automatic")}
                                  : QStringList{tr("automatic (%1)").arg(amount_), tr("auto (%1)").arg(amount_), amount_};
    const auto fits = [this](const QString& text) {
        return field_->fontMetrics().horizontalAdvance(text) <= field_->width() - kTextMargins;
    };
    const auto fullest = std::find_if(texts.begin(), texts.end(), fits);
    const QString& shown = fullest == texts.end() ? texts.back() : *fullest;
    field_->set_absent(absent_, shown);
    QStringList tip;
    if (shown != texts.front()) {
        tip << texts.front();
    }
    if (!hint_.isEmpty()) {
        tip << hint_;
    }
    field_->set_hint(tip.join(QLatin1Char('\n')));
}

} // namespace atrium::ui
