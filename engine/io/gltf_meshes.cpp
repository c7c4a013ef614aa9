// glTF meshes -> Shape: vertices of all primitives in one MeshData, one part per primitive that holds triangles.
#include "engine/io/gltf_accessor.h"
#include "engine/io/gltf_extensions.h"
#include "engine/io/gltf_read_context.h"
#include "engine/io/gltf_shape_json.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

namespace atrium::gltf {
namespace {

/// Vertices of one primitive before they are joined with the others of the mesh.
struct Vertices {
    std::vector<vec3> positions;
    std::vector<vec3> normals;
    std::vector<vec2> texcoords[2];
    std::vector<vec3> colors;
};

/// Texture coordinates without data, all 0: the writer's way of saying that the mesh has none (glTF wants an accessor where
/// a material names one).
bool is_empty_texcoord(const Json& root, const std::string& attribute, int accessor) {
    const Json& json = section(root, "accessors")[std::size_t(accessor)];
    return attribute.starts_with("TEXCOORD_") && !json.contains("bufferView") && !json.contains("sparse");
}

class MeshReader {
public:
    MeshReader(ReadContext& context, std::size_t mesh)
        : context_(context), mesh_(context.model.meshes[mesh]), where_(place(context.root, "meshes", mesh)) {}

    /// Reads all primitives; `materials` gets one glTF material index (or -1) per part.
    std::shared_ptr<const MeshData> read(std::vector<int>& materials);

private:
    struct Primitive {
        std::size_t block; ///< in blocks_
        std::vector<std::uint32_t> indices;
        int material;
    };
    void read_primitive(const tinygltf::Primitive& primitive, const std::string& where);
    std::size_t vertex_block(const tinygltf::Primitive& primitive, const std::string& where);
    Vertices read_vertices(const tinygltf::Primitive& primitive, const std::string& where);
    FloatElements attribute(const std::map<std::string, int>& attributes, const char* name, std::size_t least,
                            std::size_t most, const std::string& where, NonFinite policy);
    void morph(const tinygltf::Primitive& primitive, Vertices& vertices, const std::string& where);
    void flatten(Primitive& primitive);

    ReadContext& context_;
    const tinygltf::Mesh& mesh_;
    std::string where_;
    std::vector<Vertices> blocks_;
    std::map<std::vector<int>, std::size_t> block_of_accessors_; ///< primitives with the same accessors share vertices
    std::vector<Primitive> primitives_;
};

/// Vertex numbers of the triangles of a primitive; strips and fans become lists.
std::vector<std::uint32_t> triangle_list(int mode, const std::vector<std::uint32_t>& v) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        return {v.begin(), v.end() - std::ptrdiff_t(v.size() % 3)};
    }
    std::vector<std::uint32_t> out;
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        // Strips are stitched together by triangles without area: they are not part of the surface.
        if (a != b && b != c && c != a) {
            out.insert(out.end(), {a, b, c});
        }
    };
    for (std::size_t i = 0; i + 2 < v.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            add(v[i + 1], v[i + 2], v[0]);
        } else {
            add(v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]);
        }
    }
    return out;
}

FloatElements MeshReader::attribute(const std::map<std::string, int>& attributes, const char* name, std::size_t least,
                                    std::size_t most, const std::string& where, NonFinite policy) {
    const auto it = attributes.find(name);
    if (it == attributes.end()) {
        return {};
    }
    FloatElements out = read_floats(context_, it->second, policy);
    if (out.components < least || out.components > most) {
        refuse(where + "/" + name, fmt::format("has {} numbers per vertex", out.components));
    }
    return out;
}

void MeshReader::morph(const tinygltf::Primitive& primitive, Vertices& vertices, const std::string& where) {
    context_.count("meshes have morph targets: their default pose is shown, it cannot be changed and is saved as it is");
    for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
        const double weight = t < mesh_.weights.size() ? mesh_.weights[t] : 0.0;
        if (weight == 0.0) {
            continue;
        }
        const auto add = [&](const char* name, std::vector<vec3>& values) {
            const FloatElements delta = attribute(primitive.targets[t], name, 3, 3, where, NonFinite::Refuse);
            for (std::size_t i = 0; i < delta.count() && i < values.size(); ++i) {
                values[i] += float(weight) * delta.at3(i);
            }
        };
        add("POSITION", vertices.positions);
        add("NORMAL", vertices.normals);
    }
    for (const vec3& p : vertices.positions) {
        if (!is_finite(p)) {
            refuse(where, "its morph targets move a vertex to infinity");
        }
    }
}

Vertices MeshReader::read_vertices(const tinygltf::Primitive& primitive, const std::string& where) {
    Vertices out;
    const FloatElements positions = attribute(primitive.attributes, "POSITION", 3, 3, where, NonFinite::Refuse);
    const FloatElements normals = attribute(primitive.attributes, "NORMAL", 3, 3, where, NonFinite::Keep);
    const FloatElements colors = attribute(primitive.attributes, "COLOR_0", 3, 4, where, NonFinite::Keep);
    const std::size_t count = positions.count();
    context_.budget.charge(std::uint64_t(count) * sizeof(vec3) * 4, where);
    for (std::size_t i = 0; i < count; ++i) {
        out.positions.push_back(positions.at3(i));
    }
    for (std::size_t i = 0; i < normals.count(); ++i) {
        out.normals.push_back(normals.at3(i));
    }
    for (int set = 0; set < 2; ++set) {
        const char* name = set == 0 ? "TEXCOORD_0" : "TEXCOORD_1";
        const auto given = primitive.attributes.find(name);
        if (given != primitive.attributes.end() && is_empty_texcoord(context_.root, name, given->second)) {
            continue;
        }
        const FloatElements uv = attribute(primitive.attributes, name, 2, 2, where, NonFinite::Keep);
        for (std::size_t i = 0; i < uv.count(); ++i) {
            const bool good = is_finite(uv.at2(i));
            out.texcoords[set].push_back(good ? uv.at2(i) : vec2(0.0F));
            if (!good) {
                context_.count("texture coordinates that are not finite were set to 0");
            }
        }
    }
    for (std::size_t i = 0; i < colors.count(); ++i) {
        const vec3 color = colors.at3(i);
        const vec3 good = is_finite(color) ? glm::clamp(color, vec3(0.0F), vec3(1.0F)) : vec3(1.0F);
        out.colors.push_back(good);
        if (good != color) {
            context_.count("vertex colours outside 0 to 1 were clamped");
        }
    }
    if (!primitive.targets.empty()) {
        morph(primitive, out, where);
    }
    return out;
}

std::size_t MeshReader::vertex_block(const tinygltf::Primitive& primitive, const std::string& where) {
    std::vector<int> key;
    for (const char* name : {"POSITION", "NORMAL", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"}) {
        const auto it = primitive.attributes.find(name);
        const bool has_data = it != primitive.attributes.end() && !is_empty_texcoord(context_.root, it->first, it->second);
        key.push_back(has_data ? it->second : -1);
    }
    for (const auto& target : primitive.targets) {
        for (const auto& [name, accessor] : target) {
            key.push_back(accessor);
        }
        key.push_back(-2);
    }
    const auto [it, is_new] = block_of_accessors_.try_emplace(key, blocks_.size());
    if (is_new) {
        blocks_.push_back(read_vertices(primitive, where));
    }
    return it->second;
}

void MeshReader::read_primitive(const tinygltf::Primitive& primitive, const std::string& where) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode < TINYGLTF_MODE_TRIANGLES) {
        context_.count("primitives of points or lines are not shown and will not be saved");
        return;
    }
    if (!primitive.attributes.contains("POSITION")) {
        context_.warn(where, "has no positions and is not shown");
        return;
    }
    const std::size_t block = vertex_block(primitive, where);
    const std::size_t count = blocks_[block].positions.size();
    std::vector<std::uint32_t> numbers;
    if (primitive.indices >= 0) {
        numbers = read_indices(context_, primitive.indices);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (numbers[i] >= count) {
                refuse(place(context_.root, "accessors", std::size_t(primitive.indices)),
                       fmt::format("index {} refers to vertex {}, but {} has only {}", i, numbers[i], where, count),
                       "The geometry is damaged; export the file again.");
            }
        }
    } else {
        context_.budget.charge(std::uint64_t(count) * sizeof(std::uint32_t), where);
        for (std::size_t i = 0; i < count; ++i) {
            numbers.push_back(std::uint32_t(i));
        }
    }
    if (mode == TINYGLTF_MODE_TRIANGLES && numbers.size() % 3 != 0) {
        context_.warn(where, fmt::format("has {} vertices, not a multiple of 3; the last {} are left out", numbers.size(),
                                         numbers.size() % 3));
    }
    context_.budget.charge(std::uint64_t(numbers.size()) * sizeof(std::uint32_t) * 4, where);
    std::vector<std::uint32_t> triangles = triangle_list(mode, numbers);
    if (triangles.empty()) {
        context_.warn(where, "has no triangles and is not shown");
        return;
    }
    primitives_.push_back({block, std::move(triangles), primitive.material});
}

/// Gives a primitive without normals its own flat ones: its neighbours in the mesh have smooth normals, and a mesh has
/// either normals for all vertices or none.
void MeshReader::flatten(Primitive& primitive) {
    const Vertices& from = blocks_[primitive.block];
    context_.budget.charge(std::uint64_t(primitive.indices.size()) * 64, where_);
    Vertices to;
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        const vec3 a = from.positions[primitive.indices[i]];
        const dvec3 n = glm::cross(dvec3(from.positions[primitive.indices[i + 1]] - a),
                                   dvec3(from.positions[primitive.indices[i + 2]] - a));
        const double length = glm::length(n);
        for (std::size_t k = i; k < i + 3; ++k) {
            const std::uint32_t v = primitive.indices[k];
            to.positions.push_back(from.positions[v]);
            to.normals.push_back(length > 0.0 ? vec3(n / length) : vec3(0.0F, 0.0F, 1.0F));
            for (int set = 0; set < 2; ++set) {
                if (!from.texcoords[set].empty()) {
                    to.texcoords[set].push_back(from.texcoords[set][v]);
                }
            }
            if (!from.colors.empty()) {
                to.colors.push_back(from.colors[v]);
            }
            primitive.indices[k] = std::uint32_t(k);
        }
    }
    primitive.block = blocks_.size();
    blocks_.push_back(std::move(to));
}

/// Unit normals; one that is zero or not finite is replaced by the mean of its triangles' normals.
void repair_normals(ReadContext& context, MeshData& mesh) {
    std::vector<bool> bad(mesh.normals.size(), false);
    bool any_bad = false;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        vec3& n = mesh.normals[i];
        const float square = glm::dot(n, n);
        if (!std::isfinite(square) || square < 1e-12F) {
            bad[i] = true;
            any_bad = true;
            n = vec3(0.0F);
            context.count("normals without direction were computed anew");
        } else if (std::abs(square - 1.0F) > 1e-5F) {
            n /= std::sqrt(square);
        }
    }
    if (!any_bad) {
        return;
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const vec3 a = mesh.positions[mesh.indices[i]];
        const vec3 n = glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
        for (std::size_t k = i; k < i + 3; ++k) {
            if (bad[mesh.indices[k]] && is_finite(n)) {
                mesh.normals[mesh.indices[k]] += n;
            }
        }
    }
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        if (bad[i]) {
            const double length = glm::length(dvec3(mesh.normals[i]));
            mesh.normals[i] = length > 0.0 ? vec3(dvec3(mesh.normals[i]) / length) : vec3(0.0F, 0.0F, 1.0F);
        }
    }
}

std::shared_ptr<const MeshData> MeshReader::read(std::vector<int>& materials) {
    for (std::size_t k = 0; k < mesh_.primitives.size(); ++k) {
        read_primitive(mesh_.primitives[k], where_ + "/primitives/" + std::to_string(k));
    }
    bool any_normals = false;
    bool any_texcoords[2] = {false, false};
    bool any_colors = false;
    for (const Primitive& p : primitives_) {
        any_normals = any_normals || !blocks_[p.block].normals.empty();
        any_colors = any_colors || !blocks_[p.block].colors.empty();
        for (int set = 0; set < 2; ++set) {
            any_texcoords[set] = any_texcoords[set] || !blocks_[p.block].texcoords[set].empty();
        }
    }
    auto out = std::make_shared<MeshData>();
    std::map<std::size_t, std::uint32_t> first_vertex; // of the blocks in use
    for (Primitive& p : primitives_) {
        if (any_normals && blocks_[p.block].normals.empty()) {
            flatten(p);
        }
        const auto [it, is_new] = first_vertex.try_emplace(p.block, std::uint32_t(out->positions.size()));
        if (is_new) {
            const Vertices& v = blocks_[p.block];
            if (out->positions.size() + v.positions.size() > 0xFFFFFFF0U) {
                refuse(where_, "has more than 4 thousand million vertices");
            }
            out->positions.insert(out->positions.end(), v.positions.begin(), v.positions.end());
            out->normals.insert(out->normals.end(), v.normals.begin(), v.normals.end());
            const auto append = [&](auto& all, const auto& block, auto filler, bool any) {
                all.insert(all.end(), block.begin(), block.end());
                if (any) {
                    all.resize(out->positions.size(), filler);
                }
            };
            append(out->texcoords0, v.texcoords[0], vec2(0.0F), any_texcoords[0]);
            append(out->texcoords1, v.texcoords[1], vec2(0.0F), any_texcoords[1]);
            append(out->colors, v.colors, vec3(1.0F), any_colors);
        }
        out->parts.push_back({std::uint32_t(out->indices.size()), std::uint32_t(p.indices.size())});
        for (const std::uint32_t i : p.indices) {
            out->indices.push_back(i + it->second);
        }
        materials.push_back(p.material);
    }
    repair_normals(context_, *out);
    return out;
}

/// Meshes that differ in their materials alone are one shape: a shape has no materials, its nodes do.
std::string sharing_key(const Json& root, Json mesh) {
    for (Json& primitive : mesh["primitives"]) {
        primitive.erase("material");
        Json& attributes = primitive["attributes"];
        for (const char* name : {"TEXCOORD_0", "TEXCOORD_1"}) {
            if (attributes.contains(name) && is_empty_texcoord(root, name, attributes[name].get<int>())) {
                attributes.erase(name);
            }
        }
    }
    return mesh.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Triangles without area are part of the file and stay in it, but neither give nor take light.
void count_flat(ReadContext& context, const MeshData& mesh) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const dvec3 a(mesh.positions[mesh.indices[i]]);
        const dvec3 b(mesh.positions[mesh.indices[i + 1]]);
        const dvec3 c(mesh.positions[mesh.indices[i + 2]]);
        if (glm::cross(b - a, c - a) == dvec3(0.0)) {
            context.count("triangles have no area: they are kept, but neither give nor take light");
        }
    }
}

} // namespace

void read_meshes(ReadContext& context) {
    const Json& meshes = section(context.root, "meshes");
    std::map<std::string, std::size_t> first_of_key;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const std::string where = place(context.root, "meshes", i);
        ReadContext::LoadedMesh loaded;
        const auto [same, is_new] = first_of_key.try_emplace(sharing_key(context.root, meshes[i]), i);
        std::vector<int> materials;
        if (is_new) {
            loaded.stand_in.data = MeshReader(context, i).read(materials);
            loaded.triangles = loaded.stand_in.data->indices.size() / 3;
            Shape shape;
            shape.name = text(meshes[i], "name", where);
            shape.extras = json_text(meshes[i], "extras");
            shape.geometry = loaded.stand_in;
            if (const Json* high_level = find_extension(meshes[i], kShape)) {
                if (auto geometry = shape_from_json(*high_level)) {
                    shape.geometry = std::move(*geometry);
                } else {
                    context.warn(where, std::string(kShape) + " is malformed; the mesh that stands for it is shown");
                }
            }
            if (std::holds_alternative<Mesh>(shape.geometry)) {
                count_flat(context, *loaded.stand_in.data);
            }
            if (!loaded.stand_in.data->parts.empty()) {
                loaded.shape = context.out.scene.shapes.insert(std::move(shape));
            }
        } else {
            loaded = context.meshes[same->second];
            loaded.materials.clear();
            const auto& primitives = context.model.meshes[i].primitives;
            for (const tinygltf::Primitive& p : primitives) {
                materials.push_back(p.material);
            }
        }
        // Where primitives were left out, the lists of a copy no longer match by position: read it on its own.
        if (loaded.shape && !is_new && materials.size() != loaded.stand_in.data->parts.size()) {
            materials.clear();
            loaded.stand_in.data = MeshReader(context, i).read(materials);
        }
        for (const int material : materials) {
            loaded.materials.push_back(material >= 0 ? context.materials[std::size_t(material)] : MaterialId{});
        }
        if (loaded.shape && !std::holds_alternative<Mesh>(context.out.scene.shapes.find(loaded.shape)->geometry)) {
            loaded.materials.resize(1);
        }
        context.meshes.push_back(std::move(loaded));
    }
}

} // namespace atrium::gltf
