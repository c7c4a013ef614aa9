// A chart's rectangle cut into texels, with the true area of surface in each.
#pragma once

#include "engine/caustics/caustic_builder.h"

#include <emmintrin.h>

namespace atrium {

/// The part of a surface that a caustic texture may lie on: one chart.
struct ChartDomain {
    std::uint32_t chart = 0;
    vec2 low{0.0F}; ///< of its rectangle, chart space (tiles)
    vec2 high{0.0F};
    vec2 extent{0.0F};                    ///< metres
    double area = 0.0;                    ///< of surface, square metres
    std::vector<std::uint32_t> triangles; ///< of the surface
};
/// One domain per chart, in order.
std::vector<ChartDomain> chart_domains(const SurfaceCharts& charts, std::span<const vec3> positions,
                                       std::span<const uvec3> triangles);

/// Texels over a rectangle of a domain.
struct TexelGrid {
    vec2 low{0.0F}; ///< chart space
    vec2 high{0.0F};
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<double> area; ///< square metres of surface in each texel, row by row; 0 where there is none
    double largest = 0.0;     ///< of them: that of a texel full of surface, where any is

    [[nodiscard]] std::size_t size() const { return std::size_t(width) * height; }
    /// Texel coordinates of a chart-space position: the integer part is the texel.
    [[nodiscard]] vec2 to_texels(const vec2& uv) const {
        return (uv - low) / (high - low) * vec2(float(width), float(height));
    }
    /// Texel that holds a position, clamped to the grid.
    [[nodiscard]] std::size_t texel_at(const vec2& uv) const;
};
/// Areas are exact: triangles are clipped against the texels.
TexelGrid make_grid(const ChartDomain& domain, const SurfaceCharts& charts, std::span<const vec3> positions,
                    std::span<const uvec3> triangles, const vec2& low, const vec2& high, std::uint32_t width,
                    std::uint32_t height);

/// Light on a texel grid as whole numbers of kQuantum lux: sums do not depend on their order, and what is taken away again
/// leaves the bits as they were. The quantum, 6e-8 lux, is little beside starlight (1e-4 lux); 63 bits of it are
/// 5e11 lux, a hundred times what a lens can make of the sun (1e5 lux over the square of 4.6 mrad = 5e9).
class CausticAccumulator {
public:
    static constexpr double kQuantum = 0x1.0p-24;
    static constexpr double kMost = 0x1.0p38; ///< lux: what one texel may hold
    explicit CausticAccumulator(std::size_t texels) : sums_(3 * texels, 0) {}
    /// Adds irradiance (lux, at most kMost; negative takes it away) to a texel. One thread at a time.
    void add(std::size_t texel, const dvec3& irradiance) {
        for (int k = 0; k < 3; ++k) {
            sums_[3 * texel + std::size_t(k)] += quanta(irradiance[k]);
        }
    }
    /// Adds another's sums to rows of this one's texels: [begin, end) of them all.
    void add(const CausticAccumulator& other, std::size_t begin, std::size_t end);
    [[nodiscard]] std::vector<Rgb> image() const;
    friend bool operator==(const CausticAccumulator&, const CausticAccumulator&) = default;

private:
    // To the nearest whole number, of two the even one: an amount and its negative cancel.
    static std::uint64_t quanta(double lux) { return std::uint64_t(_mm_cvtsd_si64(_mm_set_sd(lux * (1.0 / kQuantum)))); }
    std::vector<std::uint64_t> sums_; ///< two's complement: whatever is taken away before it is added, all comes out right
};

/// Sum of amounts that does not depend on their order: whole multiples of 2^-34 of the largest.
class OrderFreeSum {
public:
    explicit OrderFreeSum(double largest) : quantum_(largest > 0.0 ? std::ldexp(largest, -34) : 1.0) {}
    void add(double amount) { sum_ += std::int64_t(_mm_cvtsd_si64(_mm_set_sd(amount / quantum_))); }
    [[nodiscard]] double value() const { return double(sum_) * quantum_; }

private:
    double quantum_;
    std::int64_t sum_ = 0;
};

} // namespace atrium
