// Where the selected objects are: position in metres, rotation, scale, size.
#pragma once

#include "ui/document/placement_frame.h"
#include "ui/panels/section.h"

class QComboBox;
class QLabel;

namespace atrium::ui {

/// Position in world metres and rotation as Euler angles, from the scene's origin and axes or from those of the group that
/// an object is in; the object's own scale; how large it is.
class PlacementSection : public Section {
    Q_OBJECT
public:
    explicit PlacementSection(Document& document);

protected:
    bool has_target() const override;
    void refresh_more() override;

private:
    [[nodiscard]] PlacementFrame frame() const;
    void add_frame();
    void add_scale();
    /// Angles in degrees (x, then y, then z about fixed axes). Keeps what was typed as long as it gives that rotation.
    dvec3 euler_of(NodeId id, const dquat& rotation) const;
    [[nodiscard]] bool in_groups() const; ///< any of the objects is in one
    void show_hints();
    void show_size();

    std::array<NumberField*, 3> position_{};
    std::array<NumberField*, 3> rotation_{};
    QComboBox* frame_ = nullptr;
    QLabel* size_ = nullptr;
    NodeId typed_for_;
    dvec3 typed_{0.0};
};

} // namespace atrium::ui
