#include "engine/layers/near_things.h"

#include "engine/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace atrium {
namespace {

constexpr std::uint32_t kBlock = 32; // triangles; neighbours in a mesh are mostly neighbours in space
constexpr float kInPlane = 0.002F;   // metres before a sheet that still count as in its plane

constexpr float kEdgesAway = 0.25F;    // what stands this many edges from a cell may be left out of sight
constexpr float kBeyondBorder = 0.25F; // edges of a cell that its corners may lie beyond the border of the chart
constexpr float kNarrow = 0.16F;       // metres: what is narrower shows by itself where to look closer

bool meet(const Box3& a, const Box3& b) {
    for (int k = 0; k < 3; ++k) {
        if (a.min[k] > b.max[k] || b.min[k] > a.max[k]) {
            return false;
        }
    }
    return true;
}

} // namespace

NearThings::NearThings(const RayScene& rays, float reach)
    : rays_(rays), reach_(reach), boxes_(rays.surfaces().size()), blocks_(rays.surfaces().size()) {
    parallel_chunks(boxes_.size(), 16, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (auto s = std::uint32_t(begin); s < end; ++s) {
            const auto count = std::uint32_t(rays_.surfaces()[s].triangles.size());
            for (std::uint32_t first = 0; first < count; first += kBlock) {
                Block block{{}, first, std::min(first + kBlock, count)};
                for (std::uint32_t t = block.first; t < block.last; ++t) {
                    for (const vec3& p : rays_.triangle(s, t)) {
                        block.box.add(p);
                    }
                }
                boxes_[s].add(block.box.min);
                boxes_[s].add(block.box.max);
                blocks_[s].push_back(block);
            }
        }
    });
}

std::vector<std::vector<NearThings::Triangle>> NearThings::before(const LightSheet& sheet) const {
    const Chart& chart = *sheet.chart;
    std::vector<std::vector<Triangle>> out(std::size_t(chart.tiles_u) * chart.tiles_v);
    const vec2 size = vec2(float(chart.tiles_u), float(chart.tiles_v)) * chart.scale;
    const vec3 normal = sheet.back ? -chart.normal : chart.normal;
    Box3 around;
    for (int k = 0; k < 4; ++k) {
        around.add(chart.origin + chart.axis_u * (k % 2 != 0 ? size.x : 0.0F) + chart.axis_v * (k / 2 != 0 ? size.y : 0.0F));
    }
    around.min -= reach_;
    around.max += reach_;
    for (std::uint32_t s = 0; s < boxes_.size(); ++s) {
        if (!meet(boxes_[s], around)) {
            continue;
        }
        for (const Block& block : blocks_[s]) {
            if (!meet(block.box, around)) {
                continue;
            }
            for (std::uint32_t t = block.first; t < block.last; ++t) {
                const auto corner = rays_.triangle(s, t);
                Triangle local;
                Box3 box;
                for (std::size_t k = 0; k < 3; ++k) {
                    const vec3 d = corner[k] - chart.origin;
                    local[k] = {glm::dot(d, chart.axis_u), glm::dot(d, chart.axis_v), glm::dot(d, normal)};
                    box.add(local[k]);
                }
                if (box.max.z <= kInPlane || box.min.z > reach_) {
                    continue;
                }
                const auto tile = [](float metres, float scale, std::uint32_t count) {
                    return std::clamp(int(std::floor(metres / scale)), 0, int(count) - 1);
                };
                if (box.max.x < -reach_ || box.max.y < -reach_ || box.min.x > size.x + reach_ ||
                    box.min.y > size.y + reach_) {
                    continue;
                }
                const int u1 = tile(box.max.x + reach_, chart.scale.x, chart.tiles_u);
                const int v1 = tile(box.max.y + reach_, chart.scale.y, chart.tiles_v);
                for (int v = tile(box.min.y - reach_, chart.scale.y, chart.tiles_v); v <= v1; ++v) {
                    for (int u = tile(box.min.x - reach_, chart.scale.x, chart.tiles_u); u <= u1; ++u) {
                        const std::size_t at = std::size_t(v) * chart.tiles_u + std::size_t(u);
                        if (sheet.used[at] != 0) {
                            out[at].push_back(local);
                        }
                    }
                }
            }
        }
    }
    return out;
}

// The nearest point of a triangle by the regions of its plane (Ericson, Real-Time Collision Detection, 5.1.5).
float distance_to(const NearThings::Triangle& t, const vec2& place) {
    const vec3 p(place, 0.0F);
    const vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0F && d2 <= 0.0F) {
        return glm::length(ap);
    }
    const vec3 bp = p - t[1];
    const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0F && d4 <= d3) {
        return glm::length(bp);
    }
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F) {
        return glm::length(ap - ab * (d1 / (d1 - d3)));
    }
    const vec3 cp = p - t[2];
    const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0F && d5 <= d6) {
        return glm::length(cp);
    }
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F) {
        return glm::length(ap - ac * (d2 / (d2 - d6)));
    }
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.0F && d4 - d3 >= 0.0F && d5 - d6 >= 0.0F) {
        return glm::length(bp - (t[2] - t[1]) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
    }
    const float sum = 1.0F / (va + vb + vc);
    return glm::length(ap - ab * (vb * sum) - ac * (vc * sum));
}

namespace {

// Which cells of one sheet are to be divided.
class Divider {
public:
    Divider(const LightSheets& sheets, const NearThings& things, std::uint32_t sheet, unsigned level, unsigned max_level)
        : sheets_(sheets), sheet_(sheet), level_(level), max_level_(max_level) {
        const Chart& chart = *sheets.sheets()[sheet].chart;
        if (!chart.planar) {
            return; // rolled out: everywhere
        }
        near_ = things.before(sheets.sheets()[sheet]);
        const float longer = std::max(float(chart.tiles_u) * chart.scale.x, float(chart.tiles_v) * chart.scale.y);
        narrow_ = chart.area < kNarrow * longer;
    }
    void run(std::vector<LightCell>& out) {
        const LightSheet& sheet = sheets_.sheets()[sheet_];
        for (std::uint32_t tile = 0; tile < sheet.used.size(); ++tile) {
            if (sheet.used[tile] != 0) {
                const std::uint32_t u = tile % sheet.chart->tiles_u, v = tile / sheet.chart->tiles_u;
                divide({sheet_, u << max_level_, v << max_level_, 0}, tile, out);
            }
        }
    }

private:
    void divide(const LightCell& cell, std::size_t tile, std::vector<LightCell>& out) const {
        if (cell.level >= level_ || !wanted(cell, tile)) {
            return;
        }
        out.push_back(cell);
        const std::uint32_t h = 1U << (max_level_ - cell.level - 1);
        for (std::uint32_t k = 0; k < 4; ++k) {
            divide({cell.sheet, cell.x + (k & 1U) * h, cell.y + (k >> 1U) * h, cell.level + 1}, tile, out);
        }
    }
    [[nodiscard]] bool wanted(const LightCell& cell, std::size_t tile) const {
        const Chart& chart = *sheets_.sheets()[sheet_].chart;
        if (near_.empty()) {
            return true;
        }
        const vec2 step = chart.scale / float(1U << max_level_);
        const auto steps = float(1U << (max_level_ - cell.level));
        const vec2 edges = step * steps;
        const float edge = std::max(edges.x, edges.y);
        const vec2 corner = step * vec2(float(cell.x), float(cell.y));
        const float close = kEdgesAway * edge + 0.5F * glm::length(edges);
        const vec2 middle = corner + 0.5F * edges;
        if (!narrow_ && std::any_of(near_[tile].begin(), near_[tile].end(),
                                    [&](const NearThings::Triangle& t) { return distance_to(t, middle) < close; })) {
            return true;
        }
        for (int k = 0; k < 4 && !narrow_; ++k) {
            const vec2 at = corner + edges * vec2(float(k % 2), float(k / 2));
            if (sheets_.distance(sheet_, at, edge) > kBeyondBorder * edge) {
                return true;
            }
        }
        return false;
    }

    const LightSheets& sheets_;
    std::uint32_t sheet_;
    unsigned level_, max_level_;
    bool narrow_ = false;
    std::vector<std::vector<NearThings::Triangle>> near_; // by tile; empty on what is rolled out
};

} // namespace

std::vector<LightCell> cells_near_things(const LightSheets& sheets, unsigned level, unsigned max_level,
                                         const RunContext& context) {
    float edge = 0.0F;
    for (const LightSheet& s : sheets.sheets()) {
        edge = std::max({edge, s.chart->scale.x, s.chart->scale.y});
    }
    const NearThings things(sheets.rays(), kEdgesAway * edge);
    std::vector<std::vector<LightCell>> of_sheet(sheets.sheets().size());
    parallel_chunks(of_sheet.size(), 4, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (auto i = std::uint32_t(begin); i < end && !context.should_stop(); ++i) {
            Divider(sheets, things, i, level, max_level).run(of_sheet[i]);
        }
    });
    std::vector<LightCell> out;
    for (const std::vector<LightCell>& cells : of_sheet) {
        out.insert(out.end(), cells.begin(), cells.end());
    }
    return out;
}

} // namespace atrium
