#include "engine/scene/material.h"

#include <algorithm>

namespace atrium {

bool operator==(const Texture& a, const Texture& b) {
    const auto same = [](const auto& x, const auto& y) { return x == y || (x && y && *x == *y); };
    return a.name == b.name && a.mime_type == b.mime_type && a.wrap_u == b.wrap_u && a.wrap_v == b.wrap_v &&
           a.nearest == b.nearest && a.uri == b.uri && same(a.encoded, b.encoded) && same(a.image, b.image);
}

vec2 TextureRef::apply(const vec2& uv) const {
    const vec2 s = uv * scale;
    const float c = std::cos(rotation);
    const float n = std::sin(rotation);
    return {c * s.x + n * s.y + offset.x, -n * s.x + c * s.y + offset.y};
}

MaterialKind classify(const Material& m) {
    if (m.metallic >= 0.5F) {
        return m.roughness < kMirrorRoughness ? MaterialKind::Mirror : MaterialKind::Glossy;
    }
    if (m.transmission >= 0.5F) {
        return m.thickness > 0.0F ? MaterialKind::DielectricSolid : MaterialKind::DielectricThin;
    }
    return MaterialKind::Diffuse;
}

const char* material_kind_name(MaterialKind kind) {
    switch (kind) {
    case MaterialKind::Diffuse: return "diffuse";
    case MaterialKind::Mirror: return "mirror";
    case MaterialKind::Glossy: return "glossy";
    case MaterialKind::DielectricThin: return "thin glass";
    case MaterialKind::DielectricSolid: return "solid glass";
    }
    return "unknown";
}

float Material::transmitted_share() const {
    return std::clamp(transmission, 0.0F, 1.0F) * (1.0F - std::clamp(metallic, 0.0F, 1.0F));
}

Rgb diffuse_reflectance(const Material& m) {
    const bool shiny = m.metallic >= 0.5F && m.roughness < kDullMetal;
    const Rgb rho = m.base_color * ((shiny ? 0.0F : m.metallic) + (1.0F - m.metallic) * (1.0F - m.transmission));
    return glm::clamp(rho, Rgb(0.0F), Rgb(kMaxReflectance));
}

} // namespace atrium
