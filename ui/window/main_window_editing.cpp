// The window's wiring of editing: adding, library, clipboard, snapping and cameras.
#include "ui/actions/actions.h"
#include "ui/actions/edit_controller.h"
#include "ui/panels/library_panel.h"
#include "ui/panels/properties_panel.h"
#include "ui/panels/scene_tree_panel.h"
#include "ui/viewport/viewport_widget.h"
#include "ui/window/main_window.h"
#include "ui/window/main_window_tables.h"
#include "ui/window/photometry_controller.h"
#include "ui/window/settings.h"

#include <QActionGroup>
#include <QDockWidget>
#include <QFileDialog>
#include <QLocale>
#include <QMenu>
#include <QToolButton>

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr double kGridSteps[] = {0.01, 0.05, 0.1, 0.25, 0.5, 1.0}; // metres
constexpr double kAngleSteps[] = {1, 5, 15, 30, 45, 90};           // degrees

QString length_text(double metres) {
    return metres < 1.0 ? MainWindow::tr("%1 cm").arg(QLocale().toString(100 * metres, 'g', 3))
                        : MainWindow::tr("%1 m").arg(QLocale().toString(metres, 'g', 3));
}
QString angle_text(double degrees) { return QLocale().toString(degrees, 'g', 3) + QChar(0x00B0); }

} // namespace

void MainWindow::connect_edit() {
    on(ActionId::Undo, [this] { document_.undo(); });
    on(ActionId::Redo, [this] { document_.redo(); });
    on(ActionId::AddDaylight, [this] { edit_->add_daylight(); });
    on(ActionId::Duplicate, [this] { edit_->duplicate(); });
    on(ActionId::Delete, [this] { edit_->remove(); });
    on(ActionId::Rename, [this] { tree_->rename_active(); });
    on(ActionId::Hide, [this] { edit_->hide(); });
    on(ActionId::ShowAll, [this] { edit_->show_all(); });
    on(ActionId::Group, [this] { edit_->group(); });
    on(ActionId::SelectAll, [this] { edit_->select_all(); });
    on(ActionId::SelectNone, [this] { edit_->select_none(); });
    for (const auto& [id, kind] : kAdd) {
        on(id, [this, what = kind] {
            const bool was_empty = document_.scene().nodes.empty();
            started_ = true;
            update_page();
            edit_->add(what, was_empty ? dvec3(0.0) : viewport_->placement_point());
            if (was_empty) {
                viewport_->frame_all();
            }
        });
    }
    on(ActionId::AddLuminaire, [this] { photometry_->choose_and_add([this] { return lamp_place(); }); });
    connect(photometry_, &PhotometryController::message, this, &MainWindow::say);
    connect(properties_, &PropertiesPanel::choose_photometry, photometry_, &PhotometryController::choose);
    on(ActionId::AddCamera, [this] {
        started_ = true;
        update_page();
        edit_->add_camera_here(viewport_->camera());
    });
    connect(edit_, &EditController::message, this, &MainWindow::say);
}

dvec3 MainWindow::lamp_place() {
    started_ = true;
    update_page();
    return document_.scene().nodes.empty() ? dvec3(0.0, kLampHeight, 0.0) : viewport_->lamp_place();
}

void MainWindow::make_library() {
    library_ = new LibraryPanel;
    auto* dock = new QDockWidget(tr("Library"), this);
    dock->setObjectName(QStringLiteral("dock_library"));
    dock->setWidget(library_);
    addDockWidget(Qt::LeftDockWidgetArea, dock);
    resizeDocks({dock}, {340}, Qt::Horizontal);
    dock->hide(); // the view has the room until the library is asked for
    QAction* action = (*actions_)[ActionId::Library];
    connect(action, &QAction::triggered, this, [this, dock](bool on) {
        dock->setVisible(on);
        if (on) {
            started_ = true;
            update_page();
            dock->raise();
            library_->focus_search();
        } else {
            viewport_->setFocus();
        }
    });
    connect(dock, &QDockWidget::visibilityChanged, this,
            [action, dock] { action->setChecked(dock->isVisible() || !dock->isHidden()); });
    connect(library_, &LibraryPanel::message, this, &MainWindow::say);
    connect(library_, &LibraryPanel::chosen, this, [this](const std::shared_ptr<const LibraryItem>& item) {
        started_ = true;
        update_page();
        if (item->is_material()) {
            edit_->assign(*item);
        } else {
            const bool was_empty = document_.scene().nodes.empty();
            viewport_->place(item);
            if (was_empty) {
                viewport_->frame_all();
            }
        }
    });
    library_->set_folder(Settings().furniture_folder());
    connect(library_, &LibraryPanel::folder_wanted, this, [this] {
        auto* dialog = new QFileDialog(this, tr("Folder with Furniture"), Settings().furniture_folder());
        dialog->setFileMode(QFileDialog::Directory);
        dialog->setOption(QFileDialog::ShowDirsOnly);
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& folder) {
            Settings().set_furniture_folder(folder);
            library_->set_folder(folder);
        });
        dialog->open();
    });
}

void MainWindow::make_snapping() {
    const Snapping remembered = Settings().snapping();
    viewport_->set_snapping(remembered);
    QAction* snap = (*actions_)[ActionId::Snap];
    QAction* slide = (*actions_)[ActionId::SlideOnSurfaces];
    QAction* turn = (*actions_)[ActionId::TurnToSurface];
    QAction* own = (*actions_)[ActionId::OwnAxes];
    own->setChecked(remembered.own_axes);
    snap->setChecked(remembered.on);
    slide->setChecked(remembered.on_surfaces);
    turn->setChecked(remembered.turn_to_surface);
    const auto show_badge = [this] {
        const Snapping& now = viewport_->snapping();
        QStringList parts;
        if (now.on) {
            parts << tr("Snap %1, %2").arg(length_text(now.grid), angle_text(degrees_from_radians(now.angle)));
        }
        if (now.on_surfaces) {
            parts << (now.turn_to_surface ? tr("Slide and turn") : tr("Slide"));
        }
        if (now.own_axes) {
            parts << tr("Own axes");
        }
        snap_badge_->setText(parts.join(QStringLiteral("  |  ")));
        snap_badge_->setVisible(!parts.isEmpty());
        snap_badge_->setToolTip(tr("How drags snap: Edit > Snapping. Click to change it."));
        snap_badge_->setAccessibleName(tr("Snapping"));
    };
    const auto changed = [this, snap, slide, turn, own, show_badge] {
        Snapping next = viewport_->snapping();
        next.on = snap->isChecked();
        next.on_surfaces = slide->isChecked();
        next.turn_to_surface = turn->isChecked();
        next.own_axes = own->isChecked();
        viewport_->set_snapping(next);
        viewport_->update(); // handles turn
        Settings().set_snapping(next);
        turn->setEnabled(next.on_surfaces);
        show_badge();
    };
    for (QAction* action : {snap, slide, turn, own}) {
        connect(action, &QAction::toggled, this, changed);
    }
    turn->setEnabled(remembered.on_surfaces);
    connect(snap_badge_, &QToolButton::clicked, this, [this] {
        if (auto* menu = findChild<QMenu*>(QStringLiteral("menu_snapping"))) {
            menu->popup(snap_badge_->mapToGlobal(QPoint(0, -menu->sizeHint().height())));
        }
    });
    connect(this, &MainWindow::snapping_steps_changed, this, changed);
    show_badge();
}

void MainWindow::fill_snapping_menu(QMenu* menu) {
    menu->setObjectName(QStringLiteral("menu_snapping"));
    for (const ActionId id : {ActionId::Snap, ActionId::SlideOnSurfaces, ActionId::TurnToSurface, ActionId::OwnAxes}) {
        menu->addAction((*actions_)[id]);
    }
    const Snapping remembered = Settings().snapping();
    const auto steps = [&](const QString& title, std::span<const double> values, double now, const auto& text,
                           const auto& set) {
        menu->addSection(title);
        auto* group = new QActionGroup(menu);
        for (const double value : values) {
            QAction* action = menu->addAction(text(value));
            action->setCheckable(true);
            action->setChecked(std::abs(value - now) < 1e-6);
            group->addAction(action);
            connect(action, &QAction::triggered, this, [this, value, set] {
                Snapping next = viewport_->snapping();
                set(next, value);
                viewport_->set_snapping(next);
                Q_EMIT snapping_steps_changed();
            });
        }
    };
    steps(tr("Grid step"), kGridSteps, remembered.grid, length_text, [](Snapping& s, double v) { s.grid = v; });
    steps(tr("Angle step"), kAngleSteps, degrees_from_radians(remembered.angle), angle_text,
          [](Snapping& s, double v) { s.angle = radians_from_degrees(v); });
}

void MainWindow::fill_camera_menu(QMenu* menu) {
    menu->setObjectName(QStringLiteral("menu_cameras"));
    const auto refill = [this, menu] {
        menu->clear();
        menu->addAction((*actions_)[ActionId::NextCamera]);
        menu->addAction((*actions_)[ActionId::PreviousCamera]);
        menu->addAction((*actions_)[ActionId::AddCamera]);
        menu->addSeparator();
        for (const NodeId id : document_.scene().in_tree_order()) {
            const Node* node = document_.scene().nodes.find(id);
            if (!document_.scene().cameras.contains(node->camera)) {
                continue;
            }
            QString name = QString::fromStdString(node->name);
            QAction* action = menu->addAction(name.replace(QLatin1Char('&'), QStringLiteral("&&")));
            action->setCheckable(true);
            action->setChecked(id == camera_);
            connect(action, &QAction::triggered, this, [this, id] { look_through(id); });
        }
    };
    connect(menu, &QMenu::aboutToShow, this, refill);
    refill();
}

void MainWindow::look_through(NodeId id) {
    const Node* node = document_.scene().nodes.find(id);
    const Camera* lens = node == nullptr ? nullptr : document_.scene().cameras.find(node->camera);
    if (lens != nullptr) {
        camera_ = id;
        viewport_->set_camera({document_.scene().world_matrix(id), *lens});
        say(tr("View of %1").arg(QString::fromStdString(node->name)));
    }
}

void MainWindow::step_camera(int step) {
    std::vector<NodeId> cameras;
    for (const NodeId id : document_.scene().in_tree_order()) {
        if (document_.scene().cameras.contains(document_.scene().nodes.find(id)->camera)) {
            cameras.push_back(id);
        }
    }
    if (cameras.empty()) {
        say(tr("The scene has no camera. Add one from the present view: Add > Camera."));
        return;
    }
    const int count = int(cameras.size());
    const int at = int(std::find(cameras.begin(), cameras.end(), camera_) - cameras.begin());
    const int next = at == count ? (step > 0 ? 0 : count - 1) : (at + step + count) % count;
    look_through(cameras[std::size_t(next)]);
}

void MainWindow::connect_editing() {
    on(ActionId::Cut, [this] { edit_->cut(); });
    on(ActionId::Copy, [this] { edit_->copy(); });
    on(ActionId::Paste, [this] {
        started_ = true;
        update_page();
        edit_->paste([this](const DBox3& bounds) { return viewport_->placement_for(bounds); });
    });
    on(ActionId::PasteInPlace, [this] {
        started_ = true;
        update_page();
        edit_->paste(nullptr);
    });
    on(ActionId::CopyMaterial, [this] { edit_->copy_material(); });
    on(ActionId::PasteMaterial, [this] { edit_->paste_material(); });
    on(ActionId::Lock, [this] { edit_->toggle_lock(); });
    on(ActionId::DropToSurface, [this] { viewport_->drop_to_surface(); });
    QAction* isolate = (*actions_)[ActionId::Isolate];
    connect(isolate, &QAction::toggled, viewport_, &ViewportWidget::set_isolated);
    connect(viewport_, &ViewportWidget::isolated_changed, isolate, &QAction::setChecked);
    connect((*actions_)[ActionId::OrbitSelection], &QAction::toggled, viewport_, &ViewportWidget::set_orbit_selection);
    on(ActionId::NextCamera, [this] { step_camera(1); });
    on(ActionId::PreviousCamera, [this] { step_camera(-1); });
    connect(&document_, &Document::reset_done, this, [this] { camera_ = {}; });
}

} // namespace atrium::ui
