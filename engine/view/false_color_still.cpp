// Stills in false colour.
#include "engine/base/rng.h"
#include "engine/view/eye_tracer.h"
#include "engine/view/look_through.h"
#include "engine/view/still.h"

#include <algorithm>

namespace atrium {
namespace {

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

Picture render_false_color(const Scene& scene, const Solution& solution, const ViewCamera& camera,
                           const StillOptions& options, const FalseColor& wanted, const RunContext& context) {
    const FalseColor scale = valid_scale(wanted);
    Picture out;
    out.width = std::max(options.width, 1);
    out.height = std::max(options.height, 1);
    out.pixels.assign(std::size_t(out.width) * std::size_t(out.height), vec3(0.0F));
    std::vector<float> amounts(out.pixels.size(), 0.0F);
    std::vector<std::uint32_t> surfaces(out.pixels.size(), kNoSurface);
    const LitScene lit(scene, solution);
    const EyeTracer tracer(lit, scene.environment.sky_radiance, options.max_specular_depth, options.shares);
    const bool bright_sky = max_component(scene.environment.sky_radiance) > 0.0F && options.shares.direct;
    const int n = std::max(options.samples_per_axis, 1);
    look_through(
        camera, lit.rays().origin(), out.width, out.height, n, context, [&](std::size_t pixel, int s, const Ray& ray) {
            const EyeTracer::Met met = tracer.meet(ray);
            const bool illuminance = scale.quantity == LightQuantity::Illuminance;
            const bool known = illuminance ? bool(met.hit) && met.matt : bool(met.hit) || bright_sky;
            if (!known) {
                out.pixels[pixel] += Rgb(met.hit ? glm::mix(0.30F, 0.58F, std::min(met.facing, 1.0F)) : 0.27F);
                surfaces[pixel] = kNoSurface;
                return;
            }
            const float amount = illuminance
                                     ? tracer.illuminance(met.hit)
                                     : luminance(tracer.look(ray, std::uint32_t(hash64(pixel * 64 + std::size_t(s)))).sum());
            out.pixels[pixel] += false_color(scale, double(amount));
            amounts[pixel] += amount / float(n * n);
            const bool drawn = met.hit && met.matt && (illuminance || met.even);
            surfaces[pixel] = drawn && (s == 0 || surfaces[pixel] == side_of(met.hit)) ? side_of(met.hit) : kNoSurface;
        });
    for (vec3& pixel : out.pixels) {
        pixel /= float(n * n);
    }
    if (scale.contours) {
        draw_contours(out, scale, amounts, surfaces);
    }
    return out;
}

} // namespace atrium
