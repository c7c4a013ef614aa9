// One particle from its source over mirrors, metals and glass to the diffuse surfaces that it lands on, with the size of the
// gap to its neighbours.
#pragma once

#include "engine/particles/emission.h"

#include <functional>
#include <vector>

namespace atrium {

/// A particle where a surface receives it. Its power = throughput * ParticleSource::brightness(): what changes with a lamp's
/// brightness or a wall's colour is not stored.
struct Landing {
    std::uint32_t surface = 0; ///< of RayScene::surfaces()
    std::uint32_t triangle = 0;
    vec2 barycentric{0.0F};
    Rgb throughput{0.0F}; ///< lumen where the source's brightness is 1
    vec3 axis_a{0.0F};    ///< half axes of the footprint in the surface, metres
    vec3 axis_b{0.0F};
    std::uint32_t link = 0;  ///< of ParticleMap::links()
    std::uint32_t index = 0; ///< in the link's stream
    std::uint32_t leaf = 0;  ///< that it left, its place among ParticleSource::leaves
    std::uint16_t bends = 0;
    bool back = false; ///< on the back side
    friend bool operator==(const Landing&, const Landing&) = default;
};

/// Where the power of particles went, luminance, lumen. Every particle that met its target counts as emitted, so emitted =
/// absorbed + escaped + stored + imaged + cut, to rounding. What the roulette takes and gives is part of `absorbed`: it
/// cancels but for chance.
struct ParticleEnergy {
    double emitted = 0;
    double absorbed = 0; ///< in mirrors and glass
    double escaped = 0;
    double stored = 0; ///< landed for good: what goes on from a surface that also mirrors is not part of it
    double imaged = 0; ///< landed where the direct layer's mirror images have the light
    double cut = 0;    ///< still on its way after kMostSurfaces
    ParticleEnergy& operator+=(const ParticleEnergy& o) {
        emitted += o.emitted;
        absorbed += o.absorbed;
        escaped += o.escaped;
        stored += o.stored;
        imaged += o.imaged;
        cut += o.cut;
        return *this;
    }
};

/// What a point of a matt source's leaf (an element) sends over what the whole leaf does, its mean about 1.
using MattDetail = std::function<Rgb(std::uint32_t leaf, const vec3& position)>;

/// How a link's particles are traced.
struct ParticleStream {
    const ParticleSource* source = nullptr;
    std::uint32_t target = 0; ///< index into SpecularTargets::targets()
    std::uint32_t link = 0;
    std::uint64_t key = 0;
    std::uint32_t count = 0; ///< particles in the stream
    ParticleAim aim;
    const MattDetail* detail = nullptr; ///< of a matt source; null where leaves send alike from all over
};

/// True where a chain whose only bend is at this hit is carried by mirror images of the light.
using CarriedByImage = std::function<bool(const Hit& hit)>;

/// Traces particle `index` of a stream. A particle counts when the first thing that bends it is its own target (clear panes
/// are passed); then on until it is absorbed, escapes, or has landed on everything that receives it. `path` (may be null)
/// gets its rays as they were traced, tmax = where each ended. Safe from any thread.
void trace_particle(const RayScene& rays, const SpecularTargets& targets, const Hierarchy& emitters,
                    const ParticleStream& stream, std::uint32_t index, const CarriedByImage& by_image,
                    std::vector<Landing>& landings, ParticleEnergy& energy, std::vector<Ray>* path = nullptr);

} // namespace atrium
