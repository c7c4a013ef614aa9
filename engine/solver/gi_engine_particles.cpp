// Light over mirrors and through glass that follows the hand: particles whose ways are touched are traced again.
#include "engine/solver/gi_engine_impl.h"

#include <algorithm>

namespace atrium {

// Marks surfaces whose caustics are to be made anew. An error where the particles do not fit the scene any more, or when
// stopped.
Result<void> GiEngine::trace_again(Impl& s, const Scene& scene, bool moves, UpdateStatistics& report,
                                   const RunContext& context) {
    Impl::Live& live = *s.live;
    if (!s.particles) {
        return {};
    }
    std::vector<CausticWish> wishes = caustic_wishes(scene, *s.rays);
    live.new_caustics.resize(s.rays->surfaces().size(), 0); // should this update be stopped
    for (const std::uint32_t i : surfaces_with_new_wishes(s.wishes, wishes)) {
        live.new_caustics[i] = 1;
    }
    s.wishes = std::move(wishes);
    if (moves) {
        std::vector<std::uint32_t> moved_surfaces;
        for (std::uint32_t i = 0; i < live.owed.moved.size(); ++i) {
            if (live.owed.moved[i] != 0) {
                moved_surfaces.push_back(i);
            }
        }
        s.targets->follow(*s.rays, moved_surfaces);
        const std::unique_ptr<DirectLight> lamps = s.lamps_of_particles();
        ParticleScene particle_scene = s.particle_scene(*lamps);
        if (s.particles->any_matt()) {
            particle_scene.detail = s.matt_detail(s.particles->matt_leaves());
        }
        const ParticleUpdate particles = s.particles->update(particle_scene, live.owed.boxes, moved_surfaces, context);
        if (!particles.fits) {
            return fail("", "", "the sources of caustics changed", "A whole new solution answers");
        }
        if (!particles.complete) {
            return fail("", "", "stopped before the light had followed", "The next update goes on");
        }
        report.particles_traced = particles.particles;
        report.particles_share = particles.share;
        report.links_visited = s.particles->links().size();
        report.links_changed = particles.links;
        for (const std::uint32_t i : particles.surfaces) {
            live.new_caustics[i] = 1;
        }
    }
    return {};
}

std::vector<std::uint32_t> GiEngine::surfaces_with_new_caustics(const Impl& s) {
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < s.live->new_caustics.size(); ++i) {
        if (s.live->new_caustics[i] != 0) {
            out.push_back(i);
        }
    }
    return out;
}

} // namespace atrium
