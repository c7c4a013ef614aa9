#include "engine/particles/particle_batch.h"

#include "engine/base/parallel.h"
#include "engine/particles/particle_paths.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kGrain = 512;

ParticleShares shares_of(const ParticleEnergy& e) {
    return {float(e.emitted), float(e.absorbed), float(e.escaped), float(e.stored), float(e.imaged), float(e.cut)};
}

} // namespace

void prepare_links(std::vector<ParticleLink>& links, const std::vector<ParticleSource>& sources,
                   const SpecularTargets& targets) {
    std::size_t first = 0;
    for (ParticleLink& l : links) {
        l.first_particle = first;
        first += l.count;
        l.aimed_at = targets.targets()[l.target].bounds;
        l.aim = make_aim(sources[l.source], targets.targets()[l.target]);
    }
}

std::vector<ParticleBatch> trace_batches(const ParticleScene& scene, const std::vector<ParticleSource>& sources,
                                         const std::vector<ParticleLink>& links, const std::vector<std::uint32_t>* only,
                                         bool with_paths, const RunContext& context) {
    std::vector<ParticleStream> streams(links.size());
    for (std::uint32_t i = 0; i < links.size(); ++i) {
        const ParticleLink& l = links[i];
        const bool detail = sources[l.source].matt() && scene.detail;
        streams[i] = {&sources[l.source], l.target, i, l.key, l.count, l.aim, detail ? &scene.detail : nullptr};
    }
    const std::size_t all = links.empty() ? 0 : links.back().first_particle + links.back().count;
    const std::size_t count = only != nullptr ? only->size() : all;
    std::vector<ParticleBatch> out(chunk_count(count, kGrain));
    parallel_chunks(count, kGrain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        ParticleBatch& batch = out[chunk];
        std::vector<Ray> rays;
        const std::size_t number = only != nullptr ? (*only)[begin] : begin;
        auto link = std::size_t(std::upper_bound(links.begin(), links.end(), number,
                                                 [](std::size_t n, const ParticleLink& l) { return n < l.first_particle; }) -
                                links.begin()) -
                    1;
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            const std::size_t particle = only != nullptr ? (*only)[i] : i;
            while (particle >= links[link].first_particle + links[link].count) {
                ++link;
            }
            const auto index = std::uint32_t(particle - links[link].first_particle);
            const Hierarchy& leaves = streams[link].source->matt() ? *scene.matt : scene.emitters;
            if (!with_paths) {
                trace_particle(scene.rays, scene.targets, leaves, streams[link], index, scene.by_image, batch.landings,
                               batch.energy);
                continue;
            }
            rays.clear();
            const std::size_t landings = batch.landings.size(), vertices = batch.vertices.size();
            ParticleEnergy energy;
            trace_particle(scene.rays, scene.targets, leaves, streams[link], index, scene.by_image, batch.landings, energy,
                           &rays);
            ParticlePaths::add_vertices(rays, batch.vertices);
            batch.landing_count.push_back(std::uint32_t(batch.landings.size() - landings));
            batch.vertex_count.push_back(std::uint32_t(batch.vertices.size() - vertices));
            batch.shares.push_back(shares_of(energy));
        }
    });
    return out;
}

} // namespace atrium
