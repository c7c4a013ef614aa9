// Where particles start: points of lamps and emitters, and directions towards a target's bounds.
#pragma once

#include "engine/particles/specular_targets.h"
#include "engine/radiosity/direct_light.h"
#include "engine/radiosity/hierarchy.h"

#include <array>
#include <memory>
#include <vector>

namespace atrium {

/// Where the light of one shining leaf comes from, by a few points of it.
struct LeafShape {
    vec3 at{0.0F};     ///< their mean
    vec3 normal{0.0F}; ///< mean of unit normals: shorter where they differ
    mat3 spread{0.0F}; ///< covariance, square metres
    friend bool operator==(const LeafShape&, const LeafShape&) = default;
};

/// A source of particles: a lamp, the sun, the shining leaves of one surface, or those of a matt one that stand out in the
/// light that falls on them.
struct ParticleSource {
    PlacedLight light;                 ///< where `leaves` is empty
    std::vector<std::uint32_t> leaves; ///< of the tree given to emit(): what shines of an area source
    std::vector<double> power;         ///< of the leaves up to and including each, lumen
    std::vector<LeafShape> shape;      ///< of every one of `leaves`
    vec3 centre{0.0F};                 ///< of an area source's light
    Rgb radiance{1.0F};                ///< lamps: intensity (cd) or normal irradiance (lux); emitters and matt ones: 1
    std::vector<Rgb> radiosity; ///< matt surfaces: of every one of `leaves`, which no throughput holds; empty for others
    std::vector<Rgb> first_radiosity; ///< the same when the particles were first sent
    float sun_radius = 0.0F;          ///< tangent of the angular radius
    bool has_size = false;            ///< false: a point or a parallel beam, which the last two numbers do not matter to
    /// Suns: nothing of the scene lies further from (0,0,0), metres. A power of two: where particles start stays the same to
    /// the last bit while things move about in the scene.
    float reach = 0.0F;
    std::uint32_t surface = Hit::kNone; ///< that an area source's leaves belong to
    std::uint64_t key = 0;              ///< seeds its streams; from what it is, not from where it is stored

    [[nodiscard]] bool matt() const { return !radiosity.empty(); }
    /// What the throughput of particles of a leaf (its place among `leaves`) is to be multiplied by.
    [[nodiscard]] Rgb brightness(std::uint32_t leaf) const { return matt() ? radiance * radiosity[leaf] : radiance; }
};
/// True where both send the same particles: all but their brightness.
bool sends_alike(const ParticleSource& a, const ParticleSource& b);

/// One particle about to leave. A derivative is by one of the numbers that it was made from, over [0,1].
struct Emission {
    vec3 origin{0.0F};
    vec3 direction{0.0F};           ///< unit
    Rgb throughput{0.0F};           ///< times ParticleSource::brightness(), over the number of particles: lumen
    std::uint32_t leaf = 0;         ///< that it leaves, its place among ParticleSource::leaves
    std::array<vec3, 4> d_origin{}; ///< 0, 1: what spreads the particles over the target; 2, 3: the source's own size
    std::array<vec3, 4> d_direction{};
};

/// Distance from (0,0,0) that nothing of a scene lies beyond, a power of two, metres.
float scene_reach(const RayScene& rays);

/// Sources of a scene: lamps and suns of `direct`, and the leaves of `emitters` (may be empty) by surface.
std::vector<ParticleSource> particle_sources(const DirectLight& direct, const Hierarchy& emitters, const RayScene& rays);

/// How a source sees a target's bounds: made once for a pair.
struct ParticleAim {
    vec3 axis{0.0F, 0.0F, 1.0F}; ///< unit, from the source towards the target
    vec3 a{0.0F};                ///< across it, turned so that the bounds look small
    vec3 b{0.0F};
    vec2 low{0.0F}; ///< sun: metres across the axis about the target's centre; lamps: on the plane at distance 1
    vec2 high{0.0F};
    bool window = false; ///< false: from so close that directions are taken from a cone or from all round
    // Area sources, as far as they face the target:
    std::shared_ptr<const std::vector<double>> leaves; ///< weights of the source's leaves up to and including each
    std::array<vec3, 2> extent{}; ///< two axes across the axis, as far as a uniform strip of equal spread reaches
};
ParticleAim make_aim(const ParticleSource& source, const SpecularTarget& target);

/// A particle from four numbers in [0,1): the first two place it over the target's bounds as the source sees them, the
/// others on the source. False where nothing goes that way (behind an emitter, outside a spot's cone).
bool emit(const ParticleSource& source, const SpecularTarget& target, const ParticleAim& aim, const Hierarchy& emitters,
          const RayScene& rays, const vec4& u, Emission& out);

} // namespace atrium
