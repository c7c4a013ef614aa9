// A slider as the engine sees it: lamps, sky and paint that change step by step, hurried updates next to new solutions.
#include "engine/io/scene_file.h"
#include "engine/measure/light_difference.h"
#include "engine/solver/gi_engine.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <map>

namespace atrium::bench {
namespace {

double wall() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
double cpu() { return double(std::clock()) / CLOCKS_PER_SEC; }

struct Arguments {
    std::string file;
    std::string quality = "normal";
    std::vector<std::string> edits;
    int steps = 12;
    std::size_t points = 4096;
};

/// Sets the scene to `t` of the way, 0 = as it was.
using Slider = std::function<void(Scene& scene, float t)>;

// "sun F", "sky F", "all F": times F. "lamp NAME R G B": a light or what a material emits, times these. "paint NAME R G B".
Slider make_slider(const Scene& was, const std::string& text) {
    std::vector<std::string> word;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        word.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    const auto number = [&](std::size_t i) { return std::stof(word.at(i)); };
    const std::string kind = word[0], name = word.size() > 4 ? word[1] : "";
    const Rgb to = word.size() > 4 ? Rgb(number(2), number(3), number(4)) : Rgb(number(1));
    return [=](Scene& scene, float t) {
        const Rgb factor = t == 0.0F ? Rgb(1.0F) : Rgb(1.0F) + t * (to - Rgb(1.0F));
        scene.lights.for_each([&](LightId id, const Light& l) {
            const bool sun = kind == "sun" && l.kind == Light::Kind::Directional;
            if (sun || kind == "all" || (kind == "lamp" && l.name == name)) {
                scene.lights.find(id)->color = was.lights.find(id)->color * factor;
            }
        });
        scene.materials.for_each([&](MaterialId id, const Material& m) {
            if ((kind == "lamp" && m.name == name) || kind == "all") {
                scene.materials.find(id)->emissive_color = was.materials.find(id)->emissive_color * factor;
            }
            if (kind == "paint" && m.name == name) {
                const Rgb old = was.materials.find(id)->base_color;
                scene.materials.find(id)->base_color = t == 0.0F ? old : old + t * (to - old);
            }
        });
        if (kind == "sky" || kind == "all") {
            scene.environment.sky_radiance = was.environment.sky_radiance * factor;
        }
    };
}

bool same_light(const Solution& a, const Solution& b) {
    const auto same_maps = [](const auto& x, const auto& y) { return x == y || (x && y && *x == *y); };
    return std::equal(a.surfaces.begin(), a.surfaces.end(), b.surfaces.begin(), b.surfaces.end(),
                      [&](const auto& x, const auto& y) {
                          return x->irradiance_front == y->irradiance_front && x->irradiance_back == y->irradiance_back &&
                                 x->direct_front == y->direct_front && x->direct_back == y->direct_back &&
                                 same_maps(x->direct_map_front, y->direct_map_front) &&
                                 same_maps(x->direct_map_back, y->direct_map_back) && x->caustic_front == y->caustic_front &&
                                 x->caustic_back == y->caustic_back;
                      });
}

int run(const Arguments& a) {
    auto loaded = read_scene(a.file);
    if (!loaded) {
        fmt::print(stderr, "{}\n", loaded.error().message());
        return 1;
    }
    const Scene was = loaded->scene;
    static const std::map<std::string, SolverSettings::Quality> kQualities{{"draft", SolverSettings::Quality::Draft},
                                                                           {"normal", SolverSettings::Quality::Normal},
                                                                           {"fine", SolverSettings::Quality::Fine}};
    SolveOptions options;
    options.quality = kQualities.at(a.quality);
    options.keep_for_updates = true;
    GiEngine engine;
    const auto first = engine.solve(was, options, {});
    if (!first) {
        fmt::print(stderr, "{}\n", first.error().message());
        return 1;
    }
    fmt::print("| scene | quality | edit | new solution s (CPU s) | first update s (CPU s) | update p50 s | p95 s | CPU s | "
               "solution / update | rays, first | rays, p95 | rms, light that follows | rms, light that stays | energy, "
               "follows | back to the bit "
               "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& edit : a.edits) {
        const Slider slide = make_slider(was, edit);
        Scene scene = was;
        std::vector<double> times;
        std::vector<std::uint64_t> rays;
        std::shared_ptr<const Solution> last;
        double first_cpu = 0.0;
        const double start_cpu = cpu();
        for (int i = 1; i <= a.steps; ++i) {
            slide(scene, float(i) / float(a.steps));
            const double before = wall();
            const auto updated = engine.update(scene, options, {});
            times.push_back(wall() - before);
            first_cpu = i == 1 ? cpu() - start_cpu : first_cpu;
            if (!updated) {
                fmt::print(stderr, "{}: {}\n", edit, updated.error().message());
                return 1;
            }
            last = *updated;
            rays.push_back(last->statistics.rays);
        }
        const double updates_cpu = (cpu() - start_cpu - first_cpu) / std::max(a.steps - 1, 1);
        GiEngine other;
        SolveOptions plain = options;
        plain.keep_for_updates = false;
        const double again = wall(), again_cpu = cpu();
        const auto truth = other.solve(scene, plain, {});
        const double solving = wall() - again, solving_cpu = cpu() - again_cpu;
        if (!truth) {
            fmt::print(stderr, "{}\n", truth.error().message());
            return 1;
        }
        const std::vector<SensorPlace> places = seen_places(scene, a.points);
        const auto followed = light_difference(scene, *last, **truth, places);
        const auto stayed = light_difference(scene, **first, **truth, places);
        slide(scene, 0.0F);
        const auto back = engine.update(scene, options, {});
        const double first_time = times.front();
        const std::uint64_t first_rays = rays.front();
        times.erase(times.begin());
        rays.erase(rays.begin());
        std::sort(times.begin(), times.end());
        std::sort(rays.begin(), rays.end());
        const auto late = [](const auto& v) { return v[std::min(v.size() - 1, v.size() * 95 / 100)]; };
        fmt::print("| {} | {} | {} | {:.2f} ({:.2f}) | {:.3f} ({:.3f}) | {:.3f} | {:.3f} | {:.3f} | {:.0f} | {} | {} | "
                   "{:.2f} % | {:.1f} % | {:.2f} % | {} |\n",
                   a.file.substr(a.file.find_last_of('/') + 1), a.quality, edit, solving, solving_cpu, first_time, first_cpu,
                   times[times.size() / 2], late(times), updates_cpu, solving / times[times.size() / 2], first_rays,
                   late(rays), 100.0 * followed.rel_rms, 100.0 * stayed.rel_rms, 100.0 * followed.energy_rel,
                   back && same_light(**back, **first) ? "yes" : "no");
        std::fflush(stdout);
    }
    return 0;
}

} // namespace
} // namespace atrium::bench

int main(int argc, char** argv) {
    CLI::App app{"Changes lamps, sky or paint step by step: hurried updates beside a new solution of where it ends."};
    atrium::bench::Arguments a;
    app.add_option("file", a.file, "scene")->required();
    app.add_option("edits", a.edits, "sun,F; sky,F; all,F; lamp,NAME,R,G,B (factors); paint,NAME,R,G,B (colour)")
        ->required();
    app.add_option("--quality", a.quality)->check(CLI::IsMember({"draft", "normal", "fine"}));
    app.add_option("--steps", a.steps, "2 at least");
    app.add_option("--points", a.points, "where the light is compared");
    CLI11_PARSE(app, argc, argv);
    return atrium::bench::run(a);
}
