// Small questions about edits that undo needs: does it change anything, which parts can be told apart.
#pragma once

#include "engine/scene/scene_edit.h"

#include <vector>

namespace atrium {

/// True when applying `edit` would leave the scene as it is: such an edit gets no undo entry.
bool changes_nothing(const Scene& scene, const SceneEdit& edit);

/// True for edits that only replace a value (no id appears or vanishes, no order changes), so that a later one for the
/// same target may take their place in a gesture.
bool replaces_value(const SceneEdit& edit);

/// One edit for a list: the edit itself when there is only one, otherwise a group.
SceneEdit as_one(std::vector<SceneEdit> edits);

/// What undo and redo apply.
struct UndoEntry {
    SceneEdit forward;
    SceneEdit inverse;
};

/// The edits of one gesture on their way to one undo entry: what was set again and again is kept once.
class GestureEdits {
public:
    /// Takes an edit that was just applied, and the inverse that apply() gave.
    void absorb(const SceneEdit& edit, const SceneEdit& inverse);
    /// All of it as one entry; nothing is left here afterwards. The entry of an empty gesture changes nothing.
    UndoEntry take();

private:
    void absorb_one(const SceneEdit& edit, const SceneEdit& inverse);
    std::vector<SceneEdit> done_;
    std::vector<SceneEdit> inverse_; ///< in order of application
};

} // namespace atrium
