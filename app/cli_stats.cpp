#include "app/cli_stats.h"

#include "engine/base/parallel.h"
#include "engine/geometry/tessellate.h"
#include "engine/solver/statistics_figures.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>

namespace atrium::cli {

using Json = nlohmann::ordered_json;

SceneFacts count(const Scene& scene) {
    SceneFacts facts;
    std::map<ShapeId, std::size_t> triangles;
    for (const NodeId id : scene.in_tree_order()) {
        const Node& node = *scene.nodes.find(id);
        ++facts.nodes;
        facts.lights += scene.lights.contains(node.light) ? 1U : 0U;
        facts.cameras += scene.cameras.contains(node.camera) ? 1U : 0U;
        const Shape* shape = scene.shapes.find(node.shape);
        if (shape == nullptr) {
            continue;
        }
        const std::size_t parts = part_count(*shape);
        facts.primitives += parts;
        auto known = triangles.find(node.shape);
        if (known == triangles.end()) {
            known = triangles.emplace(node.shape, tessellate(shape->geometry)->indices.size() / 3).first;
        }
        facts.triangles += known->second;
        for (std::size_t part = 0; part < parts; ++part) {
            const Material* material = scene.material_of(node, part);
            facts.emitters += material != nullptr && material->emits() ? 1U : 0U;
        }
    }
    facts.materials = scene.materials.size();
    facts.textures = scene.textures.size();
    return facts;
}

Json scene_json(const std::string& file, const Scene& scene) {
    const SceneFacts facts = count(scene);
    return {{"file", file},
            {"nodes", facts.nodes},
            {"primitives", facts.primitives},
            {"triangles", facts.triangles},
            {"materials", facts.materials},
            {"lights", facts.lights},
            {"emitters", facts.emitters},
            {"cameras", facts.cameras},
            {"textures", facts.textures}};
}

Json features_json(const std::vector<Feature>& features) {
    Json out = Json::object();
    for (const Feature& feature : features) {
        out[feature.name] = {{"used", feature.used}, {"why", feature.why}};
    }
    return out;
}

Json problems_json(const std::vector<Problem>& problems) {
    Json out = Json::array();
    for (const Problem& p : problems) {
        out.push_back({{"severity", severity_name(p.severity)}, {"where", p.where}, {"what", p.what}, {"hint", p.hint}});
    }
    return out;
}

namespace {

/// Groups become objects.
Json figures_json(const Statistics& s) {
    Json out = Json::object();
    for (const StatisticsFigure& figure : statistics_figures(s)) {
        const std::size_t point = figure.key.find('.');
        Json& place =
            point == std::string::npos ? out[figure.key] : out[figure.key.substr(0, point)][figure.key.substr(point + 1)];
        std::visit([&place](auto v) { place = v; }, figure.value);
    }
    return out;
}

} // namespace

Json memory_json(const Statistics& statistics) {
    Statistics s = statistics;
    s.memory.peak_rss = peak_resident_bytes();
    return figures_json(s)["memory"];
}

std::string surface_name(const Scene& scene, NodeId id) {
    const Node* node = scene.nodes.find(id);
    std::size_t place = 0, same = 0, at = 0;
    for (const NodeId other : scene.in_tree_order()) {
        same += node != nullptr && scene.nodes.find(other)->name == node->name ? 1U : 0U;
        place = other == id ? at : place;
        ++at;
    }
    return node != nullptr && !node->name.empty() && same == 1 ? node->name : fmt::format("#{}", place);
}

Json caustic_records_json(const Scene& scene, const Solution& solution) {
    Json out = Json::array();
    for (const CausticRecord& r : solution.caustic_records) {
        Json boxes = Json::array();
        Json metres = Json::array();
        for (const vec4& b : r.boxes) {
            boxes.push_back({b.x, b.y, b.z, b.w});
            metres.push_back({b.x * r.extent.x, b.y * r.extent.y, b.z * r.extent.x, b.w * r.extent.y});
        }
        out.push_back({{"surface", surface_name(scene, r.node)},
                       {"part", r.part},
                       {"chart", r.chart == 0xFFFFFFFFU ? Json(nullptr) : Json(r.chart)},
                       {"side", r.back ? "back" : "front"},
                       {"decision", caustic_decision_name(r.decision)},
                       {"why", r.why},
                       {"set_by_hand", !r.wish.automatic()},
                       {"decision_by_itself", caustic_decision_name(r.found)},
                       {"kernel", r.kernel},
                       {"particles", r.particles},
                       {"contrast", r.contrast},
                       {"dispersion", r.dispersion},
                       {"threshold", r.threshold},
                       {"width", r.width},
                       {"height", r.height},
                       {"extent", {r.extent.x, r.extent.y}},
                       {"boxes", boxes},
                       {"boxes_metres", metres},
                       {"lumen_texture", r.power_texture},
                       {"lumen_mesh", r.power_mesh},
                       {"memory", r.bytes}});
    }
    return out;
}

Json statistics_object(const Solved& solved) {
    Statistics s;
    if (solved.solution) {
        s = solved.solution->statistics;
    }
    if (s.features.empty()) {
        s.features = scene_features(solved.scene);
    }
    // Light that came with the project cost this run nothing but reading it.
    const bool solved_here = solved.solution && !solved.from_file;
    Json phases = Json::array();
    if (solved_here) {
        for (const Statistics::Phase& phase : s.phases) {
            phases.push_back({{"name", phase.name}, {"seconds", phase.seconds}, {"share", phase.share}});
        }
    }
    Json out;
    out["version"] = ATRIUM_VERSION;
    out["scene"] = scene_json(solved.file, solved.scene);
    out["threads"] = solved_here ? s.threads : thread_limit();
    out["seed"] = s.seed;
    out["mode"] = s.mode;
    out["quality"] = s.quality;
    out["features"] = features_json(s.features);
    out["time"] = {{"load", solved.load_seconds},
                   {"build", solved_here ? s.time.build : 0.0},
                   {"solve", solved_here ? s.time.solve : 0.0},
                   {"first_picture", solved_here ? s.time.first_picture : 0.0},
                   {"total", seconds_since_start()}};
    out["phases"] = phases;
    s.converged = s.converged && !solved.stopped;
    s.memory.peak_rss = peak_resident_bytes();
    const Json figures = figures_json(s);
    for (const auto& [key, value] : figures.items()) {
        if (key != "memory" && key != "energy") { // they come last
            out[key] = value;
        }
    }
    out["caustic_textures"] = solved.solution ? caustic_records_json(solved.scene, *solved.solution) : Json(Json::array());
    out["memory"] = figures["memory"];
    out["energy"] = figures["energy"];
    out["stopped"] = solved.stopped;
    out["solution_reused"] = solved.from_file;
    return out;
}

std::string as_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::string statistics_json(const Solved& solved) { return as_text(statistics_object(solved)); }

} // namespace atrium::cli
