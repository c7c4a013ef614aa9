#include "tests/bench/solve_bench.h"

#include "engine/base/parallel.h"
#include "engine/solver/gi_engine.h"
#include "tests/bench/bench_support.h"
#include "tests/bench/tessellated_room.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <functional>

namespace atrium::bench {
namespace {

/// What one solve took and made, as it comes back from its process.
struct Figures {
    struct Phase {
        std::array<char, 24> name{};
        double wall = 0;
        double cpu = 0;
    };
    bool finished = false;
    double wall = 0, cpu = 0;             ///< seconds
    double first_wall = 0, first_cpu = 0; ///< until the first picture
    double error = 0;                     ///< the engine's own estimate
    std::uint64_t triangles = 0, elements = 0, links = 0, records = 0, rays = 0;
    std::uint64_t peak = 0;   ///< bytes, of the whole process
    std::uint64_t before = 0; ///< the same before the solve: the scene as read
    std::array<Phase, 16> phases{};
    std::size_t phase_count = 0;
};

Figures solve_scene(const Scene& scene, SolverSettings::Quality quality, unsigned threads, double limit) {
    set_thread_limit(threads);
    Figures out;
    out.before = peak_resident_bytes();
    GiEngine engine;
    SolveOptions options;
    options.quality = quality;
    RunContext context;
    if (limit > 0.0) {
        context.deadline = RunContext::Clock::now() +
                           std::chrono::duration_cast<RunContext::Clock::duration>(std::chrono::duration<double>(limit));
    }
    const double before = cpu_seconds();
    const auto solution = engine.solve(scene, options, context, [&](const std::shared_ptr<const Solution>& picture) {
        if (out.first_cpu == 0.0) {
            out.first_cpu = cpu_seconds() - before;
            out.first_wall = picture->statistics.time.first_picture;
        }
    });
    out.cpu = cpu_seconds() - before;
    out.peak = peak_resident_bytes();
    if (!solution) {
        return out;
    }
    const Statistics& s = (*solution)->statistics;
    out.finished = (*solution)->final;
    out.wall = s.time.solve;
    out.error = s.error_estimate;
    out.triangles = s.triangles;
    out.elements = s.elements;
    out.links = s.links;
    out.records = s.records;
    out.rays = s.rays;
    for (const Statistics::Phase& phase : s.phases) {
        if (out.phase_count < out.phases.size()) {
            Figures::Phase& into = out.phases[out.phase_count++];
            std::strncpy(into.name.data(), phase.name.c_str(), into.name.size() - 1);
            into.wall = phase.seconds;
            into.cpu = phase.cpu_seconds;
        }
    }
    return out;
}

/// A scene by what makes it, so that the parent process has nothing of it.
using MakeScene = std::function<std::optional<Scene>()>;

std::optional<Figures> solve_alone(const MakeScene& make, SolverSettings::Quality quality, unsigned threads, double limit) {
    return in_own_process<Figures>([&] {
        const std::optional<Scene> scene = make();
        return scene ? solve_scene(*scene, quality, threads, limit) : Figures{};
    });
}

MakeScene from_file(const std::string& file) {
    return [file]() -> std::optional<Scene> {
        auto lit = read_lit_scene(file);
        return lit ? std::optional<Scene>(std::move(lit->scene)) : std::nullopt;
    };
}

constexpr double kMiB = 1024.0 * 1024.0;

double of_phase(const Figures& figures, const char* name, double Figures::Phase::*what) {
    for (std::size_t i = 0; i < figures.phase_count; ++i) {
        if (std::strcmp(figures.phases[i].name.data(), name) == 0) {
            return figures.phases[i].*what;
        }
    }
    return 0.0;
}

void print_scaling_of(const std::string& name, const MakeScene& make, int repeats) {
    std::array<std::optional<Figures>, 2> best;
    for (int i = 0; i < repeats; ++i) {
        for (unsigned threads = 1; threads <= best.size(); ++threads) { // in turn: both see the same machine
            const auto figures = solve_alone(make, SolverSettings::Quality::Draft, threads, 0.0);
            auto& kept = best[threads - 1];
            if (figures && figures->finished && (!kept || figures->wall < kept->wall)) {
                kept = figures;
            }
        }
    }
    if (!best[0] || !best[1]) {
        fmt::print("{}: no solve came to its end\n", name);
        return;
    }
    const auto row = [&](const char* phase, double wall_1, double wall_2, double cpu_1, double cpu_2) {
        fmt::print("| {:<14} | {:<12} | {:>7.2f} | {:>7.2f} | {:>5.2f} | {:>7.2f} | {:>7.2f} | {:>5.2f} |\n", name, phase,
                   wall_1, wall_2, wall_1 / std::max(wall_2, 1e-9), cpu_1, cpu_2, cpu_2 / std::max(cpu_1, 1e-9));
    };
    for (std::size_t i = 0; i < best[0]->phase_count; ++i) {
        const char* phase = best[0]->phases[i].name.data();
        row(phase, of_phase(*best[0], phase, &Figures::Phase::wall), of_phase(*best[1], phase, &Figures::Phase::wall),
            of_phase(*best[0], phase, &Figures::Phase::cpu), of_phase(*best[1], phase, &Figures::Phase::cpu));
    }
    row("all", best[0]->wall, best[1]->wall, best[0]->cpu, best[1]->cpu);
    std::fflush(stdout);
}

} // namespace

void print_scaling(const std::string& shipped_scene, int repeats) {
    fmt::print(
        "Draft, best of {} each. 'speed-up' is wall clock, 'work' the processor time of two threads over that of one.\n\n"
        "| scene | phase | wall s, 1 | wall s, 2 | speed-up | cpu s, 1 | cpu s, 2 | work "
        "|\n|---|---|---|---|---|---|---|---|\n",
        repeats);
    print_scaling_of(
        "room of 1,000", [] { return tessellated_room(1000); }, repeats);
    print_scaling_of("shipped scene", from_file(shipped_scene), repeats);
}

void print_tessellation(std::size_t most, double limit) {
    std::vector<Figures> rooms;
    for (std::size_t triangles = 1000; triangles <= most; triangles *= 10) {
        const auto figures =
            solve_alone([=] { return tessellated_room(triangles); }, SolverSettings::Quality::Normal, 0, limit);
        if (!figures || !figures->finished) {
            fmt::print("room of {} triangles: not solved in {:g} s\n", triangles, limit);
            break;
        }
        rooms.push_back(*figures);
    }
    if (rooms.empty()) {
        return;
    }
    fmt::print("Normal. In brackets the ratio to the first room.\n\n| |");
    for (const Figures& room : rooms) {
        fmt::print(" {} triangles |", room.triangles);
    }
    fmt::print("\n|---|");
    for (std::size_t i = 0; i < rooms.size(); ++i) {
        fmt::print("---|");
    }
    fmt::print("\n");
    const auto row = [&](const std::string& name, int digits, const std::function<double(const Figures&)>& value) {
        fmt::print("| {} |", name);
        for (const Figures& room : rooms) {
            fmt::print(" {:.{}f} ({:.2f}) |", value(room), digits, value(room) / std::max(value(rooms.front()), 1e-9));
        }
        fmt::print("\n");
    };
    for (std::size_t i = 0; i < rooms.front().phase_count; ++i) {
        const char* phase = rooms.front().phases[i].name.data();
        row(fmt::format("{}, cpu s", phase), 2, [&](const Figures& f) { return of_phase(f, phase, &Figures::Phase::cpu); });
    }
    row("whole solve, cpu s", 2, [](const Figures& f) { return f.cpu; });
    row("whole solve, wall s", 2, [](const Figures& f) { return f.wall; });
    row("first picture, cpu s", 2, [](const Figures& f) { return f.first_cpu; });
    row("elements", 0, [](const Figures& f) { return double(f.elements); });
    row("links", 0, [](const Figures& f) { return double(f.links); });
    row("records", 0, [](const Figures& f) { return double(f.records); });
    row("rays, millions", 2, [](const Figures& f) { return double(f.rays) / 1e6; });
    row("peak memory, MiB", 0, [](const Figures& f) { return double(f.peak) / kMiB; });
    row("of it before the solve, MiB", 0, [](const Figures& f) { return double(f.before) / kMiB; });
    std::fflush(stdout);
}

void print_qualities(const std::vector<std::string>& files, const std::vector<std::string>& quality_names, double limit) {
    fmt::print("| scene | triangles | quality | first picture s | cpu s | solve s | cpu s | peak MiB | elements | links | "
               "records | Mrays | error estimate |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& file : files) {
        const std::filesystem::path path(file);
        if (!std::filesystem::exists(path)) {
            fmt::print("| {} | left out: the file is not there |\n", path.stem().string());
            continue;
        }
        for (const std::string& quality : quality_names) {
            const auto f = solve_alone(from_file(file), qualities().at(quality), 0, limit);
            if (!f || f->triangles == 0) {
                fmt::print("| {} | | {} | no picture within {:g} s |\n", path.stem().string(), quality, limit);
                continue;
            }
            fmt::print("| {} | {} | {} | {:.2f} | {:.2f} |", path.stem().string(), f->triangles, quality, f->first_wall,
                       f->first_cpu);
            if (f->finished) {
                fmt::print(" {:.2f} | {:.2f} | {:.0f} | {} | {} | {} | {:.1f} | {:.2f} % |\n", f->wall, f->cpu,
                           double(f->peak) / kMiB, f->elements, f->links, f->records, double(f->rays) / 1e6,
                           100.0 * f->error);
            } else { // what else there is belongs to the first picture
                fmt::print(" over {:g} | over {:.2f} | {:.0f} so far |\n", limit, f->cpu, double(f->peak) / kMiB);
            }
            std::fflush(stdout);
        }
    }
}

} // namespace atrium::bench
