// Caustic light on a rectangle of a chart: what is added to the other light of a surface side.
#pragma once

#include "engine/base/ids.h"
#include "engine/base/units.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace atrium {

/// Immutable once built. Texels are cells of the rectangle [low, high] of the surface's chart space (tiles, see
/// SurfaceCharts), within one chart. The outermost ring of texels is black where the rectangle ends within the chart, so
/// textures are added up without a seam; on the chart's own edge it is not, so that light goes on up to the edge.
struct CausticTexture {
    vec2 low{0.0F};
    vec2 high{0.0F};
    std::uint32_t width = 0; ///< texels along u
    std::uint32_t height = 0;
    std::vector<Rgb> image; ///< irradiance, lux, row by row from low

    /// Irradiance at chart-space coordinates, lux: bilinear between texel middles, clamped to them at the rectangle's edge;
    /// 0 outside. Its integral is the sum of texels times their areas.
    [[nodiscard]] Rgb irradiance(const vec2& uv) const;
    [[nodiscard]] std::size_t memory_bytes() const { return sizeof(*this) + image.size() * sizeof(Rgb); }
    friend bool operator==(const CausticTexture&, const CausticTexture&) = default;
};

/// What was decided about one chart of a surface side that particles landed on, and why: what the inspector shows.
struct CausticRecord {
    enum class Decision : std::uint8_t {
        Texture,   ///< light has detail finer than the mesh
        Uniform,   ///< light is as even as chance allows
        Coarse,    ///< its detail is no finer than the mesh
        TooFew,    ///< too few particles to say
        Uncharted, ///< pieces too small for a chart
        SetToMesh  ///< by hand, see CausticWish
    };
    /// What the resolution follows.
    enum class Sizing : std::uint8_t {
        None,       ///< there is no texture
        Footprints, ///< half the width of narrow kernels
        Mesh,       ///< kernels are wider than that: a quarter of what the mesh resolves
        Particles,  ///< footprints are unknown: one particle a texel
        Brightness, ///< what a texel may hold
        Memory,     ///< what the memory for textures allows
        ByHand,     ///< see CausticWish
        Equation7   ///< paper mode
    };
    NodeId node;
    std::uint32_t part = 0;
    std::uint32_t chart = 0; ///< of SurfaceCharts; 0xFFFFFFFF for everything uncharted
    bool back = false;
    Decision decision = Decision::TooFew;
    Decision found = Decision::TooFew; ///< what the tests say: `decision`, unless that was set by hand
    CausticWish wish;                  ///< of the surface's node
    Sizing sizing = Sizing::None;
    std::uint64_t particles = 0;
    float contrast = 0.0F;   ///< (p_max - p_min) / p_max of the histogram, PAPER equation 2
    float dispersion = 0.0F; ///< standard deviations by which the histogram is more uneven than chance
    float threshold = 0.0F;  ///< what contrast (paper mode) or dispersion (default) was held against
    vec2 extent{0.0F};       ///< of the chart, metres
    std::uint32_t width = 0; ///< of the histogram over the whole chart, texels: the resolution chosen
    std::uint32_t height = 0;
    float kernel = 0.0F;      ///< width of a kernel across its narrow side, metres, the median by power; 0 = no kernels
    std::string why;          ///< of the resolution and of what was set by hand, for people
    std::vector<vec4> boxes;  ///< restriction boxes u0, v0, u1, v1 in the chart's [0,1]^2
    double power_texture = 0; ///< lumen in textures (luminance)
    double power_mesh = 0;    ///< lumen on the mesh
    std::uint64_t bytes = 0;  ///< of the textures
    friend bool operator==(const CausticRecord&, const CausticRecord&) = default;
};
const char* caustic_decision_name(CausticRecord::Decision decision);

} // namespace atrium
