// Charts made by hand for surfaces that are flat as a whole, for tests that need nothing more.
#pragma once

#include "engine/geometry/surface_charts.h"
#include "engine/raycast/ray_scene.h"

#include <cmath>
#include <vector>

namespace atrium::test {

/// One planar chart per surface, in the plane of its first triangle, with tiles from its least corner on: u along its node's
/// own x (which is in the plane of polygons), or along y where x stands upright on the plane.
inline std::vector<SurfaceCharts> flat_charts(const RayScene& rays, float tile_edge = 0.32F) {
    std::vector<SurfaceCharts> out;
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        SurfaceCharts charts;
        charts.tile_edge = tile_edge;
        Chart chart;
        const auto first = rays.triangle(s, 0);
        chart.normal = glm::normalize(glm::cross(first[1] - first[0], first[2] - first[0]));
        const dmat4& to_engine = rays.surfaces()[s].to_engine;
        vec3 x(glm::normalize(dvec3(to_engine[0])));
        if (std::abs(glm::dot(x, chart.normal)) > 0.99F) {
            x = vec3(glm::normalize(dvec3(to_engine[1])));
        }
        chart.axis_u = glm::normalize(x - chart.normal * glm::dot(x, chart.normal));
        chart.axis_v = glm::cross(chart.normal, chart.axis_u);
        chart.scale = vec2(tile_edge);
        vec2 least(std::numeric_limits<float>::infinity());
        vec2 most = -least;
        const auto flat = [&](const vec3& p) { return vec2(glm::dot(p, chart.axis_u), glm::dot(p, chart.axis_v)); };
        const auto count = std::uint32_t(rays.surfaces()[s].triangles.size());
        for (std::uint32_t t = 0; t < count; ++t) {
            for (const vec3& p : rays.triangle(s, t)) {
                least = glm::min(least, flat(p));
                most = glm::max(most, flat(p));
            }
        }
        chart.tiles_u = charts.width = std::uint32_t(std::ceil((most.x - least.x) / tile_edge - 1e-4F));
        chart.tiles_v = charts.height = std::uint32_t(std::ceil((most.y - least.y) / tile_edge - 1e-4F));
        chart.origin = first[0] + chart.axis_u * (least.x - flat(first[0]).x) + chart.axis_v * (least.y - flat(first[0]).y);
        for (std::uint32_t t = 0; t < count; ++t) {
            const auto p = rays.triangle(s, t);
            charts.uv.push_back(
                {(flat(p[0]) - least) / tile_edge, (flat(p[1]) - least) / tile_edge, (flat(p[2]) - least) / tile_edge});
            charts.chart_of_triangle.push_back(0);
            chart.area += 0.5F * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        }
        charts.charts.push_back(chart);
        out.push_back(charts);
    }
    return out;
}

/// Chart-space position of a point (engine coordinates) on a surface with one planar chart.
inline vec2 chart_position(const SurfaceCharts& charts, const vec3& point) {
    const Chart& c = charts.charts[0];
    return vec2(glm::dot(point - c.origin, c.axis_u), glm::dot(point - c.origin, c.axis_v)) / c.scale;
}

} // namespace atrium::test
