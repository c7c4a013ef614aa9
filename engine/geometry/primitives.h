// Geometric primitives in their own coordinates. High-level primitives stay what they are; a mesh is shared, immutable data.
#pragma once

#include "engine/base/math.h"

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

namespace atrium {

/// Planar polygon in its local plane z = 0, front side +z. Outer ring counter-clockwise seen from +z, holes clockwise;
/// rings are not closed (last point != first). Metres before the node's transform.
struct Polygon {
    std::vector<vec2> outer;
    std::vector<std::vector<vec2>> holes;
    friend bool operator==(const Polygon&, const Polygon&) = default;
};
/// Box centred at the origin; faces outward.
struct Box {
    vec3 size{1.0F};
    friend bool operator==(const Box&, const Box&) = default;
};
/// Sphere about the origin.
struct Sphere {
    float radius = 0.5F;
    friend bool operator==(const Sphere&, const Sphere&) = default;
};
/// Cylinder along y, centred at the origin. Open ended when capped is false.
struct Cylinder {
    float radius = 0.5F;
    float height = 1.0F;
    bool capped = true;
    friend bool operator==(const Cylinder&, const Cylinder&) = default;
};
/// Cone or frustum along y, centred at the origin; base at -height/2.
struct Cone {
    float base_radius = 0.5F;
    float top_radius = 0.0F;
    float height = 1.0F;
    bool capped = true;
    friend bool operator==(const Cone&, const Cone&) = default;
};
/// Disc in the local plane z = 0, front side +z.
struct Disc {
    float radius = 0.5F;
    friend bool operator==(const Disc&, const Disc&) = default;
};

/// One glTF primitive: triangles [first_index, first_index + index_count) drawn with the node's material of that part.
struct MeshPart {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0; ///< multiple of 3
    friend bool operator==(const MeshPart&, const MeshPart&) = default;
};

/// Indexed triangles, validated: indices in range, all numbers finite. Immutable once shared.
struct MeshData {
    std::vector<vec3> positions;
    std::vector<vec3> normals;    ///< per vertex, unit; empty = flat shaded
    std::vector<vec2> texcoords0; ///< empty or one per vertex
    std::vector<vec2> texcoords1; ///< empty or one per vertex
    std::vector<vec3> colors;     ///< linear COLOR_0, empty or one per vertex
    std::vector<std::uint32_t> indices;
    std::vector<MeshPart> parts;
    friend bool operator==(const MeshData&, const MeshData&) = default;
};
struct Mesh {
    std::shared_ptr<const MeshData> data; ///< never null
    friend bool operator==(const Mesh& a, const Mesh& b) {
        return a.data == b.data || (a.data && b.data && *a.data == *b.data);
    }
};

/// Any primitive.
using Geometry = std::variant<Polygon, Box, Sphere, Cylinder, Cone, Disc, Mesh>;

/// Bounds in the primitive's own coordinates.
Box3 local_bounds(const Geometry& geometry);

} // namespace atrium
