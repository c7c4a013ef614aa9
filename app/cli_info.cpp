// atrium-cli info: what is in a file, what the scene needs, what is wrong with it.
#include "app/cli_commands.h"
#include "app/cli_problems.h"
#include "app/cli_stats.h"
#include "engine/scene/photometric_web.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace atrium::cli {

namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
    std::string file;
    bool json = false;
};

std::vector<std::string> camera_names(const Scene& scene) {
    std::vector<std::string> names;
    for (const NodeId id : scene.in_tree_order()) {
        const Node& node = *scene.nodes.find(id);
        if (const Camera* camera = scene.cameras.find(node.camera)) {
            names.push_back(camera->name.empty() ? node.name : camera->name);
        }
    }
    return names;
}

/// Calls f(name, light) for every lamp that shines as a photometric file says, in tree order.
template <class F> void for_each_measured_lamp(const Scene& scene, F&& f) {
    for (const NodeId id : scene.in_tree_order()) {
        const Node& node = *scene.nodes.find(id);
        const Light* light = scene.lights.find(node.light);
        if (light != nullptr && light_distribution(*light) != nullptr) {
            f(node.name.empty() ? light->name : node.name, *light);
        }
    }
}

Json photometry_json(const Scene& scene) {
    Json out = Json::array();
    for_each_measured_lamp(scene, [&out](const std::string& name, const Light& light) {
        const PhotometricWeb& web = *light.photometry.web;
        out.push_back({{"node", name},
                       {"file", web.data().file_name},
                       {"manufacturer", web.data().manufacturer},
                       {"luminaire", web.data().luminaire},
                       {"file_lumens", web.flux()},
                       {"lumens", light.enabled ? flux_of(light) : 0.0},
                       {"dimming", light.intensity / web.peak()},
                       {"peak_candela", web.peak()},
                       {"luminous_opening_m",
                        {std::abs(web.data().luminous_opening.x), std::abs(web.data().luminous_opening.y),
                         std::abs(web.data().luminous_opening.z)}},
                       {"beam_degrees", {web.beam_angle(0.0), web.beam_angle(90.0)}}});
    });
    return out;
}

Json as_json(const std::string& file, const LoadedScene& loaded, const std::vector<Problem>& problems) {
    const Scene& scene = loaded.scene;
    const DBox3 bounds = scene.bounds();
    Json out;
    out["version"] = ATRIUM_VERSION;
    out["scene"] = scene_json(file, scene);
    out["camera_names"] = camera_names(scene);
    out["bounds"] = bounds.empty() ? Json(nullptr)
                                   : Json{{"min", {bounds.min.x, bounds.min.y, bounds.min.z}},
                                          {"max", {bounds.max.x, bounds.max.y, bounds.max.z}}};
    out["sky_radiance"] = {scene.environment.sky_radiance.r, scene.environment.sky_radiance.g,
                           scene.environment.sky_radiance.b};
    out["photometry"] = photometry_json(scene);
    out["has_solution"] = !loaded.solution.empty();
    out["features"] = features_json(scene_features(scene));
    out["problems"] = problems_json(problems);
    return out;
}

std::string as_text(const std::string& file, const LoadedScene& loaded, const std::vector<Problem>& problems) {
    const Scene& scene = loaded.scene;
    const SceneFacts facts = count(scene);
    const DBox3 bounds = scene.bounds();
    std::string out = file + "\n";
    const auto line = [&out](const char* name, const std::string& value) {
        out += fmt::format("  {:<12} {}\n", name, value);
    };
    line("nodes", fmt::format("{}", facts.nodes));
    line("primitives", fmt::format("{}", facts.primitives));
    line("triangles", fmt::format("{}", facts.triangles));
    line("materials", fmt::format("{}", facts.materials));
    line("textures", fmt::format("{}", facts.textures));
    line("lights", fmt::format("{} and {} emitting surfaces", facts.lights, facts.emitters));
    const char* title = "photometry";
    for_each_measured_lamp(scene, [&](const std::string& name, const Light& light) {
        const PhotometricWeb& web = *light.photometry.web;
        std::string value = fmt::format("{}: {}, {:.0f} lm", name, web.data().file_name, flux_of(light));
        if (const float dimming = light.intensity / web.peak(); std::abs(dimming - 1.0F) > 1e-4F) {
            value += fmt::format(" ({:.0f} % of its intensity)", 100.0F * dimming);
        }
        double across = web.beam_angle(0.0), along = web.beam_angle(90.0);
        if (across < 0.5 || along < 0.5) {
            across = along = std::max(across, along); // aimed to one side: no plane but that one is as bright
        }
        if (across < 360.0) {
            value += std::abs(across - along) < 0.5 ? fmt::format(", beam {:.0f} degrees", across)
                                                    : fmt::format(", beam {:.0f} x {:.0f} degrees", across, along);
        }
        line(title, value + (light.enabled ? "" : ", off"));
        title = "";
    });
    if (!bounds.empty()) {
        const dvec3 size = bounds.size();
        line("size", fmt::format("{:.3f} x {:.3f} x {:.3f} m (x, y up, z)", size.x, size.y, size.z));
    }
    const auto cameras = camera_names(scene);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        line(i == 0 ? "cameras" : "", fmt::format("{} {}", i, cameras[i]));
    }
    line("solution", loaded.solution.empty() ? "none stored" : fmt::format("stored, {} bytes", loaded.solution.size()));
    out += "needs\n";
    for (const Feature& feature : scene_features(scene)) {
        out += fmt::format("  {:<18} {:<4} {}\n", feature.name, feature.used ? "yes" : "no", feature.why);
    }
    out += fmt::format("problems: {}\n", problems.size());
    for (const Problem& problem : problems) {
        out += "  " + problem_line(problem) + "\n";
    }
    return out;
}

int run(const Arguments& a) {
    auto loaded = read_scene(a.file);
    if (!loaded) {
        return refuse(loaded.error());
    }
    const auto problems = all_problems(*loaded);
    const std::string text =
        a.json ? as_json(a.file, *loaded, problems).dump(2, ' ', false, Json::error_handler_t::replace) + "\n"
               : as_text(a.file, *loaded, problems);
    const auto written = write_text("-", text);
    return written ? kDone : refuse(written.error());
}

} // namespace

void add_info(CLI::App& app, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("info", "What is in a file, what the scene needs, problems found");
    command->add_option("FILE", a->file, "Scene: .gltf, .glb or .atrium")->required();
    command->add_flag("--json", a->json, "As one JSON object");
    command->callback([a, &status] { status = run(*a); });
}

} // namespace atrium::cli
