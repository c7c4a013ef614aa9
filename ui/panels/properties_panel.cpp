#include "ui/panels/properties_panel.h"

#include "ui/panels/light_sections.h"
#include "ui/panels/material_section.h"
#include "ui/panels/node_sections.h"
#include "ui/panels/placement_section.h"

#include <QVBoxLayout>

namespace atrium::ui {

PropertiesPanel::PropertiesPanel(Document& document, QWidget* parent) : QScrollArea(parent), document_(document) {
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setMinimumWidth(386); // three number fields side by side with their label
    auto* content = new QWidget;
    auto* layout = new QVBoxLayout(content);
    layout->setContentsMargins(10, 8, 10, 8);
    layout->setSpacing(8);
    auto* camera = new CameraSection(document);
    auto* light = new LightSection(document);
    sections_ = {new SceneSection(document),
                 new NodeSection(document),
                 new PlacementSection(document),
                 new ShapeSection(document),
                 light,
                 camera,
                 new MaterialSection(document)};
    for (Section* section : sections_) {
        layout->addWidget(section);
        connect(section, &Section::message, this, &PropertiesPanel::message);
    }
    layout->addStretch(1);
    setWidget(content);
    connect(camera, &CameraSection::look_through, this, &PropertiesPanel::look_through);
    connect(light, &LightSection::choose_photometry, this, &PropertiesPanel::choose_photometry);
    connect(&document_, &Document::edited, this, &PropertiesPanel::refresh_soon);
    connect(&document_, &Document::reset_done, this, &PropertiesPanel::refresh);
    connect(document_.selection(), &Selection::changed, this, &PropertiesPanel::refresh);
    refresh();
}

void PropertiesPanel::refresh_soon() {
    if (!queued_) {
        queued_ = true;
        QMetaObject::invokeMethod(
            this,
            [this] {
                queued_ = false;
                refresh();
            },
            Qt::QueuedConnection);
    }
}

void PropertiesPanel::refresh() {
    for (Section* section : sections_) {
        section->refresh();
    }
}

} // namespace atrium::ui
