#include "engine/caustics/texel_grid.h"

#include <algorithm>
#include <array>

namespace atrium {
namespace {

// A convex polygon cut by an axis-aligned half plane: keeps what lies on the side of `sign`.
struct Clipped {
    std::array<dvec2, 12> p;
    int count = 0;
};

Clipped clip(const Clipped& in, int axis, double at, double sign) {
    Clipped out;
    for (int i = 0; i < in.count; ++i) {
        const dvec2& a = in.p[std::size_t(i)];
        const dvec2& b = in.p[std::size_t((i + 1) % in.count)];
        const double da = sign * (a[axis] - at), db = sign * (b[axis] - at);
        if (da >= 0.0) {
            out.p[std::size_t(out.count++)] = a;
        }
        if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
            out.p[std::size_t(out.count++)] = a + (b - a) * (da / (da - db));
        }
    }
    return out;
}

double area_of(const Clipped& c) {
    double sum = 0.0;
    for (int i = 1; i + 1 < c.count; ++i) {
        const dvec2 a = c.p[std::size_t(i)] - c.p[0];
        const dvec2 b = c.p[std::size_t(i + 1)] - c.p[0];
        sum += a.x * b.y - a.y * b.x;
    }
    return 0.5 * std::abs(sum);
}

} // namespace

std::vector<ChartDomain> chart_domains(const SurfaceCharts& charts, std::span<const vec3> positions,
                                       std::span<const uvec3> triangles) {
    std::vector<ChartDomain> out(charts.charts.size());
    for (std::size_t c = 0; c < out.size(); ++c) {
        const Chart& chart = charts.charts[c];
        out[c].chart = std::uint32_t(c);
        // The rectangle that the surface fills, not the whole tiles around it.
        out[c].low = vec2(std::numeric_limits<float>::infinity());
        out[c].high = vec2(-std::numeric_limits<float>::infinity());
        out[c].extent = chart.scale;
    }
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const std::uint32_t c = charts.chart_of_triangle[t];
        if (c == SurfaceCharts::kNone) {
            continue;
        }
        const vec3& p = positions[triangles[t].x];
        out[c].area += 0.5 * glm::length(dvec3(glm::cross(positions[triangles[t].y] - p, positions[triangles[t].z] - p)));
        out[c].triangles.push_back(t);
        for (const vec2& uv : charts.uv[t]) {
            out[c].low = glm::min(out[c].low, uv);
            out[c].high = glm::max(out[c].high, uv);
        }
    }
    for (ChartDomain& d : out) {
        d.extent *= glm::max(d.high - d.low, vec2(0.0F));
    }
    return out;
}

std::size_t TexelGrid::texel_at(const vec2& uv) const {
    const vec2 at = to_texels(uv);
    const auto x = std::size_t(std::clamp(int(std::floor(at.x)), 0, int(width) - 1));
    const auto y = std::size_t(std::clamp(int(std::floor(at.y)), 0, int(height) - 1));
    return y * width + x;
}

TexelGrid make_grid(const ChartDomain& domain, const SurfaceCharts& charts, std::span<const vec3> positions,
                    std::span<const uvec3> triangles, const vec2& low, const vec2& high, std::uint32_t width,
                    std::uint32_t height) {
    TexelGrid grid;
    grid.low = low;
    grid.high = high;
    grid.width = width;
    grid.height = height;
    grid.area.assign(grid.size(), 0.0);
    const dvec2 scale = dvec2(double(width), double(height)) / dvec2(high - low);
    for (const std::uint32_t t : domain.triangles) {
        const vec3& p = positions[triangles[t].x];
        const double world =
            0.5 * glm::length(dvec3(glm::cross(positions[triangles[t].y] - p, positions[triangles[t].z] - p)));
        Clipped whole;
        whole.count = 3;
        dvec2 least(1e30), most(-1e30);
        for (std::size_t k = 0; k < 3; ++k) {
            whole.p[k] = dvec2(charts.uv[t][k] - low) * scale;
            least = glm::min(least, whole.p[k]);
            most = glm::max(most, whole.p[k]);
        }
        const double flat = area_of(whole);
        if (!(flat > 0.0)) {
            continue;
        }
        const double density = world / flat;
        const int y0 = std::max(int(std::floor(least.y)), 0), y1 = std::min(int(std::floor(most.y)), int(height) - 1);
        for (int y = y0; y <= y1; ++y) {
            const Clipped row = clip(clip(whole, 1, y, 1.0), 1, y + 1.0, -1.0);
            if (row.count < 3) {
                continue;
            }
            double left = 1e30, right = -1e30;
            std::array<double, 2> from{1e30, 1e30}, to{-1e30, -1e30}; // on the row's lower and upper line
            for (int i = 0; i < row.count; ++i) {
                const dvec2& corner = row.p[std::size_t(i)];
                left = std::min(left, corner.x);
                right = std::max(right, corner.x);
                for (std::size_t line = 0; line < 2; ++line) {
                    if (std::abs(corner.y - (double(y) + double(line))) < 1e-9) {
                        from[line] = std::min(from[line], corner.x);
                        to[line] = std::max(to[line], corner.x);
                    }
                }
            }
            const int x0 = std::max(int(std::floor(left)), 0), x1 = std::min(int(std::floor(right)), int(width) - 1);
            // What is convex and reaches both lines above and below a texel holds all of it.
            const double full_from = std::max(from[0], from[1]), full_to = std::min(to[0], to[1]);
            for (int x = x0; x <= x1; ++x) {
                double covered = 1.0;
                if (double(x) < full_from || double(x + 1) > full_to) {
                    covered = area_of(clip(clip(row, 0, x, 1.0), 0, x + 1.0, -1.0));
                }
                grid.area[std::size_t(y) * width + std::size_t(x)] += covered * density;
            }
        }
    }
    grid.largest = *std::max_element(grid.area.begin(), grid.area.end());
    return grid;
}

void CausticAccumulator::add(const CausticAccumulator& other, std::size_t begin, std::size_t end) {
    for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
        sums_[i] += other.sums_[i];
    }
}

std::vector<Rgb> CausticAccumulator::image() const {
    std::vector<Rgb> out(sums_.size() / 3);
    for (std::size_t i = 0; i < out.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            out[i][int(k)] = float(double(std::int64_t(sums_[3 * i + k])) * kQuantum);
        }
    }
    return out;
}

} // namespace atrium
