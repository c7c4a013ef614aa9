// All particles of a scene: links from sources to specular targets, how many particles each is worth, and where they landed.
#pragma once

#include "engine/particles/particle_batch.h"
#include "engine/particles/passage_octree.h"

#include <optional>
#include <span>
#include <vector>

namespace atrium {

struct ParticleSettings {
    std::uint32_t particles = 250'000; ///< emitted at most, all links together
    std::uint32_t pilot = 256;         ///< of every link: what it is worth
    std::uint32_t seed = 1;
    bool keep_paths = false;     ///< for ParticleMap::update(); about 90 bytes a particle
    bool passage_octree = false; ///< touched particles are found by the paper's octree instead of a scan
};

/// See ParticleMap::add_matt().
struct MattSettings {
    std::span<const std::uint8_t> flags; ///< per element of the hierarchy; only leaves count
    std::uint32_t particles = 250'000;   ///< emitted at most, but for the pilot's
    std::uint32_t seed = 1;
};

/// Irradiance by particles of matt sources, lux per element; empty where there are none.
struct MattLight {
    std::vector<Rgb> first; ///< by the radiosities that the sources had at first
    std::vector<Rgb> now;
};

/// What ParticleMap::update() did.
struct ParticleUpdate {
    bool complete = false;       ///< false: stopped, or `fits` is false; the map is as it was
    bool fits = true;            ///< false: the sources are others than those of the links, which only a new map can know
    std::uint64_t particles = 0; ///< traced again
    double share = 0.0;          ///< of all
    std::uint64_t landings = 0;  ///< taken away, put in or replaced by others
    std::uint32_t lit = 0;       ///< links that lit nothing before and do now: a new map would give them more particles
    std::uint32_t links = 0;     ///< with particles that were traced again
    std::uint32_t re_aimed = 0;  ///< of these: traced again as a whole, since their source or target moved
    std::vector<std::uint32_t> surfaces; ///< that moved, or whose landings or their power are others now, ascending
    double find_seconds = 0.0;           ///< for what is touched
    double trace_seconds = 0.0;
    double store_seconds = 0.0;
};

/// The same for any number of threads. Changed by update() and retrace() only.
class ParticleMap {
public:
    /// Traces everything, on all cores; the same for any number of them. `by_image`: see trace_particle(). Where no source
    /// reaches a target nothing is stored. Stopped by the context: complete() is false.
    ParticleMap(const RayScene& rays, const SpecularTargets& targets, const DirectLight& direct, const Hierarchy& emitters,
                const CarriedByImage& by_image, const ParticleSettings& settings, const RunContext& context);

    /// Traces again what the change of `boxes` (bounds of what moved before and after, engine coordinates) touches: the
    /// scene has everything in its new place already, its targets have followed (SpecularTargets::follow), and `moved` are
    /// the surfaces that moved. Links keep their counts; those whose source or target moved are aimed anew and traced as a
    /// whole. Landings are then what retrace() would find, to the last bit. Needs ParticleSettings::keep_paths. When stopped
    /// by the context the map stays as it was.
    ParticleUpdate update(const ParticleScene& scene, std::span<const Box3> boxes, std::span<const std::uint32_t> moved,
                          const RunContext& context);
    /// Adds particles of matt surfaces (D->S links): from the leaves of `scene.matt` that `settings.flags` marks towards
    /// what mirrors or bends, where a pilot finds that the light over one link stands out on what it lands on. To be called
    /// once, on a complete map, by a solved hierarchy. False when stopped: the map is as it was. Nothing happens where no
    /// such link is worth it.
    bool add_matt(const ParticleScene& scene, const MattSettings& settings, const RunContext& context);
    /// True where the map has the light that the leaf of a matt surface sends to a target: whoever follows light back over
    /// that target to the leaf is to leave it out.
    [[nodiscard]] bool carries(std::uint32_t leaf, std::uint32_t target) const {
        return leaf < matt_of_leaf_.size() && matt_of_leaf_[leaf] != kNoSource && target < targets_ &&
               matt_links_[std::size_t(matt_of_leaf_[leaf]) * targets_ + target] != 0;
    }
    [[nodiscard]] std::vector<std::uint32_t> matt_leaves() const; ///< of all matt sources
    [[nodiscard]] bool any_matt() const { return !matt_of_leaf_.empty(); }
    /// Takes over the radiosities of matt sources from the hierarchy that they are leaves of; the first ones where a source
    /// differs by no more than `tolerance`, relative. Nothing is traced. Returns the surfaces with landings of another power
    /// than before, ascending.
    std::vector<std::uint32_t> take_radiosity(const Hierarchy& matt, double tolerance);
    /// What particles of matt sources bring to the leaves of a hierarchy that follow their present ways.
    [[nodiscard]] MattLight matt_light(const Hierarchy& receivers) const;
    /// A link from a matt surface.
    [[nodiscard]] bool matt(const ParticleLink& link) const { return sources_[link.source].matt(); }
    /// Takes over other intensities and colours of the lamps of `direct`, which are as many and where they were, and
    /// multiplies what emitters sent when they were traced by `emitted` (per surface of the ray scene). Nothing is traced.
    /// Returns the surfaces with landings of another power than before, ascending.
    std::vector<std::uint32_t> relight(const DirectLight& direct, std::span<const Rgb> emitted);
    /// Makes what relight() did to emitters part of the landings, so that update() can go on from there: `scene` has its
    /// emitters in their new brightness.
    void settle_emission(const ParticleScene& scene);
    /// Traces all particles of the same links anew: what update() is measured against. False where update() would not fit or
    /// the context stopped; the map is then as it was.
    bool retrace(const ParticleScene& scene, const RunContext& context);

    [[nodiscard]] bool complete() const { return complete_; }
    [[nodiscard]] bool keeps_paths() const { return paths_.has_value(); }
    [[nodiscard]] const ParticlePaths& paths() const { return *paths_; } ///< of all particles, link by link
    [[nodiscard]] const std::optional<PassageOctree>& octree() const { return octree_; }
    [[nodiscard]] const std::vector<ParticleSource>& sources() const { return sources_; }
    [[nodiscard]] const std::vector<ParticleLink>& links() const {
        return links_;
    } ///< such as light something; with paths also others, last
    [[nodiscard]] const std::vector<Landing>& landings() const { return landings_; } ///< link by link, in stream order
    [[nodiscard]] std::uint64_t emitted() const { return emitted_; }                 ///< particles, the pilot's aside
    [[nodiscard]] const ParticleEnergy& energy() const { return energy_; }
    /// Power of a landing, lumen.
    [[nodiscard]] Rgb power(const Landing& landing) const {
        return landing.throughput * sources_[links_[landing.link].source].brightness(landing.leaf);
    }
    [[nodiscard]] std::size_t memory_bytes() const;

private:
    struct Change; // see particle_update.cpp
    // Links whose particles start or are aimed otherwise now, as marks.
    [[nodiscard]] std::vector<std::uint8_t> re_aimed(const ParticleScene& scene, const std::vector<ParticleSource>& sources,
                                                     std::span<const std::uint32_t> moved) const;
    [[nodiscard]] std::vector<std::uint32_t> touched(std::span<const Box3> boxes, float reach,
                                                     const std::vector<std::uint8_t>& whole);
    [[nodiscard]] std::vector<Change> compare(const std::vector<std::uint32_t>& particles,
                                              const std::vector<ParticleBatch>& batches) const;
    [[nodiscard]] std::vector<std::uint32_t> changed_surfaces(const ParticleScene& scene,
                                                              const std::vector<ParticleSource>& sources,
                                                              std::span<const std::uint32_t> moved,
                                                              const std::vector<Change>& changes) const;
    void replace(const std::vector<Change>& changes);
    void keep_paths(const std::vector<std::uint32_t>& particles, const std::vector<ParticleBatch>& batches);
    [[nodiscard]] std::vector<ParticleSource> sources_of(const ParticleScene& scene) const;
    void share_out(const ParticleSettings& settings, std::uint32_t pilot);
    void append(std::vector<ParticleSource>&& sources, std::vector<ParticleLink>&& links,
                std::vector<ParticleBatch>&& batches);
    void store(std::vector<ParticleBatch>&& batches);
    /// Moves what a batch holds behind what is there; `particle`: the first of its ways, then the next batch's.
    void take(ParticleBatch& b, std::size_t& particle);
    void count_landings();
    void sum_energy();

    bool complete_ = false;
    std::vector<ParticleSource> sources_;
    std::vector<ParticleLink> links_;
    std::vector<Landing> landings_;
    std::uint64_t emitted_ = 0;
    ParticleEnergy energy_;
    std::optional<ParticlePaths> paths_;
    bool with_octree_ = false;
    std::optional<PassageOctree> octree_; ///< once something moved
    static constexpr std::uint32_t kNoSource = 0xFFFFFFFFU;
    std::vector<std::uint32_t> matt_of_leaf_; ///< per element: its source, or kNoSource; empty without matt sources
    std::vector<std::uint8_t> matt_links_;    ///< not 0: there is such a link; by source and target
    std::size_t targets_ = 0;
    std::vector<ParticleShares> shares_; ///< with paths: of every particle, so that their sum does not depend on the past
};

} // namespace atrium
