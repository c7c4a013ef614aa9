#include "ui/window/help_dialogs.h"

#include "engine/base/version.h"
#include "ui/actions/actions.h"

#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace atrium::ui {

namespace {

QString tr_help(const char* text) { return QCoreApplication::translate("Help", text); }
QString plain_text(QString text) { return text.remove(QLatin1Char('&')).remove(QStringLiteral("...")); }

/// Line edit above a list of actions; Up and Down move in the list while the text keeps the focus.
class CommandSearch : public QDialog {
public:
    CommandSearch(const Actions& actions, QWidget* parent) : QDialog(parent, Qt::Popup) {
        setAttribute(Qt::WA_DeleteOnClose);
        setObjectName(QStringLiteral("command_search"));
        resize(420, 360);
        auto* layout = new QVBoxLayout(this);
        text_ = new QLineEdit;
        text_->setPlaceholderText(tr_help(QT_TRANSLATE_NOOP("Help", "Find a command")));
        text_->setAccessibleName(text_->placeholderText());
        list_ = new QListWidget;
        list_->setFocusPolicy(Qt::NoFocus);
        layout->addWidget(text_);
        layout->addWidget(list_);
        for (const ActionInfo& info : action_table()) {
            QAction* action = actions[info.id];
            if (!action->isEnabled() || info.id == ActionId::Commands) {
                continue;
            }
            const QString key = action->shortcut().toString(QKeySequence::NativeText);
            auto* item = new QListWidgetItem(
                action->icon(), key.isEmpty() ? plain_text(action->text())
                                              : QStringLiteral("%1   (%2)").arg(plain_text(action->text()), key));
            item->setToolTip(action->statusTip());
            item->setData(Qt::UserRole, QVariant::fromValue(static_cast<QObject*>(action)));
            list_->addItem(item);
        }
        list_->setCurrentRow(0);
        text_->installEventFilter(this);
        connect(text_, &QLineEdit::textChanged, this, [this](const QString& wanted) {
            bool chosen = false;
            for (int i = 0; i < list_->count(); ++i) {
                QListWidgetItem* item = list_->item(i);
                const bool fits = (item->text() + item->toolTip()).contains(wanted.trimmed(), Qt::CaseInsensitive);
                item->setHidden(!fits);
                if (fits && !chosen) {
                    list_->setCurrentItem(item);
                    chosen = true;
                }
            }
        });
        connect(text_, &QLineEdit::returnPressed, this, [this] { run(list_->currentItem()); });
        connect(list_, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) { run(item); });
        text_->setFocus();
    }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (event->type() == QEvent::KeyPress) {
            auto* key = static_cast<QKeyEvent*>(event);
            const int step = key->key() == Qt::Key_Down ? 1 : key->key() == Qt::Key_Up ? -1 : 0;
            for (int row = list_->currentRow() + step; step != 0 && row >= 0 && row < list_->count(); row += step) {
                if (!list_->item(row)->isHidden()) {
                    list_->setCurrentRow(row);
                    break;
                }
            }
            if (step != 0) {
                return true;
            }
        }
        return QDialog::eventFilter(watched, event);
    }

private:
    void run(QListWidgetItem* item) {
        auto* action = item == nullptr || item->isHidden() ? nullptr : item->data(Qt::UserRole).value<QObject*>();
        close();
        if (action != nullptr) {
            QMetaObject::invokeMethod(action, "trigger", Qt::QueuedConnection);
        }
    }
    QLineEdit* text_ = nullptr;
    QListWidget* list_ = nullptr;
};

} // namespace

void show_shortcut_list(QWidget* parent) {
    auto* dialog = new QDialog(parent);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(tr_help(QT_TRANSLATE_NOOP("Help", "Keyboard Shortcuts")));
    dialog->resize(560, 600);
    auto* layout = new QVBoxLayout(dialog);
    auto* list = new QTreeWidget;
    list->setColumnCount(2);
    list->setHeaderLabels({tr_help(QT_TRANSLATE_NOOP("Help", "Key")), tr_help(QT_TRANSLATE_NOOP("Help", "What it does"))});
    list->setRootIsDecorated(false);
    list->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
    const auto row = [list](const QString& key, const QString& what) {
        list->addTopLevelItem(new QTreeWidgetItem({key, what}));
    };
    for (const ActionInfo& info : action_table()) {
        const QKeySequence key(QLatin1StringView(info.shortcut), QKeySequence::PortableText);
        if (!key.isEmpty()) {
            row(key.toString(QKeySequence::NativeText), QCoreApplication::translate("Actions", info.tip));
        }
    }
    row(tr_help(QT_TRANSLATE_NOOP("Help", "Esc")),
        tr_help(QT_TRANSLATE_NOOP("Help", "Cancel the drag or the typing; leave walk mode")));
    row(tr_help(QT_TRANSLATE_NOOP("Help", "Enter")), tr_help(QT_TRANSLATE_NOOP("Help", "Take over the number in a field")));
    row(tr_help(QT_TRANSLATE_NOOP("Help", "Up, Down, wheel")),
        tr_help(QT_TRANSLATE_NOOP("Help", "Change the number in the focused field; Shift is finer")));
    layout->addWidget(list);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    layout->addWidget(buttons);
    dialog->show();
}

void show_about_box(QWidget* parent) {
    auto* box = new QMessageBox(parent);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setWindowTitle(tr_help(QT_TRANSLATE_NOOP("Help", "About Atrium")));
    box->setText(QStringLiteral("Atrium %1").arg(QString::fromStdString(version_text())));
    box->setInformativeText(tr_help(QT_TRANSLATE_NOOP(
        "Help", "Interiors with live global illumination: hierarchical radiosity that follows every edit.\n\n"
                "Free software; the licence is in the file LICENSE.")));
    box->open();
}

void show_command_search(const Actions& actions, QWidget* parent) {
    auto* dialog = new CommandSearch(actions, parent);
    dialog->move(parent->mapToGlobal(QPoint((parent->width() - dialog->width()) / 2, parent->height() / 6)));
    dialog->show();
}

} // namespace atrium::ui
