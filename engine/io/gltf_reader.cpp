// read_scene(): the order in which a scene file is opened, checked and turned into a Scene.
//   file_access     bytes from disk; nothing outside the scene's folder is opened
//   gltf_container  GLB chunks, JSON text
//   gltf_check      structure: references, ranges, loops; unknown required extensions
//   gltf_resources  buffers and images; then tinygltf parses the checked document
//   gltf_textures, gltf_materials, gltf_photometry, gltf_lights, gltf_meshes (with gltf_accessor), gltf_nodes fill the Scene
#include "engine/io/file_access.h"
#include "engine/io/gltf_check.h"
#include "engine/io/gltf_extensions.h"
#include "engine/io/gltf_resources.h"
#include "engine/io/gltf_salvage.h"
#include "engine/io/project_file.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

namespace atrium {
namespace {

using namespace gltf;

constexpr std::uint64_t kMaxSceneFile = std::uint64_t(1) << 34;

void check_document(const Json& root, bool has_binary) {
    check_requirements(root);
    check_buffers(root, has_binary);
    check_accessors(root);
    check_textures(root);
    check_meshes(root);
    check_nodes(root);
}

/// asset without what every glTF file has; our own name as generator says nothing about the scene.
std::string asset_text(const Json& root) {
    Json asset = root["asset"];
    asset.erase("version");
    asset.erase("minVersion");
    // Extensions of the asset point into root extensions that are not kept.
    asset.erase("extensions");
    if (const Json* generator = find(asset, "generator");
        generator != nullptr && generator->is_string() && generator->get<std::string>().starts_with("Atrium ")) {
        asset.erase("generator");
    }
    return asset.empty() ? std::string() : asset.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void read_environment(ReadContext& context) {
    if (const Json* environment = find_extension(context.root, kEnvironment)) {
        context.out.scene.environment.sky_radiance =
            glm::max(number3(*environment, "skyRadiance", Rgb(0.0F), kEnvironment), Rgb(0.0F));
    }
    if (const Json* settings = find_extension(context.root, kSettings)) {
        SolverSettings& out = context.out.scene.settings;
        const std::string quality = text(*settings, "quality", kSettings);
        out.quality = quality == "draft"  ? SolverSettings::Quality::Draft
                      : quality == "fine" ? SolverSettings::Quality::Fine
                                          : SolverSettings::Quality::Normal;
        if (const Json* seed = find(*settings, "seed")) {
            out.seed = std::uint32_t(whole(*seed, 0, 0xFFFFFFFF, kSettings));
        }
        if (const Json* thresholds = find(*settings, "thresholds")) {
            for (const ThresholdInfo& info : kThresholds) {
                const auto value = float(number(*thresholds, info.key, 0.0, kSettings));
                out.thresholds.*info.value = value > 0.0F ? std::clamp(value, info.least, info.most) : 0.0F;
            }
        }
    }
}

/// The stored solution, or a problem: without it the scene is solved again, nothing is lost.
void read_solution(ReadContext& context) {
    const Json* extension = find_extension(context.root, kSolution);
    if (extension == nullptr) {
        return;
    }
    Result<std::vector<std::byte>> bytes = fail("", "", "the stored solution is described in a way that is not known");
    try {
        const int view_index = index(*extension, "bufferView", context.model.bufferViews.size(), kSolution);
        const Json* length = find(*extension, "byteLength");
        if (view_index >= 0 && length != nullptr && text(*extension, "encoding", kSolution) == "zstd") {
            const tinygltf::BufferView& view = context.model.bufferViews[std::size_t(view_index)];
            const auto& data = context.model.buffers[std::size_t(view.buffer)].data;
            bytes = unpack_solution({data.data() + view.byteOffset, view.byteLength},
                                    whole(*length, 0, std::numeric_limits<std::int64_t>::max(), kSolution),
                                    text(*extension, "hash", kSolution), context.budget.left());
        }
    } catch (const Refusal& refusal) {
        bytes = tl::unexpected(refusal.error);
    }
    if (bytes) {
        context.out.solution = std::move(*bytes);
    } else {
        context.warn(kSolution, bytes.error().what, "The scene itself is complete; its light is computed anew.");
    }
}

void report(ReadContext& context) {
    for (const auto& [what, count] : context.counted) {
        context.note("", fmt::format("{}{}", what, count > 1 ? fmt::format(" ({} times)", count) : ""));
    }
    for (const std::string& name : unknown_extensions(context.root)) {
        context.note("extensionsUsed", "the extension " + name + " is not interpreted",
                     "What it says about materials is kept when saving.");
    }
    if (!section(context.root, "animations").empty()) {
        context.note("animations", "animations are not played and will not be saved");
    }
}

LoadedScene read(const std::filesystem::path& path, std::vector<std::uint8_t> bytes, bool salvage) {
    const std::uint64_t size = bytes.size();
    Container container = salvage ? salvage_container(std::move(bytes)) : open_container(std::move(bytes));
    check_document(container.root, container.has_binary);

    LoadedScene out;
    for (const std::string& repair : container.repairs) {
        out.problems.push_back({Problem::Severity::Warning, {}, "", repair, ""});
    }
    Resources resources = fetch_resources(path, container, size, out.problems);
    MemoryBudget budget(std::max(20 * resources.file_bytes, std::uint64_t(1) << 30));
    const auto model = parse_model(container.root, std::move(resources.buffers));
    ReadContext context{container.root, *model, budget, out, {}, {}, {}, {}, {}, {}, {}};
    read_textures(context, resources.images);
    read_materials(context);
    read_photometry(context, path.parent_path());
    read_lights(context);
    read_cameras(context);
    read_meshes(context);
    read_nodes(context);
    read_environment(context);
    out.scene.extras = json_text(container.root, "extras");
    out.scene.asset_extras = asset_text(container.root);
    read_solution(context);
    report(context);
    return out;
}

} // namespace

Result<LoadedScene> read_scene(const std::filesystem::path& path, const ReadOptions& options) {
    auto bytes = read_file(path, kMaxSceneFile);
    if (!bytes) {
        return tl::unexpected(bytes.error());
    }
    try {
        return read(path, std::move(*bytes), options.salvage);
    } catch (Refusal& refusal) {
        refusal.error.file = path.string();
        return tl::unexpected(std::move(refusal.error));
    } catch (const std::bad_alloc&) {
        return fail(path.string(), "", "there is not enough memory to open the file");
    } catch (const std::exception& e) {
        // A library's own complaint about input that passed our checks.
        return fail(path.string(), "", std::string("is not valid glTF: ") + e.what(), "Export the file again.");
    }
}

} // namespace atrium
