#include "engine/io/gltf_check.h"

#include "engine/io/gltf_extensions.h"
#include "engine/io/json_numbers.h"

#include <algorithm>

namespace atrium::gltf {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t(1) << 40;
constexpr std::uint64_t kUnsignedByte = 5121;
constexpr std::uint64_t kUnsignedShort = 5123;
constexpr std::uint64_t kUnsignedInt = 5125;

/// Every element of a section is an object.
const Json& objects(const Json& root, const char* key) {
    const Json& all = section(root, key);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!all[i].is_object()) {
            refuse(std::string(key) + "/" + std::to_string(i), "is not an object");
        }
    }
    return all;
}

std::uint64_t whole_or(const Json& object, const char* key, std::uint64_t fallback, std::uint64_t most,
                       const std::string& where) {
    const Json* value = find(object, key);
    return value != nullptr ? whole(*value, 0, most, where + "/" + key) : fallback;
}

std::uint64_t required(const Json& object, const char* key, std::uint64_t least, std::uint64_t most,
                       const std::string& where) {
    const Json* value = find(object, key);
    if (value == nullptr) {
        refuse(where, std::string("\"") + key + "\" is missing");
    }
    return whole(*value, least, most, where + "/" + key);
}

/// `count` elements of `size` bytes from `offset` must lie inside the buffer view; `where` names whose they are.
void check_inside_view(const Json& root, std::uint64_t view_index, std::uint64_t offset, std::uint64_t count,
                       std::uint64_t size, const std::string& where) {
    const Json& view = section(root, "bufferViews")[view_index];
    const std::uint64_t length = required(view, "byteLength", 1, kMaxBytes, where);
    const std::uint64_t stride = whole_or(view, "byteStride", size, 252, where);
    if (stride < size) {
        refuse(where, "the byteStride " + std::to_string(stride) + " of its buffer view is less than an element's " +
                          std::to_string(size) + " bytes");
    }
    // All terms are below 2^40 x 2^8, so nothing overflows.
    if (offset + stride * (count - 1) + size > length) {
        refuse(where,
               "reaches beyond the end of bufferViews/" + std::to_string(view_index) + " (" + std::to_string(length) +
                   " bytes)",
               "The file is damaged; export it again.");
    }
}

void check_sparse(const Json& root, const Json& accessor, std::uint64_t count, std::uint64_t element,
                  const std::string& where) {
    const Json* sparse = find_object(accessor, "sparse", where);
    if (sparse == nullptr) {
        return;
    }
    const std::uint64_t changed = required(*sparse, "count", 1, count, where + "/sparse");
    const std::size_t views = section(root, "bufferViews").size();
    for (const char* key : {"indices", "values"}) {
        const std::string part = where + "/sparse/" + key;
        const Json* object = find_object(*sparse, key, where);
        if (object == nullptr || index(*object, "bufferView", views, part) < 0) {
            refuse(part, "is missing");
        }
        std::uint64_t size = element;
        if (std::string_view(key) == "indices") {
            const std::uint64_t type = required(*object, "componentType", 0, 0xFFFF, part);
            if (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt) {
                refuse(part, "its component type is not an unsigned integer");
            }
            size = component_size(type);
        }
        const int view = index(*object, "bufferView", views, part);
        check_inside_view(root, std::uint64_t(view), whole_or(*object, "byteOffset", 0, kMaxBytes, part), changed, size,
                          part);
    }
}

/// Finds every {"index": n} below a key that ends in "Texture".
void check_texture_references(const Json& value, std::size_t textures, const std::string& where) {
    if (!value.is_object()) {
        return;
    }
    for (const auto& [key, member] : value.items()) {
        if (key == "extras") {
            continue;
        }
        if (key.ends_with("Texture") && member.is_object() && member.contains("index")) {
            index(member, "index", textures, where + "/" + key);
        }
        check_texture_references(member, textures, where + "/" + key);
    }
}

void check_primitive(const Json& root, const Json& primitive, const std::string& where) {
    const Json& accessors = section(root, "accessors");
    const auto check_attributes = [&](const Json& attributes, std::int64_t& count) {
        for (const auto& [name, value] : attributes.items()) {
            const int accessor = index(attributes, name.c_str(), accessors.size(), where);
            const auto elements = std::int64_t(whole(accessors[std::size_t(accessor)]["count"], 1, kMaxBytes, where));
            if (count >= 0 && elements != count) {
                refuse(where + "/" + name, "has " + std::to_string(elements) + " elements where the other attributes have " +
                                               std::to_string(count));
            }
            count = elements;
        }
    };
    const Json* attributes = find_object(primitive, "attributes", where);
    if (attributes == nullptr) {
        refuse(where, "\"attributes\" is missing");
    }
    std::int64_t count = -1;
    check_attributes(*attributes, count);
    const int indices = index(primitive, "indices", accessors.size(), where);
    if (indices >= 0) {
        const Json& accessor = accessors[std::size_t(indices)];
        const std::uint64_t type = whole(accessor["componentType"], 0, 0xFFFF, where);
        if (accessor["type"] != "SCALAR" || (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt)) {
            refuse(where + "/indices", "accessors/" + std::to_string(indices) + " does not hold unsigned whole numbers");
        }
    }
    index(primitive, "material", section(root, "materials").size(), where);
    whole_or(primitive, "mode", 4, 6, where);
    if (const Json* targets = find_array(primitive, "targets", where)) {
        for (const Json& target : *targets) {
            if (!target.is_object()) {
                refuse(where + "/targets", "holds something that is not an object");
            }
            check_attributes(target, count);
        }
    }
}

void check_transform(const Json& node, const std::string& where) {
    for (const auto& [key, size] : {std::pair("matrix", 16U), {"translation", 3U}, {"rotation", 4U}, {"scale", 3U}}) {
        const Json* value = find_array(node, key, where);
        if (value == nullptr) {
            continue;
        }
        if (value->size() != size) {
            refuse(where + "/" + key, "has " + std::to_string(value->size()) + " numbers, not " + std::to_string(size));
        }
        for (const Json& number : *value) {
            // The square must stay finite too: lengths are computed from these.
            if (!number.is_number() || !(std::abs(number.get<double>()) < 1e30)) {
                refuse(where + "/" + key, "holds something that is not a usable number");
            }
        }
    }
}

} // namespace

std::size_t component_size(std::uint64_t component_type) {
    switch (component_type) {
    case 5120:
    case kUnsignedByte: return 1;
    case 5122:
    case kUnsignedShort: return 2;
    case kUnsignedInt:
    case 5126: return 4;
    default: return 0;
    }
}

std::size_t component_count(const std::string& type) {
    static constexpr std::pair<std::string_view, std::size_t> kTypes[] = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    for (const auto& [name, count] : kTypes) {
        if (type == name) {
            return count;
        }
    }
    return 0;
}

void check_requirements(const Json& root) {
    if (const Json* names = find_array(root, "extensionsRequired", "")) {
        for (const Json& name : *names) {
            if (!name.is_string()) {
                refuse("extensionsRequired", "holds something that is not a text");
            }
            const auto& text = name.get_ref<const std::string&>();
            if (std::find(std::begin(kUnderstood), std::end(kUnderstood), text) == std::end(kUnderstood)) {
                refuse("extensionsRequired",
                       "the file cannot be read without the extension " + text + ", which is not supported",
                       "Export it again without " + text + ".");
            }
        }
    }
    const Json* asset = find_object(root, "asset", "");
    if (asset == nullptr) {
        refuse("asset", "is missing", "This is not a glTF 2.0 file.");
    }
    for (const char* key : {"version", "minVersion"}) {
        const std::string version = text(*asset, key, "asset");
        const bool good = version.starts_with("2.") && (std::string_view(key) == "version" || version == "2.0");
        if (!good && (std::string_view(key) == "version" || !version.empty())) {
            refuse("asset", "glTF version \"" + version + "\" is not supported", "Export the file as glTF 2.0.");
        }
    }
}

std::vector<std::string> unknown_extensions(const Json& root) {
    std::vector<std::string> out;
    for (const Json& name : section(root, "extensionsUsed")) {
        if (name.is_string() && std::find(std::begin(kUnderstood), std::end(kUnderstood), name) == std::end(kUnderstood) &&
            std::find(out.begin(), out.end(), name) == out.end()) {
            out.push_back(name.get<std::string>());
        }
    }
    return out;
}

void check_buffers(const Json& root, bool has_binary_chunk) {
    const Json& buffers = objects(root, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const std::string where = place(root, "buffers", i);
        required(buffers[i], "byteLength", 1, kMaxBytes, where);
        if (text(buffers[i], "uri", where).empty() && (i != 0 || !has_binary_chunk)) {
            refuse(where, "has no data: neither a file nor a binary chunk", "The file is incomplete; export it again.");
        }
    }
    const Json& views = objects(root, "bufferViews");
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::string where = place(root, "bufferViews", i);
        required(views[i], "buffer", 0, 0x7FFFFFFF, where);
        const int buffer = index(views[i], "buffer", buffers.size(), where);
        const std::uint64_t available = required(buffers[std::size_t(buffer)], "byteLength", 1, kMaxBytes, where);
        const std::uint64_t offset = whole_or(views[i], "byteOffset", 0, kMaxBytes, where);
        const std::uint64_t length = required(views[i], "byteLength", 1, kMaxBytes, where);
        if (offset + length > available) {
            refuse(where,
                   "reaches beyond the end of buffers/" + std::to_string(buffer) + " (" + std::to_string(available) +
                       " bytes)",
                   "The file is damaged; export it again.");
        }
        if (const Json* stride = find(views[i], "byteStride")) {
            if (whole(*stride, 4, 252, where + "/byteStride") % 4 != 0) {
                refuse(where + "/byteStride", "is not a multiple of 4");
            }
        }
    }
}

void check_accessors(const Json& root) {
    const Json& accessors = objects(root, "accessors");
    const std::size_t views = section(root, "bufferViews").size();
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        const std::string where = place(root, "accessors", i);
        const Json& accessor = accessors[i];
        const std::uint64_t count = required(accessor, "count", 1, 0xFFFFFFFF, where);
        const std::size_t size = component_size(required(accessor, "componentType", 0, 0xFFFF, where));
        const std::size_t components = component_count(text(accessor, "type", where));
        if (size == 0 || components == 0) {
            refuse(where, "its type or component type is unknown");
        }
        boolean(accessor, "normalized", false, where);
        const int view = index(accessor, "bufferView", views, where);
        const std::uint64_t offset = whole_or(accessor, "byteOffset", 0, kMaxBytes, where);
        if (view >= 0) {
            check_inside_view(root, std::uint64_t(view), offset, count, size * components, where);
        }
        check_sparse(root, accessor, count, size * components, where);
    }
}

void check_meshes(const Json& root) {
    const Json& meshes = objects(root, "meshes");
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const std::string where = place(root, "meshes", i);
        const Json* primitives = find_array(meshes[i], "primitives", where);
        if (primitives == nullptr || primitives->empty()) {
            refuse(where, "has no primitives");
        }
        for (std::size_t k = 0; k < primitives->size(); ++k) {
            if (!(*primitives)[k].is_object()) {
                refuse(where, "holds a primitive that is not an object");
            }
            check_primitive(root, (*primitives)[k], where + "/primitives/" + std::to_string(k));
        }
        if (const Json* weights = find_array(meshes[i], "weights", where)) {
            for (const Json& weight : *weights) {
                if (!float_of(weight)) {
                    refuse(where + "/weights", "holds something that is not a usable number");
                }
            }
        }
    }
}

void check_textures(const Json& root) {
    const Json& images = objects(root, "images");
    for (std::size_t i = 0; i < images.size(); ++i) {
        const std::string where = place(root, "images", i);
        index(images[i], "bufferView", section(root, "bufferViews").size(), where);
        text(images[i], "uri", where);
        text(images[i], "mimeType", where);
    }
    objects(root, "samplers");
    const Json& textures = objects(root, "textures");
    for (std::size_t i = 0; i < textures.size(); ++i) {
        const std::string where = place(root, "textures", i);
        index(textures[i], "source", images.size(), where);
        index(textures[i], "sampler", section(root, "samplers").size(), where);
        if (const Json* webp = find_extension(textures[i], kWebp)) {
            index(*webp, "source", images.size(), where);
        }
    }
    const Json& materials = objects(root, "materials");
    for (std::size_t i = 0; i < materials.size(); ++i) {
        check_texture_references(materials[i], textures.size(), place(root, "materials", i));
    }
}

void check_nodes(const Json& root) {
    const Json& nodes = objects(root, "nodes");
    objects(root, "skins");
    objects(root, "cameras");
    std::vector<int> parent(nodes.size(), -1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::string where = place(root, "nodes", i);
        index(nodes[i], "mesh", section(root, "meshes").size(), where);
        index(nodes[i], "camera", section(root, "cameras").size(), where);
        index(nodes[i], "skin", section(root, "skins").size(), where);
        check_transform(nodes[i], where);
        if (const Json* children = find_array(nodes[i], "children", where)) {
            for (const Json& child : *children) {
                const std::uint64_t c = whole(child, 0, nodes.size() - 1, where + "/children");
                if (parent[c] >= 0) {
                    refuse(place(root, "nodes", c),
                           "has two parents: nodes/" + std::to_string(parent[c]) + " and nodes/" + std::to_string(i));
                }
                parent[c] = int(i);
            }
        }
    }
    // With one parent each, a loop is found by walking up; nodes seen on an earlier walk lead to a root.
    std::vector<std::size_t> seen(nodes.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (int n = int(i); n >= 0 && seen[std::size_t(n)] != 1; n = parent[std::size_t(n)]) {
            if (seen[std::size_t(n)] == i + 2) {
                refuse(place(root, "nodes", std::size_t(n)), "is its own ancestor: the nodes form a loop");
            }
            seen[std::size_t(n)] = i + 2;
        }
        for (int n = int(i); n >= 0 && seen[std::size_t(n)] != 1; n = parent[std::size_t(n)]) {
            seen[std::size_t(n)] = 1;
        }
    }
    const Json& scenes = objects(root, "scenes");
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const std::string where = place(root, "scenes", i);
        if (const Json* roots = find_array(scenes[i], "nodes", where)) {
            for (const Json& node : *roots) {
                if (nodes.empty()) {
                    refuse(where, "refers to nodes but the file has none");
                }
                whole(node, 0, nodes.size() - 1, where + "/nodes");
            }
        }
    }
}

} // namespace atrium::gltf
