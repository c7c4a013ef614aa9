#include "engine/view/still.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/view/lit_scene.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr float kLeastThroughput = 0.004F; // branches that add less than this to a pixel are not followed

struct Dielectric {
    float reflectance = 1.0F;
    vec3 refracted{0.0F};
};

Dielectric dielectric(const vec3& d, const vec3& n, float eta) { // eta = n_incident / n_transmitted, n against d
    Dielectric out;
    const float cos_i = -glm::dot(d, n);
    const float sin2_t = eta * eta * std::max(1.0F - cos_i * cos_i, 0.0F);
    if (sin2_t >= 1.0F) {
        return out; // total internal reflection
    }
    const float cos_t = std::sqrt(1.0F - sin2_t);
    const float rs = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const float rp = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    out.reflectance = 0.5F * (rs * rs + rp * rp);
    out.refracted = glm::normalize(eta * d + (eta * cos_i - cos_t) * n);
    return out;
}

/// Follows eye rays over mirrors, metals and glass to surfaces whose light is known.
class EyeTracer {
public:
    EyeTracer(const LitScene& lit, const Rgb& sky, const StillOptions& options)
        : lit_(lit), rays_(lit.rays()), sky_(sky), max_depth_(options.max_specular_depth), shares_(options.shares) {}

    [[nodiscard]] Rgb radiance(Ray ray, int depth, float throughput, std::uint32_t seed) const {
        Rgb sum(0.0F);
        Rgb weight(1.0F);
        const LightShares shares = depth == 0 ? shares_ : LightShares{};
        // Straight passages (culled back sides, blended surfaces, thin glass) go on in this loop; bounces recurse.
        for (int pass = 0; pass < 64; ++pass) {
            const Hit hit = rays_.nearest(ray);
            if (!hit) {
                return shares.direct ? sum + weight * sky_ : sum;
            }
            const Material& m = rays_.material(hit.surface);
            const MaterialKind kind = classify(m);
            const vec3 position = ray.origin + ray.direction * hit.t;
            const auto go_on = [&] { ray.origin = position + ray.direction * (2e-5F + 1e-6F * hit.t); };
            if (depth == 0 && !hit.front && !m.double_sided && kind != MaterialKind::DielectricSolid) {
                go_on(); // as in the viewport: one looks into a room through the back of its walls
                continue;
            }
            const vec4 color = rays_.base_color(hit.surface, hit.triangle, hit.barycentric);
            const float cover = m.alpha_mode == Material::Alpha::Blend ? std::clamp(color.a, 0.0F, 1.0F) : 1.0F;
            const Rgb emitted = shares.direct && (hit.front || m.double_sided)
                                    ? rays_.emission(hit.surface, hit.triangle, hit.barycentric)
                                    : Rgb(0.0F);
            sum += weight * cover * emitted;

            const bool lobe = kind == MaterialKind::Mirror || (kind == MaterialKind::Glossy && m.roughness < kDullMetal);
            if (lobe) {
                sum +=
                    weight * cover * metal(ray, hit, m, Rgb(color), depth, throughput * max_component(weight) * cover, seed);
            } else if (kind == MaterialKind::DielectricThin) {
                const Dielectric d = dielectric(ray.direction, facing(hit), 1.0F / std::max(m.ior, 1.0F));
                const float reflected = 2.0F * d.reflectance / (1.0F + d.reflectance); // both faces and all inner bounces
                sum += weight * cover * reflected *
                       bounce(position, facing(hit), glm::reflect(ray.direction, facing(hit)), depth,
                              throughput * max_component(weight) * reflected, seed);
                weight *= (1.0F - cover) + cover * (1.0F - reflected) * Rgb(color) * m.transmission;
                sum += weight * cover * (1.0F - m.transmission) * reflection(hit, m, color, shares);
                go_on();
                if (max_component(weight) * throughput < kLeastThroughput) {
                    return sum;
                }
                continue;
            } else if (kind == MaterialKind::DielectricSolid) {
                return sum + weight * solid_glass(ray, hit, m, Rgb(color), position, depth,
                                                  throughput * max_component(weight), seed);
            } else {
                sum += weight * cover * reflection(hit, m, color, shares);
            }
            weight *= 1.0F - cover;
            if (max_component(weight) * throughput < kLeastThroughput) {
                return sum;
            }
            go_on();
        }
        return sum;
    }

private:
    static vec3 facing(const Hit& hit) { return hit.front ? hit.geometric_normal : -hit.geometric_normal; }

    [[nodiscard]] vec3 smooth_normal(const Hit& hit, const vec3& direction) const {
        vec3 n = rays_.shading_normal(hit);
        n = hit.front ? n : -n;
        return glm::dot(n, direction) < 0.0F ? n : facing(hit);
    }

    [[nodiscard]] Rgb reflection(const Hit& hit, const Material& m, const vec4& color, const LightShares& shares) const {
        Material at_point = m;
        at_point.base_color = Rgb(color);
        return diffuse_reflectance(at_point) * lit_.irradiance(hit, shares) * kInvPi;
    }

    [[nodiscard]] Rgb bounce(const vec3& position, const vec3& side, const vec3& direction, int depth, float throughput,
                             std::uint32_t seed) const {
        if (depth >= max_depth_ || throughput < kLeastThroughput) {
            return Rgb(0.0F);
        }
        const float sign = glm::dot(side, direction) >= 0.0F ? 1.0F : -1.0F;
        return radiance({position + side * (sign * 3e-5F), direction}, depth + 1, throughput, seed + 1);
    }

    [[nodiscard]] Rgb metal(const Ray& ray, const Hit& hit, const Material& m, const Rgb& f0, int depth, float throughput,
                            std::uint32_t seed) const {
        const vec3 n = smooth_normal(hit, ray.direction);
        const vec3 position = ray.origin + ray.direction * hit.t;
        const bool mirror = m.roughness < kMirrorRoughness;
        const int samples = mirror || depth > 0 ? 1 : 8;
        Rgb sum(0.0F);
        for (int i = 0; i < samples; ++i) {
            vec3 h = n;
            if (!mirror) { // GGX normal: density D cos, weight left to Fresnel alone (single reflection, no shadowing)
                const vec2 u = sobol_owen2(std::uint32_t(i), 0, seed);
                const float a2 = m.roughness * m.roughness * m.roughness * m.roughness;
                const float cos2 = (1.0F - u.x) / (1.0F + (a2 - 1.0F) * u.x);
                const float sine = std::sqrt(std::max(1.0F - cos2, 0.0F));
                vec3 t;
                vec3 b;
                make_frame(n, t, b);
                h = sine * std::cos(2.0F * kPi * u.y) * t + sine * std::sin(2.0F * kPi * u.y) * b + std::sqrt(cos2) * n;
            }
            vec3 out = glm::reflect(ray.direction, h);
            if (glm::dot(out, facing(hit)) <= 0.0F) {
                out = glm::reflect(ray.direction, facing(hit));
            }
            const float grazing = std::pow(1.0F - std::clamp(-glm::dot(ray.direction, h), 0.0F, 1.0F), 5.0F);
            const Rgb fresnel = f0 + (Rgb(1.0F) - f0) * grazing;
            sum += fresnel *
                   bounce(position, facing(hit), out, depth, throughput * max_component(fresnel), seed + std::uint32_t(i));
        }
        return sum / float(samples);
    }

    [[nodiscard]] Rgb solid_glass(const Ray& ray, const Hit& hit, const Material& m, const Rgb& tint, const vec3& position,
                                  int depth, float throughput, std::uint32_t seed) const {
        const vec3 n = smooth_normal(hit, ray.direction);
        const float ior = std::max(m.ior, 1.0F);
        const Dielectric d = dielectric(ray.direction, n, hit.front ? 1.0F / ior : ior);
        Rgb inside(1.0F);
        if (!hit.front && std::isfinite(m.attenuation_distance) && m.attenuation_distance > 0.0F) {
            for (int c = 0; c < 3; ++c) { // Beer-Lambert, KHR_materials_volume
                inside[c] = std::pow(std::max(m.attenuation_color[c], 1e-6F), hit.t / m.attenuation_distance);
            }
        }
        Rgb sum(0.0F);
        const float through = (1.0F - d.reflectance) * m.transmission;
        if (through > 0.0F) {
            sum += through * tint * bounce(position, facing(hit), d.refracted, depth, throughput * through, seed);
        }
        sum += d.reflectance *
               bounce(position, facing(hit), glm::reflect(ray.direction, n), depth, throughput * d.reflectance, seed);
        return sum * inside;
    }

    const LitScene& lit_;
    const RayScene& rays_;
    Rgb sky_;
    int max_depth_;
    LightShares shares_;
};

/// Right, up and back of a camera, unit and at right angles; those of its parent's space where the placement has none (a
/// scale of zero, or axes that fall together).
std::array<vec3, 3> camera_axes(const dmat4& to_world) {
    dvec3 back(to_world[2]);
    dvec3 up(to_world[1]);
    const auto usable = [](const dvec3& v) { return std::isfinite(glm::dot(v, v)) && glm::dot(v, v) > 0.0; };
    back = usable(back) ? glm::normalize(back) : dvec3(0.0, 0.0, 1.0);
    up = usable(up) ? glm::normalize(up) : dvec3(0.0, 1.0, 0.0);
    dvec3 right(to_world[0]);
    // A shear is kept as it is; only what gives no picture at all is replaced.
    right = usable(right) ? glm::normalize(right) : glm::cross(up, back);
    if (std::abs(glm::dot(right, glm::cross(up, back))) < 1e-9) {
        up = std::abs(back.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(0.0, 0.0, -1.0);
        right = glm::normalize(glm::cross(up, back));
        up = glm::cross(back, right);
    }
    return {vec3(right), vec3(up), vec3(back)};
}

} // namespace

Picture render_still(const Scene& scene, const Solution& solution, const ViewCamera& camera, const StillOptions& options,
                     const RunContext& context) {
    Picture out;
    out.width = std::max(options.width, 1);
    out.height = std::max(options.height, 1);
    out.pixels.assign(std::size_t(out.width) * std::size_t(out.height), vec3(0.0F));
    const LitScene lit(scene, solution);
    const EyeTracer tracer(lit, scene.environment.sky_radiance, options);
    const vec3 eye(dvec3(camera.to_world[3]) - lit.rays().origin());
    const auto [right, up, back] = camera_axes(camera.to_world);
    const vec3 forward = -back;
    const float aspect = float(out.width) / float(out.height);
    const float half_height = camera.lens.perspective ? std::tan(0.5F * camera.lens.yfov) : camera.lens.ymag;
    const int n = std::max(options.samples_per_axis, 1);
    const std::size_t band = 8; // rows between two looks at the stop flag
    const auto rows = std::size_t(out.height);
    for (std::size_t first = 0; first < rows && !context.should_stop(); first += band) {
        const std::size_t count = std::min(band, rows - first) * std::size_t(out.width);
        parallel_chunks(count, 64, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                const std::size_t pixel = first * std::size_t(out.width) + i;
                const auto x = float(pixel % std::size_t(out.width));
                const auto y = float(pixel / std::size_t(out.width));
                Rgb sum(0.0F);
                for (int s = 0; s < n * n; ++s) {
                    const vec2 offset((float(s % n) + 0.5F) / float(n), (float(s / n) + 0.5F) / float(n));
                    const float sx = (2.0F * (x + offset.x) / float(out.width) - 1.0F) * half_height * aspect;
                    const float sy = (1.0F - 2.0F * (y + offset.y) / float(out.height)) * half_height;
                    Ray ray;
                    if (camera.lens.perspective) {
                        ray = {eye, glm::normalize(forward + sx * right + sy * up)};
                    } else {
                        ray = {eye + sx * right + sy * up, forward};
                    }
                    const auto seed = std::uint32_t(hash64(pixel * 64 + std::size_t(s)));
                    sum += tracer.radiance(ray, 0, 1.0F, seed);
                }
                out.pixels[pixel] = sum / float(n * n);
            }
        });
        context.progress("render", double(std::min(first + band, rows)) / double(rows));
    }
    return out;
}

} // namespace atrium
