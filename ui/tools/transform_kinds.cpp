// The three ways to transform: how far the mouse has come, in steps, and what becomes of an object then.
#include "ui/tools/transform_tool.h"

#include <QCoreApplication>
#include <QLocale>

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr double kSnapPixels = 9.0; ///< a face as near as this on the screen is met
constexpr double kSnapNear = 0.5;   ///< metres beside the object within which faces count
constexpr double kSmallestFactor = 0.01;

QString tr(const char* text) { return QCoreApplication::translate("Tools", text); }

const char* axis_name(int axis) { return axis == 0 ? "x" : (axis == 1 ? "y" : "z"); }

} // namespace

// ---- move ----

std::optional<dvec3> MoveTool::measure(const Drag& drag, const Ray& ray, const dvec2& /*point*/) const {
    const int axis = handle_axis(drag.handle);
    if (axis >= 0 && !is_plane(drag.handle)) {
        const auto t = nearest_on_axis(ray, drag.gizmo.origin, drag.gizmo.axes[axis]);
        dvec3 out(0.0);
        out[axis] = t.value_or(0.0);
        return t ? std::optional(out) : std::nullopt;
    }
    const auto hit = meet_plane(ray, drag.grabbed, drag.normal);
    if (!hit || glm::length(*hit - ray.origin) > 1e4) {
        return std::nullopt;
    }
    return glm::transpose(drag.gizmo.axes) * (*hit - drag.grabbed);
}

dvec3 MoveTool::snapped(const Drag& drag, const dvec3& amount) {
    const double grid = host_.snapping().grid;
    dvec3 out = glm::round(amount / grid) * grid;
    if (drag.bounds.empty() || drag.gizmo.axes != dmat3(1.0)) {
        return out; // faces are met along the world's axes
    }
    const DBox3 moving{drag.bounds.min + amount, drag.bounds.max + amount};
    const double reach = kSnapPixels * host_.camera().pixel_size(moving.centre());
    const auto faces = snap_to_faces(moving, drag.others, reach, kSnapNear);
    const int handle = handle_axis(drag.handle);
    for (int axis = 0; axis < 3; ++axis) {
        const bool along = handle < 0 ? std::abs(drag.normal[axis]) < 0.999 : (handle == axis) != is_plane(drag.handle);
        const auto& face = faces[std::size_t(axis)];
        if (!along || !face) {
            continue;
        }
        out[axis] = amount[axis] + face->shift;
        // The line lies in the met plane and reaches over both boxes.
        const int level = axis == 0 ? 2 : 0;
        dvec3 a = moving.centre();
        a.y = moving.min.y;
        a[axis] = face->plane;
        dvec3 b = a;
        a[level] = std::min(moving.min[level], face->other.min[level]);
        b[level] = std::max(moving.max[level], face->other.max[level]);
        hints_.emplace_back(a, b);
        hint_text_ += tr("   flush in %1").arg(QLatin1String(axis_name(axis)));
    }
    return out;
}

dvec3 MoveTool::from_number(const Drag& drag, double value) const {
    const int axis = handle_axis(drag.handle);
    if (axis >= 0 && !is_plane(drag.handle)) {
        dvec3 out(0.0);
        out[axis] = value;
        return out;
    }
    const double length = glm::length(drag.amount);
    return length > 1e-9 ? drag.amount * (value / length) : dvec3(value, 0.0, 0.0);
}

Transform MoveTool::moved(const Drag& drag, const Target& target, const dvec3& amount) const {
    Transform out = target.start;
    out.translation += dvec3(target.parent_inverse * dvec4(drag.gizmo.axes * amount, 0.0));
    return out;
}

QString MoveTool::read_out(const Drag& /*drag*/, const dvec3& amount) const {
    QStringList parts;
    for (int i = 0; i < 3; ++i) {
        if (std::abs(amount[i]) >= 0.0005) {
            parts << QStringLiteral("%1 %2 m").arg(QLatin1String(axis_name(i)), number(amount[i], 2));
        }
    }
    return parts.isEmpty() ? QStringLiteral("+0 m") : parts.join(QStringLiteral(", "));
}

QString MoveTool::undo_text() const { return tr("Move"); }

// ---- rotate ----

std::optional<dvec3> RotateTool::measure(const Drag& drag, const Ray& ray, const dvec2& point) const {
    const dvec3 to_eye = glm::normalize(host_.camera().eye() - drag.gizmo.origin);
    if (std::abs(glm::dot(drag.normal, to_eye)) < 0.17) {
        // Edge on the ring is a line: the mouse along it turns it, 200 pixels to the radian.
        const dvec3 along = glm::cross(drag.normal, to_eye);
        const auto a = host_.camera().project(drag.gizmo.origin);
        const double step = 100.0 * host_.camera().pixel_size(drag.gizmo.origin);
        const auto b = host_.camera().project(drag.gizmo.origin + along * step);
        if (!a || !b || glm::length(*b - *a) < 1.0) {
            return std::nullopt;
        }
        return dvec3(glm::dot(point, glm::normalize(*b - *a)) / 200.0, 0.0, 0.0);
    }
    const auto hit = meet_plane(ray, drag.gizmo.origin, drag.normal);
    if (!hit) {
        return std::nullopt;
    }
    const dvec3 arm = *hit - drag.gizmo.origin;
    if (!(glm::length(arm) > 1e-9)) {
        return std::nullopt;
    }
    // Relative to a fixed direction in the plane, unwrapped so that a drag can go round more than once.
    const dvec3 helper = std::abs(drag.normal.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
    const double angle = angle_about(drag.normal, glm::normalize(glm::cross(drag.normal, helper)), arm);
    if (!drag.has_raw) {
        return dvec3(angle, 0.0, 0.0);
    }
    return dvec3(drag.last_raw.x + std::remainder(angle - drag.last_raw.x, 2.0 * kPiD), 0.0, 0.0);
}

dvec3 RotateTool::snapped(const Drag& /*drag*/, const dvec3& amount) {
    const double step = host_.snapping().angle;
    return {std::round(amount.x / step) * step, 0.0, 0.0};
}

dvec3 RotateTool::from_number(const Drag& /*drag*/, double value) const { return {radians_from_degrees(value), 0.0, 0.0}; }

Transform RotateTool::moved(const Drag& drag, const Target& target, const dvec3& amount) const {
    const dquat turn = glm::angleAxis(amount.x, drag.normal);
    const dquat parent = decompose(target.parent).rotation;
    Transform out = target.start;
    const dvec3 place(target.parent * dvec4(target.start.translation, 1.0));
    const dvec3 turned = drag.gizmo.origin + turn * (place - drag.gizmo.origin);
    out.translation = dvec3(target.parent_inverse * dvec4(turned, 1.0));
    // World turn seen from the parent. Exact below rotations and even scales; below an uneven one the shape keeps its
    // scale instead of shearing.
    out.rotation = glm::normalize(glm::inverse(parent) * turn * parent * target.start.rotation);
    return out;
}

QString RotateTool::read_out(const Drag& drag, const dvec3& amount) const {
    const int axis = handle_axis(drag.handle);
    const QString angle = number(degrees_from_radians(amount.x), 1) + QChar(0x00B0);
    return axis >= 0 ? QStringLiteral("%1 %2").arg(QLatin1String(axis_name(axis)), angle) : angle;
}

QString RotateTool::undo_text() const { return tr("Rotate"); }

// ---- scale ----

std::optional<dvec3> ScaleTool::measure(const Drag& drag, const Ray& ray, const dvec2& point) const {
    const int axis = handle_axis(drag.handle);
    if (axis < 0) {
        const auto centre = host_.camera().project(drag.gizmo.origin);
        return centre ? std::optional(dvec3((point.x - centre->x) / 100.0)) : std::nullopt;
    }
    const auto t = nearest_on_axis(ray, drag.gizmo.origin, drag.gizmo.axes[axis]);
    if (!t) {
        return std::nullopt;
    }
    // The handle's own length is factor one, so that grabbing it near the middle does not make it jump.
    dvec3 out(0.0);
    out[axis] = *t / (Gizmo::kLength * host_.camera().pixel_size(drag.gizmo.origin));
    return out;
}

dvec3 ScaleTool::snapped(const Drag& /*drag*/, const dvec3& amount) {
    const double step = host_.snapping().factor;
    return glm::round(amount / step) * step;
}

dvec3 ScaleTool::from_number(const Drag& drag, double value) const {
    const int axis = handle_axis(drag.handle);
    dvec3 out(0.0);
    if (axis < 0) {
        return dvec3(value - 1.0);
    }
    out[axis] = value - 1.0;
    return out;
}

Transform ScaleTool::moved(const Drag& drag, const Target& target, const dvec3& amount) const {
    const dvec3 factor = glm::max(dvec3(1.0) + amount, dvec3(kSmallestFactor));
    Transform out = target.start;
    out.scale *= factor;
    const dvec3 place(target.parent * dvec4(target.start.translation, 1.0));
    const dvec3 arm = glm::transpose(drag.gizmo.axes) * (place - drag.gizmo.origin);
    const dvec3 scaled = drag.gizmo.origin + drag.gizmo.axes * (arm * factor);
    out.translation = dvec3(target.parent_inverse * dvec4(scaled, 1.0));
    return out;
}

QString ScaleTool::read_out(const Drag& drag, const dvec3& amount) const {
    const int axis = handle_axis(drag.handle);
    const double factor = std::max(1.0 + amount[std::max(axis, 0)], kSmallestFactor);
    const QString text = QChar(0x00D7) + QLocale().toString(factor, 'f', 2);
    return axis >= 0 ? QStringLiteral("%1 %2").arg(QLatin1String(axis_name(axis)), text) : text;
}

QString ScaleTool::undo_text() const { return tr("Scale"); }

} // namespace atrium::ui
