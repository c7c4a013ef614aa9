// The window's wiring of what the view shows: tools, exposure, shares of the light, caustics, false colour.
#include "ui/actions/actions.h"
#include "ui/panels/caustic_panel.h"
#include "ui/viewport/viewport_widget.h"
#include "ui/window/false_color_bar.h"
#include "ui/window/help_dialogs.h"
#include "ui/window/main_window.h"
#include "ui/window/main_window_tables.h"
#include "ui/window/settings.h"

#include <algorithm>
#include <array>

#include <QActionGroup>
#include <QClipboard>
#include <QGuiApplication>

namespace atrium::ui {
namespace {

constexpr float kExposureStep = 1.0F / 3.0F;

} // namespace

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

} // namespace atrium::ui
