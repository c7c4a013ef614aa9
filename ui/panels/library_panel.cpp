#include "ui/panels/library_panel.h"

#include "ui/panels/library_model.h"

#include <QDrag>
#include <QIcon>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMimeData>
#include <QPushButton>
#include <QScrollBar>
#include <QStyledItemDelegate>
#include <QTabBar>
#include <QVBoxLayout>

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr QSize kCell(104, 128);
constexpr int kDragPicture = 28; ///< points; the object itself is seen in the view

/// Lets a name have all of its cell: three lines, where by itself it would be cut after two; a short one stands at its
/// picture.
class CellDelegate : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;
    [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& /*option*/, const QModelIndex& /*index*/) const override {
        return kCell - QSize(4, 4);
    }

protected:
    void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
        QStyledItemDelegate::initStyleOption(option, index);
        option->displayAlignment = Qt::AlignHCenter | Qt::AlignTop;
    }
};

/// A list whose drags show a small picture beside the cursor: a large one would hide the place.
class LibraryView : public QListView {
protected:
    void startDrag(Qt::DropActions /*actions*/) override {
        const QModelIndex index = currentIndex();
        QMimeData* mime = index.isValid() ? model()->mimeData({index}) : nullptr;
        if (mime == nullptr) {
            return;
        }
        auto* drag = new QDrag(this); // Qt deletes it when it has ended
        drag->setMimeData(mime);
        drag->setPixmap(index.data(Qt::DecorationRole).value<QIcon>().pixmap(kDragPicture, kDragPicture));
        drag->setHotSpot({-12, -12});
        drag->exec(Qt::CopyAction);
    }
};

} // namespace

LibraryPanel::LibraryPanel(QWidget* parent) : QWidget(parent) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(4, 4, 4, 4);
    layout->setSpacing(4);
    search_ = new QLineEdit;
    search_->setObjectName(QStringLiteral("library_search"));
    search_->setPlaceholderText(tr("Search the library"));
    search_->setAccessibleName(tr("Search the library by name"));
    search_->setClearButtonEnabled(true);
    search_->installEventFilter(this);
    layout->addWidget(search_);
    sections_ = new QTabBar;
    sections_->setObjectName(QStringLiteral("library_sections"));
    sections_->setAccessibleName(tr("Sections of the library"));
    sections_->setExpanding(false);
    sections_->setDrawBase(false);
    for (const QString& name : {tr("Shapes"), tr("Materials"), tr("Lamps"), tr("Furniture")}) {
        sections_->addTab(name);
    }
    layout->addWidget(sections_);
    note_ = new QLabel;
    note_->setWordWrap(true);
    note_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    layout->addWidget(note_);

    model_ = new LibraryModel(this);
    filter_ = new LibraryFilter(*model_, this);
    view_ = new LibraryView;
    view_->setObjectName(QStringLiteral("library_view"));
    view_->setAccessibleName(tr("Library"));
    view_->setModel(filter_);
    view_->setViewMode(QListView::IconMode);
    view_->setResizeMode(QListView::Adjust);
    view_->setMovement(QListView::Static);
    view_->setUniformItemSizes(true);
    view_->setIconSize({LibraryModel::kPictureSize, LibraryModel::kPictureSize});
    view_->setGridSize(kCell);
    view_->setItemDelegate(new CellDelegate(view_));
    view_->setWordWrap(true);
    view_->setDragEnabled(true);
    view_->setDragDropMode(QAbstractItemView::DragOnly);
    view_->setDefaultDropAction(Qt::CopyAction);
    view_->setSelectionMode(QAbstractItemView::SingleSelection);
    view_->installEventFilter(this);
    layout->addWidget(view_, 1);
    // Two columns, and all sections without having to look for them.
    const int columns = 2 * kCell.width() + view_->verticalScrollBar()->sizeHint().width() + 2 * view_->frameWidth() + 2;
    view_->setMinimumWidth(std::max(columns, sections_->sizeHint().width()));
    folder_button_ = new QPushButton(tr("Choose &Folder..."));
    folder_button_->setObjectName(QStringLiteral("library_folder"));
    folder_button_->setToolTip(tr("Choose the folder with your glTF models"));
    layout->addWidget(folder_button_);

    connect(search_, &QLineEdit::textChanged, this, [this](const QString& text) {
        filter_->set_words(text);
        update_page();
    });
    connect(sections_, &QTabBar::currentChanged, this, [this](int section) {
        filter_->set_section(LibrarySection(section));
        search_->clear();
        view_->scrollToTop();
        update_page();
    });
    connect(view_, &QListView::doubleClicked, this, &LibraryPanel::choose);
    connect(view_->selectionModel(), &QItemSelectionModel::currentChanged, this,
            [this](const QModelIndex& index) { model_->need(filter_->mapToSource(index)); });
    connect(folder_button_, &QPushButton::clicked, this, &LibraryPanel::folder_wanted);
    connect(model_, &LibraryModel::message, this, &LibraryPanel::message);
    connect(model_, &QAbstractItemModel::rowsInserted, this, &LibraryPanel::update_page);
    connect(model_, &LibraryModel::loaded, this, [this](const QString& key) {
        if (key == waiting_) {
            waiting_.clear();
            choose(view_index(key));
        }
    });
    update_page();
}

void LibraryPanel::update_page() {
    const bool searching = !search_->text().isEmpty();
    const bool furniture = !searching && sections_->currentIndex() == int(LibrarySection::Furniture);
    folder_button_->setVisible(furniture);
    QString text;
    if (searching && filter_->rowCount() == 0) {
        text = tr("Nothing in the library has this name.");
    } else if (furniture && filter_->rowCount() == 0) {
        text = tr("Choose a folder with glTF models (.glb, .gltf): they appear here, ready to be dragged into the room.");
    }
    note_->setText(text);
    note_->setVisible(!text.isEmpty());
}

void LibraryPanel::focus_search() {
    search_->setFocus(Qt::ShortcutFocusReason);
    search_->selectAll();
}

void LibraryPanel::show_section(LibrarySection section) { sections_->setCurrentIndex(int(section)); }

void LibraryPanel::set_folder(const QString& folder) {
    model_->set_folder(folder);
    update_page();
}

QModelIndex LibraryPanel::view_index(const QString& key) const {
    for (int row = 0; row < filter_->rowCount(); ++row) {
        const QModelIndex index = filter_->index(row, 0);
        if (index.data(Qt::UserRole).toString() == key) {
            return index;
        }
    }
    return {};
}

void LibraryPanel::choose(const QModelIndex& index) {
    const QModelIndex source = filter_->mapToSource(index);
    const auto item = model_->item_at(source);
    if (!item) {
        return;
    }
    if (!item->scene) {
        waiting_ = item->key;
        model_->need(source);
        Q_EMIT message(tr("%1 is being loaded...").arg(item->name));
        return;
    }
    Q_EMIT chosen(item);
}

bool LibraryPanel::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        const bool enter = key == Qt::Key_Return || key == Qt::Key_Enter;
        if (watched == search_ && (key == Qt::Key_Down || enter) && filter_->rowCount() > 0) {
            view_->setFocus();
            if (!view_->currentIndex().isValid()) {
                view_->setCurrentIndex(filter_->index(0, 0));
            }
            return true;
        }
        if (watched == view_ && enter) {
            choose(view_->currentIndex());
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

} // namespace atrium::ui
