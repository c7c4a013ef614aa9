#include "ui/panels/scene_tree_model.h"

#include "ui/actions/icons.h"
#include "ui/document/engine_text.h"
#include "ui/document/scene_commands.h"

#include <QApplication>
#include <QFont>
#include <QHash>
#include <QIODevice>
#include <QMimeData>
#include <QPalette>

#include <algorithm>

namespace atrium::ui {

namespace {

const QString kMimeType = QStringLiteral("application/x-atrium-nodes");

bool is_structural(const SceneEdit& edit) {
    if (const auto* group = std::get_if<EditGroup>(&edit.value)) {
        return std::any_of(group->edits.begin(), group->edits.end(), is_structural);
    }
    return std::holds_alternative<AddNode>(edit.value) || std::holds_alternative<RemoveNode>(edit.value) ||
           std::holds_alternative<SetParent>(edit.value);
}

QIcon cached_icon(const QString& name) {
    static QHash<QString, QIcon> cache; // the engine behind an icon paints with the palette of the moment
    auto it = cache.find(name);
    if (it == cache.end()) {
        it = cache.insert(name, tinted_icon(name));
    }
    return *it;
}

std::vector<NodeId> dragged_nodes(const QMimeData* data) {
    std::vector<NodeId> nodes;
    QByteArray bytes = data->data(kMimeType);
    QDataStream in(&bytes, QIODevice::ReadOnly);
    while (!in.atEnd()) {
        quint32 slot = 0;
        quint32 generation = 0;
        in >> slot >> generation;
        nodes.push_back({slot, generation});
    }
    return nodes;
}

} // namespace

SceneTreeModel::SceneTreeModel(Document& document, QObject* parent) : QAbstractItemModel(parent), document_(document) {
    rebuild();
    connect(&document_, &Document::reset_done, this, &SceneTreeModel::rebuild);
    connect(&document_, &Document::edited, this, &SceneTreeModel::on_edited);
}

SceneTreeModel::~SceneTreeModel() = default;

std::unique_ptr<SceneTreeModel::Item> SceneTreeModel::build(NodeId id, Item* parent) {
    auto item = std::make_unique<Item>();
    item->id = id;
    item->parent = parent;
    items_[id] = item.get();
    if (const Node* node = document_.scene().nodes.find(id)) {
        for (const NodeId child : node->children) {
            item->children.push_back(build(child, item.get()));
        }
        number_rows(item.get(), 0);
    }
    return item;
}

void SceneTreeModel::number_rows(Item* item, std::size_t from) {
    for (std::size_t i = from; i < item->children.size(); ++i) {
        item->children[i]->row = int(i);
    }
}

void SceneTreeModel::rebuild() {
    beginResetModel();
    items_.clear();
    root_ = std::make_unique<Item>();
    for (const NodeId id : document_.scene().roots) {
        root_->children.push_back(build(id, root_.get()));
    }
    number_rows(root_.get(), 0);
    endResetModel();
}

void SceneTreeModel::forget(const Item* item) {
    for (const auto& child : item->children) {
        forget(child.get());
    }
    const auto it = items_.find(item->id);
    if (it != items_.end() && it->second == item) {
        items_.erase(it);
    }
}

void SceneTreeModel::sync(Item* item, const std::vector<NodeId>& wanted) {
    const QModelIndex here = index_for(item, Name);
    auto& rows = item->children;
    for (std::size_t i = rows.size(); i-- > 0;) {
        if (std::find(wanted.begin(), wanted.end(), rows[i]->id) == wanted.end()) {
            beginRemoveRows(here, int(i), int(i));
            forget(rows[i].get());
            rows.erase(rows.begin() + std::ptrdiff_t(i));
            number_rows(item, i);
            endRemoveRows();
        }
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (i < rows.size() && rows[i]->id == wanted[i]) {
            continue;
        }
        // Out of place among its own siblings: taken out here and put in again below.
        for (std::size_t j = i + 1; j < rows.size(); ++j) {
            if (rows[j]->id == wanted[i]) {
                beginRemoveRows(here, int(j), int(j));
                forget(rows[j].get());
                rows.erase(rows.begin() + std::ptrdiff_t(j));
                number_rows(item, j);
                endRemoveRows();
                break;
            }
        }
        beginInsertRows(here, int(i), int(i));
        rows.insert(rows.begin() + std::ptrdiff_t(i), build(wanted[i], item));
        number_rows(item, i);
        endInsertRows();
    }
    for (const auto& child : rows) {
        if (const Node* node = document_.scene().nodes.find(child->id)) {
            const bool same = child->children.size() == node->children.size() &&
                              std::equal(child->children.begin(), child->children.end(), node->children.begin(),
                                         [](const std::unique_ptr<Item>& a, NodeId b) { return a->id == b; });
            if (!same || !child->children.empty()) {
                sync(child.get(), node->children);
            }
        }
    }
}

void SceneTreeModel::on_edited(const SceneEdit& edit) {
    if (is_structural(edit)) {
        sync(root_.get(), document_.scene().roots);
    }
    notify_changed(edit);
}

void SceneTreeModel::notify_changed(const SceneEdit& edit) {
    if (const auto* group = std::get_if<EditGroup>(&edit.value)) {
        for (const SceneEdit& part : group->edits) {
            notify_changed(part);
        }
    } else if (const auto* set = std::get_if<SetNode>(&edit.value)) {
        const QModelIndex at = index_of(set->id);
        if (at.isValid()) {
            Q_EMIT dataChanged(at, at.siblingAtColumn(Locked));
        }
    } else if (std::holds_alternative<SetResource<Light>>(edit.value) ||
               std::holds_alternative<SetResource<Shape>>(edit.value)) {
        // Icons follow the kind of light or shape; which nodes use it is not worth a search.
        if (!root_->children.empty()) {
            Q_EMIT dataChanged(index_for(root_->children.front().get(), Name),
                               index_for(root_->children.back().get(), Locked), {Qt::DecorationRole});
        }
    }
}

void SceneTreeModel::refresh_icons() {
    if (!root_->children.empty()) {
        Q_EMIT dataChanged(index_for(root_->children.front().get(), Name), index_for(root_->children.back().get(), Locked));
    }
}

SceneTreeModel::Item* SceneTreeModel::item_at(const QModelIndex& index) const {
    return index.isValid() ? static_cast<Item*>(index.internalPointer()) : root_.get();
}

QModelIndex SceneTreeModel::index_for(const Item* item, int column) const {
    return item == root_.get() ? QModelIndex() : createIndex(item->row, column, item);
}

NodeId SceneTreeModel::node_at(const QModelIndex& index) const { return index.isValid() ? item_at(index)->id : NodeId{}; }

QModelIndex SceneTreeModel::index_of(NodeId id, int column) const {
    const auto it = items_.find(id);
    return it == items_.end() ? QModelIndex() : index_for(it->second, column);
}

QModelIndex SceneTreeModel::index(int row, int column, const QModelIndex& parent) const {
    const Item* item = item_at(parent);
    if (row < 0 || column < 0 || column >= ColumnCount || row >= int(item->children.size())) {
        return {};
    }
    return createIndex(row, column, item->children[std::size_t(row)].get());
}

QModelIndex SceneTreeModel::parent(const QModelIndex& index) const {
    return index.isValid() ? index_for(item_at(index)->parent, Name) : QModelIndex();
}

int SceneTreeModel::rowCount(const QModelIndex& parent) const {
    return parent.column() > 0 ? 0 : int(item_at(parent)->children.size());
}

int SceneTreeModel::columnCount(const QModelIndex&) const { return ColumnCount; }

QString SceneTreeModel::kind_icon(const Node& node) const {
    const Scene& scene = document_.scene();
    if (const Light* light = scene.lights.find(node.light)) {
        switch (light->kind) {
        case Light::Kind::Point: return QStringLiteral("point_light");
        case Light::Kind::Spot: return QStringLiteral("spot_light");
        case Light::Kind::Directional: return QStringLiteral("sun");
        }
    }
    if (node.camera) {
        return QStringLiteral("camera");
    }
    if (const Shape* shape = scene.shapes.find(node.shape)) {
        const Material* material = scene.material_of(node, 0);
        if (material != nullptr && material->emits()) {
            return QStringLiteral("area_light");
        }
        return QString::fromLatin1(shape_kind(*shape)).toLower();
    }
    return QStringLiteral("group");
}

QVariant SceneTreeModel::data(const QModelIndex& index, int role) const {
    const NodeId id = node_at(index);
    const Node* node = document_.scene().nodes.find(id);
    if (node == nullptr) {
        return {};
    }
    const bool shown = document_.scene().shown(id);
    switch (role) {
    case Qt::DisplayRole:
    case Qt::EditRole:
        if (index.column() == Name) {
            const QString name = QString::fromStdString(node->name);
            return name.isEmpty() && role == Qt::DisplayRole ? tr("(unnamed)") : name;
        }
        return {};
    case Qt::DecorationRole:
        switch (index.column()) {
        case Name: return cached_icon(kind_icon(*node));
        case Visible: return cached_icon(node->visible ? QStringLiteral("eye") : QStringLiteral("eye_off"));
        case Locked: return node->locked ? QVariant(cached_icon(QStringLiteral("lock"))) : QVariant();
        default: return {};
        }
    case Qt::ForegroundRole:
        return shown ? QVariant() : QVariant(QApplication::palette().color(QPalette::Disabled, QPalette::Text));
    case Qt::FontRole: {
        QFont font;
        font.setItalic(node->locked);
        return font;
    }
    case Qt::ToolTipRole:
        switch (index.column()) {
        case Visible: return node->visible ? tr("Hide this object") : tr("Show this object");
        case Locked: return node->locked ? tr("Unlock this object") : tr("Lock this object against picking and moving");
        default: return QString::fromStdString(node->name);
        }
    case Qt::AccessibleTextRole:
        switch (index.column()) {
        case Visible: return node->visible ? tr("visible") : tr("hidden");
        case Locked: return node->locked ? tr("locked") : tr("not locked");
        default: return QString::fromStdString(node->name);
        }
    default: return {};
    }
}

bool SceneTreeModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    const NodeId id = node_at(index);
    const Node* node = document_.scene().nodes.find(id);
    if (node == nullptr || role != Qt::EditRole || index.column() != Name) {
        return false;
    }
    const QString name = value.toString().trimmed();
    if (name.isEmpty()) {
        return false;
    }
    Node renamed = *node;
    renamed.name = name.toStdString();
    const auto done = document_.apply(SceneEdit{SetNode{id, std::move(renamed)}}, tr("Rename"));
    if (!done) {
        Q_EMIT failed(error_message(done.error()));
    }
    return bool(done);
}

Qt::ItemFlags SceneTreeModel::flags(const QModelIndex& index) const {
    if (!index.isValid()) {
        return Qt::ItemIsDropEnabled;
    }
    Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsDropEnabled | Qt::ItemIsDragEnabled;
    if (index.column() == Name) {
        flags |= Qt::ItemIsEditable;
    }
    return flags;
}

QStringList SceneTreeModel::mimeTypes() const { return {kMimeType}; }

QMimeData* SceneTreeModel::mimeData(const QModelIndexList& indexes) const {
    QByteArray bytes;
    QDataStream out(&bytes, QIODevice::WriteOnly);
    for (const QModelIndex& index : indexes) {
        if (index.column() == Name) {
            const NodeId id = node_at(index);
            out << quint32(id.slot) << quint32(id.generation);
        }
    }
    auto* data = new QMimeData;
    data->setData(kMimeType, bytes);
    return data;
}

bool SceneTreeModel::canDropMimeData(const QMimeData* data, Qt::DropAction, int, int, const QModelIndex& parent) const {
    if (!data->hasFormat(kMimeType)) {
        return false;
    }
    const std::vector<NodeId> nodes = dragged_nodes(data);
    for (const Item* item = item_at(parent); item != nullptr; item = item->parent) {
        if (std::find(nodes.begin(), nodes.end(), item->id) != nodes.end() && item->id) {
            return false; // below itself
        }
    }
    return true;
}

bool SceneTreeModel::dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                                  const QModelIndex& parent) {
    if (!canDropMimeData(data, action, row, column, parent)) {
        return false;
    }
    Selection dragged;
    dragged.set(dragged_nodes(data));
    const std::vector<NodeId> nodes = dragged.top_level(document_.scene());
    const std::size_t index = row < 0 ? SIZE_MAX : std::size_t(row);
    const auto done = document_.apply(reparent_nodes(document_.scene(), nodes, node_at(parent), index), tr("Move in tree"));
    if (!done) {
        Q_EMIT failed(error_message(done.error()));
    }
    return bool(done); // the rows moved with the edit; nothing is left for the view to remove
}

Qt::DropActions SceneTreeModel::supportedDropActions() const { return Qt::MoveAction; }

} // namespace atrium::ui
