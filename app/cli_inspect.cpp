// atrium-cli inspect: what was decided about caustic light and why, what a solution consists of.
#include "app/cli_commands.h"
#include "app/cli_solving.h"
#include "app/cli_stats.h"
#include "engine/io/image_file.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace atrium::cli {

namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
    std::string file;
    bool json = false;
    std::string extract;
    SolveArguments solve;
};

/// A texture and where it is found in the table.
struct Extracted {
    std::shared_ptr<const CausticTexture> texture;
    std::string surface;
    std::uint32_t part = 0;
    bool back = false;
    std::string file; ///< within the folder; empty when nothing is extracted
};

/// Letters, digits, dots and the like stay; a name must not lead out of the folder.
std::string as_file_name(const std::string& name) {
    std::string out;
    for (const char c : name.substr(0, 60)) {
        const bool plain =
            (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
        out += plain ? c : '_';
    }
    return out;
}

/// All textures of the solution, surface by surface.
std::vector<Extracted> textures_of(const Scene& scene, const Solution& solution) {
    std::vector<Extracted> out;
    for (const auto& layer : solution.surfaces) {
        for (const bool back : {false, true}) {
            for (const auto& texture : back ? layer->caustic_textures_back : layer->caustic_textures_front) {
                out.push_back({texture, surface_name(scene, layer->node), layer->part, back, ""});
            }
        }
    }
    return out;
}

Result<void> extract(std::vector<Extracted>& textures, const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        return fail(folder, "--extract", "the folder cannot be made: " + error.message(), "Name another folder.");
    }
    for (std::size_t i = 0; i < textures.size(); ++i) {
        Extracted& t = textures[i];
        t.file = fmt::format("{:03}_{}_{}_{}.exr", i, as_file_name(t.surface), t.part, t.back ? "back" : "front");
        Picture picture;
        picture.width = int(t.texture->width);
        picture.height = int(t.texture->height);
        // A picture's rows go from the top, a texture's from its low edge: v points up.
        for (std::uint32_t y = t.texture->height; y-- > 0;) {
            const auto row = t.texture->image.begin() + std::ptrdiff_t(std::size_t(y) * t.texture->width);
            picture.pixels.insert(picture.pixels.end(), row, row + t.texture->width);
        }
        if (auto written = write_picture(std::filesystem::path(folder) / t.file, picture); !written) {
            return written;
        }
    }
    return {};
}

std::string as_json(const Solved& solved, const std::vector<Extracted>& textures) {
    const Statistics& s = solved.solution->statistics;
    Json out;
    out["version"] = ATRIUM_VERSION;
    out["file"] = solved.file;
    out["mode"] = s.mode;
    out["quality"] = s.quality;
    out["solution_stored"] = solved.from_file;
    out["caustics"] = caustic_records_json(solved.scene, *solved.solution);
    out["textures"] = Json::array();
    for (const Extracted& t : textures) {
        Json one = {{"surface", t.surface},
                    {"part", t.part},
                    {"side", t.back ? "back" : "front"},
                    {"width", t.texture->width},
                    {"height", t.texture->height},
                    {"rectangle", {t.texture->low.x, t.texture->low.y, t.texture->high.x, t.texture->high.y}},
                    {"memory", t.texture->memory_bytes()}};
        if (!t.file.empty()) {
            one["file"] = t.file;
        }
        out["textures"].push_back(one);
    }
    out["elements"] = s.elements;
    out["clusters"] = s.clusters;
    out["links"] = s.links;
    out["rays"] = s.rays;
    out["particles_emitted"] = s.particles_emitted;
    out["particles_stored"] = s.particles_stored;
    out["octree"] = nullptr;
    out["memory"] = memory_json(s);
    out["features"] = features_json(s.features);
    return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string table(const Solved& solved) {
    const auto& records = solved.solution->caustic_records;
    if (records.empty()) {
        return "caustics: none\n";
    }
    std::string out = fmt::format(
        "caustics, {} charts\n  {:<24} {:>4} {:>5} {:<5} {:<28} {:>9} {:>8} {:>20} {:>9} {:>5} {:>10} {:>10} {:>9}\n",
        records.size(), "surface", "part", "chart", "side", "decision", "particles", "contrast", "dispersion (limit)",
        "texels", "boxes", "lm texture", "lm mesh", "bytes");
    const bool paper = solved.solution->statistics.mode == "paper";
    for (const CausticRecord& r : records) {
        // What the threshold is about is another figure in paper mode.
        const std::string held =
            paper ? fmt::format("{:.3g}", r.dispersion) : fmt::format("{:.3g} ({:.3g})", r.dispersion, r.threshold);
        const std::string contrast =
            paper ? fmt::format("{:.2f} ({:.2g})", r.contrast, r.threshold) : fmt::format("{:.2f}", r.contrast);
        out +=
            fmt::format("  {:<24} {:>4} {:>5} {:<5} {:<28} {:>9} {:>8} {:>20} {:>9} {:>5} {:>10.4g} {:>10.4g} {:>9}\n",
                        surface_name(solved.scene, r.node), r.part, r.chart == 0xFFFFFFFFU ? "-" : std::to_string(r.chart),
                        r.back ? "back" : "front", caustic_decision_name(r.decision), r.particles, contrast, held,
                        r.boxes.empty() ? "-" : fmt::format("{}x{}", r.width, r.height), r.boxes.size(), r.power_texture,
                        r.power_mesh, r.bytes);
        if (!r.why.empty()) {
            out += fmt::format("      {}\n", r.why);
        }
        for (const vec4& b : r.boxes) {
            out += fmt::format("      box {:.3f} {:.3f} to {:.3f} {:.3f}, {:.3f} x {:.3f} m of {:.3f} x {:.3f} m\n", b.x,
                               b.y, b.z, b.w, (b.z - b.x) * r.extent.x, (b.w - b.y) * r.extent.y, r.extent.x, r.extent.y);
        }
    }
    return out;
}

std::string as_text(const Solved& solved, const std::vector<Extracted>& textures) {
    const Statistics& s = solved.solution->statistics;
    std::string out = fmt::format("{}: {} quality, {} mode, {}\n", solved.file, s.quality, s.mode,
                                  solved.from_file ? "stored light" : "solved now");
    out += table(solved);
    for (const Extracted& t : textures) {
        if (!t.file.empty()) {
            out += fmt::format("  written: {}\n", t.file);
        }
    }
    out += fmt::format("elements: {}\nclusters: {}\nlinks: {}\nparticles: {} emitted, {} stored\noctree: none\n", s.elements,
                       s.clusters, s.links, s.particles_emitted, s.particles_stored);
    out += "memory, bytes\n";
    const Json memory = memory_json(s);
    for (const auto& [name, bytes] : memory.items()) {
        out += fmt::format("  {:<18} {}\n", name, bytes.get<std::uint64_t>());
    }
    out += "left out\n";
    for (const Feature& feature : s.features) {
        if (!feature.used) {
            out += fmt::format("  {:<18} {}\n", feature.name, feature.why);
        }
    }
    return out;
}

int run(const Arguments& a) {
    auto solved = open_scene(a.file, a.solve);
    if (!solved) {
        return solved.error();
    }
    if (const int status = light_up(*solved, a.solve, false); status != kDone) {
        return status;
    }
    std::vector<Extracted> textures = textures_of(solved->scene, *solved->solution);
    if (!a.extract.empty()) {
        if (auto done = extract(textures, a.extract); !done) {
            return refuse(done.error());
        }
    }
    if (auto written = write_text("-", a.json ? as_json(*solved, textures) : as_text(*solved, textures)); !written) {
        return refuse(written.error());
    }
    return finish(*solved, a.solve);
}

} // namespace

void add_inspect(CLI::App& app, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("inspect", "Caustic textures and why they are there, links, particles, memory");
    command->add_option("FILE", a->file, "Scene: .gltf, .glb or .atrium; solved unless it holds light")->required();
    command->add_flag("--json", a->json, "As one JSON object");
    command->add_option("--extract", a->extract, "Write every caustic texture to this folder: .exr in lux, v pointing up");
    add_solve_options(*command, a->solve);
    command->callback([a, &status] { status = run(*a); });
}

} // namespace atrium::cli
