#include "ui/panels/elided_label.h"

#include <QPainter>
#include <QStyle>

namespace atrium::ui {

ElidedLabel::ElidedLabel(QWidget* parent) : QLabel(parent) {
    setTextFormat(Qt::PlainText);
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
}

void ElidedLabel::set_text(const QString& text) {
    if (text != this->text()) {
        setText(text);
        show_tip();
    }
}

QString ElidedLabel::shown_text() const { return fontMetrics().elidedText(text(), Qt::ElideRight, contentsRect().width()); }

QSize ElidedLabel::minimumSizeHint() const { return {0, fontMetrics().height()}; }

void ElidedLabel::resizeEvent(QResizeEvent* event) {
    QLabel::resizeEvent(event);
    show_tip();
}

void ElidedLabel::show_tip() { setToolTip(shown_text() == text() ? QString() : text()); }

void ElidedLabel::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    style()->drawItemText(&painter, contentsRect(), int(alignment()) | Qt::TextSingleLine, palette(), isEnabled(),
                          shown_text(), foregroundRole());
}

} // namespace atrium::ui
