#include "ui/tools/transform_tool.h"

#include "ui/document/engine_text.h"
#include "ui/document/placement.h"

#include <QCoreApplication>
#include <QLocale>

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr double kFine = 0.1;

QString tr(const char* text) { return QCoreApplication::translate("Tools", text); }

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
    if (kind_ == GizmoKind::Scale || host_.snapping().own_axes) {
        out.axes = world_axes(scene.world_matrix(nodes.back()));
    }
    return out;
}

Handle TransformTool::handle_at(const dvec2& point) const {
    const auto g = has_handles() ? gizmo() : std::nullopt;
    return g ? g->at(host_.camera(), point) : Handle::None;
}

bool TransformTool::in_selection(NodeId node) const {
    const Scene& scene = host_.document().scene();
    for (NodeId id = node; id; id = scene.nodes.find(id)->parent) {
        if (host_.document().selection()->contains(id)) {
            return true;
        }
    }
    return false;
}

void TransformTool::press(const Pointer& pointer) {
    typed_.clear();
    press_point_ = pointer.position;
    const Handle handle = handle_at(pointer.position);
    if (handle != Handle::None && begin(handle, pointer.position, std::nullopt)) {
        return;
    }
    press_hit_ = host_.pick(pointer.position);
    if (press_hit_ && drags_body(press_hit_->node, pointer)) {
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
    if (body) {
        drag->gizmo.axes = dmat3(1.0); // the floor has no axes but the world's
    }
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
        if (!in_selection(press_hit_->node)) {
            host_.document().selection()->set({press_hit_->node});
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
            host_.show_message(error_message(done.error()));
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
    const Handle handle = handle_at(pointer.position);
    const bool changed = handle != hovered_;
    hovered_ = handle;
    return changed;
}

void TransformTool::draw(OverlayBatch& batch) const {
    SelectTool::draw(batch);
    for (const auto& [a, b] : hints_) {
        batch.line3(host_.camera(), a, b, 2.0, vec4(1.0F, 0.62F, 0.1F, 0.95F));
    }
    auto g = has_handles() ? gizmo() : std::nullopt;
    if (!g) {
        return;
    }
    if (drag_ && kind_ != GizmoKind::Move) {
        g->origin = drag_->gizmo.origin;
        g->axes = drag_->gizmo.axes;
    }
    g->draw(batch, host_.camera(), drag_ ? drag_->handle : hovered_, drag_ != nullptr);
}

} // namespace atrium::ui
