// atrium-cli compare: two images, two measurements or two solved projects.
#include "app/cli_commands.h"
#include "app/cli_points.h"
#include "app/cli_support.h"
#include "engine/measure/compare.h"
#include "engine/measure/light_difference.h"
#include "engine/solver/gi_engine.h"
#include "engine/view/tone.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>

namespace atrium::cli {

namespace {

struct Arguments {
    std::string a;
    std::string b;
    bool json = false;
};

struct Comparison {
    std::string kind;
    Difference figures;
    std::optional<double> flip;
};

/// Linear RGB; 8-bit files are decoded from sRGB. `high_range` tells whether the file holds radiance.
Result<Picture> read_linear(const std::string& path, bool& high_range) {
    auto image = read_image(path);
    if (!image) {
        return tl::unexpected(image.error());
    }
    high_range = !image->floats.empty();
    Picture out;
    out.width = image->width;
    out.height = image->height;
    out.pixels.resize(std::size_t(image->width) * std::size_t(image->height));
    const int colors = image->channels >= 3 ? 3 : 1; // grey, grey with alpha, colour, colour with alpha
    for (std::size_t i = 0; i < out.pixels.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const std::size_t at = i * std::size_t(image->channels) + std::size_t(std::min(k, colors - 1));
            out.pixels[i][k] = high_range ? image->floats[at] : srgb_to_linear(float(image->bytes[at]) / 255.0F);
        }
        if (!is_finite(out.pixels[i])) {
            return fail(path, fmt::format("pixel {}, {}", i % std::size_t(out.width), i / std::size_t(out.width)),
                        "is not a finite number", "Compare pictures without NaN and infinity.");
        }
    }
    return out;
}

/// Radiance as the viewport would show it, linear in [0,1]; one exposure, the reference's, for both pictures.
Picture shown(Picture picture, float scale) {
    for (Rgb& c : picture.pixels) {
        c = filmic(c * scale);
    }
    return picture;
}

double log_average(const Picture& picture) {
    double sum = 0;
    double count = 0;
    for (const Rgb& c : picture.pixels) {
        if (luminance(c) > 0.0F) {
            sum += std::log(double(luminance(c)));
            ++count;
        }
    }
    return count > 0 ? std::exp(sum / count) : 0.0;
}

Result<Comparison> compare_images(const Arguments& a) {
    bool high_a = false;
    bool high_b = false;
    auto first = read_linear(a.a, high_a);
    auto second = first ? read_linear(a.b, high_b) : tl::unexpected(first.error());
    if (!second) {
        return tl::unexpected(second.error());
    }
    if (first->width != second->width || first->height != second->height) {
        return fail(
            a.b, "",
            fmt::format("is {}x{} pixels, but {} is {}x{}", second->width, second->height, a.a, first->width, first->height),
            "Compare pictures of one size.");
    }
    if (high_a != high_b) {
        return fail(a.b, "", "one picture holds radiance, the other display values",
                    "Compare .exr with .exr, .png with .png.");
    }
    std::vector<double> va;
    std::vector<double> vb;
    for (std::size_t i = 0; i < first->pixels.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            va.push_back(double(first->pixels[i][k]));
            vb.push_back(double(second->pixels[i][k]));
        }
    }
    Comparison out{"images", difference(va, vb), {}};
    if (high_b) {
        const float scale = exposure_scale(log_average(*second), 0.0F);
        out.flip = flip(shown(std::move(*first), scale), shown(std::move(*second), scale));
    } else {
        out.flip = flip(*first, *second);
    }
    return out;
}

Result<Comparison> compare_measurements(const Arguments& a) {
    auto first = read_points(a.a);
    auto second = first ? read_points(a.b) : tl::unexpected(first.error());
    if (!second) {
        return tl::unexpected(second.error());
    }
    if (first->size() != second->size()) {
        return fail(a.b, "", fmt::format("has {} points, but {} has {}", second->size(), a.a, first->size()));
    }
    std::vector<double> va;
    std::vector<double> vb;
    for (std::size_t i = 0; i < first->size(); ++i) {
        const SensorPoint& p = (*first)[i];
        const SensorPoint& q = (*second)[i];
        for (const auto& [point, file] : {std::pair(&p, &a.a), std::pair(&q, &a.b)}) {
            if (!point->illuminance) {
                return fail(*file, fmt::format("line {}", point->line), "has no value in column E",
                            "Compare files written by `atrium-cli measure`.");
            }
        }
        if (glm::distance(p.position, q.position) > 1e-4 || glm::dot(p.normal, q.normal) < 0.9999) {
            return fail(a.b, fmt::format("line {}", q.line), fmt::format("is another point than line {} of {}", p.line, a.a),
                        "Measure both at the same points, in the same order.");
        }
        va.push_back(*p.illuminance);
        vb.push_back(*q.illuminance);
    }
    return Comparison{"measurements", difference(va, vb), {}};
}

struct Project {
    Scene scene;
    std::shared_ptr<const Solution> solution;
};

Result<Project> read_project(const std::string& path) {
    auto loaded = load(path);
    if (!loaded) {
        return tl::unexpected(loaded.error());
    }
    if (loaded->solution.empty()) {
        return fail(path, "", "holds no light", "Solve it first: atrium-cli solve FILE -o PROJECT.atrium.");
    }
    auto solution = decode_solution(loaded->solution, loaded->scene);
    if (!solution) {
        return tl::unexpected(solution.error());
    }
    return Project{std::move(loaded->scene), *solution};
}

Result<Comparison> compare_projects(const Arguments& a) {
    auto first = read_project(a.a);
    auto second = first ? read_project(a.b) : tl::unexpected(first.error());
    if (!second) {
        return tl::unexpected(second.error());
    }
    const std::vector<SensorPlace> places = spread_places(second->scene, *second->solution, 2000);
    const std::vector<SensorReading> ours = read_surfaces(first->scene, *first->solution, places);
    const std::vector<SensorReading> theirs = read_surfaces(second->scene, *second->solution, places);
    std::vector<double> va;
    std::vector<double> vb;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (ours[i].on_surface && theirs[i].on_surface) {
            va.push_back(double(luminance(ours[i].irradiance)));
            vb.push_back(double(luminance(theirs[i].irradiance)));
        }
    }
    if (va.empty()) {
        return fail(a.b, "", "has no surface in common with " + a.a, "Compare projects of one scene.");
    }
    return Comparison{"projects", difference(va, vb), {}};
}

Result<Comparison> compare(const Arguments& a) {
    const auto kind = [](const std::string& path) {
        const std::string e = extension_of(path);
        return e == ".csv" ? 1 : e == ".atrium" ? 2 : e == ".exr" || e == ".hdr" || e == ".png" ? 0 : -1;
    };
    for (const std::string* path : {&a.a, &a.b}) {
        if (kind(*path) < 0) {
            return fail(*path, "", "is of a kind that cannot be compared",
                        "Give two .exr, .hdr or .png images, two .csv "
                        "measurements or two .atrium projects.");
        }
    }
    if (kind(a.a) != kind(a.b)) {
        return fail(a.b, "", "is of another kind than " + a.a, "Compare like with like.");
    }
    return kind(a.a) == 0 ? compare_images(a) : kind(a.a) == 1 ? compare_measurements(a) : compare_projects(a);
}

int run(const Arguments& a) {
    const auto result = compare(a);
    if (!result) {
        return refuse(result.error());
    }
    const Difference& d = result->figures;
    std::string text;
    if (a.json) {
        nlohmann::ordered_json out = {{"kind", result->kind},
                                      {"values", d.count},
                                      {"relMSE", d.rel_mse},
                                      {"relRMSE", d.rel_rmse},
                                      {"mean_relative_bias", d.mean_relative_bias},
                                      {"p95", d.p95},
                                      {"p99", d.p99}};
        if (result->flip) {
            out["FLIP"] = *result->flip;
        }
        text = out.dump(2) + "\n";
    } else {
        text = fmt::format(
            "{} values of {}\nrelMSE              {:.6g}\nrelRMSE             {:.6g}\nmean relative bias  {:.6g}\n"
            "p95                 {:.6g}\np99                 {:.6g}\n",
            d.count, result->kind, d.rel_mse, d.rel_rmse, d.mean_relative_bias, d.p95, d.p99);
        if (result->flip) {
            text += fmt::format("FLIP                {:.6g}\n", *result->flip);
        }
    }
    const auto written = write_text("-", text);
    return written ? kDone : refuse(written.error());
}

} // namespace

void add_compare(CLI::App& app, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("compare", "How far A is from the reference B: images, measurements or projects");
    command->add_option("A", a->a, "Image (.exr, .hdr, .png), measurement (.csv) or solved project (.atrium)")->required();
    command->add_option("B", a->b, "The reference, of the same kind")->required();
    command->add_flag("--json", a->json, "As one JSON object");
    command->callback([a, &status] { status = run(*a); });
}

} // namespace atrium::cli
