// atrium-cli measure: irradiance at points, from the solution's layers or at virtual sensors.
#include "app/cli_commands.h"
#include "app/cli_points.h"
#include "app/cli_solving.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>

namespace atrium::cli {

namespace {

struct Arguments {
    std::string file;
    std::string points;
    std::string out = "-";
    bool on_surface = false;
    bool free = false;
    SolveArguments solve;
};

int run(const Arguments& a) {
    if (auto fine = check_output(a.out); !fine) {
        return refuse(fine.error());
    }
    const auto points = read_points(a.points);
    if (!points) {
        return refuse(points.error());
    }
    auto solved = open_scene(a.file, a.solve);
    if (!solved) {
        return solved.error();
    }
    if (const int status = light_up(*solved, a.solve, a.free); status != kDone) {
        return status;
    }
    std::vector<SensorReading> readings(points->size());
    for (int attempt = 0; attempt < 2; ++attempt) {
        bool need_engine = false;
        for (std::size_t i = 0; i < points->size(); ++i) {
            const SensorPoint& point = (*points)[i];
            if (!a.free) {
                readings[i] = read_surface(solved->scene, *solved->solution, point.position, point.normal);
                if (readings[i].on_surface) {
                    continue;
                }
                if (a.on_surface) {
                    return refuse({a.points, fmt::format("line {}", point.line),
                                   "no diffuse surface within 1 cm faces the same way",
                                   "Move the point onto a surface, or leave --on-surface out."});
                }
            }
            if (solved->engine.has_solution()) {
                readings[i] = solved->engine.gather_free(point.position, point.normal);
                readings[i].on_surface = false;
            } else {
                need_engine = true;
            }
        }
        if (!need_engine) {
            break;
        }
        // Stored layers hold no answer for points in space: solve, then read everything from the same solution.
        if (const int status = light_up(*solved, a.solve, true); status != kDone) {
            return status;
        }
    }
    if (auto written = write_text(a.out, measurement_csv(*points, readings)); !written) {
        return refuse(written.error());
    }
    return finish(*solved, a.solve);
}

} // namespace

void add_measure(CLI::App& app, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("measure", "Irradiance at points, in lux");
    command->add_option("FILE", a->file, "Scene: .gltf, .glb or .atrium")->required();
    command->add_option("--points", a->points, "CSV with the header x,y,z,nx,ny,nz")->required();
    command->add_option("-o,--output", a->out, "CSV to write (default: standard output)");
    auto* on_surface =
        command->add_flag("--on-surface", a->on_surface, "Read the light of the surface within 1 cm, or fail");
    command->add_flag("--free", a->free, "Gather at virtual sensors in space")->excludes(on_surface);
    add_solve_options(*command, a->solve);
    command->callback([a, &status] { status = run(*a); });
}

} // namespace atrium::cli
