// The window's wiring of files: commands, recent files, closing, what is dropped onto it, pictures.
#include "engine/solver/memory_budget.h"
#include "ui/actions/actions.h"
#include "ui/actions/edit_controller.h"
#include "ui/viewport/viewport_widget.h"
#include "ui/window/export_picture_dialog.h"
#include "ui/window/file_controller.h"
#include "ui/window/import_bar.h"
#include "ui/window/main_window.h"
#include "ui/window/notice_bar.h"
#include "ui/window/photometry_controller.h"
#include "ui/window/preferences_dialog.h"
#include "ui/window/settings.h"
#include "ui/window/start_page.h"

#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QMimeData>
#include <QProgressBar>
#include <QPushButton>
#include <QToolButton>

namespace atrium::ui {
namespace {

constexpr int kAutosaveEdits = 20; // undo entries, whatever the time

QString dropped_file(const QMimeData* data, std::initializer_list<const char*> suffixes) {
    for (const QUrl& url : data->urls()) {
        const QString path = url.toLocalFile();
        for (const char* suffix : suffixes) {
            if (path.endsWith(QLatin1StringView(suffix), Qt::CaseInsensitive)) {
                return path;
            }
        }
    }
    return {};
}

QString dropped_scene(const QMimeData* data) { return dropped_file(data, {".gltf", ".glb", ".atrium"}); }
QString dropped_photometry(const QMimeData* data) { return dropped_file(data, {".ies", ".ldt"}); }

// Other memory is for the light that comes next; light that had too little is made anew with more.
void take_memory_budget(EngineLink& engine) {
    const std::size_t before = memory_budget();
    set_memory_budget(std::size_t(Settings().memory_mib()) << 20U);
    const auto solution = engine.solution();
    if (memory_budget() > before && solution && !lowered_by_memory(solution->statistics.features).empty()) {
        engine.load(nullptr);
    }
}

} // namespace

void MainWindow::connect_files() {
    on(ActionId::New, [this] { files_->new_scene(); });
    on(ActionId::Open, [this] { files_->ask_and_open(); });
    on(ActionId::Import, [this] { files_->ask_and_import(); });
    on(ActionId::Save, [this] { files_->save(); });
    on(ActionId::SaveAs, [this] { files_->save_as(); });
    on(ActionId::Revert, [this] { files_->revert(); });
    on(ActionId::RecoveredWork, [this] { files_->show_recovered(); });
    on(ActionId::FindImages, [this] { files_->ask_and_find_textures(); });
    recovery_->set_limits(1000 * Settings().autosave_seconds(), kAutosaveEdits);
    set_memory_budget(std::size_t(Settings().memory_mib()) << 20U);
    on(ActionId::Preferences, [this] {
        auto* dialog = new PreferencesDialog(this);
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        connect(dialog, &PreferencesDialog::stored, this, [this] {
            recovery_->set_limits(1000 * Settings().autosave_seconds(), kAutosaveEdits);
            take_memory_budget(*engine_);
        });
        dialog->open();
    });
    on(ActionId::ExportGltf, [this] { files_->ask_and_export_gltf(); });
    on(ActionId::ExportPicture, [this] { export_picture(); });
    on(ActionId::Quit, [this] { close(); });
    connect(start_, &StartPage::sample_requested, files_, &FileController::open_sample);
    connect(start_, &StartPage::file_requested, files_, &FileController::open);
    connect(files_, &FileController::message, this, &MainWindow::say);
    connect(files_, &FileController::recent_changed, this, &MainWindow::update_recent);
    connect(files_, &FileController::opened, this, [this] {
        started_ = true;
        import_bar_->dismiss();
        update_page();
        viewport_->setFocus();
    });
    connect(files_, &FileController::import_suggested, import_bar_, &ImportBar::offer);
    connect(import_bar_, &ImportBar::accepted, this, [this](const ImportSuggestion& suggestion) {
        edit_->fix_import(suggestion);
        viewport_->frame_all();
    });
    connect(files_, &FileController::busy_changed, this, [this](const QString& what, bool can_cancel) {
        busy_text_->setText(what);
        busy_text_->setVisible(!what.isEmpty());
        busy_bar_->setVisible(!what.isEmpty());
        busy_cancel_->setVisible(can_cancel);
        if (what.isEmpty() && closing_) {
            close(); // asked for while a file was being written
        }
    });
    recovery_->set_view([this] { return viewport_->camera(); });
    connect_notices();
}

void MainWindow::connect_notices() {
    connect(autosave_notice_->add_button(tr("Save &As...")), &QPushButton::clicked, this, [this] { files_->save_as(); });
    connect(autosave_notice_->add_button(tr("Try A&gain")), &QPushButton::clicked, this, [this] {
        autosave_notice_->hide();
        recovery_->write();
    });
    connect(recovery_.get(), &Recovery::failed, this, [this](const QString& why) {
        autosave_notice_->show_text(tr("Autosave failed; what is unsaved is in this window only. %1").arg(why));
    });
    connect(recovery_.get(), &Recovery::written, autosave_notice_, &QWidget::hide);
    connect(files_, &FileController::saved, autosave_notice_, &QWidget::hide);
    connect(&document_, &Document::reset_done, autosave_notice_, &QWidget::hide);

    connect(images_notice_->add_button(tr("&Find...")), &QPushButton::clicked, files_,
            &FileController::ask_and_find_textures);
    connect(&document_, &Document::reset_done, images_notice_, &QWidget::hide);
    connect(files_, &FileController::textures_missing, this, [this](int count) {
        images_notice_->setVisible(count > 0);
        if (count > 0) {
            images_notice_->show_text(
                tr("%n image(s) of this scene were not found; surfaces that use them show their plain colour.", nullptr,
                   count));
        }
    });
}

void MainWindow::update_recent() {
    const QStringList files = Settings().recent_files();
    start_->set_recent(files);
    recent_menu_->clear();
    recent_menu_->setEnabled(!files.isEmpty());
    for (const QString& file : files) {
        QAction* action = recent_menu_->addAction(QFileInfo(file).fileName());
        action->setStatusTip(file);
        connect(action, &QAction::triggered, this, [this, file] { files_->open(file); });
    }
}

void MainWindow::export_picture() {
    const std::shared_ptr<const Solution> solution = engine_->solution();
    if (!solution) {
        say(tr("There is no light to render yet."));
        return;
    }
    const Settings settings;
    const QString base = document_.path().isEmpty() ? tr("Untitled") : QFileInfo(document_.path()).completeBaseName();
    auto* dialog = new ExportPictureDialog(document_.scene(), solution, viewport_->camera(), viewport_->exposure(),
                                           viewport_->light_shares(), viewport_->false_color(),
                                           settings.last_folder() + QLatin1Char('/') + base + QStringLiteral(".png"), this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &ExportPictureDialog::message, this, &MainWindow::say);
    dialog->open();
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (files_->saving()) {
        closing_ = true;
        event->ignore();
        return;
    }
    closing_ = false;
    if (!document_.undo_stack()->isClean()) {
        event->ignore();
        files_->when_saved([this] {
            // Not from inside the message box's own signal: the window goes when that has returned.
            QMetaObject::invokeMethod(this, &QWidget::close, Qt::QueuedConnection);
        });
        return;
    }
    Settings().set_window(saveGeometry(), saveState());
    recovery_->clear(); // nothing is unsaved
    event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (!dropped_scene(event->mimeData()).isEmpty() || !dropped_photometry(event->mimeData()).isEmpty()) {
        event->acceptProposedAction();
    }
}

void MainWindow::dropEvent(QDropEvent* event) {
    if (const QString path = dropped_scene(event->mimeData()); !path.isEmpty()) {
        event->acceptProposedAction();
        files_->open(path);
    } else if (const QString file = dropped_photometry(event->mimeData()); !file.isEmpty()) {
        event->acceptProposedAction();
        drop_photometry(file, event->position());
    }
}

void MainWindow::drop_photometry(const QString& path, const QPointF& position) {
    if (document_.scene().nodes.empty()) {
        photometry_->add(path, lamp_place());
        return;
    }
    const QPointF point = viewport_->mapFrom(this, position);
    if (!viewport_->rect().contains(point.toPoint())) {
        // Onto a panel: meant for what is selected.
        const std::vector<LightId> lamps = photometry_->lamps_of(document_.selection()->active());
        if (!lamps.empty()) {
            photometry_->assign(path, lamps);
        } else {
            say(tr("Drop the file onto a lamp in the view, or where a new lamp is to hang."));
        }
        return;
    }
    const ViewportWidget::DropPlace place = viewport_->drop_place(point);
    const std::vector<LightId> lamps = photometry_->lamps_of(place.node);
    if (lamps.empty()) {
        photometry_->add(path, place.lamp);
    } else {
        photometry_->assign(path, lamps);
    }
}

} // namespace atrium::ui
