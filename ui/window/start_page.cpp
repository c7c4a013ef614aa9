#include "ui/window/start_page.h"

#include "ui/actions/actions.h"
#include "ui/actions/icons.h"

#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QListWidget>
#include <QToolButton>
#include <QVBoxLayout>

namespace atrium::ui {

namespace {

QToolButton* big_button(const QString& text, const QIcon& icon) {
    auto* button = new QToolButton;
    button->setText(text);
    button->setIcon(icon);
    button->setIconSize({40, 40});
    button->setToolButtonStyle(Qt::ToolButtonTextUnderIcon);
    button->setMinimumSize(140, 100);
    button->setAutoRaise(false);
    button->setFocusPolicy(Qt::StrongFocus);
    return button;
}

} // namespace

StartPage::StartPage(const Actions& actions, QWidget* parent) : QWidget(parent) {
    setObjectName(QStringLiteral("start_page"));
    auto* outer = new QGridLayout(this);
    outer->setRowStretch(0, 1);
    outer->setRowStretch(2, 2);
    outer->setColumnStretch(0, 1);
    outer->setColumnStretch(2, 1);
    auto* column = new QVBoxLayout;
    column->setSpacing(12);
    outer->addLayout(column, 1, 1);

    auto* title = new QLabel(QStringLiteral("Atrium"));
    QFont font = title->font();
    font.setPointSizeF(font.pointSizeF() * 2.4);
    font.setWeight(QFont::Light);
    title->setFont(font);
    column->addWidget(title);
    auto* line = new QLabel(tr("Edit an interior and see its light follow."));
    column->addWidget(line);
    column->addSpacing(8);

    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(12);
    auto* sample = big_button(tr("Sample Room"), tinted_icon(QStringLiteral("sofa")));
    sample->setObjectName(QStringLiteral("start_sample"));
    sample->setToolTip(tr("Open a furnished room to try things out"));
    connect(sample, &QToolButton::clicked, this, &StartPage::sample_requested);
    auto* open = big_button(tr("Open File"), tinted_icon(QStringLiteral("open")));
    open->setToolTip(actions[ActionId::Open]->toolTip());
    connect(open, &QToolButton::clicked, actions[ActionId::Open], &QAction::trigger);
    auto* fresh = big_button(tr("New Scene"), tinted_icon(QStringLiteral("new")));
    fresh->setObjectName(QStringLiteral("start_new"));
    fresh->setToolTip(actions[ActionId::New]->toolTip());
    connect(fresh, &QToolButton::clicked, actions[ActionId::New], &QAction::trigger);
    for (QToolButton* button : {sample, open, fresh}) {
        buttons->addWidget(button);
    }
    buttons->addStretch(1);
    column->addLayout(buttons);
    column->addSpacing(8);

    auto* recent_title = new QLabel(tr("Recent files"));
    QFont bold = recent_title->font();
    bold.setBold(true);
    recent_title->setFont(bold);
    recent_title_ = recent_title;
    column->addWidget(recent_title);
    recent_ = new QListWidget;
    recent_->setAccessibleName(tr("Recent files"));
    recent_->setFrameShape(QFrame::NoFrame);
    recent_->setMinimumWidth(432);
    recent_->setMinimumHeight(180);
    recent_->setTextElideMode(Qt::ElideMiddle);
    recent_->viewport()->setAutoFillBackground(false);
    connect(recent_, &QListWidget::itemActivated, this,
            [this](QListWidgetItem* item) { Q_EMIT file_requested(item->data(Qt::UserRole).toString()); });
    connect(recent_, &QListWidget::itemClicked, this,
            [this](QListWidgetItem* item) { Q_EMIT file_requested(item->data(Qt::UserRole).toString()); });
    column->addWidget(recent_);
    auto* hint = new QLabel(tr("glTF (.gltf, .glb) and Atrium (.atrium) files can also be dropped onto this window."));
    hint->setEnabled(false);
    column->addWidget(hint);
}

void StartPage::set_recent(const QStringList& files) {
    recent_->clear();
    for (const QString& file : files) {
        const QFileInfo info(file);
        auto* item = new QListWidgetItem(tinted_icon(QStringLiteral("recent")),
                                         tr("%1   in %2").arg(info.fileName(), info.absolutePath()));
        item->setData(Qt::UserRole, file);
        item->setToolTip(file);
        recent_->addItem(item);
    }
    recent_->setVisible(!files.isEmpty());
    recent_title_->setVisible(!files.isEmpty());
}

} // namespace atrium::ui
