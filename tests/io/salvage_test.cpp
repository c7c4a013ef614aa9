// Damaged files: what is still there is shown, what is gone is told, and nothing crashes.
#include "engine/io/file_access.h"
#include "engine/io/relink.h"
#include "tests/io/io_test_support.h"

#include <csignal>
#include <unistd.h>

#include <algorithm>
#include <set>

namespace atrium::test {
namespace {

constexpr ReadOptions kSalvage{true};

class Salvage : public testing::Test {
protected:
    void SetUp() override {
        scene = all_kinds_scene();
        ASSERT_TRUE(write_scene(path, scene));
        whole = content(path);
        const auto byte = [this](std::size_t at) { return std::size_t(static_cast<unsigned char>(whole[at])); };
        json_end = 20 + (byte(12) | byte(13) << 8 | byte(14) << 16 | byte(15) << 24);
        ASSERT_LT(json_end, whole.size());
    }
    /// Shapes that are described by numbers, by kind, of the nodes that show one.
    static std::multiset<std::size_t> described(const Scene& of) {
        std::multiset<std::size_t> out;
        of.nodes.for_each([&](NodeId, const Node& node) {
            const Shape* shape = of.shapes.find(node.shape);
            if (shape != nullptr && !std::holds_alternative<Mesh>(shape->geometry)) {
                out.insert(shape->geometry.index());
            }
        });
        return out;
    }
    TemporaryFolder folder;
    std::filesystem::path path = folder / "room.atrium";
    Scene scene;
    std::string whole;
    std::size_t json_end = 0;
};

TEST_F(Salvage, a_file_without_its_binary_part_keeps_every_object_and_described_shape) {
    put_content(path, whole.substr(0, json_end));
    ASSERT_FALSE(read_scene(path)) << "it is damaged, and that is said first";
    const auto saved = read_scene(path, kSalvage);
    ASSERT_TRUE(saved) << saved.error().message();
    EXPECT_EQ(saved->scene.nodes.size(), scene.nodes.size());
    EXPECT_EQ(saved->scene.lights.size(), scene.lights.size());
    EXPECT_EQ(described(saved->scene), described(scene));
    EXPECT_TRUE(has_warning(*saved)) << "what is lost is told";
    // And it is a scene like others: it can be saved and read without salvage.
    ASSERT_TRUE(write_scene(folder / "again.atrium", saved->scene));
    const auto again = read_scene(folder / "again.atrium");
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(described(again->scene), described(scene));
}

TEST_F(Salvage, the_earlier_a_file_breaks_off_the_less_is_left_and_nothing_is_made_up) {
    std::size_t before = scene.nodes.size();
    int opened = 0;
    constexpr std::size_t kCuts = 120;
    for (std::size_t i = 0; i < kCuts; ++i) {
        const std::size_t length = whole.size() - 1 - i * (whole.size() - 2) / kCuts;
        put_content(path, whole.substr(0, length));
        const auto saved = read_scene(path, kSalvage);
        if (!saved) {
            EXPECT_FALSE(saved.error().what.empty());
            continue;
        }
        ++opened;
        EXPECT_LE(saved->scene.nodes.size(), before) << length << " bytes";
        before = saved->scene.nodes.size();
        EXPECT_TRUE(has_warning(*saved)) << length << " bytes";
        const auto all = described(scene);
        const auto left = described(saved->scene);
        EXPECT_TRUE(std::includes(all.begin(), all.end(), left.begin(), left.end())) << length << " bytes";
        EXPECT_TRUE(write_scene(folder / "again.atrium", saved->scene)) << length << " bytes";
    }
    EXPECT_GT(opened, int(kCuts) / 3);
}

TEST_F(Salvage, a_zeroed_piece_anywhere_costs_no_crash_and_mostly_little) {
    constexpr std::size_t kPiece = 64;
    int opened = 0;
    int tried = 0;
    for (std::size_t at = 20; at + kPiece < whole.size(); at += whole.size() / 150) {
        std::string damaged = whole;
        std::fill_n(damaged.begin() + std::ptrdiff_t(at), kPiece, '\0');
        put_content(path, damaged);
        ++tried;
        const auto saved = read_scene(path, kSalvage);
        if (saved) {
            ++opened;
            EXPECT_TRUE(write_scene(folder / "again.atrium", saved->scene)) << at;
        }
    }
    EXPECT_GT(opened, tried / 2);
}

TEST_F(Salvage, a_sound_file_reads_the_same) {
    const auto plain = read_scene(path);
    const auto saved = read_scene(path, kSalvage);
    ASSERT_TRUE(plain);
    ASSERT_TRUE(saved) << saved.error().message();
    EXPECT_EQ(saved->scene.nodes.size(), plain->scene.nodes.size());
    EXPECT_EQ(described(saved->scene), described(plain->scene));
    EXPECT_EQ(saved->scene.textures.size(), plain->scene.textures.size());
}

TEST_F(Salvage, what_is_no_scene_is_still_refused) {
    for (const std::string& text : std::vector<std::string>{"", "\x01\x02\x03", "hello", "[1,2,3]", "{"}) {
        put_content(path, text);
        const auto saved = read_scene(path, kSalvage);
        if (saved) {
            EXPECT_TRUE(saved->scene.nodes.empty()) << text;
        } else {
            EXPECT_FALSE(saved.error().what.empty());
        }
    }
}

class Relink : public testing::Test {
protected:
    void SetUp() override {
        Scene scene = all_kinds_scene();
        const TextureId id = scene.textures.keys()[0];
        scene.textures.find(id)->uri = "maps/Wood.png";
        const Texture& texture = *scene.textures.find(id);
        ASSERT_TRUE(texture.encoded);
        bytes.assign(texture.encoded->begin(), texture.encoded->end());
        std::filesystem::create_directories(folder / "scene");
        ASSERT_TRUE(write_scene(folder / "scene/scene.gltf", scene));
        ASSERT_TRUE(std::filesystem::remove(folder / "scene/maps/Wood.png"));
        auto read = read_scene(folder / "scene/scene.gltf");
        ASSERT_TRUE(read) << read.error().message();
        loaded = std::move(*read);
    }
    TemporaryFolder folder;
    LoadedScene loaded;
    std::string bytes;
};

TEST_F(Relink, the_file_is_found_by_its_name_and_the_folders_around_it_decide) {
    ASSERT_EQ(missing_textures(loaded.scene).size(), 1U);
    for (const char* place : {"moved/a/other", "moved/b/maps"}) {
        std::filesystem::create_directories(folder / place);
    }
    put_content(folder / "moved/a/other/WOOD.PNG", "no picture at all");
    put_content(folder / "moved/b/maps/wood.png", bytes);
    const auto found = find_missing_textures(loaded.scene, folder / "moved", {});
    ASSERT_EQ(found.size(), 1U);
    ASSERT_TRUE(found[0].second.encoded);
    EXPECT_EQ(std::string(found[0].second.encoded->begin(), found[0].second.encoded->end()), bytes);
    ASSERT_TRUE(found[0].second.image);
    EXPECT_GT(found[0].second.image->width, 0);
    EXPECT_EQ(found[0].second.uri, "maps/Wood.png");
    // A project that was saved while the file was missing still knows its name.
    ASSERT_TRUE(write_scene(folder / "kept.atrium", loaded.scene));
    const auto kept = read_scene(folder / "kept.atrium");
    ASSERT_TRUE(kept) << kept.error().message();
    EXPECT_EQ(find_missing_textures(kept->scene, folder / "moved", {}).size(), 1U);
    *loaded.scene.textures.find(found[0].first) = found[0].second;
    EXPECT_TRUE(missing_textures(loaded.scene).empty());
}

TEST_F(Relink, what_is_no_picture_stays_missing) {
    std::filesystem::create_directories(folder / "moved");
    put_content(folder / "moved/Wood.png", "no picture at all");
    EXPECT_TRUE(find_missing_textures(loaded.scene, folder / "moved", {}).empty());
    EXPECT_TRUE(find_missing_textures(loaded.scene, folder / "not there", {}).empty());
}

TEST(Temporaries, of_a_process_that_was_killed_long_ago_go_and_others_stay) {
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> bytes{1, 2, 3};
    int dead = 300000; // a number that no process has
    while (dead < 4000000 && kill(dead, 0) == 0) {
        ++dead;
    }
    const std::string old_dead = ".room.atrium." + std::to_string(dead) + "-0.tmp";
    const std::string old_living = ".room.atrium." + std::to_string(getpid()) + "-77.tmp";
    const std::string new_dead = ".room.atrium." + std::to_string(dead) + "-1.tmp";
    const std::string other = ".other.atrium." + std::to_string(dead) + "-0.tmp";
    for (const std::string& name : {old_dead, old_living, new_dead, other}) {
        put_content(folder / name, "half");
        if (name != new_dead) {
            std::filesystem::last_write_time(folder / name,
                                             std::filesystem::file_time_type::clock::now() - std::chrono::hours(2));
        }
    }
    ASSERT_TRUE(write_file_atomically(folder / "room.atrium", bytes));
    EXPECT_FALSE(std::filesystem::exists(folder / old_dead));
    EXPECT_TRUE(std::filesystem::exists(folder / old_living));
    EXPECT_TRUE(std::filesystem::exists(folder / new_dead));
    EXPECT_TRUE(std::filesystem::exists(folder / other));
}

} // namespace
} // namespace atrium::test
