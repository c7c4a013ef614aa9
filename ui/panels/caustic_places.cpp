#include "ui/panels/caustic_places.h"

#include <algorithm>

namespace atrium::ui {

std::optional<ChartRectangle> chart_rectangle(const CausticRow& row) {
    if (row.textures.empty() || row.record.boxes.empty()) {
        return std::nullopt;
    }
    // A box is known in both: from the largest one to the whole.
    std::size_t best = 0;
    const std::size_t count = std::min(row.textures.size(), row.record.boxes.size());
    const auto area = [&](std::size_t i) {
        const vec4& b = row.record.boxes[i];
        return (b.z - b.x) * (b.w - b.y);
    };
    for (std::size_t i = 1; i < count; ++i) {
        best = area(i) > area(best) ? i : best;
    }
    const vec4& b = row.record.boxes[best];
    const CausticTexture& t = *row.textures[best];
    const vec2 share(b.z - b.x, b.w - b.y);
    if (!(share.x > 0.0F && share.y > 0.0F)) {
        return std::nullopt;
    }
    const vec2 size = (t.high - t.low) / share;
    const vec2 low = t.low - vec2(b.x, b.y) * size;
    return ChartRectangle{low, low + size};
}

const SurfaceLayer* layer_of(const Solution& solution, const CausticRow& row) {
    const auto at = std::find_if(solution.surfaces.begin(), solution.surfaces.end(), [&](const auto& layer) {
        return layer->node == row.record.node && layer->part == row.record.part;
    });
    return at == solution.surfaces.end() ? nullptr : at->get();
}

DBox3 piece_bounds(const Scene& scene, const Solution& solution, const CausticRow& row) {
    const SurfaceLayer* layer = layer_of(solution, row);
    if (!scene.nodes.contains(row.record.node) || layer == nullptr) {
        return scene.nodes.contains(row.record.node) ? scene.world_bounds(row.record.node) : DBox3();
    }
    const DisplayMesh& mesh = *layer->mesh;
    const dmat4 world = scene.world_matrix(row.record.node);
    const auto chart = chart_rectangle(row);
    constexpr float kSlack = 1e-2F; // tiles
    DBox3 piece, all;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const dvec3 at(world * dvec4(dvec3(mesh.positions[i]), 1.0));
        all.add(at);
        if (chart && i < mesh.light_uv.size()) {
            const vec2& uv = mesh.light_uv[i];
            if (uv.x >= chart->low.x - kSlack && uv.y >= chart->low.y - kSlack && uv.x <= chart->high.x + kSlack &&
                uv.y <= chart->high.y + kSlack) {
                piece.add(at);
            }
        }
    }
    return piece.empty() ? all : piece;
}

} // namespace atrium::ui
