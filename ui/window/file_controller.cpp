#include "ui/window/file_controller.h"

#include "engine/io/scene_file.h"
#include "ui/document/background.h"
#include "ui/document/insert_commands.h"
#include "ui/document/sample_room.h"
#include "ui/window/settings.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QLocale>
#include <QMessageBox>
#include <QPushButton>

#include <filesystem>

namespace atrium::ui {

namespace {

struct Opened {
    Scene scene;
    std::vector<Problem> problems;
    std::shared_ptr<const Solution> solution;
    ImportSuggestion suggestion;
};

std::filesystem::path to_path(const QString& path) { return std::filesystem::path(path.toStdU16String()); }

bool is_project(const QString& path) { return path.endsWith(QLatin1StringView(".atrium"), Qt::CaseInsensitive); }

/// Any thread.
Result<Opened> read_file(const QString& path) {
    auto loaded = read_scene(to_path(path));
    if (!loaded) {
        return tl::unexpected<Error>(loaded.error());
    }
    Opened out;
    if (!loaded->solution.empty()) {
        auto solution = decode_solution(loaded->solution, loaded->scene);
        if (solution) {
            out.solution = std::move(*solution);
        } else {
            Problem problem;
            problem.severity = Problem::Severity::Note;
            problem.where = QFileInfo(path).fileName().toStdString();
            problem.what = "the stored light could not be used: " + solution.error().message();
            problem.hint = "It is computed again.";
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

void FileController::show_error(const QString& title, const Error& error) {
    auto* box = new QMessageBox(QMessageBox::Warning, title, QString(), QMessageBox::Ok, window_);
    box->setAttribute(Qt::WA_DeleteOnClose);
    QString text = QString::fromStdString(error.what);
    if (!text.isEmpty()) {
        text[0] = text[0].toUpper();
    }
    box->setText(title);
    QStringList lines;
    if (!error.file.empty()) {
        lines += tr("File: %1").arg(QString::fromStdString(error.file));
    }
    if (!error.where.empty()) {
        lines += tr("Place: %1").arg(QString::fromStdString(error.where));
    }
    lines += text;
    if (!error.hint.empty()) {
        lines += QString::fromStdString(error.hint);
    }
    box->setInformativeText(lines.join(QLatin1Char('\n')));
    box->setTextFormat(Qt::PlainText);
    box->open();
}

void FileController::new_scene() {
    when_saved([this] {
        Scene empty;
        document_.reset(std::move(empty), {}, {});
        engine_.load(nullptr);
        Q_EMIT opened();
    });
}

void FileController::open_sample() {
    when_saved([this] {
        document_.reset(sample_room(), {}, {});
        engine_.load(nullptr);
        Q_EMIT opened();
    });
}

void FileController::ask_and_open() {
    when_saved([this] {
        auto* dialog = new QFileDialog(window_, tr("Open"), Settings().last_folder(), open_filter());
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->setFileMode(QFileDialog::ExistingFile);
        connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) { start_open(path, {}); });
        dialog->open();
    });
}

void FileController::open(const QString& path) {
    when_saved([this, path] { start_open(path, {}); });
}

void FileController::start_open(const QString& path, std::function<void()> then) {
    const std::uint64_t token = ++load_token_;
    loading_ = true;
    busy_text_ = tr("Opening %1").arg(QFileInfo(path).fileName());
    report_busy();
    run_in_background(
        this, [path] { return read_file(path); },
        [this, token, path, then = std::move(then)](Result<Opened> result) {
            if (token != load_token_) {
                return; // cancelled, or something else was opened since
            }
            loading_ = false;
            report_busy();
            if (!result) {
                Settings settings;
                if (!QFileInfo::exists(path)) {
                    settings.remove_recent(path);
                    Q_EMIT recent_changed();
                }
                show_error(tr("%1 could not be opened").arg(QFileInfo(path).fileName()), result.error());
                Q_EMIT open_failed(QString::fromStdString(result.error().message()));
                return;
            }
            document_.reset(std::move(result->scene), QFileInfo(path).absoluteFilePath(), std::move(result->problems));
            engine_.load(std::move(result->solution));
            if (then) {
                then();
            } else {
                Settings().add_recent(path);
                Q_EMIT recent_changed();
            }
            Q_EMIT opened();
            if (result->suggestion.any()) {
                Q_EMIT import_suggested(result->suggestion);
            }
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

void FileController::save(std::function<void(bool)> then) {
    if (is_project(document_.path())) {
        write(document_.path(), true, std::move(then));
    } else {
        save_as(std::move(then));
    }
}

void FileController::ask_for_path(const QString& title, const QString& suggestion, const QString& filter,
                                  const QString& suffix, std::function<void(const QString&)> then) {
    auto* dialog = new QFileDialog(window_, title, suggestion, filter);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setFileMode(QFileDialog::AnyFile);
    dialog->setDefaultSuffix(suffix);
    dialog->selectFile(QFileInfo(suggestion).fileName());
    connect(dialog, &QFileDialog::finished, this, [dialog, then = std::move(then)](int result) {
        then(result == QDialog::Accepted && !dialog->selectedFiles().isEmpty() ? dialog->selectedFiles().constFirst()
                                                                               : QString());
    });
    dialog->open();
}

void FileController::save_as(std::function<void(bool)> then) {
    const QFileInfo present(document_.path());
    const QString base = document_.path().isEmpty() ? tr("Untitled") : present.completeBaseName();
    const QString folder = document_.path().isEmpty() ? Settings().last_folder() : present.absolutePath();
    ask_for_path(tr("Save Project"), folder + QLatin1Char('/') + base + QStringLiteral(".atrium"),
                 tr("Atrium projects (*.atrium)"), QStringLiteral("atrium"),
                 [this, then = std::move(then)](const QString& path) {
                     if (path.isEmpty()) {
                         if (then) {
                             then(false);
                         }
                         return;
                     }
                     write(is_project(path) ? path : path + QStringLiteral(".atrium"), true, then);
                 });
}

void FileController::save_to(const QString& path, std::function<void(bool)> then) { write(path, true, std::move(then)); }

void FileController::ask_and_export_gltf() {
    const QFileInfo present(document_.path());
    const QString base = document_.path().isEmpty() ? tr("Untitled") : present.completeBaseName();
    ask_for_path(tr("Export glTF"), Settings().last_folder() + QLatin1Char('/') + base + QStringLiteral(".glb"),
                 tr("glTF binary (*.glb);;glTF (*.gltf)"), QStringLiteral("glb"), [this](const QString& path) {
                     if (!path.isEmpty()) {
                         write(path, false, {});
                     }
                 });
}

void FileController::write(const QString& path, bool as_document, std::function<void(bool)> then) {
    if (saving_) {
        Q_EMIT message(tr("Still saving; try again in a moment."));
        if (then) {
            then(false);
        }
        return;
    }
    saving_ = true;
    busy_text_ = tr("Saving %1").arg(QFileInfo(path).fileName());
    report_busy();
    const std::shared_ptr<const Solution> light =
        as_document && is_project(path) && !engine_.stale() ? engine_.solution() : nullptr;
    run_in_background(
        this,
        [scene = document_.scene(), path, light]() -> Result<bool> {
            WriteOptions options;
            if (light) {
                options.solution = encode_solution(*light, scene);
            }
            if (auto done = write_scene(to_path(path), scene, options); !done) {
                return tl::unexpected<Error>(done.error());
            }
            return true;
        },
        [this, path, as_document, revision = document_.revision(), then = std::move(then)](const Result<bool>& done) {
            saving_ = false;
            report_busy();
            const QString name = QFileInfo(path).fileName();
            if (!done) {
                show_error(tr("%1 could not be saved").arg(name), done.error());
            } else if (as_document) {
                document_.set_path(QFileInfo(path).absoluteFilePath());
                if (document_.revision() == revision) {
                    recovery_.clear();
                } else {
                    document_.undo_stack()->resetClean(); // edited while the file was written
                }
                Settings().add_recent(path);
                Q_EMIT recent_changed();
                Q_EMIT message(tr("Saved %1.").arg(name));
            } else {
                Q_EMIT message(tr("Exported %1.").arg(name));
            }
            if (then) {
                then(bool(done) && document_.undo_stack()->isClean());
            }
        });
}

void FileController::when_saved(std::function<void()> proceed) {
    if (document_.undo_stack()->isClean()) {
        proceed();
        return;
    }
    auto* box = new QMessageBox(QMessageBox::Warning, tr("Unsaved changes"), QString(),
                                QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, window_);
    box->setObjectName(QStringLiteral("save_changes"));
    box->setAttribute(Qt::WA_DeleteOnClose);
    const QString name = document_.path().isEmpty() ? tr("Untitled") : QFileInfo(document_.path()).fileName();
    box->setText(tr("Save the changes to %1?").arg(name));
    box->setInformativeText(tr("What is not saved is lost."));
    box->setDefaultButton(QMessageBox::Save);
    connect(box, &QMessageBox::finished, this, [this, proceed = std::move(proceed)](int button) {
        if (button == QMessageBox::Discard) {
            document_.undo_stack()->setClean(); // not asked twice on the way out
            recovery_.clear();
            proceed();
        } else if (button == QMessageBox::Save) {
            save([proceed](bool saved) {
                if (saved) {
                    proceed();
                }
            });
        }
    });
    box->open();
}

void FileController::offer_recovery() {
    const std::vector<RecoveredFile> files = recovery_.orphans();
    if (files.empty()) {
        return;
    }
    const RecoveredFile file = files.front();
    auto* box = new QMessageBox(QMessageBox::Question, tr("Recovered work"), QString(), QMessageBox::NoButton, window_);
    box->setObjectName(QStringLiteral("recovery"));
    box->setAttribute(Qt::WA_DeleteOnClose);
    const QLocale locale;
    const QFileInfo original(file.original);
    box->setText(tr("Atrium did not end properly. Unsaved work from %1 was kept.")
                     .arg(locale.toString(file.date, QLocale::ShortFormat)));
    QStringList lines;
    lines += file.original.isEmpty() ? tr("It was never saved under a name.") : tr("It belongs to %1.").arg(file.original);
    if (!file.original.isEmpty() && original.exists()) {
        lines += tr("That file was last saved on %1 and is not touched.")
                     .arg(locale.toString(original.lastModified(), QLocale::ShortFormat));
    }
    lines += tr("Recovered file: %1").arg(file.path);
    if (files.size() > 1) {
        lines += tr("%n older recovered file(s) will be offered next time.", nullptr, int(files.size()) - 1);
    }
    box->setInformativeText(lines.join(QLatin1Char('\n')));
    auto* recover = box->addButton(tr("Open Recovered"), QMessageBox::AcceptRole);
    QPushButton* saved = nullptr;
    if (!file.original.isEmpty() && original.exists()) {
        saved = box->addButton(tr("Open Saved File"), QMessageBox::ActionRole);
    }
    auto* discard = box->addButton(tr("Delete Recovered"), QMessageBox::DestructiveRole);
    auto* later = box->addButton(tr("Later"), QMessageBox::RejectRole);
    box->setDefaultButton(recover);
    box->setEscapeButton(later);
    connect(box, &QMessageBox::finished, this, [this, box, recover, saved, discard, file] {
        if (box->clickedButton() == recover) {
            open_recovered(file);
        } else if (saved != nullptr && box->clickedButton() == saved) {
            open(file.original);
        } else if (box->clickedButton() == discard) {
            Recovery::discard(file);
        }
    });
    box->open();
}

void FileController::open_recovered(const RecoveredFile& file) {
    start_open(file.path, [this, file] {
        // It takes the place of the document that it came from, and is unsaved. The recovered file goes when that is saved.
        document_.set_path(file.original);
        document_.undo_stack()->resetClean();
        auto* done = new QObject(this);
        connect(document_.undo_stack(), &QUndoStack::cleanChanged, done, [file, done](bool clean) {
            if (clean) {
                Recovery::discard(file);
                done->deleteLater();
            }
        });
    });
}

} // namespace atrium::ui
