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

/// A piece of surface in the world, to be looked at.
struct PiecePlace {
    DBox3 bounds;      ///< of the whole part where nothing smaller is known; empty without a node
    dvec3 focus{0.0};  ///< where the brightest texture lies, else the middle
    dvec3 normal{0.0}; ///< there, unit, on the lit side; zero where the surface faces all ways
};
PiecePlace piece_place(const Scene& scene, const Solution& solution, const CausticRow& row);

} // namespace atrium::ui
