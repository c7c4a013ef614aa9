// Scene files: .gltf, .glb and .atrium (one valid binary glTF with ATRIUM_ extensions). tinygltf stays in engine/io.
#pragma once

#include "engine/base/result.h"
#include "engine/scene/problems.h"
#include "engine/scene/scene.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace atrium {

/// What was read, with everything worth telling its author.
struct LoadedScene {
    Scene scene;
    std::vector<Problem> problems;   ///< of the file: repaired input, ignored extensions (each listed once)
    std::vector<std::byte> solution; ///< bytes of encode_solution(); empty when the file holds none
};

/// Reads a .gltf, .glb or .atrium file. No path outside the file's folder is opened. Memory is capped at the larger of
/// 20 x the file's size and 1 GiB. Malformed files are refused with file, place and reason, or repaired with a problem.
struct ReadOptions {
    /// Takes what a damaged file still holds: text that breaks off, missing binary parts, references to what is lost. Every
    /// loss is a problem. For files that read_scene() refuses otherwise; a sound file reads the same but for its animations.
    bool salvage = false;
};
Result<LoadedScene> read_scene(const std::filesystem::path& path, const ReadOptions& options = {});

struct WriteOptions {
    std::vector<std::byte> solution; ///< stored in .atrium files only
};
/// Writes by extension: .gltf (with one .bin and image files beside it), .glb, or .atrium. Atomic: temporary file in the
/// same folder, fsync, rename. The same scene gives the same bytes. Only resources that are in use are written.
Result<void> write_scene(const std::filesystem::path& path, const Scene& scene, const WriteOptions& options = {});

} // namespace atrium
