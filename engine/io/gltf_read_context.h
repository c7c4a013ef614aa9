// What the parts of the glTF reader share. Internal to engine/io; tinygltf is only declared here.
#pragma once

#include "engine/io/gltf_json.h"
#include "engine/io/scene_file.h"

#include <map>
#include <memory>

namespace tinygltf {
class Model;
}

namespace atrium::gltf {

/// Counts what reading allocates against the cap of scene_file.h, before it is allocated.
class MemoryBudget {
public:
    explicit MemoryBudget(std::uint64_t limit) : limit_(limit) {}
    /// Refuses when the file asks for more than its size can explain.
    void charge(std::uint64_t bytes, const std::string& where) {
        if (!try_charge(bytes)) {
            refuse(where, "needs more memory than a file of this size may take (" + std::to_string(limit_ >> 20) + " MiB)",
                   "The file is damaged or made to exhaust memory.");
        }
    }
    [[nodiscard]] bool try_charge(std::uint64_t bytes) {
        if (bytes > limit_ - used_) {
            return false;
        }
        used_ += bytes;
        return true;
    }
    [[nodiscard]] std::uint64_t left() const { return limit_ - used_; }

private:
    std::uint64_t limit_;
    std::uint64_t used_ = 0;
};

/// An image file as the scene file holds it; bytes are null when it could not be had.
struct EncodedImage {
    std::shared_ptr<const std::vector<std::uint8_t>> bytes;
    std::string mime_type;
    std::string uri; ///< relative path, not escaped; empty = embedded
};

struct ReadContext {
    const Json& root;
    const tinygltf::Model& model;
    MemoryBudget& budget;
    LoadedScene& out;

    std::vector<TextureId> textures;                         ///< by glTF texture
    std::vector<MaterialId> materials;                       ///< by glTF material
    std::vector<std::shared_ptr<const PhotometricWeb>> webs; ///< by profile of EXT_lights_ies; null: could not be read
    std::vector<LightId> lights;                             ///< by glTF light; none for one that was left out
    std::vector<CameraId> cameras;                           ///< by glTF camera
    struct LoadedMesh {
        ShapeId shape; ///< none when nothing of it can be drawn
        std::vector<MaterialId> materials;
        std::size_t triangles = 0;
        Mesh stand_in; ///< the triangles of the file, also where the shape is a high-level primitive; data may be null
    };
    std::vector<LoadedMesh> meshes; ///< by glTF mesh

    void note(std::string where, std::string what, std::string hint = {}) {
        add(Problem::Severity::Note, {}, std::move(where), std::move(what), std::move(hint));
    }
    void warn(std::string where, std::string what, std::string hint = {}) {
        add(Problem::Severity::Warning, {}, std::move(where), std::move(what), std::move(hint));
    }
    void add(Problem::Severity severity, NodeId node, std::string where, std::string what, std::string hint) {
        out.problems.push_back({severity, node, std::move(where), std::move(what), std::move(hint)});
    }
    /// What holds for many elements is reported once, with their number.
    void count(const std::string& what) { ++counted[what]; }
    std::map<std::string, int> counted;
};

/// In the order in which read_scene() calls them; each fills its part of the context and of the scene.
void read_textures(ReadContext& context, const std::vector<EncodedImage>& images); // gltf_textures.cpp
void read_materials(ReadContext& context);                                         // gltf_materials.cpp
void read_meshes(ReadContext& context);                                            // gltf_meshes.cpp
void read_photometry(ReadContext& context, const std::filesystem::path& folder);   // gltf_photometry.cpp
void read_lights(ReadContext& context);                                            // gltf_lights.cpp
void read_cameras(ReadContext& context);                                           // gltf_lights.cpp
void read_nodes(ReadContext& context);                                             // gltf_nodes.cpp

/// The light of a node: `punctual`, or one made from the profile that the node names.
LightId node_photometry(ReadContext& context, const Json& node, LightId punctual,
                        const std::string& where); // gltf_photometry.cpp

/// Name and number of problems are fixed texts here so that a value outside its range reads the same everywhere.
float clamped(ReadContext& context, const Json& object, const char* key, float fallback, float least, float most,
              const std::string& where);

} // namespace atrium::gltf
