// Surfaces that shine as sources of particles: which of their leaves face a target, and how they spread.
#pragma once

#include "engine/particles/emission.h"

namespace atrium {

/// The shining leaves (at least one) of one surface as a source. `matt`: they shine by their radiosity and not by what they
/// emit.
ParticleSource area_source(const Hierarchy& emitters, const RayScene& rays, std::uint32_t surface,
                           std::vector<std::uint32_t> leaves, bool matt);
/// The same source where its surface is now; its leaves keep their order and what they had of the light.
ParticleSource followed(ParticleSource source, const Hierarchy& emitters, const RayScene& rays);

/// Fills in what an aim at a target knows of an area source's leaves. Half of the sides of a lamp's bulb face away from a
/// mirror: leaves send by what the target sees of them. None is left out, for what is told of it are means.
void aim_leaves(const ParticleSource& source, const SpecularTarget& target, ParticleAim& aim);

} // namespace atrium
