#include "ui/window/overlay_controller.h"

#include "ui/viewport/viewport_widget.h"

#include <QMenu>

#include <array>

namespace atrium::ui {
namespace {

/// Those that need Solution::insides.
constexpr std::array kOfInsides{ActionId::ElementMesh, ActionId::ElementLinks, ActionId::SubdivisionLevel,
                                ActionId::LinkDensity, ActionId::ParticleWays, ActionId::PassageOctree};
/// Those that cover surfaces: one of them at a time.
constexpr std::array kColors{ActionId::SubdivisionLevel, ActionId::LinkDensity, ActionId::ErrorEstimate};

} // namespace

OverlayController::OverlayController(const Actions& actions, EngineLink& engine, ViewportWidget& viewport, QObject* parent)
    : QObject(parent), actions_(actions), engine_(engine), viewport_(viewport) {
    for (const ActionId id : kOfInsides) {
        connect(actions_[id], &QAction::toggled, this, &OverlayController::apply);
    }
    for (const ActionId id : {ActionId::LastUpdate, ActionId::ErrorEstimate, ActionId::Histogram}) {
        connect(actions_[id], &QAction::toggled, this, &OverlayController::apply);
    }
    for (const ActionId id : kColors) {
        connect(actions_[id], &QAction::toggled, this, [this, id](bool on) {
            for (const ActionId other : kColors) {
                if (on && other != id) {
                    actions_[other]->setChecked(false);
                }
            }
        });
    }
    connect(&engine_, &EngineLink::solution_changed, this, &OverlayController::refresh);
    refresh();
}

void OverlayController::fill(QMenu* menu) const {
    menu->setToolTipsVisible(true);
    for (const ActionId id : {ActionId::ElementMesh, ActionId::ElementLinks, ActionId::SubdivisionLevel,
                              ActionId::LinkDensity, ActionId::ErrorEstimate, ActionId::Histogram, ActionId::ParticleWays,
                              ActionId::PassageOctree, ActionId::LastUpdate}) {
        menu->addAction(actions_[id]);
    }
}

QString OverlayController::refusal() const {
    const auto solution = engine_.solution();
    if (!solution) {
        return tr("No light has been computed yet.");
    }
    if (solution->updatable) {
        return {};
    }
    return solution->final ? tr("This light was read from the project, which does not keep elements and links. It can be "
                                "looked into after the next change of the scene.")
                           : tr("The light is still being computed; its elements can be looked at when it is complete.");
}

void OverlayController::refresh() {
    const QString why = refusal();
    for (const ActionId id : kOfInsides) {
        QAction* action = actions_[id];
        action->setEnabled(why.isEmpty() || action->isChecked()); // what is on can always be turned off
        const QString key = action->shortcut().toString(QKeySequence::NativeText);
        const QString tip = key.isEmpty() ? action->statusTip() : QStringLiteral("%1 (%2)").arg(action->statusTip(), key);
        action->setToolTip(action->isEnabled() ? tip : why);
    }
}

void OverlayController::apply() {
    const auto on = [this](ActionId id) { return actions_[id]->isChecked(); };
    InspectionChoice choice;
    choice.elements = on(ActionId::ElementMesh);
    choice.links = on(ActionId::ElementLinks);
    choice.ways = on(ActionId::ParticleWays);
    choice.octree = on(ActionId::PassageOctree);
    choice.last_update = on(ActionId::LastUpdate);
    choice.histogram = on(ActionId::Histogram);
    choice.colors = on(ActionId::ErrorEstimate)      ? ElementColors::Error
                    : on(ActionId::SubdivisionLevel) ? ElementColors::Level
                    : on(ActionId::LinkDensity)      ? ElementColors::Links
                                                     : ElementColors::None;
    viewport_.set_inspection(choice);
    engine_.keep_insides(choice.needs_insides());
    refresh();
}

} // namespace atrium::ui
