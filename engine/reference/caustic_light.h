// Caustic light where the reference asks for it: discs about points, and photon maps for pictures.
#pragma once

#include "engine/base/run_context.h"
#include "engine/reference/disc_tree.h"
#include "engine/reference/light_tracer.h"

namespace atrium {

/// Particles [first, first + count) of a stream.
struct CausticBatch {
    std::uint64_t key = 0;
    std::uint64_t first = 0;
    std::uint64_t count = 0;
};

/// Irradiance on each disc from a batch of particles, lux: what the reference's paths leave out, with everything that it
/// becomes over further bounces. Light that comes over mirrors and glass last is a mean over the disc. Light that a matt
/// surface sends straight is that at its middle: wherever particles are scattered, one disc picked at random is looked at.
/// Stopped, it returns soon, and nothing of use.
std::vector<Rgb> caustic_light_on(const DiscTree& discs, const RayScene& rays, const LightTracer& tracer,
                                  const CausticBatch& batch, const RunContext& context);

/// Where the particles of one stream landed. Immutable once built; safe from any thread.
class CausticMap {
public:
    CausticMap() = default;
    CausticMap(float radius, const LightTracer& tracer, const CausticBatch& batch, const RunContext& context);
    /// Irradiance about a point of a surface side, lux: of particles within the radius that landed on sides that face the
    /// same way (within 45 degrees). Biased by as much as light changes within the radius, and dark along outer edges.
    [[nodiscard]] Rgb irradiance(const vec3& point, const vec3& normal) const;

private:
    struct Photon {
        vec3 position{0.0F};
        vec3 side{0.0F};
        Rgb flux{0.0F};
    };
    [[nodiscard]] ivec3 cell(const vec3& p) const;
    [[nodiscard]] std::size_t bucket(const ivec3& cell) const;

    float radius_ = 0.0F;
    std::vector<Photon> photons_;       ///< by bucket
    std::vector<std::uint32_t> starts_; ///< of each bucket, with one past the last
};

} // namespace atrium
