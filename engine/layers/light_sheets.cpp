#include "engine/layers/light_sheets.h"

#include "engine/base/parallel.h"

#include <algorithm>

namespace atrium {
namespace {

// Metres that a sample keeps from the border of its chart: walls that meet there must not hide it. Above the rounding of
// coordinates and the offset of rays, below what an eye sees of a shadow; in small scenes below half of the finest texel.
constexpr float kPullIn = 0.002F;
constexpr float kPullInTiles = 1.0F / 160.0F;

} // namespace

LightSheets::LightSheets(const RayScene& rays, std::span<const SurfaceCharts> charts,
                         const std::function<bool(std::uint32_t)>& back_lit, const RunContext& context)
    : rays_(rays) {
    std::vector<std::uint32_t> surface_of;
    std::vector<std::vector<std::uint32_t>> members; // triangles of each chart, surface by surface
    for (std::uint32_t s = 0; s < charts.size(); ++s) {
        const SurfaceCharts& of = charts[s];
        const std::size_t first = members.size();
        members.resize(first + of.charts.size());
        surface_of.resize(members.size(), s);
        for (std::uint32_t t = 0; t < of.chart_of_triangle.size() && !of.empty(); ++t) {
            if (of.chart_of_triangle[t] != SurfaceCharts::kNone) {
                members[first + of.chart_of_triangle[t]].push_back(t);
            }
        }
    }
    const auto chart_at = [&](std::size_t i) -> const Chart& {
        const SurfaceCharts& of = charts[surface_of[i]];
        const auto first = std::lower_bound(surface_of.begin(), surface_of.end(), surface_of[i]) - surface_of.begin();
        return of.charts[i - std::size_t(first)];
    };
    lookups_.resize(members.size());
    parallel_chunks(members.size(), 4, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            lookups_[i] = ChartLookup(charts[surface_of[i]], chart_at(i), members[i]);
        }
    });
    for (std::size_t i = 0; i < members.size() && !context.should_stop(); ++i) {
        const std::uint32_t s = surface_of[i];
        const Chart& chart = chart_at(i);
        LightSheet sheet{s, false, &chart, i, {}};
        for (std::uint32_t v = 0; v < chart.tiles_v; ++v) {
            for (std::uint32_t u = 0; u < chart.tiles_u; ++u) {
                sheet.used.push_back(lookups_[i].touches_tile(u, v) ? 1 : 0);
            }
        }
        sheets_.push_back(sheet);
        if (rays.surfaces()[s].back_side && back_lit(s)) {
            sheet.back = true;
            sheets_.push_back(std::move(sheet));
        }
    }
}

std::optional<LightSheets::Place> LightSheets::locate(std::uint32_t index, const vec2& at, float reach) const {
    const LightSheet& sheet = sheets_[index];
    const float pull = std::min(kPullIn, kPullInTiles * std::min(sheet.chart->scale.x, sheet.chart->scale.y));
    const ChartPoint on = lookups_[sheet.lookup].nearest_inside(at, reach, pull);
    if (!on || on.distance > reach) {
        return std::nullopt;
    }
    if (!sheet.chart->planar) {
        return round_place(sheet, on);
    }
    const auto corner = rays_.triangle(sheet.surface, on.triangle);
    const vec2 w = on.barycentric;
    return Place{corner[0] * (1.0F - w.x - w.y) + corner[1] * w.x + corner[2] * w.y,
                 sheet.back ? -sheet.chart->normal : sheet.chart->normal};
}

float LightSheets::distance(std::uint32_t sheet, const vec2& at, float reach) const {
    const ChartPoint on = lookups_[sheets_[sheet].lookup].nearest(at, reach);
    return on ? on.distance : std::numeric_limits<float>::infinity();
}

LightSheets::Place LightSheets::round_place(const LightSheet& sheet, const ChartPoint& on) const {
    const auto corner = rays_.triangle(sheet.surface, on.triangle);
    const vec3 w(1.0F - on.barycentric.x - on.barycentric.y, on.barycentric.x, on.barycentric.y);
    Hit hit;
    hit.surface = sheet.surface;
    hit.triangle = on.triangle;
    hit.geometric_normal = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    // Files with normals on the wrong side are lit by the side that the winding says.
    const auto side_normal = [&](const vec2& barycentric) {
        hit.barycentric = barycentric;
        const vec3 n = rays_.shading_normal(hit);
        return (glm::dot(n, hit.geometric_normal) < 0.0F) != sheet.back ? -n : n;
    };
    Place out{corner[0] * w.x + corner[1] * w.y + corner[2] * w.z, side_normal(on.barycentric)};
    // Up from the flat triangle to the round surface that it stands for, or its facets would shade one another: the mean of
    // the point's projections on the planes that touch the corners (Hanika, Hacking the shadow terminator, 2021).
    const vec2 at_corner[3] = {{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}};
    vec3 lift(0.0F);
    for (int k = 0; k < 3; ++k) {
        const vec3 n = side_normal(at_corner[k]);
        lift -= n * (w[k] * std::min(glm::dot(out.point - corner[std::size_t(k)], n), 0.0F));
    }
    out.point += lift;
    return out;
}

} // namespace atrium
