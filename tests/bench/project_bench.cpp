// A project with its light: how long it takes to save and to open, and how quick the first drag is before and after.
#include "engine/solver/gi_engine.h"
#include "tests/bench/bench_support.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <filesystem>
#include <functional>

namespace atrium::bench {
namespace {

/// Wall and processor time of one step, seconds.
struct Taken {
    double wall = 0;
    double processor = 0;
};
Taken timed(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    const double before = cpu_seconds();
    work();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), cpu_seconds() - before};
}

int fail_with(const std::string& message) {
    fmt::print(stderr, "{}\n", message);
    return 1;
}

NodeId named(const Scene& scene, const std::string& name) {
    NodeId out;
    for (const NodeId id : scene.in_tree_order()) {
        out = !out && scene.nodes.find(id)->name == name ? id : out;
    }
    return out;
}

/// The first hurried update after a node went a little way, in an engine that has complete light of the scene.
std::optional<Taken> first_drag(GiEngine& engine, Scene scene, NodeId node, const dvec3& by, SolveOptions options) {
    scene.nodes.find(node)->transform.translation += by;
    options.hurried = true;
    bool done = false;
    const Taken out = timed([&] { done = engine.update(scene, options, {}).has_value(); });
    return done ? std::optional(out) : std::nullopt;
}

void row(const char* what, const Taken& t) { fmt::print("| {} | {:.3f} | {:.3f} |\n", what, t.wall, t.processor); }

int run(const std::string& file, const std::string& node, const std::string& quality, const std::vector<double>& way) {
    auto lit = read_lit_scene(file);
    if (!lit) {
        return 1;
    }
    const NodeId moving = named(lit->scene, node);
    if (!moving || way.size() != 3) {
        return fail_with(fmt::format("{}: no node \"{}\"", file, node));
    }
    const dvec3 by(way[0], way[1], way[2]);
    SolveOptions options;
    options.quality = qualities().at(quality);
    options.keep_for_updates = true;
    lit->scene.settings.quality = options.quality;
    GiEngine engine;
    std::shared_ptr<const Solution> light;
    const Taken solve = timed([&] { light = engine.solve(lit->scene, options, {}).value_or(nullptr); });
    const auto before = light ? first_drag(engine, lit->scene, moving, by, options) : std::nullopt;
    if (!before) {
        return fail_with("the scene could not be solved, or this node cannot be followed in a hurry");
    }
    const auto project = std::filesystem::temp_directory_path() / fmt::format("atrium_project_bench_{}.atrium", getpid());
    bool written = false;
    const Taken save = timed([&] {
        WriteOptions with;
        with.solution = encode_solution(*light, lit->scene);
        written = write_scene(project, lit->scene, with).has_value();
    });
    std::optional<LoadedScene> opened;
    std::shared_ptr<const Solution> stored;
    const Taken open = timed([&] {
        auto read = read_scene(project);
        if (read) {
            stored = decode_solution(read->solution, read->scene).value_or(nullptr);
            opened = std::move(*read);
        }
    });
    std::error_code ignored;
    const auto bytes = std::filesystem::file_size(project, ignored);
    std::filesystem::remove(project, ignored);
    if (!written || !opened || !stored) {
        return fail_with("the project could not be written and read again");
    }
    // What the editor does after opening, in the background: EngineSession::prepare().
    GiEngine again;
    options.skip_first_picture = true;
    const Taken prepare = timed([&] { (void)again.solve(opened->scene, options, {}); });
    const auto after = first_drag(again, opened->scene, named(opened->scene, node), by, options);
    if (!after) {
        return fail_with("the opened project could not be followed");
    }
    fmt::print("{}: {} quality, {:.1f} MB with its light\n\n| step | wall s | processor s |\n|---|---|---|\n", file, quality,
               double(bytes) / 1e6);
    row("solve", solve);
    row("first drag, before saving", *before);
    row("save with light", save);
    row("open with light", open);
    row("get ready in the background", prepare);
    row("first drag, opened and ready", *after);
    fmt::print("\nfirst drag after opening / before saving: {:.2f} of the processor time, {:.2f} of the wall clock\n",
               after->processor / before->processor, after->wall / before->wall);
    return 0;
}

} // namespace
} // namespace atrium::bench

int main(int argc, char** argv) {
    CLI::App app{"Saves and opens a project with its light, and drags an object before and after."};
    std::string file, node, quality = "draft";
    std::vector<double> by{0.0, 0.0, -0.05};
    app.add_option("file", file, "scene")->required();
    app.add_option("node", node, "name of the node that is dragged")->required();
    app.add_option("--quality", quality)->check(CLI::IsMember({"draft", "normal", "fine"}));
    app.add_option("--by", by, "metres, in the parent's space")->expected(3);
    CLI11_PARSE(app, argc, argv);
    return atrium::bench::run(file, node, quality, by);
}
