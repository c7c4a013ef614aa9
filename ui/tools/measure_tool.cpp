#include "ui/tools/measure_tool.h"

#include <QCoreApplication>

namespace atrium::ui {

void MeasureTool::press(const Pointer& pointer) {
    pressed_ = pointer.position;
    cursor_ = pointer.position;
}

void MeasureTool::move(const Pointer& pointer) { cursor_ = pointer.position; }

void MeasureTool::release(const Pointer& pointer) {
    const bool click = pressed_ && glm::length(pointer.position - *pressed_) <= kClickRadius;
    pressed_.reset();
    if (!click) {
        return;
    }
    MeasuringPoints& points = host_.measuring_points();
    if (const MeasuringPoints::Point* point = points.at(host_.camera(), pointer.position)) {
        points.remove(point->number);
        return;
    }
    if (const auto reading = host_.read_light(pointer.position)) {
        points.add(host_.document().scene(), *reading);
    } else {
        host_.show_message(
            QCoreApplication::translate("MeasureTool", "Light is measured on matt surfaces, once there is some."));
    }
}

bool MeasureTool::hover(const Pointer& pointer) {
    cursor_ = pointer.position;
    return true;
}

} // namespace atrium::ui
