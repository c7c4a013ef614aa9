// What a move costs: particles traced again and textures made anew, next to doing everything again.
#include "engine/layers/caustic_layer.h"
#include "engine/solver/quality.h"
#include "tests/bench/bench_support.h"
#include "tests/bench/caustic_scenes.h"
#include "tests/support/moving_caustics.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace atrium::bench {
namespace {

double wall() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct Moving {
    std::string name;
    Scene scene;
    NodeId box;
    dvec3 from{0.0}, to{0.0};
};

std::vector<Moving> moving_scenes() {
    std::vector<Moving> out;
    for (CausticScene& c : caustic_scenes()) {
        // Across what is lit, a tenth as large as that.
        const test::Staged bare(c.scene);
        const ParticleMap map(bare.rays, bare.targets, bare.direct, bare.emitters, {}, {}, RunContext{});
        std::vector<float> x, z;
        for (const Landing& l : map.landings()) {
            if (c.on_receiver(bare.rays, l)) {
                x.push_back(c.corner.x + c.size * c.place(bare.rays, l).x);
                z.push_back(c.corner.y + c.size * c.place(bare.rays, l).y);
            }
        }
        std::sort(x.begin(), x.end());
        std::sort(z.begin(), z.end());
        const auto between = [](const std::vector<float>& v, double low) {
            return std::pair(double(v[std::size_t(low * double(v.size()))]),
                             double(v[std::size_t((1.0 - low) * double(v.size() - 1))]));
        };
        const auto [x0, x1] = between(x, 0.1);
        const auto [z0, z1] = between(z, 0.1);
        const double size = 0.1 * std::max(x1 - x0, z1 - z0), y = 0.51 * size;
        const NodeId box = test::add_shape(c.scene, Box{vec3(float(size))}, {0, 0, 0}, test::add_material(c.scene, 0.5F));
        out.push_back({c.name, std::move(c.scene), box, {x0, y, z0}, {x1, y, z1}});
    }
    test::Stage stage = test::stage();
    out.push_back({"stage", std::move(stage.scene), stage.box, {-1.5, 0.3, -1.0}, {1.0, 0.3, 0.8}});
    return out;
}

struct Sum {
    double share = 0, find = 0, trace = 0, store = 0, full = 0, caustics = 0, all_caustics = 0, octree = 0, octree_first = 0;
};

void measure(Moving m, std::uint32_t particles, int steps) {
    Node& node = *m.scene.nodes.find(m.box);
    node.transform.translation = m.from;
    auto at = std::make_unique<test::Staged>(m.scene);
    ParticleSettings settings;
    settings.particles = particles;
    settings.keep_paths = true;
    const RunContext context;
    ParticleMap map(at->rays, at->targets, at->direct, at->emitters, {}, settings, context);
    const QualitySettings quality = quality_settings(SolverSettings::Quality::Normal, at->rays.bounds().diagonal(), 0.0);
    std::vector<SurfaceCharts> charts = chart_surfaces(at->rays, quality.charts);
    CausticLight light = build_caustic_light(at->rays, charts, map, quality.caustics);
    settings.passage_octree = true;
    ParticleMap by_octree(at->rays, at->targets, at->direct, at->emitters, {}, settings, context);
    Sum sum;
    double most = 0.0;
    for (int i = 1; i <= steps; ++i) {
        node.transform.translation = m.from + (m.to - m.from) * (double(i) / steps);
        auto next = std::make_unique<test::Staged>(m.scene);
        const test::Moved moved(at->rays, next->rays);
        at = std::move(next);
        charts = chart_surfaces(at->rays, quality.charts);
        const ParticleUpdate u = map.update(at->particle_scene(), moved.boxes, moved.surfaces, context);
        const ParticleUpdate o = by_octree.update(at->particle_scene(), moved.boxes, moved.surfaces, context);
        if (i > 1) { // picking an object up is not moving it
            sum.octree += o.find_seconds;
        }
        sum.octree_first += i == 1 ? o.find_seconds : 0.0;
        double start = wall();
        const CausticReuse reuse{light, u.surfaces};
        CausticLight now = build_caustic_light(at->rays, charts, map, quality.caustics, &reuse);
        sum.caustics += wall() - start;
        start = wall();
        (void)build_caustic_light(at->rays, charts, map, quality.caustics);
        sum.all_caustics += wall() - start;
        ParticleMap full = map;
        start = wall();
        full.retrace(at->particle_scene(), context);
        sum.full += wall() - start;
        sum.share += u.share;
        sum.find += u.find_seconds;
        sum.trace += u.trace_seconds;
        sum.store += u.store_seconds;
        most = std::max(most, u.share);
        light = std::move(now);
        if (!u.complete || !(full.landings() == map.landings()) || !(full.landings() == by_octree.landings()) ||
            o.particles != u.particles) {
            fmt::print(stderr, "{}: an update differs from a full trace\n", m.name);
        }
    }
    const double n = 1000.0 / steps, update = sum.find + sum.trace + sum.store;
    fmt::print("{:<11} {:>9} {:>6.2f}% {:>6.2f}% | {:>6.2f} {:>6.2f} {:>6.2f} {:>7.1f} {:>6.1f} | {:>6.2f} {:>6.2f} {:>5} "
               "{:>6.0f} | {:>7.1f} {:>7.1f} {:>6.1f} | {:>6.1f} {:>6.1f}\n",
               m.name, map.emitted(), 100.0 * sum.share / steps, 100.0 * most, n * sum.find, n * sum.trace, n * sum.store,
               n * sum.full, sum.full / update, 1000.0 * sum.octree / std::max(steps - 1, 1), 1000.0 * sum.octree_first,
               by_octree.octree()->cells(), 1e-3 * double(by_octree.octree()->memory_bytes()), n * sum.caustics,
               n * sum.all_caustics, sum.all_caustics / sum.caustics, 1e-6 * double(map.paths().memory_bytes()),
               1e-6 * double(map.memory_bytes()));
}

} // namespace
} // namespace atrium::bench

int main(int argc, char** argv) {
    using namespace atrium::bench;
    CLI::App app{"A small box moves over the floor that a caustic falls on: means over the steps, milliseconds."};
    std::uint32_t particles = 250'000;
    int steps = 20;
    app.add_option("--particles", particles, "emitted at most");
    app.add_option("--steps", steps, "moves");
    CLI11_PARSE(app, argc, argv);
    fmt::print("{:<11} {:>9} {:>7} {:>7} | {:>6} {:>6} {:>6} {:>7} {:>6} | {:>6} {:>6} {:>5} {:>6} | {:>7} {:>7} {:>6} | "
               "{:>6} {:>6}\n",
               "scene", "particles", "traced", "most", "scan", "trace", "store", "anew", "ratio", "octree", "first", "cells",
               "KB", "texture", "anew", "ratio", "paths", "all MB");
    for (Moving& m : moving_scenes()) {
        measure(std::move(m), particles, steps);
    }
    return 0;
}
