#include "engine/geometry/tessellate.h"
#include "engine/layers/surface_layer.h"

#include <unordered_map>

namespace atrium {

DisplayMesh make_display_mesh(const Shape& shape, std::size_t part) {
    const std::shared_ptr<const MeshData> data = tessellate(shape.geometry);
    DisplayMesh out;
    if (part >= data->parts.size()) {
        return out;
    }
    const MeshPart& range = data->parts[part];
    const bool flat = data->normals.empty();
    std::unordered_map<std::uint32_t, std::uint32_t> copied;
    const auto copy_vertex = [&](std::uint32_t v, const vec3& normal) {
        out.positions.push_back(data->positions[v]);
        out.normals.push_back(normal);
        for (const auto& [from, to] :
             {std::pair{&data->texcoords0, &out.texcoords0}, {&data->texcoords1, &out.texcoords1}}) {
            if (!from->empty()) {
                to->push_back((*from)[v]);
            }
        }
        if (!data->colors.empty()) {
            out.colors.push_back(data->colors[v]);
        }
        return std::uint32_t(out.positions.size() - 1);
    };
    for (std::uint32_t i = range.first_index; i + 2 < range.first_index + range.index_count; i += 3) {
        const std::uint32_t* t = &data->indices[i];
        const vec3 cross =
            glm::cross(data->positions[t[1]] - data->positions[t[0]], data->positions[t[2]] - data->positions[t[0]]);
        const float length = glm::length(cross);
        if (!(length > 0.0F)) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            if (flat) {
                out.indices.push_back(copy_vertex(t[k], cross / length));
                continue;
            }
            const auto [it, fresh] = copied.try_emplace(t[k], 0);
            if (fresh) {
                it->second = copy_vertex(t[k], data->normals[t[k]]);
            }
            out.indices.push_back(it->second);
        }
    }
    return out;
}

} // namespace atrium
