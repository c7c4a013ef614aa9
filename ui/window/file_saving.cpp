// FileController: saving, exporting, and what stands in the way of it.
#include "engine/io/scene_file.h"
#include "ui/document/background.h"
#include "ui/window/file_controller.h"
#include "ui/window/file_names.h"
#include "ui/window/settings.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QLocale>
#include <QMessageBox>
#include <QPushButton>

namespace atrium::ui {

void FileController::save(std::function<void(bool)> then) {
    if (is_project(document_.path()) && !hold_.read_only) {
        write(document_.path(), Writing::Document, std::move(then));
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
    QString base = document_.path().isEmpty() ? tr("Untitled") : present.completeBaseName();
    if (hold_.read_only) {
        base = tr("%1 copy", "suggested file name").arg(base);
    }
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
                     save_to(is_project(path) ? path : path + QStringLiteral(".atrium"), then);
                 });
}

void FileController::save_to(const QString& path, std::function<void(bool)> then) {
    write(path, Writing::Document, std::move(then));
}

void FileController::ask_and_export_gltf() {
    const QFileInfo present(document_.path());
    const QString base = document_.path().isEmpty() ? tr("Untitled") : present.completeBaseName();
    ask_for_path(tr("Export glTF"), Settings().last_folder() + QLatin1Char('/') + base + QStringLiteral(".glb"),
                 tr("glTF binary (*.glb);;glTF (*.gltf)"), QStringLiteral("glb"), [this](const QString& path) {
                     if (!path.isEmpty()) {
                         write(path, Writing::Export, {});
                     }
                 });
}

void FileController::ask_about_change(const QString& path, std::function<void(bool)> then) {
    const QFileInfo info(path);
    auto* box = make_box(QMessageBox::Warning, "file_changed", tr("Changed by another program"),
                         tr("%1 has been changed since it was opened here.").arg(info.fileName()),
                         tr("It was written on %1. Overwriting it loses what was changed there.")
                             .arg(QLocale().toString(info.lastModified(), QLocale::ShortFormat)));
    auto* other = box->addButton(tr("Save Under Another Name..."), QMessageBox::AcceptRole);
    auto* overwrite = box->addButton(tr("Overwrite"), QMessageBox::DestructiveRole);
    box->setEscapeButton(box->addButton(QMessageBox::Cancel));
    box->setDefaultButton(other);
    connect(box, &QMessageBox::finished, this, [this, box, other, overwrite, path, then = std::move(then)] {
        if (box->clickedButton() == other) {
            save_as(then);
        } else if (box->clickedButton() == overwrite) {
            write(path, Writing::Overwrite, then);
        } else if (then) {
            then(false);
        }
    });
    box->open();
}

void FileController::ask_after_failure(const QString& path, const Error& error, std::function<void(bool)> then) {
    const QString name = QFileInfo(path).fileName();
    recovery_.write(); // wherever it fails too, that is told as well
    auto* box = make_box(QMessageBox::Warning, "save_failed", tr("%1 could not be saved").arg(name),
                         tr("%1 could not be saved").arg(name),
                         error_text(error) + QLatin1Char('\n') + tr("Your changes are still here."));
    auto* other = box->addButton(tr("Save Under Another Name..."), QMessageBox::AcceptRole);
    auto* again = box->addButton(tr("Try Again"), QMessageBox::ActionRole);
    box->setEscapeButton(box->addButton(QMessageBox::Cancel));
    box->setDefaultButton(other);
    connect(box, &QMessageBox::finished, this, [this, box, other, again, path, then = std::move(then)] {
        if (box->clickedButton() == other) {
            save_as(then);
        } else if (box->clickedButton() == again) {
            write(path, Writing::Document, then);
        } else if (then) {
            then(false);
        }
    });
    box->open();
}

void FileController::write(const QString& path, Writing writing, std::function<void(bool)> then) {
    if (saving_) {
        Q_EMIT message(tr("Still saving; try again in a moment."));
        if (then) {
            then(false);
        }
        return;
    }
    const bool as_document = writing != Writing::Export;
    const QString absolute = QFileInfo(path).absoluteFilePath();
    const bool same = absolute == document_.path();
    std::shared_ptr<ProjectLock> lock = same ? hold_.lock : nullptr;
    if (as_document && !same) {
        lock = std::make_shared<ProjectLock>(absolute);
        if (lock->taken() && writing != Writing::Overwrite) {
            Error error;
            error.file = absolute.toStdString();
            error.what = tr("it is open in another Atrium (%1)").arg(lock->holder()).toStdString();
            ask_after_failure(path, error, std::move(then));
            return;
        }
    }
    saving_ = true;
    busy_text_ = tr("Saving %1").arg(QFileInfo(path).fileName());
    report_busy();
    const std::shared_ptr<const Solution> light =
        as_document && is_project(path) && !engine_.stale() ? engine_.solution() : nullptr;
    struct Written {
        FileStamp stamp;
        bool changed = false; ///< by somebody else: nothing was written
        bool was_gone = false;
    };
    run_in_background(
        this,
        [scene = document_.scene(), path, light, known = hold_.stamp,
         check = as_document && same && writing == Writing::Document && hold_.stamp.exists]() -> Result<Written> {
            Written out;
            if (check) {
                const FileStamp now = FileStamp::of(path);
                out.was_gone = !now.exists;
                out.changed = now.exists && now != known;
                if (out.changed) {
                    return out;
                }
            }
            WriteOptions options;
            if (light) {
                options.solution = encode_solution(*light, scene);
            }
            if (auto done = write_scene(to_path(path), scene, options); !done) {
                return tl::unexpected<Error>(done.error());
            }
            out.stamp = FileStamp::of(path);
            return out;
        },
        [this, path, absolute, as_document, lock, revision = document_.revision(),
         then = std::move(then)](const Result<Written>& done) mutable {
            saving_ = false;
            report_busy();
            const QString name = QFileInfo(path).fileName();
            if (!done && as_document) {
                ask_after_failure(path, done.error(), std::move(then));
                return;
            }
            if (!done) {
                show_error(tr("%1 could not be saved").arg(name), done.error());
            } else if (done->changed) {
                ask_about_change(path, std::move(then));
                return;
            } else if (as_document) {
                hold_ = {std::move(lock), done->stamp, false};
                document_.set_path(absolute);
                Q_EMIT read_only_changed();
                if (document_.revision() == revision) {
                    recovery_.clear();
                } else {
                    document_.undo_stack()->resetClean(); // edited while the file was written
                }
                if (recovered_) {
                    Recovery::discard(*recovered_);
                    recovered_.reset();
                }
                Settings().add_recent(path);
                Q_EMIT recent_changed();
                Q_EMIT saved();
                Q_EMIT message(done->was_gone ? tr("%1 was gone and has been written again.").arg(name)
                                              : tr("Saved %1.").arg(name));
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
    recovery_.write(); // whatever happens while the question stands
    auto* box = make_box(QMessageBox::Warning, "save_changes", tr("Unsaved changes"),
                         tr("Save the changes to %1?").arg(document_name()),
                         tr("What is discarded can be had back for two weeks: File > Recovered Work."));
    box->setStandardButtons(QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel);
    box->setDefaultButton(QMessageBox::Save);
    connect(box, &QMessageBox::finished, this, [this, proceed = std::move(proceed)](int button) {
        if (button == QMessageBox::Discard) {
            recovery_.keep(RecoveredFile::Reason::Discarded, [this, proceed](bool kept) {
                if (kept && recovered_) {
                    Recovery::discard(*recovered_); // it is among what was given up now
                    recovered_.reset();
                }
                document_.undo_stack()->setClean(); // not asked twice on the way out
                recovery_.clear();
                proceed();
            });
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

} // namespace atrium::ui
