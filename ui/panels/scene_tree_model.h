// The scene tree as an item model: a mirror of the nodes' structure that follows the document's edits row by row.
#pragma once

#include "ui/document/document.h"

#include <QAbstractItemModel>

#include <memory>
#include <unordered_map>
#include <vector>

namespace atrium::ui {

/// Columns: name, visible (eye), locked. UI thread only.
class SceneTreeModel : public QAbstractItemModel {
    Q_OBJECT
public:
    enum Column { Name, Visible, Locked, ColumnCount };

    explicit SceneTreeModel(Document& document, QObject* parent = nullptr);
    ~SceneTreeModel() override;

    [[nodiscard]] NodeId node_at(const QModelIndex& index) const;
    [[nodiscard]] QModelIndex index_of(NodeId id, int column = Name) const;
    void refresh_icons(); ///< after the palette changed

    QModelIndex index(int row, int column, const QModelIndex& parent) const override;
    QModelIndex parent(const QModelIndex& index) const override;
    int rowCount(const QModelIndex& parent) const override;
    int columnCount(const QModelIndex& parent) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    QStringList mimeTypes() const override;
    QMimeData* mimeData(const QModelIndexList& indexes) const override;
    bool canDropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                         const QModelIndex& parent) const override;
    bool dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column, const QModelIndex& parent) override;
    Qt::DropActions supportedDropActions() const override;

Q_SIGNALS:
    void failed(const QString& why); ///< an edit was refused

private:
    struct Item {
        NodeId id;
        Item* parent = nullptr;
        int row = 0;
        std::vector<std::unique_ptr<Item>> children;
    };
    Item* item_at(const QModelIndex& index) const;
    QModelIndex index_for(const Item* item, int column) const;
    std::unique_ptr<Item> build(NodeId id, Item* parent);
    void rebuild();
    void sync(Item* item, const std::vector<NodeId>& wanted); ///< makes the rows below `item` those of the scene
    void forget(const Item* item);
    void number_rows(Item* item, std::size_t from);
    void on_edited(const SceneEdit& edit);
    void notify_changed(const SceneEdit& edit);
    QString kind_icon(const Node& node) const;

    Document& document_;
    std::unique_ptr<Item> root_;
    std::unordered_map<NodeId, Item*> items_;
};

} // namespace atrium::ui
