// write_scene(): the document is built in memory (gltf_write_materials, _meshes, _nodes), then written atomically.
#include "engine/base/float_traps.h"
#include "engine/io/file_access.h"
#include "engine/io/gltf_container.h"
#include "engine/io/gltf_extensions.h"
#include "engine/io/gltf_write_context.h"
#include "engine/io/project_file.h"
#include "engine/io/scene_file.h"

#include <set>

namespace atrium {
namespace gltf {

int WriteContext::add_view(std::span<const std::uint8_t> bytes, int target, int stride) {
    binary.resize((binary.size() + 3) & ~std::size_t(3));
    Json view = {{"buffer", 0}, {"byteLength", bytes.size()}};
    if (!binary.empty()) {
        view["byteOffset"] = binary.size();
    }
    if (target != 0) {
        view["target"] = target;
    }
    if (stride != 0) {
        view["byteStride"] = stride;
    }
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    return add("bufferViews", std::move(view));
}

std::vector<MaterialId> part_materials(const Scene& scene, const Node& node) {
    std::vector<MaterialId> out;
    if (const Shape* shape = scene.shapes.find(node.shape)) {
        out = node.materials;
        out.resize(part_count(*shape));
        for (MaterialId& id : out) {
            id = scene.materials.contains(id) ? id : MaterialId{};
        }
    }
    return out;
}

void put_text(Json& object, const char* key, const std::string& json_text) {
    if (json_text.empty()) {
        return;
    }
    const FloatTrapsOff library; // as in parse_json()
    Json value = Json::parse(json_text, nullptr, false);
    // Text that is no JSON was typed by someone: it is kept as a JSON string.
    object[key] = value.is_discarded() ? Json(json_text) : std::move(value);
}

namespace {

/// Names of all extensions that occur, for extensionsUsed.
void collect_extensions(const Json& value, std::set<std::string>& names) {
    if (!value.is_structured()) {
        return;
    }
    for (const auto& [key, member] : value.items()) {
        if (value.is_object() && key == "extras") {
            continue;
        }
        if (value.is_object() && key == "extensions" && member.is_object()) {
            for (const auto& [name, extension] : member.items()) {
                names.insert(name);
            }
        }
        collect_extensions(member, names);
    }
}

void write_root(WriteContext& context) {
    const Scene& scene = context.scene;
    put_text(context.root, "asset", scene.asset_extras);
    Json& asset = context.root["asset"];
    if (!asset.is_object()) {
        asset = Json::object();
    }
    asset["version"] = "2.0";
    if (!asset.contains("generator")) {
        asset["generator"] = "Atrium " ATRIUM_VERSION;
    }
    put_text(context.root, "extras", scene.extras);
    if (scene.environment.sky_radiance != Rgb(0.0F)) {
        context.root["extensions"][kEnvironment]["skyRadiance"] = short_numbers(scene.environment.sky_radiance);
    }
    static constexpr const char* kQualities[] = {"draft", "normal", "fine"};
    const SolverSettings usual;
    if (scene.settings.quality != usual.quality) {
        context.root["extensions"][kSettings]["quality"] = kQualities[int(scene.settings.quality)];
    }
    if (scene.settings.seed != usual.seed) {
        context.root["extensions"][kSettings]["seed"] = scene.settings.seed;
    }
    for (const ThresholdInfo& info : kThresholds) {
        if (const float value = scene.settings.thresholds.*info.value; value > 0.0F) {
            context.root["extensions"][kSettings]["thresholds"][info.key] = short_number(value);
        }
    }
}

void write_solution(WriteContext& context, const std::vector<std::byte>& solution) {
    if (solution.empty()) {
        return;
    }
    const PackedSolution packed = pack_solution(solution);
    context.root["extensions"][kSolution] = {{"bufferView", context.add_view(packed.bytes)},
                                             {"encoding", "zstd"},
                                             {"byteLength", packed.byte_length},
                                             {"hash", packed.hash}};
}

void build(WriteContext& context, const WriteOptions& options, bool is_project) {
    write_textures(context);
    write_materials(context);
    write_lights(context);
    write_cameras(context);
    write_meshes(context);
    write_nodes(context);
    write_root(context);
    if (is_project) {
        write_solution(context, options.solution);
    }
    // Looking a section up must not leave an empty one behind: glTF forbids empty arrays.
    for (auto it = context.root.begin(); it != context.root.end();) {
        it = it->is_null() || (it->is_array() && it->empty()) ? context.root.erase(it) : std::next(it);
    }
    std::set<std::string> names;
    collect_extensions(context.root, names);
    if (!names.empty()) {
        context.root["extensionsUsed"] = names;
    }
    if (!context.binary.empty()) {
        context.binary.resize((context.binary.size() + 3) & ~std::size_t(3));
        context.root["buffers"] = {{{"byteLength", context.binary.size()}}};
    }
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Everything is written and synced under temporary names before the first file is replaced; the .gltf comes last, so that
/// it never names a file that is not there.
Result<void> write_text_scene(const std::filesystem::path& path, WriteContext& context) {
    std::vector<PendingFile> pending;
    const auto prepare = [&pending](const std::filesystem::path& target,
                                    std::span<const std::uint8_t> bytes) -> Result<void> {
        auto file = PendingFile::prepare(target, bytes);
        if (!file) {
            return tl::unexpected(file.error());
        }
        pending.push_back(std::move(*file));
        return {};
    };
    for (const ImageFile& image : context.image_files) {
        if (image.on_disk) {
            continue;
        }
        const std::filesystem::path target = context.folder / image.path;
        std::error_code error;
        std::filesystem::create_directories(target.parent_path(), error); // a failure shows when the file is opened
        if (auto done = prepare(target, *image.bytes); !done) {
            return done;
        }
    }
    if (!context.binary.empty()) {
        const std::string name = context.stem + ".bin";
        context.root["buffers"][0]["uri"] = percent_encode(name);
        if (auto done = prepare(context.folder / name, context.binary); !done) {
            return done;
        }
    }
    const std::string text = context.root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    if (auto done = prepare(path, bytes_of(text)); !done) {
        return done;
    }
    for (PendingFile& file : pending) {
        if (auto done = file.commit(); !done) {
            return done;
        }
    }
    return {};
}

} // namespace
} // namespace gltf

Result<void> write_scene(const std::filesystem::path& path, const Scene& scene, const WriteOptions& options) {
    using namespace gltf;
    const std::string extension = path.extension().string();
    const bool is_text = extension == ".gltf";
    const bool is_project = extension == ".atrium";
    if (!is_text && !is_project && extension != ".glb") {
        return fail(path.string(), "", "is not a kind of scene file that can be written", "Name it .atrium, .glb or .gltf.");
    }
    try {
        WriteContext context{
            scene, !is_text, path.parent_path(), path.stem().string(), Json::object(), {}, {}, {}, {}, {}, {}, {}, {}, {}};
        context.nodes = scene.in_tree_order();
        build(context, options, is_project);
        if (is_text) {
            return write_text_scene(path, context);
        }
        const std::string json = context.root.dump(-1, ' ', false, Json::error_handler_t::replace);
        return write_file_atomically(path, make_glb(json, context.binary));
    } catch (Refusal& refusal) {
        refusal.error.file = path.string();
        return tl::unexpected(std::move(refusal.error));
    } catch (const std::exception& e) {
        return fail(path.string(), "", std::string("could not be written: ") + e.what(),
                    "The file that was there before is unchanged.");
    }
}

} // namespace atrium
