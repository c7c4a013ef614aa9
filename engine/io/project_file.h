// What a .atrium file adds to a plain GLB: the solution, compressed and guarded by a hash (gltf_extensions.h lists the
// fields).
#pragma once

#include "engine/base/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace atrium::gltf {

/// A solution as it lies in the file.
struct PackedSolution {
    std::vector<std::uint8_t> bytes; ///< zstd frame
    std::uint64_t byte_length = 0;   ///< decoded
    std::string hash;                ///< of the decoded bytes
};

PackedSolution pack_solution(std::span<const std::byte> solution);

/// The decoded bytes; an error when the frame is damaged, longer than announced or than `most`, or the hash differs.
Result<std::vector<std::byte>> unpack_solution(std::span<const std::uint8_t> bytes, std::uint64_t byte_length,
                                               const std::string& hash, std::uint64_t most);

} // namespace atrium::gltf
