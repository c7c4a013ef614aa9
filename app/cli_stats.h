// Statistics and scene facts as JSON with the names of CONTRACTS.
#pragma once

#include "app/cli_solving.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>

namespace atrium::cli {

/// What is in a scene, counted.
struct SceneFacts {
    std::size_t nodes = 0;
    std::size_t primitives = 0; ///< parts of shapes, counted once for every node that shows them
    std::size_t triangles = 0;  ///< drawn, instances counted each time
    std::size_t materials = 0;
    std::size_t lights = 0; ///< point, spot and directional lights; emitting surfaces are counted apart
    std::size_t emitters = 0;
    std::size_t cameras = 0;
    std::size_t textures = 0;
};
SceneFacts count(const Scene& scene);

nlohmann::ordered_json scene_json(const std::string& file, const Scene& scene);
nlohmann::ordered_json features_json(const std::vector<Feature>& features);
nlohmann::ordered_json problems_json(const std::vector<Problem>& problems);

/// Sizes of what a solve built, bytes.
nlohmann::ordered_json memory_json(const Statistics& statistics);
/// A node by name, or #N for the N-th of the file where it has none or shares it with others.
std::string surface_name(const Scene& scene, NodeId node);
/// What was decided about every chart that caustic light falls on.
nlohmann::ordered_json caustic_records_json(const Scene& scene, const Solution& solution);

/// The object of `--stats`.
nlohmann::ordered_json statistics_object(const Solved& solved);
/// JSON as files hold it: indented, with a final newline.
std::string as_text(const nlohmann::ordered_json& json);
/// The whole object of `--stats` as text.
std::string statistics_json(const Solved& solved);

} // namespace atrium::cli
