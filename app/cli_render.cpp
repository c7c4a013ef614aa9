// atrium-cli render: a still through one of the scene's cameras.
#include "app/cli_commands.h"
#include "app/cli_solving.h"
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
    std::string out;
    std::string camera;
    std::string size = "1280x720";
    std::optional<double> exposure;
    std::string layers;
    SolveArguments solve;
};

/// Which light the picture shows.
struct LayerChoice {
    LightShares seen; ///< on what is seen directly
    bool specular = true;
};

Result<LayerChoice> parse_layers(const std::string& text) {
    if (text.empty()) {
        return LayerChoice{};
    }
    LayerChoice choice{{false, false, false}, false};
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string name = text.substr(begin, end - begin);
        if (name == "diffuse") {
            choice.seen.diffuse = true;
        } else if (name == "specular") {
            choice.specular = true;
        } else if (name == "direct") {
            choice.seen.direct = true;
        } else if (name == "caustic") {
            choice.seen.caustic = true;
        } else {
            return fail("", "--layers", fmt::format("'{}' is not a layer", name),
                        "The layers are direct, diffuse, caustic and specular, separated by commas.");
        }
        begin = end + 1;
    }
    return choice;
}

int run(const Arguments& a) {
    const std::string extension = extension_of(a.out);
    if (extension != ".exr" && extension != ".png") {
        return refuse({a.out, "", "cannot be written in this format", "Use a name that ends in .exr or .png."});
    }
    const auto size = parse_size(a.size);
    const auto layers = parse_layers(a.layers);
    if (!size || !layers) {
        return refuse(!size ? size.error() : layers.error());
    }
    StillOptions options;
    options.width = size->first;
    options.height = size->second;
    if (auto fine = check_output(a.out); !fine) {
        return refuse(fine.error());
    }
    auto solved = open_scene(a.file, a.solve);
    if (!solved) {
        return solved.error();
    }
    auto camera = find_camera(solved->scene, a.camera);
    if (!camera) {
        Error error = camera.error();
        error.file = error.file.empty() ? a.file : error.file;
        return refuse(error);
    }
    if (const int status = light_up(*solved, a.solve, false); status != kDone) {
        return status;
    }
    // The time limit is the solve's: what it left is always drawn.
    RunContext context;
    context.stop = new_stop_flag();
    context.on_progress = progress_reporter(a.solve.progress);
    options.shares = layers->seen;
    if (!layers->specular) {
        options.max_specular_depth = 0;
    }
    Picture picture = render_still(solved->scene, *solved->solution, *camera, options, context);
    finish_progress();
    solved->stopped = solved->stopped || context.should_stop();
    if (extension == ".png") {
        const float ev = a.exposure ? float(*a.exposure) : camera->lens.exposure_ev;
        const float scale = exposure_scale(solved->solution->mean_radiance, ev);
        for (Rgb& pixel : picture.pixels) {
            pixel = display_color(pixel, scale);
        }
    }
    if (auto written = write_picture(a.out, picture); !written) {
        return refuse(written.error());
    }
    return finish(*solved, a.solve);
}

} // namespace

void add_render(CLI::App& app, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("render", "A still through one of the scene's cameras");
    command->add_option("FILE", a->file, "Scene: .gltf, .glb or .atrium")->required();
    command->add_option("-o,--output", a->out, "Image: .exr in linear cd/m2, or .png tone mapped as in the viewport")
        ->required();
    command->add_option("--camera", a->camera, "Name or index of a camera (default: the first, else one inside the room)");
    command->add_option("--size", a->size, "Pixels, as 1280x720");
    command->add_option("--exposure", a->exposure, "Stops above automatic exposure, .png only (default: the camera's own)")
        ->check(CLI::Range(-30.0, 30.0));
    command->add_option("--layers", a->layers, "Of direct,diffuse,caustic,specular (default: all)");
    add_solve_options(*command, a->solve);
    command->callback([a, &status] { status = run(*a); });
}

} // namespace atrium::cli
