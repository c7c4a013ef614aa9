// Texture and Material -> glTF. Encoded images are written back byte for byte.
#include "engine/io/file_access.h"
#include "engine/io/gltf_extensions.h"
#include "engine/io/gltf_write_context.h"
#include "engine/io/image_file.h"

#include <algorithm>
#include <set>

namespace atrium::gltf {
namespace {

constexpr std::uint64_t kMaxImageFile = std::uint64_t(1) << 30;

using Bytes = std::shared_ptr<const std::vector<std::uint8_t>>;

Bytes encoded_image(const Texture& texture) {
    if (texture.encoded || !texture.image) {
        return texture.encoded;
    }
    auto png = encode_png(*texture.image);
    if (!png) {
        refuse("texture " + texture.name, png.error().what, "Assign an image file to it.");
    }
    return std::make_shared<const std::vector<std::uint8_t>>(std::move(*png));
}

std::string extension_of(const std::string& mime_type) {
    const std::size_t slash = mime_type.find('/');
    const std::string kind = slash == std::string::npos ? "png" : mime_type.substr(slash + 1);
    return "." + (kind == "jpeg" ? std::string("jpg") : kind);
}

/// Names of image files beside a .gltf: the one it came from if it can be had.
std::string choose_file(WriteContext& context, const Texture& texture, const std::vector<std::uint8_t>& bytes,
                        bool& on_disk) {
    std::string wish = texture.uri;
    if (!is_plain_relative_path(wish) || wish.ends_with(".gltf") || wish.ends_with(".bin")) {
        std::string name = texture.name.empty() ? "image" + std::to_string(context.image_files.size()) : texture.name;
        for (char& c : name) {
            c = c == '/' || c == '\\' || c == ':' || static_cast<unsigned char>(c) < 32 ? '_' : c;
        }
        const std::string extension = extension_of(texture.mime_type);
        wish = context.stem + "_" + name + (name.ends_with(extension) ? "" : extension);
    }
    return free_file_name(context, wish, bytes, on_disk);
}

/// Index of the glTF image of a texture; -1 when it has none. Textures with the same bytes share one.
int write_image(WriteContext& context, const Texture& texture, std::vector<std::tuple<std::string, Bytes, int>>& written) {
    const Bytes bytes = encoded_image(texture);
    const std::string uri = context.embed_images && bytes ? std::string() : texture.uri;
    for (const auto& [other_uri, other, index] : written) {
        if (uri == other_uri && (bytes == other || (bytes && other && *bytes == *other))) {
            return index;
        }
    }
    Json image;
    if (!bytes) {
        if (texture.uri.empty()) {
            return -1;
        }
        image["uri"] = percent_encode(texture.uri); // its file was missing; the link is kept for when it turns up
    } else if (context.embed_images) {
        image["bufferView"] = context.add_view(*bytes);
        image["mimeType"] = texture.mime_type.empty() ? "image/png" : texture.mime_type;
    } else {
        ImageFile file;
        file.path = choose_file(context, texture, *bytes, file.on_disk);
        file.bytes = bytes;
        image["uri"] = percent_encode(file.path);
        context.image_files.push_back(std::move(file));
    }
    const int index = context.add("images", std::move(image));
    written.emplace_back(uri, bytes, index);
    return index;
}

int wrap_number(Texture::Wrap wrap) {
    switch (wrap) {
    case Texture::Wrap::ClampToEdge: return 33071;
    case Texture::Wrap::MirroredRepeat: return 33648;
    case Texture::Wrap::Repeat: break;
    }
    return 10497;
}

int write_sampler(WriteContext& context, const Texture& texture) {
    Json sampler = Json::object();
    if (texture.wrap_u != Texture::Wrap::Repeat) {
        sampler["wrapS"] = wrap_number(texture.wrap_u);
    }
    if (texture.wrap_v != Texture::Wrap::Repeat) {
        sampler["wrapT"] = wrap_number(texture.wrap_v);
    }
    if (texture.nearest) {
        sampler["magFilter"] = 9728;
    }
    if (sampler.empty()) {
        return -1;
    }
    Json& all = context.root["samplers"];
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i] == sampler) {
            return int(i);
        }
    }
    return context.add("samplers", std::move(sampler));
}

Json texture_info(const WriteContext& context, const TextureRef& ref) {
    Json info = {{"index", context.textures.at(ref.texture)}};
    if (ref.texcoord != 0) {
        info["texCoord"] = ref.texcoord;
    }
    Json transform = Json::object();
    if (ref.offset != vec2(0.0F)) {
        transform["offset"] = {short_number(ref.offset.x), short_number(ref.offset.y)};
    }
    if (ref.scale != vec2(1.0F)) {
        transform["scale"] = {short_number(ref.scale.x), short_number(ref.scale.y)};
    }
    if (ref.rotation != 0.0F) {
        transform["rotation"] = short_number(ref.rotation);
    }
    if (!transform.empty()) {
        info["extensions"][kTextureTransform] = std::move(transform);
    }
    return info;
}

/// Sets object[key] unless the value is what glTF assumes anyway.
void put(Json& object, const char* key, float value, float usual) {
    if (value != usual) {
        object[key] = short_number(value);
    }
}
void put(Json& object, const char* key, const Rgb& value, const Rgb& usual) {
    if (value != usual) {
        object[key] = short_numbers(value);
    }
}

void write_emission(const Material& m, Json& json) {
    Rgb color = glm::max(m.emissive_color, Rgb(0.0F));
    float strength = std::max(m.emissive_strength, 0.0F);
    if (const float most = max_component(color); most > 1.0F) {
        color /= most;
        strength *= most;
    }
    put(json, "emissiveFactor", color, Rgb(0.0F));
    if (strength != 1.0F) {
        json["extensions"][kEmissiveStrength]["emissiveStrength"] = short_number(strength);
    }
}

void write_glass(const Material& m, Json& json) {
    Json transmission = Json::object();
    put(transmission, "transmissionFactor", m.transmission, 0.0F);
    Json ior = Json::object();
    put(ior, "ior", m.ior, 1.5F);
    Json specular = Json::object();
    put(specular, "specularFactor", m.specular, 1.0F);
    put(specular, "specularColorFactor", m.specular_color, Rgb(1.0F));
    Json volume = Json::object();
    put(volume, "thicknessFactor", m.thickness, 0.0F);
    put(volume, "attenuationColor", m.attenuation_color, Rgb(1.0F));
    if (std::isfinite(m.attenuation_distance) && m.attenuation_distance > 0.0F) {
        volume["attenuationDistance"] = short_number(m.attenuation_distance);
    }
    for (auto& [name, value] : {std::pair(kTransmission, &transmission), std::pair(kIor, &ior),
                                std::pair(kSpecular, &specular), std::pair(kVolume, &volume)}) {
        if (!value->empty()) {
            json["extensions"][name] = std::move(*value);
        }
    }
    if (m.unlit) {
        json["extensions"][kUnlit] = Json::object();
    }
}

void write_other_textures(const WriteContext& context, const Material& m, Json& json) {
    for (const Material::OtherTexture& other : m.other_textures) {
        if (!context.textures.contains(other.ref.texture)) {
            continue;
        }
        Json* at = &json;
        std::size_t begin = 0;
        for (std::size_t slash = 0; (slash = other.slot.find('/', begin)) != std::string::npos; begin = slash + 1) {
            at = &(*at)[other.slot.substr(begin, slash - begin)];
        }
        Json& info = (*at)[other.slot.substr(begin)];
        info = texture_info(context, other.ref);
        put(info, other.slot == "occlusionTexture" ? "strength" : "scale", other.scale, 1.0F);
    }
}

Json material_json(const WriteContext& context, const Material& m) {
    Json json = Json::object();
    if (!m.name.empty()) {
        json["name"] = m.name;
    }
    put_text(json, "extensions", m.other_extensions);
    Json pbr = Json::object();
    const Rgb base = glm::clamp(m.base_color, Rgb(0.0F), Rgb(1.0F));
    const float alpha = std::clamp(m.alpha, 0.0F, 1.0F);
    if (base != Rgb(1.0F) || alpha != 1.0F) {
        pbr["baseColorFactor"] = short_numbers(base);
        pbr["baseColorFactor"].push_back(short_number(alpha));
    }
    put(pbr, "metallicFactor", std::clamp(m.metallic, 0.0F, 1.0F), 1.0F);
    put(pbr, "roughnessFactor", std::clamp(m.roughness, 0.0F, 1.0F), 1.0F);
    if (context.textures.contains(m.base_color_texture.texture)) {
        pbr["baseColorTexture"] = texture_info(context, m.base_color_texture);
    }
    if (!pbr.empty()) {
        json["pbrMetallicRoughness"] = std::move(pbr);
    }
    if (context.textures.contains(m.emissive_texture.texture)) {
        json["emissiveTexture"] = texture_info(context, m.emissive_texture);
    }
    write_emission(m, json);
    write_glass(m, json);
    write_other_textures(context, m, json);
    if (m.double_sided) {
        json["doubleSided"] = true;
    }
    if (m.alpha_mode != Material::Alpha::Opaque) {
        json["alphaMode"] = m.alpha_mode == Material::Alpha::Mask ? "MASK" : "BLEND";
    }
    // glTF allows a cutoff with MASK only.
    if (m.alpha_mode == Material::Alpha::Mask) {
        put(json, "alphaCutoff", m.alpha_cutoff, 0.5F);
    }
    put_text(json, "extras", m.extras);
    return json;
}

/// Materials that some part of a node in the tree shows, in id order.
std::set<MaterialId> used_materials(const WriteContext& context) {
    std::set<MaterialId> out;
    for (const NodeId id : context.nodes) {
        for (const MaterialId material : part_materials(context.scene, *context.scene.nodes.find(id))) {
            if (material) {
                out.insert(material);
            }
        }
    }
    return out;
}

} // namespace

std::string free_file_name(const WriteContext& context, const std::string& wish, const std::vector<std::uint8_t>& bytes,
                           bool& on_disk) {
    const std::filesystem::path path(wish);
    for (int attempt = 1;; ++attempt) {
        const std::string name =
            attempt == 1
                ? wish
                : (path.parent_path() / (path.stem().string() + "-" + std::to_string(attempt) + path.extension().string()))
                      .generic_string();
        const bool taken = std::any_of(context.image_files.begin(), context.image_files.end(),
                                       [&](const ImageFile& file) { return file.path == name; });
        if (taken) {
            continue;
        }
        std::error_code ignored;
        if (!std::filesystem::exists(context.folder / name, ignored)) {
            on_disk = false;
            return name;
        }
        if (const auto old = read_file(context.folder / name, kMaxImageFile); old && *old == bytes) {
            on_disk = true;
            return name;
        }
    }
}

void write_textures(WriteContext& context) {
    std::set<TextureId> used;
    for (const MaterialId id : used_materials(context)) {
        const Material& m = *context.scene.materials.find(id);
        used.insert(m.base_color_texture.texture);
        used.insert(m.emissive_texture.texture);
        for (const auto& other : m.other_textures) {
            used.insert(other.ref.texture);
        }
    }
    std::vector<std::tuple<std::string, Bytes, int>> written;
    for (const TextureId id : used) {
        const Texture* texture = context.scene.textures.find(id);
        if (texture == nullptr) {
            continue;
        }
        Json json = Json::object();
        if (!texture->name.empty()) {
            json["name"] = texture->name;
        }
        if (const int image = write_image(context, *texture, written); image >= 0) {
            if (texture->mime_type == "image/webp") {
                json["extensions"][kWebp]["source"] = image;
            } else {
                json["source"] = image;
            }
        }
        if (const int sampler = write_sampler(context, *texture); sampler >= 0) {
            json["sampler"] = sampler;
        }
        context.textures[id] = context.add("textures", std::move(json));
    }
}

void write_materials(WriteContext& context) {
    for (const MaterialId id : used_materials(context)) {
        context.materials[id] = context.add("materials", material_json(context, *context.scene.materials.find(id)));
    }
}

} // namespace atrium::gltf
