// Camera moves by mouse and keys, walking, framing.
#include "ui/viewport/viewport_impl.h"

#include "ui/viewport/look_at.h"

#include <QMouseEvent>

#include <algorithm>

namespace atrium::ui {

std::optional<dvec3> ViewportWidget::Impl::selection_centre() const {
    DBox3 box;
    for (const NodeId id : doc.selection()->nodes()) {
        const DBox3 one = doc.scene().subtree_bounds(id);
        if (!one.empty()) {
            box.add(one);
        } else if (doc.scene().nodes.contains(id)) {
            box.add(dvec3(doc.scene().world_matrix(id)[3]));
        }
    }
    return box.empty() ? std::nullopt : std::optional(box.centre());
}

dvec3 ViewportWidget::Impl::point_under(const dvec2& point) const {
    const Ray ray = controller.ray(point);
    const auto hit = view.pick(ray);
    if (hit) {
        return hit->point;
    }
    const DBox3 box = doc.scene().subtree_bounds(doc.selection()->active());
    if (doc.selection()->active() && !box.empty()) {
        return box.centre();
    }
    return ray.at(controller.focus_distance());
}

void ViewportWidget::Impl::navigate(const dvec2& point) {
    const dvec2 delta = point - last_point;
    last_point = point;
    if (glm::length(delta) == 0.0) {
        return;
    }
    switch (navigation) {
    case Navigation::Orbit: controller.orbit(delta, pivot); break;
    case Navigation::Pan: controller.pan(delta, pivot); break;
    case Navigation::Look: controller.look(delta); break;
    case Navigation::None: return;
    }
    picture_changed();
}

ViewportWidget::Impl::Navigation ViewportWidget::Impl::navigation_for(const QMouseEvent& event) const {
    const bool inside = [&] {
        const DBox3 box = robust_bounds(doc.scene());
        const dvec3 e = controller.eye();
        return !box.empty() && glm::all(glm::greaterThan(e, box.min)) && glm::all(glm::lessThan(e, box.max));
    }();
    switch (event.button()) {
    case Qt::MiddleButton: return event.modifiers().testFlag(Qt::ShiftModifier) ? Navigation::Pan : Navigation::Orbit;
    case Qt::LeftButton:
        if (event.modifiers().testFlag(Qt::AltModifier)) {
            return event.modifiers().testFlag(Qt::ShiftModifier) ? Navigation::Pan : Navigation::Orbit;
        }
        return walking ? Navigation::Look : Navigation::None;
    case Qt::RightButton: return walking || inside ? Navigation::Look : Navigation::Orbit;
    default: return Navigation::None;
    }
}

bool ViewportWidget::Impl::is_walk_key(int key) {
    switch (key) {
    case Qt::Key_W:
    case Qt::Key_A:
    case Qt::Key_S:
    case Qt::Key_D:
    case Qt::Key_Q:
    case Qt::Key_E:
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_Left:
    case Qt::Key_Right: return true;
    default: return false;
    }
}

WalkInput ViewportWidget::Impl::walk_input() const {
    const auto held = [this](int a, int b) { return walk_keys.contains(a) || walk_keys.contains(b) ? 1.0 : 0.0; };
    WalkInput input;
    input.forward = held(Qt::Key_W, Qt::Key_Up) - held(Qt::Key_S, Qt::Key_Down);
    input.right = held(Qt::Key_D, Qt::Key_Right) - held(Qt::Key_A, Qt::Key_Left);
    input.up = held(Qt::Key_E, Qt::Key_E) - held(Qt::Key_Q, Qt::Key_Q);
    input.fast = walk_fast;
    return input;
}

void ViewportWidget::Impl::start_walk_timer() {
    if (!walk_timer.isActive()) {
        walk_clock.restart();
        walk_timer.start();
    }
}

void ViewportWidget::Impl::walk_step() {
    // A slow frame must not become a leap through a wall.
    const double seconds = std::min(double(walk_clock.restart()) / 1000.0, 0.15);
    sync();
    WalkInput input = walk_input();
    eye_height = std::clamp(eye_height + input.up * seconds, 0.4, 3.0);
    input.up = 0;
    const dvec3 before = controller.eye();
    controller.walk(input, seconds);
    const auto floor = view.pick({controller.eye(), dvec3(0.0, -1.0, 0.0)});
    if (floor) {
        controller.settle_on_floor(floor->point.y, seconds, eye_height);
    } else {
        input.up = walk_input().up;
        controller.walk(WalkInput{0, 0, input.up, input.fast}, seconds);
    }
    if (glm::length(controller.eye() - before) > 1e-4) {
        picture_changed();
    } else if (walk_keys.isEmpty()) {
        walk_timer.stop();
    }
}

void ViewportWidget::Impl::frame(const DBox3& box) {
    controller.frame(box);
    picture_changed();
}

void ViewportWidget::frame_selection() {
    const Scene& scene = impl_->doc.scene();
    DBox3 box;
    for (const NodeId id : impl_->doc.selection()->nodes()) {
        const DBox3 b = scene.subtree_bounds(id);
        if (!b.empty()) {
            box.add(b);
        } else if (scene.nodes.contains(id)) {
            const dvec3 place(scene.world_matrix(id)[3]);
            box.add(place - 0.5);
            box.add(place + 0.5);
        }
    }
    if (box.empty()) {
        frame_all();
    } else {
        impl_->frame(box);
    }
}

void ViewportWidget::look_at(const DBox3& box, const dvec3& focus, const dvec3& normal) {
    if (box.empty()) {
        return;
    }
    impl_->sync();
    if (const auto camera = camera_towards(impl_->controller, impl_->view, box, focus, normal)) {
        set_camera(*camera);
    } else {
        impl_->frame(box);
    }
}

void ViewportWidget::frame_all() { impl_->frame(robust_bounds(impl_->doc.scene())); }
void ViewportWidget::set_walk_mode(bool on) {
    if (on == impl_->walking) {
        return;
    }
    impl_->cancel();
    impl_->walking = on;
    impl_->walk_keys.clear();
    impl_->eye_height = CameraController::kEyeHeight;
    if (on) {
        setFocus(Qt::OtherFocusReason);
        impl_->start_walk_timer();
        Q_EMIT message(tr("Walk: W A S D to go, drag to look, Q E lower or raise the eye, Shift faster, Esc leaves"));
    } else {
        impl_->walk_timer.stop();
        Q_EMIT message(QString());
    }
    Q_EMIT walk_mode_changed(on);
}

bool ViewportWidget::walk_mode() const { return impl_->walking; }
ViewCamera ViewportWidget::camera() const {
    ViewCamera out = impl_->controller.camera();
    out.lens.exposure_ev = impl_->exposure_ev;
    return out;
}

void ViewportWidget::set_camera(const ViewCamera& camera) {
    impl_->controller.set_camera(camera);
    impl_->picture_changed();
}

} // namespace atrium::ui
