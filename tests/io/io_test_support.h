// Shared by the tests of engine/io: where the shared input lies, a folder of one's own, counting, and a scene of all kinds.
#pragma once

#include "engine/geometry/primitives.h"
#include "engine/io/image_file.h"
#include "engine/io/scene_file.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>

namespace atrium::test {

inline std::filesystem::path shared_scenes() { return std::filesystem::path(ATRIUM_SHARED_DIR) / "scenes"; }

#define ATRIUM_NEED_SHARED_SCENES()                                                                                         \
    if (!std::filesystem::is_directory(::atrium::test::shared_scenes())) {                                                  \
        GTEST_SKIP() << "the folder of shared scenes is absent";                                                            \
    }

/// An empty folder, removed at the end of the scope.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "atrium-io-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

inline std::string content(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}
inline void put_content(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

/// Reads `json` as scene.gltf in a folder of its own.
inline Result<LoadedScene> read_text(const std::string& json) {
    const TemporaryFolder folder;
    put_content(folder / "scene.gltf", json);
    return read_scene(folder / "scene.gltf");
}

/// Calls f(node, mesh, world matrix) for every node that shows a mesh.
template <class F> void for_each_mesh(const Scene& scene, F&& f) {
    scene.nodes.for_each([&](NodeId id, const Node& node) {
        const Shape* shape = scene.shapes.find(node.shape);
        if (shape != nullptr && std::holds_alternative<Mesh>(shape->geometry)) {
            f(node, *std::get<Mesh>(shape->geometry).data, scene.world_matrix(id));
        }
    });
}

inline std::size_t drawn_triangles(const Scene& scene) {
    std::size_t out = 0;
    for_each_mesh(scene, [&](const Node&, const MeshData& mesh, const dmat4&) { out += mesh.indices.size() / 3; });
    return out;
}

inline bool has_problem(const LoadedScene& loaded, const std::string& words) {
    for (const Problem& p : loaded.problems) {
        if ((p.where + ": " + p.what + " " + p.hint).find(words) != std::string::npos) {
            return true;
        }
    }
    return false;
}
inline std::string all_problems(const LoadedScene& loaded) {
    std::string out;
    for (const Problem& p : loaded.problems) {
        out += p.where + ": " + p.what + "\n";
    }
    return out;
}
inline bool has_warning(const LoadedScene& loaded) {
    for (const Problem& p : loaded.problems) {
        if (p.severity != Problem::Severity::Note) {
            return true;
        }
    }
    return false;
}

/// Nodes with little in them.
inline Node node_named(const std::string& name, LightId light = {}, CameraId camera = {}) {
    Node node;
    node.name = name;
    node.light = light;
    node.camera = camera;
    return node;
}
/// Shows a new shape of one part; the node is the scene's only root.
inline void show_alone(Scene& scene, const Geometry& geometry, MaterialId material = {}) {
    Node node;
    node.shape = scene.shapes.insert(Shape{"Shape", geometry, ""});
    node.materials = {material};
    scene.roots = {scene.nodes.insert(node)};
}

/// A scene that uses every kind of shape, material, light, camera, texture and setting; built in the order in which a file
/// is read, so that it equals what is read back.
Scene all_kinds_scene();

} // namespace atrium::test
