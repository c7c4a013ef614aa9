// Edit scripts of `atrium-cli edit`: a JSON file with a list of edits.
#pragma once

#include "engine/base/result.h"
#include "engine/scene/edit_script.h"

#include <filesystem>
#include <string>

namespace atrium {

/// {"edits": [{"kind": "move", "node": "Chair", "translation": [0, 0, 1]}, ...]}. Whatever is not understood is refused with
/// the edit's index, what is wrong and what would be right; names are looked up later (rehearse()).
Result<EditScript> read_edit_script(const std::filesystem::path& path);
/// The same from text; `file` is for messages.
Result<EditScript> parse_edit_script(const std::string& text, const std::string& file);

} // namespace atrium
