// From particles that landed on a surface side to caustic textures and what stays on the mesh.
#pragma once

#include "engine/base/run_context.h"
#include "engine/caustics/caustic_texture.h"
#include "engine/geometry/surface_charts.h"

#include <span>

namespace atrium {

/// A particle where it landed on a charted triangle.
struct CausticLanding {
    std::uint32_t triangle = 0;
    vec2 barycentric{0.0F};
    vec2 uv{0.0F};     ///< chart-space coordinates, tiles
    vec2 axis_a{0.0F}; ///< half axes of its footprint in chart space, tiles: what lies between it and its neighbours in the
    vec2 axis_b{0.0F}; ///< stream of particles, any two conjugate ones; (0,0) = unknown
    Rgb power{0.0F};   ///< lumen
};

struct CausticSettings {
    bool paper = false; ///< the algorithms of 2001: contrast, equation 7, spiral, flood fill
    std::uint32_t least_particles = 10;
    float eta = 0.6F;                     ///< paper: contrast that asks for a texture
    float epsilon = 1.0F;                 ///< paper: bound of the variance, equation 7
    float spiral_radius = 3.0F;           ///< paper: R, texels
    float restriction = 0.02F;            ///< paper: share of p_max that texels of a box have
    float least_dispersion = 6.0F;        ///< default: standard deviations
    float mesh_edge = 0.1F;               ///< metres: what the mesh resolves
    std::uint32_t most_texels = 1U << 22; ///< of all textures of a surface side together
    CausticWish wish;                     ///< of the surface's node
};

struct CausticSide {
    std::vector<std::shared_ptr<const CausticTexture>> textures;
    std::vector<CausticRecord> records; ///< node, part and back are left to the caller
    std::vector<std::uint32_t> on_mesh; ///< landings that no texture holds, by index, in order
};

/// `positions` and `triangles` are the surface's in engine coordinates (metres), in the order of `charts`. One result for
/// any number of threads and any order of the landings (texels are summed in whole numbers). What the textures hold plus
/// the power of the landings on the mesh is the power of all landings, to rounding. Stopped by the context: empty.
CausticSide build_caustics(std::span<const CausticLanding> landings, const SurfaceCharts& charts,
                           std::span<const vec3> positions, std::span<const uvec3> triangles,
                           const CausticSettings& settings, const RunContext& context = {});

} // namespace atrium
