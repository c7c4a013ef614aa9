// What can still be had of a damaged scene file: cut off, or with a piece of it overwritten.
#pragma once

#include "engine/io/gltf_container.h"

namespace atrium::gltf {

/// As open_container(), but JSON text that ends or breaks is used as far as it goes, chunks as far as they are there, and
/// references to what is lost are taken out, so that the checks of a sound file pass. `repairs` tells what is missing, in
/// numbers. Refuses what is no scene file at all.
Container salvage_container(std::vector<std::uint8_t> bytes);

} // namespace atrium::gltf
