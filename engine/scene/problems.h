// What is wrong with a scene, by id, in words for its author.
#pragma once

#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace atrium {

/// One finding. Errors make `atrium-cli check` fail; warnings were worked around; notes are for information.
struct Problem {
    enum class Severity : std::uint8_t { Note, Warning, Error };
    Severity severity = Severity::Warning;
    NodeId node;       ///< none when it concerns the whole file
    std::string where; ///< node, material or accessor by name
    std::string what;
    std::string hint;
    friend bool operator==(const Problem&, const Problem&) = default;
};
const char* severity_name(Problem::Severity severity); ///< "note", "warning", "error"

/// Checks a scene by itself: no light, reflectance above the limit, zero scale, empty shapes, dangling ids, extents beyond
/// 1e4 m, cameras inside out. Sorted by severity (errors first), then tree order.
std::vector<Problem> find_problems(const Scene& scene);

/// A file in millimetres (or centimetres, feet, inches) or with +Z up, recognised by size and shape. Never applied
/// silently: the editor offers it, `check` reports it.
struct ImportSuggestion {
    double unit_scale = 1.0; ///< multiply coordinates by this to get metres; 1 = no change
    bool z_up = false;       ///< rotate +Z to +Y
    std::string why;
    [[nodiscard]] bool any() const { return unit_scale != 1.0 || z_up; }
};
ImportSuggestion suggest_import_fix(const Scene& scene);

} // namespace atrium
