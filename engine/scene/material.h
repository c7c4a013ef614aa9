// Materials in glTF's metallic-roughness terms, textures and their images.
#pragma once

#include "engine/base/ids.h"
#include "engine/base/units.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace atrium {

/// Decoded pixels, rows from the top as in glTF's texture space (v = 0 is the first row).
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;                ///< 1 to 4
    std::vector<std::uint8_t> bytes; ///< 8-bit samples; colour images are sRGB encoded
    std::vector<float> floats;       ///< linear samples of HDR and EXR files; either this or bytes is filled
    friend bool operator==(const Image&, const Image&) = default;
};

/// A glTF texture with its image; the encoded file is kept so that saving loses nothing.
struct Texture {
    enum class Wrap : std::uint8_t { Repeat, MirroredRepeat, ClampToEdge };
    std::string name;
    std::string mime_type;                                    ///< "image/png", "image/jpeg", ...
    std::shared_ptr<const std::vector<std::uint8_t>> encoded; ///< file bytes; may be null for generated images
    std::shared_ptr<const Image> image;                       ///< null when it could not be decoded
    Wrap wrap_u = Wrap::Repeat;
    Wrap wrap_v = Wrap::Repeat;
    bool nearest = false; ///< magnification filter NEAREST
    std::string uri;      ///< where it came from relative to the scene file; empty = embedded
    friend bool operator==(const Texture& a, const Texture& b);
};
using TextureId = Id<Texture>;

/// Use of a texture by a material, with KHR_texture_transform.
struct TextureRef {
    TextureId texture;
    int texcoord = 0; ///< 0 or 1
    vec2 offset{0.0F};
    vec2 scale{1.0F};
    float rotation = 0.0F; ///< radians, counter-clockwise as in KHR_texture_transform

    explicit operator bool() const { return bool(texture); }
    /// Coordinates after the transform: translate * rotate * scale.
    [[nodiscard]] vec2 apply(const vec2& uv) const;
    friend bool operator==(const TextureRef&, const TextureRef&) = default;
};

/// What a surface does with light.
struct Material {
    enum class Alpha : std::uint8_t { Opaque, Mask, Blend };

    std::string name;
    Rgb base_color{0.8F}; ///< linear; diffuse reflectance rho of a non-metal, F0 of a metal, tint of glass
    float alpha = 1.0F;
    float metallic = 0.0F;     ///< 0 dielectric, 1 metal
    float roughness = 0.6F;    ///< GGX alpha = roughness^2; with metallic 1 and roughness below kMirrorRoughness a mirror
    float transmission = 0.0F; ///< share of the non-reflected light that goes through
    float ior = 1.5F;
    float specular = 1.0F;       ///< KHR_materials_specular factor
    Rgb specular_color{1.0F};    ///< KHR_materials_specular colour factor
    float thickness = 0.0F;      ///< 0 = thin wall, > 0 = the mesh bounds a solid (KHR_materials_volume)
    Rgb attenuation_color{1.0F}; ///< transmitted colour after attenuation_distance
    float attenuation_distance = std::numeric_limits<float>::infinity(); ///< metres
    Rgb emissive_color{0.0F};
    float emissive_strength = 1.0F; ///< emissive_color * emissive_strength is the emitted radiance in cd/m2
    bool double_sided = false;
    bool unlit = false;
    Alpha alpha_mode = Alpha::Opaque;
    float alpha_cutoff = 0.5F;
    TextureRef base_color_texture;
    TextureRef emissive_texture;

    /// Textures of slots that the light simulation does not read ("normalTexture", "occlusionTexture", ...): kept for
    /// saving.
    struct OtherTexture {
        std::string slot; ///< JSON path inside the material, as "pbrMetallicRoughness/metallicRoughnessTexture"
        TextureRef ref;
        float scale = 1.0F; ///< normalTexture.scale or occlusionTexture.strength
        friend bool operator==(const OtherTexture&, const OtherTexture&) = default;
    };
    std::vector<OtherTexture> other_textures;
    std::string extras;           ///< JSON text, kept through a round trip
    std::string other_extensions; ///< JSON text of extensions that we do not interpret (without texture references)

    [[nodiscard]] Rgb emitted_radiance() const { return emissive_color * emissive_strength; }
    [[nodiscard]] bool emits() const { return max_component(emitted_radiance()) > 0.0F; }
    /// Share of the non-reflected light that goes through, metallic part taken off; in [0, 1].
    [[nodiscard]] float transmitted_share() const;
    friend bool operator==(const Material&, const Material&) = default;
};
using MaterialId = Id<Material>;

/// Below this roughness a metal is treated as a perfect mirror and glass as clear.
inline constexpr float kMirrorRoughness = 0.04F;
/// From this roughness on a metal scatters so widely that it counts as a diffuse reflector.
inline constexpr float kDullMetal = 0.5F;

/// Which transport a material needs.
enum class MaterialKind : std::uint8_t { Diffuse, Mirror, Glossy, DielectricThin, DielectricSolid };
MaterialKind classify(const Material& material);
const char* material_kind_name(MaterialKind kind);

/// Reflectance for diffuse transport of the untextured material, each channel in [0, kMaxReflectance]: base colour of a
/// non-metal, less what it transmits. A metal of roughness kDullMetal and above counts with its specular reflectance; what
/// shinier metals reflect is engine/optics' business.
Rgb diffuse_reflectance(const Material& material);

/// Reflectance is clamped here, with a problem in the list: at 1 a closed room has no steady state.
inline constexpr float kMaxReflectance = 0.9999F;

} // namespace atrium
