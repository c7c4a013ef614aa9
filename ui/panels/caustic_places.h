// Where in the room the rows of the caustic inspector lie.
#pragma once

#include "ui/panels/caustic_words.h"

namespace atrium::ui {

/// The rectangle of the row's chart in the surface's chart space, tiles (see SurfaceCharts).
struct ChartRectangle {
    vec2 low{0.0F};
    vec2 high{0.0F};
};
/// Known where the row has a texture.
std::optional<ChartRectangle> chart_rectangle(const CausticRow& row);

/// Layer of the row's surface; null where the solution has none.
const SurfaceLayer* layer_of(const Solution& solution, const CausticRow& row);

/// World bounds of the row's piece of surface: of the whole part where nothing smaller is known. Empty without a node.
DBox3 piece_bounds(const Scene& scene, const Solution& solution, const CausticRow& row);

} // namespace atrium::ui
