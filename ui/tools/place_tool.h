// What a drag from the library does in the view: the object itself follows the cursor over the surfaces, a material marks
// the object that would take it. One undo entry when it is dropped, none when it leaves.
#pragma once

#include "ui/document/gesture.h"
#include "ui/document/library.h"
#include "ui/tools/tool.h"

#include <memory>
#include <unordered_set>

namespace atrium::ui {

/// UI thread only.
class PlaceTool {
public:
    explicit PlaceTool(ToolHost& host) : host_(host) {}

    [[nodiscard]] bool active() const { return item_ != nullptr; }
    void begin(std::shared_ptr<const LibraryItem> item);
    /// Shows the object at a point of the screen, or finds the object that a material would go to. False when there is
    /// no place for it.
    bool move(const Pointer& pointer);
    /// As move(), then keeps it and selects it.
    bool drop(const Pointer& pointer);
    void cancel();
    /// Object that the material would go to; none for objects.
    [[nodiscard]] NodeId target() const { return target_ ? target_->node : NodeId{}; }

private:
    bool insert(const dmat4& placement);

    ToolHost& host_;
    std::shared_ptr<const LibraryItem> item_;
    std::unique_ptr<Gesture> gesture_;
    std::vector<NodeId> roots_;
    std::unordered_set<NodeId> own_; ///< all that was inserted
    DBox3 bounds_;
    std::optional<PickHit> target_;
};

} // namespace atrium::ui
