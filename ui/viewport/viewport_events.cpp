// Mouse and keys of the viewport: to the camera, to the active tool.
#include "ui/viewport/viewport_impl.h"

#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QWheelEvent>

namespace atrium::ui {
namespace {

constexpr double kPinchSteps = 6.0; ///< dolly steps for a pinch to twice the size

} // namespace

void ViewportWidget::Impl::flush() {
    pending_timer.stop();
    if (!pending) {
        return;
    }
    const Pointer pointer = *pending;
    pending.reset();
    sync();
    if (navigation != Navigation::None) {
        navigate(pointer.position);
    } else if (tool().active()) {
        tool().move(pointer);
        widget.update();
    } else {
        if (tool().hover(pointer)) {
            widget.update();
        }
        const auto hit = tool_kind == ToolKind::Measure ? std::nullopt : pick(pointer.position);
        set_hovered(hit ? hit->node : NodeId{});
        if (tool_kind == ToolKind::Select) {
            widget.setCursor(hit && select->grabs(hit->node) ? Qt::SizeAllCursor : Qt::ArrowCursor);
        }
        if (inspector.links() && inspector.point_at(doc.scene(), view.pick(controller.ray(pointer.position)))) {
            widget.update();
        }
    }
}

void ViewportWidget::Impl::cancel() {
    pending.reset();
    navigation = Navigation::None;
    pressed = Qt::NoButton;
    tool().cancel();
    widget.update();
}

void ViewportWidget::mousePressEvent(QMouseEvent* event) {
    impl_->flush();
    if (impl_->pressed != Qt::NoButton) {
        return; // a second button changes nothing about a drag
    }
    setFocus(Qt::MouseFocusReason);
    impl_->sync();
    const dvec2 point = to_vec(event->position());
    impl_->pressed = event->button();
    impl_->navigation = impl_->navigation_for(*event);
    impl_->refine_timer.stop();
    if (impl_->navigation != Impl::Navigation::None) {
        impl_->last_point = point;
        impl_->pivot = impl_->point_under(point);
        if (impl_->orbit_selection && impl_->navigation == Impl::Navigation::Orbit) {
            impl_->pivot = impl_->selection_centre().value_or(impl_->pivot);
        }
        impl_->set_hovered({});
    } else if (event->button() == Qt::LeftButton) {
        if (event->type() == QEvent::MouseButtonDblClick && impl_->tool_kind != ToolKind::Measure) {
            if (const auto hit = impl_->pick(point)) {
                impl_->doc.selection()->set({hit->node});
                frame_selection();
            }
            impl_->pressed = Qt::NoButton;
            return;
        }
        impl_->set_hovered({});
        if (impl_->inspector.choice().links && impl_->tool_kind != ToolKind::Measure) {
            impl_->inspector.choose(impl_->doc.scene(), impl_->view.pick(impl_->controller.ray(point)));
        }
        impl_->tool().press({point, event->modifiers()});
        update();
    } else {
        impl_->pressed = Qt::NoButton;
    }
}

void ViewportWidget::mouseMoveEvent(QMouseEvent* event) {
    impl_->pending = Pointer{to_vec(event->position()), event->modifiers()};
    if (!impl_->pending_timer.isActive()) {
        impl_->pending_timer.start();
    }
}

void ViewportWidget::mouseReleaseEvent(QMouseEvent* event) {
    impl_->flush();
    if (event->button() != impl_->pressed) {
        return;
    }
    const dvec2 point = to_vec(event->position());
    impl_->pressed = Qt::NoButton;
    if (impl_->navigation != Impl::Navigation::None) {
        impl_->navigate(point);
        impl_->navigation = Impl::Navigation::None;
    } else if (impl_->tool().active()) {
        impl_->sync();
        impl_->tool().release({point, event->modifiers()});
        update();
    }
}

void ViewportWidget::wheelEvent(QWheelEvent* event) {
    impl_->flush();
    impl_->sync();
    // Trackpads send pixels, mice eighths of a degree (120 to a notch).
    const double steps = event->pixelDelta().isNull() ? event->angleDelta().y() / 120.0 : event->pixelDelta().y() / 60.0;
    if (steps != 0.0) {
        impl_->controller.dolly(steps, impl_->point_under(to_vec(event->position())));
        impl_->picture_changed();
    }
    event->accept();
}

void ViewportWidget::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape && impl_->tool().active()) {
        impl_->cancel();
    } else if (event->key() == Qt::Key_Escape && impl_->walking) {
        set_walk_mode(false);
    } else if (impl_->tool().active() && impl_->tool().key(event->key(), event->text())) {
        update();
    } else if (impl_->walking && (Impl::is_walk_key(event->key()) || event->key() == Qt::Key_Shift)) {
        impl_->walk_fast = event->modifiers().testFlag(Qt::ShiftModifier);
        if (!event->isAutoRepeat() && event->key() != Qt::Key_Shift) {
            impl_->walk_keys.insert(event->key());
            impl_->start_walk_timer();
        }
    } else {
        QOpenGLWidget::keyPressEvent(event);
    }
}

void ViewportWidget::keyReleaseEvent(QKeyEvent* event) {
    impl_->walk_fast = event->modifiers().testFlag(Qt::ShiftModifier) && event->key() != Qt::Key_Shift;
    if (impl_->walking && Impl::is_walk_key(event->key())) {
        if (!event->isAutoRepeat()) {
            impl_->walk_keys.remove(event->key());
        }
        return;
    }
    QOpenGLWidget::keyReleaseEvent(event);
}

void ViewportWidget::focusOutEvent(QFocusEvent* event) {
    impl_->walk_keys.clear();
    if (impl_->tool().active()) {
        impl_->cancel();
    }
    QOpenGLWidget::focusOutEvent(event);
}

bool ViewportWidget::event(QEvent* event) {
    switch (event->type()) {
    case QEvent::ShortcutOverride: {
        const auto* key = static_cast<QKeyEvent*>(event);
        const bool walk_key = impl_->walking && (key->key() == Qt::Key_Escape || Impl::is_walk_key(key->key()));
        if (impl_->tool().active() || walk_key) {
            event->accept();
            return true;
        }
        break;
    }
    case QEvent::Leave:
        impl_->pending.reset();
        impl_->set_hovered({});
        impl_->tool().leave();
        update();
        break;
    case QEvent::NativeGesture: {
        const auto* gesture = static_cast<QNativeGestureEvent*>(event);
        if (gesture->gestureType() == Qt::ZoomNativeGesture) {
            impl_->sync();
            impl_->controller.dolly(gesture->value() * kPinchSteps, impl_->point_under(to_vec(gesture->position())));
            impl_->picture_changed();
            return true;
        }
        break;
    }
    default: break;
    }
    return QOpenGLWidget::event(event);
}

} // namespace atrium::ui
