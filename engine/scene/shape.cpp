#include "engine/scene/shape.h"

namespace atrium {

std::size_t part_count(const Shape& shape) {
    const auto* mesh = std::get_if<Mesh>(&shape.geometry);
    return mesh != nullptr ? mesh->data->parts.size() : 1;
}

const char* shape_kind(const Shape& shape) {
    static constexpr const char* kNames[] = {"Polygon", "Box", "Sphere", "Cylinder", "Cone", "Disc", "Mesh"};
    return kNames[shape.geometry.index()];
}

} // namespace atrium
