#include "engine/caustics/reconstruction.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr double kLeastCover =
    0.02;                           // share of surface under a kernel below which it is widened: light on slivers would glow
constexpr double kHardlyAny = 1e-4; // the same once widened: left to the mesh
constexpr int kNarrow = 8;          // texels: rows of fewer are not worth a closer look
constexpr float kWidened = 1.5F;    // texels
constexpr double kThinTexel = 0.25; // of a full texel: with less surface it does not make the peak

// Symmetric 2 x 2 matrix in texels.
struct Spread {
    float xx = 0.0F, xy = 0.0F, yy = 0.0F;
    void add(const vec2& v) {
        xx += v.x * v.x;
        xy += v.x * v.y;
        yy += v.y * v.y;
    }
};

Spread kernel_of(const CausticLanding& landing, const TexelGrid& grid, const KernelLimits& limits) {
    const vec2 per_tile = vec2(float(grid.width), float(grid.height)) / (grid.high - grid.low);
    const auto shorten = [&](vec2 v) {
        v *= per_tile;
        const float length = glm::length(v);
        return length > limits.most ? v * (limits.most / length) : v;
    };
    Spread m;
    m.add(shorten(landing.axis_a));
    m.add(shorten(landing.axis_b));
    if (!std::isfinite(m.xx + m.yy) || !(m.xx + m.yy > 0.0F)) {
        m = {limits.unknown * limits.unknown, 0.0F, limits.unknown * limits.unknown};
    }
    m.xx += limits.least * limits.least;
    m.yy += limits.least * limits.least;
    return m;
}

} // namespace

namespace {

// A landing's kernel on the texels of a grid.
struct Kernel {
    vec2 at{0.0F};
    float ixx = 0.0F, ixy = 0.0F, iyy = 0.0F;
    int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
    // Edges of the chart within reach, where what falls beyond is thrown back as by a mirror: even light stays even up to
    // the edge. Negative: none.
    std::array<float, 3> fold_x{}, fold_y{};
    bool folds = false;

    Kernel(const vec2& place, const Spread& m, const LitRange& range) : at(place) {
        const float determinant = std::max(m.xx * m.yy - m.xy * m.xy, 1e-12F);
        ixx = m.yy / determinant;
        ixy = -m.xy / determinant;
        iyy = m.xx / determinant;
        const float rx = std::sqrt(m.xx), ry = std::sqrt(m.yy);
        x0 = std::max(int(std::floor(at.x - rx - 0.5F)), range.first[0]);
        x1 = std::min(int(at.x + rx + 1.0F), range.last[0]);
        y0 = std::max(int(std::floor(at.y - ry - 0.5F)), range.first[1]);
        y1 = std::min(int(at.y + ry + 1.0F), range.last[1]);
        const auto fold = [](float to, float reach, float low, float high) {
            return std::array<float, 3>{0.0F, low >= 0.0F && to - reach < low ? low : -1.0F,
                                        high >= 0.0F && to + reach > high ? high : -1.0F};
        };
        fold_x = fold(at.x, rx, range.edge_low.x, range.edge_high.x);
        fold_y = fold(at.y, ry, range.edge_low.y, range.edge_high.y);
        folds = fold_x[1] >= 0.0F || fold_x[2] >= 0.0F || fold_y[1] >= 0.0F || fold_y[2] >= 0.0F;
    }

    [[nodiscard]] float weight(float dx, float dy) const {
        return std::max(1.0F - (ixx * dx * dx + 2.0F * ixy * dx * dy + iyy * dy * dy), 0.0F);
    }
    [[nodiscard]] float folded_weight(float cx, float cy) const {
        float w = weight(cx - at.x, cy - at.y);
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t i = 0; i < 3; ++i) {
                if (i + j > 0 && fold_x[i] >= 0.0F && fold_y[j] >= 0.0F) {
                    w += weight((i > 0 ? 2.0F * fold_x[i] - cx : cx) - at.x, (j > 0 ? 2.0F * fold_y[j] - cy : cy) - at.y);
                }
            }
        }
        return w;
    }
    // The part of a row that the kernel can reach, or a little more.
    [[nodiscard]] std::array<int, 2> columns(int y) const {
        if (folds || x1 - x0 <= kNarrow) {
            return {x0, x1};
        }
        const float dy = float(y) + 0.5F - at.y;
        const float b = ixy * dy;
        const float square = b * b - ixx * (iyy * dy * dy - 1.0F);
        if (!(square > 0.0F)) {
            return {x0, x0};
        }
        const float root = std::sqrt(square) / ixx, middle = at.x - b / ixx - 0.5F;
        return {std::max(int(std::floor(middle - root)), x0), std::min(int(std::floor(middle + root)) + 1, x1)};
    }
};

// Calls visit(row, from, to) for what the kernel can reach.
template <class F> void for_each_row(const Kernel& kernel, const F& visit) {
    for (int y = kernel.y0; y < kernel.y1; ++y) {
        const auto [from, to] = kernel.columns(y);
        visit(y, from, to);
    }
}

} // namespace

bool splat(const CausticLanding& landing, const TexelGrid& grid, const LitRange& range, const KernelLimits& limits,
           CausticAccumulator& sums, double sign) {
    static thread_local std::vector<float> weights;
    const vec2 at = grid.to_texels(landing.uv);
    const double strongest = std::max({landing.power.r, landing.power.g, landing.power.b});
    const auto fits = [&](double per_area) { return strongest * per_area < 0.01 * CausticAccumulator::kMost; };
    Spread m = kernel_of(landing, grid, limits);
    for (const bool widened : {false, true}) {
        if (widened) {
            m.xx += kWidened * kWidened;
            m.yy += kWidened * kWidened;
        }
        const Kernel kernel(at, m, range);
        const std::size_t most =
            std::size_t(std::max(kernel.x1 - kernel.x0, 0)) * std::size_t(std::max(kernel.y1 - kernel.y0, 0));
        if (weights.size() < most) {
            weights.resize(most);
        }
        float* next = weights.data();
        double total = 0.0;
        float sum = 0.0F;
        for_each_row(kernel, [&](int y, int from, int to) {
            const double* area = &grid.area[std::size_t(y) * grid.width];
            const float cy = float(y) + 0.5F, dy = cy - at.y;
            const float rest = 1.0F - kernel.iyy * dy * dy, slope = 2.0F * kernel.ixy * dy;
            for (int x = from; x < to; ++x) {
                const float cx = float(x) + 0.5F, dx = cx - at.x;
                const float w =
                    kernel.folds ? kernel.folded_weight(cx, cy) : std::max(rest - dx * (slope + kernel.ixx * dx), 0.0F);
                *next++ = w;
                sum += w;
                total += double(w) * area[x];
            }
        });
        if (total > (widened ? kHardlyAny : kLeastCover) * double(sum) * grid.largest && fits(4.0 / total)) {
            const dvec3 scaled = dvec3(landing.power) * (sign / total);
            const float* w = weights.data();
            for_each_row(kernel, [&](int y, int from, int to) {
                const std::size_t row = std::size_t(y) * grid.width;
                for (int x = from; x < to; ++x, ++w) {
                    const std::size_t i = row + std::size_t(x);
                    if (*w > 0.0F && grid.area[i] > 0.0) {
                        sums.add(i, scaled * double(*w));
                    }
                }
            });
            return true;
        }
        // A kernel between the middles of texels: the texel that it is in.
        const bool any = range.last[0] > range.first[0] && range.last[1] > range.first[1];
        if (any && !(sum > 0.0F)) {
            const int x = std::clamp(int(std::floor(at.x)), range.first[0], range.last[0] - 1);
            const int y = std::clamp(int(std::floor(at.y)), range.first[1], range.last[1] - 1);
            const std::size_t i = std::size_t(y) * grid.width + std::size_t(x);
            if (grid.area[i] > kLeastCover * grid.largest && fits(1.0 / grid.area[i])) {
                sums.add(i, dvec3(landing.power) * (sign / grid.area[i]));
                return true;
            }
        }
    }
    return false;
}

float kernel_width(const CausticLanding& landing, const TexelGrid& grid, const KernelLimits& limits) {
    const Spread m = kernel_of(landing, grid, limits);
    const float spread = std::sqrt(std::max(0.25F * (m.xx - m.yy) * (m.xx - m.yy) + m.xy * m.xy, 0.0F));
    return std::sqrt(std::max(0.5F * (m.xx + m.yy) - spread, 0.0F));
}

TexelGrid coarser(const TexelGrid& grid) {
    TexelGrid out;
    out.width = (grid.width + 1) / 2;
    out.height = (grid.height + 1) / 2;
    out.low = grid.low;
    const vec2 texel = (grid.high - grid.low) / vec2(float(grid.width), float(grid.height));
    out.high = grid.low + 2.0F * texel * vec2(float(out.width), float(out.height));
    out.area.assign(out.size(), 0.0);
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            out.area[std::size_t(y / 2) * out.width + x / 2] += grid.area[std::size_t(y) * grid.width + x];
        }
    }
    out.largest = *std::max_element(out.area.begin(), out.area.end());
    return out;
}

void add_coarser(const std::vector<Rgb>& from, const TexelGrid& coarse, int factor, const TexelGrid& grid,
                 const LitRange& range, std::vector<Rgb>& image) {
    dvec3 before(0.0);
    for (std::size_t i = 0; i < from.size(); ++i) {
        before += dvec3(from[i]) * coarse.area[i];
    }
    if (!(before.r + before.g + before.b > 0.0)) {
        return;
    }
    // Texels without surface have no light of their own to interpolate with.
    std::vector<Rgb> filled = from;
    fill_around(filled, coarse);
    std::vector<Rgb> fine(image.size(), Rgb(0.0F));
    dvec3 after(0.0);
    const auto clamp_to = [](float v, std::uint32_t count) { return std::clamp(v, 0.0F, float(count - 1)); };
    for (int y = range.first[1]; y < range.last[1]; ++y) {
        const float v = clamp_to((float(y) + 0.5F) / float(factor) - 0.5F, coarse.height);
        const auto j = std::min(std::size_t(v), std::size_t(coarse.height - 1));
        const std::size_t j1 = std::min<std::size_t>(j + 1, coarse.height - 1);
        const float fy = v - float(j);
        for (int x = range.first[0]; x < range.last[0]; ++x) {
            const float u = clamp_to((float(x) + 0.5F) / float(factor) - 0.5F, coarse.width);
            const auto i = std::min(std::size_t(u), std::size_t(coarse.width - 1));
            const std::size_t i1 = std::min<std::size_t>(i + 1, coarse.width - 1);
            const float fx = u - float(i);
            const auto texel = [&](std::size_t column, std::size_t row) { return filled[row * coarse.width + column]; };
            const Rgb value = (texel(i, j) * (1.0F - fx) + texel(i1, j) * fx) * (1.0F - fy) +
                              (texel(i, j1) * (1.0F - fx) + texel(i1, j1) * fx) * fy;
            const std::size_t at = std::size_t(y) * grid.width + std::size_t(x);
            fine[at] = value;
            after += dvec3(value) * grid.area[at];
        }
    }
    Rgb scale(0.0F);
    for (int k = 0; k < 3; ++k) {
        scale[k] = float(after[k] > 0.0 ? before[k] / after[k] : 0.0);
    }
    for (std::size_t i = 0; i < image.size(); ++i) {
        image[i] += fine[i] * scale;
    }
}

float peak(const std::vector<Rgb>& histogram, const TexelGrid& grid) {
    float most = 0.0F;
    for (std::size_t i = 0; i < histogram.size(); ++i) {
        if (grid.area[i] > kThinTexel * grid.largest) {
            most = std::max(most, luminance(histogram[i]) * float(grid.largest / grid.area[i]));
        }
    }
    return most;
}

std::vector<Rgb> spiral_means(const std::vector<Rgb>& histogram, const TexelGrid& grid, float reach) {
    const auto width = int(grid.width), height = int(grid.height);
    // Texels around one in the order of their distance; those of one ring count together.
    struct Step {
        int x, y;
        float distance;
    };
    std::vector<Step> steps;
    const int r = int(std::ceil(reach));
    for (int y = -r; y <= r; ++y) {
        for (int x = -r; x <= r; ++x) {
            const float d = std::sqrt(float(x * x + y * y));
            if (d <= reach) {
                steps.push_back({x, y, d});
            }
        }
    }
    std::stable_sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.distance < b.distance; });
    // Light of texels with little surface counts in means, but by what a full texel would make of it and not as a peak.
    const double thin = kThinTexel * grid.largest;
    const float most = peak(histogram, grid);
    std::vector<Rgb> out(histogram.size(), Rgb(0.0F));
    dvec3 before(0.0), after(0.0);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t i = std::size_t(y) * grid.width + std::size_t(x);
            before += dvec3(histogram[i]) * grid.largest;
            if (!(grid.area[i] > 0.0)) {
                continue;
            }
            dvec3 power(0.0);
            double area = 0.0;
            float met = 0.0F;
            for (std::size_t k = 0; k < steps.size();) {
                const float ring = steps[k].distance;
                for (; k < steps.size() && steps[k].distance == ring; ++k) {
                    const int u = x + steps[k].x, v = y + steps[k].y;
                    if (u < 0 || v < 0 || u >= width || v >= height) {
                        continue;
                    }
                    const std::size_t j = std::size_t(v) * grid.width + std::size_t(u);
                    if (grid.area[j] > 0.0) {
                        power += dvec3(histogram[j]) * grid.largest;
                        area += grid.area[j];
                        met += luminance(histogram[j]) * float(grid.largest / std::max(grid.area[j], thin));
                    }
                }
                if (met >= most) {
                    break;
                }
            }
            out[i] = area > thin ? Rgb(power / area) : Rgb(0.0F);
            after += dvec3(out[i]) * grid.area[i];
        }
    }
    for (int k = 0; k < 3; ++k) {
        const auto scale = float(after[k] > 0.0 ? before[k] / after[k] : 0.0);
        for (Rgb& p : out) {
            p[k] *= scale;
        }
    }
    return out;
}

void fill_around(std::vector<Rgb>& image, const TexelGrid& grid) {
    std::vector<std::uint8_t> has(grid.size());
    for (std::size_t i = 0; i < has.size(); ++i) {
        has[i] = grid.area[i] > 0.0 ? 1 : 0;
    }
    if (std::all_of(has.begin(), has.end(), [](std::uint8_t h) { return h != 0; })) {
        return;
    }
    const auto width = int(grid.width), height = int(grid.height);
    for (int pass = 0; pass < 2; ++pass) {
        const std::vector<std::uint8_t> before = has;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const std::size_t i = std::size_t(y) * grid.width + std::size_t(x);
                if (before[i] != 0) {
                    continue;
                }
                Rgb sum(0.0F);
                int count = 0;
                for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v) {
                    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
                        const std::size_t j = std::size_t(v) * grid.width + std::size_t(u);
                        if (before[j] != 0) {
                            sum += image[j];
                            ++count;
                        }
                    }
                }
                if (count > 0) {
                    image[i] = sum / float(count);
                    has[i] = 1;
                }
            }
        }
    }
}

} // namespace atrium
