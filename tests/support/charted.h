// Primitives with charts and landings on them, for tests of caustic textures.
#pragma once

#include "engine/base/rng.h"
#include "engine/caustics/caustic_builder.h"
#include "engine/geometry/tessellate.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace atrium::test {

/// Geometry as triangles with charts.
struct Charted {
    explicit Charted(const Geometry& geometry) : mesh(tessellate(geometry)) {
        for (std::size_t i = 0; i + 2 < mesh->indices.size(); i += 3) {
            const uvec3 t(mesh->indices[i], mesh->indices[i + 1], mesh->indices[i + 2]);
            const vec3 n =
                glm::cross(mesh->positions[t.y] - mesh->positions[t.x], mesh->positions[t.z] - mesh->positions[t.x]);
            if (glm::dot(n, n) > 0.0F) {
                triangles.push_back(t);
                areas.push_back(0.5 * double(glm::length(n)) + (areas.empty() ? 0.0 : areas.back()));
            }
        }
        charts = build_charts(mesh->positions, triangles, curved_domain(geometry, *mesh), ChartSettings{});
    }
    // A landing spread by area, from three numbers.
    [[nodiscard]] CausticLanding landing(float pick, vec2 u) const {
        CausticLanding l;
        const auto at = std::upper_bound(areas.begin(), areas.end(), double(pick) * areas.back());
        l.triangle = std::uint32_t(std::min<std::ptrdiff_t>(at - areas.begin(), std::ptrdiff_t(areas.size()) - 1));
        if (u.x + u.y > 1.0F) {
            u = vec2(1.0F) - u;
        }
        l.barycentric = u;
        place(l);
        return l;
    }
    void place(CausticLanding& l) const {
        const auto& uv = charts.uv[l.triangle];
        l.uv = uv[0] + (uv[1] - uv[0]) * l.barycentric.x + (uv[2] - uv[0]) * l.barycentric.y;
    }
    [[nodiscard]] CausticSide build(const std::vector<CausticLanding>& landings,
                                    const CausticSettings& settings = {}) const {
        return build_caustics(landings, charts, mesh->positions, triangles, settings);
    }
    std::shared_ptr<const MeshData> mesh;
    std::vector<uvec3> triangles;
    std::vector<double> areas;
    SurfaceCharts charts;
};

inline Geometry rectangle(float w, float h) { return Polygon{{{0, 0}, {w, 0}, {w, h}, {0, h}}, {}}; }

/// On the rectangle's two triangles, by place in metres.
inline CausticLanding at_place(const Charted& c, const vec2& place, float power, float radius) {
    CausticLanding l;
    for (std::uint32_t t = 0; t < c.triangles.size(); ++t) {
        const vec2 a(c.mesh->positions[c.triangles[t].x]), b(c.mesh->positions[c.triangles[t].y]),
            d(c.mesh->positions[c.triangles[t].z]);
        const vec2 e1 = b - a, e2 = d - a, p = place - a;
        const float det = e1.x * e2.y - e1.y * e2.x;
        const vec2 w((p.x * e2.y - p.y * e2.x) / det, (e1.x * p.y - e1.y * p.x) / det);
        if (w.x >= -1e-5F && w.y >= -1e-5F && w.x + w.y <= 1.00001F) {
            l.triangle = t;
            l.barycentric = w;
            break;
        }
    }
    c.place(l);
    const float tile = c.charts.charts.front().scale.x;
    l.axis_a = vec2(radius / tile, 0.0F);
    l.axis_b = vec2(0.0F, radius / tile);
    l.power = Rgb(power);
    return l;
}

/// Luminous power that textures and the mesh hold together, lumen.
inline double power_of(const CausticSide& side, const std::vector<CausticLanding>& landings) {
    double sum = 0.0;
    for (const CausticRecord& r : side.records) {
        sum += r.power_texture;
    }
    for (const std::uint32_t i : side.on_mesh) {
        sum += luminance(landings[i].power);
    }
    return sum;
}

/// A disc of light on a large wall.
inline std::vector<CausticLanding> spot(const Charted& c, std::size_t n, const vec2& centre, float radius,
                                        std::uint32_t seed = 1) {
    std::vector<CausticLanding> out;
    for (std::size_t i = 0; i < n; ++i) {
        const vec2 u = sobol_owen2(std::uint32_t(i), 0, seed);
        const float r = radius * std::sqrt(u.x);
        const vec2 p = centre + r * vec2(std::cos(2.0F * kPi * u.y), std::sin(2.0F * kPi * u.y));
        out.push_back(at_place(c, p, 1.0F / float(n), 1.5F * radius * std::sqrt(kPi / float(n))));
    }
    return out;
}

} // namespace atrium::test
