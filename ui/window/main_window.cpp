#include "ui/window/main_window.h"

#include "ui/actions/actions.h"
#include "ui/actions/edit_controller.h"
#include "ui/panels/caustic_panel.h"
#include "ui/panels/convergence_panel.h"
#include "ui/panels/properties_panel.h"
#include "ui/panels/scene_tree_panel.h"
#include "ui/viewport/viewport_widget.h"
#include "ui/window/daylight_bar.h"
#include "ui/window/false_color_bar.h"
#include "ui/window/file_controller.h"
#include "ui/window/import_bar.h"
#include "ui/window/notice_bar.h"
#include "ui/window/overlay_controller.h"
#include "ui/window/photometry_controller.h"
#include "ui/window/settings.h"
#include "ui/window/start_page.h"

#include <QDockWidget>
#include <QFileInfo>
#include <QStackedWidget>
#include <QStatusBar>
#include <QVBoxLayout>

namespace atrium::ui {

namespace {

constexpr int kMessageMs = 6000;

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
    autosave_notice_ = new NoticeBar("autosave_notice");
    images_notice_ = new NoticeBar("images_notice");
    layout->addWidget(autosave_notice_);
    layout->addWidget(images_notice_);
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

void MainWindow::connect_documents() {
    connect(&document_, &Document::path_changed, this, &MainWindow::update_title);
    connect(&document_, &Document::path_changed, this, &MainWindow::update_actions);
    connect(files_, &FileController::read_only_changed, this, &MainWindow::update_title);
    connect(document_.undo_stack(), &QUndoStack::cleanChanged, this, &MainWindow::update_title);
    connect(document_.undo_stack(), &QUndoStack::indexChanged, this, &MainWindow::update_actions);
    connect(document_.undo_stack(), &QUndoStack::cleanChanged, this, &MainWindow::update_actions);
    connect(document_.selection(), &Selection::changed, this, &MainWindow::update_actions);
    connect(&document_, &Document::reset_done, this, &MainWindow::update_actions);
    connect(engine_, &EngineLink::status_changed, this, &MainWindow::update_actions);
}

void MainWindow::update_title() {
    const QString name = document_.path().isEmpty() ? tr("Untitled") : QFileInfo(document_.path()).fileName();
    setWindowTitle(files_->read_only() ? tr("%1[*] (read-only) - Atrium").arg(name) : tr("%1[*] - Atrium").arg(name));
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
    (*actions_)[ActionId::Revert]->setEnabled(!document_.path().isEmpty());
    (*actions_)[ActionId::ExportPicture]->setEnabled(bool(engine_->solution()));
}

void MainWindow::update_page() {
    if (!document_.scene().nodes.empty() || !document_.path().isEmpty()) {
        started_ = true;
    }
    pages_->setCurrentWidget(started_ ? static_cast<QWidget*>(viewport_) : start_);
}

void MainWindow::changeEvent(QEvent* event) {
    QMainWindow::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && actions_ != nullptr) {
        actions_->refresh_icons();
    }
}

} // namespace atrium::ui
