#include "engine/caustics/chart_work.h"

#include "engine/caustics/reconstruction.h"

namespace atrium {

double ChartWork::fullest() const {
    constexpr double kFullest = 0.01; // of what a texel may hold: the mean over a chart
    return kFullest * CausticAccumulator::kMost * domain.area;
}

TexelGrid ChartWork::grid_of(const CellBox& box, int width, int height) const {
    const vec2 texel = size() / vec2(float(width), float(height));
    const vec2 low = domain.low + texel * vec2(float(box.x0), float(box.y0));
    const vec2 high = domain.low + texel * vec2(float(box.x1), float(box.y1));
    return make_grid(domain, charts, positions, triangles, low, high, std::uint32_t(box.x1 - box.x0),
                     std::uint32_t(box.y1 - box.y0));
}

void ChartWork::keep(const TexelGrid& grid, std::vector<Rgb> image) {
    fill_around(image, grid);
    auto texture = std::make_shared<CausticTexture>();
    texture->low = grid.low;
    texture->high = grid.high;
    texture->width = grid.width;
    texture->height = grid.height;
    texture->image = std::move(image);
    record.bytes += texture->memory_bytes();
    const vec2 a = (grid.low - domain.low) / size();
    const vec2 b = (grid.high - domain.low) / size();
    record.boxes.emplace_back(a.x, a.y, b.x, b.y);
    textures.push_back(std::move(texture));
}

// Too few particles to fill a texture stay too few, whatever is wished.
void obey_wish(ChartWork& work) {
    using Decision = CausticRecord::Decision;
    CausticRecord& record = work.record;
    const CausticWish::Show show = work.settings.wish.show;
    record.found = record.decision;
    if (show == CausticWish::Show::Mesh) {
        record.decision = Decision::SetToMesh;
    } else if (show == CausticWish::Show::Texture && record.decision != Decision::TooFew) {
        record.decision = Decision::Texture;
    }
}

} // namespace atrium
