// Thresholds of the solver that a quality stands for, as far as they can be set by hand.
#pragma once

#include <array>

namespace atrium {

/// 0 = automatic: what the quality makes of the scene's size. Part of SolverSettings, in every solution of the scene.
struct SolverThresholds {
    float element_edge = 0.0F;       ///< metres: patches are not split whose longer edge is below twice this
    float link_share = 0.0F;         ///< of the flux in a room: a transfer less sure than this gets finer links
    float leaf_contrast = 0.0F;      ///< relative: elements on which reflected light is more uneven are divided
    float mesh_edge = 0.0F;          ///< metres: edges of the shown mesh are not split below this
    float mesh_contrast = 0.0F;      ///< relative: edges along which light is less even are split
    float shadow_texel = 0.0F;       ///< metres: texels of direct light along sharp edges, the finest; by steps of two
    float reflected_rays = 0.0F;     ///< first look over the hemisphere for reflected light, rays
    float particles = 0.0F;          ///< that are sent over mirrors and glass at most
    float caustic_dispersion = 0.0F; ///< standard deviations beyond chance that ask for a caustic texture
    [[nodiscard]] bool automatic() const { return *this == SolverThresholds{}; }
    friend bool operator==(const SolverThresholds&, const SolverThresholds&) = default;
};

/// One of them: its word in files, and what can be set. Values outside are taken as the nearest one inside.
struct ThresholdInfo {
    const char* key;
    float SolverThresholds::*value;
    float least, most;
};
inline constexpr std::array<ThresholdInfo, 9> kThresholds{
    {{"elementEdge", &SolverThresholds::element_edge, 0.002F, 100.0F},
     {"linkShare", &SolverThresholds::link_share, 1e-6F, 0.1F},
     {"leafContrast", &SolverThresholds::leaf_contrast, 0.01F, 10.0F},
     {"meshEdge", &SolverThresholds::mesh_edge, 0.002F, 100.0F},
     {"meshContrast", &SolverThresholds::mesh_contrast, 0.002F, 10.0F},
     {"shadowTexel", &SolverThresholds::shadow_texel, 0.0005F, 10.0F},
     {"reflectedRays", &SolverThresholds::reflected_rays, 8.0F, 4096.0F},
     {"particles", &SolverThresholds::particles, 1000.0F, 16'000'000.0F},
     {"causticDispersion", &SolverThresholds::caustic_dispersion, 1.0F, 1000.0F}}};

} // namespace atrium
