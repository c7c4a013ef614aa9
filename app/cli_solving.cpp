#include "app/cli_solving.h"

#include "app/cli_stats.h"
#include "engine/base/parallel.h"
#include "engine/measure/error_audit.h"
#include "engine/measure/wished_solve.h"
#include "engine/scene/daylight.h"
#include "engine/solver/memory_budget.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <map>

namespace atrium::cli {

namespace {

const std::map<std::string, SolverSettings::Quality> kQualities = {{"draft", SolverSettings::Quality::Draft},
                                                                   {"normal", SolverSettings::Quality::Normal},
                                                                   {"fine", SolverSettings::Quality::Fine}};

/// Whether the light stored in a project answers what the command line asks for.
bool good_enough(const Solution& stored, const SolveArguments& arguments) {
    if (arguments.quality && !stored.final) {
        return false; // it was stopped before it reached the quality that it names
    }
    const auto known = kQualities.find(stored.statistics.quality);
    if (arguments.quality && (known == kQualities.end() || kQualities.at(*arguments.quality) > known->second)) {
        return false;
    }
    if (arguments.seed && *arguments.seed != stored.statistics.seed) {
        return false;
    }
    if (arguments.mode && *arguments.mode != stored.statistics.mode) {
        return false;
    }
    const Statistics& s = stored.statistics; // an error that was never measured is none to rely on
    return !arguments.error || (s.audit.points > 0 && s.error_estimate <= *arguments.error);
}

/// What the arguments wish instead of a quality, and whether anything is to say how far off the light is.
SolveWish wish_of(const SolveArguments& arguments, bool need_engine) {
    SolveWish wish;
    wish.error = arguments.error.value_or(0.0);
    wish.from_quality = arguments.quality.has_value();
    // What is begun in vain leaves an engine without the light that is returned.
    wish.best_in_time = arguments.time && !arguments.quality && !need_engine;
    wish.audit = arguments.audit || !arguments.stats.empty() || arguments.error;
    return wish;
}

/// The error of stored light that was never measured.
std::shared_ptr<const Solution> look_at_error(const Solved& solved, const SolveArguments& arguments,
                                              const RunContext& context) {
    const SolveWish wish = wish_of(arguments, false);
    if (!wish.audit) {
        return solved.solution;
    }
    context.progress("audit", 1.0);
    RunContext unhurried;
    unhurried.stop = context.stop;
    SolveOptions options;
    set_options(options, solved.scene, arguments);
    AuditSettings settings = audit_settings(options.quality);
    settings.seed = options.seed;
    return audited(solved.scene, solved.solution, settings, unhurried);
}

/// Puts the thresholds of the command line into the scene. True where that changes what the light is made with.
bool take_thresholds(Scene& scene, const SolveArguments& arguments) {
    const SolverThresholds before = scene.settings.thresholds;
    for (const auto& [info, value] : arguments.thresholds) {
        scene.settings.thresholds.*info->value = value;
    }
    return scene.settings.thresholds != before;
}

} // namespace

void set_options(SolveOptions& options, const Scene& scene, const SolveArguments& arguments) {
    options.quality = arguments.quality ? kQualities.at(*arguments.quality) : scene.settings.quality;
    options.seed = arguments.seed.value_or(scene.settings.seed);
    options.paper_mode = arguments.mode == "paper";
}

RunContext context_for(const SolveArguments& arguments) {
    RunContext context;
    context.stop = new_stop_flag();
    context.on_progress = progress_reporter(arguments.progress);
    if (arguments.time) {
        context.deadline = program_start() + std::chrono::duration_cast<RunContext::Clock::duration>(
                                                 std::chrono::duration<double>(*arguments.time));
    }
    return context;
}

void add_solve_options(CLI::App& command, SolveArguments& a) {
    const std::string group = "Solve options";
    command.add_option("--quality", a.quality, "How fine: draft, normal or fine (default: as the project says)")
        ->check(CLI::IsMember({"draft", "normal", "fine"}))
        ->group(group);
    command
        .add_option("--error", a.error,
                    "Relative error of irradiance wished for, as 0.05: from draft on, better qualities follow until "
                    "the measured error is as small")
        ->check(CLI::Range(1e-6, 1.0))
        ->group(group);
    command
        .add_option("--time", a.time,
                    "Seconds in which the best light is wanted: the finest that is likely to be complete by then. With "
                    "--quality their limit: stopped with what there is (exit status 2)")
        ->check(CLI::Range(1e-3, 1e7))
        ->group(group);
    command.add_option("--threads", a.threads, "Number of worker threads, 0 = one per core")
        ->check(CLI::Range(0U, 1024U))
        ->group(group);
    command
        .add_option_function<double>(
            "--memory", [](double mib) { set_memory_budget(std::size_t(mib * 1024.0 * 1024.0)); },
            "MiB that the light may take; where it takes more it gets coarser (default: half of the machine's)")
        ->check(CLI::Range(16.0, 1e7))
        ->group(group);
    command
        .add_option_function<std::vector<std::string>>(
            "--threshold",
            [&a](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) {
                    a.thresholds.push_back(*parse_threshold(text));
                }
            },
            "Set by hand what the quality stands for; once for each threshold. The project written keeps it; NAME=auto "
            "takes "
            "back what the project says. Names, and what VALUE may be:\n" +
                threshold_help())
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false)
        ->check(CLI::Validator(
            [](std::string& text) {
                const auto parsed = parse_threshold(text);
                return parsed ? std::string() : parsed.error().message();
            },
            ""))
        ->group(group);
    command.add_option("--seed", a.seed, "Seed of the random numbers")->group(group);
    command.add_option("--mode", a.mode, "default, or paper: caustic textures by the algorithms of 2001")
        ->check(CLI::IsMember({"default", "paper"}))
        ->group(group);
    command.add_option("--stats", a.stats, "Write statistics as JSON to this file, - for standard output")->group(group);
    command.add_flag("--daylight", a.daylight, "Add a sun and a sky where the file has no light of its own")->group(group);
    command.add_flag("--progress", a.progress, "Report progress on standard error")->group(group);
}

tl::expected<Solved, int> open_scene(const std::string& file, const SolveArguments& arguments) {
    if (auto fine = check_output(arguments.stats); !fine) {
        return tl::unexpected(refuse(fine.error()));
    }
    if (arguments.threads) {
        set_thread_limit(*arguments.threads);
    }
    Solved solved;
    solved.file = file;
    const double before = seconds_since_start();
    auto loaded = load(file);
    if (!loaded) {
        return tl::unexpected(refuse(loaded.error()));
    }
    solved.scene = std::move(loaded->scene);
    solved.load_seconds = seconds_since_start() - before;
    if (has_no_light(solved.scene)) {
        if (arguments.daylight) {
            const auto added = apply(solved.scene, add_daylight(solved.scene));
            if (!added) {
                return tl::unexpected(refuse(added.error()));
            }
            loaded->solution.clear();
        } else {
            complain(fmt::format("warning: {}: nothing in it gives light, so all is dark. --daylight adds a sun and a sky",
                                 file));
        }
    }
    if (take_thresholds(solved.scene, arguments)) {
        loaded->solution.clear(); // the light of others
    }
    if (!loaded->solution.empty()) {
        auto stored = decode_solution(loaded->solution, solved.scene);
        if (!stored) {
            complain(fmt::format("warning: {}: the stored light cannot be used and is solved again: {}", file,
                                 stored.error().message()));
        } else {
            solved.solution = *stored;
            solved.from_file = good_enough(**stored, arguments);
            solved.load_seconds = seconds_since_start() - before;
        }
    }
    return solved;
}

int light_up(Solved& solved, const SolveArguments& arguments, bool need_engine, const SnapshotWatcher& watcher) {
    const RunContext context = context_for(arguments);
    if (solved.from_file && !need_engine) {
        if (solved.solution->statistics.audit.points == 0) { // of an older project
            solved.solution = look_at_error(solved, arguments, context);
            finish_progress();
        }
        return kDone;
    }
    std::function<void(std::shared_ptr<const Solution>)> on_snapshot;
    if (watcher) {
        on_snapshot = [&watcher](const std::shared_ptr<const Solution>& s) { watcher(s, seconds_since_start()); };
    }
    SolveOptions options;
    set_options(options, solved.scene, arguments);
    auto result = solve_to_wish(solved.engine, solved.scene, options, wish_of(arguments, need_engine), context, on_snapshot);
    finish_progress();
    if (result && arguments.error && (*result)->statistics.error_estimate > *arguments.error) {
        complain(fmt::format("{}: asked for an error of {:.1f} %, reached {:.1f} % at quality {}", solved.file,
                             100.0 * *arguments.error, 100.0 * (*result)->statistics.error_estimate,
                             (*result)->statistics.quality));
    }
    if (!result) {
        Error error = result.error();
        if (error.file.empty()) {
            error.file = solved.file;
        }
        if (!context.should_stop()) {
            return refuse(error);
        }
        solved.stopped = true;
        if (solved.solution && !need_engine) {
            solved.from_file = true;
            complain(fmt::format("{}: stopped before a better picture; the light is the stored one", solved.file));
            return kDone;
        }
        complain(error.message());
        const int status = finish(solved, arguments);
        return status == kDone ? kStopped : status;
    }
    solved.solution = *result;
    solved.from_file = false;
    if (const auto lowered = lowered_by_memory(solved.solution->statistics.features); !lowered.empty()) {
        complain(
            fmt::format("warning: {}: at most {} MiB are to be used, so the light is coarser than its quality stands for "
                        "({}). --memory gives it more",
                        solved.file, memory_budget() >> 20U, fmt::join(lowered, ", ")));
    }
    solved.stopped = !solved.solution->final;
    if (solved.stopped) {
        complain(fmt::format("{}: stopped {}; the light is that of the last complete picture", solved.file,
                             interrupted() ? "by a signal" : "at the time limit"));
    }
    return kDone;
}

int finish(const Solved& solved, const SolveArguments& arguments) {
    if (!arguments.stats.empty()) {
        if (auto written = write_text(arguments.stats, statistics_json(solved)); !written) {
            return refuse(written.error());
        }
    }
    return solved.stopped ? kStopped : kDone;
}

} // namespace atrium::cli
