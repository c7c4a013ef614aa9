// What a scene file may reach, and what saving may destroy: nothing outside the folder, nothing that was good.
#include "engine/io/file_access.h"
#include "tests/io/io_test_support.h"

#include <array>
#include <csignal>
#include <limits>
#include <sys/resource.h>
#include <sys/stat.h>

namespace atrium::test {
namespace {

std::string with_buffer(const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":")" + uri + "\"}]}";
}
std::string with_image(const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"images":[{"uri":")" + uri + R"("}],"textures":[{"source":0}]})";
}

class Reach : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directory(outer / "scene");
        put_content(outer / "secret.bin", "secret");
        put_content(outer / "scene/inside.bin", "inside");
    }
    Result<LoadedScene> read(const std::string& json) const {
        put_content(outer / "scene/scene.gltf", json);
        return read_scene(outer / "scene/scene.gltf");
    }
    TemporaryFolder outer;
};

TEST_F(Reach, files_inside_the_folder_are_opened) {
    std::filesystem::create_directory(outer / "scene/sub");
    put_content(outer / "scene/sub/a file.bin", "data");
    for (const char* uri : {"inside.bin", "./inside.bin", "sub/../inside.bin", "sub/a%20file.bin", "sub\\\\a file.bin"}) {
        const auto loaded = read(with_buffer(uri));
        EXPECT_TRUE(loaded) << uri << ": " << loaded.error().message();
    }
}

TEST_F(Reach, nothing_outside_the_folder_is_opened) {
    std::filesystem::create_symlink(outer / "secret.bin", outer / "scene/link.bin");
    std::filesystem::create_directory_symlink(outer.path(), outer / "scene/up");
    const std::string absolute = (outer / "secret.bin").string();
    for (const std::string& uri : std::vector<std::string>{
             "../secret.bin", "%2e%2e/secret.bin", "%2E%2E%2Fsecret.bin", "..\\\\secret.bin", "sub/../../secret.bin",
             "link.bin", "up/secret.bin", absolute, "file://" + absolute, "/etc/passwd", "../../../../../../etc/passwd",
             "http://example.org/a.bin", "C:\\\\secret.bin"}) {
        const auto loaded = read(with_buffer(uri));
        ASSERT_FALSE(loaded) << uri;
        const std::string message = loaded.error().message();
        EXPECT_TRUE(message.find("outside the folder") != std::string::npos ||
                    message.find("not a file beside") != std::string::npos)
            << message;
        // An image is no reason to refuse the file, but it is not opened either.
        const auto image = read(with_image(uri));
        ASSERT_TRUE(image) << image.error().message();
        EXPECT_TRUE(has_warning(*image));
        image->scene.textures.for_each([](TextureId, const Texture& t) { EXPECT_FALSE(t.encoded); });
    }
}

TEST_F(Reach, pipes_and_folders_are_refused_without_waiting) {
    ASSERT_EQ(mkfifo((outer / "scene/pipe.bin").c_str(), 0600), 0);
    std::filesystem::create_directory(outer / "scene/folder.bin");
    for (const char* uri : {"pipe.bin", "folder.bin"}) {
        const auto loaded = read(with_buffer(uri));
        ASSERT_FALSE(loaded);
        EXPECT_NE(loaded.error().message().find("not a regular file"), std::string::npos) << loaded.error().message();
    }
}

TEST_F(Reach, a_hostile_texture_uri_cannot_choose_where_saving_writes) {
    Scene scene = all_kinds_scene();
    const TextureId id = scene.textures.keys()[0];
    for (const char* uri : {"../stolen.png", "/tmp/stolen.png", "scene.gltf", "a/../../stolen.png", "c:stolen.png"}) {
        scene.textures.find(id)->uri = uri;
        ASSERT_TRUE(write_scene(outer / "scene/scene.gltf", scene)) << uri;
        EXPECT_FALSE(std::filesystem::exists(outer / "stolen.png"));
        const auto loaded = read_scene(outer / "scene/scene.gltf");
        ASSERT_TRUE(loaded) << loaded.error().message();
        EXPECT_FALSE(has_warning(*loaded)) << all_problems(*loaded);
    }
}

TEST(Saving, a_full_disk_leaves_the_old_file) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "scene.atrium";
    ASSERT_TRUE(write_scene(file, Scene{}));
    const std::string before = content(file);
    // A limit on file sizes fails the write in the middle, as a full disk does.
    rlimit old{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = old;
    small.rlim_cur = 1000;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto written = write_scene(file, all_kinds_scene());
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
    std::signal(SIGXFSZ, old_handler);
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().message().find("unchanged"), std::string::npos) << written.error().message();
    EXPECT_EQ(content(file), before);
    // No litter either.
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Saving, a_target_that_cannot_be_replaced_is_reported) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "scene.glb");
    EXPECT_FALSE(write_scene(folder / "scene.glb", Scene{}));
    EXPECT_FALSE(write_scene(folder / "missing" / "scene.glb", Scene{}));
    EXPECT_FALSE(write_scene(folder / "scene.obj", Scene{}));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Saving, links_and_modes_are_kept) {
    const TemporaryFolder folder;
    put_content(folder / "real.glb", "old");
    std::filesystem::permissions(folder / "real.glb", std::filesystem::perms(0640));
    std::filesystem::create_symlink(folder / "real.glb", folder / "link.glb");
    ASSERT_TRUE(write_scene(folder / "link.glb", Scene{}));
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.glb"));
    EXPECT_NE(content(folder / "real.glb"), "old");
    EXPECT_EQ(std::filesystem::status(folder / "real.glb").permissions(), std::filesystem::perms(0640));
}

TEST(Saving, a_placement_that_is_not_finite_is_refused_by_name) {
    std::array<Transform, 4> placements{};
    placements[0].translation.x = std::numeric_limits<double>::quiet_NaN();
    placements[1].translation.y = 1e200; // its square is not
    placements[2].scale.z = -std::numeric_limits<double>::infinity();
    placements[3].rotation.x = 1e200;
    for (const Transform& placement : placements) {
        Scene scene;
        Node node = node_named("Chair");
        node.transform = placement;
        scene.roots = {scene.nodes.insert(node)};
        const TemporaryFolder folder;
        const auto written = write_scene(folder / "scene.glb", scene);
        ASSERT_FALSE(written);
        EXPECT_NE(written.error().message().find("Chair"), std::string::npos);
    }
}

TEST(Base64, rejects_what_is_not) {
    std::vector<std::uint8_t> out;
    EXPECT_TRUE(decode_base64("AAECAw==", out));
    EXPECT_EQ(out, (std::vector<std::uint8_t>{0, 1, 2, 3}));
    EXPECT_FALSE(decode_base64("AA!C", out));
    EXPECT_FALSE(decode_base64("AAECA", out));
}

} // namespace
} // namespace atrium::test
