#include "ui/panels/caustic_table_model.h"

#include <algorithm>
#include <utility>

namespace atrium::ui {

namespace {

QString cell_text(const CausticRow& row, int column) {
    const CausticRecord& r = row.record;
    const bool texture = row.has_texture();
    switch (column) {
    case CausticTableModel::Surface: return row.name;
    case CausticTableModel::ShownAs: return caustic_decision_text(row);
    case CausticTableModel::Reason: return caustic_reason_text(row);
    case CausticTableModel::Particles: return count_text(r.particles);
    case CausticTableModel::Texel: return texture ? length_text(row.texel()) : QString();
    case CausticTableModel::TexelReason: return caustic_sizing_text(row);
    case CausticTableModel::Kernel: return caustic_kernel_text(row);
    case CausticTableModel::Boxes: return texture ? count_text(r.boxes.size()) : QString();
    case CausticTableModel::Coverage: return texture ? share_text(row.coverage()) : QString();
    case CausticTableModel::Memory: return texture ? memory_text(r.bytes) : QString();
    case CausticTableModel::InTextures: return lumen_text(r.power_texture);
    case CausticTableModel::OnMesh: return lumen_text(r.power_mesh);
    default: return {};
    }
}

QVariant sort_value(const CausticRow& row, int column) {
    const CausticRecord& r = row.record;
    switch (column) {
    case CausticTableModel::Particles: return qulonglong(r.particles);
    case CausticTableModel::Texel: return row.texel();
    case CausticTableModel::Kernel: return row.has_texture() ? double(r.kernel) : 0.0;
    case CausticTableModel::Boxes: return qulonglong(r.boxes.size());
    case CausticTableModel::Coverage: return row.coverage();
    case CausticTableModel::Memory: return qulonglong(r.bytes);
    case CausticTableModel::InTextures: return r.power_texture;
    case CausticTableModel::OnMesh: return r.power_mesh;
    default: return cell_text(row, column);
    }
}

bool is_text(int column) {
    return column == CausticTableModel::Surface || column == CausticTableModel::ShownAs ||
           column == CausticTableModel::Reason || column == CausticTableModel::TexelReason;
}

} // namespace

void CausticTableModel::set_rows(std::vector<CausticRow> rows) {
    const auto known = [&](const CausticRow& row, const std::vector<CausticRow>& in) {
        const auto at = std::lower_bound(in.begin(), in.end(), row,
                                         [](const CausticRow& a, const CausticRow& b) { return a.before(b); });
        return at != in.end() && at->same_place(row);
    };
    for (std::size_t end = rows_.size(); end > 0;) { // runs of places that are gone
        std::size_t begin = end;
        while (begin > 0 && !known(rows_[begin - 1], rows)) {
            --begin;
        }
        if (begin < end) {
            beginRemoveRows({}, int(begin), int(end) - 1);
            rows_.erase(rows_.begin() + std::ptrdiff_t(begin), rows_.begin() + std::ptrdiff_t(end));
            endRemoveRows();
            end = begin;
        } else {
            --end;
        }
    }
    // Told once: a view that sorts would begin anew for every row.
    std::size_t first_changed = rows.size(), last_changed = 0;
    for (std::size_t i = 0; i < rows.size();) {
        if (i < rows_.size() && rows_[i].same_place(rows[i])) {
            if (!(rows_[i] == rows[i])) {
                rows_[i] = rows[i];
                first_changed = std::min(first_changed, i);
                last_changed = i;
            }
            ++i;
            continue;
        }
        std::size_t end = i; // a run of places that are new
        while (end < rows.size() && !(i < rows_.size() && rows_[i].same_place(rows[end]))) {
            ++end;
        }
        beginInsertRows({}, int(i), int(end) - 1);
        rows_.insert(rows_.begin() + std::ptrdiff_t(i), rows.begin() + std::ptrdiff_t(i),
                     rows.begin() + std::ptrdiff_t(end));
        endInsertRows();
        i = end;
    }
    if (first_changed < rows.size()) {
        Q_EMIT dataChanged(index(int(first_changed), 0), index(int(last_changed), ColumnCount - 1));
    }
}

void CausticTableModel::clear() {
    beginResetModel();
    rows_.clear();
    endResetModel();
}

int CausticTableModel::rowCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : int(rows_.size()); }
int CausticTableModel::columnCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : int(ColumnCount); }

QVariant CausticTableModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || index.row() >= rowCount()) {
        return {};
    }
    const CausticRow& of = row(index.row());
    switch (role) {
    case Qt::DisplayRole: return cell_text(of, index.column());
    case kSortRole: return sort_value(of, index.column());
    case Qt::TextAlignmentRole: return int((is_text(index.column()) ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    case Qt::ToolTipRole:
        return index.column() == Texel && of.has_texture()
                   ? tr("%1 x %2 texels over the whole piece").arg(of.record.width).arg(of.record.height)
                   : cell_text(of, index.column());
    case Qt::AccessibleTextRole:
        return QStringLiteral("%1: %2").arg(headerData(index.column(), Qt::Horizontal, Qt::DisplayRole).toString(),
                                            cell_text(of, index.column()));
    default: return {};
    }
}

QVariant CausticTableModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal) {
        return {};
    }
    if (role == Qt::TextAlignmentRole) {
        return int((is_text(section) ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    }
    struct Head {
        QString title, tip;
    };
    const auto head = [section]() -> Head {
        switch (section) {
        case Surface: return {tr("Surface"), tr("Name of the object, with part, piece and side where there are several")};
        case ShownAs:
            return {tr("Shown as"), tr("Where the caustic light is kept: in textures or on the corners of the mesh")};
        case Reason: return {tr("Why"), tr("What the tests found")};
        case Particles: return {tr("Particles"), tr("Particles that landed here")};
        case Texel: return {tr("Texel"), tr("Edge of a texel on the surface")};
        case TexelReason: return {tr("Texel follows"), tr("What decides the size of the texels")};
        case Kernel:
            return {tr("Kernel"),
                    tr("Width of the spot that a particle's light is spread over, across its narrow side; the median")};
        case Boxes: return {tr("Boxes"), tr("Restriction boxes: the textures cover no more than these")};
        case Coverage: return {tr("Covered"), tr("Share of the piece that the boxes cover")};
        case Memory: return {tr("Memory"), tr("Of the textures")};
        case InTextures: return {tr("In textures"), tr("Light in the textures")};
        case OnMesh: return {tr("On mesh"), tr("Light on the corners of the mesh")};
        default: return {};
        }
    }();
    return role == Qt::DisplayRole ? QVariant(head.title) : role == Qt::ToolTipRole ? QVariant(head.tip) : QVariant();
}

CausticFilter::CausticFilter(QObject* parent) : QSortFilterProxyModel(parent) {
    setSortRole(CausticTableModel::kSortRole);
    setSortCaseSensitivity(Qt::CaseInsensitive);
    setSortLocaleAware(true);
    setDynamicSortFilter(true);
}

void CausticFilter::set_text(const QString& text) {
    words_ = text.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    invalidateFilter();
}

bool CausticFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
    QString all;
    for (int column = 0; column < CausticTableModel::ColumnCount; ++column) {
        if (is_text(column)) {
            all += sourceModel()->index(row, column, parent).data().toString() + QLatin1Char('\n');
        }
    }
    return std::all_of(words_.begin(), words_.end(),
                       [&](const QString& word) { return all.contains(word, Qt::CaseInsensitive); });
}

} // namespace atrium::ui
