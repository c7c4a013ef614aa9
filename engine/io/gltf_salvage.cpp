#include "engine/io/gltf_salvage.h"

#include "engine/io/gltf_check.h"
#include "engine/io/gltf_extensions.h"
#include "engine/io/json_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <set>

namespace atrium::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67; // "glTF"
constexpr int kMaxCuts = 64;
constexpr std::uint64_t kMaxPadding = std::uint64_t(1) << 30;

std::uint32_t little_endian(std::span<const std::uint8_t> bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (unsigned i = 0; i < 4; ++i) {
        value |= std::uint32_t(bytes[at + i]) << (8 * i);
    }
    return value;
}

/// The text up to its last complete value, with everything that is open there closed.
std::string closed(std::string_view text) {
    std::string open;
    std::string open_at_end;
    std::size_t end = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_text) {
            i += c == '\\' ? 1 : 0;
            in_text = c != '"';
            continue;
        }
        if (c == '"') {
            in_text = true;
        } else if (c == '{' || c == '[') {
            open += c == '{' ? '}' : ']';
            end = i + 1;
            open_at_end = open;
        } else if ((c == '}' || c == ']') && !open.empty()) {
            open.pop_back();
            end = i + 1;
            open_at_end = open;
        } else if (c == ',') {
            end = i;
            open_at_end = open;
        }
    }
    std::reverse(open_at_end.begin(), open_at_end.end());
    return std::string(text.substr(0, end)) + open_at_end;
}

/// Parses as much as is sound; `whole` tells whether that was all.
Json parse_what_is_sound(std::string_view bytes, bool& whole) {
    whole = true;
    std::string text(bytes);
    for (int cut = 0; cut < kMaxCuts && !text.empty(); ++cut) {
        check_depth(text);
        try {
            Json root = parse_json(text);
            if (root.is_object()) {
                return root;
            }
            break;
        } catch (const Json::parse_error& e) {
            whole = false;
            const std::size_t sound = std::min<std::size_t>(e.byte > 0 ? e.byte - 1 : 0, text.size());
            std::string next = closed(std::string_view(text).substr(0, sound));
            // What was closed and still fails is cut before its last value.
            text = next == text ? closed(std::string_view(text).substr(0, text.size() / 2)) : std::move(next);
        }
    }
    refuse("JSON", "nothing of the scene's description can be read");
}

/// Takes references out of a document until what they point at is there. Counts what goes.
class Pruner {
public:
    Pruner(Json& root, std::size_t available) : root_(root), available_(available) {}

    void run() {
        keep_objects();
        views();
        accessors();
        textures();
        meshes();
        nodes();
        scenes();
        root_.erase("animations");
        root_.erase("skins");
    }
    std::set<std::size_t> lost_meshes;
    int lost_references = 0;

private:
    Json& array(const char* key) {
        Json& value = root_[key];
        if (!value.is_array()) {
            value = Json::array();
        }
        return value;
    }
    std::size_t count(const char* key) { return array(key).size(); }
    static bool number(const Json& object, const char* key, std::uint64_t& out) {
        const auto it = object.find(key);
        if (it == object.end() || !it->is_number() || it->get<double>() < 0 || it->get<double>() > 1e15) {
            return false;
        }
        out = it->get<std::uint64_t>();
        return true;
    }
    /// Erases object[key] unless it is an index below `size`.
    bool keep_index(Json& object, const char* key, std::size_t size) {
        std::uint64_t value = 0;
        if (!object.contains(key) || (number(object, key, value) && value < size)) {
            return true;
        }
        object.erase(key);
        ++lost_references;
        return false;
    }
    void keep_objects() {
        for (const char* key : {"accessors", "bufferViews", "buffers", "cameras", "images", "materials", "meshes", "nodes",
                                "samplers", "scenes", "textures"}) {
            for (Json& element : array(key)) {
                if (!element.is_object()) {
                    element = Json::object();
                }
            }
        }
        if (!root_.contains("asset") || !root_["asset"].is_object()) {
            root_["asset"] = {{"version", "2.0"}};
        }
        root_.erase("extensionsRequired"); // whatever it asks for, something is better than nothing
    }
    void views() {
        // Places that a missing view had are filled by one that is marked, so that numbers of others stay.
        Json& list = array("bufferViews");
        for (std::size_t i = 0; i < list.size(); ++i) {
            std::uint64_t buffer = 0;
            std::uint64_t length = 0;
            std::uint64_t offset = 0;
            number(list[i], "byteOffset", offset);
            const bool sound = number(list[i], "buffer", buffer) && buffer < count("buffers") &&
                               number(list[i], "byteLength", length) && length > 0 &&
                               (buffer != 0 || root_["buffers"][0].contains("uri") || offset + length <= available_);
            if (!sound) {
                lost_views_.insert(i);
            }
        }
        view_count_ = list.size();
    }
    [[nodiscard]] bool view_lost(std::uint64_t view) const { return view >= view_count_ || lost_views_.count(view) != 0; }
    void accessors() {
        Json& list = array("accessors");
        for (std::size_t i = 0; i < list.size(); ++i) {
            std::uint64_t view = 0;
            std::uint64_t values = 0;
            const bool sound = number(list[i], "count", values) && list[i].contains("componentType") &&
                               list[i].contains("type") && (!number(list[i], "bufferView", view) || !view_lost(view));
            if (!sound) {
                lost_accessors_.insert(i);
            }
        }
        accessor_count_ = list.size();
    }
    [[nodiscard]] bool accessor_lost(const Json& value) const {
        return !value.is_number_unsigned() || value.get<std::uint64_t>() >= accessor_count_ ||
               lost_accessors_.count(value.get<std::uint64_t>()) != 0;
    }
    void textures() {
        for (Json& image : array("images")) {
            std::uint64_t view = 0;
            if (number(image, "bufferView", view) && view_lost(view)) {
                image.erase("bufferView"); // the reader tells that it has no content
                ++lost_references;
            }
        }
        for (Json& texture : array("textures")) {
            keep_index(texture, "source", count("images"));
            keep_index(texture, "sampler", count("samplers"));
        }
        const std::size_t size = count("textures");
        const std::function<void(Json&)> walk = [&](Json& value) {
            if (value.is_object()) {
                for (auto it = value.begin(); it != value.end();) {
                    std::uint64_t index = 0;
                    const bool is_texture = it.key().ends_with("Texture") && it->is_object();
                    if (is_texture && (!number(*it, "index", index) || index >= size)) {
                        it = value.erase(it);
                        ++lost_references;
                    } else {
                        walk(*it);
                        ++it;
                    }
                }
            }
        };
        for (Json& material : array("materials")) {
            walk(material);
        }
    }
    void meshes() {
        Json& list = array("meshes");
        for (std::size_t i = 0; i < list.size(); ++i) {
            Json& primitives = list[i]["primitives"];
            if (!primitives.is_array()) {
                primitives = Json::array();
            }
            const auto lost = [&](const Json& primitive) {
                const Json* attributes = primitive.is_object() ? find(primitive, "attributes") : nullptr;
                return attributes == nullptr || !attributes->is_object() ||
                       std::any_of(attributes->begin(), attributes->end(),
                                   [&](const Json& a) { return accessor_lost(a); }) ||
                       (primitive.contains("indices") && accessor_lost(primitive["indices"]));
            };
            if (const Json* shape = find_extension(list[i], kShape);
                shape != nullptr && shape->is_object() &&
                (primitives.empty() || std::any_of(primitives.begin(), primitives.end(), lost))) {
                stand_in(primitives);
                continue;
            }
            for (std::size_t p = primitives.size(); p-- > 0;) {
                if (lost(primitives[p])) {
                    primitives.erase(p);
                    lost_meshes.insert(i);
                } else {
                    primitives[p].erase("targets");
                    keep_index(primitives[p], "material", count("materials"));
                }
            }
        }
    }
    /// A shape is described in the text: any triangle will do in the place of those that stood for it.
    void stand_in(Json& primitives) {
        Json one = {{"attributes", {{"POSITION", root_["accessors"].size()}}}};
        root_["accessors"].push_back(
            {{"componentType", 5126U}, {"count", 3U}, {"type", "VEC3"}, {"min", {0, 0, 0}}, {"max", {0, 0, 0}}});
        if (!primitives.empty() && primitives[0].is_object() && primitives[0].contains("material")) {
            one["material"] = primitives[0]["material"];
            keep_index(one, "material", count("materials"));
        }
        primitives = Json::array({one});
    }
    void nodes() {
        Json& list = array("nodes");
        std::vector<bool> has_parent(list.size(), false);
        for (std::size_t i = 0; i < list.size(); ++i) {
            Json& node = list[i];
            std::uint64_t mesh = 0;
            if (number(node, "mesh", mesh) && mesh < count("meshes") && array("meshes")[mesh]["primitives"].empty()) {
                node.erase("mesh");
            }
            keep_index(node, "mesh", count("meshes"));
            keep_index(node, "camera", count("cameras"));
            node.erase("skin");
            if (auto it = node.find("children"); it != node.end()) {
                Json kept = Json::array();
                for (const Json& child : *it) {
                    const bool there = child.is_number_unsigned() && child.get<std::uint64_t>() < list.size() &&
                                       child.get<std::uint64_t>() != i && !has_parent[child.get<std::size_t>()];
                    if (there) {
                        has_parent[child.get<std::size_t>()] = true;
                        kept.push_back(child);
                    } else {
                        ++lost_references;
                    }
                }
                *it = kept;
                if (kept.empty()) {
                    node.erase("children");
                }
            }
            if (auto it = node.find("extensions"); it != node.end() && it->is_object()) {
                if (auto punctual = it->find(kLightsPunctual); punctual != it->end()) {
                    std::uint64_t light = 0;
                    const Json* lights = find_extension(root_, kLightsPunctual);
                    const Json* all = lights == nullptr ? nullptr : find(*lights, "lights");
                    if (!punctual->is_object() || !number(*punctual, "light", light) || all == nullptr || !all->is_array() ||
                        light >= all->size()) {
                        it->erase(kLightsPunctual);
                        ++lost_references;
                    }
                }
            }
        }
        roots_ = Json::array();
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (!has_parent[i]) {
                roots_.push_back(i);
            }
        }
        // Meshes without triangles are gone from nodes; the check wants none of them.
        for (Json& mesh : array("meshes")) {
            if (mesh["primitives"].empty()) {
                mesh["primitives"] = Json::array({{{"attributes", Json::object()}}});
            }
        }
        if (!lost_views_.empty() && count("buffers") == 0) {
            root_["buffers"] = Json::array({{{"byteLength", 4U}}});
        }
        for (const std::size_t view : lost_views_) {
            root_["bufferViews"][view] = {{"buffer", 0U}, {"byteLength", 1U}};
        }
        for (const std::size_t accessor : lost_accessors_) {
            root_["accessors"][accessor] = {{"componentType", 5126U}, {"count", 1U}, {"type", "SCALAR"}};
        }
        if (auto solution = find_extension(root_, kSolution)) {
            std::uint64_t view = 0;
            if (!solution->is_object() || !number(*solution, "bufferView", view) || view_lost(view)) {
                root_["extensions"].erase(kSolution);
            }
        }
    }
    void scenes() {
        // Every object that nothing holds is a root: a list of roots that was cut would hide what is there.
        if (!roots_.empty()) {
            root_["scenes"] = Json::array({{{"nodes", roots_}}});
            root_["scene"] = 0U;
        } else {
            root_.erase("scenes");
            root_.erase("scene");
        }
        for (const char* key : {"accessors", "bufferViews", "buffers", "cameras", "images", "materials", "meshes", "nodes",
                                "samplers", "textures"}) {
            if (root_[key].empty()) {
                root_.erase(key);
            }
        }
    }
    Json& root_;
    std::size_t available_;
    std::size_t view_count_ = 0;
    std::size_t accessor_count_ = 0;
    std::set<std::uint64_t> lost_views_;
    std::set<std::uint64_t> lost_accessors_;
    Json roots_;
};

} // namespace

Container salvage_container(std::vector<std::uint8_t> bytes) {
    Container out;
    std::string_view json(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (bytes.size() >= 20 && little_endian(bytes, 0) == kMagic) {
        out.is_glb = true;
        const std::size_t left = bytes.size() - 20;
        const std::size_t size = std::min<std::size_t>(little_endian(bytes, 12), left);
        json = json.substr(20, size);
        if (left - size >= 8) {
            out.has_binary = true;
            const auto start = bytes.begin() + std::ptrdiff_t(20 + size + 8);
            out.binary.assign(
                start, start + std::ptrdiff_t(std::min<std::size_t>(little_endian(bytes, 20 + size), left - size - 8)));
        }
    } else if (bytes.empty() || bytes[0] < 9) {
        refuse("", "is neither glTF text nor a binary glTF file", "Choose a .gltf, .glb or .atrium file.");
    }
    if (json.starts_with("\xEF\xBB\xBF")) {
        json.remove_prefix(3);
    }
    bool whole_text = true;
    out.root = parse_what_is_sound(json, whole_text);
    Pruner pruner(out.root, out.binary.size());
    pruner.run();

    // The first buffer is as long as it says: what is missing is never looked at.
    if (Json* buffers = out.root.contains("buffers") ? &out.root["buffers"] : nullptr;
        buffers != nullptr && !buffers->at(0).contains("uri")) {
        out.has_binary = true;
        Json& length = (*buffers)[0]["byteLength"];
        const std::uint64_t announced = length.is_number_unsigned() ? length.get<std::uint64_t>() : 0;
        const std::uint64_t wanted = std::max<std::uint64_t>({announced, out.binary.size(), 4});
        if (wanted > std::max<std::uint64_t>(kMaxPadding, 20 * std::uint64_t(bytes.size()))) {
            refuse("buffers/0", "is said to be larger than a file of this size can explain");
        }
        length = wanted;
        out.binary.resize(std::size_t(wanted));
    }
    if (!whole_text) {
        out.repairs.emplace_back("the description of the scene is damaged: objects after that place are missing");
    }
    if (!pruner.lost_meshes.empty()) {
        out.repairs.push_back(fmt::format("the triangles of {} meshes are missing or damaged", pruner.lost_meshes.size()));
    }
    if (pruner.lost_references > 0) {
        out.repairs.push_back(fmt::format("{} references lead to parts that are missing", pruner.lost_references));
    }
    if (out.repairs.empty()) {
        out.repairs.emplace_back("the file is damaged, and nothing that was looked at is missing");
    }
    return out;
}

} // namespace atrium::gltf
