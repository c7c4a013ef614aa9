// Triangles that lie where another one of their mesh lies: doubles, and twins that are turned round.
#pragma once

#include "engine/base/run_context.h"
#include "engine/geometry/primitives.h"

#include <cstdint>
#include <vector>

namespace atrium {

/// Of a whole mesh. Numbers of triangles count within a part and ascend.
struct RepeatedTriangles {
    struct Part {
        std::vector<std::uint32_t> same;   ///< lie as an earlier one of the part does, the same way round
        std::vector<std::uint32_t> turned; ///< lie on an earlier one of the part, the first there that is turned round
    };
    std::vector<Part> parts;
    bool twins = false; ///< somewhere two lie in one place and face apart, in one part or in two
};

/// Compares corners bit for bit, in the mesh's own coordinates and whatever their order; triangles without area count as any
/// other. O(n). What it returns when stopped is of no use.
RepeatedTriangles repeated_triangles(const MeshData& mesh, const RunContext& context = {});

} // namespace atrium
