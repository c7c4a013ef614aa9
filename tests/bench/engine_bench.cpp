// Where the time of a solve goes, step by step, on a room with furniture. Counters give the floor: rays and links a second.
#include "engine/base/rng.h"
#include "engine/radiosity/indirect_gather.h"
#include "engine/radiosity/links.h"
#include "engine/radiosity/transport.h"
#include "engine/solver/quality.h"
#include "tests/support/rooms.h"

#include <benchmark/benchmark.h>

namespace atrium {
namespace {

Scene furnished_room() {
    Scene scene;
    const MaterialId white = test::add_material(scene, 0.8F);
    const MaterialId grey = test::add_material(scene, 0.4F);
    test::add_room(scene, 5, 2.7F, 6, {grey, white, white, white, white, white});
    test::add_rectangle(scene, "lamp", {2.5, 2.69, 3}, {0, -1, 0}, {1, 0, 0}, 1.2F, 0.3F,
                        test::add_material(scene, 0.5F, 10000));
    for (int i = 0; i < 12; ++i) {
        Shape shape;
        if (i % 3 == 0) {
            shape.geometry = Sphere{0.2F};
        } else {
            shape.geometry = Box{{0.5F, 0.4F + 0.1F * float(i % 4), 0.3F}};
        }
        Node node;
        node.name = "thing " + std::to_string(i);
        node.shape = scene.shapes.insert(shape);
        node.materials = {i % 2 == 0 ? grey : white};
        node.transform.translation = {0.6 + 1.2 * (i % 4), 0.3, 0.8 + 1.8 * (i / 4)};
        scene.roots.push_back(scene.nodes.insert(node));
    }
    return scene;
}

/// One solved room that all benchmarks share.
struct Room {
    Scene scene = furnished_room();
    RayScene rays{scene};
    DirectLight direct{scene, rays};
    QualitySettings quality = quality_settings(SolverSettings::Quality::Normal, rays.bounds().diagonal(), 0.0);
    Hierarchy hierarchy = build_hierarchy(rays, quality.hierarchy);
    LinkSet links{hierarchy};

    Room() {
        for (Element& e : hierarchy.elements) {
            e.radiosity = e.emitted;
        }
        hierarchy.pull_radiosity();
        for (int round = 0; round < 2; ++round) {
            links.refine(hierarchy, rays, quality.refine, RunContext{});
            Transport transport(hierarchy, links.links());
            transport.close_rows(std::vector<std::uint8_t>(transport.leaves().size(), 1));
            solve_radiosity(hierarchy, transport, 1e-4, 200, RunContext{});
        }
    }
    static Room& get() {
        static Room room;
        return room;
    }
};

void build_ray_scene(benchmark::State& state) {
    const Scene scene = furnished_room();
    for (auto _ : state) {
        benchmark::DoNotOptimize(RayScene(scene).triangle_count());
    }
}
BENCHMARK(build_ray_scene)->Unit(benchmark::kMillisecond);

void visibility_between_elements(benchmark::State& state) {
    Room& room = Room::get();
    std::uint32_t i = 0;
    for (auto _ : state) {
        const vec2 u = sobol_owen2(i, 0, 1U);
        const vec2 v = sobol_owen2(i++, 2, 1U);
        const SurfacePoint a = sample_point(room.hierarchy, room.rays, 0, u, false);
        const SurfacePoint b = sample_point(room.hierarchy, room.rays, 0, v, false);
        benchmark::DoNotOptimize(room.rays.transmittance(a.position, b.position));
    }
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(visibility_between_elements);

void transport_sweep(benchmark::State& state) {
    Room& room = Room::get();
    Transport transport(room.hierarchy, room.links.links());
    const std::vector<Rgb> in(transport.leaves().size(), Rgb(1.0F));
    std::vector<Rgb> out;
    for (auto _ : state) {
        transport.apply(in, out);
    }
    state.SetItemsProcessed(state.iterations() * std::int64_t(room.links.links().size()));
    state.counters["links"] = double(room.links.links().size());
}
BENCHMARK(transport_sweep)->Unit(benchmark::kMicrosecond);

void gather_at_a_point(benchmark::State& state) {
    Room& room = Room::get();
    Transport transport(room.hierarchy, room.links.links());
    transport.close_rows(std::vector<std::uint8_t>(transport.leaves().size(), 1));
    solve_radiosity(room.hierarchy, transport, 1e-4, 200, RunContext{});
    const IndirectGather gather(room.hierarchy, room.rays, bright_leaves(room.hierarchy, {}, room.quality.bright_contrast));
    const std::uint64_t before = room.rays.rays_traced();
    std::uint32_t i = 0;
    for (auto _ : state) {
        const SurfacePoint p = sample_point(room.hierarchy, room.rays, 0, sobol_owen2(i++, 0, 7U), false);
        benchmark::DoNotOptimize(gather.irradiance(p.position, p.normal, room.quality.field.reflected));
    }
    state.SetItemsProcessed(state.iterations());
    state.counters["rays_a_point"] = double(room.rays.rays_traced() - before) / double(state.iterations());
}
BENCHMARK(gather_at_a_point)->Unit(benchmark::kMicrosecond);

void whole_solve(benchmark::State& state) {
    const Scene scene = furnished_room();
    const auto quality = SolverSettings::Quality(state.range(0));
    for (auto _ : state) {
        const auto solved = test::solve(scene, quality);
        state.counters["first_picture_s"] = solved.solution->statistics.time.first_picture;
        state.counters["error_estimate"] = solved.solution->statistics.error_estimate;
    }
}
BENCHMARK(whole_solve)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
} // namespace atrium

BENCHMARK_MAIN();
