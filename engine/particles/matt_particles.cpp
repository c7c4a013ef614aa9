// ParticleMap: particles of matt surfaces that stand out in the light that falls on them (diffuse-to-specular links).
#include "engine/base/rng.h"
#include "engine/particles/area_sources.h"
#include "engine/particles/particle_map.h"

#include <algorithm>
#include <limits>
#include <map>

namespace atrium {
namespace {

constexpr double kLeastFlux = 1e-4;     // towards a target, of all light that falls on surfaces: less is not looked at
constexpr std::size_t kMostLinks = 512; // that are looked at, the strongest
constexpr double kLeastEffect = 0.02;   // of a link's light, of all light where it lands
constexpr double kWholeEffect = 0.25;   // from which a link is worth its full share of the particles
constexpr double kLeastLandings = 2000.0;

std::vector<ParticleSource> matt_sources(const ParticleScene& scene, std::span<const std::uint8_t> flags) {
    const Hierarchy& h = *scene.matt;
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_surface;
    for (std::uint32_t i = 0; i < flags.size(); ++i) {
        const Element& e = h.elements[i];
        if (flags[i] != 0 && e.leaf() && double(e.area) * luminance(e.radiosity) > 0.0) {
            by_surface[e.kind == Element::Kind::Patch ? e.surface : h.faces[e.triangle].surface].push_back(i);
        }
    }
    std::vector<ParticleSource> out;
    for (auto& [surface, leaves] : by_surface) {
        out.push_back(area_source(h, scene.rays, surface, std::move(leaves), true));
    }
    return out;
}

// An upper bound, about, of what a source sends towards a target's bounds, lumen.
double flux_towards(const ParticleSource& source, const SpecularTarget& target, const ParticleAim& aim) {
    const double radius = 0.5 * double(target.bounds.diagonal());
    const double away = std::max(double(glm::length(target.bounds.centre() - source.centre)), radius);
    return aim.leaves->back() * radius * radius / (away * away);
}

// Light that falls on surfaces.
struct Received {
    double flux = 0.0; // lumen
    double mean = 0.0; // lux
    explicit Received(const Hierarchy& h) {
        double area = 0.0;
        for (const Element& e : h.elements) {
            flux += e.leaf() ? double(e.area) * light(e) : 0.0;
            area += e.leaf() ? double(e.area) : 0.0;
        }
        mean = area > 0.0 ? flux / area : 0.0;
    }
    static double light(const Element& e) { return luminance(e.direct + e.caustic + e.irradiance); }
};

// Pairs of which anything may be expected, the strongest: their order is that of sources and targets.
std::vector<ParticleLink> likely_links(const ParticleScene& scene, const std::vector<ParticleSource>& sources,
                                       double least_flux, std::uint32_t seed) {
    struct Pair {
        double flux;
        ParticleLink link;
    };
    std::vector<Pair> pairs;
    for (std::uint32_t s = 0; s < sources.size(); ++s) {
        for (std::uint32_t t = 0; t < scene.targets.targets().size(); ++t) {
            const SpecularTarget& target = scene.targets.targets()[t];
            const double flux = flux_towards(sources[s], target, make_aim(sources[s], target));
            if (target.surface != sources[s].surface && flux > least_flux) {
                ParticleLink link;
                link.source = s;
                link.target = t;
                link.key = hash_combine(hash_combine(sources[s].key, hash_combine(target.surface, target.piece)), seed);
                pairs.push_back({flux, link});
            }
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.flux > b.flux; });
    pairs.resize(std::min(pairs.size(), kMostLinks));
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
        return a.link.source != b.link.source ? a.link.source < b.link.source : a.link.target < b.link.target;
    });
    std::vector<ParticleLink> out;
    std::transform(pairs.begin(), pairs.end(), std::back_inserter(out), [](const Pair& p) { return p.link; });
    return out;
}

// How much of all light a link's is where it lands, mean over its light. Landings do not count for themselves: by chance
// alone few of them would stand out on small leaves.
double effect_of(const std::vector<std::pair<std::uint32_t, double>>& landed, const Hierarchy& h, double floor) {
    std::map<std::uint32_t, double> on_leaf;
    for (const auto& [leaf, power] : landed) {
        on_leaf[leaf] += power;
    }
    double sum = 0.0, all = 0.0;
    for (const auto& [leaf, power] : landed) {
        const Element& e = h.elements[leaf];
        sum += power * (on_leaf[leaf] - power) / (double(e.area) * (Received::light(e) + floor));
        all += power;
    }
    return all > 0.0 ? sum / all : 0.0;
}

struct Candidate {
    ParticleLink link;
    double worth;  // share of its particles that it is to have
    double landed; // landings of one particle, mean
};

// Particles by what links bring. Those that would leave too few landings for a smooth image are not worth any, the
// hemisphere does better: the weakest goes until there is none.
std::vector<ParticleLink> share_out_matt(std::vector<Candidate> candidates, std::uint32_t particles) {
    while (!candidates.empty()) {
        double all = 0.0;
        for (const Candidate& c : candidates) {
            all += c.link.landed;
        }
        auto weakest = candidates.begin();
        double fewest = std::numeric_limits<double>::infinity();
        for (auto c = candidates.begin(); c != candidates.end(); ++c) {
            c->link.count = std::uint32_t(std::lround(particles * c->worth * c->link.landed / all));
            if (const double landings = c->link.count * c->landed; landings < fewest) {
                fewest = landings;
                weakest = c;
            }
        }
        if (fewest >= kLeastLandings) {
            break;
        }
        candidates.erase(weakest);
    }
    std::vector<ParticleLink> out;
    std::transform(candidates.begin(), candidates.end(), std::back_inserter(out), [](const Candidate& c) { return c.link; });
    return out;
}

} // namespace

bool ParticleMap::add_matt(const ParticleScene& scene, const MattSettings& settings, const RunContext& context) {
    const Hierarchy& h = *scene.matt;
    if (scene.targets.empty() || h.empty()) {
        return true;
    }
    const Received received(h);
    std::vector<ParticleSource> sources = matt_sources(scene, settings.flags);
    std::vector<ParticleLink> links = likely_links(scene, sources, kLeastFlux * received.flux, settings.seed);
    if (links.empty()) {
        return true;
    }
    constexpr std::uint32_t kPilot = 256;
    for (ParticleLink& l : links) {
        l.count = std::min(kPilot, std::max(settings.particles / 16, 16U));
    }
    prepare_links(links, sources, scene.targets);
    std::vector<std::vector<std::pair<std::uint32_t, double>>> landed(links.size());
    for (const ParticleBatch& part : trace_batches(scene, sources, links, nullptr, false, context)) {
        for (const Landing& l : part.landings) {
            const double power = luminance(l.throughput * sources[links[l.link].source].brightness(l.leaf));
            const std::uint32_t leaf = h.leaf_at(l.surface, l.triangle, l.back, l.barycentric);
            links[l.link].landed += power;
            if (leaf != Element::kNone) {
                landed[l.link].emplace_back(leaf, power);
            }
        }
    }
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < links.size(); ++i) {
        const double effect = effect_of(landed[i], h, 0.05 * received.mean);
        const double worth = std::min(effect / kWholeEffect, 1.0);
        if (effect >= kLeastEffect) {
            candidates.push_back({links[i], worth * worth, double(landed[i].size()) / links[i].count});
        }
    }
    std::vector<ParticleLink> kept = share_out_matt(std::move(candidates), settings.particles);
    if (context.should_stop() || kept.empty()) {
        return !context.should_stop();
    }
    // Sources without a link are of no use.
    std::vector<std::uint32_t> place(sources.size(), kNoSource);
    std::vector<ParticleSource> used;
    for (ParticleLink& l : kept) {
        if (place[l.source] == kNoSource) {
            place[l.source] = std::uint32_t(used.size());
            used.push_back(std::move(sources[l.source]));
        }
        l.source = place[l.source];
    }
    prepare_links(kept, used, scene.targets);
    std::vector<ParticleBatch> batches = trace_batches(scene, used, kept, nullptr, keeps_paths(), context);
    if (context.should_stop()) {
        return false;
    }
    targets_ = scene.targets.targets().size();
    matt_of_leaf_.assign(h.elements.size(), kNoSource);
    append(std::move(used), std::move(kept), std::move(batches));
    matt_links_.assign(sources_.size() * targets_, 0);
    for (const ParticleLink& l : links_) {
        if (matt(l)) {
            matt_links_[std::size_t(l.source) * targets_ + l.target] = 1;
            for (const std::uint32_t leaf : sources_[l.source].leaves) {
                matt_of_leaf_[leaf] = l.source;
            }
        }
    }
    return true;
}

std::vector<std::uint32_t> ParticleMap::matt_leaves() const {
    std::vector<std::uint32_t> out;
    for (const ParticleSource& source : sources_) {
        if (source.matt()) {
            out.insert(out.end(), source.leaves.begin(), source.leaves.end());
        }
    }
    return out;
}

void ParticleMap::append(std::vector<ParticleSource>&& sources, std::vector<ParticleLink>&& links,
                         std::vector<ParticleBatch>&& batches) {
    const auto first_source = std::uint32_t(sources_.size());
    const auto first_link = std::uint32_t(links_.size());
    std::size_t particle = emitted_;
    std::move(sources.begin(), sources.end(), std::back_inserter(sources_));
    for (ParticleLink& l : links) {
        l.source += first_source;
        l.first_particle += particle;
        emitted_ += l.count;
        links_.push_back(std::move(l));
    }
    if (paths_) {
        paths_->add(emitted_ - particle);
    }
    for (ParticleBatch& b : batches) {
        for (Landing& l : b.landings) {
            l.link += first_link;
        }
        take(b, particle);
    }
    count_landings();
    if (paths_) {
        sum_energy();
    }
}

std::vector<std::uint32_t> ParticleMap::take_radiosity(const Hierarchy& matt_leaves, double tolerance) {
    std::vector<std::uint8_t> changed(sources_.size(), 0);
    for (std::size_t s = 0; s < sources_.size(); ++s) {
        ParticleSource& source = sources_[s];
        if (!source.matt()) {
            continue;
        }
        std::vector<Rgb> now;
        double difference = 0.0, size = 0.0;
        for (std::size_t i = 0; i < source.leaves.size(); ++i) {
            const Element& e = matt_leaves.elements[source.leaves[i]];
            now.push_back(e.radiosity);
            difference += double(e.area) * luminance(glm::abs(e.radiosity - source.first_radiosity[i]));
            size += double(e.area) * luminance(source.first_radiosity[i]);
        }
        if (difference <= tolerance * size) {
            now = source.first_radiosity;
        }
        changed[s] = now != source.radiosity ? 1 : 0;
        source.radiosity = std::move(now);
    }
    std::vector<std::uint32_t> surfaces;
    for (const ParticleLink& l : links_) {
        for (std::size_t i = l.first; changed[l.source] != 0 && i < l.first + l.landings; ++i) {
            surfaces.push_back(landings_[i].surface);
        }
    }
    std::sort(surfaces.begin(), surfaces.end());
    surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
    return surfaces;
}

MattLight ParticleMap::matt_light(const Hierarchy& receivers) const {
    MattLight out;
    for (const ParticleLink& l : links_) {
        const ParticleSource& source = sources_[l.source];
        if (!source.matt()) {
            continue;
        }
        out.first.resize(receivers.elements.size(), Rgb(0.0F));
        out.now.resize(receivers.elements.size(), Rgb(0.0F));
        for (std::size_t i = l.first; i < l.first + l.landings; ++i) {
            const Landing& landing = landings_[i];
            const std::uint32_t leaf =
                receivers.leaf_at(landing.surface, landing.triangle, landing.back, landing.barycentric);
            if (leaf != Element::kNone) {
                const Rgb per_radiosity = landing.throughput / receivers.elements[leaf].area;
                out.first[leaf] += per_radiosity * source.first_radiosity[landing.leaf];
                out.now[leaf] += per_radiosity * source.radiosity[landing.leaf];
            }
        }
    }
    return out;
}

} // namespace atrium
