// Our side of the comparison with other programs: pictures of a scene solved from nothing and after an object has moved,
// with what each took. Driven by tests/bench/peers/compare.py.
#include "engine/base/parallel.h"
#include "engine/io/image_file.h"
#include "engine/solver/gi_engine.h"
#include "engine/view/still.h"
#include "tests/bench/bench_support.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <filesystem>

namespace atrium::bench {
namespace {

struct Arguments {
    std::string file, node, folder, camera;
    std::vector<double> by{0.0, 0.0, 0.0};
    std::vector<std::string> qualities{"draft", "normal"};
    int steps = 1;
    int width = 640;
    int height = 360;
    unsigned threads = 0;
    unsigned seed = 1;
};

int fail_with(const std::string& message) {
    fmt::print(stderr, "{}\n", message);
    return 1;
}

/// Processor and wall seconds since it was made or asked.
class Watch {
public:
    struct Reading {
        double cpu = 0;
        double wall = 0;
    };
    Reading lap() {
        const Reading now = read();
        const Reading out{now.cpu - last_.cpu, now.wall - last_.wall};
        last_ = now;
        return out;
    }

private:
    static Reading read() {
        return {cpu_seconds(), std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count()};
    }
    Reading last_ = read();
};

/// Draws pictures and prints a line of CSV each.
class Pictures {
public:
    Pictures(const Arguments& a, const ViewCamera& camera) : a_(a), camera_(camera) {
        fmt::print("quality,stage,cpu,wall,still_cpu,rays,file\n");
    }
    Result<void> draw(const std::string& quality, const std::string& stage, const Scene& scene, const Solution& solution,
                      const Watch::Reading& took) {
        StillOptions options;
        options.width = a_.width;
        options.height = a_.height;
        Watch watch;
        const StillLayers still = render_layers(scene, solution, camera_, options, RunContext{});
        const double cpu = watch.lap().cpu;
        const auto path = std::filesystem::path(a_.folder) / fmt::format("{}_{}.exr", quality, stage);
        fmt::print("{},{},{:.4f},{:.4f},{:.4f},{},{}\n", quality, stage, took.cpu, took.wall, cpu, solution.statistics.rays,
                   path.string());
        std::fflush(stdout);
        return write_picture(path, still.beauty(), still.channels());
    }

private:
    const Arguments& a_;
    ViewCamera camera_;
};

/// From nothing, then the object's way in hurried steps, then settled: with `quality`.
Result<void> measure(const Arguments& a, Scene scene, const std::string& quality, NodeId moving, Pictures& pictures) {
    SolveOptions options;
    options.quality = qualities().at(quality);
    options.seed = a.seed;
    options.keep_for_updates = bool(moving);
    GiEngine engine;
    Watch watch;
    std::shared_ptr<const Solution> first;
    Watch::Reading to_first;
    const auto solved = engine.solve(scene, options, RunContext{}, [&](const std::shared_ptr<const Solution>& s) {
        if (!first) {
            first = s;
            Watch since = watch;
            to_first = since.lap();
        }
    });
    if (!solved) {
        return tl::unexpected(solved.error());
    }
    const Watch::Reading took = watch.lap();
    auto done = first->final ? Result<void>{} : pictures.draw(quality, "first", scene, *first, to_first);
    if (done) {
        done = pictures.draw(quality, "solved", scene, **solved, took);
    }
    if (!done || !moving) {
        return done;
    }
    const dvec3 start = scene.nodes.find(moving)->transform.translation;
    Result<std::shared_ptr<const Solution>> light = *solved;
    for (int i = 1; i <= a.steps && light; ++i) {
        const double share = double(i) / double(a.steps);
        scene.nodes.find(moving)->transform.translation = start + share * dvec3(a.by[0], a.by[1], a.by[2]);
        watch.lap();
        light = engine.update(scene, options, RunContext{});
    }
    if (!light) {
        return tl::unexpected(light.error());
    }
    done = pictures.draw(quality, "hurried", scene, **light, watch.lap());
    if (!done) {
        return done;
    }
    options.settle = true;
    watch.lap();
    light = engine.update(scene, options, RunContext{});
    if (!light) {
        return tl::unexpected(light.error());
    }
    return pictures.draw(quality, "settled", scene, **light, watch.lap());
}

int run(const Arguments& a) {
    set_thread_limit(a.threads);
    const auto lit = read_lit_scene(a.file);
    if (!lit) {
        return 1;
    }
    NodeId moving;
    for (const NodeId id : lit->scene.in_tree_order()) {
        if (!moving && !a.node.empty() && lit->scene.nodes.find(id)->name == a.node) {
            moving = id;
        }
    }
    if (!moving && !a.node.empty()) {
        return fail_with(fmt::format("{}: no node \"{}\"", a.file, a.node));
    }
    const auto camera = find_camera(lit->scene, a.camera);
    if (!camera) {
        return fail_with(camera.error().message());
    }
    Pictures pictures(a, *camera);
    for (const std::string& quality : a.qualities) {
        if (auto done = measure(a, lit->scene, quality, moving, pictures); !done) {
            return fail_with(done.error().message());
        }
    }
    return 0;
}

} // namespace
} // namespace atrium::bench

int main(int argc, char** argv) {
    CLI::App app{"Pictures of a scene solved from nothing and after an object has moved, with what each took; CSV."};
    atrium::bench::Arguments a;
    app.add_option("file", a.file, "scene")->required();
    app.add_option("folder", a.folder, "where the pictures go, .exr with their parts")
        ->required()
        ->check(CLI::ExistingDirectory);
    app.add_option("--node", a.node, "name of the object that moves; without one nothing is kept for updates");
    app.add_option("--by", a.by, "metres, in the parent's space")->expected(3);
    app.add_option("--steps", a.steps, "hurried updates on the way; the time is that of the last")
        ->check(CLI::Range(1, 1000));
    app.add_option("--qualities", a.qualities)->delimiter(',')->check(CLI::IsMember({"draft", "normal", "fine"}));
    app.add_option("--camera", a.camera, "name or index");
    app.add_option("--width", a.width, "pixels")->check(CLI::Range(16, 8192));
    app.add_option("--height", a.height, "pixels")->check(CLI::Range(16, 8192));
    app.add_option("--threads", a.threads, "0 = one per core");
    app.add_option("--seed", a.seed);
    CLI11_PARSE(app, argc, argv);
    return atrium::bench::run(a);
}
