// The caustic inspector's table: one row for every chart of a surface side that caustic light fell on.
#pragma once

#include "ui/panels/caustic_words.h"

#include <QAbstractTableModel>
#include <QSortFilterProxyModel>

namespace atrium::ui {

/// UI thread only. Rows keep their persistent indices from one solution to the next as long as their place does.
class CausticTableModel : public QAbstractTableModel {
    Q_OBJECT
public:
    enum Column : std::uint8_t {
        Surface,
        ShownAs,
        Texel,
        Boxes,
        Coverage,
        Memory,
        InTextures,
        OnMesh,
        Particles,
        Kernel,
        Reason,
        TexelReason,
        ColumnCount
    };
    static constexpr int kSortRole = Qt::UserRole; ///< numbers as numbers, texts as texts

    using QAbstractTableModel::QAbstractTableModel;
    void set_rows(std::vector<CausticRow> rows); ///< in the order of places
    void clear();                                ///< another document
    [[nodiscard]] const std::vector<CausticRow>& rows() const { return rows_; }
    [[nodiscard]] const CausticRow& row(int index) const { return rows_[std::size_t(index)]; }

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
    std::vector<CausticRow> rows_;
};

/// Sorts by value and filters by what is written in the columns of text.
class CausticFilter : public QSortFilterProxyModel {
    Q_OBJECT
public:
    explicit CausticFilter(QObject* parent = nullptr);
    void set_text(const QString& text); ///< every word must occur somewhere in the row

protected:
    [[nodiscard]] bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

private:
    QStringList words_;
};

} // namespace atrium::ui
