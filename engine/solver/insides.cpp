#include "engine/solver/insides.h"

#include "engine/particles/emission.h"

#include <algorithm>

namespace atrium {
namespace {

/// Every n-th landing of each surface, so that they stay spread as the streams spread them.
std::vector<std::size_t> sample_landings(const ParticleMap& particles, const SpecularTargets& targets,
                                         std::size_t surfaces) {
    std::vector<std::size_t> landed(surfaces, 0);
    std::vector<std::size_t> aimed(surfaces, 0);
    const auto target = [&](const Landing& l) { return targets.targets()[particles.links()[l.link].target].surface; };
    for (const Landing& l : particles.landings()) {
        ++landed[l.surface];
        ++aimed[target(l)];
    }
    const auto stride = [](std::size_t count) {
        return std::max<std::size_t>(1, (count + Insides::kWays - 1) / Insides::kWays);
    };
    std::vector<std::size_t> landed_so_far(surfaces, 0);
    std::vector<std::size_t> aimed_so_far(surfaces, 0);
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < particles.landings().size(); ++i) {
        const Landing& l = particles.landings()[i];
        const std::uint32_t from = target(l);
        const bool by_landing = landed_so_far[l.surface]++ % stride(landed[l.surface]) == 0;
        const bool by_target = aimed_so_far[from]++ % stride(aimed[from]) == 0;
        if (by_landing || by_target) {
            out.push_back(i);
        }
    }
    return out;
}

} // namespace

std::shared_ptr<const Insides> make_insides(const RayScene& rays, const Hierarchy& hierarchy,
                                            std::shared_ptr<const LeafExchange> exchange, const ParticleMap* particles,
                                            const SpecularTargets* targets) {
    auto out = std::make_shared<Insides>();
    out->origin = rays.origin();
    out->surfaces = rays.surfaces();
    out->hierarchy = hierarchy;
    out->exchange = std::move(exchange);
    if (particles == nullptr || targets == nullptr || !particles->keeps_paths()) {
        return out;
    }
    out->particles = particles->emitted();
    out->paths = std::make_shared<const ParticlePaths>(particles->paths());
    out->reach = scene_reach(rays);
    out->passage_cells = particles->octree() ? particles->octree()->cells() : 0;
    for (const std::size_t i : sample_landings(*particles, *targets, rays.surfaces().size())) {
        const Landing& l = particles->landings()[i];
        const ParticleLink& link = particles->links()[l.link];
        ParticleWay way;
        way.points = particles->paths().path(link.first_particle + l.index);
        way.landed_on = l.surface;
        way.aimed_at = targets->targets()[link.target].surface;
        way.power = particles->power(l);
        if (way.points.size() > 1) {
            out->ways.push_back(std::move(way));
        }
    }
    return out;
}

} // namespace atrium
