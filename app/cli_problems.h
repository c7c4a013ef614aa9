// Everything that can be said against a file: from reading it, from the scene itself, from its size.
#pragma once

#include "engine/io/scene_file.h"

#include <string>
#include <vector>

namespace atrium::cli {

/// Problems of the file, of the scene and a suggestion about units, errors first.
std::vector<Problem> all_problems(const LoadedScene& loaded);
/// "error: Node 'x': what. hint"
std::string problem_line(const Problem& problem);

} // namespace atrium::cli
