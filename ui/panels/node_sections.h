// Sections of the properties panel for nodes: name and state, shape, and the scene when nothing is selected.
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
