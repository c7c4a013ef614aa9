// A chart's rectangle cut into texels, with the true area of surface in each.
#pragma once

#include "engine/caustics/caustic_builder.h"

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
/// leaves the bits as they were. Holds up to 3e10 lux.
class CausticAccumulator {
public:
    static constexpr double kQuantum = 0x1.0p-28;
    explicit CausticAccumulator(std::size_t texels) : sums_(3 * texels, 0) {}
    /// Adds irradiance (lux; negative takes it away) to a texel. One thread at a time.
    void add(std::size_t texel, const dvec3& irradiance);
    /// The same from any thread.
    void add_shared(std::size_t texel, const dvec3& irradiance);
    [[nodiscard]] std::vector<Rgb> image() const;
    friend bool operator==(const CausticAccumulator&, const CausticAccumulator&) = default;

private:
    std::vector<std::int64_t> sums_;
};

} // namespace atrium
