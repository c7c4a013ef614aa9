#include "ui/tools/transform_tool.h"

#include "ui/document/placement.h"

#include <QCoreApplication>
#include <QLocale>

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr double kSnapPixels = 9.0; ///< a face as near as this on the screen is met
constexpr double kSnapNear = 0.5;   ///< metres beside the object within which faces count
constexpr double kSmallestFactor = 0.01;
constexpr double kFine = 0.1;

QString tr(const char* text) { return QCoreApplication::translate("Tools", text); }

const char* axis_name(int axis) { return axis == 0 ? "x" : (axis == 1 ? "y" : "z"); }

bool is_plane(Handle handle) { return handle == Handle::PlaneX || handle == Handle::PlaneY || handle == Handle::PlaneZ; }

/// A node's own axes in the world, made orthogonal.
dmat3 world_axes(const dmat4& world) {
    dmat3 out(1.0);
    const dvec3 x(world[0]);
    const dvec3 y(world[1]);
    if (glm::length(glm::cross(x, y)) > 1e-12) {
        out[0] = glm::normalize(x);
        out[2] = glm::normalize(glm::cross(x, y));
        out[1] = glm::cross(out[2], out[0]);
    }
    return out;
}

dvec3 pivot_of(const Scene& scene, NodeId id) {
    const dvec3 origin(scene.world_matrix(id)[3]);
    const DBox3 box = scene.subtree_bounds(id);
    if (box.empty()) {
        return origin;
    }
    // Files often keep every node's origin at zero, far from what is drawn.
    const dvec3 margin(0.05 * box.diagonal() + 1e-3);
    const bool inside =
        glm::all(glm::greaterThanEqual(origin, box.min - margin)) && glm::all(glm::lessThanEqual(origin, box.max + margin));
    return inside ? origin : box.centre();
}

} // namespace

QString TransformTool::number(double value, int decimals) {
    const QString text = QLocale().toString(std::abs(value), 'f', decimals);
    // A true minus sign; nothing reads "-0.00".
    const bool negative = value < 0 && std::abs(value) >= 0.5 * std::pow(10.0, -decimals);
    return (negative ? QString(QChar(0x2212)) : QStringLiteral("+")) + text;
}

std::vector<NodeId> TransformTool::targets() const {
    const Scene& scene = host_.document().scene();
    std::vector<NodeId> out;
    for (const NodeId id : host_.document().selection()->top_level(scene)) {
        bool locked = false;
        for (const Node* n = scene.nodes.find(id); n != nullptr; n = scene.nodes.find(n->parent)) {
            locked = locked || n->locked;
        }
        if (!locked && scene.nodes.contains(id)) {
            out.push_back(id);
        }
    }
    return out;
}

std::optional<Gizmo> TransformTool::gizmo() const {
    const std::vector<NodeId> nodes = targets();
    if (nodes.empty()) {
        return std::nullopt;
    }
    const Scene& scene = host_.document().scene();
    Gizmo out;
    out.kind = kind_;
    if (nodes.size() == 1) {
        out.origin = pivot_of(scene, nodes.front());
    } else {
        DBox3 box;
        for (const NodeId id : nodes) {
            box.add(pivot_of(scene, id));
        }
        out.origin = box.centre();
    }
    if (kind_ == GizmoKind::Scale) {
        out.axes = world_axes(scene.world_matrix(nodes.back()));
    }
    return out;
}

void TransformTool::press(const Pointer& pointer) {
    typed_.clear();
    press_point_ = pointer.position;
    const auto g = gizmo();
    const Handle handle = g ? g->at(host_.camera(), pointer.position) : Handle::None;
    if (handle != Handle::None && begin(handle, pointer.position, std::nullopt)) {
        return;
    }
    press_hit_ = host_.pick(pointer.position);
    if (press_hit_ && drags_bodies()) {
        armed_ = true;
        return;
    }
    SelectTool::press(pointer);
}

bool TransformTool::begin(Handle handle, const dvec2& point, std::optional<dvec3> body) {
    const Scene& scene = host_.document().scene();
    const auto g = gizmo();
    if (!g) {
        if (!host_.document().selection()->nodes().empty()) {
            host_.show_message(tr("The selection is locked: unlock it to change its place"));
        }
        return false;
    }
    auto drag = std::make_unique<Drag>();
    drag->gizmo = *g;
    drag->handle = handle;
    for (const NodeId id : targets()) {
        const Node* node = scene.nodes.find(id);
        Target target{id, node->transform, scene.world_matrix(node->parent), dmat4(1.0)};
        if (!(std::abs(glm::determinant(dmat3(target.parent))) > 0.0)) {
            continue; // a parent scaled to nothing: no placement answers the mouse
        }
        target.parent_inverse = glm::inverse(target.parent);
        drag->targets.push_back(target);
    }
    if (drag->targets.empty()) {
        return false;
    }
    const CameraController& camera = host_.camera();
    const Ray ray = camera.ray(point);
    const int axis = handle_axis(handle);
    if (body) {
        // The object slides on its floor; looked at nearly level, it moves in the picture plane instead.
        drag->grabbed = *body;
        drag->normal = std::abs(ray.direction.y) > 0.12 ? dvec3(0, 1, 0) : -camera.forward();
    } else if (axis >= 0) {
        drag->normal = drag->gizmo.axes[axis];
        drag->grabbed = drag->gizmo.origin;
    } else {
        drag->normal = -camera.forward();
        drag->grabbed = drag->gizmo.origin;
    }
    if (const auto hit = meet_plane(ray, drag->grabbed, drag->normal); hit && (is_plane(handle) || axis < 0)) {
        drag->grabbed = *hit;
    }
    drag->last_point = point;
    drag->body = body.has_value();
    remember_bounds(*drag);
    drag->gesture = std::make_unique<Gesture>(host_.document(), undo_text());
    drag_ = std::move(drag);
    // What the first position measures is zero by definition.
    if (const auto raw = measure(*drag_, ray, point)) {
        drag_->last_raw = *raw;
        drag_->has_raw = true;
    }
    return true;
}

void TransformTool::remember_bounds(Drag& drag) const {
    const Scene& scene = host_.document().scene();
    for (const Target& target : drag.targets) {
        for (const NodeId id : scene.in_tree_order(target.node)) {
            drag.own.insert(id);
        }
    }
    const dvec3 origin(scene.world_matrix(drag.targets.front().node)[3]);
    for (const ViewItem& item : host_.view_scene().items()) {
        if (!drag.own.contains(item.node)) {
            drag.others.push_back(item.bounds);
            continue;
        }
        drag.bounds.add(item.bounds);
        const Box3& local = item.bvh->bounds();
        for (int corner = 0; corner < 8; ++corner) {
            const dvec3 p((corner & 1) != 0 ? local.max.x : local.min.x, (corner & 2) != 0 ? local.max.y : local.min.y,
                          (corner & 4) != 0 ? local.max.z : local.min.z);
            drag.corners.push_back(dvec3(item.world * dvec4(p, 1.0)) - origin);
        }
    }
}

/// Puts what is dragged on the surface under the cursor; false where there is none.
bool TransformTool::slide(const Pointer& pointer) {
    const PickRules rules{&drag_->own, false};
    const auto hit =
        host_.view_scene().pick(host_.camera().ray(pointer.position), std::numeric_limits<double>::infinity(), rules);
    if (!hit || drag_->corners.empty()) {
        return false;
    }
    const Snapping& snapping = host_.snapping();
    const dvec3& normal = hit->normal;
    const Target& first = drag_->targets.front();
    const dmat4 start = first.parent * first.start.matrix();
    dquat turn(1.0, 0.0, 0.0, 0.0);
    if (snapping.turn_to_surface && drag_->targets.size() == 1) {
        const dvec3 own_up = glm::normalize(dvec3(start[1]));
        turn = turn_to_face(normal) * glm::inverse(turn_to_face(own_up));
    }
    DBox3 box; // turned, about the target's origin
    double support = std::numeric_limits<double>::infinity();
    for (const dvec3& corner : drag_->corners) {
        const dvec3 p = turn * corner;
        box.add(p);
        support = std::min(support, glm::dot(p, normal));
    }
    // The middle of the box over the point, its lowest corner in the plane.
    const dvec3 middle = box.centre() - normal * glm::dot(box.centre(), normal);
    dvec3 origin = hit->point - middle - normal * support;
    if (!drag_->slide_from) {
        drag_->slide_from = normal;
        const dvec3 gap = dvec3(start[3]) - origin;
        drag_->slide_offset = gap - normal * glm::dot(gap, normal);
    }
    // It keeps under the hand as it was grabbed while the surface keeps its direction.
    if (glm::dot(*drag_->slide_from, normal) > 0.99) {
        origin += drag_->slide_offset;
    }
    dvec3 amount = origin - dvec3(start[3]);
    if (snapping.on != pointer.modifiers.testFlag(Qt::ControlModifier)) {
        const dvec3 along = amount - normal * glm::dot(amount, normal);
        const dvec3 steps = glm::round(along / snapping.grid) * snapping.grid;
        amount += (steps - normal * glm::dot(steps, normal)) - along;
    }
    drag_->amount = amount;
    drag_->has_raw = false; // off the surfaces it goes on from here
    if (drag_->targets.size() > 1 || turn == dquat(1.0, 0.0, 0.0, 0.0)) {
        apply(amount);
        return true;
    }
    dmat4 turned = glm::mat4_cast(turn) * start;
    turned[3] = dvec4(dvec3(start[3]) + amount, 1.0);
    const Transform next = decompose(first.parent_inverse * turned);
    (void)host_.document().apply(SceneEdit{SetTransform{first.node, next}}, undo_text());
    host_.show_message(read_out(*drag_, amount));
    return true;
}

void TransformTool::move(const Pointer& pointer) {
    if (armed_ && glm::length(pointer.position - press_point_) > kClickRadius) {
        armed_ = false;
        Selection* selection = host_.document().selection();
        bool selected = false;
        for (NodeId id = press_hit_->node; id; id = host_.document().scene().nodes.find(id)->parent) {
            selected = selected || selection->contains(id);
        }
        if (!selected) {
            selection->set({press_hit_->node});
        }
        begin(Handle::Centre, press_point_, press_hit_->point);
    }
    if (!drag_) {
        SelectTool::move(pointer);
        return;
    }
    hints_.clear();
    hint_text_.clear();
    if (drag_->body && typed_.isEmpty() && host_.snapping().on_surfaces && slide(pointer)) {
        drag_->last_point = pointer.position;
        return;
    }
    const auto raw = measure(*drag_, host_.camera().ray(pointer.position), pointer.position);
    if (raw) {
        if (drag_->has_raw) {
            const bool fine = pointer.modifiers.testFlag(Qt::ShiftModifier);
            drag_->amount += (*raw - drag_->last_raw) * (fine ? kFine : 1.0);
        }
        drag_->last_raw = *raw;
        drag_->has_raw = true;
    }
    drag_->last_point = pointer.position;
    if (typed_.isEmpty()) {
        const bool snap = host_.snapping().on != pointer.modifiers.testFlag(Qt::ControlModifier);
        apply(snap ? snapped(*drag_, drag_->amount) : drag_->amount);
    }
}

void TransformTool::apply(const dvec3& amount) {
    for (const Target& target : drag_->targets) {
        const Transform next = moved(*drag_, target, amount);
        const auto done = host_.document().apply(SceneEdit{SetTransform{target.node, next}}, undo_text());
        if (!done) {
            host_.show_message(QString::fromStdString(done.error().message()));
            return;
        }
    }
    host_.show_message(typed_.isEmpty() ? read_out(*drag_, amount) + hint_text_
                                        : read_out(*drag_, amount) + QStringLiteral("   [%1]").arg(typed_));
}

void TransformTool::finish() {
    if (drag_) {
        drag_->gesture->commit();
        drag_.reset();
    }
    typed_.clear();
    hints_.clear();
    hint_text_.clear();
}

void TransformTool::release(const Pointer& pointer) {
    if (drag_) {
        if (typed_.isEmpty()) {
            move(pointer);
        }
        finish();
    } else if (armed_) {
        armed_ = false;
        click({press_point_, pointer.modifiers});
    } else {
        SelectTool::release(pointer);
    }
}

void TransformTool::cancel() {
    const bool dragged = drag_ != nullptr;
    drag_.reset(); // the gesture rolls back
    armed_ = false;
    typed_.clear();
    hints_.clear();
    hint_text_.clear();
    SelectTool::cancel();
    if (dragged) {
        host_.show_message(tr("Cancelled"));
    }
}

bool TransformTool::key(int key, const QString& text) {
    if (!drag_) {
        return false;
    }
    if (key == Qt::Key_Return || key == Qt::Key_Enter) {
        finish();
        return true;
    }
    if (key == Qt::Key_Backspace) {
        typed_.chop(1);
    } else if (text.size() == 1 && (text[0].isDigit() || QStringLiteral("+-.,").contains(text[0]))) {
        // Both decimal signs are good; QLocale would take only one of them.
        typed_ += text[0] == QLatin1Char(',') ? QLatin1Char('.') : text[0];
    } else {
        return false;
    }
    bool good = false;
    const double value = QLocale::c().toDouble(typed_, &good);
    if (good) {
        apply(from_number(*drag_, value));
    } else if (typed_.isEmpty()) {
        apply(drag_->amount);
    } else {
        host_.show_message(QStringLiteral("[%1]").arg(typed_));
    }
    return true;
}

bool TransformTool::hover(const Pointer& pointer) {
    const auto g = gizmo();
    const Handle handle = g ? g->at(host_.camera(), pointer.position) : Handle::None;
    const bool changed = handle != hovered_;
    hovered_ = handle;
    return changed;
}

void TransformTool::draw(OverlayBatch& batch) const {
    SelectTool::draw(batch);
    for (const auto& [a, b] : hints_) {
        batch.line3(host_.camera(), a, b, 2.0, vec4(1.0F, 0.62F, 0.1F, 0.95F));
    }
    auto g = gizmo();
    if (!g) {
        return;
    }
    if (drag_ && kind_ != GizmoKind::Move) {
        g->origin = drag_->gizmo.origin;
        g->axes = drag_->gizmo.axes;
    }
    g->draw(batch, host_.camera(), drag_ ? drag_->handle : hovered_, drag_ != nullptr);
}

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
    if (drag.bounds.empty()) {
        return out;
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
