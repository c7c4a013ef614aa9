#include "engine/debug/update_view.h"

#include <algorithm>
#include <map>

namespace atrium {
namespace {

using Textures = std::vector<std::shared_ptr<const CausticTexture>>;

bool same_value(const std::vector<Rgb>& a, const std::vector<Rgb>& b, std::size_t i) {
    const Rgb va = i < a.size() ? a[i] : Rgb(0.0F), vb = i < b.size() ? b[i] : Rgb(0.0F);
    return va == vb;
}

/// Samples of a map that differ, as marks; all of a tile whose level is another.
std::vector<std::uint8_t> changed_samples(const LightMap* before, const LightMap& after) {
    std::vector<std::uint8_t> out(after.image.size(), 0);
    const bool comparable = before != nullptr && before->width == after.width && before->height == after.height;
    for (std::size_t i = 0; i < after.tiles.size(); ++i) {
        const LightMap::Tile& tile = after.tiles[i];
        if (tile.used == 0) {
            continue;
        }
        const LightMap::Tile* old = comparable && before->tiles[i].used != 0 ? &before->tiles[i] : nullptr;
        const bool same_grid = old != nullptr && old->level == tile.level;
        const std::size_t side = (std::size_t(1) << tile.level) + 1;
        for (std::size_t y = 0; y < side; ++y) {
            for (std::size_t x = 0; x < side; ++x) {
                const std::size_t at = (tile.y + y) * after.image_width + tile.x + x;
                out[at] =
                    !same_grid || before->image[(old->y + y) * before->image_width + old->x + x] != after.image[at] ? 1 : 0;
            }
        }
    }
    return out;
}

std::size_t used_samples(const LightMap* map) {
    std::size_t out = 0;
    for (std::size_t i = 0; map != nullptr && i < map->tiles.size(); ++i) {
        const std::size_t side = (std::size_t(1) << map->tiles[i].level) + 1;
        out += map->tiles[i].used != 0 ? side * side : 0;
    }
    return out;
}

/// Where marked samples lie on the mesh.
void place_samples(const DisplayMesh& mesh, const LightMap& map, std::vector<std::uint8_t>& marks, bool back,
                   ChangedSurface& out) {
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        const std::uint32_t* v = &mesh.indices[t];
        const vec2 &a = mesh.light_uv[v[0]], &b = mesh.light_uv[v[1]], &c = mesh.light_uv[v[2]];
        const vec2 u = b - a, w = c - a;
        const float area = u.x * w.y - u.y * w.x;
        if (a.x < 0.0F || area == 0.0F) {
            continue;
        }
        const vec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
        const auto last = [](float x, std::uint32_t size) { return std::min(std::uint32_t(std::max(x, 0.0F)) + 1, size); };
        const vec3 normal = back ? -mesh.normals[v[0]] : mesh.normals[v[0]];
        for (std::uint32_t j = std::uint32_t(low.y); j < last(high.y, map.height); ++j) {
            for (std::uint32_t i = std::uint32_t(low.x); i < last(high.x, map.width); ++i) {
                const LightMap::Tile& tile = map.tiles[std::size_t(j) * map.width + i];
                if (tile.used == 0) {
                    continue;
                }
                const std::size_t steps = std::size_t(1) << tile.level;
                for (std::size_t y = 0; y <= steps; ++y) {
                    for (std::size_t x = 0; x <= steps; ++x) {
                        std::uint8_t& mark = marks[(tile.y + y) * map.image_width + tile.x + x];
                        if (mark == 0) {
                            continue;
                        }
                        const vec2 p = vec2(float(i) + float(x) / float(steps), float(j) + float(y) / float(steps)) - a;
                        const float s = (p.x * w.y - p.y * w.x) / area, r = (u.x * p.y - u.y * p.x) / area;
                        constexpr float kSlack = -1e-4F;
                        if (s < kSlack || r < kSlack || s + r > 1.0F - kSlack) {
                            continue;
                        }
                        mark = 0; // edges belong to several triangles
                        const vec3& o = mesh.positions[v[0]];
                        out.texels.push_back(o + (mesh.positions[v[1]] - o) * s + (mesh.positions[v[2]] - o) * r);
                        out.texel_normals.push_back(normal);
                    }
                }
            }
        }
    }
}

/// Textures that are new, and the triangles below them.
std::size_t place_textures(const DisplayMesh& mesh, const Textures* before, const Textures& after, bool back,
                           ChangedSurface& out) {
    std::size_t changed = 0;
    for (const auto& texture : after) {
        if (before != nullptr && std::any_of(before->begin(), before->end(), [&](const auto& old) {
                return old == texture || (old->low == texture->low && old->high == texture->high &&
                                          old->width == texture->width && old->image == texture->image);
            })) {
            continue;
        }
        ++changed;
        for (std::size_t t = 0; t + 2 < mesh.indices.size() && !mesh.light_uv.empty(); t += 3) {
            const std::uint32_t* v = &mesh.indices[t];
            const vec2 &a = mesh.light_uv[v[0]], &b = mesh.light_uv[v[1]], &c = mesh.light_uv[v[2]];
            const vec2 middle = (a + b + c) / 3.0F;
            if (a.x >= 0.0F && middle == glm::clamp(middle, texture->low, texture->high)) {
                out.textures.push_back({mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]});
                out.texture_back.push_back(back ? 1 : 0);
            }
        }
    }
    return changed;
}

} // namespace

UpdateView view_update(const Solution& before, const Solution& after) {
    std::map<std::pair<NodeId, std::uint32_t>, const SurfaceLayer*> old;
    for (const auto& layer : before.surfaces) {
        old[{layer->node, layer->part}] = layer.get();
    }
    UpdateView out;
    for (const auto& layer : after.surfaces) {
        const auto found = old.find({layer->node, layer->part});
        const SurfaceLayer* was = found != old.end() ? found->second : nullptr;
        const DisplayMesh& mesh = *layer->mesh;
        out.all_vertices += mesh.positions.size();
        for (const bool back : {false, true}) {
            out.all_texels += used_samples((back ? layer->direct_map_back : layer->direct_map_front).get());
            out.all_textures += (back ? layer->caustic_textures_back : layer->caustic_textures_front).size();
        }
        if (was == layer.get()) {
            continue;
        }
        ChangedSurface surface;
        surface.node = layer->node;
        surface.part = layer->part;
        const bool same_mesh = was != nullptr && (was->mesh == layer->mesh || *was->mesh == *layer->mesh);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const bool same = same_mesh && same_value(was->irradiance_front, layer->irradiance_front, i) &&
                              same_value(was->irradiance_back, layer->irradiance_back, i) &&
                              same_value(was->direct_front, layer->direct_front, i) &&
                              same_value(was->direct_back, layer->direct_back, i) &&
                              same_value(was->caustic_front, layer->caustic_front, i) &&
                              same_value(was->caustic_back, layer->caustic_back, i);
            if (!same) {
                surface.vertices.push_back(mesh.positions[i]);
                surface.vertex_normals.push_back(i < mesh.normals.size() ? mesh.normals[i] : vec3(0.0F));
            }
        }
        out.vertices += surface.vertices.size();
        for (const bool back : {false, true}) {
            const auto& map = back ? layer->direct_map_back : layer->direct_map_front;
            const LightMap* old_map = same_mesh ? (back ? was->direct_map_back : was->direct_map_front).get() : nullptr;
            if (map && map.get() != old_map) {
                std::vector<std::uint8_t> marks = changed_samples(old_map, *map);
                out.texels += std::size_t(std::count(marks.begin(), marks.end(), 1));
                place_samples(mesh, *map, marks, back, surface);
            }
            const Textures* old_textures =
                same_mesh ? &(back ? was->caustic_textures_back : was->caustic_textures_front) : nullptr;
            out.textures += place_textures(
                mesh, old_textures, back ? layer->caustic_textures_back : layer->caustic_textures_front, back, surface);
        }
        if (!surface.vertices.empty() || !surface.texels.empty() || !surface.textures.empty()) {
            out.surfaces.push_back(std::move(surface));
        }
    }
    return out;
}

} // namespace atrium
