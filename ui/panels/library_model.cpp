#include "ui/panels/library_model.h"

#include "engine/io/scene_file.h"
#include "ui/document/background.h"
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
    run_in_background(
        this,
        [items = items_]() -> Result<std::vector<QImage>> {
            std::vector<QImage> out;
            for (const auto& item : items) {
                out.push_back(picture_of(*item));
            }
            return out;
        },
        [this](const Result<std::vector<QImage>>& made) {
            for (std::size_t i = 0; made && i < made->size(); ++i) {
                item(int(i))->setIcon(icon_of((*made)[i]));
            }
        });
}

void LibraryModel::set_folder(const QString& folder) {
    const auto first = std::find_if(items_.begin(), items_.end(),
                                    [](const auto& item) { return item->section == LibrarySection::Furniture; });
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
                Q_EMIT message(QString::fromStdString(found.error().message()));
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
                    item(row)->setToolTip(QString::fromStdString(made.error().message()));
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
    if (item->section != LibrarySection::Furniture || item == needed_) {
        return;
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
                Q_EMIT message(QString::fromStdString(made.error().message()));
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
