#include "ui/panels/library_model.h"

#include "engine/io/scene_file.h"
#include "ui/document/background.h"
#include "ui/document/engine_text.h"
#include "ui/document/insert_commands.h"
#include "ui/document/scene_mime.h"
#include "ui/panels/thumbnail.h"

#include <QDirIterator>
#include <QFileInfo>
#include <QIcon>
#include <QPixmap>
#include <QRegularExpression>

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr int kMostFurniture = 500; ///< a folder of everything would never end
constexpr int kPixels = 2 * LibraryModel::kPictureSize;

QIcon icon_of(const QImage& image) {
    QPixmap picture = QPixmap::fromImage(image);
    picture.setDevicePixelRatio(double(image.width()) / LibraryModel::kPictureSize);
    return QIcon(picture);
}

QImage picture_of(const LibraryItem& item) {
    if (item.is_material()) {
        const Material* material = item.scene->materials.find(material_in(*item.scene));
        return material_thumbnail(material == nullptr ? default_material() : *material, kPixels);
    }
    if (item.mount == Mount::Ceiling) { // as it hangs
        Scene hanging;
        const Command command = insert_scene(hanging, *item.scene, glm::mat4_cast(turn_to_face({0, -1, 0})));
        (void)atrium::apply(hanging, command.edit);
        return object_thumbnail(hanging, kPixels);
    }
    return object_thumbnail(*item.scene, kPixels);
}

} // namespace

Result<Scene> read_shipped_furniture(const LibraryItem& item) {
    QFile file(item.key);
    if (!file.open(QIODevice::ReadOnly)) {
        return fail(item.key.toStdString(), {}, file.errorString().toStdString());
    }
    auto out = scene_from_bytes(file.readAll());
    if (out) {
        for (const NodeId root : out->roots) {
            out->nodes.find(root)->name = item.name.toStdString();
        }
    }
    return out;
}

Result<Scene> read_furniture(const QString& path) {
    auto loaded = read_scene(path.toStdString());
    if (!loaded) {
        return tl::unexpected(loaded.error());
    }
    const Command command = merge_scene(Scene(), loaded->scene, QFileInfo(path).completeBaseName().toStdString());
    Scene out;
    if (const auto done = atrium::apply(out, command.edit); !done) {
        return tl::unexpected(done.error());
    }
    for (const NodeId id : out.in_tree_order()) {
        out.nodes.find(id)->camera = {};
    }
    if (out.bounds().empty()) {
        return fail(path.toStdString(), {}, "there is nothing to see in this file");
    }
    return out;
}

LibraryModel::LibraryModel(QObject* parent) : QStandardItemModel(parent) {
    for (const LibraryItem& item : shipped_library()) {
        add(std::make_shared<LibraryItem>(item));
    }
    draw_shipped();
}

void LibraryModel::add(std::shared_ptr<LibraryItem> item) {
    static const QRegularExpression before_unit(QStringLiteral("(\\d) (?=(lm|K)\\b)"));
    auto* row = new QStandardItem(QString(item->name).replace(before_unit, QStringLiteral("\\1\u00a0"))); // not torn apart
    row->setEditable(false);
    row->setDragEnabled(true);
    row->setDropEnabled(false);
    row->setToolTip(item->tip.isEmpty() ? item->name : item->name + QLatin1Char('\n') + item->tip);
    row->setData(item->key, Qt::UserRole);
    QPixmap empty(kPixels, kPixels);
    empty.fill(Qt::transparent);
    empty.setDevicePixelRatio(2.0);
    row->setIcon(QIcon(empty)); // keeps the place until the picture is made
    items_.push_back(std::move(item));
    appendRow(row);
}

std::shared_ptr<const LibraryItem> LibraryModel::item_at(const QModelIndex& index) const {
    return index.isValid() && std::size_t(index.row()) < items_.size() ? items_[std::size_t(index.row())] : nullptr;
}

int LibraryModel::row_of(const QString& key) const {
    const auto it = std::find_if(items_.begin(), items_.end(), [&](const auto& item) { return item->key == key; });
    return it == items_.end() ? -1 : int(it - items_.begin());
}

void LibraryModel::draw_shipped() {
    struct Drawn {
        QImage picture;
        std::shared_ptr<const Scene> scene; ///< of furniture, read for the picture and kept: it is small
    };
    run_in_background(
        this,
        [items = items_]() -> Result<std::vector<Drawn>> {
            std::vector<Drawn> out;
            for (const auto& item : items) {
                LibraryItem whole = *item;
                if (!whole.scene) {
                    auto scene = read_shipped_furniture(whole);
                    if (!scene) {
                        return tl::unexpected(scene.error());
                    }
                    whole.scene = std::make_shared<const Scene>(std::move(*scene));
                }
                out.push_back({picture_of(whole), whole.scene});
            }
            return out;
        },
        [this](const Result<std::vector<Drawn>>& made) {
            if (!made) {
                Q_EMIT message(error_message(made.error()));
                return;
            }
            for (std::size_t i = 0; i < made->size(); ++i) {
                item(int(i))->setIcon(icon_of((*made)[i].picture));
                if (!items_[i]->scene) {
                    items_[i]->scene = (*made)[i].scene;
                    Q_EMIT loaded(items_[i]->key);
                }
            }
        });
}

void LibraryModel::set_folder(const QString& folder) {
    const auto first = std::find_if(items_.begin(), items_.end(), [](const auto& item) { return !item->ships(); });
    const int row = int(first - items_.begin());
    removeRows(row, rowCount() - row);
    items_.erase(first, items_.end());
    needed_.reset();
    to_draw_.clear();
    if (folder.isEmpty()) {
        return;
    }
    run_in_background(
        this,
        [folder]() -> Result<QStringList> {
            QStringList files;
            QDirIterator it(folder, {QStringLiteral("*.glb"), QStringLiteral("*.gltf")}, QDir::Files | QDir::Readable,
                            QDirIterator::Subdirectories);
            while (it.hasNext() && files.size() < kMostFurniture) {
                files << it.next();
            }
            files.sort(Qt::CaseInsensitive);
            return files;
        },
        [this, folder](const Result<QStringList>& found) {
            if (!found) {
                Q_EMIT message(error_message(found.error()));
                return;
            }
            for (const QString& file : *found) {
                if (row_of(file) >= 0) {
                    continue; // the folder was chosen twice in a row
                }
                auto item = std::make_shared<LibraryItem>();
                item->section = LibrarySection::Furniture;
                item->key = file;
                item->name = QFileInfo(file).completeBaseName();
                item->tip = file;
                add(std::move(item));
                to_draw_ << file;
            }
            if (found->isEmpty()) {
                Q_EMIT message(tr("There are no glTF files in %1.").arg(folder));
            }
            draw_next();
        });
}

void LibraryModel::draw_next() {
    if (drawing_ || to_draw_.isEmpty()) {
        return;
    }
    drawing_ = true;
    const QString key = to_draw_.takeFirst();
    run_in_background(
        this,
        [key]() -> Result<QImage> {
            const auto scene = read_furniture(key);
            if (!scene) {
                return tl::unexpected(scene.error());
            }
            return object_thumbnail(*scene, kPixels);
        },
        [this, key](const Result<QImage>& made) {
            drawing_ = false;
            if (const int row = row_of(key); row >= 0) {
                if (made) {
                    item(row)->setIcon(icon_of(*made));
                } else {
                    item(row)->setToolTip(error_message(made.error()));
                    item(row)->setEnabled(false);
                }
            }
            draw_next();
        });
}

void LibraryModel::need(const QModelIndex& index) {
    if (!index.isValid() || std::size_t(index.row()) >= items_.size()) {
        return;
    }
    const std::shared_ptr<LibraryItem> item = items_[std::size_t(index.row())];
    if (item->ships() || item == needed_) {
        return; // what ships is there, or comes with the pictures
    }
    if (needed_) {
        needed_->scene.reset();
    }
    needed_ = item;
    run_in_background(
        this, [key = item->key] { return read_furniture(key); },
        [this, item](Result<Scene> made) {
            if (item != needed_) {
                return;
            }
            if (!made) {
                needed_.reset();
                Q_EMIT message(error_message(made.error()));
                return;
            }
            item->scene = std::make_shared<const Scene>(std::move(*made));
            Q_EMIT loaded(item->key);
        });
}

QStringList LibraryModel::mimeTypes() const {
    return {SceneMime::type_of(SceneMime::Kind::Nodes), SceneMime::type_of(SceneMime::Kind::Material)};
}

QMimeData* LibraryModel::mimeData(const QModelIndexList& indexes) const {
    const auto item = indexes.isEmpty() ? nullptr : item_at(indexes.front());
    return item ? new SceneMime(item) : nullptr;
}

LibraryFilter::LibraryFilter(LibraryModel& model, QObject* parent) : QSortFilterProxyModel(parent), model_(model) {
    setSourceModel(&model);
}

void LibraryFilter::set_section(LibrarySection section) {
    section_ = section;
    invalidateFilter();
}

void LibraryFilter::set_words(const QString& words) {
    words_ = words.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    invalidateFilter();
}

bool LibraryFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
    const auto item = model_.item_at(model_.index(row, 0, parent));
    if (!item) {
        return false;
    }
    if (words_.isEmpty()) {
        return item->section == section_;
    }
    return std::all_of(words_.begin(), words_.end(), [&](const QString& word) {
        return item->name.contains(word, Qt::CaseInsensitive) || item->tip.contains(word, Qt::CaseInsensitive);
    });
}

} // namespace atrium::ui
