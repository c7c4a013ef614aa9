// What reads files from others, fed with any bytes: must refuse or read them, never crash, hang or take memory without
// bound.
#pragma once

#include <cstddef>
#include <cstdint>

namespace atrium::fuzz {

/// Each returns 0; a fault shows as a crash or a report of a sanitizer. Not for several threads at once.
int gltf(const std::uint8_t* data, std::size_t size);    ///< .gltf text; what was read is also written and read again
int glb(const std::uint8_t* data, std::size_t size);     ///< .glb
int project(const std::uint8_t* data, std::size_t size); ///< .atrium
int edit_script(const std::uint8_t* data, std::size_t size);
int points(const std::uint8_t* data, std::size_t size); ///< CSV of sensors
int ies(const std::uint8_t* data, std::size_t size);    ///< LM-63; what was read is looked up in all directions
int ldt(const std::uint8_t* data, std::size_t size);    ///< EULUMDAT

} // namespace atrium::fuzz
