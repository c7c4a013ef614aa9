#include "engine/particles/particle_map.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kWatched = 16; // one particle in so many, at most, belongs to links that light nothing

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
    const ParticleScene scene{rays, targets, direct, emitters, by_image};
    prepare_links(links_, sources_, targets);
    for (const ParticleBatch& part : trace_batches(scene, sources_, links_, nullptr, false, context)) {
        for (const Landing& landing : part.landings) {
            links_[landing.link].landed += luminance(power(landing));
        }
    }
    if (context.should_stop()) {
        return;
    }
    share_out(settings, pilot);
    prepare_links(links_, sources_, targets);
    std::vector<ParticleBatch> batches = trace_batches(scene, sources_, links_, nullptr, settings.keep_paths, context);
    if (context.should_stop()) {
        return;
    }
    if (settings.keep_paths) {
        paths_.emplace();
        with_octree_ = settings.passage_octree;
    }
    store(std::move(batches));
    complete_ = true;
}

void ParticleMap::share_out(const ParticleSettings& settings, std::uint32_t pilot) {
    const auto lit = [](const ParticleLink& l) { return l.landed > 0.0; };
    const auto dark = std::stable_partition(links_.begin(), links_.end(), lit);
    const auto dark_links = std::size_t(links_.end() - dark);
    // A few of those that light nothing are kept under watch: an object may come into their way, or go out of it.
    const std::size_t watched = settings.keep_paths && dark_links > 0 ? settings.particles / (kWatched * dark_links) : 0;
    if (watched == 0) {
        links_.erase(dark, links_.end());
    }
    double all = 0.0;
    for (const ParticleLink& l : links_) {
        all += l.landed;
    }
    for (ParticleLink& l : links_) {
        l.count = lit(l) ? std::max(pilot, std::uint32_t(std::lround(settings.particles * (l.landed / all))))
                         : std::uint32_t(std::min<std::size_t>(watched, pilot));
        emitted_ += l.count;
    }
}

void ParticleMap::store(std::vector<ParticleBatch>&& batches) {
    std::size_t count = 0, vertices = 0;
    for (const ParticleBatch& b : batches) {
        count += b.landings.size();
        vertices += b.vertices.size();
    }
    landings_.clear();
    landings_.reserve(count);
    energy_ = {};
    shares_.clear();
    octree_.reset();
    if (paths_) {
        paths_->reset(emitted_, vertices);
        shares_.reserve(emitted_);
    }
    std::size_t particle = 0;
    for (ParticleBatch& b : batches) {
        take(b, particle);
    }
    count_landings();
    if (paths_) {
        sum_energy();
    }
}

void ParticleMap::take(ParticleBatch& b, std::size_t& particle) {
    landings_.insert(landings_.end(), b.landings.begin(), b.landings.end());
    energy_ += b.energy;
    shares_.insert(shares_.end(), b.shares.begin(), b.shares.end());
    std::size_t at = 0;
    for (const std::uint32_t n : b.vertex_count) {
        paths_->set(particle++, std::span(b.vertices).subspan(at, n));
        at += n;
    }
    b = {};
}

void ParticleMap::count_landings() {
    for (ParticleLink& l : links_) {
        l.landings = 0;
    }
    for (const Landing& l : landings_) {
        ++links_[l.link].landings;
    }
    std::size_t first = 0;
    for (ParticleLink& l : links_) {
        l.first = first;
        first += l.landings;
    }
}

void ParticleMap::sum_energy() {
    std::vector<ParticleEnergy> parts(links_.size());
    parallel_chunks(links_.size(), 16, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t l = begin; l < end; ++l) {
            const ParticleLink& link = links_[l];
            if (!(link.landed > 0.0) && link.landings == 0) {
                continue; // only watched: a map without paths does not know of it
            }
            for (std::size_t i = link.first_particle; i < link.first_particle + link.count; ++i) {
                const ParticleShares& s = shares_[i];
                parts[l] += {s[0], s[1], s[2], s[3], s[4], s[5]};
            }
        }
    });
    energy_ = {};
    for (const ParticleEnergy& part : parts) {
        energy_ += part;
    }
}

std::size_t ParticleMap::memory_bytes() const {
    std::size_t bytes = landings_.capacity() * sizeof(Landing) + links_.capacity() * sizeof(ParticleLink);
    bytes += matt_of_leaf_.capacity() * sizeof(std::uint32_t) + matt_links_.capacity();
    bytes += shares_.capacity() * sizeof(ParticleShares) + (paths_ ? paths_->memory_bytes() : 0) +
             (octree_ ? octree_->memory_bytes() : 0);
    for (const ParticleSource& s : sources_) {
        bytes += s.leaves.capacity() * (sizeof(std::uint32_t) + sizeof(double));
        bytes += 2 * s.radiosity.capacity() * sizeof(Rgb);
    }
    return bytes;
}

} // namespace atrium
