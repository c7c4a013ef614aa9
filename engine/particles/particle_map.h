// All particles of a scene: links from sources to specular targets, how many particles each is worth, and where they landed.
#pragma once

#include "engine/base/run_context.h"
#include "engine/particles/particle_tracer.h"

#include <vector>

namespace atrium {

struct ParticleSettings {
    std::uint32_t particles = 250'000; ///< emitted at most, all links together
    std::uint32_t pilot = 256;         ///< of every link: what it is worth
    std::uint32_t seed = 1;
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
};

/// Immutable once built.
class ParticleMap {
public:
    /// Traces everything, on all cores; the same for any number of them. `by_image`: see trace_particle(). Where no source
    /// reaches a target nothing is stored. Stopped by the context: complete() is false.
    ParticleMap(const RayScene& rays, const SpecularTargets& targets, const DirectLight& direct, const Hierarchy& emitters,
                const CarriedByImage& by_image, const ParticleSettings& settings, const RunContext& context);

    [[nodiscard]] bool complete() const { return complete_; }
    [[nodiscard]] const std::vector<ParticleSource>& sources() const { return sources_; }
    [[nodiscard]] const std::vector<ParticleLink>& links() const { return links_; }  ///< only such as light something
    [[nodiscard]] const std::vector<Landing>& landings() const { return landings_; } ///< link by link, in stream order
    [[nodiscard]] std::uint64_t emitted() const { return emitted_; }                 ///< particles, the pilot's aside
    [[nodiscard]] const ParticleEnergy& energy() const { return energy_; }
    /// Power of a landing, lumen.
    [[nodiscard]] Rgb power(const Landing& landing) const {
        return landing.throughput * sources_[links_[landing.link].source].radiance;
    }
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    bool complete_ = false;
    std::vector<ParticleSource> sources_;
    std::vector<ParticleLink> links_;
    std::vector<Landing> landings_;
    std::uint64_t emitted_ = 0;
    ParticleEnergy energy_;
};

} // namespace atrium
