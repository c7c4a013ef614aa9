// atrium-cli render: a still through one of the scene's cameras.
#include "app/cli_commands.h"
#include "app/cli_solving.h"
#include "engine/measure/light_range.h"
#include "engine/view/still.h"
#include "engine/view/tone.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
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
    std::string false_color;
    std::string range;
    std::string scale = "log";
    std::string legend;
    bool contours = false;
    bool final_pass = false;
    std::optional<int> samples;
    bool channels = false;
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

/// What `--false-colour` and its companions ask for; `automatic` when the range is to be found.
struct ScaleWish {
    FalseColor scale;
    bool automatic = true;
};

Result<ScaleWish> parse_scale(const Arguments& a) {
    ScaleWish wish;
    wish.scale.quantity = a.false_color == "luminance" ? LightQuantity::Luminance : LightQuantity::Illuminance;
    wish.scale.logarithmic = a.scale == "log";
    wish.scale.contours = a.contours;
    if (!a.range.empty()) {
        const std::size_t comma = a.range.find(',');
        const char* end = a.range.data() + a.range.size();
        const char* middle = a.range.data() + std::min(comma, a.range.size());
        double low = 0.0;
        double high = 0.0;
        const auto first = std::from_chars(a.range.data(), middle, low);
        const bool good = comma != std::string::npos && first.ec == std::errc() && first.ptr == middle &&
                          std::from_chars(middle + 1, end, high).ec == std::errc() && low >= 0.0 && high > low &&
                          std::isfinite(high) && (low > 0.0 || !wish.scale.logarithmic);
        if (!good) {
            return fail("", "--range", fmt::format("'{}' is not a range of light", a.range),
                        "Give two rising numbers in lux or cd/m2, as 0,500; a logarithmic scale starts above 0.");
        }
        wish.scale.minimum = low;
        wish.scale.maximum = high;
        wish.automatic = false;
    }
    wish.scale = valid_scale(wish.scale);
    return wish;
}

/// The scale's round amounts and ends with the colours that they have in the picture.
std::string legend_csv(const FalseColor& scale) {
    std::vector<double> values = round_values(scale);
    values.push_back(scale.minimum);
    values.push_back(scale.maximum);
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    std::string out = fmt::format("{},colour\n", scale.quantity == LightQuantity::Illuminance ? "lux" : "cd/m2");
    for (const double value : values) {
        const Rgb c = false_color(scale, value);
        const auto byte = [](float x) { return int(std::lround(255.0F * x)); };
        out += fmt::format("{:.6g},#{:02x}{:02x}{:02x}\n", value, byte(c.r), byte(c.g), byte(c.b));
    }
    return out;
}

int run(const Arguments& a) {
    const std::string extension = extension_of(a.out);
    if (extension != ".exr" && extension != ".png") {
        return refuse({a.out, "", "cannot be written in this format", "Use a name that ends in .exr or .png."});
    }
    if (!a.false_color.empty() && extension != ".png") {
        return refuse({a.out, "", "an .exr holds amounts of light, not colours that stand for them",
                       "Use a name that ends in .png, or leave --false-colour out."});
    }
    if (a.channels && extension != ".exr") {
        return refuse(
            {a.out, "", "a .png has no room for more channels", "Use a name that ends in .exr, or leave --channels out."});
    }
    const auto wish = parse_scale(a);
    if (!wish) {
        return refuse(wish.error());
    }
    const auto size = parse_size(a.size);
    const auto layers = parse_layers(a.layers);
    if (!size || !layers) {
        return refuse(!size ? size.error() : layers.error());
    }
    StillOptions options;
    options.width = size->first;
    options.height = size->second;
    options.final_pass = a.final_pass;
    if (a.samples) {
        options.final_samples = *a.samples;
        options.samples_per_axis = std::max(1, int(std::lround(std::sqrt(double(*a.samples)))));
    }
    for (const std::string* path : {&a.out, &a.legend}) {
        if (auto fine = check_output(*path); !fine) {
            return refuse(fine.error());
        }
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
    options.seed = a.solve.seed.value_or(solved->scene.settings.seed);
    if (!layers->specular) {
        options.max_specular_depth = 0;
    }
    FalseColor scale = wish->scale;
    if (!a.false_color.empty() && wish->automatic) {
        scale = fitted_scale(scale, light_range(solved->scene, *solved->solution, scale.quantity, options.shares));
    }
    const bool amounts = !a.false_color.empty();
    Picture picture;
    std::vector<PictureChannel> channels;
    if (amounts) {
        picture = render_false_color(solved->scene, *solved->solution, *camera, options, scale, context);
    } else {
        const StillLayers parts = render_layers(solved->scene, *solved->solution, *camera, options, context);
        picture = parts.beauty();
        if (a.channels) {
            channels = parts.channels();
        }
    }
    finish_progress();
    solved->stopped = solved->stopped || context.should_stop();
    if (extension == ".png" && !amounts) {
        const float ev = a.exposure ? float(*a.exposure) : camera->lens.exposure_ev;
        const float exposure = exposure_scale(solved->solution->mean_radiance, ev);
        for (Rgb& pixel : picture.pixels) {
            pixel = display_color(pixel, exposure);
        }
    }
    if (auto written = write_picture(a.out, picture, channels); !written) {
        return refuse(written.error());
    }
    if (amounts && !a.legend.empty()) {
        if (auto written = write_text(a.legend, legend_csv(scale)); !written) {
            return refuse(written.error());
        }
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
    auto* final_pass = command->add_flag("--final", a->final_pass,
                                         "Compute the light of every pixel instead of reading it from the solution: sharp "
                                         "contacts and small things, for minutes of time");
    command
        ->add_option("--samples", a->samples, "Samples a pixel (default: 4; with --final 64, rounded up to a power of two)")
        ->check(CLI::Range(1, 4096));
    command->add_flag("--channels", a->channels,
                      "Also write the picture's parts into the .exr: direct, diffuse, caustic and specular light, which add "
                      "up to it, and albedo, normal and depth");
    auto* false_color =
        command
            ->add_option("--false-colour", a->false_color,
                         "Show an amount of light in colours: illuminance (lux) or luminance (cd/m2); .png only")
            ->check(CLI::IsMember({"illuminance", "luminance"}))
            ->excludes(final_pass);
    command->add_option("--range", a->range, "Ends of its scale, as 20,2000 (default: fitted to the scene's light)")
        ->needs(false_color);
    command->add_option("--scale", a->scale, "Its scale: log or linear")
        ->check(CLI::IsMember({"log", "linear"}))
        ->needs(false_color);
    command->add_flag("--contours", a->contours, "Lines at its round amounts")->needs(false_color);
    command->add_option("--legend", a->legend, "Write its amounts and their colours as CSV to this file")
        ->needs(false_color);
    add_solve_options(*command, a->solve);
    command->callback([a, &status] { status = run(*a); });
}

} // namespace atrium::cli
