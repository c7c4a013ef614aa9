#include "tests/bench/accuracy_curve.h"

#include "tests/bench/bench_support.h"

#include <algorithm>
#include <limits>

namespace atrium::bench {
namespace {

struct Rung {
    const char* quality;
    double target; // relative error asked for; 0 = what the quality stands for
};
// From the cheapest to the dearest.
constexpr Rung kLadder[] = {{"draft", 0.4},  {"draft", 0.2},    {"draft", 0.0}, {"normal", 0.1},
                            {"normal", 0.0}, {"normal", 0.025}, {"fine", 0.04}, {"fine", 0.0}};
constexpr double kGoals[] = {0.10, 0.05, 0.02};

/// A picture and what had been spent when it was there.
struct Picture {
    std::shared_ptr<const Solution> solution;
    double cpu = 0; ///< seconds
    double wall = 0;
};

/// The least that was spent on a picture within a goal.
struct Best {
    double cpu = std::numeric_limits<double>::infinity();
    double wall = 0;
    std::string how;
};

} // namespace

const char* curve_csv_header() {
    return "scene,quality,target,picture,wall_seconds,cpu_seconds,rms,p50,bias,error_estimate\n";
}

bool print_curve(const std::string& name, const Scene& scene, const std::vector<Probe>& probes, std::uint32_t seed,
                 double limit, std::string& csv) {
    std::vector<SensorPlace> places;
    for (const Probe& p : probes) {
        places.push_back(p.place);
    }
    Best by_rms[std::size(kGoals)];
    Best by_median[std::size(kGoals)];
    for (const Rung& rung : kLadder) {
        const std::string target = rung.target > 0.0 ? fmt::format("{:g} %", 100.0 * rung.target) : "usual";
        std::vector<Picture> pictures;
        RunContext context;
        const auto start = RunContext::Clock::now();
        if (limit > 0.0) {
            context.deadline =
                start + std::chrono::duration_cast<RunContext::Clock::duration>(std::chrono::duration<double>(limit));
        }
        SolveOptions options;
        options.quality = qualities().at(rung.quality);
        options.target_error = rung.target;
        options.seed = seed;
        GiEngine engine;
        const double before = cpu_seconds();
        const auto solved = engine.solve(scene, options, context, [&](const std::shared_ptr<const Solution>& picture) {
            pictures.push_back(
                {picture, cpu_seconds() - before, std::chrono::duration<double>(RunContext::Clock::now() - start).count()});
        });
        if (!solved && !context.should_stop()) {
            fmt::print(stderr, "{}: {}\n", name, solved.error().message());
            return false;
        }
        for (const Picture& picture : pictures) {
            std::vector<double> unused;
            const Row row = compare(probes, read_surfaces(scene, *picture.solution, places), unused);
            const char* which = picture.solution->final ? "final" : "first";
            const double own = picture.solution->statistics.error_estimate;
            fmt::print("| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} % | {:.2f} % | {:+.2f} % | {:.2f} % |\n", name,
                       rung.quality, target, which, picture.cpu, picture.wall, 100.0 * row.rms, 100.0 * row.p50,
                       100.0 * row.bias, 100.0 * own);
            csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", name, rung.quality, rung.target, which, picture.wall,
                               picture.cpu, row.rms, row.p50, row.bias, own);
            for (std::size_t g = 0; g < std::size(kGoals); ++g) {
                const auto note = [&](double error, Best& best) {
                    if (error <= kGoals[g] && picture.cpu < best.cpu) {
                        best = {picture.cpu, picture.wall, fmt::format("{} {}, {}", rung.quality, target, which)};
                    }
                };
                note(row.rms, by_rms[g]);
                note(row.p50, by_median[g]);
            }
        }
        std::fflush(stdout);
        if (pictures.empty() || !pictures.back().solution->final) {
            fmt::print("| {} | {} | {} | not done in {:.0f} s |\n", name, rung.quality, target, limit);
            break;
        }
    }
    const auto say = [&](const char* what, const Best& best, double goal) {
        if (std::isfinite(best.cpu)) {
            fmt::print("{}: {} within {:.0f} % after {:.2f} s of processor time, {:.2f} s of wall clock ({})\n", name, what,
                       100.0 * goal, best.cpu, best.wall, best.how);
        } else {
            fmt::print("{}: {} within {:.0f} %: not reached\n", name, what, 100.0 * goal);
        }
    };
    fmt::print("\n");
    for (std::size_t g = 0; g < std::size(kGoals); ++g) {
        say("rms", by_rms[g], kGoals[g]);
        say("median", by_median[g], kGoals[g]);
    }
    fmt::print("\n");
    std::fflush(stdout);
    return true;
}

} // namespace atrium::bench
