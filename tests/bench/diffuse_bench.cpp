// Diffuse light against what it stands on and against itself: rays and memory, threads, triangles, qualities.
#include "tests/bench/bench_support.h"
#include "tests/bench/floor_bench.h"
#include "tests/bench/solve_bench.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <functional>

namespace {

struct Arguments {
    std::vector<std::string> only{"rays", "steps", "threads", "triangles", "qualities"};
    std::string shipped = ATRIUM_SOURCE_DIR "/scenes/sunlit_room/sunlit_room.gltf";
    std::vector<std::string> scenes;
    std::vector<std::string> quality_names{"draft", "normal", "fine"};
    std::size_t most_triangles = 1'000'000;
    double limit = 600.0;
    int repeats = 3;
};

int run(Arguments a) {
    using namespace atrium::bench;
    if (a.scenes.empty()) {
        const std::string interiors = ATRIUM_SHARED_DIR "/scenes/interiors/";
        a.scenes = {a.shipped, interiors + "cornell_box.glb", interiors + "office_b90.glb",
                    interiors + "wooden_staircase.glb"};
    }
    const auto wanted = [&](const char* section) {
        return std::find(a.only.begin(), a.only.end(), section) != a.only.end();
    };
    // The engine's threads belong to the process that started them: this one must never use it.
    bool fine = true;
    const auto alone = [&](const std::function<void()>& print) {
        fine = in_own_process<bool>([&] {
                   print();
                   return true;
               }).has_value() &&
               fine;
    };
    if (wanted("rays")) {
        fmt::print("\n## Rays, one thread\n\n");
        alone([&] { print_ray_floor(a.shipped); });
    }
    if (wanted("steps")) {
        fmt::print("\n## Steps, one thread\n\n");
        alone([&] { print_step_floor(a.shipped); });
    }
    if (wanted("threads")) {
        fmt::print("\n## Threads\n\n");
        print_scaling(a.shipped, a.repeats);
    }
    if (wanted("triangles")) {
        fmt::print("\n## The same room in more triangles\n\n");
        print_tessellation(a.most_triangles, a.limit);
    }
    if (wanted("qualities")) {
        fmt::print("\n## Qualities\n\n");
        print_qualities(a.scenes, a.quality_names, a.limit);
    }
    return fine ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    Arguments a;
    CLI::App app("Diffuse light: rays and steps as shares of their floor, threads, triangles, qualities. Prints Markdown.");
    app.add_option("--only", a.only, "Of rays,steps,threads,triangles,qualities")
        ->delimiter(',')
        ->check(CLI::IsMember({"rays", "steps", "threads", "triangles", "qualities"}));
    app.add_option("--scenes", a.scenes,
                   "Scenes of the table of qualities (default: the one that ships, three shared interiors)")
        ->delimiter(',');
    app.add_option("--quality", a.quality_names, "Of draft,normal,fine")
        ->delimiter(',')
        ->check(CLI::IsMember({"draft", "normal", "fine"}));
    app.add_option("--triangles", a.most_triangles, "Of the finest room at most");
    app.add_option("--limit", a.limit, "Seconds of wall clock after which a solve is stopped");
    app.add_option("--repeats", a.repeats, "Solves for each number of threads")->check(CLI::Range(1, 100));
    CLI11_PARSE(app, argc, argv);
    return run(std::move(a));
}
