// Particles: how fast they are next to Embree alone on the same rays, and what they cost and bring scene by scene.
#include "engine/base/parallel.h"
#include "engine/particles/particle_map.h"
#include "tests/bench/bare_embree.h"
#include "tests/bench/bench_support.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace atrium::bench {
namespace {

constexpr int kRounds = 5;

struct Figures {
    double particles = 0, segments = 0, landings = 0, ours = 0, bare = 0, defect = 0;
};

Figures measure(const Scene& scene, std::uint32_t count) {
    const RayScene rays(scene);
    const SpecularTargets targets(rays);
    const DirectLight direct(scene, rays);
    ParticleSettings settings;
    settings.particles = count;
    const ParticleMap map(rays, targets, direct, {}, {}, settings, RunContext{});
    Figures out;
    out.particles = double(map.emitted());
    out.landings = double(map.landings().size());
    const ParticleEnergy& e = map.energy();
    out.defect = e.emitted > 0.0 ? 1.0 - (e.absorbed + e.escaped + e.stored + e.imaged + e.cut) / e.emitted : 0.0;
    std::vector<Landing> landings;
    ParticleEnergy energy;
    std::vector<Ray> path;
    const auto trace_all = [&](std::vector<Ray>* into) {
        for (std::uint32_t l = 0; l < map.links().size(); ++l) {
            const ParticleLink& link = map.links()[l];
            const ParticleSource& source = map.sources()[link.source];
            const ParticleStream stream{&source,  link.target, l,
                                        link.key, link.count,  make_aim(source, targets.targets()[link.target])};
            for (std::uint32_t k = 0; k < link.count; ++k) {
                trace_particle(rays, targets, {}, stream, k, {}, landings, energy, into);
            }
            landings.clear();
        }
    };
    trace_all(&path);
    out.segments = double(path.size());
    std::vector<BareRay> bare;
    bare.reserve(path.size());
    for (const Ray& r : path) {
        bare.push_back({r.origin, r.direction, 0.0F, std::numeric_limits<float>::infinity()});
    }
    const BareEmbree embree(rays);
    out.ours = out.bare = std::numeric_limits<double>::infinity();
    std::size_t met = 0;
    for (int round = 0; round < kRounds; ++round) {
        double before = cpu_seconds();
        trace_all(nullptr);
        out.ours = std::min(out.ours, cpu_seconds() - before);
        before = cpu_seconds();
        met += embree.nearest(bare);
        out.bare = std::min(out.bare, cpu_seconds() - before);
    }
    if (met == 0) {
        fmt::print(stderr, "no ray met anything\n");
    }
    return out;
}

} // namespace
} // namespace atrium::bench

int main(int argc, char** argv) {
    using namespace atrium;
    using namespace atrium::bench;
    CLI::App app{"Particles per second next to Embree alone on the same rays, one thread. Lamps and suns only."};
    std::vector<std::string> files;
    std::uint32_t count = 200'000;
    app.add_option("FILE", files, "scenes")->required();
    app.add_option("--particles", count, "emitted at most");
    CLI11_PARSE(app, argc, argv);
    fmt::print("{:<28} {:>10} {:>10} {:>10} {:>12} {:>12} {:>8} {:>10}\n", "scene", "particles", "segments", "landings",
               "ours Mray/s", "bare Mray/s", "share", "defect");
    for (const std::string& file : files) {
        const auto lit = read_lit_scene(file);
        if (!lit) {
            return 1;
        }
        const Figures f = measure(lit->scene, count);
        fmt::print("{:<28} {:>10.0f} {:>10.0f} {:>10.0f} {:>12.2f} {:>12.2f} {:>7.0f}% {:>10.2g}\n",
                   file.substr(file.find_last_of('/') + 1), f.particles, f.segments, f.landings, 1e-6 * f.segments / f.ours,
                   1e-6 * f.segments / f.bare, 100.0 * f.bare / f.ours, f.defect);
    }
    return 0;
}
