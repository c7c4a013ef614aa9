#include "ui/window/recovery_dialog.h"

#include "engine/io/scene_file.h"
#include "ui/document/background.h"
#include "ui/document/engine_text.h"
#include "ui/panels/lit_picture.h"
#include "ui/panels/room_picture.h"
#include "ui/window/file_names.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QVBoxLayout>

#include <map>

namespace atrium::ui {
namespace {

constexpr QSize kPicture(400, 250);
constexpr int kNamesShown = 6;

/// What was found out about both files.
struct Compared {
    QImage saved;
    QImage recovered;
    QString saved_error; ///< why there is no picture
    QString recovered_error;
    SceneDifference difference;
    bool comparable = false;
};

QString date_text(const QDateTime& date) { return QLocale().toString(date, QStringLiteral("d MMM yyyy  HH:mm:ss")); }

/// Both pictures in the saved light where there is any, so that they can be compared; else both without light.
void draw(Compared& out, const Scene* recovered, const LoadedScene* saved, const ViewCamera& camera) {
    std::shared_ptr<const Solution> light;
    if (saved != nullptr && !saved->solution.empty()) {
        light = decode_solution(saved->solution, saved->scene).value_or(nullptr);
    }
    if (light && !light->surfaces.empty()) {
        out.saved = lit_picture(saved->scene, *light, camera, kPicture);
        if (recovered != nullptr) {
            out.recovered = lit_picture(*recovered, carried_light(saved->scene, *light, *recovered), camera, kPicture);
        }
        return;
    }
    if (recovered != nullptr) {
        out.recovered = room_picture(*recovered, camera, kPicture);
    }
    if (saved != nullptr) {
        out.saved = room_picture(saved->scene, camera, kPicture);
    }
}

/// Any thread.
Compared compare(const RecoveredFile& file) {
    Compared out;
    const auto recovered = read_scene(to_path(file.path));
    if (!recovered) {
        out.recovered_error = error_message(recovered.error());
    }
    std::optional<Result<LoadedScene>> saved;
    if (!file.original.isEmpty() && QFileInfo::exists(file.original)) {
        saved = read_scene(to_path(file.original));
        if (!*saved) {
            out.saved_error = error_message(saved->error());
        }
    }
    const bool have_saved = saved && *saved;
    if (recovered || have_saved) {
        // One place to look from for both, or they could not be compared.
        const Scene& leading = recovered ? recovered->scene : (*saved)->scene;
        const ViewCamera camera = file.camera ? *file.camera : default_camera(leading);
        draw(out, recovered ? &recovered->scene : nullptr, have_saved ? &**saved : nullptr, camera);
    }
    if (recovered && have_saved) {
        out.comparable = true;
        out.difference = scene_difference((*saved)->scene, recovered->scene);
    }
    return out;
}

bool same_object(const Scene& a, const Node& x, const Scene& b, const Node& y) {
    const auto same = [](const auto* one, const auto* other, const auto& equal) {
        return (one == nullptr) == (other == nullptr) && (one == nullptr || equal(*one, *other));
    };
    if (x.transform != y.transform || x.visible != y.visible || x.materials.size() != y.materials.size()) {
        return false;
    }
    for (std::size_t i = 0; i < x.materials.size(); ++i) {
        if (!same(a.materials.find(x.materials[i]), b.materials.find(y.materials[i]),
                  [](const Material& m, const Material& n) {
                      return m.name == n.name && m.base_color == n.base_color && m.roughness == n.roughness &&
                             m.metallic == n.metallic && m.transmission == n.transmission &&
                             m.emissive_color == n.emissive_color && m.emissive_strength == n.emissive_strength;
                  })) {
            return false;
        }
    }
    return same(a.shapes.find(x.shape), b.shapes.find(y.shape),
                [](const Shape& m, const Shape& n) {
                    return m.geometry.index() == n.geometry.index() &&
                           (std::holds_alternative<Mesh>(m.geometry) || m.geometry == n.geometry);
                }) &&
           same(a.lights.find(x.light), b.lights.find(y.light), [](const Light& m, const Light& n) {
               return m.color == n.color && m.intensity == n.intensity && m.enabled == n.enabled;
           });
}

std::multimap<std::string, NodeId> by_name(const Scene& scene) {
    std::multimap<std::string, NodeId> out;
    for (const NodeId id : scene.in_tree_order()) {
        out.emplace(scene.nodes.find(id)->name, id);
    }
    return out;
}

QString names(const QStringList& list) {
    return list.size() <= kNamesShown ? list.join(QStringLiteral(", "))
                                      : RecoveryDialog::tr("%1 and %n more", nullptr, int(list.size()) - kNamesShown)
                                            .arg(QStringList(list.mid(0, kNamesShown)).join(QStringLiteral(", ")));
}

QLabel* picture_label() {
    auto* label = new QLabel;
    label->setFixedSize(kPicture);
    label->setFrameShape(QFrame::StyledPanel);
    label->setAlignment(Qt::AlignCenter);
    label->setWordWrap(true);
    return label;
}

} // namespace

SceneDifference scene_difference(const Scene& saved, const Scene& recovered) {
    SceneDifference out;
    auto before = by_name(saved);
    for (const auto& [name, id] : by_name(recovered)) {
        const auto match = before.find(name);
        if (match == before.end()) {
            out.added += QString::fromStdString(name);
            continue;
        }
        if (!same_object(saved, *saved.nodes.find(match->second), recovered, *recovered.nodes.find(id))) {
            out.changed += QString::fromStdString(name);
        }
        before.erase(match);
    }
    for (const auto& [name, id] : before) {
        out.removed += QString::fromStdString(name);
    }
    return out;
}

RecoveryDialog::RecoveryDialog(std::vector<RecoveredFile> files, bool after_crash, QWidget* parent)
    : QDialog(parent), files_(std::move(files)) {
    setObjectName(QStringLiteral("recovery"));
    setWindowTitle(tr("Recovered work"));
    auto* layout = new QVBoxLayout(this);
    intro_ = new QLabel(after_crash ? tr("Atrium did not end properly. Work that was not saved has been kept.")
                                    : tr("Work that was not saved: kept after a crash, or given up in the last two weeks."));
    QFont bold = intro_->font();
    bold.setBold(true);
    intro_->setFont(bold);
    layout->addWidget(intro_);
    choice_ = new QComboBox;
    choice_->setAccessibleName(tr("Recovered work"));
    for (const RecoveredFile& file : files_) {
        const QString name = file.original.isEmpty() ? tr("Untitled") : QFileInfo(file.original).fileName();
        const QString when = date_text(file.date);
        choice_->addItem(file.reason == RecoveredFile::Reason::Reverted    ? tr("%1, %2, reverted").arg(name, when)
                         : file.reason == RecoveredFile::Reason::Discarded ? tr("%1, %2, discarded").arg(name, when)
                                                                           : tr("%1, %2").arg(name, when));
    }
    choice_->setVisible(files_.size() > 1);
    layout->addWidget(choice_);

    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(12);
    saved_caption_ = new QLabel;
    recovered_caption_ = new QLabel;
    saved_picture_ = picture_label();
    saved_picture_->setObjectName(QStringLiteral("saved_picture"));
    saved_picture_->setAccessibleName(tr("Picture of the saved file"));
    recovered_picture_ = picture_label();
    recovered_picture_->setObjectName(QStringLiteral("recovered_picture"));
    recovered_picture_->setAccessibleName(tr("Picture of the recovered work"));
    for (QLabel* caption : {saved_caption_, recovered_caption_}) {
        caption->setWordWrap(true);
        caption->setAlignment(Qt::AlignBottom | Qt::AlignLeft);
        caption->setTextFormat(Qt::PlainText);
    }
    saved_caption_->setObjectName(QStringLiteral("saved_caption"));
    recovered_caption_->setObjectName(QStringLiteral("recovered_caption"));
    grid->addWidget(saved_caption_, 0, 0);
    grid->addWidget(recovered_caption_, 0, 1);
    grid->addWidget(saved_picture_, 1, 0);
    grid->addWidget(recovered_picture_, 1, 1);
    layout->addLayout(grid);
    summary_ = new QLabel;
    summary_->setObjectName(QStringLiteral("recovery_summary"));
    summary_->setWordWrap(true);
    summary_->setTextFormat(Qt::PlainText);
    summary_->setMinimumHeight(4 * fontMetrics().lineSpacing());
    summary_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    layout->addWidget(summary_);

    auto* buttons = new QDialogButtonBox;
    recover_button_ = buttons->addButton(tr("Open Recovered"), QDialogButtonBox::AcceptRole);
    saved_button_ = buttons->addButton(tr("Open Saved File"), QDialogButtonBox::ActionRole);
    auto* remove = buttons->addButton(tr("Delete Recovered"), QDialogButtonBox::DestructiveRole);
    auto* later = buttons->addButton(after_crash ? tr("Later") : tr("Close"), QDialogButtonBox::RejectRole);
    recover_button_->setObjectName(QStringLiteral("recover"));
    saved_button_->setObjectName(QStringLiteral("open_saved"));
    remove->setObjectName(QStringLiteral("delete_recovered"));
    recover_button_->setDefault(true);
    layout->addWidget(buttons);
    connect(recover_button_, &QPushButton::clicked, this, [this] {
        const RecoveredFile file = files_[std::size_t(shown_)];
        accept();
        Q_EMIT recover(file);
    });
    connect(saved_button_, &QPushButton::clicked, this, [this] {
        const QString path = files_[std::size_t(shown_)].original;
        accept();
        Q_EMIT open_saved(path);
    });
    connect(remove, &QPushButton::clicked, this, &RecoveryDialog::remove_shown);
    connect(later, &QPushButton::clicked, this, &QDialog::reject);
    connect(choice_, &QComboBox::currentIndexChanged, this, [this](int index) {
        if (index >= 0) {
            show_file(index);
        }
    });
    show_file(0);
}

void RecoveryDialog::remove_shown() {
    Recovery::discard(files_[std::size_t(shown_)]);
    files_.erase(files_.begin() + shown_);
    if (files_.empty()) {
        reject();
        return;
    }
    choice_->removeItem(shown_);
    show_file(std::max(0, choice_->currentIndex()));
}

void RecoveryDialog::show_file(int index) {
    shown_ = index;
    drawn_ = false;
    const RecoveredFile& file = files_[std::size_t(index)];
    const QFileInfo original(file.original);
    const bool has_saved = !file.original.isEmpty() && original.exists();
    saved_caption_->setText(has_saved ? tr("Saved: %1\n%2").arg(date_text(original.lastModified()), file.original)
                            : file.original.isEmpty() ? tr("Saved: never")
                                                      : tr("Saved: the file is gone\n%1").arg(file.original));
    recovered_caption_->setText(tr("Recovered: %1").arg(date_text(file.date)));
    recovered_caption_->setToolTip(file.path);
    for (QLabel* picture : {saved_picture_, recovered_picture_}) {
        picture->setPixmap({});
        picture->setText(tr("Drawing..."));
    }
    if (!has_saved) {
        saved_picture_->setText(tr("There is no saved file."));
    }
    saved_button_->setEnabled(has_saved);
    const bool saved_is_newer = has_saved && original.lastModified() > file.date;
    (saved_is_newer ? saved_button_ : recover_button_)->setDefault(true);
    const QString newer = saved_is_newer ? tr("The saved file is newer than the recovered work.") : QString();
    summary_->setText(newer);
    const int token = ++token_;
    run_in_background(
        this, [file]() -> Result<Compared> { return compare(file); },
        [this, token, newer, has_saved](const Result<Compared>& done) {
            if (token != token_) {
                return;
            }
            const auto show = [](QLabel* label, const QImage& image, const QString& error) {
                if (image.isNull()) {
                    label->setText(error);
                } else {
                    label->setPixmap(QPixmap::fromImage(image));
                }
            };
            if (!done) {
                recovered_picture_->setText(error_message(done.error()));
                return;
            }
            show(recovered_picture_, done->recovered, done->recovered_error);
            if (has_saved) {
                show(saved_picture_, done->saved, done->saved_error);
            }
            QStringList lines;
            if (!newer.isEmpty()) {
                lines += newer;
            }
            if (done->comparable) {
                const SceneDifference& d = done->difference;
                if (!d.any()) {
                    lines += tr("Both hold the same objects in the same places.");
                }
                if (!d.changed.isEmpty()) {
                    lines += tr("Changed in the recovered work: %1").arg(names(d.changed));
                }
                if (!d.added.isEmpty()) {
                    lines += tr("Only in the recovered work: %1").arg(names(d.added));
                }
                if (!d.removed.isEmpty()) {
                    lines += tr("Only in the saved file: %1").arg(names(d.removed));
                }
            }
            summary_->setText(lines.join(QLatin1Char('\n')));
            drawn_ = true;
        });
}

} // namespace atrium::ui
