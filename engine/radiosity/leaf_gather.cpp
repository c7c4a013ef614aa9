#include "engine/radiosity/leaf_gather.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/raycast/light_walk.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kGrain = 32;

} // namespace

LeafGather::LeafGather(const Hierarchy& h, const RayScene& rays, unsigned rays_per_leaf, std::size_t first,
                       const std::function<bool(const SurfacePoint&)>& covered, const RunContext& context)
    : leaves_(h.leaves()) {
    std::erase_if(leaves_, [&](std::uint32_t leaf) { return leaf < first; });
    groups_.resize(leaves_.size());
    const float offset = std::clamp(1e-5F * rays.bounds().diagonal(), 1e-6F, 1e-3F);
    parallel_chunks(leaves_.size(), kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            const auto seed = std::uint32_t(hash64(h.elements[leaves_[i]].path));
            for (std::uint32_t k = 0; k < rays_per_leaf; ++k) {
                const SurfacePoint p = sample_point(h, rays, leaves_[i], sobol_owen2(k, 2, seed), false);
                if (covered(p)) {
                    continue;
                }
                const vec3 from_centre = p.position - h.elements[leaves_[i]].centre;
                vec3 t1;
                vec3 b1;
                make_frame(h.elements[leaves_[i]].kind == Element::Kind::Patch ? h.elements[leaves_[i]].normal
                                                                               : vec3(0, 1, 0),
                           t1, b1);
                Group& group =
                    groups_[i][(glm::dot(from_centre, t1) > 0.0F ? 1U : 0U) + (glm::dot(from_centre, b1) > 0.0F ? 2U : 0U)];
                Rgb brought(0.0F);
                const vec2 u = sobol_owen2(k, 0, seed);
                vec3 t;
                vec3 b;
                make_frame(p.normal, t, b);
                const float r = std::sqrt(u.x), angle = 2.0F * kPi * u.y;
                const vec3 d =
                    (r * std::cos(angle)) * t + (r * std::sin(angle)) * b + std::sqrt(std::max(1.0F - u.x, 0.0F)) * p.normal;
                LightWay way;
                way.ray = {p.position + p.normal * offset, d};
                way.seed = hash_combine(seed, k);
                for (unsigned met = 0; met < kMostSurfaces; ++met) {
                    const Hit hit = rays.nearest(way.ray);
                    if (!hit) {
                        break;
                    }
                    const std::uint32_t leaf = h.leaf_at(hit.surface, hit.triangle, !hit.front, hit.barycentric);
                    if (leaf != Element::kNone) {
                        brought += h.elements[leaf].radiosity * way.through;
                    }
                    if (!send_on(rays, hit, way)) {
                        break;
                    }
                }
                group.light += brought;
                group.light2 += luminance(brought) * luminance(brought);
                group.rays += 1.0F;
            }
        }
    });
    complete_ = !context.should_stop();
}

std::size_t LeafGather::split_uneven(Hierarchy& h, const RayScene& rays, float contrast, float floor) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        if (!h.can_split(leaves_[i])) {
            continue;
        }
        Group all;
        for (const Group& g : groups_[i]) {
            all.light += g.light;
            all.light2 += g.light2;
            all.rays += g.rays;
        }
        if (!(all.rays > 0.0F)) {
            continue;
        }
        const float mean = luminance(all.light) / all.rays;
        const float variance = std::max(all.light2 / all.rays - mean * mean, 0.0F);
        bool uneven = false;
        for (const Group& g : groups_[i]) {
            const float d = g.rays > 0.0F ? std::abs(luminance(g.light) / g.rays - mean) : 0.0F;
            uneven = uneven || (d > contrast * std::max(mean, floor) && d * d * g.rays > 4.0F * variance);
        }
        if (uneven) {
            h.split(leaves_[i], rays);
            ++count;
        }
    }
    return count;
}

} // namespace atrium
