// The window's panels: which there are, where they stand and what a click in them leads to.
#include "ui/actions/icons.h"
#include "ui/panels/caustic_panel.h"
#include "ui/panels/caustic_places.h"
#include "ui/panels/convergence_panel.h"
#include "ui/panels/jobs_panel.h"
#include "ui/panels/problems_panel.h"
#include "ui/panels/properties_panel.h"
#include "ui/panels/scene_tree_panel.h"
#include "ui/viewport/viewport_widget.h"
#include "ui/window/main_window.h"

#include <QDockWidget>
#include <QToolButton>

namespace atrium::ui {

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
    auto* jobs = new JobsPanel(document_, *engine_);
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

    connect(engine_, &EngineLink::solution_changed, problems, [this, problems] {
        const auto solution = engine_->solution();
        problems->set_light_warning(solution ? lowered_by_memory_text(solution->statistics) : QString());
    });
    connect(jobs, &JobsPanel::message, this, &MainWindow::say);
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

} // namespace atrium::ui
