#include "ui/window/notice_bar.h"

#include "ui/actions/icons.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

namespace atrium::ui {

NoticeBar::NoticeBar(const char* name, QWidget* parent) : QFrame(parent) {
    setObjectName(QLatin1StringView(name));
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::AlternateBase);
    layout_ = new QHBoxLayout(this);
    layout_->setContentsMargins(10, 4, 10, 4);
    icon_ = new QLabel;
    icon_->setPixmap(tinted_icon(QStringLiteral("warning")).pixmap(18, 18));
    text_ = new QLabel;
    text_->setWordWrap(true);
    text_->setTextFormat(Qt::PlainText);
    auto* close = new QToolButton;
    close->setIcon(tinted_icon(QStringLiteral("close")));
    close->setAutoRaise(true);
    close->setToolTip(tr("Put this message away"));
    close->setAccessibleName(tr("Put this message away"));
    connect(close, &QToolButton::clicked, this, &QWidget::hide);
    layout_->addWidget(icon_);
    layout_->addWidget(text_, 1);
    layout_->addWidget(close);
    hide();
}

QPushButton* NoticeBar::add_button(const QString& text) {
    auto* button = new QPushButton(text);
    layout_->insertWidget(layout_->count() - 1, button);
    return button;
}

void NoticeBar::show_text(const QString& text) {
    text_->setText(text);
    show();
}

QString NoticeBar::text() const { return text_->text(); }

} // namespace atrium::ui
