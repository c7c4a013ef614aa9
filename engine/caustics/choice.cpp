#include "engine/caustics/choice.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr double kPerBin = 16.0;      // particles a bin of the test, on average
constexpr double kFewestBins = 9.0;   // however few they are: ten particles in one place of four may be chance
constexpr double kThinBin = 0.25;     // of the mean bin's surface: bins with less are put together
constexpr double kPerFineBin = 4.0;   // of the look for detail: what is bright has many more
constexpr double kBeyondChance = 9.0; // variances by which a bin must be off to count as detail: three standard deviations
constexpr double kLeastDetail = 0.05; // of the mean light: less is not seen
constexpr std::uint32_t kMostBins = 256;

struct Sums {
    double squares = 0.0, fourths = 0.0;
};

Sums sums_of(std::span<const WeightedPoint> points) {
    Sums s;
    for (const WeightedPoint& p : points) {
        const double w2 = exact_weight(p.weight * p.weight);
        s.squares += w2;
        s.fourths += exact_weight(w2 * w2);
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

// Contrast of what bins with enough surface hold per area.
float contrast_of(const std::vector<double>& sums, const TexelGrid& grid) {
    const double thin = kThinBin * grid.largest;
    double most = 0.0, least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (grid.area[i] > thin) {
            most = std::max(most, sums[i] / grid.area[i]);
            least = std::min(least, sums[i] / grid.area[i]);
        }
    }
    return most > 0.0 ? caustic_contrast(float(least / most), 1.0F) : 0.0F;
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

double exact_weight(double weight) { return std::rint(std::clamp(weight, 0.0, 1.0) * 0x1.0p24) * 0x1.0p-24; }

double dispersion(std::span<const double> sums, std::span<const double> expected, double sum_of_squares,
                  double sum_of_fourths) {
    double total = 0.0, area = 0.0;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        total += sums[i];
        area += expected[i];
        lit += expected[i] > 0.0 ? 1 : 0;
    }
    if (!(area > 0.0) || !(sum_of_squares > 0.0)) {
        return 0.0;
    }
    // Chi square: each bin's squared deviation over its variance.
    double chi2 = 0.0, inverse = 0.0;
    std::size_t count = 0;
    const auto take = [&](double sum, double p) {
        const double d = sum - total * p;
        chi2 += d * d / (sum_of_squares * p);
        inverse += 1.0 / p;
        ++count;
    };
    // One particle in a sliver of surface would outweigh all others: slivers are one bin together.
    const double thin = kThinBin / double(lit);
    double thin_sum = 0.0, thin_share = 0.0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double p = expected[i] / area;
        if (p >= thin) {
            take(sums[i], p);
        } else {
            thin_sum += sums[i];
            thin_share += p;
        }
    }
    if (thin_share >= thin) {
        take(thin_sum, thin_share);
    }
    if (count < 2) {
        return 0.0;
    }
    // Its mean and variance over all ways to drop these particles; then the normal deviate of the same probability (Wilson
    // and Hilferty 1931), for with few bins chi square itself strays far more often than a normal deviate would.
    const double heavy = sum_of_fourths / (sum_of_squares * sum_of_squares);
    const auto m = double(count);
    const double mean = m - 1.0;
    const double variance = 2.0 * mean * std::max(1.0 - heavy, 0.0) + heavy * std::max(inverse - m * m, 0.0);
    if (!(variance > 0.0)) {
        return 0.0; // a single particle
    }
    const double spread = variance / (9.0 * mean * mean); // 2 / (9 degrees of freedom)
    return (std::cbrt(chi2 / mean) - (1.0 - spread)) / std::sqrt(spread);
}

Choice choose_texture(std::span<const WeightedPoint> points, const ChartDomain& domain, const SurfaceCharts& charts,
                      std::span<const vec3> positions, std::span<const uvec3> triangles, const CausticSettings& settings,
                      const RunContext& context) {
    Choice out;
    if (points.size() < settings.least_particles || context.should_stop()) {
        return out;
    }
    const double n = double(points.size());
    // Over the whole chart, bins about square.
    const double edge = std::sqrt(double(domain.extent.x) * domain.extent.y / std::max(n / kPerBin, kFewestBins));
    const TexelGrid grid = make_grid(domain, charts, positions, triangles, domain.low, domain.high,
                                     bins(domain.extent.x, edge), bins(domain.extent.y, edge));
    const Sums all = sums_of(points);
    const std::vector<double> seen = histogram(points, grid);
    out.dispersion = dispersion(seen, grid.area, all.squares, all.fourths);
    out.contrast = contrast_of(seen, grid);
    if (out.dispersion < double(settings.least_dispersion) || context.should_stop()) {
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
        squares[coarse.texel_at(p.uv)] += exact_weight(p.weight * p.weight);
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
    } while (edge_of_bins > finest && !context.should_stop());
    return out;
}

} // namespace atrium
