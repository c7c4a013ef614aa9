// Pieces of scenes on the clipboard and under the mouse. Within the program the scene itself travels; for other windows
// it is written as binary glTF when they ask for it.
#pragma once

#include "engine/base/result.h"
#include "ui/document/library.h"

#include <QMimeData>

#include <memory>

namespace atrium::ui {

/// UI thread only.
class SceneMime : public QMimeData {
    Q_OBJECT
public:
    enum class Kind : std::uint8_t { Nodes, Material };
    SceneMime(Kind kind, std::shared_ptr<const Scene> scene) : kind_(kind), scene_(std::move(scene)) {}
    /// A library entry that is being dragged; `item` may still be loading.
    explicit SceneMime(std::shared_ptr<const LibraryItem> item);

    [[nodiscard]] Kind kind() const { return kind_; }
    [[nodiscard]] const std::shared_ptr<const LibraryItem>& item() const { return item_; } ///< null off the clipboard
    [[nodiscard]] std::shared_ptr<const Scene> scene() const { return item_ ? item_->scene : scene_; }

    [[nodiscard]] QStringList formats() const override;
    [[nodiscard]] bool hasFormat(const QString& type) const override { return formats().contains(type); }

    static QString type_of(Kind kind); ///< MIME type: a .atrium file with nodes, or with one material
    /// True when the data hold a piece of this kind, from this program or another one.
    static bool holds(const QMimeData* data, Kind kind);

protected:
    [[nodiscard]] QVariant retrieveData(const QString& type, QMetaType wanted) const override;

private:
    Kind kind_;
    std::shared_ptr<const Scene> scene_;
    std::shared_ptr<const LibraryItem> item_;
    mutable QByteArray written_; ///< made when somebody outside asks
};

/// The bytes of a .atrium file with this scene. Any thread.
Result<QByteArray> scene_to_bytes(const Scene& scene);
/// Reads such bytes; they come from outside and are checked as any file. Any thread.
Result<Scene> scene_from_bytes(const QByteArray& bytes);

} // namespace atrium::ui
