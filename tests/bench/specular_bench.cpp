// Mirrors, metals and glass of a still view: what the viewport traces over its picture, in time and pixels.
#include "engine/solver/gi_engine.h"
#include "engine/view/specular_pixels.h"
#include "tests/bench/bench_support.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <filesystem>

namespace atrium::bench {
namespace {

struct Arguments {
    std::vector<std::string> files;
    std::string camera;
    std::string quality = "draft";
    int width = 1280;
    int height = 720;
    int repeats = 3;
};

constexpr double kMark = 0.1 * 1280 * 720; // pixels that have to be there within half a second on two cores

double wall_seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Processor and wall seconds from the start of a look to one of its answers.
struct Pass {
    double cpu = 1e30;
    double wall = 1e30;
    int samples = 0;
    std::size_t pixels = 0; ///< that show something specular
};

bool measure(const std::string& file, const Arguments& a) {
    const auto lit = read_lit_scene(file);
    if (!lit) {
        return false;
    }
    const auto camera = find_camera(lit->scene, a.camera);
    GiEngine engine;
    SolveOptions options;
    options.quality = qualities().at(a.quality);
    const auto solution = engine.solve(lit->scene, options, RunContext{});
    if (!solution || !camera) {
        fmt::print(stderr, "{}: {}\n", file, (solution ? camera.error() : solution.error()).message());
        return false;
    }
    const double cpu = cpu_seconds();
    const double wall = wall_seconds();
    const SpecularView view(lit->scene, **solution);
    const double made_cpu = cpu_seconds() - cpu;
    const double made_wall = wall_seconds() - wall;
    std::vector<Pass> passes;
    for (int i = 0; i < a.repeats; ++i) {
        const double from_cpu = cpu_seconds();
        const double from_wall = wall_seconds();
        std::size_t pass = 0;
        view.look(*camera, a.width, a.height, 2, LightShares{}, RunContext{}, [&](const SpecularPixels& pixels) {
            passes.resize(std::max(passes.size(), pass + 1));
            Pass& p = passes[pass++];
            p.cpu = std::min(p.cpu, cpu_seconds() - from_cpu);
            p.wall = std::min(p.wall, wall_seconds() - from_wall);
            p.samples = pixels.samples;
            p.pixels = 0;
            for (const vec4& pixel : pixels.pixels) {
                p.pixels += pixel.w > 0.0F ? 1 : 0;
            }
        });
    }
    const std::string name = std::filesystem::path(file).stem().string();
    for (const Pass& p : passes) {
        const double share = double(p.pixels) / (double(a.width) * double(a.height));
        const double mark = p.pixels > 0 ? p.cpu * kMark / double(p.pixels) : 0.0;
        fmt::print("| {} | {:.3f} ({:.3f}) | {} | {:.1f} % | {:.3f} | {:.3f} | {:.3f} |\n", name, made_cpu, made_wall,
                   p.samples, 100.0 * share, p.cpu, p.wall, mark);
    }
    std::fflush(stdout);
    return true;
}

} // namespace
} // namespace atrium::bench

int main(int argc, char** argv) {
    CLI::App app{"What the viewport traces over its picture at rest: time to each answer, best of the repeats."};
    atrium::bench::Arguments a;
    app.add_option("FILES", a.files, "scenes")->required();
    app.add_option("--camera", a.camera, "name or index");
    app.add_option("--quality", a.quality)->check(CLI::IsMember({"draft", "normal", "fine"}));
    app.add_option("--width", a.width, "pixels")->check(CLI::Range(16, 8192));
    app.add_option("--height", a.height, "pixels")->check(CLI::Range(16, 8192));
    app.add_option("--repeats", a.repeats)->check(CLI::Range(1, 100));
    CLI11_PARSE(app, argc, argv);
    fmt::print("| scene | made in CPU s (wall) | samples | of the view | CPU s | wall s | CPU s for 92,160 pixels |\n"
               "|---|---|---|---|---|---|---|\n");
    bool fine = true;
    for (const std::string& file : a.files) {
        fine = atrium::bench::measure(file, a) && fine;
    }
    return fine ? 0 : 1;
}
