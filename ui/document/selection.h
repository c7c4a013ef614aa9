// What is selected: ids, the last one being the active one. Ids of deleted nodes leave by themselves.
#pragma once

#include "engine/scene/scene.h"

#include <QObject>

#include <vector>

namespace atrium::ui {

/// UI thread only.
class Selection : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;
    [[nodiscard]] const std::vector<NodeId>& nodes() const { return nodes_; }
    [[nodiscard]] NodeId active() const { return nodes_.empty() ? NodeId{} : nodes_.back(); }
    [[nodiscard]] bool contains(NodeId id) const;
    void set(std::vector<NodeId> nodes); ///< duplicates are dropped; emits changed() when it differs
    void toggle(NodeId id);
    void clear() { set({}); }
    /// Selected nodes without those below another selected one: what move, delete and duplicate act on.
    [[nodiscard]] std::vector<NodeId> top_level(const Scene& scene) const;

Q_SIGNALS:
    void changed();

private:
    std::vector<NodeId> nodes_;
};

} // namespace atrium::ui
