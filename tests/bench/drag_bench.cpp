// A drag as the engine sees it: hurried updates next to whole new solutions, in time, rays and error.
#include "engine/io/scene_file.h"
#include "engine/measure/light_difference.h"
#include "engine/solver/gi_engine.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>

namespace atrium::bench {
namespace {

double wall() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct Arguments {
    std::string file, node;
    std::string quality = "normal";
    std::vector<double> by{0.03, 0.0, 0.02};
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
    NodeId moving;
    for (const NodeId id : scene.in_tree_order()) {
        if (!moving && scene.nodes.find(id)->name == a.node) {
            moving = id;
        }
    }
    if (!moving || a.by.size() != 3 || a.steps < 1) {
        return fail_with(fmt::format("{}: no node \"{}\", or no step", a.file, a.node));
    }
    static const std::map<std::string, SolverSettings::Quality> kQualities{{"draft", SolverSettings::Quality::Draft},
                                                                           {"normal", SolverSettings::Quality::Normal},
                                                                           {"fine", SolverSettings::Quality::Fine}};
    SolveOptions options;
    options.quality = kQualities.at(a.quality);
    options.keep_for_updates = true;
    GiEngine engine;
    const double start = wall();
    const auto first = engine.solve(scene, options, {});
    const double solving = wall() - start;
    if (!first) {
        return fail_with(first.error().message());
    }
    std::vector<double> times;
    std::shared_ptr<const Solution> last;
    std::uint64_t rays = 0;
    double share = 0.0;
    for (int i = 0; i < a.steps; ++i) {
        scene.nodes.find(moving)->transform.translation += dvec3(a.by[0], a.by[1], a.by[2]);
        const double before = wall();
        const auto updated = engine.update(scene, options, {});
        times.push_back(wall() - before);
        if (!updated) {
            return fail_with(updated.error().message());
        }
        last = *updated;
        rays = std::max(rays, last->statistics.rays);
        share = std::max(share, last->statistics.update.particles_share);
    }
    // Let go: the light that is as good as new.
    options.settle = true;
    const double released = wall();
    const auto settled = engine.update(scene, options, {});
    const double settling = wall() - released;
    if (!settled) {
        return fail_with(settled.error().message());
    }
    options.settle = false;
    GiEngine other;
    options.keep_for_updates = false;
    const double again = wall();
    const auto truth = other.solve(scene, options, {});
    const double resolving = wall() - again;
    if (!truth) {
        return fail_with(truth.error().message());
    }
    std::sort(times.begin(), times.end());
    const double median = times[times.size() / 2], late = times[std::min(times.size() - 1, times.size() * 95 / 100)];
    fmt::print(
        "| scene | moved | quality | new solution s | update p50 s | p95 s | solution / update | rays of a solution's | "
        "particles traced | rms, light that follows | rms, light that stays "
        "| settled s | rms |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    const double followed = light_difference(scene, *last, **truth, a.points).rel_rms;
    const double stayed = light_difference(scene, **first, **truth, a.points).rel_rms;
    fmt::print("| {} | {} | {} | {:.2f} ({:.2f} with what updates keep) | {:.3f} | {:.3f} | {:.0f} | {:.2f} % | {:.2f} % | "
               "{:.1f} % | "
               "{:.1f} % | {:.2f} | {:.2f} % |\n",
               a.file.substr(a.file.find_last_of('/') + 1), a.node, a.quality, resolving, solving, median, late,
               resolving / median, 100.0 * double(rays) / double((*truth)->statistics.rays), 100.0 * share, 100.0 * followed,
               100.0 * stayed, settling, 100.0 * light_difference(scene, **settled, **truth, a.points).rel_rms);
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
    app.add_option("--steps", a.steps);
    app.add_option("--points", a.points, "where the light is compared");
    CLI11_PARSE(app, argc, argv);
    return atrium::bench::run(a);
}
