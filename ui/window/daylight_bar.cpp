#include "ui/window/daylight_bar.h"

#include "engine/scene/daylight.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

namespace atrium::ui {

DaylightBar::DaylightBar(Document& document, QWidget* parent) : QFrame(parent), document_(document) {
    setObjectName(QStringLiteral("daylight_bar"));
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::AlternateBase);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(10, 4, 10, 4);
    auto* text =
        new QLabel(tr("Nothing in this scene gives light. Until something does, it is shown in a neutral working light."));
    text->setWordWrap(true);
    auto* add = new QPushButton(tr("Add &Daylight"));
    add->setObjectName(QStringLiteral("daylight_add"));
    add->setToolTip(tr("Add a sun and a uniform sky; one step to undo"));
    auto* keep = new QPushButton(tr("&Not Now"));
    keep->setObjectName(QStringLiteral("daylight_keep"));
    layout->addWidget(text, 1);
    layout->addWidget(add);
    layout->addWidget(keep);
    connect(add, &QPushButton::clicked, this, &DaylightBar::accepted);
    connect(keep, &QPushButton::clicked, this, [this] {
        declined_ = true;
        hide();
    });
    connect(&document_, &Document::reset_done, this, [this] {
        declined_ = false;
        update_offer();
    });
    connect(&document_, &Document::edited, this, &DaylightBar::update_offer);
    hide();
}

void DaylightBar::update_offer() {
    // While the mouse holds an object nothing may jump; gestures never add or remove light.
    if (document_.in_gesture()) {
        return;
    }
    const Scene& scene = document_.scene();
    setVisible(!declined_ && !scene.shapes.empty() && has_no_light(scene));
}

} // namespace atrium::ui
