// The library's entries as rows with pictures that are made in the background.
#pragma once

#include "ui/document/library.h"

#include <QSortFilterProxyModel>
#include <QStandardItemModel>

#include <memory>

namespace atrium::ui {

/// UI thread only. Rows can be dragged; the entry itself travels (SceneMime).
class LibraryModel : public QStandardItemModel {
    Q_OBJECT
public:
    static constexpr int kPictureSize = 64; ///< points

    explicit LibraryModel(QObject* parent = nullptr);

    [[nodiscard]] std::shared_ptr<const LibraryItem> item_at(const QModelIndex& index) const;
    /// Lists the glTF files of a folder and of the folders in it as furniture, instead of those before. Empty = none.
    void set_folder(const QString& folder);
    /// Loads a piece of furniture that is not loaded yet, and forgets the one before; others have nothing to load.
    void need(const QModelIndex& index);

    [[nodiscard]] QStringList mimeTypes() const override;
    [[nodiscard]] QMimeData* mimeData(const QModelIndexList& indexes) const override;

Q_SIGNALS:
    void loaded(const QString& key); ///< the entry has its scene now
    void message(const QString& text);

private:
    void add(std::shared_ptr<LibraryItem> item);
    void draw_shipped();
    void draw_next();
    [[nodiscard]] int row_of(const QString& key) const;

    std::vector<std::shared_ptr<LibraryItem>> items_; ///< by row
    std::shared_ptr<LibraryItem> needed_;             ///< furniture that is kept loaded
    QStringList to_draw_;
    bool drawing_ = false;
};

/// Entries of one section, or of all that have every word of a search in name or description.
class LibraryFilter : public QSortFilterProxyModel {
public:
    explicit LibraryFilter(LibraryModel& model, QObject* parent = nullptr);
    void set_section(LibrarySection section);
    void set_words(const QString& words);

protected:
    [[nodiscard]] bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

private:
    LibraryModel& model_;
    LibrarySection section_ = LibrarySection::Shapes;
    QStringList words_;
};

/// A piece of furniture that ships, as one node with the entry's name; an error where its resource is not there. Any thread.
Result<Scene> read_shipped_furniture(const LibraryItem& item);
/// Reads a model for the library: its shapes and lights under one root that has the file's name, without cameras. Any
/// thread.
Result<Scene> read_furniture(const QString& path);

} // namespace atrium::ui
