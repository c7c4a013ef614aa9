#include "ui/window/file_controller.h"

#include "engine/io/relink.h"
#include "engine/io/scene_file.h"
#include "ui/document/background.h"
#include "ui/document/engine_text.h"
#include "ui/document/insert_commands.h"
#include "ui/document/sample_room.h"
#include "ui/window/file_names.h"
#include "ui/window/settings.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>

namespace atrium::ui {

namespace {

struct Opened {
    Scene scene;
    std::vector<Problem> problems;
    std::shared_ptr<const Solution> solution;
    ImportSuggestion suggestion;
    FileStamp stamp;      ///< of the file, taken before it was read
    Error damage;         ///< why it could not be read as it is
    bool rescued = false; ///< what the damaged file still held
};

/// Any thread. A damaged file gives what it still holds, if that is anything.
Result<Opened> read_file(const QString& path) {
    Opened out;
    out.stamp = FileStamp::of(path);
    auto loaded = read_scene(to_path(path));
    if (!loaded) {
        auto rescued = read_scene(to_path(path), {.salvage = true});
        if (!rescued || rescued->scene.nodes.empty()) {
            return tl::unexpected<Error>(loaded.error());
        }
        out.damage = loaded.error();
        out.rescued = true;
        loaded = std::move(rescued);
    }
    if (!loaded->solution.empty()) {
        auto solution = decode_solution(loaded->solution, loaded->scene);
        if (solution) {
            out.solution = std::move(*solution);
        } else {
            Problem problem;
            problem.severity = Problem::Severity::Note;
            problem.where = QFileInfo(path).fileName().toStdString();
            problem.what = FileController::tr("the stored light could not be used: %1")
                               .arg(error_message(solution.error()))
                               .toStdString();
            loaded->problems.push_back(std::move(problem));
        }
    }
    if (!is_project(path)) {
        out.suggestion = suggest_import_fix(loaded->scene);
    }
    out.scene = std::move(loaded->scene);
    out.problems = std::move(loaded->problems);
    return out;
}

QString open_filter() {
    return FileController::tr(
        "Scenes (*.atrium *.gltf *.glb);;Atrium projects (*.atrium);;glTF (*.gltf *.glb);;All files (*)");
}

} // namespace

FileController::FileController(Document& document, EngineLink& engine, Recovery& recovery, QWidget* window)
    : QObject(window), document_(document), engine_(engine), recovery_(recovery), window_(window) {}

void FileController::report_busy() { Q_EMIT busy_changed(busy() ? busy_text_ : QString(), loading_); }

QString FileController::error_text(const Error& error) {
    QString text = engine_text(error.what);
    if (!text.isEmpty()) {
        text[0] = text[0].toUpper();
    }
    QStringList lines;
    if (!error.file.empty()) {
        lines += tr("File: %1").arg(QString::fromStdString(error.file));
    }
    if (!error.where.empty()) {
        lines += tr("Place: %1").arg(QString::fromStdString(error.where));
    }
    lines += text;
    if (!error.hint.empty()) {
        lines += engine_text(error.hint);
    }
    return lines.join(QLatin1Char('\n'));
}

QMessageBox* FileController::make_box(QMessageBox::Icon icon, const char* name, const QString& title, const QString& text,
                                      const QString& more) {
    auto* box = new QMessageBox(icon, title, text, QMessageBox::NoButton, window_);
    box->setObjectName(QLatin1StringView(name));
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setTextFormat(Qt::PlainText);
    box->setInformativeText(more);
    return box;
}

void FileController::show_error(const QString& title, const Error& error) {
    auto* box = make_box(QMessageBox::Warning, "error", title, title, error_text(error));
    box->addButton(QMessageBox::Ok);
    box->open();
}

QString FileController::document_name() const {
    return document_.path().isEmpty() ? tr("Untitled") : QFileInfo(document_.path()).fileName();
}

void FileController::replace(Scene scene, const QString& path, std::vector<Problem> problems, const FileHold& hold) {
    recovered_.reset(); // what was not saved of it is offered again
    hold_ = hold;
    document_.reset(std::move(scene), path, std::move(problems));
    Q_EMIT read_only_changed();
}

void FileController::new_scene() {
    when_saved([this] {
        replace({}, {}, {}, {});
        engine_.load(nullptr);
        Q_EMIT opened();
    });
}

void FileController::open_sample() {
    when_saved([this] {
        replace(sample_room(), {}, {}, {});
        engine_.load(nullptr);
        Q_EMIT opened();
    });
}

void FileController::ask_and_open() {
    when_saved([this] {
        auto* dialog = new QFileDialog(window_, tr("Open"), Settings().last_folder(), open_filter());
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->setFileMode(QFileDialog::ExistingFile);
        connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) { start_open({path}); });
        dialog->open();
    });
}

void FileController::open(const QString& path) {
    when_saved([this, path] { start_open({path}); });
}

void FileController::ask_about_lock(const OpenRequest& request, const QString& holder) {
    const QString name = QFileInfo(request.saved_to()).fileName();
    auto* box = make_box(QMessageBox::Question, "project_locked", tr("Open elsewhere"),
                         tr("%1 is open in another Atrium.").arg(name),
                         tr("It is held by %1. If both save, the one that saves last is asked what to do.").arg(holder));
    auto* look = box->addButton(tr("Open Read-Only"), QMessageBox::AcceptRole);
    auto* anyway = box->addButton(tr("Open Anyway"), QMessageBox::ActionRole);
    box->setEscapeButton(box->addButton(QMessageBox::Cancel));
    box->setDefaultButton(look);
    connect(box, &QMessageBox::finished, this, [this, box, look, anyway, request] {
        OpenRequest next = request;
        next.read_only = box->clickedButton() == look;
        next.ignore_lock = box->clickedButton() == anyway;
        if (next.read_only || next.ignore_lock) {
            start_open(std::move(next));
        }
    });
    box->open();
}

void FileController::start_open(OpenRequest request) {
    const QString path = request.path;
    FileHold hold;
    hold.read_only = request.read_only;
    if (is_project(request.saved_to()) && !request.read_only) {
        const QString project = QFileInfo(request.saved_to()).absoluteFilePath();
        hold.lock = hold_.lock && hold_.lock->project() == project ? hold_.lock : std::make_shared<ProjectLock>(project);
        if (hold.lock->taken() && !request.ignore_lock) {
            ask_about_lock(request, hold.lock->holder());
            return;
        }
    }
    const std::uint64_t token = ++load_token_;
    loading_ = true;
    busy_text_ = tr("Opening %1").arg(QFileInfo(path).fileName());
    report_busy();
    run_in_background(
        this, [path] { return read_file(path); },
        [this, token, hold, request](Result<Opened> result) {
            if (token != load_token_) {
                return; // cancelled, or something else was opened since
            }
            loading_ = false;
            report_busy();
            const QString shown = QFileInfo(request.path).fileName();
            if (!result) {
                Settings settings;
                if (!QFileInfo::exists(request.path)) {
                    settings.remove_recent(request.path);
                    Q_EMIT recent_changed();
                }
                show_error(tr("%1 could not be opened").arg(shown), result.error());
                Q_EMIT open_failed(error_message(result.error()));
                return;
            }
            const auto opened = std::make_shared<Opened>(std::move(*result));
            const auto show = [this, opened, held = hold, request] {
                FileHold now = held;
                now.stamp = opened->stamp;
                now.read_only = held.read_only || opened->rescued; // the damaged file may hold more than we could read
                replace(std::move(opened->scene), QFileInfo(request.path).absoluteFilePath(), std::move(opened->problems),
                        now);
                engine_.load(std::move(opened->solution));
                engine_.prepare(); // the first drag is to be followed as it was before saving
                if (request.then) {
                    request.then();
                } else {
                    Settings().add_recent(request.path);
                    Q_EMIT recent_changed();
                }
                if (opened->rescued) {
                    document_.undo_stack()->resetClean();
                }
                Q_EMIT this->opened();
                if (opened->suggestion.any()) {
                    Q_EMIT import_suggested(opened->suggestion);
                }
                if (const auto missing = missing_textures(document_.scene()).size(); missing > 0) {
                    Q_EMIT textures_missing(int(missing));
                }
            };
            if (!opened->rescued) {
                show();
                return;
            }
            auto* box = make_box(QMessageBox::Warning, "damaged_file", tr("Damaged file"), tr("%1 is damaged.").arg(shown),
                                 error_text(opened->damage) + QLatin1Char('\n') +
                                     tr("%n object(s) can be saved from it. The file itself is left as it is.", nullptr,
                                        int(opened->scene.nodes.size())));
            auto* rescue = box->addButton(tr("Open What Is Left"), QMessageBox::AcceptRole);
            box->setEscapeButton(box->addButton(QMessageBox::Cancel));
            box->setDefaultButton(rescue);
            connect(box, &QMessageBox::finished, this, [this, box, rescue, show, why = error_message(opened->damage)] {
                if (box->clickedButton() == rescue) {
                    show();
                } else {
                    Q_EMIT open_failed(why);
                }
            });
            box->open();
        });
}

void FileController::cancel_loading() {
    ++load_token_;
    loading_ = false;
    report_busy();
    Q_EMIT message(tr("Opening was cancelled."));
}

void FileController::ask_and_import() {
    auto* dialog = new QFileDialog(window_, tr("Import"), Settings().last_folder(), open_filter());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, this, &FileController::import);
    dialog->open();
}

void FileController::import(const QString& path) {
    recovery_.write(); // as it is before
    const std::uint64_t token = ++load_token_;
    loading_ = true;
    busy_text_ = tr("Importing %1").arg(QFileInfo(path).fileName());
    report_busy();
    run_in_background(
        this, [path] { return read_file(path); },
        [this, token, path](Result<Opened> result) {
            if (token != load_token_) {
                return;
            }
            loading_ = false;
            report_busy();
            const QFileInfo info(path);
            if (!result) {
                show_error(tr("%1 could not be imported").arg(info.fileName()), result.error());
                return;
            }
            if (result->rescued) {
                show_error(tr("%1 could not be imported").arg(info.fileName()), result->damage);
                return;
            }
            Settings().set_last_folder(info.absolutePath());
            const Command command = merge_scene(document_.scene(), result->scene, info.completeBaseName().toStdString());
            const auto done = document_.apply(command.edit, tr("Import %1").arg(info.fileName()));
            if (!done) {
                show_error(tr("%1 could not be imported").arg(info.fileName()), done.error());
                return;
            }
            document_.selection()->set(command.select);
            Q_EMIT message(tr("Imported %1 objects.").arg(result->scene.nodes.size()));
        });
}

void FileController::ask_and_find_textures() {
    if (missing_textures(document_.scene()).empty()) {
        Q_EMIT message(tr("No image of this scene is missing."));
        return;
    }
    auto* dialog = new QFileDialog(window_, tr("Folder with the Images"), Settings().last_folder());
    dialog->setFileMode(QFileDialog::Directory);
    dialog->setOption(QFileDialog::ShowDirsOnly);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, &FileController::find_textures);
    dialog->open();
}

void FileController::find_textures(const QString& folder) {
    busy_text_ = tr("Looking for images");
    searching_ = true;
    report_busy();
    using Found = std::vector<std::pair<TextureId, Texture>>;
    run_in_background(
        this,
        [scene = document_.scene(), folder]() -> Result<Found> {
            return find_missing_textures(scene, to_path(folder), RunContext{});
        },
        [this](const Result<Found>& found) {
            searching_ = false;
            report_busy();
            if (!found) {
                show_error(tr("The images could not be looked for"), found.error());
                return;
            }
            EditGroup edits;
            for (const auto& [id, texture] : *found) {
                if (document_.scene().textures.contains(id)) {
                    edits.edits.push_back({SetResource<Texture>{id, texture}});
                }
            }
            const int count = int(edits.edits.size());
            if (count > 0) {
                if (const auto done = document_.apply({std::move(edits)}, tr("Find Missing Images")); !done) {
                    show_error(tr("The images could not be used"), done.error());
                    return;
                }
            }
            const int left = int(missing_textures(document_.scene()).size());
            Q_EMIT textures_missing(left);
            Q_EMIT message(left == 0 ? tr("%n image(s) found; none is missing.", nullptr, count)
                                     : tr("%n image(s) found.", nullptr, count) + QLatin1Char(' ') +
                                           tr("%n image(s) still missing.", nullptr, left));
        });
}

} // namespace atrium::ui
