#include "engine/radiosity/leaf_surroundings.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"

#include <algorithm>
#include <numeric>

namespace atrium {
namespace {

using Kind = Element::Kind;
constexpr std::uint32_t kRays = 24;

/// Union-find over elements.
class Rooms {
public:
    explicit Rooms(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

private:
    std::vector<std::uint32_t> parent_;
};

} // namespace

LeafSurroundings look_around(const Hierarchy& h, const RayScene& rays, const std::vector<std::uint32_t>& leaves,
                             const RunContext& context) {
    LeafSurroundings out;
    out.enclosed.assign(leaves.size(), 0);
    out.dark.assign(leaves.size(), 0);
    std::vector<std::uint32_t> seen(leaves.size() * kRays, Element::kNone); // leaves met
    std::vector<std::uint8_t> glass(leaves.size(), 0);                      // light may come from elsewhere
    parallel_chunks(leaves.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
        if (context.should_stop()) {
            return;
        }
        for (std::size_t i = begin; i < end; ++i) {
            bool enclosed = true;
            for (std::uint32_t k = 0; k < kRays; ++k) {
                const SurfacePoint p = sample_point(h, rays, leaves[i], sobol_owen2(k, 2, 91U), false);
                const vec2 u = sobol_owen2(k, 0, 73U);
                vec3 t;
                vec3 b;
                make_frame(p.normal, t, b);
                const float r = std::sqrt(u.x);
                const float angle = 2.0F * kPi * u.y;
                const vec3 d = (r * std::cos(angle)) * t + (r * std::sin(angle)) * b + std::sqrt(1.0F - u.x) * p.normal;
                const Hit hit = rays.nearest({p.position + p.normal * 1e-4F, glm::normalize(d)});
                const bool lets_through = hit && (rays.material(hit.surface).transmission > 0.0F ||
                                                  rays.material(hit.surface).alpha_mode == Material::Alpha::Blend);
                const bool reflects = hit && (hit.front || rays.surfaces()[hit.surface].back_side);
                enclosed = enclosed && reflects && rays.material(hit.surface).transmission <= 0.0F;
                glass[i] = glass[i] != 0 || lets_through ? 1 : 0;
                seen[i * kRays + k] =
                    reflects ? h.leaf_at(hit.surface, hit.triangle, !hit.front, hit.barycentric) : Element::kNone;
            }
            out.enclosed[i] = enclosed ? 1 : 0;
        }
    });
    if (context.should_stop()) {
        return out;
    }
    Rooms rooms(h.elements.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (seen[i] != Element::kNone) {
            rooms.join(leaves[i / kRays], seen[i]);
        }
    }
    std::vector<std::uint8_t> lit(h.elements.size(), 0);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const Element& e = h.elements[leaves[i]];
        if (glass[i] != 0 || max_component(e.emitted + e.direct) > 0.0F) {
            lit[rooms.find(leaves[i])] = 1;
        }
    }
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        out.dark[i] = lit[rooms.find(leaves[i])] != 0 ? 0 : 1;
    }
    return out;
}

void darken(Hierarchy& h, const std::vector<std::uint32_t>& leaves, const LeafSurroundings& surroundings) {
    bool any = false;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (surroundings.dark[i] != 0) {
            h.elements[leaves[i]].radiosity = Rgb(0.0F);
            h.elements[leaves[i]].irradiance = Rgb(0.0F);
            any = true;
        }
    }
    if (any) {
        h.pull_radiosity();
    }
}

} // namespace atrium
