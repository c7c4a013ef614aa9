// Sections of the properties panel for nodes: name and state, placement, shape, and the scene when nothing is selected.
#pragma once

#include "ui/panels/section.h"

class QLabel;
class QLineEdit;

namespace atrium::ui {

/// Name, visible, locked.
class NodeSection : public Section {
    Q_OBJECT
public:
    explicit NodeSection(Document& document);

protected:
    bool has_target() const override;
    void refresh_more() override;

private:
    QLineEdit* name_ = nullptr;
    QLabel* count_ = nullptr;
};

/// Translation, rotation as Euler angles, scale; in the parent's space.
class PlacementSection : public Section {
    Q_OBJECT
public:
    explicit PlacementSection(Document& document);

protected:
    bool has_target() const override;

private:
    /// Angles in degrees (x, then y, then z about fixed axes). Keeps what was typed as long as it gives that rotation.
    dvec3 euler_of(NodeId id, const dquat& rotation) const;
    SceneEdit write(const std::function<void(Transform&, NodeId)>& change) const;
    mutable NodeId typed_for_;
    mutable dvec3 typed_{0.0};
};

/// Parameters of the shape: sizes, radii, caps.
class ShapeSection : public Section {
    Q_OBJECT
public:
    explicit ShapeSection(Document& document);

protected:
    bool has_target() const override;
    void refresh_more() override;

private:
    std::vector<ShapeId> targets() const;
    QLabel* kind_ = nullptr;
};

/// Sky and solver quality; shown when nothing is selected.
class SceneSection : public Section {
    Q_OBJECT
public:
    explicit SceneSection(Document& document);

protected:
    bool has_target() const override;
    void refresh_more() override;

private:
    QLabel* summary_ = nullptr;
    QString size_; ///< extent as text; measured on opening and on deselecting, not at every edit
    bool measure_ = true;
};

} // namespace atrium::ui
