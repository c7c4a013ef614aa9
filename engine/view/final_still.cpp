#include "engine/view/final_still.h"

#include "engine/base/parallel.h"
#include "engine/view/final_light.h"
#include "engine/view/look_through.h"
#include "engine/view/still_sums.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr int kMostSamples = 4096;
constexpr float kRouletteUnder = 0.1F;   // throughput below which paths over mirrors and glass may end
constexpr int kMostMet = 256;            // surfaces on one path
constexpr std::uint32_t kLightGroup = 1; // of random numbers: 0 is the place in the pixel
constexpr std::uint32_t kWayGroup = kLightGroup + 2 * FinalLight::kGroups; // first of those at mirrors and glass

/// Follows one eye ray, one way on at every mirror and glass.
class FinalTracer {
public:
    FinalTracer(const LitScene& lit, const FinalLight& light, const Rgb& sky, const StillOptions& options)
        : lit_(lit), rays_(lit.rays()), light_(light), sky_(sky), shares_(options.shares), gather_(options.gather),
          max_depth_(options.max_specular_depth > 0 ? kMostMet : 0) {}

    [[nodiscard]] EyeLight look(const Ray& first, const PixelSampler& sampler) const {
        EyeLight out;
        Rgb weight(1.0F);
        Ray ray = first;
        int bends = 0;
        for (std::uint32_t met = 0; met < kMostMet; ++met) {
            const Hit hit = rays_.nearest(ray);
            if (!hit) {
                (bends > 0 ? out.specular : out.direct) += bends > 0 || shares_.direct ? weight * sky_ : Rgb(0.0F);
                return out;
            }
            const EyeSurface at = eye_surface(rays_, hit, ray.direction);
            if (bends == 0 && at.culled()) {
                ray.origin = at.behind();
                continue;
            }
            const vec4 u = sampler.group(kWayGroup + std::min(met, 64U));
            const SpecularWays ways = at.ways({u.x, u.y});
            if (bends == 0 && max_component(at.through) < 0.5F) {
                out.meet(at, glm::length(at.position - first.origin),
                         at.diffuse + ways.reflected.weight + ways.transmitted.weight);
            }
            add_matt(at, bends, weight, sampler, met, out);
            const bool over = bends < max_depth_;
            const float pass = max_component(at.through);
            const float back = over ? max_component(ways.reflected.weight) : 0.0F;
            const float bent = over ? max_component(ways.transmitted.weight) : 0.0F;
            const float all = pass + back + bent;
            if (!(all > 0.0F)) {
                return out;
            }
            const float pick = u.z * all;
            if (pick < pass) {
                weight *= at.through * (all / pass);
                ray.origin = at.behind();
            } else {
                const SpecularSample& way = pick < pass + back || !(bent > 0.0F) ? ways.reflected : ways.transmitted;
                weight *= way.weight * (all / std::max(max_component(way.weight), 1e-20F));
                ray = {at.start_of(way), way.direction};
                ++bends;
            }
            const float left = max_component(weight);
            if (left < kRouletteUnder) {
                const float survival = left / kRouletteUnder;
                if (!(u.w < survival)) {
                    return out;
                }
                weight /= survival;
            }
        }
        return out;
    }

private:
    void add_matt(const EyeSurface& at, int bends, const Rgb& weight, const PixelSampler& sampler, std::uint32_t met,
                  EyeLight& out) const {
        const bool straight = bends == 0;
        if (!straight || shares_.direct) {
            (straight ? out.direct : out.specular) += weight * at.emitted;
        }
        if (!(max_component(at.diffuse) > 0.0F) || (straight && shares_ == LightShares{false, false, false})) {
            return;
        }
        const Rgb scattered = weight * at.diffuse * kInvPi;
        if (!straight || shares_.caustic) {
            (straight ? out.caustic : out.specular) += scattered * lit_.irradiance(at.hit, {false, false, true});
        }
        if (straight && !shares_.direct && !shares_.diffuse) {
            return;
        }
        // Surfaces that let some light through are met in one path with what is behind them: other numbers for those.
        const std::uint32_t group = met < 4 ? kLightGroup : 1024 + met * 16;
        PointLight light = light_.at(off_surface(at.position, at.geometric), at.geometric, sampler, group);
        if (!gather_) {
            light.diffuse = lit_.irradiance(at.hit, {true, false, false});
        }
        if (!straight) {
            out.specular += scattered * light.sum();
            return;
        }
        out.direct += shares_.direct ? scattered * light.direct : Rgb(0.0F);
        if (shares_.diffuse) {
            out.diffuse += scattered * light.diffuse;
            out.read += gather_ ? scattered * lit_.irradiance(at.hit, {true, false, false}) : Rgb(0.0F);
        }
    }

    const LitScene& lit_;
    const RayScene& rays_;
    const FinalLight& light_;
    Rgb sky_;
    LightShares shares_;
    bool gather_;
    int max_depth_;
};

} // namespace

StillLayers render_final(const Scene& scene, const Solution& solution, const ViewCamera& camera, const StillOptions& options,
                         const RunContext& context, const StillWatcher& watcher) {
    StillSums sums(options.width, options.height);
    const LitScene lit(scene, solution);
    const RayScene rays(scene);
    const FinalLight light(scene, rays, lit, solution.statistics.mode != "paper", options.gather, context);
    const FinalTracer tracer(lit, light, scene.environment.sky_radiance, options);
    const CameraRays eye(camera, lit.rays().origin(), sums.width(), sums.height());
    std::uint64_t samples = 1;
    while (samples < std::uint64_t(std::clamp(options.final_samples, 1, kMostSamples))) {
        samples *= 2;
    }
    const std::uint64_t key = hash64(options.seed + 0x57111ULL);
    const auto columns = std::size_t(sums.width());
    const auto rows = std::size_t(sums.height());
    constexpr std::size_t kBand = 8; // rows between two reports
    std::uint64_t done = 0;
    while (done < samples && !context.should_stop()) {
        const std::uint64_t next = done == 0 ? 1 : 2 * done;
        for (std::size_t first = 0; first < rows && !context.should_stop(); first += kBand) {
            const std::size_t count = std::min(kBand, rows - first) * columns;
            parallel_chunks(count, 16, [&](std::size_t begin, std::size_t end, std::size_t) {
                for (std::size_t i = begin; i < end; ++i) {
                    const std::size_t pixel = first * columns + i;
                    const auto x = std::uint32_t(pixel % columns);
                    const auto y = std::uint32_t(pixel / columns);
                    for (std::uint64_t s = done; s < next && !context.should_stop(); ++s) {
                        const PixelSampler sampler(key, pixel_order(x, y) * samples + s);
                        const vec4 place = sampler.group(0);
                        sums.add(pixel, tracer.look(eye.through(float(x) + place.x, float(y) + place.y), sampler));
                    }
                }
            });
            const double share = double(std::min(first + kBand, rows)) / double(rows);
            context.progress("render", (double(done) + share * double(next - done)) / double(samples));
        }
        done = next;
        if (watcher && !context.should_stop()) {
            watcher(sums.mean());
        }
    }
    return sums.mean();
}

} // namespace atrium
