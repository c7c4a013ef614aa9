#include "ui/tools/place_tool.h"

#include "ui/document/engine_text.h"
#include "ui/document/insert_commands.h"
#include "ui/tools/surface.h"

#include <QCoreApplication>
#include <QLocale>

namespace atrium::ui {
namespace {

QString tr(const char* text) { return QCoreApplication::translate("Tools", text); }

} // namespace

void PlaceTool::begin(std::shared_ptr<const LibraryItem> item) {
    cancel();
    if (!host_.document().in_gesture()) {
        item_ = std::move(item);
    }
}

bool PlaceTool::insert(const dmat4& placement) {
    gesture_ = std::make_unique<Gesture>(host_.document(), tr("Add %1").arg(item_->name));
    const Command command = insert_scene(host_.document().scene(), *item_->scene, placement);
    const auto done = host_.document().apply(command.edit, tr("Add %1").arg(item_->name));
    if (!done) {
        host_.show_message(error_message(done.error()));
        gesture_.reset();
        return false;
    }
    roots_ = command.select;
    for (const NodeId root : roots_) {
        for (const NodeId id : host_.document().scene().in_tree_order(root)) {
            own_.insert(id);
        }
    }
    return true;
}

bool PlaceTool::move(const Pointer& pointer) {
    if (!item_) {
        return false;
    }
    if (!item_->scene) {
        host_.show_message(tr("%1 is being loaded...").arg(item_->name));
        return false;
    }
    const Ray ray = host_.camera().ray(pointer.position);
    if (item_->is_material()) {
        target_ = host_.view_scene().pick(ray);
        const Node* node = target_ ? host_.document().scene().nodes.find(target_->node) : nullptr;
        if (node != nullptr) {
            host_.show_message(tr("%1 on %2").arg(item_->name, QString::fromStdString(node->name)));
        }
        return node != nullptr;
    }
    if (!gesture_) {
        bounds_ = item_->scene->bounds();
    }
    const Snapping& snapping = host_.snapping();
    const bool snap = snapping.on != pointer.modifiers.testFlag(Qt::ControlModifier);
    const auto placement = placement_under(host_.view_scene(), ray, item_->mount, bounds_, own_, snap ? snapping.grid : 0.0);
    if (!placement) {
        return gesture_ != nullptr; // it stays where it was last
    }
    if (!gesture_) {
        if (!insert(*placement)) {
            return false;
        }
    } else {
        for (std::size_t i = 0; i < roots_.size(); ++i) {
            const Node* source = item_->scene->nodes.find(item_->scene->roots[i]);
            const Transform next = decompose(*placement * source->transform.matrix());
            (void)host_.document().apply(SceneEdit{SetTransform{roots_[i], next}}, {});
        }
    }
    const dvec3 at((*placement)[3]);
    const QLocale locale;
    host_.show_message(
        tr("%1 at x %2 m, y %3 m, z %4 m")
            .arg(item_->name, locale.toString(at.x, 'f', 2), locale.toString(at.y, 'f', 2), locale.toString(at.z, 'f', 2)));
    return true;
}

bool PlaceTool::drop(const Pointer& pointer) {
    const bool placed = move(pointer);
    if (placed && item_->is_material()) {
        const SceneEdit edit = assign_material(host_.document().scene(), {{target_->node, target_->part}}, *item_->scene,
                                               material_in(*item_->scene));
        const auto done = host_.document().apply(edit, tr("Set material %1").arg(item_->name));
        if (!done) {
            host_.show_message(error_message(done.error()));
        }
        host_.document().selection()->set({target_->node});
    } else if (placed) {
        gesture_->commit();
        host_.document().selection()->set(roots_);
    }
    cancel();
    return placed;
}

void PlaceTool::cancel() {
    gesture_.reset(); // rolls back what was not committed
    item_.reset();
    roots_.clear();
    own_.clear();
    target_.reset();
}

} // namespace atrium::ui
