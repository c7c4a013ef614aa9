// glTF materials with their KHR extensions -> Material. What we do not interpret is kept as text for saving.
#include "engine/io/gltf_extensions.h"
#include "engine/io/gltf_read_context.h"
#include "engine/io/json_numbers.h"
#include "engine/scene/light_limits.h"

#include <fmt/format.h>

namespace atrium::gltf {
namespace {

TextureRef read_texture_ref(ReadContext& context, const Json& info, const std::string& where) {
    TextureRef ref;
    ref.texture = context.textures[info["index"].get<std::size_t>()];
    double texcoord = number(info, "texCoord", 0.0, where);
    if (const Json* transform = find_extension(info, kTextureTransform)) {
        const auto pair = [&](const char* key, const vec2& fallback) {
            const Json* value = find_array(*transform, key, where);
            if (value == nullptr) {
                return fallback;
            }
            if (value->size() != 2 || !(*value)[0].is_number() || !(*value)[1].is_number()) {
                refuse(where + "/" + key, "is not an array of two numbers");
            }
            const auto x = float_of((*value)[0]);
            const auto y = float_of((*value)[1]);
            if (!x || !y) {
                refuse(where + "/" + key, "holds a number that is too large");
            }
            return vec2(*x, *y);
        };
        ref.offset = pair("offset", vec2(0.0F));
        ref.scale = pair("scale", vec2(1.0F));
        ref.rotation = float(number(*transform, "rotation", 0.0, where));
        texcoord = number(*transform, "texCoord", texcoord, where);
    }
    if (texcoord != 0.0 && texcoord != 1.0) {
        context.warn(where, fmt::format("uses texture coordinates {}; only sets 0 and 1 are read, set 0 is used", texcoord));
        texcoord = 0.0;
    }
    ref.texcoord = int(texcoord);
    return ref;
}

/// Takes every texture out of the material's JSON: the two that the light reads into their fields, the others by path.
void take_textures(ReadContext& context, Json& object, const std::string& path, Material& material,
                   const std::string& where) {
    std::vector<std::string> taken;
    for (auto& [key, member] : object.items()) {
        if (key == "extras" || !member.is_object()) {
            continue;
        }
        const std::string slot = path + key;
        if (!key.ends_with("Texture") || !member.contains("index")) {
            take_textures(context, member, slot + "/", material, where);
            continue;
        }
        const TextureRef ref = read_texture_ref(context, member, where + "/" + slot);
        if (slot == "pbrMetallicRoughness/baseColorTexture") {
            material.base_color_texture = ref;
        } else if (slot == "emissiveTexture") {
            material.emissive_texture = ref;
        } else {
            const char* factor = member.contains("strength") ? "strength" : "scale";
            material.other_textures.push_back({slot, ref, float(number(member, factor, 1.0, where + "/" + slot))});
            context.count("textures other than base colour and emission are kept but take no part in the light");
        }
        taken.push_back(key);
    }
    for (const std::string& key : taken) {
        object.erase(key);
    }
}

void read_base(ReadContext& context, const Json& json, Material& material, const std::string& where) {
    const Json none = Json::object();
    const Json* found = find_object(json, "pbrMetallicRoughness", where);
    const Json& pbr = found != nullptr ? *found : none;
    material.base_color = Rgb(1.0F);
    if (const Json* color = find_array(pbr, "baseColorFactor", where)) {
        if (color->size() != 4) {
            refuse(where + "/baseColorFactor", "has " + std::to_string(color->size()) + " numbers, not 4");
        }
        double worst = 0.0;
        double instead = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (!(*color)[i].is_number()) {
                refuse(where + "/baseColorFactor", "holds something that is not a number");
            }
            const auto value = (*color)[i].get<double>();
            const double good = std::clamp(value, 0.0, 1.0);
            if (std::abs(good - value) > std::abs(instead - worst)) {
                worst = value;
                instead = good;
            }
            (i < 3 ? material.base_color[int(i)] : material.alpha) = float(good);
        }
        if (worst != instead) { // once, whatever the number of channels
            context.warn(where, fmt::format("a base colour of {} was set to {}", worst, instead),
                         "A surface cannot reflect more light than falls on it.");
        }
    }
    material.metallic = clamped(context, pbr, "metallicFactor", 1.0F, 0.0F, 1.0F, where);
    material.roughness = clamped(context, pbr, "roughnessFactor", 1.0F, 0.0F, 1.0F, where);
    material.double_sided = boolean(json, "doubleSided", false, where);
    const std::string alpha = text(json, "alphaMode", where);
    material.alpha_mode = alpha == "MASK"    ? Material::Alpha::Mask
                          : alpha == "BLEND" ? Material::Alpha::Blend
                                             : Material::Alpha::Opaque;
    if (!alpha.empty() && alpha != "OPAQUE" && material.alpha_mode == Material::Alpha::Opaque) {
        context.warn(where, "alphaMode \"" + alpha + "\" is unknown; the material is opaque");
    }
    material.alpha_cutoff = clamped(context, json, "alphaCutoff", 0.5F, 0.0F, 1e6F, where);
}

void read_emission(ReadContext& context, const Json& json, Material& material, const std::string& where) {
    material.emissive_color = number3(json, "emissiveFactor", Rgb(0.0F), where);
    if (const Json* strength = find_extension(json, kEmissiveStrength)) {
        material.emissive_strength = float(number(*strength, "emissiveStrength", 1.0, where));
        if (material.emissive_strength < 0.0F) {
            context.warn(where, fmt::format("an emissive strength of {} was set to 1", material.emissive_strength),
                         "Light cannot be negative.");
            material.emissive_strength = 1.0F;
        }
    }
    if (glm::min(material.emissive_color.r, glm::min(material.emissive_color.g, material.emissive_color.b)) < 0.0F) {
        context.warn(where, "a negative emissive colour was set to 0", "Light cannot be negative.");
        material.emissive_color = glm::max(material.emissive_color, Rgb(0.0F));
    }
    if (const float most = max_component(material.emissive_color); most > 1.0F) {
        context.warn(where, "an emissive colour above 1 was moved into the emissive strength; the light is the same");
        material.emissive_color /= most;
        material.emissive_strength *= most;
    }
    if (!(material.emissive_strength <= kMaxLight)) {
        context.warn(where,
                     fmt::format("an emissive strength of {} was set to {} cd/m2", material.emissive_strength, kMaxLight),
                     "The sun has 1.6e9 cd/m2.");
        material.emissive_strength = kMaxLight;
    }
}

void read_glass(ReadContext& context, const Json& json, Material& material, const std::string& where) {
    if (const Json* transmission = find_extension(json, kTransmission)) {
        material.transmission = clamped(context, *transmission, "transmissionFactor", 0.0F, 0.0F, 1.0F, where);
    }
    if (const Json* ior = find_extension(json, kIor)) {
        material.ior = float(number(*ior, "ior", 1.5, where));
        if (material.ior < 1.0F) {
            context.warn(where, fmt::format("an index of refraction of {} was set to 1.5", material.ior),
                         "It must be at least 1: glass 1.5, water 1.33.");
            material.ior = 1.5F;
        }
    }
    if (const Json* specular = find_extension(json, kSpecular)) {
        material.specular = clamped(context, *specular, "specularFactor", 1.0F, 0.0F, 1.0F, where);
        material.specular_color = glm::max(number3(*specular, "specularColorFactor", Rgb(1.0F), where), Rgb(0.0F));
    }
    if (const Json* volume = find_extension(json, kVolume)) {
        material.thickness = clamped(context, *volume, "thicknessFactor", 0.0F, 0.0F, 1e6F, where);
        material.attenuation_color =
            glm::clamp(number3(*volume, "attenuationColor", Rgb(1.0F), where), Rgb(0.0F), Rgb(1.0F));
        if (volume->contains("attenuationDistance")) {
            const auto distance = float(number(*volume, "attenuationDistance", 1.0, where));
            if (distance > 0.0F) {
                material.attenuation_distance = distance;
            } else {
                context.warn(where, "an attenuation distance that is not positive was ignored");
            }
        }
    }
    material.unlit = find_extension(json, kUnlit) != nullptr;
}

} // namespace

float clamped(ReadContext& context, const Json& object, const char* key, float fallback, float least, float most,
              const std::string& where) {
    const auto value = float(number(object, key, double(fallback), where));
    const float good = std::fmin(std::fmax(value, least), most);
    if (good != value) {
        context.warn(where, fmt::format("{} is {}, outside {} to {}; {} is used", key, value, least, most, good));
    }
    return good;
}

void read_materials(ReadContext& context) {
    const Json& materials = section(context.root, "materials");
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const std::string where = place(context.root, "materials", i);
        Json json = materials[i];
        Material material;
        material.name = text(json, "name", where);
        take_textures(context, json, "", material, where);
        read_base(context, json, material, where);
        read_emission(context, json, material, where);
        read_glass(context, json, material, where);
        material.extras = json_text(json, "extras");
        if (json.contains("extensions")) {
            for (const char* known : {kEmissiveStrength, kTransmission, kIor, kVolume, kSpecular, kUnlit}) {
                json["extensions"].erase(known);
            }
            if (!json["extensions"].empty()) {
                material.other_extensions = json_text(json, "extensions");
            }
        }
        context.materials.push_back(context.out.scene.materials.insert(std::move(material)));
    }
}

} // namespace atrium::gltf
