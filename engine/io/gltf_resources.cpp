#include "engine/io/gltf_resources.h"

#include "engine/base/float_traps.h"
#include "engine/io/file_access.h"

#include <charconv>
#include <tiny_gltf.h>

namespace atrium::gltf {
namespace {

constexpr std::uint64_t kMaxFile = std::uint64_t(1) << 34; // 16 GiB: more than any interior, less than endless
constexpr std::uint64_t kMaxImageFile = std::uint64_t(1) << 30;

std::string mime_from_content(const std::vector<std::uint8_t>& bytes, const std::string& fallback) {
    const auto starts = [&](std::string_view magic) {
        return bytes.size() >= magic.size() &&
               std::equal(magic.begin(), magic.end(), bytes.begin(),
                          [](char a, std::uint8_t b) { return static_cast<unsigned char>(a) == b; });
    };
    if (starts("\x89PNG")) {
        return "image/png";
    }
    if (starts("\xFF\xD8\xFF")) {
        return "image/jpeg";
    }
    return starts("RIFF") ? "image/webp" : fallback;
}

std::vector<std::uint8_t> fetch_buffer(const std::filesystem::path& folder, const std::string& uri, const std::string& where,
                                       std::uint64_t& file_bytes) {
    std::vector<std::uint8_t> bytes;
    if (uri.starts_with("data:")) {
        std::string mime_type;
        if (!decode_data_uri(uri, mime_type, bytes)) {
            refuse(where, "its data: URI is not valid base64");
        }
        return bytes;
    }
    const auto path = resolve_uri(folder, uri);
    if (!path) {
        refuse(where, path.error().what, path.error().hint);
    }
    auto read = read_file(*path, kMaxFile);
    if (!read) {
        refuse(where, "the file \"" + uri + "\" " + read.error().what,
               "Put it beside the scene file, where it was exported.");
    }
    file_bytes += read->size();
    return std::move(*read);
}

/// Bytes of one image; empty with the reason in `why` when it cannot be had.
std::vector<std::uint8_t> fetch_image(const std::filesystem::path& folder, const Json& image, const Json& root,
                                      const Resources& resources, EncodedImage& out, std::string& why) {
    std::vector<std::uint8_t> bytes;
    if (const Json* view_index = find(image, "bufferView")) {
        const Json& view = section(root, "bufferViews")[view_index->get<std::size_t>()];
        const auto& buffer = resources.buffers[view["buffer"].get<std::size_t>()];
        const auto offset = std::ptrdiff_t(view.value("byteOffset", std::uint64_t(0)));
        bytes.assign(buffer.begin() + offset, buffer.begin() + offset + view["byteLength"].get<std::ptrdiff_t>());
        return bytes;
    }
    const std::string uri = image.value("uri", "");
    if (uri.empty()) {
        why = "has neither a file nor a buffer view";
    } else if (uri.starts_with("data:")) {
        if (!decode_data_uri(uri, out.mime_type, bytes)) {
            why = "its data: URI is not valid base64";
        }
    } else if (const auto path = resolve_uri(folder, uri); !path) {
        why = path.error().what;
    } else if (auto read = read_file(*path, kMaxImageFile); !read) {
        why = "the file \"" + uri + "\" " + read.error().what;
        out.uri = percent_decode(uri);
    } else {
        bytes = std::move(*read);
        out.uri = percent_decode(uri);
    }
    return bytes;
}

/// The parts of the document that tinygltf parses: no images (we decode them), no extensions and extras (we keep their
/// text), and every buffer a name that only our callback knows.
Json model_json(const Json& root, std::size_t buffer_count) {
    Json out;
    for (const char* key : {"asset", "accessors", "bufferViews", "meshes", "nodes", "cameras", "samplers", "textures"}) {
        if (const Json* value = find(root, key)) {
            out[key] = *value;
            if (value->is_array()) {
                for (Json& element : out[key]) {
                    element.erase("extensions");
                    element.erase("extras");
                }
            }
        }
    }
    out["asset"].erase("extensions");
    out["asset"].erase("extras");
    if (out.contains("meshes")) {
        for (Json& mesh : out["meshes"]) {
            for (Json& primitive : mesh["primitives"]) {
                primitive.erase("extensions");
                primitive.erase("extras");
            }
        }
    }
    for (std::size_t i = 0; i < buffer_count; ++i) {
        out["buffers"].push_back({{"byteLength", root["buffers"][i]["byteLength"]}, {"uri", "buffer" + std::to_string(i)}});
    }
    return out;
}

using BufferList = std::vector<std::vector<std::uint8_t>>;

/// Position of "buffer<n>" in the list, or npos.
std::size_t buffer_of(const std::string& name, const BufferList& buffers) {
    constexpr std::string_view kPrefix = "buffer";
    std::size_t n = 0;
    if (!name.starts_with(kPrefix) ||
        std::from_chars(name.data() + kPrefix.size(), name.data() + name.size(), n).ec != std::errc{} ||
        n >= buffers.size()) {
        return std::string::npos;
    }
    return n;
}

} // namespace

bool decode_data_uri(const std::string& uri, std::string& mime_type, std::vector<std::uint8_t>& out) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos) {
        return false;
    }
    const std::string head = uri.substr(5, comma - 5);
    mime_type = head.substr(0, head.find(';'));
    if (!head.ends_with(";base64")) {
        return false;
    }
    const std::string_view payload = std::string_view(uri).substr(comma + 1);
    return decode_base64(payload, out) ||
           (payload.find('%') != std::string_view::npos && decode_base64(percent_decode(std::string(payload)), out));
}

Resources fetch_resources(const std::filesystem::path& file, Container& container, std::uint64_t scene_bytes,
                          std::vector<Problem>& problems) {
    Resources out;
    out.file_bytes = scene_bytes;
    const Json& root = container.root;
    const std::filesystem::path folder = file.parent_path();
    const Json& buffers = section(root, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const std::string where = place(root, "buffers", i);
        const std::string uri = buffers[i].value("uri", "");
        std::vector<std::uint8_t> bytes =
            uri.empty() ? std::move(container.binary) : fetch_buffer(folder, uri, where, out.file_bytes);
        const std::uint64_t length = whole(buffers[i]["byteLength"], 1, kMaxFile, where);
        if (bytes.size() < length) {
            refuse(where,
                   "holds " + std::to_string(bytes.size()) + " bytes where the file announces " + std::to_string(length),
                   "The file is damaged or incomplete; copy or export it again.");
        }
        bytes.resize(std::size_t(length));
        out.buffers.push_back(std::move(bytes));
    }
    const Json& images = section(root, "images");
    for (std::size_t i = 0; i < images.size(); ++i) {
        EncodedImage image;
        std::string why;
        image.mime_type = images[i].value("mimeType", "");
        std::vector<std::uint8_t> bytes = fetch_image(folder, images[i], root, out, image, why);
        if (!why.empty()) {
            problems.push_back({Problem::Severity::Warning,
                                {},
                                place(root, "images", i),
                                why,
                                "Surfaces that use it show their plain colour."});
        } else {
            image.mime_type = mime_from_content(bytes, image.mime_type);
            out.file_bytes += image.uri.empty() ? 0 : bytes.size();
            image.bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
        }
        out.images.push_back(std::move(image));
    }
    return out;
}

std::shared_ptr<const tinygltf::Model> parse_model(const Json& root, BufferList buffers) {
    const std::string json = model_json(root, buffers.size()).dump(-1, ' ', false, Json::error_handler_t::replace);
    tinygltf::FsCallbacks files{};
    files.user_data = &buffers;
    files.FileExists = [](const std::string& name, void* data) {
        return buffer_of(name, *static_cast<BufferList*>(data)) != std::string::npos;
    };
    files.ExpandFilePath = [](const std::string& name, void*) { return name; };
    files.ReadWholeFile = [](std::vector<unsigned char>* out, std::string* error, const std::string& name, void* data) {
        BufferList& list = *static_cast<BufferList*>(data);
        const std::size_t n = buffer_of(name, list);
        if (n == std::string::npos) {
            *error += "unexpected file " + name;
            return false;
        }
        *out = std::move(list[n]);
        return true;
    };
    files.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; };

    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(files);
    auto model = std::make_shared<tinygltf::Model>();
    std::string error;
    std::string warning;
    const FloatTrapsOff library;
    if (!loader.LoadASCIIFromString(model.get(), &error, &warning, json.data(), unsigned(json.size()), "")) {
        while (!error.empty() && (error.back() == '\n' || error.back() == ' ')) {
            error.pop_back();
        }
        refuse("", error.empty() ? "is not valid glTF" : error, "Export the file again.");
    }
    return model;
}

} // namespace atrium::gltf
