// What an update of the light changed: the difference of two solutions, texel by texel.
#pragma once

#include "engine/base/ids.h"
#include "engine/base/math.h"
#include "engine/scene/scene.h"
#include "engine/solver/solution.h"

#include <array>
#include <vector>

namespace atrium {

/// Places on one (node, part) in the node's own coordinates whose light is another.
struct ChangedSurface {
    NodeId node;
    std::uint32_t part = 0;
    std::vector<vec3> texels;
    std::vector<vec3> texel_normals; ///< of each: of its side, unit
    std::vector<vec3> vertices;
    std::vector<vec3> vertex_normals;
    std::vector<std::array<vec3, 3>> textures; ///< triangles below caustic textures that were made anew, as on the mesh
    std::vector<std::uint8_t> texture_back;    ///< of each: it is about the back side
};
struct UpdateView {
    std::vector<ChangedSurface> surfaces;
    std::size_t texels = 0, all_texels = 0; ///< changed, and how many there are
    std::size_t vertices = 0, all_vertices = 0;
    std::size_t textures = 0, all_textures = 0;
};

/// Bits that differ between two solutions of a document. What was looked at again and found the same is no change. A surface
/// that was not there or had another mesh is changed as a whole. Any thread; as long as it takes to read both.
UpdateView view_update(const Solution& before, const Solution& after);

} // namespace atrium
