// Textures whose image files were not where the scene file says: which they are, and where they may be.
#pragma once

#include "engine/base/run_context.h"
#include "engine/scene/scene.h"

#include <filesystem>
#include <utility>
#include <vector>

namespace atrium {

/// Textures that name a file and have no content, in the order of the scene.
std::vector<TextureId> missing_textures(const Scene& scene);

/// Looks for the files of the scene's missing textures in `folder` and below (at most 8 levels and 100,000 entries; links
/// to folders are not followed), by name without regard to case. Of several the one whose path agrees with the texture's on
/// the most folders wins, then the first by name. Textures that were found, with content and decoded; those whose file
/// is no image stay missing. Any thread; stops when asked.
std::vector<std::pair<TextureId, Texture>> find_missing_textures(const Scene& scene, const std::filesystem::path& folder,
                                                                 const RunContext& context);

} // namespace atrium
