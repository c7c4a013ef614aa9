// The reference's own reading of photometric webs: straight from the angles of the file, in doubles, without the tables and
// the filled-in symmetry of the engine's PhotometricWeb, so that neither repeats a mistake of the other.
#pragma once

#include "engine/scene/photometric_web.h"

namespace atrium {

/// Intensity towards a unit direction in the light's own axes, candela. Any thread.
double read_candela(const PhotometricData& data, const dvec3& direction);

} // namespace atrium
