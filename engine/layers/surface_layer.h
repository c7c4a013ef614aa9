// What is shown of one surface: a conforming triangle mesh in the node's own coordinates and the light on its vertices.
#pragma once

#include "engine/base/units.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace atrium {

/// Triangles to draw, in the shape's own (local) coordinates, so that a moved node is drawn at its new place at once.
/// No T-vertices: neighbours share vertices (or have equal ones across creases).
struct DisplayMesh {
    std::vector<vec3> positions;
    std::vector<vec3> normals;    ///< unit, one per vertex, on the front side
    std::vector<vec2> texcoords0; ///< empty or one per vertex
    std::vector<vec2> texcoords1;
    std::vector<vec3> colors; ///< linear vertex colours, empty or one per vertex
    std::vector<std::uint32_t> indices;
    friend bool operator==(const DisplayMesh&, const DisplayMesh&) = default;
};

/// Light on one (node, part). Radiance seen = emitted + reflectance * irradiance / pi, textures applied by the viewer.
struct SurfaceLayer {
    NodeId node;
    std::uint32_t part = 0;
    std::shared_ptr<const DisplayMesh> mesh; ///< never null
    std::vector<Rgb> irradiance_front;       ///< lux per vertex, diffuse and direct together
    std::vector<Rgb> irradiance_back;        ///< empty when the back side is never lit (solids, one-sided materials)
};

/// Unlit triangles of a node's part: what is drawn before (or without) a solution. Empty data for a part without area.
DisplayMesh make_display_mesh(const Shape& shape, std::size_t part);

} // namespace atrium
