// An immutable snapshot of the light, shared by whoever shows or measures it.
#pragma once

#include "engine/base/result.h"
#include "engine/caustics/caustic_texture.h"
#include "engine/layers/surface_layer.h"
#include "engine/solver/statistics.h"

#include <memory>
#include <span>
#include <vector>

namespace atrium {

/// Where particles landed on one side of a surface: to be looked at, nothing is computed from it.
struct SurfaceLandings {
    NodeId node;
    std::uint32_t part = 0;
    bool back = false;
    std::vector<vec3> places; ///< in the node's own coordinates
};

struct Insides; // insides.h

/// Result of a solve at one revision of the document. Never changed after it was published; surfaces are shared between
/// snapshots while unchanged.
struct Solution {
    std::uint64_t revision = 0; ///< of the scene that it was computed for
    bool final = false;         ///< false = a first, coarse picture; a better one follows
    std::vector<std::shared_ptr<const SurfaceLayer>> surfaces;
    std::vector<CausticRecord> caustic_records; ///< what was decided about surfaces that caustic light falls on
    /// Null unless asked for (SolveOptions::keep_landings): 12 bytes a landing. Not kept in project files.
    std::shared_ptr<const std::vector<SurfaceLandings>> landings;
    /// Null unless asked for (SolveOptions::keep_insides): elements, links and ways of particles, to be looked at
    /// (engine/debug). Not kept in project files.
    std::shared_ptr<const Insides> insides;
    Statistics statistics;
    bool updatable = false;   ///< the engine keeps what GiEngine::update() starts from; not kept in project files
    double mean_radiance = 0; ///< log-average of shown diffuse radiance, cd/m2: what automatic exposure starts from
};

/// Layers, records and statistics as compressed bytes for the project file (versioned; ids are stored as indices into
/// `scene`'s nodes in tree order, so they survive the ids of another session).
std::vector<std::byte> encode_solution(const Solution& solution, const Scene& scene);
/// Reads it back. Damaged, truncated or of another version: an error, and the caller solves again.
Result<std::shared_ptr<const Solution>> decode_solution(std::span<const std::byte> bytes, const Scene& scene);

} // namespace atrium
