// From the cells that were looked at to the light maps that are kept.
#pragma once

#include "engine/base/run_context.h"
#include "engine/layers/light_cells.h"
#include "engine/layers/light_map.h"

#include <span>

namespace atrium {

/// Place of a sheet's rectangle in its surface's chart space, tiles.
struct SheetPlace {
    std::uint32_t sheet = 0;
    std::uint32_t tile_u = 0;
    std::uint32_t tile_v = 0;
    std::uint32_t tiles_u = 0;
    std::uint32_t tiles_v = 0;
};

/// Gives nodes that are covered, and then those away from the surface, the mean of their neighbours, outwards from known
/// ones. Nodes that no known one is connected with stay as they are: wholly enclosed, dark, seen by nobody. Returns what
/// they were before, for who wants to look at the cells again. `marks` are the cells' own and stay true.
std::vector<std::pair<std::uint32_t, LightNode>> fill_unknown_nodes(LightCells& cells, std::span<const SheetPlace> sheets,
                                                                    std::vector<std::uint8_t>& marks);

/// Cells of a part of the light, without unknown nodes, and their LightCells::tile_marks().
struct PartCells {
    const LightCells* cells = nullptr;
    std::vector<std::uint8_t> marks = {};
};

/// The light map of one side of a surface from the sheets of its charts, the sum of `parts`, which have the same sheets;
/// chart space of width * height tiles. It has the texels of a map of `all` parts. Tiles that meet agree along their common
/// edge, whatever their levels. `context` may stop it: the map is then not to be used.
LightMap assemble_light_map(std::span<const PartCells> parts, std::span<LightCells* const> all,
                            std::span<const SheetPlace> sheets, std::uint32_t width, std::uint32_t height,
                            const RunContext& context);

} // namespace atrium
