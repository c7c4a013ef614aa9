#include "engine/view/eye_tracer.h"

#include "engine/base/rng.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr float kLeastThroughput = 0.004F; // branches that add less than this to a pixel are not followed
constexpr int kMostPassages = 64;          // surfaces that one ray goes straight through
constexpr int kLobeRays = 8;               // of a rough surface that the eye sees; one where it is seen over another

} // namespace

void EyeLight::meet(const EyeSurface& surface, float distance, const Rgb& albedo_there) {
    if (depth <= 0.0F) {
        depth = distance;
        normal = surface.normal;
        albedo = albedo_there;
    }
}

EyeLight EyeTracer::look(const Ray& first, std::uint32_t seed) const {
    EyeLight out;
    Rgb weight(1.0F);
    Ray ray = first;
    for (int pass = 0; pass < kMostPassages && max_component(weight) >= kLeastThroughput; ++pass) {
        const Hit hit = rays_.nearest(ray);
        if (!hit) {
            out.direct += shares_.direct ? weight * sky_ : Rgb(0.0F);
            break;
        }
        const EyeSurface at = eye_surface(rays_, hit, ray.direction);
        ray.origin = off_surface(at.position, -at.geometric);
        if (at.culled()) {
            continue; // as in the viewport: one looks into a room through the back of its walls
        }
        if (max_component(at.through) < 0.5F) {
            Rgb albedo = at.diffuse;
            if (at.mirrors) {
                const SpecularWays ways = at.ways(vec2(0.5F));
                albedo += ways.reflected.weight + ways.transmitted.weight;
            }
            out.meet(at, glm::length(at.position - first.origin), albedo);
        }
        if (shares_.direct) {
            out.direct += weight * at.emitted;
        }
        if (max_component(at.diffuse) > 0.0F) {
            const Rgb scattered = weight * at.diffuse * kInvPi;
            const auto share = [&](bool wanted, LightShares only) {
                return wanted ? scattered * lit_.irradiance(hit, only) : Rgb(0.0F);
            };
            out.direct += share(shares_.direct, {false, true, false});
            out.diffuse += share(shares_.diffuse, {true, false, false});
            out.caustic += share(shares_.caustic, {false, false, true});
        }
        if (at.mirrors) {
            out.rough = !out.over ? at.material->roughness >= kMirrorRoughness : out.rough;
            out.over = true;
            out.specular += weight * over(at, 0, max_component(weight), seed);
        }
        weight *= at.through;
    }
    return out;
}

Rgb EyeTracer::beyond(const Ray& first, int depth, float throughput, std::uint32_t seed) const {
    Rgb sum(0.0F);
    Rgb weight(1.0F);
    Ray ray = first;
    for (int pass = 0; pass < kMostPassages && max_component(weight) * throughput >= kLeastThroughput; ++pass) {
        const Hit hit = rays_.nearest(ray);
        if (!hit) {
            return sum + weight * sky_;
        }
        const EyeSurface at = eye_surface(rays_, hit, ray.direction);
        sum += weight * at.emitted;
        if (max_component(at.diffuse) > 0.0F) {
            sum += weight * at.diffuse * kInvPi * lit_.irradiance(hit);
        }
        if (at.mirrors) {
            sum += weight * over(at, depth, throughput * max_component(weight), seed);
        }
        weight *= at.through;
        ray.origin = at.behind();
    }
    return sum;
}

Rgb EyeTracer::over(const EyeSurface& at, int depth, float throughput, std::uint32_t seed) const {
    const bool rough = at.material->roughness >= kMirrorRoughness;
    const int count = rough && depth == 0 ? kLobeRays : 1;
    Rgb sum(0.0F);
    for (int i = 0; i < count; ++i) {
        const SpecularWays ways = at.ways(rough ? sobol_owen2(std::uint32_t(i), 0, seed) : vec2(0.5F));
        const std::uint32_t next = std::uint32_t(hash64((std::uint64_t(seed) << 8) + std::uint64_t(i)));
        sum +=
            on_way(at, ways.reflected, depth, throughput, next) + on_way(at, ways.transmitted, depth, throughput, next + 1);
    }
    return sum / float(count);
}

Rgb EyeTracer::on_way(const EyeSurface& at, const SpecularSample& way, int depth, float throughput,
                      std::uint32_t seed) const {
    const float left = throughput * max_component(way.weight);
    if (depth >= max_depth_ || !(left >= kLeastThroughput)) {
        return Rgb(0.0F);
    }
    return way.weight * beyond({at.start_of(way), way.direction}, depth + 1, left, seed);
}

EyeTracer::Met EyeTracer::meet(Ray ray) const {
    for (int pass = 0; pass < kMostPassages; ++pass) {
        const Hit hit = rays_.nearest(ray);
        if (!hit) {
            return {};
        }
        const Material& m = rays_.material(hit.surface);
        const MaterialKind kind = classify(m);
        const bool glass = kind == MaterialKind::DielectricThin || kind == MaterialKind::DielectricSolid;
        const bool faint =
            m.alpha_mode == Material::Alpha::Blend && rays_.base_color(hit.surface, hit.triangle, hit.barycentric).a < 0.5F;
        if (!glass && !faint && (hit.front || m.double_sided)) {
            return {hit, kind == MaterialKind::Diffuse && !m.unlit, !m.base_color_texture && !m.emissive_texture,
                    std::abs(glm::dot(eye_surface(rays_, hit, ray.direction).normal, ray.direction))};
        }
        ray.origin += ray.direction * (hit.t + 2e-5F + 1e-6F * hit.t);
    }
    return {};
}

} // namespace atrium
