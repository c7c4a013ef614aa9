#include "engine/solver/memory_budget.h"

#include "engine/layers/light_cells.h"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>
#include <iterator>
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

// Names of features, in the order of LoweredByMemory's.
constexpr const char* kLowered[] = {"more_links", "finer_light_maps", "more_vertices", "more_particles",
                                    "finer_caustic_textures"};

std::size_t most(std::size_t bytes, double share, std::size_t each, std::size_t least) {
    return std::max(std::size_t(share * double(bytes) / double(each)), least);
}

} // namespace

void set_memory_budget(std::size_t bytes) { wanted = bytes; }

std::size_t default_memory_budget() {
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    constexpr std::size_t kUnknown = std::size_t(4) << 30U;
    return pages > 0 && page > 0 ? std::size_t(pages) * std::size_t(page) / 2 : kUnknown;
}

std::size_t memory_budget() {
    const std::size_t bytes = wanted;
    return bytes != 0 ? bytes : default_memory_budget();
}

LoweredByMemory keep_within(QualitySettings& q, std::size_t bytes, std::size_t triangles) {
    LoweredByMemory lowered;
    const auto lower = [](auto& value, std::size_t limit, bool& less) {
        if (std::size_t(value) > limit) {
            less = true;
            value = std::decay_t<decltype(value)>(limit);
        }
    };
    const std::size_t rest = bytes - std::min(bytes, triangles * kPerTriangle);
    lower(q.refine.max_links, most(rest, 0.2, kPerLink, 100'000), lowered.links);
    for (DirectMapSettings* maps : {&q.first_maps, &q.maps}) {
        lower(maps->max_samples, most(rest, 0.4, kPerTexel, 200'000), lowered.texels);
    }
    for (LayerSettings* layers : {&q.first_layers, &q.layers}) {
        lower(layers->max_vertices, most(rest, 0.2, kPerVertex, 20'000), lowered.vertices);
    }
    // Light that stands out is the sharper one: of particles that do not all fit it has two thirds.
    const std::size_t particles = most(rest, 0.15, kPerParticle, 30'000);
    if (2 * std::size_t(q.particles) > particles) {
        lowered.particles = true;
        q.most_particles = std::uint32_t(particles);
        q.particles = std::uint32_t(std::min<std::size_t>(q.particles, particles / 3 * 2));
    }
    lower(q.caustics.most_texels, most(rest, 0.05, sizeof(Rgb), 1U << 16U), lowered.caustic_texels);
    return lowered;
}

void tell_lowered(std::vector<Feature>& features, const LoweredByMemory& lowered) {
    std::erase_if(features, [](const Feature& f) {
        return std::find(std::begin(kLowered), std::end(kLowered), f.name) != std::end(kLowered);
    });
    const bool is[] = {lowered.links, lowered.texels, lowered.vertices, lowered.particles, lowered.caustic_texels};
    for (std::size_t i = 0; i < std::size(kLowered); ++i) {
        if (is[i]) {
            features.push_back(
                {kLowered[i], false, fmt::format("The light may take {} MiB of memory.", memory_budget() >> 20U)});
        }
    }
}

std::vector<std::string> lowered_by_memory(const std::vector<Feature>& features) {
    std::vector<std::string> out;
    for (const Feature& f : features) {
        if (std::find(std::begin(kLowered), std::end(kLowered), f.name) != std::end(kLowered)) {
            out.push_back(f.name);
        }
    }
    return out;
}

} // namespace atrium
