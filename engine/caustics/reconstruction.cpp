#include "engine/caustics/reconstruction.h"

#include <algorithm>

namespace atrium {
namespace {

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

bool splat(const CausticLanding& landing, const TexelGrid& grid, const LitRange& range, const KernelLimits& limits,
           CausticAccumulator& sums, bool shared, double sign) {
    const Spread m = kernel_of(landing, grid, limits);
    const std::array<int, 2>& first = range.first;
    const std::array<int, 2>& last = range.last;
    const float determinant = std::max(m.xx * m.yy - m.xy * m.xy, 1e-12F);
    const float ixx = m.yy / determinant, ixy = -m.xy / determinant, iyy = m.xx / determinant;
    const vec2 at = grid.to_texels(landing.uv);
    const float rx = std::sqrt(m.xx), ry = std::sqrt(m.yy);
    const int x0 = std::max(int(std::floor(at.x - rx - 0.5F)), first[0]), x1 = std::min(int(at.x + rx + 1.0F), last[0]);
    const int y0 = std::max(int(std::floor(at.y - ry - 0.5F)), first[1]), y1 = std::min(int(at.y + ry + 1.0F), last[1]);
    double total = 0.0;
    // What falls beyond the chart's edge is thrown back as by a mirror there: even light stays even up to the edge.
    const auto fold = [](float place, float reach, float low, float high) {
        return std::array<float, 3>{0.0F, low >= 0.0F && place - reach < low ? low : -1.0F,
                                    high >= 0.0F && place + reach > high ? high : -1.0F};
    };
    const std::array<float, 3> fold_x = fold(at.x, rx, range.edge_low.x, range.edge_high.x);
    const std::array<float, 3> fold_y = fold(at.y, ry, range.edge_low.y, range.edge_high.y);
    const auto kernel = [&](float dx, float dy) {
        return std::max(1.0F - (ixx * dx * dx + 2.0F * ixy * dx * dy + iyy * dy * dy), 0.0F);
    };
    const bool folds = fold_x[1] >= 0.0F || fold_x[2] >= 0.0F || fold_y[1] >= 0.0F || fold_y[2] >= 0.0F;
    const auto for_each = [&](auto&& visit) {
        for (int y = y0; y < y1; ++y) {
            const float cy = float(y) + 0.5F;
            for (int x = x0; x < x1; ++x) {
                const float cx = float(x) + 0.5F;
                float w = kernel(cx - at.x, cy - at.y);
                for (std::size_t j = 0; folds && j < 3; ++j) {
                    for (std::size_t i = 0; i < 3; ++i) {
                        if (i + j > 0 && fold_x[i] >= 0.0F && fold_y[j] >= 0.0F) {
                            w += kernel((i > 0 ? 2.0F * fold_x[i] - cx : cx) - at.x,
                                        (j > 0 ? 2.0F * fold_y[j] - cy : cy) - at.y);
                        }
                    }
                }
                if (w > 0.0F) {
                    visit(std::size_t(y) * grid.width + std::size_t(x), double(w));
                }
            }
        }
    };
    for_each([&](std::size_t i, double w) { total += w * grid.area[i]; });
    if (total > 0.0) {
        const dvec3 scaled = dvec3(landing.power) * (sign / total);
        for_each([&](std::size_t i, double w) {
            if (grid.area[i] > 0.0) {
                shared ? sums.add_shared(i, scaled * w) : sums.add(i, scaled * w);
            }
        });
        return true;
    }
    // A kernel between the middles of texels: the texel that it is in.
    const int x = std::clamp(int(std::floor(at.x)), first[0], last[0] - 1);
    const int y = std::clamp(int(std::floor(at.y)), first[1], last[1] - 1);
    const std::size_t i = std::size_t(y) * grid.width + std::size_t(x);
    if (last[0] <= first[0] || last[1] <= first[1] || !(grid.area[i] > 0.0)) {
        return false;
    }
    const dvec3 all = dvec3(landing.power) * (sign / grid.area[i]);
    shared ? sums.add_shared(i, all) : sums.add(i, all);
    return true;
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
    float most = 0.0F;
    for (const Rgb& p : histogram) {
        most = std::max(most, luminance(p));
    }
    std::vector<Rgb> out(histogram.size(), Rgb(0.0F));
    dvec3 before(0.0), after(0.0);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t i = std::size_t(y) * grid.width + std::size_t(x);
            before += dvec3(histogram[i]) * grid.area[i];
            if (!(grid.area[i] > 0.0)) {
                continue;
            }
            Rgb sum(0.0F);
            int count = 0;
            for (std::size_t k = 0; k < steps.size();) {
                const float ring = steps[k].distance;
                for (; k < steps.size() && steps[k].distance == ring; ++k) {
                    const int u = x + steps[k].x, v = y + steps[k].y;
                    if (u < 0 || v < 0 || u >= width || v >= height) {
                        continue;
                    }
                    const std::size_t j = std::size_t(v) * grid.width + std::size_t(u);
                    if (grid.area[j] > 0.0) {
                        sum += histogram[j];
                        ++count;
                    }
                }
                if (luminance(sum) >= most) {
                    break;
                }
            }
            out[i] = count > 0 ? sum / float(count) : Rgb(0.0F);
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
