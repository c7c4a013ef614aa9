#include "engine/radiosity/leaf_surroundings.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/optics/specular.h"
#include "engine/raycast/light_walk.h"

#include <algorithm>
#include <numeric>

namespace atrium {
namespace {

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

// A point and a direction spread about its normal by the cosine, the k-th of a leaf's bundle.
struct LeafRay {
    SurfacePoint from;
    vec3 direction;
};
LeafRay leaf_ray(const Hierarchy& h, const RayScene& rays, std::uint32_t leaf, std::uint32_t k) {
    // Streams of their own: with one bundle for all, what it misses would be missed everywhere.
    const auto seed = std::uint32_t(h.elements[leaf].path);
    LeafRay out{sample_point(h, rays, leaf, sobol_owen2(k, 2, seed), false), {}};
    const vec2 u = sobol_owen2(k, 0, seed);
    vec3 t;
    vec3 b;
    make_frame(out.from.normal, t, b);
    const float r = std::sqrt(u.x);
    const float angle = 2.0F * kPi * u.y;
    out.direction = glm::normalize((r * std::cos(angle)) * t + (r * std::sin(angle)) * b +
                                   std::sqrt(std::max(1.0F - u.x, 1e-6F)) * out.from.normal);
    return out;
}

// How far from a surface rays start, metres: clear of its own rounding.
constexpr float kClear = 1e-4F;

// Share of the light from all round that neither goes straight through a leaf nor is mirrored or bent by it.
float opacity(const Hierarchy& h, const RayScene& rays, std::uint32_t leaf) {
    const Element& e = h.elements[leaf];
    bool sends_on = false;
    const auto look_at = [&](std::uint32_t surface) {
        const Material& m = rays.material(surface);
        sends_on = sends_on || m.transmission > 0.0F || m.alpha_mode != Material::Alpha::Opaque || is_specular(m);
    };
    if (e.kind == Element::Kind::Patch) {
        look_at(e.surface);
    } else {
        for (std::uint32_t f = e.triangle; f < e.triangle + e.face_count; ++f) {
            look_at(h.faces[f].surface);
        }
    }
    if (!sends_on) {
        return 1.0F;
    }
    constexpr std::uint32_t kRays = 32;
    double passed = 0.0;
    for (std::uint32_t k = 0; k < kRays; ++k) {
        const LeafRay ray = leaf_ray(h, rays, leaf, k);
        const vec3 in = -ray.direction; // from outside onto the leaf's own side
        const Hit hit = rays.nearest({ray.from.position + ray.direction * kClear, in, 2.0F * kClear});
        passed += hit ? double(onward_share(rays, hit, in)) : 1.0; // holes of a cut-out are no hits
    }
    return float(std::clamp(1.0 - passed / kRays, 0.0, 1.0));
}

} // namespace

LeafSurroundings look_around(const Hierarchy& h, const RayScene& rays, const std::vector<std::uint32_t>& leaves,
                             const LookSettings& settings, const RunContext& context) {
    constexpr std::size_t kGrain = 32;
    LeafSurroundings out;
    out.rays = settings.rays;
    out.share.assign(leaves.size(), 0.0F);
    out.sky.assign(leaves.size(), 0.0F);
    out.opacity.assign(leaves.size(), 1.0F);
    out.open.assign(leaves.size(), 1.0F);
    out.first_seen.assign(leaves.size() + 1, 0);
    std::vector<std::vector<LeafSurroundings::Seen>> seen(chunk_count(leaves.size(), kGrain));
    parallel_chunks(leaves.size(), kGrain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            out.opacity[i] = opacity(h, rays, leaves[i]);
            const std::size_t before = seen[chunk].size();
            double share = 0.0;
            double sky = 0.0;
            std::uint32_t shot = 0;
            for (std::uint32_t k = 0; k < settings.rays; ++k) {
                const LeafRay ray = leaf_ray(h, rays, leaves[i], k);
                if (settings.covered && settings.covered(ray.from)) {
                    continue;
                }
                ++shot;
                LightWay way;
                way.ray = {ray.from.position + ray.from.normal * kClear, ray.direction};
                way.seed = hash_combine(h.elements[leaves[i]].path, k);
                for (unsigned met = 0; met < kMostSurfaces; ++met) {
                    const Hit hit = rays.nearest(way.ray);
                    if (!hit) {
                        sky += way.bends > 0 ? double(luminance(way.through)) : 0.0;
                        break;
                    }
                    const std::uint32_t leaf = h.leaf_at(hit.surface, hit.triangle, !hit.front, hit.barycentric);
                    const float arrived = luminance(way.through);
                    const float onward = onward_share(rays, hit, way.ray.direction);
                    if (leaf != Element::kNone) {
                        share += double(arrived) * (1.0 - onward);
                        seen[chunk].push_back({leaf, arrived});
                        ++out.first_seen[i + 1];
                    }
                    if (!(onward > 0.0F) || !send_on(rays, hit, way)) {
                        break;
                    }
                }
            }
            for (std::size_t k = before; k < seen[chunk].size(); ++k) {
                seen[chunk][k].weight /= float(shot);
            }
            out.sky[i] = shot > 0 ? float(sky / shot) : 0.0F;
            out.share[i] = shot > 0 ? float(share / shot) : 0.0F;
            out.open[i] = std::max(float(shot), 0.5F) / float(settings.rays);
        }
    });
    for (const auto& part : seen) {
        out.seen.insert(out.seen.end(), part.begin(), part.end());
    }
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        out.first_seen[i + 1] += out.first_seen[i];
    }
    return out;
}

void mark_rooms(Hierarchy& h, const std::vector<std::uint32_t>& leaves, const LeafSurroundings& around) {
    h.room.clear();
    Rooms rooms(h.elements.size());
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        for (std::size_t k = around.first_seen[i]; k < around.first_seen[i + 1]; ++k) {
            rooms.join(leaves[i], around.seen[k].leaf);
        }
    }
    struct Room {
        std::uint32_t name;
        std::size_t leaves = 0;
        double area = 0.0;
    };
    std::vector<Room> found;
    std::vector<std::uint32_t> index(h.elements.size(), Element::kNone); // of a room's name in found
    for (const std::uint32_t leaf : leaves) {
        const std::uint32_t name = rooms.find(leaf);
        if (index[name] == Element::kNone) {
            index[name] = std::uint32_t(found.size());
            found.push_back({name});
        }
        ++found[index[name]].leaves;
        found[index[name]].area += h.elements[leaf].area;
    }
    // What sees nothing, such as backs of walls and the ground outside, is no room.
    std::erase_if(found, [](const Room& room) { return room.leaves < 2; });
    if (found.size() < 2) {
        return;
    }
    constexpr std::size_t kMostRooms = 64;
    std::stable_sort(found.begin(), found.end(), [](const Room& a, const Room& b) { return a.area > b.area; });
    found.resize(std::min(found.size(), kMostRooms));
    std::fill(index.begin(), index.end(), Element::kNone);
    for (std::uint32_t i = 0; i < found.size(); ++i) {
        index[found[i].name] = i;
    }
    h.room.assign(h.elements.size(), Element::kNone);
    for (const std::uint32_t leaf : leaves) {
        h.room[leaf] = index[rooms.find(leaf)];
    }
}

} // namespace atrium
