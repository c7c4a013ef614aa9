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

    /// What a ray meets in false colour: the first surface that is not looked through.
    struct Met {
        Hit hit;             ///< none: the outside
        bool matt = false;   ///< scatters the light that arrives
        bool even = false;   ///< without a texture
        float facing = 1.0F; ///< cosine between the ray and its normal
    };
    [[nodiscard]] Met meet(Ray ray) const {
        for (int pass = 0; pass < 64; ++pass) {
            const Hit hit = rays_.nearest(ray);
            if (!hit) {
                return {};
            }
            const Material& m = rays_.material(hit.surface);
            const MaterialKind kind = classify(m);
            const bool glass = kind == MaterialKind::DielectricThin || kind == MaterialKind::DielectricSolid;
            const bool faint = m.alpha_mode == Material::Alpha::Blend &&
                               rays_.base_color(hit.surface, hit.triangle, hit.barycentric).a < 0.5F;
            if (!glass && !faint && (hit.front || m.double_sided)) {
                return {hit, kind == MaterialKind::Diffuse && !m.unlit, !m.base_color_texture && !m.emissive_texture,
                        std::abs(glm::dot(smooth_normal(hit, ray.direction), ray.direction))};
            }
            ray.origin += ray.direction * (hit.t + 2e-5F + 1e-6F * hit.t);
        }
        return {};
    }
    [[nodiscard]] float illuminance(const Hit& hit) const { return luminance(lit_.irradiance(hit, shares_)); }

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

/// Calls sample(pixel, index of the sample within it, ray) for all samples of all pixels, in parallel over pixels, then
/// done(pixel). Stops between bands of rows when the context says so.
template <class Sample, class Done>
void look_through(const ViewCamera& camera, const LitScene& lit, int width, int height, int samples,
                  const RunContext& context, Sample&& sample, Done&& done) {
    const vec3 eye(dvec3(camera.to_world[3]) - lit.rays().origin());
    const auto axes = camera_axes(camera.to_world);
    const vec3 right = axes[0];
    const vec3 up = axes[1];
    const vec3 forward = -axes[2];
    const float aspect = float(width) / float(height);
    const float half_height = camera.lens.perspective ? std::tan(0.5F * camera.lens.yfov) : camera.lens.ymag;
    const int n = samples;
    const std::size_t band = 8; // rows between two looks at the stop flag
    const auto rows = std::size_t(height);
    for (std::size_t first = 0; first < rows && !context.should_stop(); first += band) {
        const std::size_t count = std::min(band, rows - first) * std::size_t(width);
        parallel_chunks(count, 64, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                const std::size_t pixel = first * std::size_t(width) + i;
                const auto x = float(pixel % std::size_t(width));
                const auto y = float(pixel / std::size_t(width));
                for (int s = 0; s < n * n; ++s) {
                    const vec2 offset((float(s % n) + 0.5F) / float(n), (float(s / n) + 0.5F) / float(n));
                    const float sx = (2.0F * (x + offset.x) / float(width) - 1.0F) * half_height * aspect;
                    const float sy = (1.0F - 2.0F * (y + offset.y) / float(height)) * half_height;
                    Ray ray;
                    if (camera.lens.perspective) {
                        ray = {eye, glm::normalize(forward + sx * right + sy * up)};
                    } else {
                        ray = {eye + sx * right + sy * up, forward};
                    }
                    sample(pixel, s, ray);
                }
                done(pixel);
            }
        });
        context.progress("render", double(std::min(first + band, rows)) / double(rows));
    }
}

Picture empty_picture(const StillOptions& options) {
    Picture out;
    out.width = std::max(options.width, 1);
    out.height = std::max(options.height, 1);
    out.pixels.assign(std::size_t(out.width) * std::size_t(out.height), vec3(0.0F));
    return out;
}

constexpr std::uint32_t kNoSurface = 0xFFFFFFFFU;
/// Tells the sides of a box apart, whose light has no contours in common.
std::uint32_t side_of(const Hit& hit) {
    const vec3 n = glm::abs(hit.geometric_normal);
    const std::uint32_t axis = n.x >= n.y && n.x >= n.z ? 0U : (n.y >= n.z ? 1U : 2U);
    return hit.surface * 6U + axis * 2U + (hit.geometric_normal[int(axis)] < 0.0F ? 1U : 0U);
}

constexpr float kHalfLine = 0.75F; ///< pixels: half the width of a contour, as in the viewport

/// Draws contours over a finished picture. `amounts` and `surfaces` by pixel; none where kNoSurface.
void draw_contours(Picture& picture, const FalseColor& scale, const std::vector<float>& amounts,
                   const std::vector<std::uint32_t>& surfaces) {
    std::vector<double> levels = round_values(scale);
    std::erase_if(levels, [&](double level) { return level <= scale.minimum; });
    const auto width = std::size_t(picture.width);
    for (std::size_t i = 0; i < amounts.size(); ++i) {
        if (surfaces[i] == kNoSurface) {
            continue;
        }
        // Change to the next pixels of the same surface; edges of things are no contours.
        const auto change = [&](std::size_t step, bool before, bool after) {
            float out = 0.0F;
            if (before && surfaces[i - step] == surfaces[i]) {
                out = std::abs(amounts[i] - amounts[i - step]);
            }
            if (after && surfaces[i + step] == surfaces[i]) {
                out = std::max(out, std::abs(amounts[i + step] - amounts[i]));
            }
            return out;
        };
        const std::size_t x = i % width;
        const float slope = change(1, x > 0, x + 1 < width) + change(width, i >= width, i + width < amounts.size());
        if (!(slope > 0.0F)) {
            continue;
        }
        float line = 0.0F;
        for (const double level : levels) {
            line = std::max(line, kHalfLine + 0.5F - std::abs(amounts[i] - float(level)) / slope);
        }
        const Rgb ink(scale_place(scale, double(amounts[i])) < 0.55F ? 1.0F : 0.0F);
        picture.pixels[i] = glm::mix(picture.pixels[i], ink, 0.85F * std::clamp(line, 0.0F, 1.0F));
    }
}

} // namespace

Picture render_still(const Scene& scene, const Solution& solution, const ViewCamera& camera, const StillOptions& options,
                     const RunContext& context) {
    Picture out = empty_picture(options);
    const LitScene lit(scene, solution);
    const EyeTracer tracer(lit, scene.environment.sky_radiance, options);
    const int n = std::max(options.samples_per_axis, 1);
    look_through(
        camera, lit, out.width, out.height, n, context,
        [&](std::size_t pixel, int s, const Ray& ray) {
            out.pixels[pixel] += tracer.radiance(ray, 0, 1.0F, std::uint32_t(hash64(pixel * 64 + std::size_t(s))));
        },
        [&](std::size_t pixel) { out.pixels[pixel] /= float(n * n); });
    return out;
}

Picture render_false_color(const Scene& scene, const Solution& solution, const ViewCamera& camera,
                           const StillOptions& options, const FalseColor& wanted, const RunContext& context) {
    const FalseColor scale = valid_scale(wanted);
    Picture out = empty_picture(options);
    std::vector<float> amounts(out.pixels.size(), 0.0F);
    std::vector<std::uint32_t> surfaces(out.pixels.size(), kNoSurface);
    const LitScene lit(scene, solution);
    const EyeTracer tracer(lit, scene.environment.sky_radiance, options);
    const bool bright_sky = max_component(scene.environment.sky_radiance) > 0.0F && options.shares.direct;
    const int n = std::max(options.samples_per_axis, 1);
    look_through(
        camera, lit, out.width, out.height, n, context,
        [&](std::size_t pixel, int s, const Ray& ray) {
            const EyeTracer::Met met = tracer.meet(ray);
            const bool illuminance = scale.quantity == LightQuantity::Illuminance;
            const bool known = illuminance ? bool(met.hit) && met.matt : bool(met.hit) || bright_sky;
            if (!known) {
                out.pixels[pixel] += Rgb(met.hit ? glm::mix(0.30F, 0.58F, std::min(met.facing, 1.0F)) : 0.27F);
                surfaces[pixel] = kNoSurface;
                return;
            }
            const float amount =
                illuminance ? tracer.illuminance(met.hit)
                            : luminance(tracer.radiance(ray, 0, 1.0F, std::uint32_t(hash64(pixel * 64 + std::size_t(s)))));
            out.pixels[pixel] += false_color(scale, double(amount));
            amounts[pixel] += amount / float(n * n);
            const bool drawn = met.hit && met.matt && (illuminance || met.even);
            surfaces[pixel] = drawn && (s == 0 || surfaces[pixel] == side_of(met.hit)) ? side_of(met.hit) : kNoSurface;
        },
        [&](std::size_t pixel) { out.pixels[pixel] /= float(n * n); });
    if (scale.contours) {
        draw_contours(out, scale, amounts, surfaces);
    }
    return out;
}

} // namespace atrium
