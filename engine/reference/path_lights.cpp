#include "engine/reference/path_lights.h"

#include <algorithm>

namespace atrium {
namespace {

/// Mean luminance of a triangle's emission over an even grid: how often it is picked, not how bright it is taken.
double mean_emission(const RayScene& rays, std::uint32_t surface, std::uint32_t triangle) {
    const Material& m = rays.material(surface);
    if (!m.emissive_texture) {
        return luminance(m.emitted_radiance());
    }
    constexpr int kSide = 8;
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < kSide; ++i) {
        for (int j = 0; i + j < kSide; ++j) {
            const vec2 b((float(i) + 1.0F / 3.0F) / float(kSide), (float(j) + 1.0F / 3.0F) / float(kSide));
            sum += luminance(rays.emission(surface, triangle, b));
            ++count;
        }
    }
    // The grid may miss a bright spot of the texture: no triangle that can emit is left out.
    return std::max(sum / count, 0.01 * luminance(m.emitted_radiance()));
}

} // namespace

PathLights::PathLights(const Scene& scene, const RayScene& rays) : rays_(rays), sky_(scene.environment.sky_radiance) {
    for (const NodeId id : scene.in_tree_order()) {
        const Node& node = *scene.nodes.find(id);
        const Light* light = scene.lights.find(node.light);
        if (light == nullptr || !light->enabled || !scene.shown(id) || !(light->intensity > 0.0F)) {
            continue;
        }
        const dmat4 world = scene.world_matrix(id);
        const dvec3 z(world[2]);
        const vec3 axis = glm::length(z) > 0.0 ? vec3(-glm::normalize(z)) : vec3(0.0F, 0.0F, -1.0F);
        if (light->kind == Light::Kind::Directional) {
            const double radius = radians_from_degrees(0.5 * light->angular_diameter_degrees);
            const double half = std::sin(0.5 * radius);
            suns_.push_back({light->color * light->intensity, -axis, float(2.0 * half * half)});
        } else {
            Lamp lamp{*light, vec3(dvec3(world[3]) - rays.origin()), axis, dmat3(1.0)};
            if (light->photometry) {
                // Scale has no part in it: own axes are -z as it shines and x as far as it is across.
                const dvec3 back = -dvec3(axis);
                const dvec3 up = glm::cross(back, dvec3(world[0]));
                lamp.from_world[1] = glm::length(up) > 0.0 ? glm::normalize(up) : dvec3(0.0, 1.0, 0.0);
                lamp.from_world[2] = back;
                lamp.from_world[0] = glm::cross(lamp.from_world[1], back);
                lamp.from_world = glm::transpose(lamp.from_world);
                const double tilt = std::acos(std::clamp(back.y, -1.0, 1.0));
                lamp.light.intensity *= light->photometry->tilt_factor(degrees_from_radians(tilt));
            }
            lamps_.push_back(std::move(lamp));
        }
    }
    add_emitters();
}

void PathLights::add_emitters() {
    density_.resize(rays_.surfaces().size());
    small_.resize(rays_.surfaces().size(), false);
    const double largest = std::pow(0.1 * double(rays_.bounds().diagonal()), 2.0);
    double total = 0.0;
    for (std::uint32_t s = 0; s < rays_.surfaces().size(); ++s) {
        if (!rays_.material(s).emits()) {
            continue;
        }
        const auto count = std::uint32_t(rays_.surfaces()[s].triangles.size());
        density_[s].resize(count, 0.0F);
        double whole = 0.0;
        for (std::uint32_t t = 0; t < count; ++t) {
            const auto p = rays_.triangle(s, t);
            const double area = 0.5 * double(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
            const double mean = mean_emission(rays_, s, t);
            total += area * mean;
            whole += area;
            density_[s][t] = float(mean); // divided by the total below
            emitters_.push_back({s, t});
            cumulative_.push_back(total);
        }
        small_[s] = whole < largest;
    }
    for (auto& surface : density_) {
        for (float& d : surface) {
            d = float(double(d) / total);
        }
    }
}

PathLights::EmitterPoint PathLights::sample_emitter(float pick, const vec2& u) const {
    const double at = double(pick) * cumulative_.back();
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), at);
    const auto index = std::min(std::size_t(found - cumulative_.begin()), emitters_.size() - 1);
    const Emitter& e = emitters_[index];
    EmitterPoint out;
    out.surface = e.surface;
    out.triangle = e.triangle;
    const float root = std::sqrt(u.x);
    out.barycentric = {root * (1.0F - u.y), root * u.y};
    const auto p = rays_.triangle(e.surface, e.triangle);
    out.position = p[0] + (p[1] - p[0]) * out.barycentric.x + (p[2] - p[0]) * out.barycentric.y;
    out.normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    out.area_probability = density_[e.surface][e.triangle];
    return out;
}

Rgb PathLights::Lamp::irradiance(const vec3& x, const vec3& n) const {
    const vec3 d = position - x;
    const float distance2 = glm::dot(d, d);
    const float distance = std::sqrt(distance2);
    const float cosine = distance > 0.0F ? glm::dot(n, d) / distance : 0.0F;
    if (cosine <= 0.0F) {
        return Rgb(0.0F);
    }
    return light.color * (candela(-d / distance) * cosine / distance2);
}

float PathLights::Lamp::candela(const vec3& away) const {
    if (light.photometry) {
        const PhotometricWeb& web = *light.photometry.web;
        return float(read_candela(web.data(), from_world * dvec3(away)) / double(web.peak()) * double(light.intensity));
    }
    return light.kind == Light::Kind::Spot ? light.intensity * spot_falloff(light, glm::dot(away, axis)) : light.intensity;
}

vec3 PathLights::Sun::sample(const vec2& u) const {
    if (one_minus_cos_radius <= 0.0F) {
        return towards;
    }
    const float down = u.x * one_minus_cos_radius; // 1 - cosine, exact where cosines are all close to 1
    const float sine = std::sqrt(down * (2.0F - down));
    const float angle = 2.0F * kPi * u.y;
    vec3 t;
    vec3 b;
    make_frame(towards, t, b);
    return glm::normalize((sine * std::cos(angle)) * t + (sine * std::sin(angle)) * b + (1.0F - down) * towards);
}

} // namespace atrium
