// Error of caustic textures against brute force: both modes, by particles and by time; and what reconstruction costs.
#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/layers/caustic_layer.h"
#include "engine/layers/direct_map_builder.h"
#include "engine/radiosity/mirror_light.h"
#include "engine/raycast/scene_charts.h"
#include "engine/reference/reference.h"
#include "engine/solver/quality.h"
#include "tests/bench/bench_support.h"
#include "tests/bench/caustic_scenes.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <numeric>

namespace atrium::bench {
namespace {

constexpr int kSide = 256; // texels of the comparison

double wall() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Irradiance (luminance) per texel of the receiver.
using Map = std::vector<double>;

/// Means over the texels of what `light` says at chart-space coordinates.
template <class F> Map over_texels(const CausticScene& c, const SurfaceCharts& charts, const F& light) {
    Map out(std::size_t(kSide) * kSide, 0.0);
    constexpr int kSub = 3;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            double sum = 0.0;
            for (int k = 0; k < kSub * kSub; ++k) {
                const vec2 at((float(x) + (float(k % kSub) + 0.5F) / kSub) / kSide,
                              (float(y) + (float(k / kSub) + 0.5F) / kSub) / kSide);
                sum += luminance(light(c.chart_position(charts, at)));
            }
            out[std::size_t(y) * kSide + std::size_t(x)] = sum / (kSub * kSub);
        }
    }
    return out;
}

/// What light maps show of the light over flat mirrors: default mode has it by mirror images instead of particles.
Map shown_over_mirrors(const CausticScene& c, const RayScene& rays, const std::vector<SurfaceCharts>& charts,
                       const DirectLight& lamps, const MirrorLight& mirrors, const QualitySettings& quality,
                       float light_floor) {
    DirectMapSettings settings = quality.maps;
    settings.light_floor = light_floor;
    const DirectPart part{
        [&](const vec3& p, const vec3& n) { return mirrors.irradiance(p, n, quality.field.direct, &lamps, nullptr); }, false,
        true};
    const RunContext context; // asked for as long as the maps live
    LiveDirectMaps maps(
        rays, charts, {part}, [&](std::uint32_t s) { return rays.surfaces()[s].back_side; }, settings, context);
    const DirectMaps made = maps.build(0.0, 1.0);
    const auto& map = made.front[c.receiver];
    return over_texels(c, charts[c.receiver], [&](const vec2& uv) { return map ? map->irradiance(uv) : Rgb(0.0F); });
}

/// What textures show there, and the rest of the landings at the mesh's resolution.
Map shown(const CausticScene& c, const RayScene& rays, const std::vector<SurfaceCharts>& charts, const ParticleMap& map,
          const CausticLight& light, float mesh_edge) {
    Map out(std::size_t(kSide) * kSide, 0.0);
    for (const CausticLight::Side& side : light.sides) {
        if (side.surface != c.receiver || side.back) {
            continue;
        }
        const Map textured = over_texels(c, charts[c.receiver], [&](const vec2& uv) {
            Rgb sum(0.0F);
            for (const auto& t : side.textures) {
                sum += t->irradiance(uv);
            }
            return sum;
        });
        std::transform(out.begin(), out.end(), textured.begin(), out.begin(), std::plus<>());
        const int cells = std::max(int(std::lround(c.size / mesh_edge)), 1);
        Map mesh(std::size_t(cells) * std::size_t(cells), 0.0);
        const double cell = double(c.size) * c.size / (double(cells) * cells);
        for (const std::uint32_t i : side.on_mesh) {
            const vec2 at = c.place(rays, map.landings()[i]) * float(cells);
            if (at.x >= 0.0F && at.y >= 0.0F && at.x < float(cells) && at.y < float(cells)) {
                mesh[std::size_t(at.y) * std::size_t(cells) + std::size_t(at.x)] +=
                    luminance(map.power(map.landings()[i])) / cell;
            }
        }
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                out[std::size_t(y) * kSide + std::size_t(x)] +=
                    mesh[std::size_t(y * cells / kSide) * std::size_t(cells) + std::size_t(x * cells / kSide)];
            }
        }
    }
    return out;
}

/// Root mean square difference over the root mean square of the truth, less the truth's own noise.
double error(const Map& a, const Map& truth, double noise2) {
    double d = 0.0, s = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        d += (a[i] - truth[i]) * (a[i] - truth[i]);
        s += truth[i] * truth[i];
    }
    return s > 0.0 ? std::sqrt(std::max(d - noise2, 0.0) / s) : 0.0;
}

ParticleMap trace(const CausticScene& c, const RayScene& rays, const SpecularTargets& targets, const DirectLight& direct,
                  const CarriedByImage& by_image, std::uint32_t count, std::uint32_t seed) {
    ParticleSettings settings;
    settings.particles = count;
    settings.seed = seed;
    return ParticleMap(rays, targets, direct, c.emitters(rays), by_image, settings, RunContext{});
}

void measure(const CausticScene& c, std::uint64_t truth_particles) {
    const RayScene rays(c.scene);
    const SpecularTargets targets(rays);
    const DirectLight direct(c.scene, rays);
    const QualitySettings quality = quality_settings(SolverSettings::Quality::Normal, rays.bounds().diagonal(), 0.0);
    const std::vector<SurfaceCharts> charts = chart_surfaces(rays, quality.charts);
    // The reference: other code, other random numbers.
    const ReferenceRectangle square{{double(c.corner.x), 1e-6, double(c.corner.y)},
                                    {double(c.size), 0.0, 0.0},
                                    {0.0, 0.0, double(c.size)},
                                    {0.0, 1.0, 0.0}};
    CausticReferenceSettings reference;
    reference.particles = truth_particles;
    const auto found = reference_caustics(c.scene, square, kSide, kSide, reference, RunContext{});
    if (!found) {
        fmt::print(stderr, "{}\n", found.error().message());
        return;
    }
    Map truth;
    double noise2 = 0.0, size2 = 0.0;
    for (std::size_t i = 0; i < found->irradiance.size(); ++i) {
        truth.push_back(luminance(found->irradiance[i]));
        noise2 += found->standard_error[i] * found->standard_error[i];
        size2 += truth.back() * truth.back();
    }
    fmt::print("{}: truth from {} particles, its noise {:.2f} %\n", c.name, truth_particles,
               100.0 * std::sqrt(noise2 / size2));
    fmt::print("  {:>9} {:>9} {:>10} {:>10} {:>7} {:>8} {:>12} {:>12} {:>5}  {}\n", "particles", "landings", "paper",
               "default", "ratio", "trace s", "paper s", "default s", "boxes", "texels");
    const auto floor =
        float(0.05 * std::accumulate(truth.begin(), truth.end(), 0.0) / double(truth.size())); // as a solution's
    const MirrorLight mirrors(rays);
    double start = wall();
    const Map over_mirrors =
        mirrors.empty() ? Map(truth.size(), 0.0) : shown_over_mirrors(c, rays, charts, direct, mirrors, quality, floor);
    if (!mirrors.empty()) {
        fmt::print("  default mode shows flat mirrors by images: light maps in {:.3f} s\n", wall() - start);
    }
    for (const std::uint32_t n : {3000U, 10'000U, 30'000U, 100'000U, 300'000U, 1'000'000U}) {
        start = wall();
        const ParticleMap all = trace(c, rays, targets, direct, {}, n, 1);
        const double traced = wall() - start;
        const ParticleMap others = trace(
            c, rays, targets, direct, [&](const Hit& hit) { return mirrors.carries(hit); }, n, 1);
        double errors[2];
        double seconds[2];
        std::size_t boxes = 0, texels = 0;
        for (const bool paper : {true, false}) {
            CausticSettings settings = quality.caustics;
            settings.paper = paper;
            const ParticleMap& map = paper ? all : others;
            start = wall();
            const CausticLight light = build_caustic_light(rays, charts, map, settings);
            seconds[paper ? 0 : 1] = wall() - start;
            Map seen = shown(c, rays, charts, map, light, settings.mesh_edge);
            if (!paper) {
                std::transform(seen.begin(), seen.end(), over_mirrors.begin(), seen.begin(), std::plus<>());
            }
            errors[paper ? 0 : 1] = error(seen, truth, noise2);
            boxes = light.texture_count();
            texels = 0;
            for (const auto& side : light.sides) {
                for (const auto& t : side.textures) {
                    texels += t->image.size();
                }
            }
        }
        fmt::print("  {:>9} {:>9} {:>9.1f}% {:>9.1f}% {:>7.2f} {:>8.3f} {:>12.3f} {:>12.3f} {:>5}  {}\n", all.emitted(),
                   all.landings().size(), 100.0 * errors[0], 100.0 * errors[1], errors[1] / std::max(errors[0], 1e-9),
                   traced, seconds[0], seconds[1], boxes, texels);
    }
}

/// 25 textures of 85 x 85 from a million particles, both modes.
void reconstruction_speed() {
    constexpr std::uint32_t kTextures = 25, kParticles = 1'000'000;
    SurfaceCharts charts;
    charts.tile_edge = 1.0F;
    charts.width = charts.height = 5;
    std::vector<vec3> positions;
    std::vector<uvec3> triangles;
    for (std::uint32_t k = 0; k < kTextures; ++k) {
        const vec3 at(float(k % 5), float(k / 5), 0.0F);
        Chart chart;
        chart.tile_u = k % 5;
        chart.tile_v = k / 5;
        chart.tiles_u = chart.tiles_v = 1;
        charts.charts.push_back(chart);
        const auto v = std::uint32_t(positions.size());
        for (const vec2& c : {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1)}) {
            positions.push_back(at + vec3(c.x, c.y, 0.0F));
        }
        for (const uvec3& t : {uvec3(v, v + 1, v + 2), uvec3(v, v + 2, v + 3)}) {
            triangles.push_back(t);
            charts.chart_of_triangle.push_back(k);
            charts.uv.push_back({vec2(positions[t.x]), vec2(positions[t.y]), vec2(positions[t.z])});
        }
    }
    std::vector<CausticLanding> landings;
    for (std::uint32_t i = 0; i < kParticles; ++i) {
        CausticLanding l;
        const std::uint32_t k = i % kTextures;
        const vec2 u = sobol_owen2(i / kTextures, 0, k);
        const float r = 0.45F * u.x; // denser towards the middle
        const float angle = 2.0F * kPi * u.y;
        const vec2 p = vec2(0.5F) + r * vec2(std::cos(angle), std::sin(angle));
        const bool second = p.y > p.x;
        l.triangle = 2 * k + (second ? 1 : 0);
        l.uv = vec2(float(k % 5), float(k / 5)) + p;
        l.barycentric = second ? vec2(p.x, p.y - p.x) : vec2(p.x - p.y, p.y);
        l.axis_a = vec2(0.02F, 0.0F); // texels of 1/100: about 85 across the lit disc
        l.axis_b = vec2(0.0F, 0.02F);
        l.power = Rgb(1.0F / float(kParticles));
        landings.push_back(l);
    }
    for (const bool paper : {true, false}) {
        CausticSettings settings;
        settings.paper = paper;
        settings.mesh_edge = 0.2F;
        double best = std::numeric_limits<double>::infinity(), work = best;
        CausticSide side;
        for (int round = 0; round < 9; ++round) {
            const double start = wall(), before = cpu_seconds();
            side = build_caustics(landings, charts, positions, triangles, settings);
            best = std::min(best, wall() - start);
            work = std::min(work, cpu_seconds() - before);
        }
        std::size_t texels = 0;
        for (const auto& t : side.textures) {
            texels += t->image.size();
        }
        fmt::print("{}: {} textures, {:.0f} texels a side on average, {} particles: {:.0f} ms on {} threads, "
                   "{:.0f} ms of processor time\n",
                   paper ? "paper" : "default", side.textures.size(),
                   std::sqrt(double(texels) / double(std::max<std::size_t>(side.textures.size(), 1))), kParticles,
                   1000.0 * best, thread_limit(), 1000.0 * work);
    }
}

} // namespace
} // namespace atrium::bench

int main(int argc, char** argv) {
    using namespace atrium::bench;
    CLI::App app{"Relative RMS error of caustic textures on 256 x 256 texels of the receiver against brute force, paper and "
                 "default mode at equal particles, and the time of both."};
    std::uint64_t truth = 20'000'000;
    std::vector<std::string> only;
    app.add_option("--truth", truth, "particles of the truth");
    app.add_option("--only", only, "names of scenes; 'speed' for reconstruction alone");
    CLI11_PARSE(app, argc, argv);
    const auto wanted = [&](const std::string& name) {
        return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
    };
    for (const CausticScene& c : caustic_scenes()) {
        if (wanted(c.name)) {
            measure(c, truth);
        }
    }
    if (wanted("speed")) {
        reconstruction_speed();
    }
    return 0;
}
