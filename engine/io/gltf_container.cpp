#include "engine/io/gltf_container.h"

#include "engine/io/json_numbers.h"

#include <cstring>

namespace atrium::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67; // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinChunk = 0x004E4942;
constexpr int kMaxDepth = 200;
constexpr char kDamaged[] = "The file is damaged or incomplete; copy or export it again.";

std::uint32_t little_endian(std::span<const std::uint8_t> bytes, std::size_t at) {
    return std::uint32_t(bytes[at]) | std::uint32_t(bytes[at + 1]) << 8 | std::uint32_t(bytes[at + 2]) << 16 |
           std::uint32_t(bytes[at + 3]) << 24;
}

void append(std::vector<std::uint8_t>& out, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) {
        out.push_back(std::uint8_t(value >> shift));
    }
}

Json parse(std::string_view json, Container& container) {
    if (json.starts_with("\xEF\xBB\xBF")) {
        json.remove_prefix(3);
        container.repairs.emplace_back("the text starts with a byte order mark, which glTF forbids");
    }
    if (json.empty()) {
        refuse("", "the file is empty");
    }
    check_depth(json);
    try {
        Json root = parse_json(json);
        if (!root.is_object()) {
            refuse("", "is not a glTF file: the JSON text is not an object");
        }
        return root;
    } catch (const Json::exception& e) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
        const std::string message = e.what();
        const std::size_t bracket = message.find("] ");
        refuse("JSON", bracket == std::string::npos ? message : message.substr(bracket + 2), kDamaged);
    }
}

} // namespace

/// Printing JSON and tinygltf's own conversion recurse: deep nesting would overflow the stack.
void check_depth(std::string_view json) {
    int depth = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_text) {
            if (c == '\\') {
                ++i;
            } else if (c == '"') {
                in_text = false;
            }
        } else if (c == '"') {
            in_text = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kMaxDepth) {
                refuse("JSON", "is nested more than " + std::to_string(kMaxDepth) + " levels deep");
            }
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

Container open_container(std::vector<std::uint8_t> bytes) {
    Container out;
    if (bytes.size() < 4 || little_endian(bytes, 0) != kMagic) {
        const bool binary = !bytes.empty() && bytes[0] < 9;
        if (binary) {
            refuse("", "is neither glTF text nor a binary glTF file", "Choose a .gltf, .glb or .atrium file.");
        }
        out.root = parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, out);
        return out;
    }
    out.is_glb = true;
    if (bytes.size() < 20) {
        refuse("GLB header", "the file ends after " + std::to_string(bytes.size()) + " bytes", kDamaged);
    }
    const std::uint32_t version = little_endian(bytes, 4);
    if (version != 2) {
        refuse("GLB header", "version " + std::to_string(version) + " is not supported", "Export the file as glTF 2.0.");
    }
    const std::uint32_t length = little_endian(bytes, 8);
    if (length != bytes.size()) {
        refuse("GLB header",
               "announces " + std::to_string(length) + " bytes but the file has " + std::to_string(bytes.size()), kDamaged);
    }
    std::size_t at = 12;
    int chunk = 0;
    while (at < bytes.size()) {
        const std::string where = "GLB chunk " + std::to_string(chunk);
        if (bytes.size() - at < 8) {
            refuse(where, "its header is cut off", kDamaged);
        }
        const std::size_t size = little_endian(bytes, at);
        const std::uint32_t type = little_endian(bytes, at + 4);
        at += 8;
        if (size > bytes.size() - at) {
            refuse(where,
                   "announces " + std::to_string(size) + " bytes but " + std::to_string(bytes.size() - at) + " are left",
                   kDamaged);
        }
        const std::span<const std::uint8_t> content(bytes.data() + at, size);
        if (chunk == 0) {
            if (type != kJsonChunk) {
                refuse(where, "the first chunk is not JSON", kDamaged);
            }
            out.root = parse({reinterpret_cast<const char*>(content.data()), size}, out);
        } else if (type == kBinChunk) {
            if (out.has_binary) {
                refuse(where, "a second binary chunk", kDamaged);
            }
            out.has_binary = true;
            out.binary.assign(content.begin(), content.end());
        } else {
            out.repairs.push_back(where + " is of an unknown type and was skipped");
        }
        at += size;
        ++chunk;
    }
    return out;
}

std::vector<std::uint8_t> make_glb(const std::string& json, std::span<const std::uint8_t> binary) {
    const std::size_t json_size = (json.size() + 3) & ~std::size_t(3);
    const std::size_t binary_size = (binary.size() + 3) & ~std::size_t(3);
    const std::size_t total = 20 + json_size + (binary.empty() ? 0 : 8 + binary_size);
    if (total > 0xFFFFFFFFU) {
        refuse("", "the scene is larger than 4 GiB, more than one binary glTF file can hold", "Save as .gltf.");
    }
    std::vector<std::uint8_t> out;
    out.reserve(total);
    append(out, kMagic);
    append(out, 2);
    append(out, std::uint32_t(total));
    append(out, std::uint32_t(json_size));
    append(out, kJsonChunk);
    out.insert(out.end(), json.begin(), json.end());
    out.resize(20 + json_size, ' ');
    if (!binary.empty()) {
        append(out, std::uint32_t(binary_size));
        append(out, kBinChunk);
        out.insert(out.end(), binary.begin(), binary.end());
        out.resize(total, 0);
    }
    return out;
}

} // namespace atrium::gltf
