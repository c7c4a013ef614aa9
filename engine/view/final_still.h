// The final pass of a still: light computed at every sample of every pixel.
#pragma once

#include "engine/view/still.h"

namespace atrium {

/// See StillOptions::final_pass. Samples come in passes over the whole picture, each doubling what was there; the watcher
/// is called after each.
StillLayers render_final(const Scene& scene, const Solution& solution, const ViewCamera& camera, const StillOptions& options,
                         const RunContext& context, const StillWatcher& watcher);

} // namespace atrium
