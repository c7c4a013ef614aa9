#include "ui/window/main_window.h"

#include "ui/actions/actions.h"
#include "ui/actions/edit_controller.h"
#include "ui/actions/icons.h"
#include "ui/panels/caustic_panel.h"
#include "ui/panels/caustic_places.h"
#include "ui/panels/convergence_panel.h"
#include "ui/panels/jobs_panel.h"
#include "ui/panels/problems_panel.h"
#include "ui/panels/properties_panel.h"
#include "ui/panels/scene_tree_panel.h"
#include "ui/viewport/viewport_widget.h"
#include "ui/window/daylight_bar.h"
#include "ui/window/export_picture_dialog.h"
#include "ui/window/false_color_bar.h"
#include "ui/window/file_controller.h"
#include "ui/window/help_dialogs.h"
#include "ui/window/import_bar.h"
#include "ui/window/overlay_controller.h"
#include "ui/window/photometry_controller.h"
#include "ui/window/settings.h"
#include "ui/window/start_page.h"

#include <algorithm>
#include <array>

#include <QActionGroup>
#include <QClipboard>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QGuiApplication>
#include <QLabel>
#include <QMenuBar>
#include <QMimeData>
#include <QProgressBar>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

namespace atrium::ui {

namespace {

constexpr float kExposureStep = 1.0F / 3.0F;
constexpr int kMessageMs = 6000;

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

const std::pair<ActionId, ToolKind> kTools[] = {{ActionId::ToolSelect, ToolKind::Select},
                                                {ActionId::ToolMove, ToolKind::Move},
                                                {ActionId::ToolRotate, ToolKind::Rotate},
                                                {ActionId::ToolScale, ToolKind::Scale},
                                                {ActionId::ToolMeasure, ToolKind::Measure}};

const std::pair<ActionId, NewObject> kAdd[] = {{ActionId::AddPolygon, NewObject::Polygon},
                                               {ActionId::AddBox, NewObject::Box},
                                               {ActionId::AddSphere, NewObject::Sphere},
                                               {ActionId::AddCylinder, NewObject::Cylinder},
                                               {ActionId::AddCone, NewObject::Cone},
                                               {ActionId::AddDisc, NewObject::Disc},
                                               {ActionId::AddPointLight, NewObject::PointLight},
                                               {ActionId::AddSpotLight, NewObject::SpotLight},
                                               {ActionId::AddSun, NewObject::Sun},
                                               {ActionId::AddAreaLight, NewObject::AreaLight}};

const std::pair<ActionId, CausticView> kWays[] = {{ActionId::CausticsFlat, CausticView::Flat},
                                                  {ActionId::CausticsOnMesh, CausticView::Mesh},
                                                  {ActionId::CausticsInTextures, CausticView::Texture},
                                                  {ActionId::CausticsWhole, CausticView::Whole}};

} // namespace

MainWindow::MainWindow(const QString& recovery_directory, QWidget* parent) : QMainWindow(parent) {
    setObjectName(QStringLiteral("main_window"));
    setAcceptDrops(true);
    setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
    recovery_ = std::make_unique<Recovery>(document_, recovery_directory.isEmpty() ? Recovery::default_directory()
                                                                                   : recovery_directory);
    engine_ = new EngineLink(document_, this);
    actions_ = new Actions(this);
    files_ = new FileController(document_, *engine_, *recovery_, this);
    edit_ = new EditController(document_, this);
    photometry_ = new PhotometryController(document_, this);

    auto* centre = new QWidget;
    auto* layout = new QVBoxLayout(centre);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    import_bar_ = new ImportBar;
    pages_ = new QStackedWidget;
    start_ = new StartPage(*actions_);
    viewport_ = new ViewportWidget(document_, *engine_);
    viewport_->setMinimumSize(320, 240);
    pages_->addWidget(start_);
    pages_->addWidget(viewport_);
    auto* daylight_bar = new DaylightBar(document_);
    connect(daylight_bar, &DaylightBar::accepted, this, [this] { edit_->add_daylight(); });
    layout->addWidget(import_bar_);
    layout->addWidget(daylight_bar);
    layout->addWidget(pages_, 1);
    false_color_bar_ = new FalseColorBar(document_, *engine_);
    layout->addWidget(false_color_bar_);
    setCentralWidget(centre);

    overlays_ = new OverlayController(*actions_, *engine_, *viewport_, this);
    make_docks();
    make_menus();
    make_tool_bar();
    make_status_bar();
    connect_files();
    connect_edit();
    connect_view();
    connect_editing();
    make_snapping();
    connect_false_color();
    connect_documents();

    resize(1360, 860);
    const Settings settings;
    if (!settings.geometry().isEmpty()) {
        restoreGeometry(settings.geometry());
        restoreState(settings.layout());
    }
    update_recent();
    update_title();
    update_actions();
    update_page();
}

MainWindow::~MainWindow() {
    // Panels and viewport look at document and engine, which are members: they go first.
    document_.disconnect();
    document_.undo_stack()->disconnect();
    document_.selection()->disconnect();
    const QList<QDockWidget*> docks = findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
    // In place: taken out of the window first, it would have lost the GL context that its resources must be freed in.
    delete viewport_;
    viewport_ = nullptr;
    qDeleteAll(docks);
    delete files_;
    delete engine_;
}

QAction* MainWindow::action(ActionId id) const { return (*actions_)[id]; }

void MainWindow::on(ActionId id, std::function<void()> slot) {
    connect((*actions_)[id], &QAction::triggered, this, [slot = std::move(slot)] { slot(); });
}

void MainWindow::say(const QString& text) { statusBar()->showMessage(text, kMessageMs); }

void MainWindow::raise_dock(const char* name) {
    if (auto* dock = findChild<QDockWidget*>(QLatin1StringView(name))) {
        dock->show();
        dock->raise();
    }
}

void MainWindow::make_docks() {
    const auto dock = [this](const char* name, const QString& title, QWidget* content, Qt::DockWidgetArea area) {
        auto* widget = new QDockWidget(title, this);
        widget->setObjectName(QLatin1StringView(name));
        widget->setWidget(content);
        addDockWidget(area, widget);
        return widget;
    };
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    tree_ = new SceneTreePanel(document_);
    properties_ = new PropertiesPanel(document_);
    auto* problems = new ProblemsPanel(document_);
    auto* jobs = new JobsPanel(*engine_);
    auto* tree_dock = dock("dock_tree", tr("Scene"), tree_, Qt::RightDockWidgetArea);
    auto* properties_dock = dock("dock_properties", tr("Properties"), properties_, Qt::RightDockWidgetArea);
    auto* problems_dock = dock("dock_problems", tr("Problems"), problems, Qt::RightDockWidgetArea);
    auto* jobs_dock = dock("dock_jobs", tr("Light"), jobs, Qt::RightDockWidgetArea);
    splitDockWidget(tree_dock, properties_dock, Qt::Vertical);
    tabifyDockWidget(properties_dock, jobs_dock);
    tabifyDockWidget(jobs_dock, problems_dock);
    properties_dock->raise();
    setTabPosition(Qt::RightDockWidgetArea, QTabWidget::North);
    resizeDocks({tree_dock, properties_dock}, {330, 450}, Qt::Vertical);
    resizeDocks({tree_dock, properties_dock}, {320, 320}, Qt::Horizontal);
    // Wide rows want the width of the window; until they are asked for, the view has it all.
    caustics_ = new CausticPanel(document_, *engine_);
    auto* caustics_dock = dock("dock_caustics", tr("Caustics"), caustics_, Qt::BottomDockWidgetArea);
    resizeDocks({caustics_dock}, {320}, Qt::Vertical);
    caustics_dock->hide();
    convergence_ = new ConvergencePanel(document_, *engine_);
    auto* convergence_dock = dock("dock_convergence", tr("Convergence"), convergence_, Qt::BottomDockWidgetArea);
    tabifyDockWidget(caustics_dock, convergence_dock);
    convergence_dock->hide();
    connect(convergence_, &ConvergencePanel::message, this, &MainWindow::say);
    connect(caustics_, &CausticPanel::message, this, &MainWindow::say);
    connect(caustics_, &CausticPanel::activated, this, [this](const CausticRow& row) {
        if (const auto solution = engine_->solution()) {
            const PiecePlace place = piece_place(document_.scene(), *solution, row);
            viewport_->look_at(place.bounds, place.focus, place.normal);
        }
    });

    connect(tree_, &SceneTreePanel::activated, this, [this] { viewport_->frame_selection(); });
    connect(tree_, &SceneTreePanel::message, this, &MainWindow::say);
    connect(problems, &ProblemsPanel::activated_node, this, [this] { viewport_->frame_selection(); });
    connect(problems, &ProblemsPanel::count_changed, this, [this, problems_dock](int errors, int warnings) {
        const int all = errors + warnings;
        problems_dock->setWindowTitle(all == 0 ? tr("Problems") : tr("Problems (%1)").arg(all));
        problems_badge_->setVisible(all != 0);
        problems_badge_->setIcon(tinted_icon(errors != 0 ? QStringLiteral("error") : QStringLiteral("warning")));
        problems_badge_->setText(QString::number(all));
    });
    connect(properties_, &PropertiesPanel::message, this, &MainWindow::say);
    connect(properties_, &PropertiesPanel::look_through, this, &MainWindow::look_through);
    make_library();
}

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
                                    ActionId::Commands});
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

void MainWindow::connect_files() {
    on(ActionId::New, [this] { files_->new_scene(); });
    on(ActionId::Open, [this] { files_->ask_and_open(); });
    on(ActionId::Import, [this] { files_->ask_and_import(); });
    on(ActionId::Save, [this] { files_->save(); });
    on(ActionId::SaveAs, [this] { files_->save_as(); });
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
    connect(recovery_.get(), &Recovery::failed, this,
            [this](const QString& why) { say(tr("Autosave failed: %1").arg(why)); });
}

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

void MainWindow::connect_view() {
    for (const auto& [id, tool] : kTools) {
        on(id, [this, kind = tool] { viewport_->set_tool(kind); });
    }
    const auto show_tool = [this](ToolKind tool) {
        for (const auto& [id, kind] : kTools) {
            if (kind == tool) {
                (*actions_)[id]->setChecked(true);
            }
        }
    };
    connect(viewport_, &ViewportWidget::tool_changed, this, show_tool);
    show_tool(viewport_->tool());
    on(ActionId::FrameSelection, [this] { viewport_->frame_selection(); });
    on(ActionId::FrameAll, [this] { viewport_->frame_all(); });
    connect((*actions_)[ActionId::WalkMode], &QAction::toggled, viewport_, &ViewportWidget::set_walk_mode);
    connect(viewport_, &ViewportWidget::walk_mode_changed, this, [this](bool walking) {
        (*actions_)[ActionId::WalkMode]->setChecked(walking);
        if (walking) {
            viewport_->setFocus();
        }
        // Letters walk now; as shortcuts they would never reach the view.
        for (const ActionInfo& info : action_table()) {
            if (qstrlen(info.shortcut) == 1) {
                (*actions_)[info.id]->setEnabled(!walking);
            }
        }
        update_actions();
    });
    const auto expose = [this](float ev) {
        viewport_->set_exposure(ev);
        say(tr("Exposure %1%2 EV").arg(ev > 0 ? QStringLiteral("+") : QString()).arg(double(ev), 0, 'f', 1));
    };
    on(ActionId::ExposureUp, [this, expose] { expose(viewport_->exposure() + kExposureStep); });
    on(ActionId::ExposureDown, [this, expose] { expose(viewport_->exposure() - kExposureStep); });
    on(ActionId::ExposureReset, [expose] { expose(0); });
    connect((*actions_)[ActionId::Wireframe], &QAction::toggled, viewport_, &ViewportWidget::set_wireframe);
    connect((*actions_)[ActionId::CausticBoxes], &QAction::toggled, viewport_, &ViewportWidget::set_caustic_boxes);
    connect((*actions_)[ActionId::TexelGrid], &QAction::toggled, viewport_, &ViewportWidget::set_texel_grid);
    connect((*actions_)[ActionId::ParticleLandings], &QAction::toggled, this, [this](bool on) {
        engine_->keep_landings(on);
        viewport_->set_landings(on);
        if (on && document_.selection()->nodes().empty()) {
            say(tr("Select an object to see the particles that landed on it."));
        }
    });
    auto* ways = new QActionGroup(this);
    for (const auto& [id, way] : kWays) {
        ways->addAction((*actions_)[id]);
        on(id, [this, shown = way] { viewport_->set_caustic_view(shown); });
    }
    (*actions_)[ActionId::CausticsInTextures]->setChecked(true);
    on(ActionId::InspectCaustics, [this] {
        raise_dock("dock_caustics");
        caustics_->focus_table();
    });
    on(ActionId::Convergence, [this] { raise_dock("dock_convergence"); });
    (*actions_)[ActionId::CutWalls]->setChecked(true);
    connect((*actions_)[ActionId::CutWalls], &QAction::toggled, viewport_, &ViewportWidget::set_cut_walls);
    QAction* direct = (*actions_)[ActionId::ShowDirect];
    QAction* diffuse = (*actions_)[ActionId::ShowDiffuse];
    QAction* caustic = (*actions_)[ActionId::ShowCaustic];
    const LightShares remembered = Settings().light_shares();
    direct->setChecked(remembered.direct);
    diffuse->setChecked(remembered.diffuse);
    caustic->setChecked(remembered.caustic);
    viewport_->set_light_shares(remembered);
    const std::array switches{direct, diffuse, caustic};
    for (QAction* changed : switches) {
        connect(changed, &QAction::toggled, this, [this, changed, switches] {
            if (std::none_of(switches.begin(), switches.end(), [](QAction* one) { return one->isChecked(); })) {
                for (QAction* other : switches) { // a black picture shows nothing; these come back here
                    other->setChecked(other != changed);
                }
                return;
            }
            const LightShares shares{switches[1]->isChecked(), switches[0]->isChecked(), switches[2]->isChecked()};
            viewport_->set_light_shares(shares);
            false_color_bar_->set_shares(shares);
            Settings().set_light_shares(shares);
            say(shares == LightShares{} ? tr("All light is shown.") : tr("Shown: only %1.").arg(shares_text(shares)));
        });
    }
    connect(viewport_, &ViewportWidget::message, this, &MainWindow::say);
    on(ActionId::CopyPoints, [this] {
        const auto& points = viewport_->measuring_points().points();
        if (points.empty()) {
            say(tr("There are no measuring points yet: choose Measure Light and click on a surface."));
            return;
        }
        QGuiApplication::clipboard()->setText(QString::fromStdString(viewport_->measuring_points().csv()));
        say(tr("%n measuring point(s) copied.", nullptr, int(points.size())));
    });
    on(ActionId::RemovePoints, [this] { viewport_->clear_measuring_points(); });
    on(ActionId::StopLight, [this] { engine_->cancel(); });
    on(ActionId::ResumeLight, [this] { engine_->resume(); });
    on(ActionId::Shortcuts, [this] { show_shortcut_list(this); });
    on(ActionId::About, [this] { show_about_box(this); });
    on(ActionId::Commands, [this] { show_command_search(*actions_, this); });
}

void MainWindow::connect_false_color() {
    connect(false_color_bar_, &FalseColorBar::changed, this,
            [this] { viewport_->set_false_color(false_color_bar_->scale()); });
    connect(false_color_bar_, &FalseColorBar::message, this, &MainWindow::say);
    const Settings settings;
    auto* group = new QActionGroup(this);
    const std::array<std::pair<ActionId, std::optional<LightQuantity>>, 3> views{
        {{ActionId::ShowPicture, std::nullopt},
         {ActionId::ShowIlluminance, LightQuantity::Illuminance},
         {ActionId::ShowLuminance, LightQuantity::Luminance}}};
    for (const auto& [id, quantity] : views) {
        group->addAction((*actions_)[id]);
        (*actions_)[id]->setChecked(settings.false_color() == quantity);
        on(id, [this, shown = quantity] {
            false_color_bar_->set_quantity(shown);
            update_actions();
        });
    }
    QAction* contours = (*actions_)[ActionId::Contours];
    contours->setChecked(settings.contours());
    connect(contours, &QAction::toggled, this, [this](bool on) {
        Settings().set_contours(on);
        false_color_bar_->set_contours(on);
    });
    false_color_bar_->set_shares(viewport_->light_shares());
    false_color_bar_->set_contours(settings.contours());
    false_color_bar_->set_quantity(settings.false_color());
}

void MainWindow::connect_documents() {
    connect(&document_, &Document::path_changed, this, &MainWindow::update_title);
    connect(document_.undo_stack(), &QUndoStack::cleanChanged, this, &MainWindow::update_title);
    connect(document_.undo_stack(), &QUndoStack::indexChanged, this, &MainWindow::update_actions);
    connect(document_.undo_stack(), &QUndoStack::cleanChanged, this, &MainWindow::update_actions);
    connect(document_.selection(), &Selection::changed, this, &MainWindow::update_actions);
    connect(&document_, &Document::reset_done, this, &MainWindow::update_actions);
    connect(engine_, &EngineLink::status_changed, this, &MainWindow::update_actions);
}

void MainWindow::update_title() {
    const QString name = document_.path().isEmpty() ? tr("Untitled") : QFileInfo(document_.path()).fileName();
    setWindowTitle(tr("%1[*] - Atrium").arg(name));
    setWindowFilePath(document_.path());
    setWindowModified(!document_.undo_stack()->isClean());
}

void MainWindow::update_actions() {
    const QUndoStack* undo = document_.undo_stack();
    const auto name = [this](ActionId id, bool possible, const QString& plain, const QString& what) {
        QAction* action = (*actions_)[id];
        action->setEnabled(possible);
        action->setText(possible && !what.isEmpty() ? tr("%1: %2").arg(plain, what) : plain);
    };
    name(ActionId::Undo, undo->canUndo(), tr("&Undo"), undo->undoText());
    name(ActionId::Redo, undo->canRedo(), tr("&Redo"), undo->redoText());
    const bool selected = !document_.selection()->nodes().empty();
    const bool walking = viewport_->walk_mode();
    for (const ActionId id :
         {ActionId::Cut, ActionId::Copy, ActionId::CopyMaterial, ActionId::PasteMaterial, ActionId::Lock,
          ActionId::DropToSurface, ActionId::Duplicate, ActionId::Delete, ActionId::Rename, ActionId::Group}) {
        (*actions_)[id]->setEnabled(selected);
    }
    (*actions_)[ActionId::Hide]->setEnabled(selected && !walking);
    (*actions_)[ActionId::Contours]->setEnabled(false_color_bar_->quantity() && !walking);
    const bool solving = engine_->status().state == SessionStatus::State::Solving;
    (*actions_)[ActionId::StopLight]->setEnabled(solving);
    (*actions_)[ActionId::ResumeLight]->setEnabled(!solving && engine_->stale());
    (*actions_)[ActionId::ExportPicture]->setEnabled(bool(engine_->solution()));
}

void MainWindow::update_page() {
    if (!document_.scene().nodes.empty() || !document_.path().isEmpty()) {
        started_ = true;
    }
    pages_->setCurrentWidget(started_ ? static_cast<QWidget*>(viewport_) : start_);
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
    recovery_->clear();
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

dvec3 MainWindow::lamp_place() {
    started_ = true;
    update_page();
    return document_.scene().nodes.empty() ? dvec3(0.0, kLampHeight, 0.0) : viewport_->lamp_place();
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

void MainWindow::changeEvent(QEvent* event) {
    QMainWindow::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && actions_ != nullptr) {
        actions_->refresh_icons();
    }
}

} // namespace atrium::ui
