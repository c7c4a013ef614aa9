// Triangles of a primitive: for ray tracing, for the picture and for the glTF stand-in of a high-level primitive.
#pragma once

#include "engine/geometry/primitives.h"

namespace atrium {

/// How finely curved primitives are cut.
struct TessellationOptions {
    int segments = 32; ///< around a full circle, at least 8
};

/// Triangles of any primitive as mesh data in its own coordinates: counter-clockwise seen from the front side, smooth
/// normals on curved sides, creases where the surface has one, texture coordinates of the primitive's [0,1]^2 domain,
/// one part. A Mesh is returned as it is (shared, not copied). Degenerate input gives empty data, never NaN.
std::shared_ptr<const MeshData> tessellate(const Geometry& geometry, const TessellationOptions& options = {});

} // namespace atrium
