#include "ui/panels/placement_section.h"

#include "engine/scene/edit_tools.h"
#include "ui/panels/quiet_combo.h"

#include <QLabel>

#include <algorithm>

namespace atrium::ui {
namespace {

dquat rotation_from(const dvec3& degrees) {
    return glm::normalize(
        dquat(dvec3(radians_from_degrees(degrees.x), radians_from_degrees(degrees.y), radians_from_degrees(degrees.z))));
}

/// The same turn; q and -q are one.
bool same_rotation(const dquat& a, const dquat& b) { return std::abs(glm::dot(a, b)) > 1 - 1e-12; }

/// What is a whole number but for rounding, as such; no minus zero.
double tidy(double value) {
    const double rounded = std::round(value * 1e9) / 1e9;
    return rounded == 0 ? 0 : rounded;
}

QString metres(double value) { return QString::fromStdString(format_number(value, value < 1 ? 3 : 2)); }

} // namespace

PlacementSection::PlacementSection(Document& document) : Section(tr("Placement"), document) {
    const auto each = [this](const std::function<dvec3(NodeId)>& get) {
        std::vector<dvec3> values;
        for (const NodeId id : Section::document().selection()->nodes()) {
            values.push_back(get(id));
        }
        return values;
    };
    const auto write = [this](const std::function<void(FramedPlacement&, NodeId)>& change) {
        return place_nodes(scene(), Section::document().selection()->nodes(), frame(), change);
    };
    add_frame();
    position_ = add_vector(
        tr("Position"), NumberFormat::length(),
        [this, each] {
            return each([this](NodeId id) {
                const dvec3 p = placement_in(scene(), id, frame()).position;
                return dvec3(tidy(p.x), tidy(p.y), tidy(p.z));
            });
        },
        [write](int axis, double value) { return write([=](FramedPlacement& p, NodeId) { p.position[axis] = value; }); });
    rotation_ = add_vector(
        tr("Rotation"), NumberFormat::angle(),
        [this, each] {
            return each([this](NodeId id) { return euler_of(id, placement_in(scene(), id, frame()).rotation); });
        },
        [this, write](int axis, double value) {
            return write([this, axis, value](FramedPlacement& p, NodeId id) {
                dvec3 angles = euler_of(id, p.rotation);
                angles[axis] = value;
                p.rotation = rotation_from(angles);
                typed_for_ = id;
                typed_ = angles;
            });
        });
    add_scale();
    size_ = new QLabel;
    size_->setObjectName(QStringLiteral("Size"));
    size_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    size_->setToolTip(tr("Extent along the axes of the scene: X, Y (height), Z"));
    add_row(tr("Size"), size_);
}

bool PlacementSection::has_target() const { return !document().selection()->nodes().empty(); }

PlacementFrame PlacementSection::frame() const {
    return frame_->currentIndex() == 1 ? PlacementFrame::Parent : PlacementFrame::World;
}

void PlacementSection::add_frame() {
    auto* combo = new QuietCombo;
    combo->addItems({tr("Scene"), tr("Group")});
    combo->setObjectName(QStringLiteral("Measured from"));
    combo->setToolTip(
        tr("Origin and axes of position and rotation: those of the scene, or those of the group that an object "
           "is in. Lengths are metres in both."));
    connect(combo, &QComboBox::currentIndexChanged, this, [this] {
        typed_for_ = {}; // what was typed was about other axes
        refresh();
    });
    frame_ = combo;
    add_row(tr("Measured from"), combo, [this] { return in_groups(); });
}

void PlacementSection::add_scale() {
    NumberFormat format = NumberFormat::plain(-1e6, 1e6, 4);
    format.step = 0.05;
    const auto fields = add_vector(
        tr("Scale"), format,
        [this] {
            std::vector<dvec3> values;
            for (const NodeId id : Section::document().selection()->nodes()) {
                values.push_back(scene().nodes.find(id)->transform.scale);
            }
            return values;
        },
        [this](int axis, double value) {
            std::vector<SceneEdit> edits;
            for (const NodeId id : Section::document().selection()->nodes()) {
                Transform transform = scene().nodes.find(id)->transform;
                transform.scale[axis] = value;
                edits.push_back(SceneEdit{SetTransform{id, transform}});
            }
            return as_one(std::move(edits));
        });
    for (NumberField* field : fields) {
        field->set_hint(tr("Of the object, along its own axes; the scale of its groups comes on top"));
    }
}

bool PlacementSection::in_groups() const {
    const auto& nodes = document().selection()->nodes();
    return std::any_of(nodes.begin(), nodes.end(),
                       [this](NodeId id) { return scene().nodes.contains(scene().nodes.find(id)->parent); });
}

dvec3 PlacementSection::euler_of(NodeId id, const dquat& rotation) const {
    if (id == typed_for_ && same_rotation(rotation_from(typed_), rotation)) {
        return typed_;
    }
    const dvec3 radians = glm::eulerAngles(rotation);
    return {tidy(degrees_from_radians(radians.x)), tidy(degrees_from_radians(radians.y)),
            tidy(degrees_from_radians(radians.z))};
}

void PlacementSection::refresh_more() {
    show_hints();
    if (!document().in_gesture()) { // a hand that moves something does not look at its size
        show_size();
    }
}

void PlacementSection::show_hints() {
    const bool world = frame() == PlacementFrame::World || !in_groups();
    for (NumberField* field : position_) {
        field->set_hint(world ? tr("Metres from the origin of the scene, along its axes; Y is up")
                              : tr("Metres from the origin of the group, along its axes"));
    }
    for (NumberField* field : rotation_) {
        field->set_hint(world ? tr("Degrees about the axes of the scene") : tr("Degrees about the axes of the group"));
    }
}

void PlacementSection::show_size() {
    DBox3 box;
    for (const NodeId id : document().selection()->nodes()) {
        const DBox3 own = scene().subtree_bounds(id);
        if (!own.empty()) {
            box.add(own);
        }
    }
    const dvec3 size = box.size();
    size_->setText(box.empty() ? tr("none") : tr("%1 x %2 x %3 m").arg(metres(size.x), metres(size.y), metres(size.z)));
}

} // namespace atrium::ui
