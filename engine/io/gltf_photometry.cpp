// EXT_lights_ies <-> PhotometricWeb: profiles as whole LM-63 files, in the buffer or beside the scene.
#include "engine/io/file_access.h"
#include "engine/io/gltf_extensions.h"
#include "engine/io/gltf_resources.h"
#include "engine/io/gltf_write_context.h"
#include "engine/io/ies_reader.h"

#include <algorithm>
#include <fmt/format.h>
#include <tiny_gltf.h>

namespace atrium::gltf {
namespace {

constexpr char kMimeType[] = "application/x-ies-lm-63";
constexpr std::uint64_t kMaxFile = std::uint64_t(32) << 20;
constexpr std::uint64_t kBytesPerByte = 16; // numbers of two characters, twice as floats and as they stand

Result<std::vector<std::uint8_t>> read_beside(const std::filesystem::path& folder, const std::string& uri) {
    const auto path = resolve_uri(folder, uri);
    if (!path) {
        return tl::unexpected(path.error());
    }
    auto bytes = read_file(*path, kMaxFile);
    if (!bytes) {
        return fail("", "", "the file \"" + uri + "\" " + bytes.error().what, bytes.error().hint);
    }
    return bytes;
}

/// The LM-63 file of a profile.
Result<std::vector<std::uint8_t>> profile_bytes(const ReadContext& context, const Json& json,
                                                const std::filesystem::path& folder, const std::string& where) {
    const int view_index = index(json, "bufferView", context.model.bufferViews.size(), where);
    if (view_index >= 0) {
        const tinygltf::BufferView& view = context.model.bufferViews[std::size_t(view_index)];
        const auto& data = context.model.buffers[std::size_t(view.buffer)].data;
        const auto begin = data.begin() + std::ptrdiff_t(view.byteOffset);
        return std::vector<std::uint8_t>(begin, begin + std::ptrdiff_t(view.byteLength));
    }
    const std::string uri = text(json, "uri", where);
    if (uri.starts_with("data:")) {
        std::string mime_type;
        std::vector<std::uint8_t> bytes;
        if (!decode_data_uri(uri, mime_type, bytes)) {
            return fail("", "", "its data: URI is not valid base64");
        }
        return bytes;
    }
    return uri.empty() ? fail("", "", "has neither a file nor a buffer view") : read_beside(folder, uri);
}

std::string file_name_of(const Json& json, const std::string& where) {
    std::string name = text(json, "name", where);
    if (const std::string uri = text(json, "uri", where); name.empty() && !uri.starts_with("data:")) {
        name = std::filesystem::path(percent_decode(uri)).filename().string();
    }
    return name.empty() ? std::string("photometry.ies") : name;
}

} // namespace

void read_photometry(ReadContext& context, const std::filesystem::path& folder) {
    const Json* extension = find_extension(context.root, kLightsIes);
    const Json* profiles = extension != nullptr ? find_array(*extension, "lights", kLightsIes) : nullptr;
    for (std::size_t i = 0; profiles != nullptr && i < profiles->size(); ++i) {
        const Json& json = (*profiles)[i];
        const std::string where = fmt::format("{}/lights/{}", kLightsIes, i);
        const std::string name = file_name_of(json, where);
        context.webs.emplace_back();
        auto bytes = profile_bytes(context, json, folder, where);
        Result<LoadedPhotometry> loaded = fail("", "", "");
        if (bytes) {
            context.budget.charge(kBytesPerByte * bytes->size(), where);
            loaded = parse_ies(*bytes, name, [&](const std::string& tilt) { return read_beside(folder, tilt); });
        } else {
            loaded = tl::unexpected(bytes.error());
        }
        if (!loaded) {
            const Error& e = loaded.error();
            context.warn(where + " (" + name + ")", (e.where.empty() ? "" : e.where + ": ") + e.what,
                         "Lamps that use it shine as plain lights, or not at all.");
            continue;
        }
        for (const std::string& warning : loaded->warnings) {
            context.warn(where + " (" + name + ")", warning);
        }
        context.webs.back() = std::move(loaded->web);
    }
}

LightId node_photometry(ReadContext& context, const Json& node, LightId punctual, const std::string& where) {
    const Json* json = find_extension(node, kLightsIes);
    const int i = json != nullptr ? index(*json, "light", context.webs.size(), where) : -1;
    const Light* standing_in = context.out.scene.lights.find(punctual);
    // Ours: the punctual light knows its profile, and may say more than a multiplier.
    if (i < 0 || !context.webs[std::size_t(i)] || (standing_in != nullptr && standing_in->photometry)) {
        return punctual;
    }
    if (standing_in != nullptr) {
        context.note(where, "has a light profile and a punctual light; only the profile is used");
    }
    Light light;
    set_photometry(light, context.webs[std::size_t(i)]);
    light.name =
        text((*find_array(*find_extension(context.root, kLightsIes), "lights", kLightsIes))[std::size_t(i)], "name", where);
    light.intensity *= clamped(context, *json, "multiplier", 1.0F, 0.0F, 1e9F, where);
    light.color = glm::clamp(number3(*json, "color", Rgb(1.0F), where), Rgb(0.0F), Rgb(1.0F));
    return context.out.scene.lights.insert(std::move(light));
}

int write_profile(WriteContext& context, const Photometry& photometry) {
    for (std::size_t i = 0; i < context.profiles.size(); ++i) {
        if (context.profiles[i] == photometry) {
            return int(i);
        }
    }
    const PhotometricData& data = photometry->data();
    Json profile = {{"name", data.file_name}};
    if (context.embed_images) {
        profile["bufferView"] = context.add_view(data.file);
        profile["mimeType"] = kMimeType;
    } else {
        const bool plain = is_plain_relative_path(data.file_name) && !data.file_name.ends_with(".gltf") &&
                           !data.file_name.ends_with(".bin") && data.file_name.find('/') == std::string::npos;
        ImageFile file;
        file.bytes = std::make_shared<const std::vector<std::uint8_t>>(data.file);
        file.path =
            free_file_name(context, plain ? data.file_name : context.stem + "_photometry.ies", data.file, file.on_disk);
        profile["uri"] = percent_encode(file.path);
        context.image_files.push_back(std::move(file));
    }
    context.root["extensions"][kLightsIes]["lights"].push_back(std::move(profile));
    context.profiles.push_back(photometry);
    return int(context.profiles.size()) - 1;
}

void put_profile(const WriteContext& context, const Light& light, Json& node) {
    const auto at = std::find(context.profiles.begin(), context.profiles.end(), light.photometry);
    if (light_distribution(light) == nullptr || at == context.profiles.end()) {
        return;
    }
    Json& json = node["extensions"][kLightsIes];
    json = {{"light", at - context.profiles.begin()}};
    const float most = std::max(max_component(light.color), 1.0F); // colours end at 1
    const float multiplier = light.enabled ? std::max(light.intensity, 0.0F) * most / light.photometry->peak() : 0.0F;
    if (multiplier != 1.0F) {
        json["multiplier"] = short_number(multiplier);
    }
    if (light.color != Rgb(1.0F)) {
        json["color"] = short_numbers(glm::max(light.color, Rgb(0.0F)) / most);
    }
}

} // namespace atrium::gltf
