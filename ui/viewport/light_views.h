// The same light shown otherwise: flat, on the mesh, in textures (Granier and Drettakis 2001, figure 2), and in textures
// that are not restricted to boxes (figure 3). Values in, values out: no GL.
#pragma once

#include "engine/solver/solution.h"

#include <memory>

namespace atrium::ui {

enum class CausticView : std::uint8_t {
    Flat,    ///< one value for every face of the mesh
    Mesh,    ///< caustics at the corners of the mesh, no textures
    Texture, ///< as it is
    Whole    ///< the texels of the restriction boxes spread over whole pieces of surface: so much coarser
};

/// A solution whose layers show `solution` in this way; Texture: nothing but a copy. What does not change is shared. Takes
/// up to some tenths of a second for a large scene; any thread.
std::shared_ptr<const Solution> shown_as(const Solution& solution, CausticView view);

} // namespace atrium::ui
