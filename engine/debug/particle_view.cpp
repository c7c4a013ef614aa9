#include "engine/debug/particle_view.h"

#include "engine/solver/insides.h"

#include <algorithm>

namespace atrium {

ParticleView view_particles(const Solution& solution, const std::unordered_set<NodeId>& of, std::size_t most) {
    ParticleView out;
    if (!solution.insides) {
        return out;
    }
    const Insides& in = *solution.insides;
    out.particles = in.particles;
    out.passage_cells = in.passage_cells;
    const auto wanted = [&](std::uint32_t surface) {
        return surface < in.surfaces.size() && (of.empty() || of.contains(in.surfaces[surface].node));
    };
    std::vector<const ParticleWay*> found;
    for (const ParticleWay& way : in.ways) {
        if (wanted(way.landed_on) || wanted(way.aimed_at)) {
            found.push_back(&way);
        }
    }
    const std::size_t count = std::min(found.size(), most);
    for (std::size_t i = 0; i < count; ++i) {
        const ParticleWay& way = *found[i * found.size() / count];
        ParticlePolyline& line = out.ways.emplace_back();
        line.power = way.power;
        for (const vec3& p : way.points) {
            if (glm::length(p) < 0.1F * ParticlePaths::kFar) {
                line.points.push_back(dvec3(p) + in.origin);
            }
        }
    }
    return out;
}

} // namespace atrium
