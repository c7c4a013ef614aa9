// atrium-cli reference: brute-force light at points or through a camera, with its own standard error.
#include "app/cli_commands.h"
#include "app/cli_points.h"
#include "app/cli_solving.h"
#include "engine/reference/reference.h"
#include "engine/view/still.h"
#include "engine/view/tone.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>
#include <optional>

namespace atrium::cli {

namespace {

struct Arguments {
    std::string file;
    std::string points;
    std::optional<std::string> camera;
    std::string out;
    std::string size = "640x360";
    double time = 60.0;
    double error = 0.0;
    double caustic_radius = 0.0;
    SolveArguments common; ///< threads, seed, daylight, progress
};

/// Log-average of the luminance of all pixels that are not black, cd/m2: what exposure starts from.
double log_average(const Picture& picture) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const Rgb& pixel : picture.pixels) {
        if (luminance(pixel) > 0.0F) {
            sum += std::log(double(luminance(pixel)));
            ++count;
        }
    }
    return count > 0 ? std::exp(sum / double(count)) : 0.0;
}

ReferenceSettings settings_for(const Scene& scene, const Arguments& a) {
    ReferenceSettings settings;
    settings.seed = a.common.seed.value_or(scene.settings.seed);
    settings.relative_error = a.error;
    settings.caustic_radius = float(a.caustic_radius);
    return settings;
}

RunContext context_for(const Arguments& a) {
    RunContext context;
    context.stop = new_stop_flag();
    context.on_progress = progress_reporter(a.common.progress);
    context.deadline =
        program_start() + std::chrono::duration_cast<RunContext::Clock::duration>(std::chrono::duration<double>(a.time));
    return context;
}

/// Exit status of a run that has its estimate: the time limit is what was asked for, a signal is not.
int status_after(const ReferenceRun& run, const Arguments& a) {
    if (a.common.progress) {
        complain(fmt::format("{}: {} paths each, {} rays", a.file, run.paths, run.rays));
    }
    if (interrupted()) {
        complain(fmt::format("{}: stopped by a signal; written is what {} paths each gave", a.file, run.paths));
        return kStopped;
    }
    if (a.error > 0.0 && !run.reached) {
        complain(fmt::format("{}: the time limit came before the relative error of {}", a.file, a.error));
        return kStopped;
    }
    return kDone;
}

int stopped_without(const Error& error, const std::string& file) {
    refuse({file, error.where, error.what, error.hint});
    return kStopped;
}

int measure(const Arguments& a) {
    const auto points = read_points(a.points);
    if (!points) {
        return refuse(points.error());
    }
    const auto opened = open_scene(a.file, a.common);
    if (!opened) {
        return opened.error();
    }
    std::vector<ReferencePoint> places;
    for (const SensorPoint& point : *points) {
        places.push_back({point.position, point.normal});
    }
    const auto result = reference_irradiance(opened->scene, places, settings_for(opened->scene, a), context_for(a));
    finish_progress();
    if (!result) {
        return stopped_without(result.error(), a.file);
    }
    std::vector<SensorReading> readings;
    for (const ReferenceReading& r : result->points) {
        readings.push_back({r.irradiance, r.standard_error, r.on_surface});
    }
    if (auto written = write_text(a.out.empty() ? "-" : a.out, measurement_csv(*points, readings)); !written) {
        return refuse(written.error());
    }
    return status_after(result->run, a);
}

int draw(const Arguments& a) {
    const std::string extension = extension_of(a.out);
    if (extension != ".exr" && extension != ".png") {
        return refuse({a.out.empty() ? "-o" : a.out, "",
                       a.out.empty() ? "no picture is named" : "cannot be written in this format",
                       "Use a name that ends in .exr or .png."});
    }
    const auto size = parse_size(a.size);
    if (!size) {
        return refuse(size.error());
    }
    const auto opened = open_scene(a.file, a.common);
    if (!opened) {
        return opened.error();
    }
    const auto camera = find_camera(opened->scene, *a.camera);
    if (!camera) {
        Error error = camera.error();
        error.file = error.file.empty() ? a.file : error.file;
        return refuse(error);
    }
    auto result = reference_picture(opened->scene, {camera->to_world, camera->lens, size->first, size->second},
                                    settings_for(opened->scene, a), context_for(a));
    finish_progress();
    if (!result) {
        return stopped_without(result.error(), a.file);
    }
    Picture& picture = result->radiance;
    std::vector<PictureChannel> extra;
    if (extension == ".exr") {
        extra.push_back({"standard_error.Y", result->standard_error});
    } else {
        const float scale = exposure_scale(log_average(picture), camera->lens.exposure_ev);
        for (Rgb& pixel : picture.pixels) {
            pixel = display_color(pixel, scale);
        }
    }
    if (auto written = write_picture(a.out, picture, extra); !written) {
        return refuse(written.error());
    }
    return status_after(result->run, a);
}

int run(const Arguments& a) {
    if (a.points.empty() == !a.camera) {
        return refuse({"", "reference", a.camera ? "--points and --camera exclude each other" : "nothing is asked for",
                       "Give --points P.csv, or --camera NAME with -o IMAGE."});
    }
    if (auto fine = check_output(a.out); !fine) {
        return refuse(fine.error());
    }
    return a.camera ? draw(a) : measure(a);
}

} // namespace

void add_reference(CLI::App& app, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "reference",
        "The light by brute force (path tracing), unbiased and with its own standard error.\n"
        "It follows light over matt surfaces, mirrors, metals and glass in any order. What lamps and suns send over mirrors "
        "and glass is counted in a disc about each point: see --caustic-radius.");
    command->add_option("FILE", a->file, "Scene: .gltf, .glb or .atrium")->required();
    command->add_option("--points", a->points, "CSV with the header x,y,z,nx,ny,nz: irradiance there");
    command->add_option("--camera", a->camera, "Name or index of a camera: radiance of every pixel");
    command->add_option("-o,--output", a->out,
                        "CSV to write (default: standard output); with --camera .exr in linear cd/m2 with the channel "
                        "standard_error.Y, or .png tone mapped");
    command->add_option("--size", a->size, "Pixels, as 640x360");
    command->add_option("--time", a->time, "Stop after this many seconds (default 60)")->check(CLI::Range(1e-3, 1e7));
    command->add_option("--error", a->error, "Stop at this relative standard error of every point or pixel, as 0.01")
        ->check(CLI::Range(1e-6, 1.0));
    command
        ->add_option("--caustic-radius", a->caustic_radius,
                     "Radius of that disc in metres (default: a thousandth of the scene's diagonal, 3 in pictures); such "
                     "light is blurred "
                     "by as much")
        ->check(CLI::Range(1e-5, 1e3));
    command->add_option("--threads", a->common.threads, "Number of worker threads, 0 = one per core")
        ->check(CLI::Range(0U, 1024U));
    command->add_option("--seed", a->common.seed, "Seed of the random numbers");
    command->add_flag("--daylight", a->common.daylight, "Add a sun and a sky where the file has no light of its own");
    command->add_flag("--progress", a->common.progress, "Report progress on standard error");
    command->callback([a, &status] { status = run(*a); });
}

} // namespace atrium::cli
