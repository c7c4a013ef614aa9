// Many particles of many links traced side by side.
#pragma once

#include "engine/base/run_context.h"
#include "engine/particles/particle_tracer.h"

#include <array>
#include <span>
#include <vector>

namespace atrium {

/// What particles are traced in.
struct ParticleScene {
    const RayScene& rays;
    const SpecularTargets& targets;
    const DirectLight& direct;
    const Hierarchy& emitters;
    CarriedByImage by_image;         ///< see trace_particle()
    const Hierarchy* matt = nullptr; ///< that the leaves of matt sources are of; null where there are none
    MattDetail detail = {};          ///< of these; may be empty
};

/// Light from one source to one target. Its stream of particles is fixed by its key: more of them keep those there were.
struct ParticleLink {
    std::uint32_t source = 0; ///< into ParticleMap::sources()
    std::uint32_t target = 0; ///< into SpecularTargets::targets()
    std::uint64_t key = 0;
    std::uint32_t count = 0; ///< particles emitted
    double landed = 0.0;     ///< lumen that reached surfaces, luminance, by the pilot
    std::size_t first = 0;   ///< its landings in ParticleMap::landings()
    std::size_t landings = 0;
    std::size_t first_particle = 0; ///< the number of its first one: all particles are numbered link by link
    ParticleAim aim;
    Box3 aimed_at; ///< the target's bounds
};

/// ParticleEnergy of one particle, in its order, small enough to be kept.
using ParticleShares = std::array<float, 6>;

/// What became of a run of particles, in the order of their numbers.
struct ParticleBatch {
    std::vector<Landing> landings;
    ParticleEnergy energy;
    // With paths; for each particle:
    std::vector<std::uint32_t> landing_count;
    std::vector<std::uint32_t> vertex_count;
    std::vector<ParticleShares> shares;
    std::vector<vec3> vertices; ///< see ParticlePaths::add_vertices()
};

/// Numbers the particles of links by their counts and aims them at the targets as they are now.
void prepare_links(std::vector<ParticleLink>& links, const std::vector<ParticleSource>& sources,
                   const SpecularTargets& targets);

/// Traces all particles of the links, or only those of ascending numbers `only` (may be null), in batches that do not
/// depend on threads. What was not traced when the context stopped is missing.
std::vector<ParticleBatch> trace_batches(const ParticleScene& scene, const std::vector<ParticleSource>& sources,
                                         const std::vector<ParticleLink>& links, const std::vector<std::uint32_t>* only,
                                         bool with_paths, const RunContext& context);

} // namespace atrium
