// Where a part of the direct light can shine at all: tiles of charts within its reach.
#pragma once

#include "engine/layers/direct_map_builder.h"
#include "engine/layers/light_cells.h"
#include "engine/layers/light_sheets.h"

#include <vector>

namespace atrium {

/// Cells to divide where the light of a part may reach, starting from whole tiles, down to `level`; each before its own
/// quarters. Where more than `most_tiles` are within reach, those where the light may be strongest; 0 = all. What shines
/// anywhere (DirectPart::most is empty) reaches all. Coordinates are in steps, 2^max_level to a tile.
std::vector<LightCell> cells_within_reach(const LightSheets& sheets, const DirectPart& part, unsigned level,
                                          unsigned max_level, std::size_t most_tiles, const RunContext& context);

} // namespace atrium
