#include "engine/optics/specular.h"

#include "engine/base/rng.h"
#include "engine/optics/ggx.h"

#include <algorithm>

namespace atrium {
namespace {

using Ways = SpecularWays;

bool smooth(const Material& m) { return m.roughness < kMirrorRoughness; }

float ggx_alpha(const Material& m) {
    const float roughness = std::clamp(m.roughness, kMirrorRoughness, 1.0F);
    return roughness * roughness;
}

/// A lobe about a shading normal may reach behind the triangle. What does is folded back over the triangle's plane: no
/// light is lost on coarse meshes, and none leaks. Directions within the plane itself are absorbed.
void keep_to_side(SpecularSample& way, const vec3& geometric, float side) {
    const float height = glm::dot(way.direction, geometric);
    if (height * side < 0.0F) {
        way.direction -= 2.0F * height * geometric;
    }
    const float length = glm::length(way.direction);
    if (!(height != 0.0F) || !(length > 0.0F) || !is_finite(way.direction) || !is_finite(way.weight)) {
        way.weight = Rgb(0.0F);
        way.direction = side * geometric;
        return;
    }
    way.direction /= length;
}

/// Where the light meets a facet, in numbers.
struct Facet {
    vec3 n{0.0F}; ///< surface normal that faces the light
    vec3 h{0.0F}; ///< facet normal
    float cos_n = 0.0F;
    float cos_h = 0.0F;
    float alpha = 0.0F; ///< 0 = smooth
    [[nodiscard]] float reflected(const vec3& out) const {
        return alpha > 0.0F ? ggx_reflected(cos_n, glm::dot(out, n), alpha) : 1.0F;
    }
    [[nodiscard]] float transmitted(const vec3& out) const {
        return alpha > 0.0F ? ggx_transmitted(-glm::dot(out, n), alpha) : 1.0F;
    }
};

/// False where the light comes from behind, or from nowhere.
bool find_facet(const SpecularPoint& at, const vec3& in, const vec2& u, Facet& f) {
    const float cos_g = -glm::dot(in, at.geometric);
    if (!(cos_g > 0.0F) || !is_finite(in)) {
        return false;
    }
    f.n = at.normal;
    f.cos_n = -glm::dot(in, f.n);
    if (!(f.cos_n > 0.0F) || !is_finite(f.n)) {
        f.n = at.geometric; // bent away from the light by interpolation
        f.cos_n = cos_g;
    }
    f.h = f.n;
    f.cos_h = f.cos_n;
    if (!smooth(*at.material)) {
        f.alpha = ggx_alpha(*at.material);
        vec3 t;
        vec3 b;
        make_frame(f.n, t, b);
        const vec3 local = ggx_visible_normal({-glm::dot(in, t), -glm::dot(in, b), f.cos_n}, f.alpha, u);
        f.h = local.x * t + local.y * b + local.z * f.n;
        f.cos_h = std::max(-glm::dot(in, f.h), 0.0F);
    }
    return true;
}

Ways metal(const SpecularPoint& at, const vec3& in, const Facet& f, const Rgb& color) {
    Ways out;
    out.reflected.direction = glm::reflect(in, f.h);
    const float away = 1.0F - std::min(f.cos_h, 1.0F);
    const float grazing = away * away * away * away * away;
    const Rgb fresnel = color + (Rgb(1.0F) - color) * grazing;
    out.reflected.weight = fresnel * (f.reflected(out.reflected.direction) * std::min(at.material->metallic, 1.0F));
    return out;
}

Ways sheet(const SpecularPoint& at, const vec3& in, const Facet& f, const Rgb& color) {
    Ways out;
    const float face = fresnel_dielectric(f.cos_h, std::max(at.material->ior, 1.0F));
    const float both = 2.0F * face / (1.0F + face); // with all reflections within the sheet
    out.reflected.direction = glm::reflect(in, f.h);
    const float seen = f.reflected(out.reflected.direction);
    out.reflected.weight = Rgb(both * seen);
    if (f.alpha > 0.0F) {
        out.transmitted.direction = out.reflected.direction - 2.0F * glm::dot(out.reflected.direction, f.n) * f.n;
        out.transmitted.weight = color * ((1.0F - both) * seen * at.material->transmitted_share());
    }
    return out;
}

Ways solid(const SpecularPoint& at, const vec3& in, const Facet& f, const Rgb& color) {
    Ways out;
    const float ior = std::max(at.material->ior, 1.0F);
    const float eta = at.front || at.slab ? ior : 1.0F / ior; // within a slab rays are not bent: the angle is that outside
    const float face = fresnel_dielectric(f.cos_h, eta);
    out.reflected.direction = glm::reflect(in, f.h);
    out.reflected.weight = Rgb(face * f.reflected(out.reflected.direction));
    const float sin2_t = (1.0F - f.cos_h * f.cos_h) / (eta * eta);
    if (face < 1.0F && sin2_t < 1.0F && !at.slab) {
        const float cos_t = std::sqrt(std::max(1.0F - sin2_t, 0.0F));
        out.transmitted.direction = in / eta + (f.cos_h / eta - cos_t) * f.h;
        out.transmitted.weight =
            color * ((1.0F - face) * f.transmitted(out.transmitted.direction) * at.material->transmitted_share());
        out.transmitted.spread = f.alpha > 0.0F ? std::abs(1.0F - 1.0F / eta) * ggx_rms_tilt(f.alpha) : 0.0F;
    }
    return out;
}

Ways ways_on(const SpecularPoint& at, const vec3& in, const vec2& u) {
    Ways out;
    Facet f;
    if (at.material == nullptr || !is_specular(*at.material) || !find_facet(at, in, u, f)) {
        return out;
    }
    const Rgb color = glm::clamp(at.base_color, Rgb(0.0F), Rgb(1.0F));
    const float spread = f.alpha > 0.0F ? 2.0F * ggx_rms_tilt(f.alpha) : 0.0F;
    switch (classify(*at.material)) {
    case MaterialKind::Mirror:
    case MaterialKind::Glossy: out = metal(at, in, f, color); break;
    case MaterialKind::DielectricThin:
        out = sheet(at, in, f, color);
        out.transmitted.spread = spread;
        break;
    case MaterialKind::DielectricSolid: out = solid(at, in, f, color); break;
    case MaterialKind::Diffuse: return out;
    }
    out.reflected.spread = spread;
    out.transmitted.transmitted = true;
    keep_to_side(out.reflected, at.geometric, 1.0F);
    keep_to_side(out.transmitted, at.geometric, -1.0F);
    return out;
}

} // namespace

SpecularWays specular_ways(const SpecularPoint& at, const vec3& in, const vec2& u) { return ways_on(at, in, u); }

bool is_specular(const Material& m) {
    switch (classify(m)) {
    case MaterialKind::Mirror:
    case MaterialKind::DielectricThin:
    case MaterialKind::DielectricSolid: return true;
    case MaterialKind::Glossy: return m.roughness < kDullMetal;
    case MaterialKind::Diffuse: return false;
    }
    return false;
}

bool shows_no_irradiance(const Material& m) {
    constexpr float kShownAsMatt = 0.35F; // metals of this roughness and above are drawn with some of their irradiance
    return is_specular(m) && !(max_component(diffuse_reflectance(m)) > 0.0F) &&
           (m.metallic < 0.5F || m.roughness < kShownAsMatt);
}

bool is_clear_sheet(const Material& m) { return classify(m) == MaterialKind::DielectricThin && smooth(m); }

SpecularSample sample_specular(const SpecularPoint& at, const vec3& in, const vec3& u) {
    Ways ways = ways_on(at, in, {u.x, u.y});
    const float back = max_component(ways.reflected.weight);
    const float through = max_component(ways.transmitted.weight);
    if (!(through > 0.0F)) {
        return ways.reflected;
    }
    const float chance = back / (back + through);
    if (u.z < chance) {
        ways.reflected.weight /= chance;
        return ways.reflected;
    }
    ways.transmitted.weight /= 1.0F - chance;
    return ways.transmitted;
}

float specular_albedo(const SpecularPoint& at, const vec3& in) {
    const unsigned samples = at.material != nullptr && smooth(*at.material) ? 1 : 64;
    float sum = 0.0F;
    for (unsigned i = 0; i < samples; ++i) {
        const Ways ways = ways_on(at, in, sobol_owen2(i, 0, 0x5EC1U));
        sum += luminance(ways.reflected.weight + ways.transmitted.weight);
    }
    return sum / float(samples);
}

} // namespace atrium
