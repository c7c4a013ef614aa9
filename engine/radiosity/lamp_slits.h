// Narrow openings before large lamps: rays spread over a lamp pass them by, so the openings are looked through by name.
#pragma once

#include "engine/base/run_context.h"
#include "engine/radiosity/hierarchy.h"
#include "engine/radiosity/sky_window.h"

#include <vector>

namespace atrium {

/// Rectangles between two straight edges of surfaces in one plane that face each other across a gap much narrower than a
/// lamp that shines through it, where what lies behind is dark otherwise. At most a few; the one with the most light first.
/// A direction belongs to the first that it crosses, from either side. Empty without lamps, and in nearly all scenes.
/// `lamps` is the tree in which only they shine. Deterministic; parallel inside; empty when stopped.
std::vector<SkyWindow> find_lamp_slits(const RayScene& rays, const Hierarchy& lamps, const RunContext& context = {});

} // namespace atrium
