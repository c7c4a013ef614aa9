// What a solution was computed with, as a value that can be looked at. Nothing is computed from it.
#pragma once

#include "engine/particles/particle_map.h"
#include "engine/particles/specular_targets.h"
#include "engine/radiosity/leaf_exchange.h"
#include "engine/raycast/ray_scene.h"

#include <memory>
#include <vector>

namespace atrium {

/// The way of one particle: engine coordinates, from where it started to where it ended.
struct ParticleWay {
    std::vector<vec3> points;
    std::uint32_t landed_on = Hit::kNone; ///< index into Insides::surfaces
    std::uint32_t aimed_at = Hit::kNone;  ///< likewise: the mirror or glass that it met first
    Rgb power{0.0F};                      ///< of what landed, lumen
};

/// Copies of what GiEngine keeps (the exchange itself, which never changes): about as much memory again as its elements.
/// Light of elements is that of the solution it comes with; who sees whom is that of the last complete one.
struct Insides {
    dvec3 origin{0.0}; ///< world position of engine coordinates (0,0,0), metres
    std::vector<RaySurface> surfaces;
    Hierarchy hierarchy;
    std::shared_ptr<const LeafExchange> exchange; ///< null where nothing is lit
    std::vector<ParticleWay> ways;                ///< a sample: see kWays
    std::uint64_t particles = 0;                  ///< emitted, of which `ways` are some
    std::shared_ptr<const ParticlePaths> paths;   ///< of all of them; null where there are none
    float reach = 0.0F;                           ///< of the scene, metres, as the octree of passing particles needs it
    std::size_t passage_cells = 0;                ///< of that octree in the engine; 0 = they are found by a scan there

    /// As many ways at most for every surface, of the particles that landed on it and of those that were aimed at it.
    static constexpr std::size_t kWays = 400;
};

/// `exchange`, `particles` and `targets` may be null. Any thread, while nothing changes these.
std::shared_ptr<const Insides> make_insides(const RayScene& rays, const Hierarchy& hierarchy,
                                            std::shared_ptr<const LeafExchange> exchange, const ParticleMap* particles,
                                            const SpecularTargets* targets);

} // namespace atrium
