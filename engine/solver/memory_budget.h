// How much memory the light of a scene may take.
#pragma once

#include "engine/scene/features.h"
#include "engine/solver/quality.h"

#include <cstddef>
#include <string>
#include <vector>

namespace atrium {

/// Upper bound on the memory of every following solution of the process, bytes; 0 = half of the machine's. Any thread.
void set_memory_budget(std::size_t bytes);
/// Half of the machine's memory, bytes.
std::size_t default_memory_budget();
/// The bound in force, bytes.
std::size_t memory_budget();

/// What a budget holds less of than a quality asks for. Whether a solution would have had more of it is another matter.
struct LoweredByMemory {
    bool links = false;
    bool texels = false; ///< of light maps
    bool vertices = false;
    bool particles = false;
    bool caustic_texels = false;
};
/// Tells in the features what of this a solution would have had more of, in place of what was told before.
void tell_lowered(std::vector<Feature>& features, const LoweredByMemory& lowered);
/// Names of the features by which tell_lowered() told something, as "finer_light_maps".
std::vector<std::string> lowered_by_memory(const std::vector<Feature>& features);

/// Lowers the most links, texels, vertices and particles that a quality allows until a solution of `triangles` triangles
/// stays within `bytes` together with what updates keep. What they bite on is coarser than the quality asks for: links stay
/// on larger elements, texels and triangles grow. Below some hundred MiB they stay at what a recognisable picture takes.
/// Depends on nothing else, so that the same budget gives the same light on any machine.
LoweredByMemory keep_within(QualitySettings& quality, std::size_t bytes, std::size_t triangles);

} // namespace atrium
