// Structure of a glTF document, checked on the raw JSON before tinygltf sees it (tinygltf 2.7 is not a validator).
#pragma once

#include "engine/io/gltf_json.h"

#include <vector>

namespace atrium::gltf {

/// Refuses another version of glTF and, by name, extensions that the file requires and we do not know.
void check_requirements(const Json& root);
/// Names in extensionsUsed that the reader does not interpret, each once, in the file's order.
std::vector<std::string> unknown_extensions(const Json& root);

/// Every reference in range, buffer views inside buffers, accessors inside views (overflow-safe), numbers of the right type.
void check_buffers(const Json& root, bool has_binary_chunk);
void check_accessors(const Json& root);
void check_meshes(const Json& root);
void check_textures(const Json& root);
/// References of nodes and scenes; no node has two parents or is its own ancestor.
void check_nodes(const Json& root);

/// Bytes of one component (1, 2, 4) and number of components (1 to 16) of glTF's constants; 0 for unknown ones.
std::size_t component_size(std::uint64_t component_type);
std::size_t component_count(const std::string& type);

} // namespace atrium::gltf
