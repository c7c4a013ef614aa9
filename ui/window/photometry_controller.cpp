#include "ui/window/photometry_controller.h"

#include "ui/document/background.h"
#include "ui/document/engine_text.h"
#include "ui/document/scene_commands.h"
#include "ui/panels/photometry_box.h"
#include "ui/window/settings.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>

#include <algorithm>

namespace atrium::ui {

PhotometryController::PhotometryController(Document& document, QWidget* window)
    : QObject(window), document_(document), window_(window) {}

void PhotometryController::choose(const std::vector<LightId>& lights) {
    ask(tr("Choose Photometric File"), [this, lights](const QString& path) { assign(path, lights); });
}

void PhotometryController::choose_and_add(const std::function<dvec3()>& at) {
    ask(tr("Add Luminaire"), [this, at](const QString& path) { add(path, at()); });
}

void PhotometryController::ask(const QString& title, std::function<void(const QString& path)> then) {
    auto* dialog = new QFileDialog(window_, title, Settings().photometry_folder(),
                                   tr("Photometric files (*.ies *.IES *.ldt *.LDT);;All files (*)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, this, std::move(then));
    dialog->open();
}

void PhotometryController::assign(const QString& path, const std::vector<LightId>& lights) {
    read(path, [this, path, lights](const LoadedPhotometry& loaded) {
        const SceneEdit edit = set_lamp_photometry(document_.scene(), lights, loaded.web);
        const auto done = document_.apply(edit, tr("Set photometry"));
        if (done) {
            tell(path, loaded);
        } else {
            Q_EMIT message(error_message(done.error()));
        }
    });
}

void PhotometryController::add(const QString& path, const dvec3& at) {
    read(path, [this, path, at](const LoadedPhotometry& loaded) {
        const QString name = QFileInfo(path).completeBaseName();
        const Command command =
            add_luminaire(document_.scene(), loaded.web, at, (name.isEmpty() ? tr("Lamp") : name).toStdString());
        const auto done = document_.apply(command.edit, tr("Add lamp"));
        if (done) {
            document_.selection()->set(command.select);
            tell(path, loaded);
        } else {
            Q_EMIT message(error_message(done.error()));
        }
    });
}

std::vector<LightId> PhotometryController::lamps_of(NodeId node) const {
    const Scene& scene = document_.scene();
    std::vector<LightId> out;
    if (!scene.nodes.contains(node)) {
        return out;
    }
    for (const NodeId id : scene.in_tree_order(node)) {
        const LightId light = scene.nodes.find(id)->light;
        const Light* found = scene.lights.find(light);
        if (found != nullptr && found->kind != Light::Kind::Directional &&
            std::find(out.begin(), out.end(), light) == out.end()) {
            out.push_back(light);
        }
    }
    return out;
}

void PhotometryController::read(const QString& path, std::function<void(const LoadedPhotometry&)> then) {
    run_in_background(
        this, [path] { return read_photometric_file(QFile::encodeName(path).toStdString()); },
        [this, path, then = std::move(then)](Result<LoadedPhotometry> loaded) {
            if (!loaded) {
                Error error = loaded.error();
                error.file.clear(); // the title names it
                auto* box =
                    new QMessageBox(QMessageBox::Warning, tr("Photometric File"),
                                    tr("%1 cannot be used.").arg(QFileInfo(path).fileName()), QMessageBox::Ok, window_);
                box->setInformativeText(error_message(error));
                box->setAttribute(Qt::WA_DeleteOnClose);
                box->open();
                return;
            }
            Settings().set_photometry_folder(QFileInfo(path).absolutePath());
            if (document_.in_gesture()) {
                Q_EMIT message(tr("Let go of the object first."));
                return;
            }
            then(*loaded);
        });
}

void PhotometryController::tell(const QString& path, const LoadedPhotometry& loaded) {
    Q_EMIT message(loaded.warnings.empty()
                       ? tr("%1: %2").arg(QFileInfo(path).fileName(), photometry_summary(*loaded.web))
                       : tr("%1: %2").arg(QFileInfo(path).fileName(), QString::fromStdString(loaded.warnings.front())));
}

} // namespace atrium::ui
