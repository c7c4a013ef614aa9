// Where things go that are put into the view: drops, the library, lamps, falling; and showing some objects alone.
#include "ui/viewport/viewport_impl.h"

#include "ui/document/engine_text.h"
#include "ui/document/insert_commands.h"
#include "ui/document/scene_commands.h"
#include "ui/document/scene_mime.h"
#include "ui/tools/surface.h"

#include <QDragEnterEvent>
#include <QLocale>

#include <algorithm>

namespace atrium::ui {
namespace {

// Of lamps that are put there, metres.
constexpr double kBelowCeiling = 0.02;
constexpr double kBeforeWall = 0.1;

} // namespace

dvec3 ViewportWidget::Impl::lamp_above(const dvec3& floor) const {
    const auto ceiling = view.pick({floor + dvec3(0.0, 0.01, 0.0), dvec3(0.0, 1.0, 0.0)});
    const double room = ceiling ? ceiling->point.y - floor.y - kBelowCeiling : kLampHeight;
    return floor + dvec3(0.0, room > 0.1 ? std::min(kLampHeight, room) : kLampHeight, 0.0);
}

void ViewportWidget::Impl::note_isolated(const SceneEdit& edit) {
    if (!view.isolated()) {
        return;
    }
    if (const auto* group = std::get_if<EditGroup>(&edit.value)) {
        for (const SceneEdit& one : group->edits) {
            note_isolated(one);
        }
    } else if (const auto* added = std::get_if<AddNode>(&edit.value)) {
        auto nodes = *view.isolated();
        nodes.insert(added->id);
        view.set_isolated(std::move(nodes));
    }
}

void ViewportWidget::Impl::isolate(std::optional<std::unordered_set<NodeId>> nodes) {
    if (!nodes && !view.isolated()) {
        return;
    }
    const bool on = nodes.has_value();
    view.set_isolated(std::move(nodes));
    scene_changed();
    Q_EMIT widget.isolated_changed(on);
}

bool ViewportWidget::Impl::answer_drag(QDropEvent* event, bool drop) {
    if (!place_tool.active()) {
        return false;
    }
    sync();
    const Pointer pointer{to_vec(event->position()), event->modifiers()};
    const bool good = drop ? place_tool.drop(pointer) : place_tool.move(pointer);
    set_hovered(place_tool.target());
    widget.update();
    return good;
}

dvec3 ViewportWidget::placement_point() const {
    impl_->sync();
    const CameraController& camera = impl_->controller;
    const Ray ray = camera.ray({0.5 * camera.width(), 0.5 * camera.height()});
    const dvec3 down(0.0, -1.0, 0.0);
    if (const auto hit = impl_->view.pick(ray)) {
        if (hit->normal.y > 0.7) {
            return hit->point;
        }
        // A wall or a ceiling: the floor in front of it.
        const auto floor = impl_->view.pick({hit->point + hit->normal * 0.5 - ray.direction * 0.01, down});
        return floor ? floor->point : hit->point;
    }
    if (const auto ground = meet_plane(ray, dvec3(0.0), dvec3(0.0, 1.0, 0.0));
        ground && glm::length(*ground - ray.origin) < 50.0) {
        return *ground;
    }
    const dvec3 ahead = ray.at(std::min(camera.focus_distance(), 5.0));
    const auto floor = impl_->view.pick({ahead, down});
    return floor ? floor->point : ahead;
}

void ViewportWidget::place(const std::shared_ptr<const LibraryItem>& item) {
    impl_->cancel();
    impl_->sync();
    const CameraController& camera = impl_->controller;
    const Pointer middle{{0.5 * camera.width(), 0.5 * camera.height()}, {}};
    impl_->place_tool.begin(item);
    if (impl_->place_tool.active() && !impl_->place_tool.drop(middle) && item->scene) {
        Q_EMIT message(tr("There is no surface in the middle of the view."));
    }
    update();
}

dmat4 ViewportWidget::placement_for(const DBox3& bounds) const {
    impl_->sync();
    const CameraController& camera = impl_->controller;
    const Ray ray = camera.ray({0.5 * camera.width(), 0.5 * camera.height()});
    const auto found = placement_under(impl_->view, ray, Mount::Stand, bounds, {}, 0.0);
    return found ? *found : place_on(bounds, Mount::Stand, placement_point(), dvec3(0, 1, 0));
}

void ViewportWidget::drop_to_surface() {
    Document& doc = impl_->doc;
    if (doc.in_gesture()) {
        return;
    }
    impl_->sync();
    std::vector<SceneEdit> edits;
    double most = 0;
    std::size_t without = 0;
    for (const NodeId id : doc.selection()->top_level(doc.scene())) {
        const Node* node = doc.scene().nodes.find(id);
        const std::optional<double> found = node->locked ? std::nullopt : fall_distance(impl_->view, doc.scene(), id);
        const double fall = found.value_or(0.0);
        const dmat4 parent = doc.scene().world_matrix(node->parent);
        if (!found || !(std::abs(glm::determinant(dmat3(parent))) > 0.0)) {
            ++without;
            continue;
        }
        Transform next = node->transform;
        next.translation += dvec3(glm::inverse(parent) * dvec4(0.0, -fall, 0.0, 0.0));
        edits.push_back(SceneEdit{SetTransform{id, next}});
        most = std::abs(fall) > std::abs(most) ? fall : most;
    }
    if (edits.empty()) {
        Q_EMIT message(without == 0 ? tr("Select an object first.")
                                    : tr("Nothing lies below the selection, or it is locked."));
        return;
    }
    const auto done = doc.apply(as_one(std::move(edits)), tr("Drop to surface"));
    Q_EMIT message(!done                   ? error_message(done.error())
                   : std::abs(most) < 5e-4 ? tr("The selection rests already.")
                                           : tr("Lowered by %1 m").arg(QLocale().toString(most, 'f', 3)));
}

void ViewportWidget::set_isolated(bool on) {
    if (!on) {
        impl_->isolate(std::nullopt);
        return;
    }
    std::unordered_set<NodeId> nodes;
    for (const NodeId id : impl_->doc.selection()->nodes()) {
        for (const NodeId below : impl_->doc.scene().in_tree_order(id)) {
            nodes.insert(below);
        }
    }
    if (nodes.empty()) {
        Q_EMIT message(tr("Select an object first."));
        Q_EMIT isolated_changed(false);
        return;
    }
    impl_->isolate(std::move(nodes));
    Q_EMIT message(tr("Only the selection is shown; its light is that of the whole scene."));
}

void ViewportWidget::dragEnterEvent(QDragEnterEvent* event) {
    const auto* mime = qobject_cast<const SceneMime*>(event->mimeData());
    if (mime != nullptr && mime->item()) {
        impl_->cancel();
        impl_->place_tool.begin(mime->item());
        event->setDropAction(Qt::CopyAction);
        event->accept();
    } else {
        event->ignore();
    }
}

void ViewportWidget::dragMoveEvent(QDragMoveEvent* event) {
    event->setDropAction(Qt::CopyAction);
    event->setAccepted(impl_->answer_drag(event, false));
}

void ViewportWidget::dragLeaveEvent(QDragLeaveEvent* /*event*/) {
    impl_->place_tool.cancel();
    impl_->set_hovered({});
    update();
}

void ViewportWidget::dropEvent(QDropEvent* event) {
    event->setDropAction(Qt::CopyAction);
    event->setAccepted(impl_->answer_drag(event, true));
    impl_->set_hovered({});
    setFocus(Qt::OtherFocusReason);
}

dvec3 ViewportWidget::lamp_place() const { return impl_->lamp_above(placement_point()); }
ViewportWidget::DropPlace ViewportWidget::drop_place(const QPointF& point) const {
    impl_->sync();
    const auto hit = impl_->pick({point.x(), point.y()});
    if (!hit) {
        return {{}, lamp_place()};
    }
    DropPlace out{hit->node, hit->point};
    if (hit->normal.y < -0.5) {
        out.lamp += hit->normal * kBelowCeiling;
    } else if (hit->normal.y > 0.5) {
        out.lamp = impl_->lamp_above(hit->point);
    } else {
        out.lamp += hit->normal * kBeforeWall;
    }
    return out;
}

} // namespace atrium::ui
