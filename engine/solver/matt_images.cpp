// Images of matt surfaces in solutions: which particles there are, and what else leaves them out.
#include "engine/solver/gi_engine_impl.h"

#include <algorithm>

namespace atrium {

bool GiEngine::Impl::trace_matt_particles(const QualitySettings& quality, std::uint32_t seed, const RunContext& context) {
    if (!particles) {
        return true;
    }
    const LeafFlags flags = bright_leaves(hierarchy, hierarchy.room, quality.image_contrast);
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t i = 0; i < flags.size(); ++i) {
        if (flags[i] != 0) {
            leaves.push_back(i);
        }
    }
    if (leaves.empty()) {
        return true;
    }
    ParticleScene scene = particle_scene(*punctual);
    scene.detail = matt_detail(leaves);
    const auto emitted = std::uint32_t(std::min<std::uint64_t>(particles->emitted(), quality.most_particles));
    return particles->add_matt(scene, {flags, std::min(quality.particles, quality.most_particles - emitted), seed}, context);
}

MattDetail GiEngine::Impl::matt_detail(const std::vector<std::uint32_t>& leaves) const {
    std::vector<Rgb> mean(hierarchy.elements.size(), Rgb(-1.0F)); // direct light; less than 0: there is no map
    for (const std::uint32_t leaf : leaves) {
        double spread = 0.0;
        (void)mean_of_maps(hierarchy.elements[leaf], maps.front, maps.back, mean[leaf], spread);
    }
    return [this, mean = std::move(mean)](std::uint32_t leaf, const vec3& position) {
        if (mean[leaf].r < 0.0F) {
            return Rgb(1.0F);
        }
        const Element& e = hierarchy.elements[leaf];
        const Chart& chart = *chart_of(e);
        const auto& map = e.back ? maps.back[e.surface] : maps.front[e.surface];
        const Rgb here = map ? map->irradiance(place_on(chart, position)) : Rgb(0.0F);
        const Rgb other = e.emitted + e.rho * (e.caustic + e.irradiance);
        return (other + e.rho * here) / glm::max(other + e.rho * mean[leaf], Rgb(1e-30F));
    };
}

CarriedByParticles GiEngine::Impl::carried_by_particles() const {
    if (!particles || !particles->any_matt()) {
        return {};
    }
    return [this](std::uint32_t leaf, const Hit& over, unsigned bends) {
        return particles->carries(leaf, targets->target_of(over.surface, over.triangle)) &&
               !(bends == 1 && mirrors && mirrors->carries(over)); // an image of the light has it
    };
}

MattLight GiEngine::Impl::brighten_images(double tolerance) const {
    if (!particles || !particles->any_matt()) {
        return {};
    }
    live->new_caustics.resize(rays->surfaces().size(), 0);
    for (const std::uint32_t surface : particles->take_radiosity(hierarchy, tolerance)) {
        live->new_caustics[surface] = 1;
    }
    return particles->matt_light(hierarchy);
}

} // namespace atrium
