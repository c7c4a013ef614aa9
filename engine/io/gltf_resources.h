// Buffers and images of a document, fetched under the rule that only the scene's own folder is opened, and tinygltf's model.
#pragma once

#include "engine/io/gltf_container.h"
#include "engine/io/gltf_read_context.h"

namespace atrium::gltf {

struct Resources {
    std::vector<std::vector<std::uint8_t>> buffers; ///< exactly byteLength bytes each
    std::vector<EncodedImage> images;
    std::uint64_t file_bytes = 0; ///< all files read, the scene file included
};

/// Fetches buffers (refused when one is missing or short) and images (a missing one is a warning in `problems`).
Resources fetch_resources(const std::filesystem::path& file, Container& container, std::uint64_t scene_bytes,
                          std::vector<Problem>& problems);

/// Content of a data: URI; false when it is not base64.
bool decode_data_uri(const std::string& uri, std::string& mime_type, std::vector<std::uint8_t>& out);

/// Parses a checked document with tinygltf, which reads the given buffers through callbacks and never a file. The buffers
/// are moved into the model.
std::shared_ptr<const tinygltf::Model> parse_model(const Json& root, std::vector<std::vector<std::uint8_t>> buffers);

} // namespace atrium::gltf
