// From where a piece of surface is seen: in front of it, as near the present view as that goes, with nothing between.
#pragma once

#include "ui/viewport/view_scene.h"

#include <optional>

namespace atrium::ui {

/// A camera that looks at `focus` on a surface with this normal (world, unit), so far away that `box` is in sight if nothing
/// stands between; nearer where a wall or another object does. None where the surface has no normal (zero), or can only be
/// seen straight from above or below.
std::optional<ViewCamera> camera_towards(const CameraController& now, const ViewScene& view, const DBox3& box,
                                         const dvec3& focus, const dvec3& normal);

} // namespace atrium::ui
