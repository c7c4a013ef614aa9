// A shape of the document: geometry with a name, shared by the nodes that show it.
#pragma once

#include "engine/base/ids.h"
#include "engine/geometry/primitives.h"

#include <string>

namespace atrium {

/// A shape of the document; several nodes may refer to one (instancing).
struct Shape {
    std::string name;
    Geometry geometry;
    std::string extras; ///< JSON text of the file's own extras, kept through a round trip; empty = none
    friend bool operator==(const Shape&, const Shape&) = default;
};
using ShapeId = Id<Shape>;

/// Number of separately materialed parts: mesh parts, 1 for every other shape.
std::size_t part_count(const Shape& shape);
/// "Polygon", "Box", "Sphere", "Cylinder", "Cone", "Disc" or "Mesh".
const char* shape_kind(const Shape& shape);

} // namespace atrium
