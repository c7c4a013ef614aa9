// What happens to damaged and hostile files: refused, with these words in the message, or opened with these words in a
// problem.
#include "tests/io/io_test_support.h"

#include <chrono>
#include <set>

namespace atrium::test {
namespace {

struct Case {
    const char* file;
    enum Outcome { Refused, Repaired, Clean } outcome;
    const char* words;
};

// The rule: what would show a wrong picture or read beyond its data is refused; what loses a detail opens with a warning;
// what no light or picture depends on (declared bounds, data that nothing uses) opens clean.
constexpr Case kCases[] = {
    {"assimp/IndexOutOfRange/IndexOutOfRange.gltf", Case::Refused, "accessors/0: index 0 refers to vertex 255"},
    {"assimp/MissingBin/BoxTextured.gltf", Case::Refused, "BoxTextured0.bin"},
    {"tinygltf/BoundsChecking/integer-out-of-bounds.gltf", Case::Refused, "bufferViews/0/byteLength"},
    {"tinygltf/BoundsChecking/invalid-buffer-index.gltf", Case::Refused, "bufferViews/1/buffer"},
    {"tinygltf/BoundsChecking/invalid-buffer-view-index.gltf", Case::Refused, "bufferViews/0/buffer"},
    {"tinygltf/BoundsChecking/invalid-primitive-indices.gltf", Case::Refused, "bufferViews/0/buffer"},
    {"validator/KHR_lights_punctual/data/light/spot_invalid_angles.gltf", Case::Repaired, "inner cone"},
    {"validator/KHR_lights_punctual/data/light/unknown_type.gltf", Case::Repaired, "spherical"},
    {"validator/KHR_materials_emissive_strength/data/material/out_of_range.gltf", Case::Repaired, "emissive strength"},
    {"validator/KHR_materials_ior/data/material/out_of_range.gltf", Case::Repaired, "index of refraction"},
    {"validator/accessor/invalid_sparse_count_and_stride.gltf", Case::Refused, "buffers/0: has no data"},
    {"validator/accessor/small_stride.gltf", Case::Refused, "buffers/0: has no data"},
    {"validator/accessor/unresolved_bufferviews.gltf", Case::Refused, "accessors/0/bufferView"},
    {"validator/accessor_data/invalid_elements_float.gltf", Case::Clean, ""},
    {"validator/accessor_data/out_of_range_elements_float.gltf", Case::Clean, ""},
    {"validator/buffer/invalid_uri_data_bytelength.gltf", Case::Refused, "buffers/1: \"byteLength\" is missing"},
    {"validator/buffer/not_found.gltf", Case::Refused, "not_found.bin"},
    {"validator/buffer/wrong_bytelength.glb", Case::Refused, "holds 16 bytes where the file announces 17"},
    {"validator/buffer/zero_bytelength.gltf", Case::Refused, "buffers/0/byteLength: is 0"},
    {"validator/buffer_view/invalid_length.gltf", Case::Refused, "bufferViews/0: reaches beyond the end of buffers/0"},
    {"validator/buffer_view/unresolved_buffer.gltf", Case::Refused, "bufferViews/0/buffer"},
    {"validator/camera/perspective_yfov.gltf", Case::Repaired, "yfov is 4"},
    {"validator/glb/chunk_too_big.glb", Case::Refused, "announces 13 bytes"},
    {"validator/glb/empty_file.glb", Case::Refused, "empty"},
    {"validator/glb/invalid_magic.glb", Case::Refused, "neither glTF text nor"},
    {"validator/glb/length_mismatch.glb", Case::Refused, "announces 49 bytes but the file has 48"},
    {"validator/glb/only_header.glb", Case::Refused, "ends after 12 bytes"},
    {"validator/glb/truncated_chunk_data.glb", Case::Refused, "announces 48 bytes but the file has 47"},
    {"validator/glb/two_bin_chunks.glb", Case::Refused, "the first chunk is not JSON"},
    {"validator/image/invalid_image_data.gltf", Case::Repaired, "images/0"},
    {"validator/image/not_found.gltf", Case::Repaired, "not_found.png"},
    {"validator/json/bom.gltf", Case::Repaired, "byte order mark"},
    {"validator/json/empty_file.gltf", Case::Refused, "empty"},
    {"validator/json/invalid_syntax.gltf", Case::Refused, "line 1, column 2"},
    {"validator/mesh/accessor_unequal_count.gltf", Case::Refused, "has 3 elements where the other attributes have 4"},
    {"validator/mesh/position_accessor_no_bounds.gltf", Case::Clean, ""},
    {"validator/mesh/primitive_no_position.gltf", Case::Repaired, "has no positions"},
    {"validator/mesh/unresolved_indices.gltf", Case::Refused, "meshes/0/primitives/0/indices"},
    {"validator/mesh_data/index_buffer_oob.gltf", Case::Refused, "index 5 refers to vertex 5"},
    {"validator/node/infinite_transform.gltf", Case::Refused, "1e309"},
    {"validator/node/matrix_indecomposable.gltf", Case::Repaired, "last row"},
    {"validator/node/node_loop.gltf", Case::Refused, "loop"},
    {"validator/node/unresolved_child_node.gltf", Case::Refused, "nodes/0/children"},
};

TEST(Broken, every_file_has_the_outcome_of_the_table) {
    ATRIUM_NEED_SHARED_SCENES();
    for (const Case& c : kCases) {
        SCOPED_TRACE(c.file);
        const std::filesystem::path path = shared_scenes() / "broken" / c.file;
        const auto start = std::chrono::steady_clock::now();
        const auto loaded = read_scene(path);
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
        ASSERT_EQ(loaded.has_value(), c.outcome != Case::Refused)
            << (loaded ? all_problems(*loaded) : loaded.error().message());
        if (!loaded) {
            EXPECT_NE(loaded.error().message().find(c.words), std::string::npos) << loaded.error().message();
            EXPECT_EQ(loaded.error().file, path.string());
        } else if (c.outcome == Case::Repaired) {
            EXPECT_TRUE(has_warning(*loaded) && has_problem(*loaded, c.words)) << all_problems(*loaded);
        } else {
            EXPECT_FALSE(has_warning(*loaded)) << all_problems(*loaded);
        }
    }
}

TEST(Broken, the_table_names_every_file) {
    ATRIUM_NEED_SHARED_SCENES();
    const std::filesystem::path root = shared_scenes() / "broken";
    std::set<std::string> known;
    for (const Case& c : kCases) {
        known.insert(c.file);
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".gltf" || extension == ".glb") {
            EXPECT_TRUE(known.contains(entry.path().lexically_relative(root).generic_string())) << entry.path();
        }
    }
}

/// A triangle whose parts a test replaces. POSITION is accessor 0 (three vertices), accessor 1 its indices.
std::string triangle(const std::string& from = "", const std::string& to = "") {
    std::string json = R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3}],
"buffers":[{"byteLength":39,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEC"}]})";
    if (!from.empty()) {
        const std::size_t at = json.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        json.replace(at, from.size(), to);
    }
    return json;
}

TEST(Broken, the_triangle_itself_is_good) {
    const auto loaded = read_text(triangle());
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_TRUE(loaded->problems.empty()) << all_problems(*loaded);
    EXPECT_EQ(drawn_triangles(loaded->scene), 1U);
}

TEST(Broken, hostile_numbers_are_refused_with_their_place) {
    const struct {
        const char *from, *to, *words;
    } cases[] = {
        {R"("count":3,"type":"VEC3")", R"("count":4294967295,"type":"VEC3")", "accessors/0: reaches beyond"},
        {R"("count":3,"type":"VEC3")", R"("count":-3,"type":"VEC3")", "accessors/0/count"},
        {R"("count":3,"type":"VEC3")", R"("count":0,"type":"VEC3")", "accessors/0/count"},
        {R"("count":3,"type":"VEC3")", R"("count":"3","type":"VEC3")", "accessors/0/count"},
        {R"("count":3,"type":"VEC3")", R"("byteOffset":18446744073709551604,"count":3,"type":"VEC3")", "byteOffset"},
        {R"("byteOffset":36)", R"("byteOffset":1099511627776)", "bufferViews/1: reaches beyond"},
        {R"("type":"VEC3")", R"("type":"VEC9")", "accessors/0"},
        {R"("indices":1)", R"("indices":0)", "does not hold unsigned whole numbers"},
        {R"("mesh":0)", R"("mesh":1)", "nodes/0/mesh"},
        {R"("mesh":0)", R"("mesh":0,"scale":[1,2])", "nodes/0/scale"},
        {R"("mesh":0)", R"("mesh":0,"children":[0])", "loop"},
        {R"("nodes":[{"mesh":0}])", R"("nodes":[{"mesh":0,"children":[2]},{"children":[2]},{}])", "two parents"},
        {R"("version":"2.0")", R"("version":"1.0")", "version \"1.0\""},
        {R"("byteLength":39)", R"("byteLength":40)", "holds 39 bytes"},
        {R"("scenes":[{"nodes":[0]}])", R"("scenes":[{"nodes":[9]}])", "scenes/0/nodes"},
        {"AAEC", "AAED", "refers to vertex 3"},
        {"AAAAAAAAAAAAAAAAAACAPw", "AAAAAAAAAAAAAAAAAACAfw", "accessors/0: element 1 is not a finite number"},
        {R"("nodes":[{"mesh":0}])", R"("nodes":7)", "nodes"},
        {R"("nodes":[{"mesh":0}])", R"("nodes":[null])", "nodes/0"},
        {R"("attributes":{"POSITION":0},)", "", "attributes"},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.to);
        const auto loaded = read_text(triangle(c.from, c.to));
        ASSERT_FALSE(loaded);
        EXPECT_NE(loaded.error().message().find(c.words), std::string::npos) << loaded.error().message();
    }
}

TEST(Broken, unknown_required_extensions_are_refused_by_name_before_anything_else) {
    for (const char* name :
         {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu", "ACME_something_new"}) {
        const auto loaded = read_text(std::string(R"({"extensionsRequired":[")") + name + R"("],"asset":{},"nodes":3})");
        ASSERT_FALSE(loaded);
        EXPECT_NE(loaded.error().message().find(name), std::string::npos) << loaded.error().message();
    }
}

TEST(Broken, unknown_optional_extensions_are_listed_once) {
    const auto loaded = read_text(triangle(R"("scenes")", R"("extensionsUsed":["ACME_a","ACME_b","ACME_a"],"scenes")"));
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->problems.size(), 2U);
    EXPECT_TRUE(has_problem(*loaded, "ACME_a") && has_problem(*loaded, "ACME_b"));
}

TEST(Broken, memory_is_capped) {
    // 4 thousand million zeros from nothing: an accessor without a buffer view is legal glTF.
    const auto zeros = read_text(
        triangle(R"("bufferView":0,"componentType":5126,"count":3)", R"("componentType":5126,"count":4000000000)"));
    ASSERT_FALSE(zeros);
    EXPECT_NE(zeros.error().message().find("memory"), std::string::npos) << zeros.error().message();
    // Instancing: one triangle, 30 million times.
    std::string many =
        triangle(R"("nodes":[{"mesh":0}])",
                 R"("nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":2}}}}])");
    const std::string last = R"("count":3,"type":"SCALAR"})";
    many.insert(many.find(last) + last.size(), R"(,{"componentType":5126,"count":30000000,"type":"VEC3"})");
    const auto too_many = read_text(many);
    ASSERT_FALSE(too_many);
    const std::string message = too_many.error().message();
    EXPECT_TRUE(message.find("20 million triangles") != std::string::npos || message.find("memory") != std::string::npos)
        << message;
}

TEST(Broken, deep_nesting_is_refused) {
    const auto loaded =
        read_text(R"({"asset":{"version":"2.0"},"extras":)" + std::string(200000, '[') + std::string(200000, ']') + "}");
    ASSERT_FALSE(loaded);
    EXPECT_NE(loaded.error().message().find("nested"), std::string::npos);
}

TEST(Broken, long_chains_of_nodes_are_read) {
    std::string nodes;
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i) {
        nodes +=
            (i != 0 ? "," : "") + (i + 1 < kCount ? "{\"children\":[" + std::to_string(i + 1) + "]}" : std::string("{}"));
    }
    const auto loaded = read_text(R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + "]}");
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(loaded->scene.nodes.size(), std::size_t(kCount));
}

TEST(Broken, reflectance_above_one_is_clamped_with_a_warning) {
    const auto loaded = read_text(
        R"({"asset":{"version":"2.0"},"materials":[{"name":"Snow","pbrMetallicRoughness":{"baseColorFactor":[1.5,0.5,-1,1]}}]})");
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->scene.materials.find(loaded->scene.materials.keys()[0])->base_color, Rgb(1.0F, 0.5F, 0.0F));
    EXPECT_TRUE(has_problem(*loaded, "materials/0 (Snow)"));
}

} // namespace
} // namespace atrium::test
