// Stills against brute force: how far each way of drawing them is from the truth, and what it costs.
#include "engine/base/parallel.h"
#include "engine/measure/compare.h"
#include "engine/reference/reference.h"
#include "engine/solver/gi_engine.h"
#include "engine/view/still.h"
#include "engine/view/tone.h"
#include "tests/bench/bench_support.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <filesystem>

using namespace atrium;
using namespace atrium::bench;

namespace {

struct Wish {
    std::vector<std::string> scenes;
    std::string cache;
    std::string pictures;
    std::string quality = "normal";
    int width = 320;
    int height = 180;
    unsigned runs = 2;
    unsigned paths = 256;
    std::vector<int> samples{16, 64};
};

/// Means of the even and of the odd runs, so that the reference's own noise can be told.
struct Truth {
    Picture even, odd, mean;
    unsigned runs = 0;
};

Picture mean_of(const Picture& a, const Picture& b) {
    Picture out = a;
    for (std::size_t i = 0; i < out.pixels.size(); ++i) {
        out.pixels[i] = 0.5F * (a.pixels[i] + b.pixels[i]);
    }
    return out;
}

Result<Picture> reference_run(const Scene& scene, const ViewCamera& camera, const Wish& w, const std::string& name,
                              unsigned seed) {
    const std::filesystem::path kept =
        std::filesystem::path(w.cache) / fmt::format("{}_{}x{}_{}_{}.exr", name, w.width, w.height, w.paths, seed);
    if (!w.cache.empty() && std::filesystem::exists(kept)) {
        auto image = read_image(kept);
        if (!image) {
            return tl::unexpected(image.error());
        }
        Picture out{image->width, image->height, {}};
        for (std::size_t i = 0; i < image->floats.size(); i += std::size_t(image->channels)) {
            out.pixels.emplace_back(image->floats[i], image->floats[i + 1], image->floats[i + 2]);
        }
        return out;
    }
    ReferenceSettings settings;
    settings.seed = seed;
    settings.paths = w.paths;
    auto made = reference_picture(scene, {camera.to_world, camera.lens, w.width, w.height}, settings, RunContext{});
    if (!made) {
        return tl::unexpected(made.error());
    }
    if (!w.cache.empty()) {
        if (auto done = write_picture(kept, made->radiance); !done) {
            return tl::unexpected(done.error());
        }
    }
    return std::move(made->radiance);
}

Result<Truth> find_truth(const Scene& scene, const ViewCamera& camera, const Wish& w, const std::string& name) {
    Truth out;
    for (unsigned i = 0; i < 2 * w.runs; ++i) {
        auto one = reference_run(scene, camera, w, name, 101 + i);
        if (!one) {
            return tl::unexpected(one.error());
        }
        Picture& sum = i % 2 == 0 ? out.even : out.odd;
        if (sum.pixels.empty()) {
            sum = *one;
        } else {
            for (std::size_t k = 0; k < sum.pixels.size(); ++k) {
                sum.pixels[k] += one->pixels[k];
            }
        }
    }
    for (Picture* p : {&out.even, &out.odd}) {
        for (vec3& pixel : p->pixels) {
            pixel /= float(w.runs);
        }
    }
    out.mean = mean_of(out.even, out.odd);
    return out;
}

Picture shown(Picture picture, float exposure) {
    for (Rgb& c : picture.pixels) {
        c = filmic(c * exposure);
    }
    return picture;
}

/// Mean of (a - b)^2 / (b^2 + (1 % of the mean)^2) over all values.
double rel_mse(const Picture& a, const Picture& b) {
    double mean = 0.0;
    for (const Rgb& c : b.pixels) {
        mean += double(c.r + c.g + c.b) / 3.0;
    }
    mean /= double(b.pixels.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const double d = double(a.pixels[i][k]) - double(b.pixels[i][k]);
            sum += d * d / (double(b.pixels[i][k]) * double(b.pixels[i][k]) + 1e-4 * mean * mean);
        }
    }
    return sum / (3.0 * double(a.pixels.size()));
}

void write_shown(const Wish& w, const std::string& name, Picture picture, float exposure) {
    if (w.pictures.empty()) {
        return;
    }
    for (Rgb& c : picture.pixels) {
        c = display_color(c, exposure);
    }
    if (auto done = write_picture(std::filesystem::path(w.pictures) / (name + ".png"), picture); !done) {
        fmt::print(stderr, "{}\n", done.error().message());
    }
}

bool measure(const std::string& file, const Wish& w) {
    const auto lit = read_lit_scene(file);
    if (!lit) {
        return false;
    }
    const std::string name = std::filesystem::path(file).stem().string();
    const auto camera = find_camera(lit->scene, "");
    const auto truth = camera ? find_truth(lit->scene, *camera, w, name) : tl::unexpected(camera.error());
    if (!truth) {
        fmt::print(stderr, "{}: {}\n", file, truth.error().message());
        return false;
    }
    GiEngine engine;
    SolveOptions options;
    options.quality = qualities().at(w.quality);
    double start = cpu_seconds();
    const auto solution = engine.solve(lit->scene, options, RunContext{});
    if (!solution) {
        fmt::print(stderr, "{}: {}\n", file, solution.error().message());
        return false;
    }
    const double solve_seconds = cpu_seconds() - start;
    const auto exposure = float(exposure_scale((*solution)->mean_radiance, 0.0F));
    const Picture seen_truth = shown(truth->mean, exposure);
    const auto row = [&](const std::string& what, const Picture& picture, double seconds) {
        fmt::print("| {} | {} | {:.4f} | {:.5f} | {:.2f} |\n", name, what, flip(shown(picture, exposure), seen_truth),
                   rel_mse(picture, truth->mean), seconds);
        std::fflush(stdout);
        write_shown(w, name + "_" + what, picture, exposure);
    };
    // Two halves differ by twice the variance of each, the mean of both has half of that: a quarter of what they differ by.
    fmt::print("| {} | noise of the truth | {:.4f} (between its halves) | {:.5f} | |\n", name,
               flip(shown(truth->even, exposure), shown(truth->odd, exposure)), 0.25 * rel_mse(truth->even, truth->odd));
    write_shown(w, name + "_truth", truth->mean, exposure);
    fmt::print("| {} | solution ({}) | | | {:.2f} |\n", name, w.quality, solve_seconds);
    StillOptions still;
    still.width = w.width;
    still.height = w.height;
    still.samples_per_axis = 4;
    const auto draw = [&](const std::string& what) {
        start = cpu_seconds();
        const Picture picture = render_still(lit->scene, **solution, *camera, still, RunContext{});
        row(what, picture, cpu_seconds() - start);
    };
    draw("fast");
    still.final_pass = true;
    for (const int samples : w.samples) {
        still.final_samples = samples;
        still.gather = false;
        draw(fmt::format("final_{}_reflected_as_fast", samples));
        still.gather = true;
        draw(fmt::format("final_{}", samples));
    }
    return true;
}

} // namespace

int main(int argc, char** argv) {
    Wish w;
    CLI::App app("Stills, read from the layers and with the final pass, against path traced pictures of the same camera");
    app.add_option("FILES", w.scenes, "Scenes (default: four that ship)");
    app.add_option("--cache", w.cache, "Folder that keeps the path traced pictures; remove what belongs to a changed scene");
    app.add_option("--pictures", w.pictures, "Folder for all pictures as .png");
    app.add_option("--quality", w.quality, "Of the solution: draft, normal or fine")
        ->check(CLI::IsMember({"draft", "normal", "fine"}));
    app.add_option("--width", w.width, "Pixels")->check(CLI::Range(16, 4096));
    app.add_option("--height", w.height, "Pixels")->check(CLI::Range(16, 4096));
    app.add_option("--runs", w.runs, "Path traced pictures in each half of the truth")->check(CLI::Range(1, 1000));
    app.add_option("--paths", w.paths, "Paths a pixel in each of them")->check(CLI::Range(16, 1 << 20));
    app.add_option("--samples", w.samples, "Samples a pixel of the final pass, several for several rows")->delimiter(',');
    CLI11_PARSE(app, argc, argv);
    if (w.scenes.empty()) {
        const std::string scenes = ATRIUM_SOURCE_DIR "/scenes/";
        w.scenes = {scenes + "sunlit_room/sunlit_room.gltf", scenes + "glass-ball/glass-ball.glb", scenes + "ring/ring.glb",
                    scenes + "sun-mirror/sun-mirror.glb"};
    }
    fmt::print("| scene | picture | FLIP | relMSE | processor seconds |\n|---|---|---|---|---|\n");
    bool fine = true;
    for (const std::string& file : w.scenes) {
        fine = measure(file, w) && fine;
    }
    return fine ? 0 : 1;
}
