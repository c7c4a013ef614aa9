#include "engine/optics/specular.h"

#include <algorithm>

namespace atrium {
namespace {

bool is_metal(const Material& m) { return m.metallic >= 0.5F; }
bool smooth(const Material& m) { return m.roughness < kMirrorRoughness; }
float alpha_of(const Material& m) { return std::max(m.roughness * m.roughness, 1e-4F); }

// Schlick 1994 from F0 at right angles to white at grazing incidence: what glTF asks of metals.
Rgb schlick(const Rgb& f0, float cosine) {
    const float k = std::clamp(1.0F - cosine, 0.0F, 1.0F);
    const float k2 = k * k;
    return f0 + (Rgb(1.0F) - f0) * (k2 * k2 * k);
}

struct Frame {
    vec3 t{0.0F}, b{0.0F}, n{0.0F};
    explicit Frame(const vec3& normal) : n(normal) { make_frame(normal, t, b); }
    [[nodiscard]] vec3 in(const vec3& v) const { return {glm::dot(v, t), glm::dot(v, b), glm::dot(v, n)}; }
    [[nodiscard]] vec3 out(const vec3& v) const { return t * v.x + b * v.y + n * v.z; }
};

// Smith's Lambda of GGX, isotropic.
float lambda(const vec3& w, float alpha) {
    const float z2 = w.z * w.z;
    const float tan2 = z2 > 0.0F ? std::max(1.0F - z2, 0.0F) / z2 : 1e12F;
    return 0.5F * (std::sqrt(1.0F + alpha * alpha * tan2) - 1.0F);
}

// G2 / G1 of the height-correlated Smith term: weight of a direction that was drawn by visible normals.
float masking(const vec3& view, const vec3& light, float alpha) {
    const float v = lambda(view, alpha);
    return (1.0F + v) / (1.0F + v + lambda(light, alpha));
}

// A normal that `view` sees, by its visible projected area (Heitz 2018).
vec3 visible_normal(const vec3& view, float alpha, const vec2& u) {
    const vec3 vh = glm::normalize(vec3(alpha * view.x, alpha * view.y, view.z));
    const float length2 = vh.x * vh.x + vh.y * vh.y;
    const vec3 t1 = length2 > 0.0F ? vec3(-vh.y, vh.x, 0.0F) / std::sqrt(length2) : vec3(1.0F, 0.0F, 0.0F);
    const vec3 t2 = glm::cross(vh, t1);
    const float r = std::sqrt(u.x);
    const float phi = 2.0F * kPi * u.y;
    const float p1 = r * std::cos(phi);
    const float s = 0.5F * (1.0F + vh.z);
    const float p2 = (1.0F - s) * std::sqrt(std::max(1.0F - p1 * p1, 0.0F)) + s * r * std::sin(phi);
    const vec3 h = p1 * t1 + p2 * t2 + std::sqrt(std::max(1.0F - p1 * p1 - p2 * p2, 0.0F)) * vh;
    return glm::normalize(vec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-6F)));
}

// RMS half angle of the lobe about the mirror direction: that of the facets (tan = alpha sqrt(u / (1 - u)), half of them
// within atan(alpha)) twice over; refracted light turns by (1 - eta) of it.
float lobe_spread(float alpha) { return std::min(2.0F * std::atan(0.8F * alpha), 1.0F); }

bool refract(const vec3& in, const vec3& n, float eta, vec3& out) {
    const float c = -glm::dot(in, n);
    const float s2 = eta * eta * std::max(1.0F - c * c, 0.0F);
    if (s2 >= 1.0F) {
        return false;
    }
    out = glm::normalize(eta * in + (eta * c - std::sqrt(1.0F - s2)) * n);
    return true;
}

// Both faces of a sheet and all that goes to and fro in it.
float sheet_reflectance(float f) { return 2.0F * f / (1.0F + f); }

} // namespace

float fresnel_dielectric(float cos_i, float eta) {
    const float c = std::clamp(cos_i, 0.0F, 1.0F);
    const float sin2_t = (1.0F - c * c) / (eta * eta);
    if (sin2_t >= 1.0F) {
        return 1.0F;
    }
    const float cos_t = std::sqrt(1.0F - sin2_t);
    const float s = c + eta * cos_t;
    const float p = eta * c + cos_t;
    if (!(s > 0.0F) || !(p > 0.0F)) {
        return 1.0F;
    }
    const float rs = (c - eta * cos_t) / s;
    const float rp = (eta * c - cos_t) / p;
    return 0.5F * (rs * rs + rp * rp);
}

Rgb absorption(const Material& m, float path) {
    if (!(m.attenuation_distance < std::numeric_limits<float>::infinity()) || !(path > 0.0F)) {
        return Rgb(1.0F);
    }
    Rgb out(1.0F);
    for (int k = 0; k < 3; ++k) {
        const float c = std::clamp(m.attenuation_color[k], 0.0F, 1.0F);
        out[k] = c <= 0.0F ? 0.0F : std::exp(std::log(c) * path / std::max(m.attenuation_distance, 1e-9F));
    }
    return out;
}

bool is_specular(const Material& m) { return is_metal(m) ? m.roughness < kDullMetal : m.transmission > 0.0F; }

bool shows_no_irradiance(const Material& m) {
    constexpr float kShownAsMatt = 0.35F; // metals of this roughness and above are drawn with some of their irradiance
    return is_specular(m) && !(max_component(diffuse_reflectance(m)) > 0.0F) && (!is_metal(m) || m.roughness < kShownAsMatt);
}

bool is_clear_sheet(const Material& m) { return !is_metal(m) && m.transmission > 0.0F && m.thickness <= 0.0F && smooth(m); }

SpecularSample sample_specular(const SpecularPoint& at, const vec3& in, const vec3& u) {
    SpecularSample out;
    const Material& m = *at.material;
    vec3 n = at.normal;
    float cosine = -glm::dot(in, n);
    if (!(cosine > 0.0F)) {
        n = at.geometric;
        cosine = -glm::dot(in, n);
        if (!(cosine > 0.0F)) {
            return out;
        }
    }
    // The facet that light meets: the surface itself where it is smooth.
    const float alpha = smooth(m) ? 0.0F : alpha_of(m);
    const Frame frame(n);
    const vec3 view = frame.in(-in);
    vec3 h = n;
    if (alpha > 0.0F) {
        h = frame.out(visible_normal(view, alpha, {u.x, u.y}));
        out.spread = lobe_spread(alpha);
    }
    const float c = std::clamp(-glm::dot(in, h), 0.0F, 1.0F);
    const auto shadowing = [&](const vec3& way) {
        if (!(alpha > 0.0F)) {
            return 1.0F;
        }
        vec3 w = frame.in(way);
        w.z = std::abs(w.z);
        return masking(view, w, alpha);
    };
    const auto reflect = [&](const Rgb& share, float chance) {
        vec3 d = in + 2.0F * c * h;
        if (!(glm::dot(d, at.geometric) > 0.0F)) {
            if (alpha > 0.0F && !(glm::dot(d, n) > 0.0F)) {
                return; // below the horizon: what single scattering loses
            }
            d = in - 2.0F * glm::dot(in, at.geometric) * at.geometric; // bent normals must not send light inside
        }
        if (alpha > 0.0F && !(glm::dot(d, n) > 0.0F)) {
            return;
        }
        out.direction = glm::normalize(d);
        out.weight = share * (shadowing(out.direction) / chance);
    };
    if (is_metal(m)) {
        reflect(schlick(at.base_color, c) * m.metallic, 1.0F);
        return out;
    }
    if (m.thickness <= 0.0F) {
        const float r = sheet_reflectance(fresnel_dielectric(c, std::max(m.ior, 1.0F)));
        if (!(alpha > 0.0F)) {
            reflect(Rgb(r), 1.0F);
            return out;
        }
        const Rgb through = at.base_color * ((1.0F - r) * m.transmission);
        const float chance = r / std::max(r + luminance(through), 1e-6F);
        if (u.z < chance) {
            reflect(Rgb(r), chance);
            return out;
        }
        vec3 d = in + 2.0F * c * h; // frosted: the lobe of a reflection, on the other side
        if (!(glm::dot(d, n) > 0.0F) || !(chance < 1.0F)) {
            return out;
        }
        d -= 2.0F * glm::dot(d, n) * n;
        if (!(glm::dot(d, at.geometric) < 0.0F)) {
            return out;
        }
        out.direction = glm::normalize(d);
        out.weight = through * (shadowing(out.direction) / (1.0F - chance));
        out.transmitted = true;
        return out;
    }
    const float ior = std::max(m.ior, 1.0F);
    const float eta = at.front ? 1.0F / ior : ior; // of the side that light comes from over the other
    const float f = fresnel_dielectric(c, 1.0F / eta);
    const Rgb through = at.base_color * ((1.0F - f) * m.transmission);
    const float chance = f / std::max(f + luminance(through), 1e-6F);
    if (u.z < chance) {
        reflect(Rgb(f), chance);
        return out;
    }
    vec3 d;
    if (!refract(in, h, eta, d) || !(glm::dot(d, at.geometric) < 0.0F)) {
        return out;
    }
    out.direction = d;
    out.weight = through * (shadowing(d) / (1.0F - chance));
    out.transmitted = true;
    out.spread *= 0.5F * std::abs(1.0F - eta);
    return out;
}

float specular_albedo(const SpecularPoint& at, const vec3& in) {
    const Material& m = *at.material;
    const float cosine = std::clamp(-glm::dot(in, at.normal), 0.0F, 1.0F);
    float albedo = 0.0F;
    if (is_metal(m)) {
        albedo = luminance(schlick(at.base_color, cosine)) * m.metallic;
    } else {
        const float ior = std::max(m.ior, 1.0F);
        const bool solid = m.thickness > 0.0F;
        const float f = fresnel_dielectric(cosine, solid && !at.front ? 1.0F / ior : ior);
        const float r = solid ? f : sheet_reflectance(f);
        albedo = r;
        if (solid || !smooth(m)) {
            albedo += (1.0F - r) * m.transmission * luminance(at.base_color);
        }
    }
    if (!smooth(m)) { // the mean over the lobe, by a few of its directions
        constexpr int kSide = 4;
        float sum = 0.0F;
        for (int i = 0; i < kSide * kSide; ++i) {
            const vec3 u((float(i % kSide) + 0.5F) / kSide, (float(i / kSide) + 0.5F) / kSide,
                         std::fmod(0.5F + 0.618034F * float(i), 1.0F));
            sum += luminance(sample_specular(at, in, u).weight);
        }
        albedo = sum / float(kSide * kSide);
    }
    return std::clamp(albedo, 0.0F, 1.0F);
}

} // namespace atrium
