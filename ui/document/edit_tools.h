// Small questions about edits that undo needs: does it change anything, which parts can be told apart.
#pragma once

#include "engine/scene/scene_edit.h"

#include <vector>

namespace atrium::ui {

/// True when applying `edit` would leave the scene as it is: such an edit gets no undo entry.
bool changes_nothing(const Scene& scene, const SceneEdit& edit);

/// True for edits that only replace a value (no id appears or vanishes, no order changes), so that a later one for the
/// same target may take their place in a gesture.
bool replaces_value(const SceneEdit& edit);

/// One edit for a list: the edit itself when there is only one, otherwise a group.
SceneEdit as_one(std::vector<SceneEdit> edits);

} // namespace atrium::ui
