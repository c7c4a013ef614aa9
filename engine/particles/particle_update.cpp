// ParticleMap: what an edit touches is traced again, the rest stays.
#include "engine/base/checks.h"
#include "engine/base/parallel.h"
#include "engine/particles/area_sources.h"
#include "engine/particles/particle_map.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace atrium {
namespace {

double seconds_since(std::chrono::steady_clock::time_point& start) {
    const auto now = std::chrono::steady_clock::now();
    const double out = std::chrono::duration<double>(now - start).count();
    start = now;
    return out;
}

// Links belong to what sends and what is aimed at: there must be as many sources as before, of the same names.
bool same_sources(const std::vector<ParticleSource>& a, const std::vector<ParticleSource>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const ParticleSource& x, const ParticleSource& y) { return x.key == y.key; });
}

bool contains(std::span<const std::uint32_t> list, std::uint32_t value) {
    return std::find(list.begin(), list.end(), value) != list.end();
}

void mark(std::span<const Landing> landings, std::vector<std::uint8_t>& surfaces) {
    for (const Landing& l : landings) {
        surfaces[l.surface] = 1;
    }
}

std::vector<std::uint32_t> marked(const std::vector<std::uint8_t>& marks) {
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < marks.size(); ++i) {
        if (marks[i] != 0) {
            out.push_back(i);
        }
    }
    return out;
}

} // namespace

// Sources as they are now: those of the scene, and behind them the matt ones that were found by add_matt().
std::vector<ParticleSource> ParticleMap::sources_of(const ParticleScene& scene) const {
    std::vector<ParticleSource> out;
    if (scene.targets.empty()) {
        return out;
    }
    out = particle_sources(scene.direct, scene.emitters, scene.rays);
    for (const ParticleSource& source : sources_) {
        if (source.matt() && scene.matt != nullptr) {
            out.push_back(followed(source, *scene.matt, scene.rays));
        }
    }
    return out;
}

/// A run [first, first + count) of the landings that others take the place of.
struct ParticleMap::Change {
    std::size_t first = 0;
    std::size_t count = 0;
    std::span<const Landing> now;
};

std::vector<std::uint8_t> ParticleMap::re_aimed(const ParticleScene& scene, const std::vector<ParticleSource>& sources,
                                                std::span<const std::uint32_t> moved) const {
    std::vector<std::uint8_t> out(links_.size(), 0);
    for (std::size_t i = 0; i < links_.size(); ++i) {
        const ParticleLink& l = links_[i];
        const SpecularTarget& target = scene.targets.targets()[l.target];
        const ParticleSource& source = sources[l.source];
        const bool same = target.bounds.min == l.aimed_at.min && target.bounds.max == l.aimed_at.max &&
                          sends_alike(sources_[l.source], source) && !contains(moved, target.surface) &&
                          (source.leaves.empty() || !contains(moved, source.surface));
        out[i] = same ? 0 : 1;
    }
    return out;
}

std::vector<std::uint32_t> ParticleMap::touched(std::span<const Box3> boxes, float reach,
                                                const std::vector<std::uint8_t>& whole) {
    std::vector<std::uint8_t> marks(shares_.size(), 0);
    const std::vector<Box3> wide = ParticlePaths::widened(boxes, reach);
    if (with_octree_ && (!octree_ || octree_->reach() != reach)) {
        octree_.emplace(reach);
    }
    if (octree_) {
        octree_->mark_crossing(*paths_, wide, marks);
    } else {
        paths_->mark_crossing(wide, marks);
    }
    for (std::size_t i = 0; i < links_.size(); ++i) {
        if (whole[i] != 0) {
            std::fill_n(marks.begin() + std::ptrdiff_t(links_[i].first_particle), links_[i].count, std::uint8_t(1));
        }
    }
    return marked(marks);
}

// What is other than before: particles that were touched for nothing leave no change.
std::vector<ParticleMap::Change> ParticleMap::compare(const std::vector<std::uint32_t>& particles,
                                                      const std::vector<ParticleBatch>& batches) const {
    std::vector<std::size_t> first(batches.size() + 1, 0); // among the particles
    for (std::size_t b = 0; b < batches.size(); ++b) {
        first[b + 1] = first[b] + batches[b].landing_count.size();
    }
    std::vector<std::vector<Change>> parts(batches.size());
    parallel_chunks(batches.size(), 1, [&](std::size_t b, std::size_t, std::size_t) {
        std::size_t link = 0, at = 0, from = 0;
        for (std::size_t k = first[b]; k < first[b + 1]; ++k) {
            while (particles[k] >= links_[link].first_particle + links_[link].count) {
                ++link;
            }
            const auto index = std::uint32_t(particles[k] - links_[link].first_particle);
            const auto before = [&](const Landing& l) { return l.link != link ? l.link < link : l.index < index; };
            std::size_t step = 1; // what comes next is near, but for the first of a batch
            while (at + step < landings_.size() && before(landings_[at + step])) {
                at += step;
                step *= 2;
            }
            const auto low = landings_.begin() + std::ptrdiff_t(at);
            at = std::size_t(
                std::partition_point(low, low + std::ptrdiff_t(std::min(step + 1, landings_.size() - at)), before) -
                landings_.begin());
            const std::uint32_t count = batches[b].landing_count[k - first[b]];
            Change c{at, 0, std::span(batches[b].landings).subspan(from, count)};
            while (at < landings_.size() && landings_[at].link == link && landings_[at].index == index) {
                ++at;
            }
            c.count = at - c.first;
            if (!std::equal(c.now.begin(), c.now.end(), landings_.begin() + std::ptrdiff_t(c.first),
                            landings_.begin() + std::ptrdiff_t(at))) {
                parts[b].push_back(c);
            }
            from += count;
        }
    });
    std::vector<Change> out;
    for (const std::vector<Change>& part : parts) {
        out.insert(out.end(), part.begin(), part.end());
    }
    return out;
}

// What lies between changes moves to its new place, without a second store: first all that moves to the front, in order,
// then all that moves to the back, from the end.
void ParticleMap::replace(const std::vector<Change>& changes) {
    struct Run {
        std::size_t from, to, count;
    };
    std::vector<Run> runs;
    std::size_t at = 0, to = 0;
    for (const Change& c : changes) {
        runs.push_back({at, to, c.first - at});
        to += c.first - at + c.now.size();
        at = c.first + c.count;
        ParticleLink& link = links_[c.count > 0 ? landings_[c.first].link : c.now.front().link];
        link.landings += c.now.size() - c.count;
    }
    runs.push_back({at, to, landings_.size() - at});
    const std::size_t size = to + runs.back().count;
    if (size > landings_.capacity()) {
        landings_.reserve(size + size / 16);
    }
    landings_.resize(std::max(size, landings_.size()));
    for (const Run& r : runs) {
        if (r.to < r.from) {
            const auto from = landings_.begin() + std::ptrdiff_t(r.from);
            std::copy(from, from + std::ptrdiff_t(r.count), landings_.begin() + std::ptrdiff_t(r.to));
        }
    }
    for (auto r = runs.rbegin(); r != runs.rend(); ++r) {
        if (r->to > r->from) {
            const auto from = landings_.begin() + std::ptrdiff_t(r->from);
            std::copy_backward(from, from + std::ptrdiff_t(r->count), landings_.begin() + std::ptrdiff_t(r->to + r->count));
        }
    }
    for (std::size_t i = 0; i < changes.size(); ++i) {
        std::copy(changes[i].now.begin(), changes[i].now.end(),
                  landings_.begin() + std::ptrdiff_t(runs[i].to + runs[i].count));
    }
    landings_.resize(size);
    std::size_t first = 0;
    for (ParticleLink& l : links_) {
        l.first = first;
        first += l.landings;
    }
}

ParticleUpdate ParticleMap::update(const ParticleScene& scene, std::span<const Box3> boxes,
                                   std::span<const std::uint32_t> moved, const RunContext& context) {
    ATRIUM_CHECK(complete_ && (links_.empty() || paths_));
    ParticleUpdate out;
    auto clock = std::chrono::steady_clock::now();
    std::vector<ParticleSource> sources = sources_of(scene);
    out.fits = same_sources(sources_, sources);
    if (links_.empty() || !out.fits) {
        out.complete = out.fits;
        return out;
    }
    const std::vector<std::uint8_t> whole = re_aimed(scene, sources, moved);
    const std::vector<std::uint32_t> particles = touched(boxes, scene_reach(scene.rays), whole);
    std::vector<ParticleLink> links = links_;
    for (std::size_t i = 0; i < links.size(); ++i) {
        if (whole[i] != 0) {
            links[i].aimed_at = scene.targets.targets()[links[i].target].bounds;
            links[i].aim = make_aim(sources[links[i].source], scene.targets.targets()[links[i].target]);
        }
    }
    out.find_seconds = seconds_since(clock);
    const std::vector<ParticleBatch> batches = trace_batches(scene, sources, links, &particles, true, context);
    out.trace_seconds = seconds_since(clock);
    if (context.should_stop()) {
        return out;
    }
    const std::vector<Change> changes = compare(particles, batches);
    out.surfaces = changed_surfaces(scene, sources, moved, changes);
    std::size_t k = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
        const std::size_t before = k;
        while (k < particles.size() && particles[k] < links[i].first_particle + links[i].count) {
            ++k;
        }
        out.links += k > before ? 1 : 0;
        out.re_aimed += whole[i];
    }
    const std::vector<ParticleLink> before = std::exchange(links_, std::move(links));
    sources_ = std::move(sources);
    replace(changes);
    for (std::size_t i = 0; i < links_.size(); ++i) {
        out.lit += links_[i].landings > 0 && before[i].landings == 0 ? 1 : 0;
    }
    keep_paths(particles, batches);
    for (const Change& c : changes) {
        out.landings += std::max(c.count, c.now.size());
    }
    out.particles = particles.size();
    out.share = shares_.empty() ? 0.0 : double(particles.size()) / double(shares_.size());
    out.complete = true;
    out.store_seconds = seconds_since(clock);
    return out;
}

std::vector<std::uint32_t> ParticleMap::changed_surfaces(const ParticleScene& scene,
                                                         const std::vector<ParticleSource>& sources,
                                                         std::span<const std::uint32_t> moved,
                                                         const std::vector<Change>& changes) const {
    std::vector<std::uint8_t> surfaces(scene.rays.surfaces().size(), 0);
    for (const Change& c : changes) {
        mark(std::span(landings_).subspan(c.first, c.count), surfaces);
        mark(c.now, surfaces);
    }
    for (const ParticleLink& l : links_) { // brightness is no part of a landing
        if (sources[l.source].radiance != sources_[l.source].radiance) {
            mark(std::span(landings_).subspan(l.first, l.landings), surfaces);
        }
    }
    for (const std::uint32_t s : moved) {
        surfaces[s] = 1;
    }
    return marked(surfaces);
}

void ParticleMap::keep_paths(const std::vector<std::uint32_t>& particles, const std::vector<ParticleBatch>& batches) {
    std::size_t k = 0;
    for (const ParticleBatch& b : batches) {
        std::size_t vertex = 0;
        for (std::size_t i = 0; i < b.vertex_count.size(); ++i, ++k) {
            paths_->set(particles[k], std::span(b.vertices).subspan(vertex, b.vertex_count[i]));
            shares_[particles[k]] = b.shares[i];
            vertex += b.vertex_count[i];
        }
    }
    paths_->compact();
    if (octree_) {
        octree_->follow(*paths_, particles);
    }
    sum_energy();
}

std::vector<std::uint32_t> ParticleMap::relight(const DirectLight& direct, std::span<const Rgb> emitted) {
    std::vector<Rgb> before;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        ParticleSource& source = sources_[i];
        before.push_back(source.radiance);
        if (source.leaves.empty()) { // lamps come first, in their order
            source.light = direct.lights()[i];
            source.radiance = source.light.light.color * source.light.light.intensity;
        } else if (!source.matt()) {
            source.radiance = emitted[source.surface];
        }
    }
    std::vector<std::uint8_t> surfaces(emitted.size(), 0);
    for (const ParticleLink& l : links_) {
        if (sources_[l.source].radiance != before[l.source]) {
            mark(std::span(landings_).subspan(l.first, l.landings), surfaces);
        }
    }
    return marked(surfaces);
}

void ParticleMap::settle_emission(const ParticleScene& scene) {
    for (const ParticleLink& l : links_) {
        const ParticleSource& source = sources_[l.source];
        for (std::size_t i = l.first; !source.leaves.empty() && i < l.first + l.landings; ++i) {
            landings_[i].throughput *= source.radiance;
        }
    }
    std::vector<ParticleSource> sources = sources_of(scene);
    if (same_sources(sources_, sources)) { // else update() says so
        sources_ = std::move(sources);
    }
}

bool ParticleMap::retrace(const ParticleScene& scene, const RunContext& context) {
    std::vector<ParticleSource> sources = sources_of(scene);
    if (!complete_ || !same_sources(sources_, sources)) {
        return false;
    }
    std::vector<ParticleLink> links = links_;
    prepare_links(links, sources, scene.targets);
    std::vector<ParticleBatch> batches = trace_batches(scene, sources, links, nullptr, paths_.has_value(), context);
    if (context.should_stop()) {
        return false;
    }
    links_ = std::move(links);
    sources_ = std::move(sources);
    store(std::move(batches));
    return true;
}

} // namespace atrium
