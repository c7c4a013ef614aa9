// Shape -> glTF meshes: positions, normals, texture coordinates, colours and indices in the binary buffer.
#include "engine/geometry/tessellate.h"
#include "engine/io/gltf_extensions.h"
#include "engine/io/gltf_shape_json.h"
#include "engine/io/gltf_write_context.h"

#include <algorithm>

namespace atrium::gltf {
namespace {

constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr int kFloat = 5126;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;

template <class T> std::span<const std::uint8_t> bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)};
}

/// Vertices [begin, end) that a part uses.
struct Range {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// One range per drawn part when each part has vertices of its own, following each other (as the reader makes them); else
/// nothing, and all parts share all vertices. Either way the reader builds the same MeshData again.
std::vector<Range> own_ranges(const MeshData& mesh, const std::vector<MeshPart>& parts) {
    std::vector<Range> out;
    std::uint32_t next = 0;
    for (const MeshPart& part : parts) {
        const auto first = mesh.indices.begin() + part.first_index;
        const auto [low, high] = std::minmax_element(first, first + part.index_count);
        if (*low != next) {
            return {};
        }
        next = *high + 1;
        out.push_back({*low, next});
    }
    return next == mesh.positions.size() ? out : std::vector<Range>();
}

class MeshWriter {
public:
    MeshWriter(WriteContext& context, const MeshData& mesh) : context_(context), mesh_(mesh) {
        for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
            if (mesh.parts[i].index_count > 0) {
                parts_.push_back(mesh.parts[i]);
                part_numbers_.push_back(i);
            }
        }
        if (!parts_.empty()) {
            write_vertices();
            write_indices();
        }
    }
    /// The "primitives" array with these materials, one per part of the mesh data; empty when nothing can be drawn.
    [[nodiscard]] Json primitives(const std::vector<MaterialId>& materials) const {
        Json out = Json::array();
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            const std::size_t range = ranges_.size() == 1 ? 0 : k;
            const MaterialId material = part_numbers_[k] < materials.size() ? materials[part_numbers_[k]] : MaterialId{};
            Json primitive = {{"attributes", with_texcoords(range, material)}, {"indices", indices_[k]}};
            if (const auto it = context_.materials.find(material); it != context_.materials.end()) {
                primitive["material"] = it->second;
            }
            out.push_back(std::move(primitive));
        }
        return out;
    }

private:
    /// glTF wants the texture coordinates that a material names, and no gap in their numbers. Sets that the mesh lacks
    /// become accessors without data (all zeros, no bytes), which the reader takes for absent.
    [[nodiscard]] Json with_texcoords(std::size_t range, MaterialId id) const {
        Json out = attributes_[range];
        int sets = out.contains("TEXCOORD_1") ? 2 : 0;
        const auto need = [&sets](const TextureRef& ref) { sets = ref ? std::max(sets, ref.texcoord + 1) : sets; };
        if (const Material* material = context_.scene.materials.find(id)) {
            need(material->base_color_texture);
            need(material->emissive_texture);
            for (const auto& other : material->other_textures) {
                need(other.ref);
            }
        }
        for (int set = 0; set < sets; ++set) {
            const std::string name = "TEXCOORD_" + std::to_string(set);
            if (!out.contains(name)) {
                const std::uint32_t count = ranges_[range].end - ranges_[range].begin;
                out[name] = context_.add("accessors", {{"componentType", kFloat}, {"count", count}, {"type", "VEC2"}});
            }
        }
        return out;
    }

    void write_vertices() {
        ranges_ = own_ranges(mesh_, parts_);
        if (ranges_.empty()) {
            ranges_.push_back({0, std::uint32_t(mesh_.positions.size())});
        }
        attributes_.resize(ranges_.size());
        add_attribute("POSITION", mesh_.positions, "VEC3");
        add_attribute("NORMAL", unit_normals(), "VEC3");
        add_attribute("TEXCOORD_0", mesh_.texcoords0, "VEC2");
        add_attribute("TEXCOORD_1", mesh_.texcoords1, "VEC2");
        add_attribute("COLOR_0", mesh_.colors, "VEC3");
    }

    /// As they are, unless one breaks glTF's rule of unit length.
    [[nodiscard]] std::vector<vec3> unit_normals() const {
        std::vector<vec3> out = mesh_.normals;
        for (vec3& n : out) {
            const float square = glm::dot(n, n);
            if (!(std::abs(square - 1.0F) < 1e-4F)) {
                n = square > 1e-12F && std::isfinite(square) ? n / std::sqrt(square) : vec3(0.0F, 0.0F, 1.0F);
            }
        }
        return out;
    }

    template <class T> void add_attribute(const char* name, const std::vector<T>& values, const char* type) {
        if (values.empty() || values.size() != mesh_.positions.size()) {
            return;
        }
        const int view = context_.add_view(bytes_of(values), kArrayBuffer, int(sizeof(T)));
        for (std::size_t r = 0; r < ranges_.size(); ++r) {
            Json accessor = {{"bufferView", view},
                             {"componentType", kFloat},
                             {"count", ranges_[r].end - ranges_[r].begin},
                             {"type", type}};
            if (ranges_[r].begin != 0) {
                accessor["byteOffset"] = std::uint64_t(ranges_[r].begin) * sizeof(T);
            }
            if (std::string_view(name) == "POSITION") {
                Box3 box;
                for (std::uint32_t i = ranges_[r].begin; i < ranges_[r].end; ++i) {
                    box.add(mesh_.positions[i]);
                }
                // The full value, not its short form: validators compare with the stored float bit for bit.
                accessor["min"] = {double(box.min.x), double(box.min.y), double(box.min.z)};
                accessor["max"] = {double(box.max.x), double(box.max.y), double(box.max.z)};
            }
            attributes_[r][name] = context_.add("accessors", std::move(accessor));
        }
    }

    void write_indices() {
        // 65535 itself is the restart value of strips and must not occur.
        const bool is_short = std::all_of(ranges_.begin(), ranges_.end(), [](Range r) { return r.end - r.begin < 65535; });
        std::vector<std::uint8_t> bytes;
        std::vector<Json> accessors;
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            const std::uint32_t first_vertex = ranges_[ranges_.size() == 1 ? 0 : k].begin;
            bytes.resize((bytes.size() + 3) & ~std::size_t(3));
            accessors.push_back({{"componentType", is_short ? kUnsignedShort : kUnsignedInt},
                                 {"count", parts_[k].index_count},
                                 {"type", "SCALAR"}});
            if (!bytes.empty()) {
                accessors.back()["byteOffset"] = bytes.size();
            }
            for (std::uint32_t i = 0; i < parts_[k].index_count; ++i) {
                const std::uint32_t v = mesh_.indices[parts_[k].first_index + i] - first_vertex;
                for (int shift = 0; shift < (is_short ? 16 : 32); shift += 8) {
                    bytes.push_back(std::uint8_t(v >> shift));
                }
            }
        }
        const int view = context_.add_view(bytes, kElementArrayBuffer);
        for (Json& accessor : accessors) {
            accessor["bufferView"] = view;
            indices_.push_back(context_.add("accessors", std::move(accessor)));
        }
    }

    WriteContext& context_;
    const MeshData& mesh_;
    std::vector<MeshPart> parts_; ///< those that hold triangles
    std::vector<std::size_t> part_numbers_;
    std::vector<Range> ranges_;
    std::vector<Json> attributes_; ///< one for all parts, or one each
    std::vector<int> indices_;
};

/// glTF cannot say "a mesh of nothing": a degenerate high-level primitive is represented by one triangle without area.
std::shared_ptr<const MeshData> stand_in(const Geometry& geometry) {
    std::shared_ptr<const MeshData> mesh = tessellate(geometry);
    if (!mesh->indices.empty() || std::holds_alternative<Mesh>(geometry)) {
        return mesh;
    }
    auto nothing = std::make_shared<MeshData>();
    nothing->positions.assign(3, vec3(0.0F));
    nothing->indices = {0, 1, 2};
    nothing->parts = {{0, 3}};
    return nothing;
}

} // namespace

void write_meshes(WriteContext& context) {
    // Which lists of materials each shape is shown with, in tree order.
    std::map<ShapeId, std::vector<std::vector<MaterialId>>> uses;
    for (const NodeId id : context.nodes) {
        const Node& node = *context.scene.nodes.find(id);
        if (context.scene.shapes.contains(node.shape)) {
            const std::vector<MaterialId> materials = part_materials(context.scene, node);
            auto& lists = uses[node.shape];
            if (std::find(lists.begin(), lists.end(), materials) == lists.end()) {
                lists.push_back(materials);
            }
        }
    }
    for (const auto& [id, lists] : uses) {
        const Shape& shape = *context.scene.shapes.find(id);
        const std::shared_ptr<const MeshData> data = stand_in(shape.geometry);
        const MeshWriter writer(context, *data);
        for (const std::vector<MaterialId>& materials : lists) {
            Json mesh = {{"primitives", writer.primitives(materials)}};
            if (mesh["primitives"].empty()) {
                context.meshes[{id, materials}] = -1;
                continue;
            }
            if (!shape.name.empty()) {
                mesh["name"] = shape.name;
            }
            put_text(mesh, "extras", shape.extras);
            if (Json high_level = shape_to_json(shape.geometry); !high_level.is_null()) {
                mesh["extensions"][kShape] = std::move(high_level);
            }
            context.meshes[{id, materials}] = context.add("meshes", std::move(mesh));
        }
    }
}

} // namespace atrium::gltf
