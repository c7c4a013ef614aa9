#include "engine/radiosity/sight_change.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/raycast/light_walk.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::uint32_t kSeed = 0x516D7U;
constexpr float kClear = 1e-4F;         // metres: rays start this far off their surface
constexpr float kCloseBy = 1.15F;       // within so many radii of a ball its cone is no help: the whole hemisphere
constexpr float kSmallestShare = 5e-4F; // what changes less of the hemisphere is not looked at

bool crosses(const Ray& ray, const Box3& box) {
    float t0 = 0.0F;
    float t1 = std::numeric_limits<float>::infinity();
    for (int k = 0; k < 3; ++k) {
        const float d = ray.direction[k];
        const float inverse = 1.0F / (std::abs(d) < 1e-18F ? std::copysign(1e-18F, d) : d);
        const float a = (box.min[k] - ray.origin[k]) * inverse;
        const float b = (box.max[k] - ray.origin[k]) * inverse;
        t0 = std::max(t0, std::min(a, b));
        t1 = std::min(t1, std::max(a, b));
    }
    return t0 <= t1;
}

} // namespace

SightChange::SightChange(const Hierarchy& hierarchy, const RayScene& rays, std::span<const Displacement> displaced,
                         std::span<const std::uint8_t> moved, CarriedByParticles carried)
    : h_(hierarchy), rays_(rays), moved_(moved.begin(), moved.end()), carried_(std::move(carried)) {
    for (const Displacement& d : displaced) {
        for (Box3 box : {d.before, d.now}) {
            if (box.empty()) {
                continue; // it is not there any more
            }
            const float slack = 1e-4F + 1e-5F * box.diagonal(); // flat things have flat bounds
            box.min -= slack;
            box.max += slack;
            targets_.push_back({box, box.centre(), 0.5F * box.diagonal()});
        }
    }
}

// A ball that fills a cone of half angle a about a direction at angle t from the normal has a form factor of at most
// sin^2 a * min(1, cos t + sin a), and none below the horizon.
float SightChange::share_of(const Target& target, const vec3& point, const vec3& normal, float radius) const {
    const vec3 to = target.centre - point;
    const float reach = target.radius + radius;
    const float distance = glm::length(to);
    const bool all_round = normal == vec3(0.0F);
    const float height = all_round ? distance : glm::dot(to, normal);
    if (height <= -reach) {
        return 0.0F;
    }
    if (distance <= reach) {
        return 1.0F;
    }
    const float sine = reach / distance;
    return sine * sine * std::min(height / distance + sine, 1.0F);
}

float SightChange::share(const vec3& point, const vec3& normal, float radius) const {
    float out = 0.0F;
    for (const Target& t : targets_) {
        out = std::max(out, share_of(t, point, normal, radius));
    }
    return out;
}

unsigned SightChange::rays_for(float share, const Effort& effort) const {
    if (share < kSmallestShare) {
        return 0;
    }
    return std::clamp(unsigned(std::lround(share * effort.rays)), effort.least, effort.most);
}

// False where what moved sends light on itself: where it went before is not known.
bool SightChange::follow(const Ray& ray, bool before, float weight, std::uint64_t seed, Ray1& out) const {
    LightWay way;
    way.ray = ray;
    way.seed = seed; // the same choices before and now
    Hit over;        // what bent the ray last
    for (unsigned met = 0; met < kMostSurfaces && out.count < kMostMet; ++met) {
        const Hit hit = before ? rays_.nearest_before(way.ray) : rays_.nearest(way.ray);
        if (!hit) {
            return true;
        }
        bool carried = false;
        if (way.bends > 0 && carried_) {
            const std::uint32_t leaf = h_.leaf_at(hit.surface, hit.triangle, !hit.front, hit.barycentric);
            carried = leaf != Element::kNone && carried_(leaf, over, way.bends);
        }
        out.met[out.count++] = {hit, weight * way.through, carried};
        const unsigned bends = way.bends;
        if (!(onward_share(rays_, hit, way.ray.direction) > 0.0F)) {
            return true;
        }
        if (moved_[hit.surface] != 0) {
            return false;
        }
        if (!send_on(rays_, hit, way)) {
            return true;
        }
        if (way.bends > bends) {
            over = hit;
        }
    }
    return true;
}

void SightChange::shoot(std::size_t index, const SurfacePoint& from, const vec2& u, float rays, std::uint64_t seed,
                        Ray1& out) const {
    out.count = 0;
    const Target& target = targets_[index];
    const vec3 origin = from.position + from.normal * kClear;
    const vec3 to = target.centre - origin;
    const float distance = glm::length(to);
    const bool cone = distance > kCloseBy * target.radius;
    const vec3 axis = cone ? to / distance : from.normal;
    vec3 t;
    vec3 b;
    make_frame(axis, t, b);
    const float angle = 2.0F * kPi * u.y;
    float cosine = 0.0F; // to the axis
    float weight = 0.0F; // of the ray: form factor that it stands for
    if (cone) {
        const float sine = target.radius / distance;
        const float width = sine * sine / (1.0F + std::sqrt(1.0F - sine * sine)); // 1 - cosine of the cone
        cosine = 1.0F - u.x * width;
        weight = 2.0F * width / rays; // times the cosine to the normal: below
    } else {
        cosine = std::sqrt(std::max(1.0F - u.x, 1e-6F));
        weight = 1.0F / rays;
    }
    const float r = std::sqrt(std::max(1.0F - cosine * cosine, 0.0F));
    const vec3 direction = glm::normalize(t * (r * std::cos(angle)) + b * (r * std::sin(angle)) + axis * cosine);
    if (cone) {
        weight *= glm::dot(direction, from.normal);
    }
    if (!(weight > 0.0F)) {
        return;
    }
    const Ray ray{origin, direction};
    if (!crosses(ray, target.box)) {
        return;
    }
    for (std::size_t k = 0; k < index; ++k) {
        if (crosses(ray, targets_[k].box)) {
            return; // counted there
        }
    }
    if (!rays_.meets_moved(ray)) {
        return;
    }
    const Hit now = rays_.nearest(ray);
    const Hit was = rays_.nearest_before(ray);
    if (now.surface == was.surface && now.triangle == was.triangle && now.t == was.t &&
        (!now || !(onward_share(rays_, now, direction) > 0.0F))) {
        return; // it is hidden, or back in its place
    }
    if (!follow(ray, false, weight, seed, out) || !follow(ray, true, -weight, seed, out)) {
        out.count = 0;
    }
}

Rgb SightChange::irradiance(const SurfacePoint& at, const Effort& effort, const RadiosityAtHit& radiosity) const {
    Rgb sum(0.0F);
    Ray1 ray;
    for (std::size_t index = 0; index < targets_.size(); ++index) {
        const unsigned rays = rays_for(share_of(targets_[index], at.position, at.normal, 0.0F), effort);
        for (unsigned k = 0; k < rays; ++k) {
            // The same pattern everywhere: neighbours err alike.
            shoot(index, at, sobol_owen2(k, 0, kSeed), float(rays), k, ray);
            for (std::size_t m = 0; m < ray.count; ++m) {
                if (!ray.met[m].carried) {
                    sum += ray.met[m].weight * radiosity(ray.met[m].hit);
                }
            }
        }
    }
    return sum;
}

SightChange::Rows SightChange::rows(const Hierarchy& h, std::span<const std::uint32_t> leaves, const Effort& effort,
                                    const std::function<bool(std::uint32_t)>& anew, const LookSettings& look,
                                    const RunContext& context) const {
    constexpr std::size_t kGrain = 64;
    std::vector<std::uint32_t> place(h.elements.size(), 0);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        place[leaves[i]] = std::uint32_t(i);
    }
    Rows out;
    out.first.assign(leaves.size() + 1, 0);
    out.whole.assign(leaves.size(), 0);
    std::vector<std::vector<std::uint8_t>> marks(chunk_count(leaves.size(), kGrain)); // of what is carried
    std::vector<std::vector<Rows::Entry>> found(chunk_count(leaves.size(), kGrain));
    parallel_chunks(leaves.size(), kGrain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        Ray1 ray;
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            const Element& e = h.elements[leaves[i]];
            if (anew(leaves[i])) {
                out.whole[i] = 1;
                continue;
            }
            const std::size_t before = found[chunk].size();
            const auto seed = std::uint32_t(e.path);
            for (std::size_t index = 0; index < targets_.size(); ++index) {
                const vec3 normal = e.kind == Element::Kind::Patch ? e.normal : vec3(0.0F);
                const unsigned rays = rays_for(share_of(targets_[index], e.centre, normal, e.radius), effort);
                for (unsigned k = 0; k < rays; ++k) {
                    const SurfacePoint from = sample_point(h, rays_, leaves[i], sobol_owen2(k, 2, seed), false);
                    shoot(index, from, sobol_owen2(k, 0, seed), float(rays), hash_combine(e.path, k), ray);
                    for (std::size_t m = 0; m < ray.count; ++m) {
                        const Hit& hit = ray.met[m].hit;
                        const std::uint32_t leaf = h.leaf_at(hit.surface, hit.triangle, !hit.front, hit.barycentric);
                        if (leaf != Element::kNone) {
                            found[chunk].push_back({place[leaf], luminance(ray.met[m].weight)});
                            if (carried_) {
                                marks[chunk].push_back(ray.met[m].carried ? 1 : 0);
                            }
                        }
                    }
                }
            }
            out.first[i + 1] = found[chunk].size() - before;
        }
    });
    std::vector<std::uint32_t> own;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (out.whole[i] != 0) {
            own.push_back(leaves[i]);
        }
    }
    const LeafSurroundings around = look_around(h, rays_, own, look, context);
    std::size_t k = 0; // in own
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (out.whole[i] != 0) {
            out.first[i + 1] = around.first_seen[k + 1] - around.first_seen[k];
            ++k;
        }
    }
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        out.first[i + 1] += out.first[i];
    }
    out.entries.resize(out.first.back());
    out.carried.resize(carried_ ? out.entries.size() : 0, 0);
    k = 0;
    for (std::size_t chunk = 0; chunk < found.size(); ++chunk) {
        auto next = found[chunk].begin();
        auto next_mark = marks[chunk].begin();
        for (std::size_t i = chunk * kGrain; i < std::min(leaves.size(), (chunk + 1) * kGrain); ++i) {
            const auto to = out.entries.begin() + std::ptrdiff_t(out.first[i]);
            if (out.whole[i] == 0) {
                const auto count = std::ptrdiff_t(out.first[i + 1] - out.first[i]);
                std::copy_n(next, count, to);
                next += count;
                if (carried_) {
                    std::copy_n(next_mark, count, out.carried.begin() + std::ptrdiff_t(out.first[i]));
                    next_mark += count;
                }
                continue;
            }
            std::transform(around.seen.begin() + std::ptrdiff_t(around.first_seen[k]),
                           around.seen.begin() + std::ptrdiff_t(around.first_seen[k + 1]), to,
                           [&](const LeafSurroundings::Seen& seen) {
                               return Rows::Entry{place[seen.leaf], seen.weight};
                           });
            ++k;
        }
    }
    return out;
}

void SightChange::Rows::apply(const std::vector<Rgb>& radiosity, std::vector<Rgb>& irradiance) const {
    parallel_chunks(whole.size(), 1024, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            Rgb sum(0.0F);
            for (std::size_t k = first[i]; k < first[i + 1]; ++k) {
                sum += radiosity[entries[k].other] * entries[k].weight;
            }
            irradiance[i] = whole[i] != 0 ? sum : irradiance[i] + sum;
        }
    });
}

Rgb SightChange::Rows::carried_light(const Hierarchy& h, std::span<const std::uint32_t> leaves, std::size_t leaf) const {
    Rgb sum(0.0F);
    for (std::size_t k = first[leaf]; k < first[leaf + 1] && !carried.empty(); ++k) {
        if (carried[k] != 0) {
            sum += h.elements[leaves[entries[k].other]].radiosity * entries[k].weight;
        }
    }
    return sum;
}

std::vector<Rgb> solve_with_changed_sight(Hierarchy& h, const LeafExchange& exchange, const SightChange::Rows& rows,
                                          double tolerance, int max_iterations, const RunContext& context) {
    const std::vector<std::uint32_t>& leaves = exchange.leaves();
    const std::size_t n = leaves.size();
    std::vector<Rgb> b(n), r(n), e(n), ar(n);
    const auto reflected = [&](const std::vector<Rgb>& radiosity, std::vector<Rgb>& out) {
        exchange.apply(radiosity, e);
        rows.apply(radiosity, e);
        for (std::size_t i = 0; i < n; ++i) {
            out[i] = h.elements[leaves[i]].rho * e[i];
        }
    };
    // Weighted by area: energy, and not the number of leaves, is what must come right.
    const auto dot = [&](const std::vector<Rgb>& p, const std::vector<Rgb>& q) {
        return parallel_sum(n, 512, 0.0, [&](std::size_t i) { return double(exchange.area()[i]) * glm::dot(p[i], q[i]); });
    };
    for (std::size_t i = 0; i < n; ++i) {
        b[i] = h.elements[leaves[i]].radiosity;
    }
    reflected(b, r);
    for (std::size_t i = 0; i < n; ++i) {
        r[i] += h.elements[leaves[i]].first_radiosity() - b[i];
    }
    const double size = dot(b, b);
    for (int k = 0; k < max_iterations && dot(r, r) > tolerance * tolerance * size && !context.should_stop(); ++k) {
        reflected(r, ar);
        for (std::size_t i = 0; i < n; ++i) {
            ar[i] = r[i] - ar[i];
        }
        const double squared = dot(ar, ar);
        const float alpha = squared > 0.0 ? float(std::clamp(dot(r, ar) / squared, 0.1, 10.0)) : 1.0F;
        for (std::size_t i = 0; i < n; ++i) {
            b[i] += alpha * r[i];
            r[i] -= alpha * ar[i];
        }
    }
    for (Rgb& radiosity : b) {
        radiosity = glm::max(radiosity, Rgb(0.0F)); // where more was taken off by chance than there was
    }
    std::vector<Rgb> beside;
    exchange.apply(b, beside);
    e = beside;
    rows.apply(b, e);
    for (std::size_t i = 0; i < n; ++i) {
        Element& element = h.elements[leaves[i]];
        element.irradiance = glm::max(e[i], Rgb(0.0F));
        element.radiosity = element.first_radiosity() + element.rho * element.irradiance;
        beside[i] = element.irradiance - beside[i];
    }
    h.pull_radiosity();
    return beside;
}

} // namespace atrium
