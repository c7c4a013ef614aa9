// The dock with the scene tree: filter, rename in place, eye and lock, drag to re-parent.
#pragma once

#include "ui/document/document.h"

#include <QWidget>

class QLineEdit;
class QSortFilterProxyModel;
class QTreeView;

namespace atrium::ui {

class SceneTreeModel;

/// UI thread only. Its selection and the document's are the same at all times.
class SceneTreePanel : public QWidget {
    Q_OBJECT
public:
    explicit SceneTreePanel(Document& document, QWidget* parent = nullptr);
    [[nodiscard]] QTreeView* view() const { return view_; }
    [[nodiscard]] QModelIndex view_index(NodeId id) const; ///< row in the view, invalid while filtered out
    void rename_active();

Q_SIGNALS:
    void activated(atrium::NodeId id); ///< double click: bring it into view
    void message(const QString& text);

protected:
    void changeEvent(QEvent* event) override;

private:
    void on_view_selection();
    void on_document_selection();
    void on_clicked(const QModelIndex& index);

    Document& document_;
    SceneTreeModel* model_ = nullptr;
    QSortFilterProxyModel* proxy_ = nullptr;
    QTreeView* view_ = nullptr;
    QLineEdit* filter_ = nullptr;
    bool syncing_ = false;
};

} // namespace atrium::ui
