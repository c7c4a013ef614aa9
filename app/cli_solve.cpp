// atrium-cli solve: computes the light of a scene and keeps it in a project.
#include "app/cli_commands.h"
#include "app/cli_points.h"
#include "app/cli_solving.h"
#include "engine/measure/compare.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>

namespace atrium::cli {

namespace {

struct Arguments {
    std::string file;
    std::string out;
    std::string curve;
    std::string reference;
    SolveArguments solve;
};

/// Error against time: one line for every picture that the solve publishes.
class Curve {
public:
    explicit Curve(std::vector<SensorPoint> reference) : reference_(std::move(reference)) {}

    void add(const Solution& s, double seconds) { rows_.push_back({s, seconds}); }

    /// The distance to the reference is read from the layers, once the solve is over.
    [[nodiscard]] std::string csv(const Scene& scene) const {
        std::string out = "seconds,final,elements,links,error_estimate,rel_rmse\n";
        for (const Row& row : rows_) {
            const Statistics& s = row.solution.statistics;
            out += fmt::format("{},{},{},{},{},{}\n", row.seconds, row.solution.final ? 1 : 0, s.elements, s.links,
                               s.error_estimate, distance(scene, row.solution));
        }
        return out;
    }

private:
    struct Row {
        Solution solution; // shares its surfaces with the picture
        double seconds;
    };
    [[nodiscard]] std::string distance(const Scene& scene, const Solution& solution) const {
        std::vector<double> ours;
        std::vector<double> theirs;
        for (const SensorPoint& point : reference_) {
            const SensorReading reading = read_surface(scene, solution, point.position, point.normal);
            if (reading.on_surface) {
                ours.push_back(double(luminance(reading.irradiance)));
                theirs.push_back(*point.illuminance);
            }
        }
        return ours.empty() ? "" : fmt::format("{}", difference(ours, theirs).rel_rmse);
    }
    std::vector<SensorPoint> reference_;
    std::vector<Row> rows_;
};

Result<std::vector<SensorPoint>> read_reference(const std::string& path) {
    auto points = read_points(path);
    if (points) {
        for (const SensorPoint& point : *points) {
            if (!point.illuminance) {
                return fail(path, fmt::format("line {}", point.line), "a reference needs the column E",
                            "Use a file written by `atrium-cli measure`.");
            }
        }
    }
    return points;
}

int run(const Arguments& a) {
    if (!a.out.empty() && extension_of(a.out) != ".atrium") {
        return refuse(
            {a.out, "", "a solved project must end in .atrium", "To write only the scene, use `atrium-cli convert`."});
    }
    for (const std::string* path : {&a.out, &a.curve}) {
        if (auto fine = check_output(*path); !fine) {
            return refuse(fine.error());
        }
    }
    std::vector<SensorPoint> reference;
    if (!a.reference.empty()) {
        auto read = read_reference(a.reference);
        if (!read) {
            return refuse(read.error());
        }
        reference = std::move(*read);
    }
    Curve curve(std::move(reference));
    SnapshotWatcher watcher;
    if (!a.curve.empty()) {
        watcher = [&curve](const std::shared_ptr<const Solution>& s, double seconds) { curve.add(*s, seconds); };
    }
    auto solved = open_scene(a.file, a.solve);
    if (!solved) {
        return solved.error();
    }
    // A curve is about solving: stored light has none.
    if (const int status = light_up(*solved, a.solve, !a.curve.empty(), watcher); status != kDone) {
        return status;
    }
    if (!a.out.empty()) {
        WriteOptions options;
        options.solution = encode_solution(*solved->solution, solved->scene);
        if (auto written = write_scene(a.out, solved->scene, options); !written) {
            return refuse(written.error());
        }
    }
    if (!a.curve.empty()) {
        if (auto written = write_text(a.curve, curve.csv(solved->scene)); !written) {
            return refuse(written.error());
        }
    }
    return finish(*solved, a.solve);
}

} // namespace

void add_solve(CLI::App& app, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("solve", "Compute the light and keep it in a project");
    command->add_option("FILE", a->file, "Scene: .gltf, .glb or .atrium")->required();
    command->add_option("-o,--output", a->out, "Project to write: .atrium");
    auto* curve = command->add_option("--curve", a->curve, "Write error against time as CSV to this file");
    command->add_option("--reference", a->reference, "Measure CSV that the curve's rel_rmse is taken against")->needs(curve);
    add_solve_options(*command, a->solve);
    command->callback([a, &status] { status = run(*a); });
}

} // namespace atrium::cli
