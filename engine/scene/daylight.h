// Daylight for files that bring no light of their own.
#pragma once

#include "engine/scene/scene_edit.h"

#include <optional>

namespace atrium {

/// True when nothing shown emits: no enabled lamp, no emitting surface, no sky.
bool has_no_light(const Scene& scene);

/// The edit that adds a clear afternoon: a sun node (30 degrees high, from the side, 40,000 lx) and a uniform sky of
/// 3,000 cd/m2. Never applied silently: the editor offers it, atrium-cli has --daylight.
SceneEdit add_daylight(const Scene& scene);

} // namespace atrium
