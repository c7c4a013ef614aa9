// A small picture of a whole room, drawn without GL and without light: to tell one state of a scene from another.
#pragma once

#include "engine/view/still.h"

#include <QImage>

namespace atrium::ui {

/// The scene's shapes through `camera`, each face shaded by its direction in the plain colour of its material; what emits
/// glows. The same scene and camera give the same picture. Any thread; time grows with the number of triangles.
QImage room_picture(const Scene& scene, const ViewCamera& camera, QSize size);

} // namespace atrium::ui
