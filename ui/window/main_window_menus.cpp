// Menu bar, tool bar and status bar: what stands in them and in which order. What it does is connected elsewhere.
#include "ui/actions/actions.h"
#include "ui/actions/icons.h"
#include "ui/panels/jobs_panel.h"
#include "ui/window/file_controller.h"
#include "ui/window/main_window.h"
#include "ui/window/main_window_tables.h"
#include "ui/window/overlay_controller.h"

#include <QActionGroup>
#include <QDockWidget>
#include <QLabel>
#include <QMenuBar>
#include <QProgressBar>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>

namespace atrium::ui {

void MainWindow::make_menus() {
    const Actions& a = *actions_;
    auto* file = menuBar()->addMenu(tr("&File"));
    file->addAction(a[ActionId::New]);
    file->addAction(a[ActionId::Open]);
    recent_menu_ = file->addMenu(tr("Open &Recent"));
    file->addAction(a[ActionId::Import]);
    file->addSeparator();
    file->addAction(a[ActionId::Save]);
    file->addAction(a[ActionId::SaveAs]);
    file->addAction(a[ActionId::Revert]);
    file->addAction(a[ActionId::RecoveredWork]);
    file->addAction(a[ActionId::FindImages]);
    file->addSeparator();
    file->addAction(a[ActionId::ExportGltf]);
    file->addAction(a[ActionId::ExportPicture]);
    file->addSeparator();
    file->addAction(a[ActionId::Quit]);

    const auto fill = [&](const QString& title, std::initializer_list<ActionId> ids) {
        auto* menu = menuBar()->addMenu(title);
        for (const ActionId id : ids) {
            if (id == ActionId::Count) {
                menu->addSeparator();
            } else {
                menu->addAction(a[id]);
            }
        }
        return menu;
    };
    const ActionId gap = ActionId::Count;
    auto* edit = fill(tr("&Edit"), {ActionId::Undo,
                                    ActionId::Redo,
                                    gap,
                                    ActionId::Cut,
                                    ActionId::Copy,
                                    ActionId::Paste,
                                    ActionId::PasteInPlace,
                                    ActionId::CopyMaterial,
                                    ActionId::PasteMaterial,
                                    gap,
                                    ActionId::Duplicate,
                                    ActionId::Delete,
                                    ActionId::Rename,
                                    ActionId::Group,
                                    gap,
                                    ActionId::Hide,
                                    ActionId::ShowAll,
                                    ActionId::Isolate,
                                    ActionId::Lock,
                                    gap,
                                    ActionId::SelectAll,
                                    ActionId::SelectNone,
                                    gap,
                                    ActionId::ToolSelect,
                                    ActionId::ToolMove,
                                    ActionId::ToolRotate,
                                    ActionId::ToolScale,
                                    ActionId::DropToSurface,
                                    gap,
                                    ActionId::ToolMeasure,
                                    ActionId::CopyPoints,
                                    ActionId::RemovePoints,
                                    gap,
                                    ActionId::Commands,
                                    gap,
                                    ActionId::Preferences});
    fill_snapping_menu(edit->addMenu(tr("Sna&pping")));
    fill(tr("&Add"),
         {ActionId::Library, gap, ActionId::AddPolygon, ActionId::AddBox, ActionId::AddSphere, ActionId::AddCylinder,
          ActionId::AddCone, ActionId::AddDisc, gap, ActionId::AddPointLight, ActionId::AddSpotLight, ActionId::AddAreaLight,
          ActionId::AddLuminaire, ActionId::AddSun, ActionId::AddDaylight, gap, ActionId::AddCamera});
    auto* view = fill(tr("&View"), {ActionId::FrameSelection,
                                    ActionId::FrameAll,
                                    ActionId::WalkMode,
                                    ActionId::OrbitSelection,
                                    gap,
                                    ActionId::ExposureUp,
                                    ActionId::ExposureDown,
                                    ActionId::ExposureReset,
                                    gap,
                                    ActionId::ShowPicture,
                                    ActionId::ShowIlluminance,
                                    ActionId::ShowLuminance,
                                    ActionId::Contours,
                                    gap,
                                    ActionId::ShowDirect,
                                    ActionId::ShowDiffuse,
                                    ActionId::ShowCaustic,
                                    gap,
                                    ActionId::Wireframe,
                                    ActionId::CutWalls,
                                    gap,
                                    ActionId::Convergence,
                                    ActionId::InspectCaustics,
                                    ActionId::CausticBoxes,
                                    ActionId::TexelGrid,
                                    ActionId::ParticleLandings});
    overlays_->fill(view->addMenu(tr("O&verlays")));
    auto* ways = view->addMenu(tr("Ca&ustics Shown As"));
    for (const auto& [id, way] : kWays) {
        ways->addAction(a[id]);
    }
    fill_camera_menu(view->addMenu(tr("Ca&meras")));
    view->addSeparator();
    docks_menu_ = view->addMenu(tr("&Panels"));
    const QList<QDockWidget*> docks = findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
    for (QDockWidget* dock : docks) {
        docks_menu_->addAction(dock->toggleViewAction());
    }
    fill(tr("&Light"), {ActionId::StopLight, ActionId::ResumeLight});
    fill(tr("&Help"), {ActionId::Shortcuts, gap, ActionId::About});
}

void MainWindow::make_tool_bar() {
    const Actions& a = *actions_;
    auto* bar = addToolBar(tr("Tools"));
    bar->setObjectName(QStringLiteral("tool_bar"));
    bar->setMovable(false);
    bar->setIconSize({20, 20});
    bar->setContextMenuPolicy(Qt::PreventContextMenu);
    const auto add = [&](std::initializer_list<ActionId> ids) {
        for (const ActionId id : ids) {
            bar->addAction(a[id]);
        }
        bar->addSeparator();
    };
    add({ActionId::Open, ActionId::Save});
    add({ActionId::Undo, ActionId::Redo});
    auto* group = new QActionGroup(this);
    for (const auto& [id, tool] : kTools) {
        group->addAction(a[id]);
        bar->addAction(a[id]);
    }
    bar->addAction(a[ActionId::Snap]);
    bar->addAction(a[ActionId::SlideOnSurfaces]);
    bar->addSeparator();
    add({ActionId::Library});
    add({ActionId::AddBox, ActionId::AddSphere, ActionId::AddCylinder, ActionId::AddPolygon});
    add({ActionId::AddPointLight, ActionId::AddSpotLight, ActionId::AddAreaLight});
    add({ActionId::FrameSelection, ActionId::FrameAll, ActionId::WalkMode, ActionId::Wireframe});
    add({ActionId::ExposureDown, ActionId::ExposureUp});
    bar->addAction(a[ActionId::StopLight]);
    bar->addAction(a[ActionId::ResumeLight]);
}

void MainWindow::make_status_bar() {
    busy_text_ = new QLabel;
    busy_bar_ = new QProgressBar;
    busy_bar_->setRange(0, 0);
    busy_bar_->setMaximumSize(120, 12);
    busy_bar_->setTextVisible(false);
    busy_bar_->setAccessibleName(tr("File progress"));
    busy_cancel_ = new QToolButton;
    busy_cancel_->setIcon(tinted_icon(QStringLiteral("close")));
    busy_cancel_->setToolTip(tr("Cancel opening"));
    busy_cancel_->setAccessibleName(tr("Cancel opening"));
    busy_cancel_->setAutoRaise(true);
    connect(busy_cancel_, &QToolButton::clicked, files_, &FileController::cancel_loading);
    problems_badge_ = new QToolButton;
    problems_badge_->setAutoRaise(true);
    problems_badge_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    problems_badge_->setToolTip(tr("Show the problems of this scene"));
    problems_badge_->setAccessibleName(tr("Number of problems"));
    problems_badge_->hide();
    connect(problems_badge_, &QToolButton::clicked, this, [this] { raise_dock("dock_problems"); });
    snap_badge_ = new QToolButton;
    snap_badge_->setObjectName(QStringLiteral("snap_badge"));
    snap_badge_->setAutoRaise(true);
    snap_badge_->hide();
    for (QWidget* widget : std::initializer_list<QWidget*>{busy_text_, busy_bar_, busy_cancel_, snap_badge_, problems_badge_,
                                                           new LightBadge(*engine_)}) {
        statusBar()->addPermanentWidget(widget);
    }
    for (QWidget* widget : std::initializer_list<QWidget*>{busy_text_, busy_bar_, busy_cancel_}) {
        widget->hide();
    }
}

} // namespace atrium::ui
