// What the leaves of the hierarchy see around them, and which of them are in one room.
#pragma once

#include "engine/base/run_context.h"
#include "engine/radiosity/hierarchy.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace atrium {

/// How leaves look around.
struct LookSettings {
    std::uint32_t rays = 64; ///< per leaf, best a power of two
    /// Points that lie on something: they neither send nor receive. None when empty. Called from any thread.
    std::function<bool(const SurfacePoint&)> covered;
};

/// One entry per leaf, in the order of the list that was asked for.
struct LeafSurroundings {
    /// Leaf at the end of a ray, or met on its way over mirrors and through glass.
    struct Seen {
        std::uint32_t leaf; ///< element
        float weight;       ///< of that ray among the leaf's, less what mirrors and glass took
    };
    std::uint32_t rays = 0; ///< per leaf
    std::vector<Seen> seen;
    std::vector<std::size_t> first_seen; ///< per leaf, into `seen`; one more at the end
    /// Share of the light that the leaf sends out which ends on leaves, in [0, 1]: the rest leaves the scene, or meets sides
    /// that are no part of the hierarchy. Exactly 1 where no ray of the bundle does. Its standard error is at most about
    /// 0.2 / sqrt(rays), and its mean over many leaves is right.
    std::vector<float> share;
    std::vector<float> opacity; ///< share of the light from all round that goes on neither straight nor over a mirror
    std::vector<float> sky;     ///< share of the rays that end in the sky over a mirror or through a lens
    std::vector<float> open;    ///< share of the leaf's area that is not covered; never quite 0
};

/// Shoots a bundle of rays from every leaf, on over mirrors and through glass. `leaves` are the hierarchy's leaves, all of
/// them.
LeafSurroundings look_around(const Hierarchy& hierarchy, const RayScene& rays, const std::vector<std::uint32_t>& leaves,
                             const LookSettings& settings, const RunContext& context);

/// Writes Hierarchy::room: leaves that see each other, directly or over others, are one room. Of a great many rooms only the
/// largest few dozen by area have numbers.
void mark_rooms(Hierarchy& hierarchy, const std::vector<std::uint32_t>& leaves, const LeafSurroundings& around);

} // namespace atrium
