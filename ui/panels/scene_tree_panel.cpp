#include "ui/panels/scene_tree_panel.h"

#include "ui/document/engine_text.h"
#include "ui/document/scene_commands.h"
#include "ui/panels/scene_tree_model.h"

#include <QEvent>
#include <QHeaderView>
#include <QLineEdit>
#include <QSortFilterProxyModel>
#include <QTreeView>
#include <QVBoxLayout>

namespace atrium::ui {

SceneTreePanel::SceneTreePanel(Document& document, QWidget* parent) : QWidget(parent), document_(document) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(4, 4, 4, 4);
    layout->setSpacing(4);
    filter_ = new QLineEdit;
    filter_->setObjectName(QStringLiteral("tree_filter"));
    filter_->setPlaceholderText(tr("Filter objects"));
    filter_->setAccessibleName(tr("Filter objects by name"));
    filter_->setClearButtonEnabled(true);
    layout->addWidget(filter_);

    model_ = new SceneTreeModel(document, this);
    proxy_ = new QSortFilterProxyModel(this);
    proxy_->setSourceModel(model_);
    proxy_->setRecursiveFilteringEnabled(true);
    proxy_->setFilterCaseSensitivity(Qt::CaseInsensitive);
    view_ = new QTreeView;
    view_->setObjectName(QStringLiteral("scene_tree"));
    view_->setAccessibleName(tr("Scene tree"));
    view_->setModel(proxy_);
    view_->setHeaderHidden(true);
    view_->setUniformRowHeights(true);
    view_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    view_->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::SelectedClicked);
    view_->setDragDropMode(QAbstractItemView::InternalMove);
    view_->setDefaultDropAction(Qt::MoveAction);
    view_->setExpandsOnDoubleClick(false);
    view_->header()->setStretchLastSection(false);
    view_->header()->setMinimumSectionSize(20);
    view_->header()->setSectionResizeMode(SceneTreeModel::Name, QHeaderView::Stretch);
    for (const int column : {SceneTreeModel::Visible, SceneTreeModel::Locked}) {
        view_->header()->setSectionResizeMode(column, QHeaderView::Fixed);
        view_->header()->resizeSection(column, 26);
    }
    layout->addWidget(view_);

    connect(filter_, &QLineEdit::textChanged, this, [this](const QString& text) {
        proxy_->setFilterFixedString(text);
        if (!text.isEmpty()) {
            view_->expandAll();
        }
        on_document_selection();
    });
    connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, this, &SceneTreePanel::on_view_selection);
    connect(view_, &QTreeView::clicked, this, &SceneTreePanel::on_clicked);
    connect(view_, &QTreeView::doubleClicked, this, [this](const QModelIndex& index) {
        if (index.column() == SceneTreeModel::Name) {
            Q_EMIT activated(model_->node_at(proxy_->mapToSource(index)));
        }
    });
    connect(model_, &SceneTreeModel::failed, this, &SceneTreePanel::message);
    connect(model_, &QAbstractItemModel::modelReset, this, [this] {
        if (document_.scene().nodes.size() <= 200) {
            view_->expandToDepth(0);
        }
    });
    // Queued behind the model's own reaction to an edit would be too late for tests and keys: these run right after it.
    connect(model_, &QAbstractItemModel::rowsInserted, this, &SceneTreePanel::on_document_selection);
    connect(document_.selection(), &Selection::changed, this, &SceneTreePanel::on_document_selection);
}

QModelIndex SceneTreePanel::view_index(NodeId id) const { return proxy_->mapFromSource(model_->index_of(id)); }

void SceneTreePanel::rename_active() {
    const QModelIndex index = view_index(document_.selection()->active());
    if (index.isValid()) {
        view_->setFocus();
        view_->setCurrentIndex(index);
        view_->edit(index);
    }
}

void SceneTreePanel::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange && model_ != nullptr) {
        model_->refresh_icons();
    }
    QWidget::changeEvent(event);
}

void SceneTreePanel::on_view_selection() {
    if (syncing_) {
        return;
    }
    syncing_ = true;
    std::vector<NodeId> nodes;
    const QModelIndex current = view_->selectionModel()->currentIndex();
    const NodeId active = model_->node_at(proxy_->mapToSource(current));
    bool active_selected = false;
    const QModelIndexList rows = view_->selectionModel()->selectedRows(SceneTreeModel::Name);
    for (const QModelIndex& row : rows) {
        const NodeId id = model_->node_at(proxy_->mapToSource(row));
        if (id == active) {
            active_selected = true;
        } else if (document_.scene().nodes.contains(id)) {
            nodes.push_back(id);
        }
    }
    if (active_selected && document_.scene().nodes.contains(active)) {
        nodes.push_back(active);
    }
    document_.selection()->set(std::move(nodes));
    syncing_ = false;
}

void SceneTreePanel::on_document_selection() {
    if (syncing_) {
        return;
    }
    syncing_ = true;
    QItemSelection selection;
    for (const NodeId id : document_.selection()->nodes()) {
        const QModelIndex index = view_index(id);
        if (index.isValid()) {
            selection.select(index, index.siblingAtColumn(SceneTreeModel::Locked));
        }
    }
    view_->selectionModel()->select(selection, QItemSelectionModel::ClearAndSelect);
    const QModelIndex active = view_index(document_.selection()->active());
    if (active.isValid()) {
        view_->selectionModel()->setCurrentIndex(active, QItemSelectionModel::NoUpdate);
        view_->scrollTo(active);
    }
    syncing_ = false;
}

void SceneTreePanel::on_clicked(const QModelIndex& index) {
    const NodeId id = model_->node_at(proxy_->mapToSource(index));
    const Node* node = document_.scene().nodes.find(id);
    if (node == nullptr || index.column() == SceneTreeModel::Name) {
        return;
    }
    // With several selected, the click is meant for all of them.
    const std::vector<NodeId> nodes =
        document_.selection()->contains(id) ? document_.selection()->nodes() : std::vector<NodeId>{id};
    const bool eye = index.column() == SceneTreeModel::Visible;
    const SceneEdit edit =
        eye ? set_visible(document_.scene(), nodes, !node->visible) : set_locked(document_.scene(), nodes, !node->locked);
    const QString text = eye ? (node->visible ? tr("Hide") : tr("Show")) : (node->locked ? tr("Unlock") : tr("Lock"));
    if (const auto done = document_.apply(edit, text); !done) {
        Q_EMIT message(error_message(done.error()));
    }
}

} // namespace atrium::ui
