#include "engine/caustics/choice.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr double kPerBin = 16.0;      // particles a bin of the test, on average
constexpr double kPerFineBin = 4.0;   // of the look for detail: what is bright has many more
constexpr double kBeyondChance = 9.0; // variances by which a bin must be off to count as detail: three standard deviations
constexpr double kLeastDetail = 0.05; // of the mean light: less is not seen
constexpr std::uint32_t kMostBins = 256;

struct Sums {
    double all = 0.0, squares = 0.0, fourths = 0.0;
};

Sums sums_of(std::span<const WeightedPoint> points) {
    Sums s;
    for (const WeightedPoint& p : points) {
        const double w2 = p.weight * p.weight;
        s.all += p.weight;
        s.squares += w2;
        s.fourths += w2 * w2;
    }
    return s;
}

std::vector<double> histogram(std::span<const WeightedPoint> points, const TexelGrid& grid) {
    std::vector<double> out(grid.size(), 0.0);
    for (const WeightedPoint& p : points) {
        out[grid.texel_at(p.uv)] += p.weight;
    }
    return out;
}

std::uint32_t bins(double extent, double edge) {
    return std::uint32_t(std::clamp(std::ceil(extent / edge), 1.0, double(kMostBins)));
}

// Density (weight per area) of a coarse grid at a fine texel's middle, bilinear between coarse middles that have surface.
double interpolate(const TexelGrid& grid, const std::vector<double>& density, const vec2& uv) {
    const vec2 at = grid.to_texels(uv) - vec2(0.5F);
    const auto x = int(std::floor(at.x)), y = int(std::floor(at.y));
    const double fx = at.x - float(x), fy = at.y - float(y);
    double sum = 0.0, weight = 0.0;
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            const int cx = std::clamp(x + i, 0, int(grid.width) - 1), cy = std::clamp(y + j, 0, int(grid.height) - 1);
            const std::size_t index = std::size_t(cy) * grid.width + std::size_t(cx);
            const double w = (i == 0 ? 1.0 - fx : fx) * (j == 0 ? 1.0 - fy : fy);
            if (grid.area[index] > 0.0) {
                sum += w * density[index];
                weight += w;
            }
        }
    }
    return weight > 0.0 ? sum / weight : 0.0;
}

// Whether the weights on a fine grid have detail that a coarse one, interpolated, has not. `density` and `squares` are the
// sums of weights and of their squares per area on the coarse grid.
bool has_detail(const std::vector<double>& seen, const TexelGrid& fine, const TexelGrid& coarse,
                const std::vector<double>& density, const std::vector<double>& squares) {
    double excess = 0.0; // squared deviation beyond chance, of density
    double chance = 0.0; // what there is of squared deviation by chance
    double area = 0.0, light = 0.0;
    for (std::uint32_t y = 0; y < fine.height; ++y) {
        for (std::uint32_t x = 0; x < fine.width; ++x) {
            const std::size_t i = std::size_t(y) * fine.width + x;
            if (!(fine.area[i] > 0.0)) {
                continue;
            }
            const vec2 uv = fine.low + (vec2(float(x), float(y)) + vec2(0.5F)) /
                                           vec2(float(fine.width), float(fine.height)) * (fine.high - fine.low);
            const double d = seen[i] - interpolate(coarse, density, uv) * fine.area[i];
            const double v = interpolate(coarse, squares, uv) * fine.area[i];
            excess += std::max(d * d - kBeyondChance * v, 0.0) / fine.area[i];
            chance += v / fine.area[i];
            area += fine.area[i];
            light += seen[i];
        }
    }
    // Root mean square detail over where the light is, relative to its mean there.
    const double mean = area > 0.0 ? light / area : 0.0;
    const double detail = area > 0.0 && mean > 0.0 ? std::sqrt(excess / area) / mean : 0.0;
    // Of chance alone less than a hundredth is beyond three deviations.
    return excess > 0.1 * chance && detail > kLeastDetail;
}

} // namespace

float caustic_contrast(float p_min, float p_max) { return p_max > 0.0F ? (p_max - std::max(p_min, 0.0F)) / p_max : 0.0F; }

double dispersion(std::span<const double> sums, std::span<const double> expected, double sum_of_squares,
                  double sum_of_fourths) {
    double total = 0.0, area = 0.0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        total += sums[i];
        area += expected[i];
    }
    if (!(area > 0.0) || !(sum_of_squares > 0.0)) {
        return 0.0;
    }
    // Each bin's squared deviation over its variance: mean 1, variance 2 and what rare heavy particles add.
    double x = 0.0, variance = 0.0;
    std::size_t count = 0;
    const double heavy = sum_of_fourths / (sum_of_squares * sum_of_squares);
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double p = expected[i] / area;
        if (!(p > 1e-12)) {
            continue;
        }
        const double d = sums[i] - total * p;
        x += d * d / (sum_of_squares * p);
        variance += 2.0 + heavy / p;
        ++count;
    }
    return count < 2 ? 0.0 : (x - double(count - 1)) / std::sqrt(variance);
}

Choice choose_texture(std::span<const WeightedPoint> points, const ChartDomain& domain, const SurfaceCharts& charts,
                      std::span<const vec3> positions, std::span<const uvec3> triangles, const CausticSettings& settings) {
    Choice out;
    if (points.size() < settings.least_particles) {
        return out;
    }
    const double n = double(points.size());
    // Over the whole chart, bins about square.
    const double edge = std::sqrt(double(domain.extent.x) * domain.extent.y * kPerBin / n);
    const TexelGrid grid = make_grid(domain, charts, positions, triangles, domain.low, domain.high,
                                     bins(domain.extent.x, edge), bins(domain.extent.y, edge));
    const Sums all = sums_of(points);
    out.dispersion = dispersion(histogram(points, grid), grid.area, all.squares, all.fourths);
    if (out.dispersion < double(settings.least_dispersion)) {
        out.decision = CausticRecord::Decision::Uniform;
        return out;
    }
    // Where the particles are, with a margin, at the mesh's resolution and finer.
    vec2 low(std::numeric_limits<float>::infinity()), high(-std::numeric_limits<float>::infinity());
    for (const WeightedPoint& p : points) {
        low = glm::min(low, p.uv);
        high = glm::max(high, p.uv);
    }
    const vec2 scale = domain.extent / glm::max(domain.high - domain.low, vec2(1e-9F)); // metres per tile
    const vec2 margin = vec2(settings.mesh_edge) / glm::max(scale, vec2(1e-9F));
    low = glm::max(low - margin, domain.low);
    high = glm::min(high + margin, domain.high);
    const vec2 size = (high - low) * scale;
    const double finest = std::sqrt(double(size.x) * size.y * kPerFineBin / n);
    const TexelGrid coarse = make_grid(domain, charts, positions, triangles, low, high,
                                       bins(size.x, double(settings.mesh_edge)), bins(size.y, double(settings.mesh_edge)));
    std::vector<double> density = histogram(points, coarse);
    std::vector<double> squares(coarse.size(), 0.0);
    for (const WeightedPoint& p : points) {
        squares[coarse.texel_at(p.uv)] += p.weight * p.weight;
    }
    for (std::size_t i = 0; i < coarse.size(); ++i) {
        density[i] = coarse.area[i] > 0.0 ? density[i] / coarse.area[i] : 0.0;
        squares[i] = coarse.area[i] > 0.0 ? squares[i] / coarse.area[i] : 0.0;
    }
    // Detail of any size between the mesh's and what the particles can show.
    out.decision = CausticRecord::Decision::Coarse;
    double edge_of_bins = 0.5 * double(settings.mesh_edge);
    do {
        const TexelGrid fine = make_grid(domain, charts, positions, triangles, low, high, bins(size.x, edge_of_bins),
                                         bins(size.y, edge_of_bins));
        if (has_detail(histogram(points, fine), fine, coarse, density, squares)) {
            out.decision = CausticRecord::Decision::Texture;
            break;
        }
        edge_of_bins *= 0.5;
    } while (edge_of_bins > finest);
    return out;
}

} // namespace atrium
