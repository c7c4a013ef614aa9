// extreme_probe FILE CASE: reads a hard scene, solves, stops, draws and moves it, and prints what it found as JSON. CASE is
// an entry of cases.json as text. Judging is run's part; a crash, a hang and memory are seen from outside.
#include "engine/io/scene_file.h"
#include "engine/scene/scene_edit.h"
#include "engine/solver/gi_engine.h"
#include "engine/view/still.h"

#include <nlohmann/json.hpp>

#include <atomic>
#include <cstdio>
#include <mutex>
#include <sys/resource.h>
#include <thread>
#include <utility>

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;
using Clock = RunContext::Clock;

/// Seconds of processor time of the whole process.
double cpu_now() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Numbers that light cannot be.
struct Wrong {
    std::uint64_t not_finite = 0, negative = 0;
    void look_at(const Rgb& c) {
        for (const float x : {c.r, c.g, c.b}) {
            not_finite += std::isfinite(x) ? 0 : 1;
            negative += x < 0.0F ? 1 : 0;
        }
    }
    void look_at(double x) {
        not_finite += std::isfinite(x) ? 0 : 1;
        negative += x < 0.0 ? 1 : 0;
    }
};

void look_at(const Solution& solution, Wrong& wrong) {
    for (const auto& layer : solution.surfaces) {
        const DisplayMesh& mesh = *layer->mesh;
        for (const auto* places : {&mesh.positions, &mesh.normals}) {
            for (const vec3& p : *places) {
                wrong.not_finite += is_finite(p) ? 0 : 1;
            }
        }
        for (const bool back : {false, true}) {
            if (back && !layer->has_back()) {
                continue;
            }
            // Light maps and caustic textures are read as a viewer does: at corners and within triangles.
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
                const std::array<std::uint32_t, 3> corner{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
                for (const vec3& weight : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(0.2F, 0.3F, 0.5F)}) {
                    wrong.look_at(irradiance_at(*layer, corner, weight, back));
                }
            }
        }
    }
    const Statistics& s = solution.statistics;
    for (const double x :
         {solution.mean_radiance, s.residual, s.error_estimate, s.energy.emitted, s.energy.absorbed, s.energy.escaped}) {
        wrong.look_at(x);
    }
}

dvec3 vector_of(const Json& json) { return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()}; }

NodeId node_named(const Scene& scene, const std::string& name) {
    NodeId found;
    scene.nodes.for_each([&](NodeId id, const Node& node) { found = node.name == name ? id : found; });
    return found;
}

/// Longest time between a request to stop and the return, in seconds: of the clock or of the processor, whichever is less,
/// for on a busy machine the clock counts what others do.
double slowest_stop(const Scene& scene, const SolveOptions& options, double whole_solve, int count) {
    double slowest = 0.0;
    for (int i = 0; i < count; ++i) {
        RunContext context;
        std::atomic<bool> done = false;
        std::atomic<double> asked_cpu = 0.0;
        std::atomic<Clock::time_point> asked{};
        std::thread watcher([&] {
            const auto due = Clock::now() + std::chrono::duration<double>(whole_solve * (i + 0.5) / count);
            while (!done && Clock::now() < due) {
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
            asked_cpu = cpu_now();
            asked = Clock::now();
            context.stop.request_stop();
        });
        GiEngine engine;
        const auto result = engine.solve(scene, options, context);
        const auto returned = Clock::now();
        const double cpu = cpu_now();
        done = true;
        watcher.join();
        if (result && (*result)->final) {
            continue; // it was done before it was asked
        }
        const double wall = std::chrono::duration<double>(returned - asked.load()).count();
        slowest = std::max(slowest, std::min(wall, cpu - asked_cpu));
    }
    return slowest;
}

/// Longest time within a solve in which nothing asks whether to stop, in seconds: of the clock or of the processor,
/// whichever is less. No stop can take less at the worst moment.
double longest_unasked(const Scene& scene, const SolveOptions& options) {
    constexpr auto kFine = std::chrono::milliseconds(5); // between two looks at the processor's clock, which is slow to read
    std::mutex guard;
    auto asked = Clock::now();
    auto sampled = asked;
    double cpu = cpu_now();
    double longest = 0.0;
    const std::function<bool()> watch = [&] {
        const std::lock_guard lock(guard);
        const auto now = Clock::now();
        const double wall = std::chrono::duration<double>(now - asked).count();
        asked = now;
        if (now - sampled >= kFine) {
            const double then = std::exchange(cpu, cpu_now());
            longest = std::max(longest, std::min(wall, cpu - then));
            sampled = now;
        }
        return false;
    };
    RunContext context;
    context.stop.watch(&watch);
    GiEngine engine;
    (void)engine.solve(scene, options, context);
    watch();
    return longest;
}

Json lux_at(const Json& points, const Scene& scene, const GiEngine& engine, const Solution& solution) {
    Json out = Json::array();
    for (const Json& p : points) {
        const dvec3 at = vector_of(p.at("at")), normal = vector_of(p.at("normal"));
        const SensorReading reading =
            p.value("surface", false) ? read_surface(scene, solution, at, normal) : engine.gather_free(at, normal);
        out.push_back(double(luminance(reading.irradiance)));
    }
    return out;
}

/// Pictures through every camera: what is no number in them.
void look_through_cameras(const Scene& scene, const Solution& solution, Wrong& wrong) {
    for (const NodeId id : scene.in_tree_order()) {
        const Node& node = *scene.nodes.find(id);
        if (const Camera* lens = scene.cameras.find(node.camera)) {
            StillOptions options;
            options.width = 48;
            options.height = 32;
            ViewCamera camera;
            camera.lens = *lens;
            camera.to_world = scene.world_matrix(id);
            for (const vec3& pixel : render_still(scene, solution, camera, options, RunContext{}).pixels) {
                wrong.look_at(pixel);
            }
        }
    }
}

int probe(const std::string& file, const Json& what) {
    Json out;
    auto loaded = read_scene(file);
    if (!loaded) {
        out["refused"] = loaded.error().message();
        std::puts(out.dump().c_str());
        return 0;
    }
    Scene& scene = loaded->scene;
    std::vector<Problem> problems = loaded->problems;
    const auto more = find_problems(scene);
    problems.insert(problems.end(), more.begin(), more.end());
    out["problems"] = Json::array();
    for (const Problem& p : problems) {
        out["problems"].push_back(std::string(severity_name(p.severity)) + ": " + p.where + ": " + p.what);
    }
    out["read_cpu"] = cpu_now();

    SolveOptions options;
    options.quality = SolverSettings::Quality::Draft;
    options.keep_for_updates = what.contains("moves");
    GiEngine engine;
    Wrong wrong;
    const double cpu_before = cpu_now();
    const auto before = Clock::now();
    const auto solved = engine.solve(scene, options, RunContext{}, [&](auto snapshot) { look_at(*snapshot, wrong); });
    if (!solved) {
        out["unsolved"] = solved.error().message();
        std::puts(out.dump().c_str());
        return 0;
    }
    const double wall = std::chrono::duration<double>(Clock::now() - before).count();
    const Solution& solution = **solved;
    out["solve_cpu"] = cpu_now() - cpu_before;
    look_at(solution, wrong);
    out["converged"] = solution.statistics.converged;
    out["defect"] = solution.statistics.energy.defect;
    out["lux"] = lux_at(what.value("points", Json::array()), scene, engine, solution);
    if (what.value("look", true)) {
        look_through_cameras(scene, solution, wrong);
    }
    if (what.contains("moves")) {
        const NodeId id = node_named(scene, what["moves"].at("node").get<std::string>());
        Json after = Json::array();
        for (const Json& place : what["moves"].at("to")) {
            scene.nodes.find(id)->transform.translation = vector_of(place);
            SolveOptions hurry = options;
            hurry.hurried = true;
            const auto updated = engine.update(scene, hurry, RunContext{});
            if (!updated) {
                out["unsolved"] = updated.error().message();
                break;
            }
            look_at(**updated, wrong);
            after.push_back(lux_at(what["moves"].value("points", Json::array()), scene, engine, **updated));
        }
        out["lux_after"] = after;
    }
    const auto encoded = encode_solution(solution, scene);
    const auto decoded = decode_solution(encoded, scene);
    out["kept"] = decoded.has_value();
    if (decoded) {
        look_at(**decoded, wrong);
    }
    out["peak_mib"] = double(peak_resident_bytes()) / (1024.0 * 1024.0);
    out["stop"] = slowest_stop(scene, options, wall, what.value("stops", 6));
    out["unasked"] = longest_unasked(scene, options);
    out["not_finite"] = wrong.not_finite;
    out["negative"] = wrong.negative;
    std::puts(out.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
    return 0;
}

} // namespace
} // namespace atrium

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: extreme_probe FILE CASE\n", stderr);
        return 1;
    }
    return atrium::probe(argv[1], atrium::Json::parse(argv[2]));
}
