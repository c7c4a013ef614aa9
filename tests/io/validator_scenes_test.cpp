// Writes the files that the Khronos validator is run over afterwards (validator.cmake).
#include "tests/io/io_test_support.h"

namespace atrium::test {
namespace {

TEST(ValidatorScenes, are_written) {
    const std::filesystem::path folder = std::filesystem::path(ATRIUM_BINARY_DIR) / "validator_scenes";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    const auto write_all = [&](const Scene& scene, const std::string& name) {
        WriteOptions options;
        options.solution.assign(3000, std::byte{5});
        for (const char* extension : {".gltf", ".glb", ".atrium"}) {
            const auto written = write_scene(folder / (name + extension), scene, options);
            EXPECT_TRUE(written) << written.error().message();
        }
    };
    write_all(all_kinds_scene(), "all kinds");
    write_all(Scene{}, "empty");
    Scene degenerate;
    show_alone(degenerate, Polygon{});
    write_all(degenerate, "degenerate");
    if (!std::filesystem::is_directory(shared_scenes())) {
        return; // the scenes above are still worth validating
    }
    for (const char* part : {"conformance", "objects", "interiors"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_scenes() / part)) {
            const std::string extension = entry.path().extension().string();
            if (extension == ".gltf" || extension == ".glb") {
                const auto loaded = read_scene(entry.path());
                ASSERT_TRUE(loaded) << loaded.error().message();
                write_all(loaded->scene, entry.path().stem().string());
            }
        }
    }
}

} // namespace
} // namespace atrium::test
