#include "ui/actions/edit_controller.h"

#include "engine/scene/daylight.h"
#include "ui/document/engine_text.h"

namespace atrium::ui {

namespace {

QString object_name(NewObject kind) {
    switch (kind) {
    case NewObject::Polygon: return EditController::tr("Polygon");
    case NewObject::Box: return EditController::tr("Box");
    case NewObject::Sphere: return EditController::tr("Sphere");
    case NewObject::Cylinder: return EditController::tr("Cylinder");
    case NewObject::Cone: return EditController::tr("Cone");
    case NewObject::Disc: return EditController::tr("Disc");
    case NewObject::PointLight: return EditController::tr("Point light");
    case NewObject::SpotLight: return EditController::tr("Spot light");
    case NewObject::Sun: return EditController::tr("Sun");
    case NewObject::AreaLight: return EditController::tr("Area light");
    case NewObject::Camera: return EditController::tr("Camera");
    }
    return {};
}

} // namespace

EditController::EditController(Document& document, QObject* parent) : QObject(parent), document_(document) {}

bool EditController::apply(const SceneEdit& edit, const QString& text) {
    const auto done = document_.apply(edit, text);
    if (!done) {
        Q_EMIT message(error_message(done.error()));
    }
    return bool(done);
}

bool EditController::nothing_selected() {
    if (document_.in_gesture()) {
        return true; // the mouse still holds the objects
    }
    if (document_.selection()->nodes().empty()) {
        Q_EMIT message(tr("Select an object first."));
        return true;
    }
    return false;
}

void EditController::duplicate() {
    if (nothing_selected()) {
        return;
    }
    const Command command = duplicate_nodes(document_.scene(), document_.selection()->top_level(document_.scene()));
    if (apply(command.edit, tr("Duplicate"))) {
        document_.selection()->set(command.select);
    }
}

void EditController::remove() {
    if (nothing_selected()) {
        return;
    }
    std::vector<NodeId> nodes;
    std::size_t locked = 0;
    for (const NodeId id : document_.selection()->top_level(document_.scene())) {
        if (document_.scene().nodes.find(id)->locked) {
            ++locked;
        } else {
            nodes.push_back(id);
        }
    }
    if (!nodes.empty()) {
        apply(delete_nodes(nodes), tr("Delete"));
    }
    if (locked != 0) {
        Q_EMIT message(tr("%n locked object(s) kept. Unlock them in the scene tree first.", nullptr, int(locked)));
    }
}

void EditController::hide() {
    if (!nothing_selected()) {
        apply(set_visible(document_.scene(), document_.selection()->nodes(), false), tr("Hide"));
    }
}

void EditController::show_all() {
    std::vector<NodeId> hidden;
    document_.scene().nodes.for_each([&](NodeId id, const Node& node) {
        if (!node.visible) {
            hidden.push_back(id);
        }
    });
    if (!hidden.empty() && !document_.in_gesture()) {
        apply(set_visible(document_.scene(), hidden, true), tr("Show all"));
    }
}

void EditController::group() {
    if (nothing_selected()) {
        return;
    }
    const Command command =
        group_nodes(document_.scene(), document_.selection()->top_level(document_.scene()), tr("Group").toStdString());
    if (apply(command.edit, tr("Group"))) {
        document_.selection()->set(command.select);
    }
}

void EditController::select_all() {
    std::vector<NodeId> nodes;
    const Scene& scene = document_.scene();
    for (const NodeId id : scene.in_tree_order()) {
        const Node* node = scene.nodes.find(id);
        if ((node->shape || node->light) && !node->locked && scene.shown(id)) {
            nodes.push_back(id);
        }
    }
    document_.selection()->set(std::move(nodes));
}

void EditController::select_none() { document_.selection()->clear(); }

void EditController::add(NewObject kind, const dvec3& at) {
    if (document_.in_gesture()) {
        return;
    }
    const QString name = object_name(kind);
    const Command command = add_object(document_.scene(), kind, at, name.toStdString());
    if (apply(command.edit, tr("Add %1").arg(name))) {
        document_.selection()->set(command.select);
    }
}

void EditController::add_camera_here(const ViewCamera& camera) {
    if (document_.in_gesture()) {
        return;
    }
    const QString name = object_name(NewObject::Camera);
    const Command command = add_camera(document_.scene(), camera.to_world, camera.lens, name.toStdString());
    if (apply(command.edit, tr("Add %1").arg(name))) {
        document_.selection()->set(command.select);
    }
}

void EditController::fix_import(const ImportSuggestion& suggestion) {
    const Command command =
        wrap_roots(document_.scene(), suggestion.unit_scale, suggestion.z_up, tr("Import correction").toStdString());
    apply(command.edit, tr("Correct units and direction"));
}

void EditController::add_daylight() {
    // By its full name: the member hides the engine's function.
    apply(atrium::add_daylight(document_.scene()), tr("Add daylight"));
}

} // namespace atrium::ui
