// The solve options that several subcommands take, and the solve behind them.
#pragma once

#include "app/cli_support.h"
#include "app/cli_thresholds.h"
#include "engine/solver/gi_engine.h"

#include <memory>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace atrium::cli {

/// As given on the command line; what was not given stays at what the project says.
struct SolveArguments {
    std::optional<std::string> quality;
    std::optional<double> error;
    std::optional<double> time;
    std::optional<unsigned> threads;
    std::optional<std::uint32_t> seed;
    std::optional<std::string> mode;
    std::vector<ThresholdWish> thresholds; ///< in the order given, the last of a name counts
    std::string stats;
    bool progress = false;
    bool daylight = false; ///< add a sun and a sky where the file has no light
    bool audit = true; ///< the command tells or keeps the error of the light; else it is measured for stats or error only
};
void add_solve_options(CLI::App& command, SolveArguments& arguments);

/// Puts what the arguments and the project wish into `options`; what else is in them stays.
void set_options(SolveOptions& options, const Scene& scene, const SolveArguments& arguments);
/// Stop flag raised by signals, time limit and progress of the job that starts now.
RunContext context_for(const SolveArguments& arguments);

/// A file with its light.
struct Solved {
    std::string file;
    Scene scene;
    std::shared_ptr<const Solution> solution; ///< after open_scene(): what the file holds, may be null
    GiEngine engine;                          ///< holds the hierarchy only when it solved in this run (has_solution())
    bool from_file = false;                   ///< the project's own solution was good enough
    bool stopped = false;                     ///< by a signal or the time limit: exit status 2
    double load_seconds = 0;                  ///< reading the file
};

/// Called with every picture worth showing and the time since the program started.
using SnapshotWatcher = std::function<void(const std::shared_ptr<const Solution>&, double seconds)>;

/// Reads a file and whatever light it holds. On failure the message has been written and the exit status is returned.
tl::expected<Solved, int> open_scene(const std::string& file, const SolveArguments& arguments);
/// Solves unless the project's own light is good enough for the arguments and `need_engine` is false. Returns an exit
/// status; kDone also when the solve was stopped with a picture (`stopped`), be it the stored one. Stopped without any it
/// is kStopped, and the statistics have been written.
int light_up(Solved& solved, const SolveArguments& arguments, bool need_engine, const SnapshotWatcher& watcher = {});

/// Writes `--stats` and gives the final exit status: kDone, kStopped or what went wrong.
int finish(const Solved& solved, const SolveArguments& arguments);

} // namespace atrium::cli
