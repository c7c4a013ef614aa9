// Light maps as few bytes: they are the largest part of a stored solution.
#pragma once

#include "engine/layers/light_map.h"
#include "engine/solver/byte_stream.h"

namespace atrium {

/// Appends a map. Samples are kept as halves over a power of two that suits the map's largest: relative error at most
/// 2^-11 (0.05 %) for all that is brighter than 2e-9 of it. Writing what was read gives the same bytes.
void write_light_map(ByteWriter& out, const LightMap& map);
/// False when the bytes are damaged: a used tile that reaches out of the image or is finer than level kFinestLevel, samples
/// that are not finite, too few bytes. A map that was read can be evaluated anywhere.
bool read_light_map(ByteReader& in, LightMap& map);

/// Finest level of a tile that is read: 4097 samples a side.
inline constexpr int kFinestLevel = 12;

} // namespace atrium
