#include "tests/io/io_test_support.h"

namespace atrium::test {
namespace {

/// What a .gltf adds to a texture: the name of the image file that was written beside it.
Scene without_uris(Scene scene) {
    for (const TextureId id : scene.textures.keys()) {
        scene.textures.find(id)->uri.clear();
    }
    return scene;
}

class RoundTrip : public testing::TestWithParam<const char*> {};

TEST_P(RoundTrip, every_kind_comes_back_equal_and_saves_to_the_same_bytes) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / (std::string("all kinds") + GetParam());
    const Scene scene = all_kinds_scene();
    ASSERT_TRUE(write_scene(file, scene));
    const auto loaded = read_scene(file);
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_FALSE(has_warning(*loaded)) << all_problems(*loaded);

    const Scene read = without_uris(loaded->scene);
    EXPECT_EQ(read.nodes, scene.nodes);
    EXPECT_EQ(read.shapes, scene.shapes);
    EXPECT_EQ(read.materials, scene.materials);
    EXPECT_EQ(read.textures, scene.textures);
    EXPECT_EQ(read.lights, scene.lights);
    EXPECT_EQ(read.cameras, scene.cameras);
    EXPECT_EQ(read, scene);

    const std::string first = content(file);
    const std::string first_binary = content(folder / "all kinds.bin");
    ASSERT_TRUE(write_scene(file, loaded->scene));
    EXPECT_EQ(content(file), first);
    EXPECT_EQ(content(folder / "all kinds.bin"), first_binary);
}

TEST_P(RoundTrip, only_what_is_in_use_is_written) {
    Scene scene = all_kinds_scene();
    Material unused;
    unused.name = "Nobody shows this";
    scene.materials.insert(unused);
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / (std::string("scene") + GetParam());
    ASSERT_TRUE(write_scene(file, scene));
    EXPECT_EQ(content(file).find(unused.name), std::string::npos);
    EXPECT_NE(content(file).find("Mirror"), std::string::npos);
}

TEST_P(RoundTrip, an_empty_scene_is_a_valid_file) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / (std::string("empty") + GetParam());
    ASSERT_TRUE(write_scene(file, Scene{}));
    const auto loaded = read_scene(file);
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(loaded->scene, Scene{});
}

TEST_P(RoundTrip, shared_files_keep_their_light_and_geometry) {
    ATRIUM_NEED_SHARED_SCENES();
    for (const char* name :
         {"interiors/office_b90.glb", "interiors/cornell_glass_spheres.glb", "interiors/small_house.glb",
          "conformance/SimpleInstancing/SimpleInstancing.glb", "conformance/NegativeScaleTest/NegativeScaleTest.glb",
          "objects/LightsPunctualLamp/LightsPunctualLamp.gltf"}) {
        SCOPED_TRACE(name);
        const TemporaryFolder folder;
        const auto original = read_scene(shared_scenes() / name);
        ASSERT_TRUE(original) << original.error().message();
        const std::filesystem::path file = folder / (std::string("scene") + GetParam());
        ASSERT_TRUE(write_scene(file, original->scene));
        const auto again = read_scene(file);
        ASSERT_TRUE(again) << again.error().message();
        EXPECT_TRUE(without_uris(again->scene) == without_uris(original->scene));
        const std::string first = content(file);
        ASSERT_TRUE(write_scene(file, again->scene));
        EXPECT_TRUE(content(file) == first);
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip, testing::Values(".gltf", ".glb", ".atrium"),
                         [](const auto& info) { return std::string(info.param).substr(1); });

TEST(RoundTripTest, degenerate_primitives_are_kept) {
    Scene scene;
    show_alone(scene, Sphere{0.0F});
    const TemporaryFolder folder;
    ASSERT_TRUE(write_scene(folder / "scene.glb", scene));
    const auto loaded = read_scene(folder / "scene.glb");
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(loaded->scene, scene);
}

TEST(RoundTripTest, emission_above_one_goes_into_the_strength) {
    Scene scene;
    Material lamp;
    lamp.emissive_color = {4.0F, 2.0F, 1.0F};
    lamp.emissive_strength = 10.0F;
    const MaterialId material = scene.materials.insert(lamp);
    show_alone(scene, Box{}, material);
    const TemporaryFolder folder;
    ASSERT_TRUE(write_scene(folder / "scene.glb", scene));
    const auto loaded = read_scene(folder / "scene.glb");
    ASSERT_TRUE(loaded);
    const Material& read = *loaded->scene.materials.find(material);
    EXPECT_EQ(read.emissive_color, Rgb(1.0F, 0.5F, 0.25F));
    EXPECT_EQ(read.emitted_radiance(), lamp.emitted_radiance());
}

TEST(RoundTripTest, encoded_images_are_written_byte_for_byte) {
    const TemporaryFolder folder;
    const Scene scene = all_kinds_scene();
    ASSERT_TRUE(write_scene(folder / "scene.gltf", scene));
    int found = 0;
    for (const TextureId id : scene.textures.keys()) {
        const Texture& texture = *scene.textures.find(id);
        const std::string file = content(folder / ("scene_" + texture.name + ".png"));
        EXPECT_EQ(file, std::string(texture.encoded->begin(), texture.encoded->end())) << texture.name;
        ++found;
    }
    EXPECT_EQ(found, 3);
}

TEST(RoundTripTest, a_foreign_image_file_is_never_overwritten) {
    const TemporaryFolder folder;
    put_content(folder / "scene_Tiles.png", "somebody else's picture");
    ASSERT_TRUE(write_scene(folder / "scene.gltf", all_kinds_scene()));
    EXPECT_EQ(content(folder / "scene_Tiles.png"), "somebody else's picture");
    const auto loaded = read_scene(folder / "scene.gltf");
    ASSERT_TRUE(loaded);
    EXPECT_EQ(without_uris(loaded->scene), all_kinds_scene());
}

TEST(RoundTripTest, the_solution_is_kept_in_projects_only) {
    const TemporaryFolder folder;
    WriteOptions options;
    for (int i = 0; i < 100000; ++i) {
        options.solution.push_back(std::byte(i * i / 7));
    }
    const Scene scene = all_kinds_scene();
    ASSERT_TRUE(write_scene(folder / "scene.atrium", scene, options));
    ASSERT_TRUE(write_scene(folder / "scene.glb", scene, options));
    EXPECT_EQ(read_scene(folder / "scene.atrium")->solution, options.solution);
    EXPECT_TRUE(read_scene(folder / "scene.glb")->solution.empty());
}

TEST(RoundTripTest, a_damaged_solution_still_opens_the_scene) {
    const TemporaryFolder folder;
    WriteOptions options;
    options.solution.assign(5000, std::byte{42});
    for (int i = 0; i < 5000; i += 3) {
        options.solution[std::size_t(i)] = std::byte(i * 37);
    }
    const Scene scene = all_kinds_scene();
    ASSERT_TRUE(write_scene(folder / "scene.atrium", scene, options));
    const std::string good = content(folder / "scene.atrium");
    // The solution is the last thing in the file.
    for (const std::size_t from_end : {8U, 100U, 600U}) {
        std::string bad = good;
        bad[bad.size() - from_end] ^= 0x55;
        put_content(folder / "bad.atrium", bad);
        const auto loaded = read_scene(folder / "bad.atrium");
        ASSERT_TRUE(loaded) << loaded.error().message();
        EXPECT_EQ(loaded->scene, scene);
        EXPECT_TRUE(loaded->solution.empty());
        EXPECT_TRUE(has_problem(*loaded, "solution")) << from_end;
    }
    // Announced length and hash are checked as well.
    std::string bad = good;
    bad.replace(bad.find("\"byteLength\":5000"), 17, "\"byteLength\":5001");
    put_content(folder / "bad.atrium", bad);
    const auto loaded = read_scene(folder / "bad.atrium");
    ASSERT_TRUE(loaded);
    EXPECT_TRUE(has_problem(*loaded, "another length"));
}

} // namespace
} // namespace atrium::test
