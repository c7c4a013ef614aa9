#include "engine/particles/particle_map.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kGrain = 512;

struct Traced {
    std::vector<Landing> landings;
    ParticleEnergy energy;
};

// Particles [0, count) of every link, in chunks that do not depend on threads.
std::vector<Traced> trace(const RayScene& rays, const SpecularTargets& targets, const Hierarchy& emitters,
                          const std::vector<ParticleSource>& sources, const std::vector<ParticleLink>& links,
                          const CarriedByImage& by_image, const RunContext& context) {
    std::vector<std::size_t> first(links.size() + 1, 0);
    for (std::size_t i = 0; i < links.size(); ++i) {
        first[i + 1] = first[i] + links[i].count;
    }
    std::vector<ParticleStream> streams(links.size());
    for (std::uint32_t i = 0; i < links.size(); ++i) {
        const ParticleLink& l = links[i];
        streams[i] = {
            &sources[l.source], l.target, i, l.key, l.count, make_aim(sources[l.source], targets.targets()[l.target])};
    }
    std::vector<Traced> out(chunk_count(first.back(), kGrain));
    parallel_chunks(first.back(), kGrain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        auto link = std::size_t(std::upper_bound(first.begin(), first.end(), begin) - first.begin()) - 1;
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            while (i >= first[link + 1]) {
                ++link;
            }
            trace_particle(rays, targets, emitters, streams[link], std::uint32_t(i - first[link]), by_image,
                           out[chunk].landings, out[chunk].energy);
        }
    });
    return out;
}

} // namespace

ParticleMap::ParticleMap(const RayScene& rays, const SpecularTargets& targets, const DirectLight& direct,
                         const Hierarchy& emitters, const CarriedByImage& by_image, const ParticleSettings& settings,
                         const RunContext& context) {
    if (targets.empty()) {
        complete_ = true;
        return;
    }
    sources_ = particle_sources(direct, emitters, rays);
    // A few particles of every pair tell what it is worth.
    const std::size_t pairs = sources_.size() * targets.targets().size();
    const auto pilot = std::uint32_t(
        std::clamp<std::size_t>(4 * std::size_t(settings.particles) / std::max<std::size_t>(pairs, 1), 16, settings.pilot));
    for (std::uint32_t s = 0; s < sources_.size(); ++s) {
        for (std::uint32_t t = 0; t < targets.targets().size(); ++t) {
            const SpecularTarget& target = targets.targets()[t];
            ParticleLink link;
            link.source = s;
            link.target = t;
            link.key =
                hash_combine(hash_combine(sources_[s].key, hash_combine(target.surface, target.piece)), settings.seed);
            link.count = pilot;
            links_.push_back(link);
        }
    }
    for (const Traced& part : trace(rays, targets, emitters, sources_, links_, by_image, context)) {
        for (const Landing& landing : part.landings) {
            links_[landing.link].landed += luminance(power(landing));
        }
    }
    if (context.should_stop()) {
        return;
    }
    std::erase_if(links_, [](const ParticleLink& l) { return !(l.landed > 0.0); });
    double all = 0.0;
    for (const ParticleLink& l : links_) {
        all += l.landed;
    }
    for (ParticleLink& l : links_) {
        l.count = std::max(pilot, std::uint32_t(std::lround(settings.particles * (l.landed / all))));
        emitted_ += l.count;
    }
    std::vector<Traced> parts = trace(rays, targets, emitters, sources_, links_, by_image, context);
    if (context.should_stop()) {
        return;
    }
    std::size_t count = 0;
    for (const Traced& part : parts) {
        count += part.landings.size();
    }
    landings_.reserve(count);
    for (Traced& part : parts) {
        landings_.insert(landings_.end(), part.landings.begin(), part.landings.end());
        part.landings = {};
        energy_ += part.energy;
    }
    for (std::size_t i = 0; i < landings_.size(); ++i) {
        ParticleLink& l = links_[landings_[i].link];
        l.first = l.landings == 0 ? i : l.first;
        ++l.landings;
    }
    complete_ = true;
}

std::size_t ParticleMap::memory_bytes() const {
    std::size_t bytes = landings_.capacity() * sizeof(Landing) + links_.capacity() * sizeof(ParticleLink);
    for (const ParticleSource& s : sources_) {
        bytes += s.leaves.capacity() * (sizeof(std::uint32_t) + sizeof(double));
    }
    return bytes;
}

} // namespace atrium
