// How much memory the light of a scene may take.
#pragma once

#include "engine/solver/quality.h"

#include <cstddef>

namespace atrium {

/// Upper bound on the memory of every following solution of the process, bytes; 0 = half of the machine's. Engine thread
/// only, as set_thread_limit().
void set_memory_budget(std::size_t bytes);
/// The bound in force, bytes.
std::size_t memory_budget();

/// Lowers the most links, texels, vertices and particles that a quality allows until a solution of `triangles` triangles
/// stays within `bytes` together with what updates keep. What they bite on is coarser than the quality asks for: links stay
/// on larger elements, texels and triangles grow. Below some hundred MiB they stay at what a recognisable picture takes.
/// Depends on nothing else, so that the same budget gives the same light on any machine.
void keep_within(QualitySettings& quality, std::size_t bytes, std::size_t triangles);

} // namespace atrium
