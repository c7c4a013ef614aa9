// Light over mirrors and through glass that follows the hand: particles whose ways are touched are traced again.
#include "engine/solver/gi_engine_impl.h"

#include <algorithm>

namespace atrium {

// Surfaces whose caustics are to be made anew. An error where the particles do not fit the scene any more, or when stopped.
Result<std::vector<std::uint32_t>> GiEngine::trace_again(Impl& s, const Scene& scene, bool moves, UpdateStatistics& report,
                                                         const RunContext& context) {
    Impl::Live& live = *s.live;
    std::vector<std::uint32_t> out;
    if (!s.particles) {
        return out;
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
        const ParticleScene particle_scene{*s.rays, *s.targets, *lamps, s.emitters,
                                           [&s](const Hit& hit) { return s.mirrors && s.mirrors->carries(hit); }};
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
    for (std::uint32_t i = 0; i < live.new_caustics.size(); ++i) {
        if (live.new_caustics[i] != 0) {
            out.push_back(i);
        }
    }
    return out;
}

} // namespace atrium
