// The outermost layer of a scene file: plain JSON text or the chunks of a GLB, split and parsed. Knows nothing of glTF's
// contents.
#pragma once

#include "engine/io/gltf_json.h"

#include <span>
#include <vector>

namespace atrium::gltf {

struct Container {
    Json root;
    std::vector<std::uint8_t> binary; ///< BIN chunk
    bool is_glb = false;
    bool has_binary = false;
    std::vector<std::string> repairs; ///< what was wrong and worked around
};

/// Splits and parses; refuses wrong headers, truncated chunks, syntax errors and JSON nested deeper than 200 levels.
Container open_container(std::vector<std::uint8_t> bytes);

/// Refuses JSON text nested deeper than 200 levels.
void check_depth(std::string_view json);

/// A GLB of this JSON and binary chunk (which may be empty); both padded to 4 bytes.
std::vector<std::uint8_t> make_glb(const std::string& json, std::span<const std::uint8_t> binary);

} // namespace atrium::gltf
