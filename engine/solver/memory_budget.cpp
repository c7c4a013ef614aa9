#include "engine/solver/memory_budget.h"

#include "engine/layers/light_cells.h"

#include <algorithm>
#include <atomic>
#include <unistd.h>

namespace atrium {
namespace {

std::atomic<std::size_t> wanted = 0; // 0: half of the machine's

// What one of each takes while a solution is made and kept for updates, bytes: rounded up from what vectors were seen to
// hold.
constexpr std::size_t kPerTriangle = 400; // ray scene with Embree's boxes, hierarchy, charts
constexpr std::size_t kPerLink = 4 * sizeof(Link);
constexpr std::size_t kPerTexel = 3 * sizeof(LightNode);
constexpr std::size_t kPerVertex = 700;
constexpr std::size_t kPerParticle = 1000;

std::size_t most(std::size_t bytes, double share, std::size_t each, std::size_t least) {
    return std::max(std::size_t(share * double(bytes) / double(each)), least);
}

} // namespace

void set_memory_budget(std::size_t bytes) { wanted = bytes; }

std::size_t memory_budget() {
    if (const std::size_t bytes = wanted; bytes != 0) {
        return bytes;
    }
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    constexpr std::size_t kUnknown = std::size_t(4) << 30U;
    return pages > 0 && page > 0 ? std::size_t(pages) * std::size_t(page) / 2 : kUnknown;
}

void keep_within(QualitySettings& q, std::size_t bytes, std::size_t triangles) {
    const std::size_t rest = bytes - std::min(bytes, triangles * kPerTriangle);
    q.refine.max_links = std::min(q.refine.max_links, most(rest, 0.2, kPerLink, 100'000));
    for (DirectMapSettings* maps : {&q.maps, &q.first_maps}) {
        maps->max_samples = std::min(maps->max_samples, most(rest, 0.4, kPerTexel, 200'000));
    }
    for (LayerSettings* layers : {&q.layers, &q.first_layers}) {
        layers->max_vertices = std::min(layers->max_vertices, most(rest, 0.2, kPerVertex, 20'000));
    }
    q.particles = std::uint32_t(std::min<std::size_t>(q.particles, most(rest, 0.15, kPerParticle, 20'000)));
    q.caustics.most_texels =
        std::uint32_t(std::min<std::size_t>(q.caustics.most_texels, most(rest, 0.05, sizeof(Rgb), 1U << 16U)));
}

} // namespace atrium
