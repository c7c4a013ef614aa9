// What the parts of the glTF writer share. Internal to engine/io.
#pragma once

#include "engine/io/gltf_json.h"
#include "engine/scene/scene.h"

#include <filesystem>
#include <map>
#include <span>
#include <vector>

namespace atrium::gltf {

/// An image or photometric file to be written beside a .gltf.
struct ImageFile {
    std::string path; ///< relative to the scene file
    std::shared_ptr<const std::vector<std::uint8_t>> bytes;
    bool on_disk = false; ///< the same bytes are there already
};

/// A document under construction: JSON, binary buffer, and the glTF index of every resource in use.
struct WriteContext {
    const Scene& scene;
    bool embed_images;            ///< in the binary buffer; else files beside the scene
    std::filesystem::path folder; ///< of the scene file
    std::string stem;             ///< of the scene file's name

    Json root = Json::object();
    std::vector<std::uint8_t> binary;
    std::vector<ImageFile> image_files;

    std::vector<NodeId> nodes; ///< in tree order: the glTF index of a node is its position
    std::map<TextureId, int> textures;
    std::map<MaterialId, int> materials;
    std::map<LightId, int> lights;
    std::vector<Photometry> profiles; ///< of EXT_lights_ies, in their order
    std::map<CameraId, int> cameras;
    /// A glTF mesh names its materials, our nodes do: one mesh per shape and list of materials. -1 = nothing to draw.
    std::map<std::pair<ShapeId, std::vector<MaterialId>>, int> meshes;

    /// Appends an element to a top-level array and returns its index.
    int add(const char* section, Json element) {
        Json& array = root[section];
        array.push_back(std::move(element));
        return int(array.size()) - 1;
    }
    /// Appends bytes to the binary buffer, aligned to 4, and returns the index of their buffer view. 0 = leave it out.
    int add_view(std::span<const std::uint8_t> bytes, int target = 0, int stride = 0);
};

/// Materials of a node's shape, one per part; ids that are not live become none.
std::vector<MaterialId> part_materials(const Scene& scene, const Node& node);
/// Puts back JSON text that the reader kept (extras).
void put_text(Json& object, const char* key, const std::string& json_text);

/// `wish`, or `wish-2`, `wish-3`, ...: a path beside the scene that is free or holds these bytes already (`on_disk`). A file
/// that holds something else is never overwritten.
std::string free_file_name(const WriteContext& context, const std::string& wish, const std::vector<std::uint8_t>& bytes,
                           bool& on_disk); // gltf_write_materials.cpp
/// Index of the profile that holds a light's distribution; written when it is asked for first.
int write_profile(WriteContext& context, const Photometry& photometry); // gltf_photometry.cpp
/// Makes a node refer to the profile of its light, if that has one.
void put_profile(const WriteContext& context, const Light& light, Json& node); // gltf_photometry.cpp

void write_textures(WriteContext& context);  // gltf_write_materials.cpp
void write_materials(WriteContext& context); // gltf_write_materials.cpp
void write_lights(WriteContext& context);    // gltf_write_nodes.cpp
void write_cameras(WriteContext& context);   // gltf_write_nodes.cpp
void write_meshes(WriteContext& context);    // gltf_write_meshes.cpp
void write_nodes(WriteContext& context);     // gltf_write_nodes.cpp

} // namespace atrium::gltf
