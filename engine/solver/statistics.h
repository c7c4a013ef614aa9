// The figures of CONTRACTS' `--stats`, filled by the engine; written as JSON by atrium-cli.
#pragma once

#include "engine/scene/features.h"

#include <cstdint>
#include <string>
#include <vector>

namespace atrium {

/// What it took to bring the light up to date after edits. All of it is zero for a solve from scratch.
struct UpdateStatistics {
    bool degraded = false;               ///< made in a hurry during a gesture; a full update follows
    std::uint64_t particles_traced = 0;  ///< those that had to be sent again
    double particles_share = 0;          ///< of all particles of the scene, 0 to 1
    std::uint64_t links_visited = 0;     ///< looked at to find what the edit touches
    std::uint64_t links_changed = 0;     ///< computed again, made or removed
    std::uint64_t octree_bytes = 0;      ///< of the tree that tells which particles pass where
    std::uint64_t sources_changed = 0;   ///< lamps, emitting materials and skies that were dimmed, coloured or moved
    std::uint64_t materials_changed = 0; ///< whose colour or emission is another
    friend bool operator==(const UpdateStatistics&, const UpdateStatistics&) = default;
};

/// Light at random places of all surfaces against brute force (audit_error()). The difference of a place is relative to the
/// truth there, or to a twentieth of the mean where that is more.
struct ErrorAudit {
    double rms = 0;           ///< root mean square of the differences
    double low = 0, high = 0; ///< bounds of rms that hold 95 times in 100
    double bias = 0;          ///< of the mean irradiance, relative
    double bias_error = 0;    ///< its standard error
    std::uint32_t points = 0; ///< 0 = no audit was made
    std::uint64_t paths = 0;  ///< of the truth at each point
    std::uint64_t rays = 0;
    double seconds = 0;
    double typical = 0; ///< half of the places differ by no more than this, the truth's own noise included
    friend bool operator==(const ErrorAudit&, const ErrorAudit&) = default;
};

/// Times in seconds of wall clock, sizes in bytes. What was not used is zero.
struct Statistics {
    struct Phase {
        std::string name;
        double seconds = 0;
        double share = 0;       ///< of time.solve
        double cpu_seconds = 0; ///< processor time of the whole process in that phase
    };
    std::vector<Feature> features;
    struct {
        double load = 0, build = 0, solve = 0, first_picture = 0, total = 0;
    } time;
    std::vector<Phase> phases;
    unsigned threads = 0;
    std::uint32_t seed = 0;
    std::string mode = "default";
    std::string quality = "normal";
    int iterations = 0;
    bool converged = false;
    double residual = 0; ///< relative, of the linear system on the final links
    /// Relative error of irradiance, root mean square over the area of all surfaces: measured where there is an audit, else
    /// what the samples' spread and the size of leaves tell, which is too little where surfaces lie close together.
    double error_estimate = 0;
    ErrorAudit audit;
    bool link_budget_reached = false; ///< memory ran out: elements or texels are larger than the quality asks for
    std::uint64_t triangles = 0, elements = 0, clusters = 0, links = 0, rays = 0;
    std::uint64_t records = 0; ///< of reflected light that the picture was interpolated from
    std::uint64_t particles_emitted = 0, particles_stored = 0;
    struct {
        std::uint64_t elements = 0, links = 0, particles = 0, octree = 0, caustic_textures = 0, layers = 0, ray_scene = 0,
                      peak_rss = 0;
    } memory;
    struct {
        double emitted = 0, absorbed = 0, escaped = 0, defect = 0; ///< lumen; defect = 1 - (absorbed + escaped) / emitted
    } energy;
    UpdateStatistics update; ///< not kept in project files: it is about a run, not about the light
};

/// Highest resident set of this process so far, bytes.
std::uint64_t peak_resident_bytes();

} // namespace atrium
