// Small pictures of objects and materials, drawn without GL.
#pragma once

#include "engine/scene/scene.h"

#include <QImage>

namespace atrium::ui {

/// The scene's shapes from the front, above and right, shaded by a fixed light; lamps glow. Transparent background. Any
/// thread; time grows with the number of triangles.
QImage object_thumbnail(const Scene& scene, int size);
/// A ball of the material before a checkered ground, so that glass and mirrors are told apart. Any thread.
QImage material_thumbnail(const Material& material, int size);

} // namespace atrium::ui
