// Places spread evenly over the diffuse surfaces of a scene that light can reach: where light is compared.
#pragma once

#include "engine/reference/path_tracer.h"

#include <cstdint>
#include <vector>

namespace atrium {

/// A point on one side of a diffuse surface.
struct LitPlace {
    dvec3 position{0.0};         ///< metres, world
    dvec3 normal{0.0, 1.0, 0.0}; ///< unit, of the side: the smooth normal of curved things, as they are shown
    NodeId node;
    /// Share of what it sees that is farther than 5 cm (in a room with a diagonal of 10 m, else in proportion), weighted by
    /// the cosine: small in gaps, such as between books or behind a lamp on the ceiling, into which nobody looks.
    float open = 1.0F;
    [[nodiscard]] bool seen() const { return open >= 0.1F; }
};

/// Up to `count` random places, evenly by area over both sides where both have light; the same ones for the same scene,
/// count and seed. Left out are places that something lies on within a millimetre or in whose very plane another surface
/// lies (which of the two is seen there is left to rounding), holes of masks, and insides that no light gets into.
/// Fewer or none when stopped.
std::vector<LitPlace> lit_places(const RayScene& rays, const PathTracer& tracer, std::size_t count, std::uint32_t seed,
                                 const RunContext& context = {});

} // namespace atrium
