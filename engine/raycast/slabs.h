// Which solid glass is a flat pane: light may cross it straight on, moved aside by less than its thickness.
#pragma once

#include "engine/raycast/ray_scene.h"

namespace atrium {

/// Mean thickness of a surface that bounds flat panes, metres; 0 = it does not. Four fifths of its area must have a parallel
/// face of the same surface (within 2 degrees) behind them, closer than 6 cm and than a quarter of the root of its area, in
/// few directions: shells of curved things are none. Looks at the shape alone, not at the material.
/// 0 when stopped.
float slab_thickness(const RaySurface& surface, const RunContext& context = {});

} // namespace atrium
