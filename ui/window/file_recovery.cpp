// FileController: work that was not saved, and going back to what was.
#include "ui/window/file_controller.h"
#include "ui/window/file_names.h"
#include "ui/window/recovery_dialog.h"

#include <QFileInfo>
#include <QLocale>
#include <QMessageBox>
#include <QPushButton>

namespace atrium::ui {

void FileController::offer_recovery() {
    if (std::vector<RecoveredFile> files = recovery_.orphans(); !files.empty()) {
        show_recovery(std::move(files), true);
    }
}

void FileController::show_recovered() {
    std::vector<RecoveredFile> files = recovery_.orphans();
    for (RecoveredFile& file : recovery_.kept()) {
        files.push_back(std::move(file));
    }
    if (files.empty()) {
        Q_EMIT message(tr("There is no recovered work."));
        return;
    }
    show_recovery(std::move(files), false);
}

void FileController::show_recovery(std::vector<RecoveredFile> files, bool after_crash) {
    auto* dialog = new RecoveryDialog(std::move(files), after_crash, window_);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &RecoveryDialog::recover, this,
            [this](const RecoveredFile& file) { when_saved([this, file] { open_recovered(file); }); });
    connect(dialog, &RecoveryDialog::open_saved, this, [this](const QString& path) { open(path); });
    dialog->open();
}

void FileController::open_recovered(const RecoveredFile& file) {
    OpenRequest request{file.path};
    request.original = file.original;
    request.then = [this, file] {
        // It takes the place of the document that it came from, and is unsaved. The recovered file goes when that is saved.
        hold_.stamp = {};
        if (is_project(file.original)) {
            // Whoever wrote the file after the recovered state was made has changed what it was made from.
            const FileStamp now = FileStamp::of(file.original);
            const bool newer = now.exists && now.modified_ns / 1000000 > file.date.toMSecsSinceEpoch();
            hold_.stamp = now;
            hold_.stamp.size = newer ? -1 : now.size; // differs from what is there: saving asks
        }
        document_.set_path(file.original);
        document_.undo_stack()->resetClean();
        recovered_ = file;
    };
    start_open(std::move(request));
}

void FileController::revert() {
    const QString path = document_.path();
    if (path.isEmpty() || !QFileInfo::exists(path)) {
        Q_EMIT message(tr("There is no saved file to go back to."));
        return;
    }
    if (document_.undo_stack()->isClean()) {
        start_open({path});
        return;
    }
    auto* box =
        make_box(QMessageBox::Question, "revert", tr("Revert"), tr("Go back to %1 as it was saved?").arg(document_name()),
                 tr("It was saved on %1. What was changed since can be had back for two weeks: File > Recovered Work.")
                     .arg(QLocale().toString(QFileInfo(path).lastModified(), QLocale::ShortFormat)));
    auto* go = box->addButton(tr("Revert"), QMessageBox::AcceptRole);
    box->setEscapeButton(box->addButton(QMessageBox::Cancel));
    box->setDefaultButton(go);
    recovery_.write();
    connect(box, &QMessageBox::finished, this, [this, box, go, path] {
        if (box->clickedButton() != go) {
            return;
        }
        recovery_.keep(RecoveredFile::Reason::Reverted, [this, path](bool kept) {
            if (kept) {
                start_open({path});
                return;
            }
            Error error;
            error.what = tr("what would be lost could not be put aside first").toStdString();
            error.hint = tr("Save the scene under another name, then open the file again.").toStdString();
            show_error(tr("Nothing was reverted"), error);
        });
    });
    box->open();
}

} // namespace atrium::ui
