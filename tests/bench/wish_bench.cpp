// Whether wishes are kept: an error asked for against what a second look finds, a time asked for against the clock.
#include "engine/base/parallel.h"
#include "engine/measure/error_audit.h"
#include "engine/measure/wished_solve.h"
#include "tests/bench/bench_support.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <filesystem>

namespace atrium::bench {
namespace {

struct Arguments {
    std::vector<std::string> files;
    std::vector<double> errors{0.2, 0.1, 0.05};
    std::vector<double> times{1.0, 3.0, 10.0};
    unsigned threads = 0;
    unsigned seed = 1;
};

struct Kept {
    int errors = 0, errors_of = 0;
    int times = 0, times_of = 0;
    int late = 0; ///< of the times: more than a fifth too long
};

using Clock = RunContext::Clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The error by places and paths that the wish did not look at.
std::string second_look(const Scene& scene, const Solution& light, unsigned seed, double* rms = nullptr) {
    AuditSettings settings = audit_settings(SolverSettings::Quality::Fine);
    settings.seed = seed + 1000;
    const auto found = audit_error(scene, light, settings, RunContext{});
    if (!found) {
        return "not known";
    }
    if (rms != nullptr) {
        *rms = found->rms;
    }
    return fmt::format("{:.1f} % ({:.1f} to {:.1f})", 100.0 * found->rms, 100.0 * found->low, 100.0 * found->high);
}

bool measure(const std::string& file, const Arguments& a, Kept& kept) {
    const auto lit = read_lit_scene(file);
    if (!lit) {
        return false;
    }
    const std::string name = std::filesystem::path(file).stem().string();
    SolveOptions options;
    options.seed = a.seed;
    for (const double error : a.errors) {
        GiEngine engine;
        const double cpu = cpu_seconds();
        const auto light = solve_to_wish(engine, lit->scene, options, {.error = error, .audit = true}, RunContext{});
        if (!light) {
            fmt::print(stderr, "{}: {}\n", file, light.error().message());
            return false;
        }
        const double took = cpu_seconds() - cpu;
        double got = 0.0;
        const std::string look = second_look(lit->scene, **light, a.seed, &got);
        const Statistics& s = (*light)->statistics;
        kept.errors += got <= error ? 1 : 0;
        ++kept.errors_of;
        fmt::print("| {} | {:.0f} % | {} | {:.1f} % | {} | {} | {:.2f} |\n", name, 100.0 * error, s.quality,
                   100.0 * s.error_estimate, look,
                   got <= error ? "yes" : (s.error_estimate > error ? "no, and says so" : "no"), took);
        std::fflush(stdout);
    }
    for (const double time : a.times) {
        GiEngine engine;
        RunContext context;
        const double cpu = cpu_seconds();
        const Clock::time_point start = Clock::now();
        context.deadline = start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time));
        const auto light = solve_to_wish(engine, lit->scene, options, {.best_in_time = true}, context);
        const double took = seconds_since(start);
        const double spent = cpu_seconds() - cpu;
        ++kept.times_of;
        kept.late += took > 1.2 * time ? 1 : 0;
        kept.times += took <= 1.2 * time && light && (*light)->final ? 1 : 0;
        if (!light) {
            fmt::print("| {} | {:g} s | nothing | {} | | {:.2f} s | {:.2f} |\n", name, time, light.error().what, took,
                       spent);
            continue;
        }
        fmt::print("| {} | {:g} s | {} | {} | {} | {:.2f} s | {:.2f} |\n", name, time, (*light)->statistics.quality,
                   (*light)->final ? "complete" : "first picture", second_look(lit->scene, **light, a.seed), took, spent);
        std::fflush(stdout);
    }
    return true;
}

} // namespace
} // namespace atrium::bench

int main(int argc, char** argv) {
    CLI::App app{"Solves scenes for wishes and tells whether they are kept: errors by a second audit, times by the clock."};
    atrium::bench::Arguments a;
    app.add_option("FILES", a.files, "scenes")->required();
    app.add_option("--errors", a.errors, "relative, as 0.05; 0 for none")->delimiter(',');
    app.add_option("--times", a.times, "seconds; 0 for none")->delimiter(',');
    app.add_option("--threads", a.threads, "0 = one per core");
    app.add_option("--seed", a.seed);
    CLI11_PARSE(app, argc, argv);
    std::erase(a.errors, 0.0);
    std::erase(a.times, 0.0);
    atrium::set_thread_limit(a.threads);
    fmt::print("| scene | asked | quality | said | second look | kept, or took | CPU s |\n|---|---|---|---|---|---|---|\n");
    atrium::bench::Kept kept;
    bool fine = true;
    for (const std::string& file : a.files) {
        fine = atrium::bench::measure(file, a, kept) && fine;
    }
    fmt::print("\nerrors: {} of {} kept. Times: {} of {} kept with complete light, {} more than a fifth late.\n",
               kept.errors, kept.errors_of, kept.times, kept.times_of, kept.late);
    return fine ? 0 : 1;
}
