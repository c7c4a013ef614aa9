// The part of EditController that goes over the clipboard.
#include "ui/actions/edit_controller.h"
#include "ui/document/background.h"
#include "ui/document/engine_text.h"
#include "ui/document/insert_commands.h"
#include "ui/document/scene_mime.h"

#include <QClipboard>
#include <QGuiApplication>

#include <algorithm>

namespace atrium::ui {
namespace {

using Kind = SceneMime::Kind;

void put(Kind kind, Scene scene) {
    QGuiApplication::clipboard()->setMimeData(new SceneMime(kind, std::make_shared<const Scene>(std::move(scene))));
}

/// Bounds of a piece; a piece without shapes is the points where its nodes are.
DBox3 bounds_of(const Scene& piece) {
    DBox3 box = piece.bounds();
    if (box.empty()) {
        for (const NodeId id : piece.in_tree_order()) {
            box.add(dvec3(piece.world_matrix(id)[3]));
        }
    }
    return box;
}

} // namespace

void EditController::copy() {
    if (nothing_selected()) {
        return;
    }
    const std::vector<NodeId> nodes = document_.selection()->top_level(document_.scene());
    put(Kind::Nodes, extract_nodes(document_.scene(), nodes));
    Q_EMIT message(tr("%n object(s) copied.", nullptr, int(nodes.size())));
}

void EditController::cut() {
    if (nothing_selected()) {
        return;
    }
    std::vector<NodeId> nodes;
    for (const NodeId id : document_.selection()->top_level(document_.scene())) {
        if (!document_.scene().nodes.find(id)->locked) {
            nodes.push_back(id);
        }
    }
    if (nodes.empty()) {
        Q_EMIT message(tr("The selection is locked: unlock it to cut it."));
        return;
    }
    put(Kind::Nodes, extract_nodes(document_.scene(), nodes));
    apply(delete_nodes(nodes), tr("Cut"));
}

void EditController::from_clipboard(bool material, std::function<void(const Scene&)> use) {
    if (document_.in_gesture()) {
        return;
    }
    const Kind kind = material ? Kind::Material : Kind::Nodes;
    const QMimeData* data = QGuiApplication::clipboard()->mimeData();
    if (!SceneMime::holds(data, kind)) {
        Q_EMIT message(material ? tr("No material was copied.") : tr("No objects were copied."));
        return;
    }
    if (const auto* own = qobject_cast<const SceneMime*>(data); own != nullptr && own->scene()) {
        use(*own->scene());
        return;
    }
    run_in_background(
        this, [bytes = data->data(SceneMime::type_of(kind))] { return scene_from_bytes(bytes); },
        [this, use = std::move(use)](const Result<Scene>& read) {
            if (!read) {
                Q_EMIT message(error_message(read.error()));
            } else if (!document_.in_gesture()) {
                use(*read);
            }
        });
}

void EditController::paste(const Placement& place) {
    from_clipboard(false, [this, place](const Scene& piece) {
        const dmat4 placement = place ? place(bounds_of(piece)) : dmat4(1.0);
        const Command command = insert_scene(document_.scene(), piece, placement);
        if (!command.select.empty() && apply(command.edit, tr("Paste"))) {
            document_.selection()->set(command.select);
        }
    });
}

void EditController::copy_material() {
    if (nothing_selected()) {
        return;
    }
    const Scene& scene = document_.scene();
    const auto places = material_places(scene, {document_.selection()->active()});
    for (const MaterialPlace& place : places) {
        const std::vector<MaterialId>& materials = scene.nodes.find(place.node)->materials;
        if (place.part < materials.size() && scene.materials.contains(materials[place.part])) {
            put(Kind::Material, material_scene(scene, materials[place.part]));
            Q_EMIT message(tr("%1 copied.").arg(QString::fromStdString(scene.materials.find(materials[place.part])->name)));
            return;
        }
    }
    Q_EMIT message(tr("The active object has no material of its own."));
}

void EditController::paste_material() {
    if (nothing_selected()) {
        return;
    }
    from_clipboard(true, [this](const Scene& piece) {
        const auto places = material_places(document_.scene(), document_.selection()->nodes());
        if (const MaterialId id = material_in(piece); id && !places.empty()) {
            apply(assign_material(document_.scene(), places, piece, id), tr("Paste material"));
        }
    });
}

void EditController::assign(const LibraryItem& material) {
    if (nothing_selected() || !material.scene) {
        return;
    }
    const auto places = material_places(document_.scene(), document_.selection()->nodes());
    if (places.empty()) {
        Q_EMIT message(tr("The selection has no surface."));
        return;
    }
    if (apply(assign_material(document_.scene(), places, *material.scene, material_in(*material.scene)),
              tr("Set material %1").arg(material.name))) {
        Q_EMIT message(
            tr("%1 given to %n object(s).", nullptr, int(document_.selection()->nodes().size())).arg(material.name));
    }
}

void EditController::toggle_lock() {
    if (nothing_selected()) {
        return;
    }
    const std::vector<NodeId>& nodes = document_.selection()->nodes();
    const bool lock =
        std::any_of(nodes.begin(), nodes.end(), [this](NodeId id) { return !document_.scene().nodes.find(id)->locked; });
    apply(set_locked(document_.scene(), nodes, lock), lock ? tr("Lock") : tr("Unlock"));
}

} // namespace atrium::ui
