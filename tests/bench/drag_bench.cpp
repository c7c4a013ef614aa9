// A drag as the engine sees it: hurried updates next to whole new solutions, in time, rays and error.
#include "engine/measure/drag_measure.h"
#include "tests/bench/bench_support.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace atrium::bench {
namespace {

struct Arguments {
    std::string file, node;
    std::string quality = "normal";
    std::vector<double> by{0.03, 0.0, 0.02};
    std::vector<double> lamp;
    bool night = false;
    bool add = false;
    int steps = 12;
    std::size_t points = 4096;
};

int fail_with(const std::string& message) {
    fmt::print(stderr, "{}\n", message);
    return 1;
}

int run(const Arguments& a) {
    auto loaded = read_scene(a.file);
    if (!loaded) {
        return fail_with(loaded.error().message());
    }
    Scene& scene = loaded->scene;
    if (a.night) {
        scene.environment.sky_radiance = Rgb(0.0F);
        for (const LightId id : scene.lights.keys()) {
            Light& light = *scene.lights.find(id);
            light.enabled = light.enabled && light.kind != Light::Kind::Directional;
        }
    }
    if (a.lamp.size() == 3) {
        constexpr float kLumen = 800.0F;
        Light light;
        light.intensity = kLumen / (4.0F * kPi);
        Node node;
        node.name = a.node;
        node.light = scene.lights.insert(light);
        node.transform.translation = dvec3(a.lamp[0], a.lamp[1], a.lamp[2]);
        scene.roots.push_back(scene.nodes.insert(node));
    }
    NodeId moving;
    for (const NodeId id : scene.in_tree_order()) {
        if (!moving && scene.nodes.find(id)->name == a.node) {
            moving = id;
        }
    }
    if (!moving || a.by.size() != 3 || a.steps < 1) {
        return fail_with(fmt::format("{}: no node \"{}\", or no step", a.file, a.node));
    }
    scene.nodes.find(moving)->visible = !a.add;
    std::vector<dvec3> positions;
    for (int i = 1; i <= a.steps; ++i) {
        positions.push_back(scene.nodes.find(moving)->transform.translation + double(i) * dvec3(a.by[0], a.by[1], a.by[2]));
    }
    SolveOptions options;
    options.quality = qualities().at(a.quality);
    const auto drag = measure_drag(scene, moving, positions, options, 1, a.points, {});
    if (!drag) {
        return fail_with(drag.error().message());
    }
    std::uint64_t rays = 0;
    double share = 0.0;
    for (const DragFrame& frame : drag->frames) {
        rays = std::max(rays, frame.rays);
        share = std::max(share, frame.update.particles_share);
    }
    const FrameError& end = *drag->frames.back().error;
    const double median = drag->frame_seconds(0.5);
    fmt::print(
        "| scene | moved | quality | new solution s | update p50 s | p95 s | solution / update | rays of a solution's | "
        "particles traced | rms, light that follows | rms, light that stays "
        "| settled s | rms |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    fmt::print("| {} | {} | {} | {:.2f} ({:.2f} with what updates keep) | {:.3f} | {:.3f} | {:.0f} | {:.2f} % | {:.2f} % | "
               "{:.1f} % | {:.1f} % | {:.2f} | {:.2f} % |\n",
               a.file.substr(a.file.find_last_of('/') + 1), a.node, a.quality, end.fresh_seconds, drag->solve_seconds,
               median, drag->frame_seconds(0.95), end.fresh_seconds / median,
               100.0 * double(rays) / double(drag->solved.rays), 100.0 * share, 100.0 * end.followed.rel_rms,
               100.0 * end.stayed, end.settle_seconds, 100.0 * end.settled.rel_rms);
    return 0;
}

} // namespace
} // namespace atrium::bench

int main(int argc, char** argv) {
    CLI::App app{"Moves an object step by step: hurried updates beside a new solution of where it ends."};
    atrium::bench::Arguments a;
    app.add_option("file", a.file, "scene")->required();
    app.add_option("node", a.node, "name of the node that moves")->required();
    app.add_option("--quality", a.quality)->check(CLI::IsMember({"draft", "normal", "fine"}));
    app.add_option("--by", a.by, "metres per step, in the parent's space")->expected(3);
    app.add_option("--lamp", a.lamp, "first adds a point light of 800 lm there, of the name of the node that moves")
        ->expected(3);
    app.add_flag("--add", a.add, "the node is not there when all is solved, but comes with the first step");
    app.add_flag("--night", a.night, "without sun and sky");
    app.add_option("--steps", a.steps);
    app.add_option("--points", a.points, "where the light is compared");
    CLI11_PARSE(app, argc, argv);
    return atrium::bench::run(a);
}
