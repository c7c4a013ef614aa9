// How far the engine's light is from brute force, scene by scene: a table, a line of CSV each, and the worst points.
#include "engine/base/parallel.h"
#include "engine/measure/error_audit.h"
#include "tests/bench/accuracy_curve.h"
#include "tests/bench/bench_support.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <fstream>
#include <numeric>

namespace atrium::bench {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::vector<std::string> files;
    std::vector<std::string> quality_names{"draft", "normal", "fine"};
    ReferenceOptions reference;
    std::string out;
    std::string worst;
    std::size_t worst_count = 50;
    bool reference_only = false;
    bool curve = false;
    bool no_audit = false;
    double limit = 0.0;
    unsigned threads = 0;
    std::uint32_t seed = 1;
};

/// A scene with its reference, without the places that nobody sees.
struct Case {
    std::string name;
    Scene scene;
    Reference reference;
    std::size_t dropped = 0; ///< places left out
};

std::optional<Case> read_case(const std::string& file, const ReferenceOptions& options) {
    auto lit = read_lit_scene(file);
    if (!lit) {
        return std::nullopt;
    }
    Case out;
    out.name = fs::path(file).stem().string();
    out.scene = std::move(lit->scene);
    if (!get_reference(file, out.scene, lit->daylight, options, out.reference)) {
        return std::nullopt;
    }
    const std::size_t picked = out.reference.probes.size();
    drop_dark(out.reference.probes);
    out.dropped = picked - out.reference.probes.size();
    return out;
}

std::string worst_points(const std::string& scene, const std::string& quality, const std::vector<Probe>& probes,
                         const std::vector<SensorReading>& readings, const std::vector<double>& relative,
                         std::size_t count) {
    std::vector<std::size_t> order(probes.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return std::abs(relative[a]) > std::abs(relative[b]); });
    std::string out;
    for (std::size_t k = 0; k < std::min(count, order.size()); ++k) {
        const std::size_t i = order[k];
        const Probe& p = probes[i];
        out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", scene, quality, p.place.point.x, p.place.point.y,
                           p.place.point.z, p.place.normal.x, p.place.normal.y, p.place.normal.z, p.node,
                           luminance(readings[i].irradiance), luminance(p.irradiance), p.standard_error, relative[i]);
    }
    return out;
}

const char* header() {
    return "Relative difference of a point: (E - R) / max(R, 5 % of the mean R). rms: root of its mean square, less the "
           "reference's own\nvariance, +- its standard error; bias: of the mean. Points are spread evenly over the area; "
           "'seen' leaves out\ngaps that nobody looks into. "
           "'noise' is the reference's rms standard error. audit: what the program\nitself measures of 'seen', with its "
           "bounds of 95 %, whether these hold, and what it took.\n";
}

void print_reference(const Case& c) {
    std::vector<double> unused;
    std::vector<SensorReading> same;
    for (const Probe& p : c.reference.probes) {
        same.push_back({p.irradiance, 0.0, true});
    }
    fmt::print("{:<24} reference of {} points ({} more are covered), {:.0f} paths each, rms noise {:.2f} %\n", c.name,
               c.reference.probes.size(), c.dropped, c.reference.paths,
               100.0 * compare(c.reference.probes, same, unused).noise);
    std::fflush(stdout);
}

/// Solves at one quality and prints its line; false when it cannot be solved.
bool print_row(const Case& c, const std::string& quality, const Arguments& a, std::string& csv, std::string& worst) {
    GiEngine engine;
    SolveOptions options;
    options.quality = qualities().at(quality);
    options.seed = a.seed;
    const double before = cpu_seconds();
    const auto solution = engine.solve(c.scene, options, RunContext{});
    const double cpu = cpu_seconds() - before;
    if (!solution) {
        fmt::print(stderr, "{}: {}\n", c.name, solution.error().message());
        return false;
    }
    std::vector<SensorPlace> places;
    for (const Probe& p : c.reference.probes) {
        places.push_back(p.place);
    }
    const auto readings = read_surfaces(c.scene, **solution, places);
    std::vector<double> relative;
    const Row row = compare(c.reference.probes, readings, relative);
    const Statistics& s = (*solution)->statistics;
    ErrorAudit audit;
    if (!a.no_audit) {
        audit = audit_error(c.scene, **solution, audit_settings(options.quality), RunContext{}).value_or(ErrorAudit{});
    }
    const bool holds = audit.low <= row.rms_seen && row.rms_seen <= audit.high;
    fmt::print("{:<24} {:<6} {:>8.2f} {:>8.2f} {:>7.1f} {:>6.2f}% {:>6.2f}% {:>5.2f}% {:>+6.2f}% {:>6.2f}% {:>6.2f}% "
               "{:>6.1f}% {:>6.2f}% {:>6.2f}% {:>6.2f}% {:<3} {:>6.2f} {:>6} {:>6} {:>6.2f}%\n",
               c.name, quality, s.time.solve, cpu, 1e-6 * double(s.rays), 100 * row.rms, 100 * row.rms_seen,
               100 * row.rms_spread, 100 * row.bias, 100 * row.p50, 100 * row.p95, 100 * row.p99, 100 * audit.rms,
               100 * audit.low, 100 * audit.high, holds ? "yes" : "no", audit.seconds, row.points, row.unread,
               100 * row.noise);
    std::fflush(stdout);
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", c.name, quality, s.time.solve,
                       cpu, row.rms, row.rms_seen, row.rms_spread, row.bias, row.p50, row.p95, row.p99, audit.rms, audit.low,
                       audit.high, audit.seconds, row.points, c.dropped, row.unread, row.noise, row.reference_bias,
                       c.reference.paths);
    worst += worst_points(c.name, quality, c.reference.probes, readings, relative, a.worst_count);
    return true;
}

int run(const Arguments& a) {
    if (a.threads != 0) {
        set_thread_limit(a.threads);
    }
    if (!a.reference.cache.empty()) {
        fs::create_directories(a.reference.cache);
    }
    std::string csv = "scene,quality,solve_seconds,cpu_seconds,rms,rms_seen,rms_spread,bias,p50,p95,p99,audit,audit_low,"
                      "audit_high,audit_seconds,"
                      "points,covered,unread,"
                      "reference_noise,reference_mean_noise,reference_paths\n";
    std::string worst = "scene,quality,x,y,z,nx,ny,nz,node,E,R,stderr,relative\n";
    fmt::print("{}", header());
    if (a.curve) {
        csv = curve_csv_header();
        fmt::print("\n| scene | quality | target | picture | cpu s | wall s | rms | p50 | bias | own estimate |\n"
                   "|---|---|---|---|---|---|---|---|---|---|\n");
    } else {
        fmt::print(
            "{:<24} {:<6} {:>8} {:>8} {:>7} {:>7} {:>7} {:>6} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:<3} {:>6} {:>6} "
            "{:>6} {:>7}\n",
            "scene", "qual.", "solve s", "cpu s", "Mrays", "rms", "seen", "+-", "bias", "p50", "p95", "p99", "audit", "low",
            "high", "in", "s", "points", "unread", "noise");
    }
    bool fine = true;
    for (const std::string& file : a.files) {
        const std::optional<Case> c = read_case(file, a.reference);
        if (!c) {
            fine = false;
        } else if (a.reference_only) {
            print_reference(*c);
        } else if (a.curve) {
            fine = print_curve(c->name, c->scene, c->reference.probes, a.seed, a.limit, csv) && fine;
        } else {
            for (const std::string& quality : a.quality_names) {
                fine = print_row(*c, quality, a, csv, worst) && fine;
            }
        }
    }
    if (!a.out.empty()) {
        std::ofstream(a.out) << csv;
    }
    if (!a.worst.empty()) {
        std::ofstream(a.worst) << worst;
    }
    return fine ? 0 : 1;
}

/// Every scene that ships and every shared interior.
std::vector<std::string> default_scenes() {
    std::vector<std::string> out;
    for (const fs::path& folder :
         {fs::path(ATRIUM_SOURCE_DIR) / "scenes", fs::path(ATRIUM_SHARED_DIR) / "scenes/interiors"}) {
        std::error_code absent;
        for (const auto& entry : fs::recursive_directory_iterator(folder, absent)) {
            const std::string extension = entry.path().extension().string();
            if (extension == ".gltf" || extension == ".glb") {
                out.push_back(entry.path().string());
            }
        }
    }
    std::sort(out.begin(), out.end());
    return out;
}

/// Three that differ: a box, an office full of furniture, sun through a window.
std::vector<std::string> curve_scenes() {
    const fs::path interiors = fs::path(ATRIUM_SHARED_DIR) / "scenes/interiors";
    std::vector<std::string> out = {std::string(ATRIUM_SOURCE_DIR) + "/scenes/sunlit_room/sunlit_room.gltf"};
    for (const char* name : {"cornell_box.glb", "office_b90.glb"}) {
        if (fs::exists(interiors / name)) {
            out.push_back((interiors / name).string());
        } else {
            fmt::print("{}: left out, the file is not there\n", (interiors / name).string());
        }
    }
    return out;
}

} // namespace
} // namespace atrium::bench

int main(int argc, char** argv) {
    atrium::bench::Arguments a;
    CLI::App app("The engine's light against brute force, at random points of every diffuse surface.");
    app.add_option("FILE", a.files, "Scenes (default: all that ship and all shared interiors)");
    app.add_option("--quality", a.quality_names, "Of draft,normal,fine")
        ->delimiter(',')
        ->check(CLI::IsMember({"draft", "normal", "fine"}));
    app.add_option("--cache", a.reference.cache, "Folder that keeps references, by a hash of the scene's files");
    app.add_option("--points", a.reference.points, "Points per scene")->check(CLI::Range(1, 1000000));
    app.add_option("--time", a.reference.time, "Seconds for the reference of a scene that is not in the cache");
    app.add_flag("--extend", a.reference.extend, "Spend that time on cached references as well, which makes them better");
    app.add_flag("--reference-only", a.reference_only, "Make references, solve nothing");
    app.add_flag("--no-audit", a.no_audit,
                 "Leave out what the program says of its own error, which takes a part of the time");
    app.add_flag("--curve", a.curve, "Error against time on a ladder of qualities (default: on three scenes)");
    app.add_option("--limit", a.limit, "Seconds of wall clock after which a ladder ends, 0 = none");
    app.add_option("-o,--output", a.out, "CSV with one line per scene and quality");
    app.add_option("--worst", a.worst, "CSV of the points with the largest differences");
    app.add_option("--worst-count", a.worst_count, "How many of them per scene and quality");
    app.add_option("--threads", a.threads, "Worker threads, 0 = one per core");
    app.add_option("--seed", a.seed, "Of the engine");
    CLI11_PARSE(app, argc, argv);
    if (a.files.empty()) {
        a.files = a.curve ? atrium::bench::curve_scenes() : atrium::bench::default_scenes();
    }
    return atrium::bench::run(a);
}
