// Small pictures of a room in the light of a stored solution, also of another state of the room: for recovered work, which
// is written aside without its light.
#pragma once

#include "engine/solver/solution.h"
#include "engine/view/still.h"

#include <QImage>

namespace atrium::ui {

/// The light of one state of a scene on another: objects that both have (by name, in the order of the tree, with the same
/// shape) keep theirs, wherever they are now; what is new has the mean of all. Any thread.
Solution carried_light(const Scene& from, const Solution& light, const Scene& to);

/// Through `camera`, exposed as the view is at first. Any thread; some tenths of a second of processor time.
QImage lit_picture(const Scene& scene, const Solution& light, const ViewCamera& camera, QSize size);

} // namespace atrium::ui
