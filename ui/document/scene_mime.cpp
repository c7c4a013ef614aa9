#include "ui/document/scene_mime.h"

#include "engine/io/scene_file.h"

#include <QFile>
#include <QTemporaryDir>

namespace atrium::ui {

SceneMime::SceneMime(std::shared_ptr<const LibraryItem> item)
    : kind_(item->is_material() ? Kind::Material : Kind::Nodes), item_(std::move(item)) {}

QString SceneMime::type_of(Kind kind) {
    return kind == Kind::Nodes ? QStringLiteral("application/x-atrium-nodes")
                               : QStringLiteral("application/x-atrium-material");
}

bool SceneMime::holds(const QMimeData* data, Kind kind) { return data != nullptr && data->hasFormat(type_of(kind)); }

QStringList SceneMime::formats() const { return {type_of(kind_)}; }

QVariant SceneMime::retrieveData(const QString& type, QMetaType wanted) const {
    const std::shared_ptr<const Scene> piece = scene();
    if (type != type_of(kind_) || !piece) {
        return QMimeData::retrieveData(type, wanted);
    }
    if (written_.isEmpty()) {
        if (auto bytes = scene_to_bytes(*piece)) {
            written_ = std::move(*bytes);
        }
    }
    return written_;
}

Result<QByteArray> scene_to_bytes(const Scene& scene) {
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("piece.atrium"));
    if (const auto done = write_scene(path.toStdString(), scene); !done) {
        return tl::unexpected(done.error());
    }
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) {
        return fail(path.toStdString(), {}, file.errorString().toStdString());
    }
    return file.readAll();
}

Result<Scene> scene_from_bytes(const QByteArray& bytes) {
    const QTemporaryDir folder;
    QFile file(folder.filePath(QStringLiteral("piece.atrium")));
    if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size()) {
        return fail(file.fileName().toStdString(), {}, file.errorString().toStdString());
    }
    file.close();
    auto loaded = read_scene(file.fileName().toStdString());
    if (!loaded) {
        return tl::unexpected(loaded.error());
    }
    return std::move(loaded->scene);
}

} // namespace atrium::ui
