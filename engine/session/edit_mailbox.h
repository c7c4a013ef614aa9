// Edits on their way to the engine thread. A pure class: no thread, no lock, no clock.
#pragma once

#include "engine/scene/scene_edit.h"

#include <cstdint>
#include <vector>

namespace atrium {

/// Pending edits in an order that ends in the same scene as the order they were posted in. Never refuses; holds at most one
/// edit per target that is set again and again, plus the structural edits (add, remove, re-parent).
class EditMailbox {
public:
    /// Puts an edit at the end, or in the place of a pending one that it supersedes when nothing between the two has to do
    /// with its targets. `revision` is the document's after this edit.
    void post(SceneEdit edit, std::uint64_t revision);

    struct Batch {
        std::vector<SceneEdit> edits;
        std::uint64_t revision = 0; ///< of the document after the last of them
    };
    /// Everything pending, in order; the mailbox is empty afterwards.
    Batch take();
    void clear();
    [[nodiscard]] bool empty() const { return pending_.empty(); }
    [[nodiscard]] std::size_t size() const { return pending_.size(); }

private:
    std::vector<SceneEdit> pending_;
    std::uint64_t revision_ = 0;
};

} // namespace atrium
