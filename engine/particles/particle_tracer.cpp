#include "engine/particles/particle_tracer.h"

#include "engine/base/rng.h"
#include "engine/optics/specular.h"
#include "engine/raycast/light_walk.h"

#include <algorithm>

namespace atrium {
namespace {

// Igehy 1999: derivatives of a ray by the numbers that it was made from. 0, 1 spread the particles of a stream over their
// target; 2, 3 are the source's size; 4, 5 the lobe of a rough surface on the way.
constexpr std::size_t kPairs = 6;
constexpr std::uint32_t kLobeStream = 0x9E3779B9U; // apart from the stream that the particle was emitted by
// The lobe's numbers in an order of their own: in the particles' order they would agree with the emission's in their leading
// bits (Burley 2020). Strata of powers of two stay whole, so streams stay nested.
std::uint32_t shuffled(std::uint32_t index, std::uint32_t seed) {
    return reverse_bits(owen_scramble_reversed(reverse_bits(index), seed * 0x85EBCA6BU + kLobeStream));
}
struct Beam {
    std::array<vec3, kPairs> p{};
    std::array<vec3, kPairs> d{};
    std::size_t used = kPairs; ///< the others are zero
};

// Moves a beam on to the plane of a hit.
void transfer(Beam& beam, const vec3& direction, float t, const vec3& normal) {
    const float cosine = glm::dot(direction, normal);
    const float inverse = std::abs(cosine) > 1e-4F ? 1.0F / cosine : 0.0F; // grazing: nothing sensible to say
    for (std::size_t k = 0; k < beam.used; ++k) {
        const vec3 q = beam.p[k] + beam.d[k] * t;
        beam.p[k] = q - direction * (glm::dot(q, normal) * inverse);
    }
}

// Change of the (unit) shading normal with a step within the hit's triangle.
class NormalChange {
public:
    NormalChange(const RayScene& rays, const Hit& hit, const vec3& shading) : shading_(shading) {
        const RaySurface& s = rays.surfaces()[hit.surface];
        if (s.mesh->normals.empty()) {
            return;
        }
        const uvec3& t = s.triangles[hit.triangle];
        const auto p = rays.triangle(hit.surface, hit.triangle);
        const mat3 turn(s.normal_matrix);
        std::array<vec3, 3> n;
        for (int k = 0; k < 3; ++k) {
            const vec3 w = turn * s.mesh->normals[t[k]];
            const float length = glm::length(w);
            n[std::size_t(k)] = length > 0.0F ? w / length : hit.geometric_normal;
        }
        const vec3 e1 = p[1] - p[0];
        const vec3 e2 = p[2] - p[0];
        const float a = glm::dot(e1, e1), b = glm::dot(e1, e2), c = glm::dot(e2, e2);
        const float determinant = a * c - b * b;
        if (!(determinant > 0.0F)) {
            return;
        }
        along_1_ = (e1 * c - e2 * b) / determinant;
        along_2_ = (e2 * a - e1 * b) / determinant;
        const vec3 sum =
            n[0] * (1.0F - hit.barycentric.x - hit.barycentric.y) + n[1] * hit.barycentric.x + n[2] * hit.barycentric.y;
        const float length = glm::length(sum);
        if (length > 1e-3F) {
            // Towards the same side as the normal that is used.
            const float side = glm::dot(sum, shading) < 0.0F ? -1.0F : 1.0F;
            d1_ = (n[1] - n[0]) * (side / length);
            d2_ = (n[2] - n[0]) * (side / length);
        }
    }
    [[nodiscard]] vec3 by(const vec3& step) const {
        const vec3 d = d1_ * glm::dot(along_1_, step) + d2_ * glm::dot(along_2_, step);
        return d - shading_ * glm::dot(shading_, d);
    }

private:
    vec3 shading_;
    vec3 along_1_{0.0F}, along_2_{0.0F}; // gradients of the barycentric coordinates
    vec3 d1_{0.0F}, d2_{0.0F};
};

// Turns a beam over a mirror or lens. The normal is the one that makes the outgoing direction of the incoming one: on rough
// surfaces that of the facet.
void bend(Beam& beam, const RayScene& rays, const Hit& hit, const vec3& in, const vec3& out, const WayOn& way,
          const Material& material) {
    const NormalChange change(rays, hit, way.shading);
    if (!way.transmitted) {
        const vec3 h = out - in;
        const float length = glm::length(h);
        const vec3 n = length > 1e-6F ? h / length : way.shading;
        for (std::size_t k = 0; k < beam.used; ++k) {
            const vec3 dn = change.by(beam.p[k]);
            const float c = glm::dot(in, n);
            const float dc = glm::dot(beam.d[k], n) + glm::dot(in, dn);
            beam.d[k] -= 2.0F * (dc * n + c * dn);
        }
    } else if (material.thickness > 0.0F) {
        const float ior = std::max(material.ior, 1.0F);
        const float eta = hit.front ? 1.0F / ior : ior;
        const vec3 m = out - eta * in; // mu * n
        const float size = glm::length(m);
        if (size > 1e-6F) {
            vec3 n = m / size;
            n = glm::dot(n, in) > 0.0F ? -n : n;
            const float c = -glm::dot(in, n);
            const float ct = std::max(-glm::dot(out, n), 1e-3F);
            const float mu = eta * c - ct;
            for (std::size_t k = 0; k < beam.used; ++k) {
                const vec3 dn = change.by(beam.p[k]);
                const float dc = -glm::dot(beam.d[k], n) - glm::dot(in, dn);
                const float dmu = (eta - eta * eta * c / ct) * dc;
                beam.d[k] = eta * beam.d[k] + mu * dn + dmu * n;
            }
        }
    }
    for (std::size_t k = 0; k < beam.used; ++k) {
        beam.d[k] -= out * glm::dot(out, beam.d[k]);
    }
    if (way.spread > 0.0F) {
        beam.used = kPairs;
        vec3 t;
        vec3 b;
        make_frame(out, t, b);
        // A uniform strip of the same standard deviation; spreads of several rough surfaces add by their squares.
        const float width = way.spread * std::sqrt(12.0F);
        beam.d[4] = t * std::hypot(glm::length(beam.d[4]), width);
        beam.d[5] = b * std::hypot(glm::length(beam.d[5]), width);
    }
}

struct Spread { // symmetric 2 x 2
    float xx = 0.0F, xy = 0.0F, yy = 0.0F;
    void add(const vec2& v) {
        xx += v.x * v.x;
        xy += v.x * v.y;
        yy += v.y * v.y;
    }
    [[nodiscard]] float determinant() const { return std::max(xx * yy - xy * xy, 0.0F); }
};

// What follows from how many particles a stream has: the same roots for every landing.
struct Crowd {
    std::uint32_t count = 0; ///< particles in the stream
    float scale = 0.0F;      ///< of the half axes of what lies between neighbours
    float crowd = 0.0F;      ///< see blur_share()
    float most = 0.0F;       ///< share of the blur
    explicit Crowd(std::uint32_t particles) : count(particles) {
        const auto n = float(std::max(particles, 1U));
        constexpr float kSpacing = 3.0F; // of the kernel's diameter over the mean distance of particles
        scale = 0.5F * kSpacing / std::sqrt(n);
        crowd = 20.0F * std::max(std::sqrt(n / 1e4F), 1.0F);
        most = std::min(std::pow(n / 5e4F, -2.0F / 3.0F), 1.0F);
    }
};

// Share of the blur that is there anyway (the source's size, rough surfaces) by which a kernel is widened. Such blur throws
// neighbours of a stream about: their kernels no longer tile the light but fall on it by chance, n of them over the area of
// image and blur together. As many must overlap as make their mean smooth, `crowd` times what tiling needs, but never more
// than a share of the blur itself. With more particles more overlap and the share shrinks, so that noise and bias both
// vanish in the end: kernels that shrink as fast as particles lie closer keep their noise for ever.
float blur_share(const Spread& own, const Spread& blur, const Crowd& by) {
    const float scale2 = by.scale * by.scale;
    Spread spread = own;
    spread.xx += scale2 * blur.xx;
    spread.xy += scale2 * blur.xy;
    spread.yy += scale2 * blur.yy;
    const float missing = std::max(by.crowd * by.crowd * spread.determinant() - own.determinant(), 0.0F);
    const float mixed = own.xx * blur.yy + own.yy * blur.xx - 2.0F * own.xy * blur.xy;
    const float root = std::sqrt(std::max(mixed * mixed + 4.0F * blur.determinant() * missing, 0.0F));
    const float below = mixed + root; // det(own + x blur) = det own + missing, stable where the blur is a line
    return below > 0.0F ? std::min(2.0F * missing / below, by.most) : 0.0F;
}

// Half axes of the kernel: what lies between a particle and its neighbours, and a share of the blur.
void footprint(const Beam& beam, const vec3& normal, std::uint32_t count, Landing& out) {
    vec3 t;
    vec3 b;
    make_frame(normal, t, b);
    static thread_local Crowd by(1); // of the stream at hand
    if (by.count != count) {
        by = Crowd(count);
    }
    const float scale = by.scale;
    Spread own;
    Spread blur;
    for (std::size_t k = 0; k < beam.used; ++k) {
        const vec2 v(glm::dot(beam.p[k], t), glm::dot(beam.p[k], b));
        if (k < 2) {
            own.add(scale * v);
        } else {
            blur.add(v);
        }
    }
    const float share = blur_share(own, blur, by);
    const float xx = own.xx + share * blur.xx, xy = own.xy + share * blur.xy, yy = own.yy + share * blur.yy;
    if (!std::isfinite(xx + xy + yy)) {
        return;
    }
    // Eigenvectors of the symmetric matrix, each as long as the root of its value.
    const float mean = 0.5F * (xx + yy);
    const float spread = std::sqrt(std::max(0.25F * (xx - yy) * (xx - yy) + xy * xy, 0.0F));
    const float high = std::max(mean + spread, 0.0F);
    const float low = std::max(mean - spread, 0.0F);
    // The larger of the two columns of (M - low) that are parallel to the major axis.
    const vec2 p(xx - low, xy), q(xy, yy - low);
    const vec2 along = glm::dot(p, p) >= glm::dot(q, q) ? p : q;
    const float length = glm::length(along);
    const vec2 e = length > 0.0F ? along / length : vec2(1.0F, 0.0F);
    const vec3 major = t * e.x + b * e.y;
    const vec3 minor = b * e.x - t * e.y;
    out.axis_a = major * std::sqrt(high);
    out.axis_b = minor * std::sqrt(low);
}

bool receives(const RayScene& rays, const Hit& hit) {
    const Material& m = rays.material(hit.surface);
    if (!hit.front && !rays.surfaces()[hit.surface].back_side) {
        return false;
    }
    return !is_specular(m) || max_component(diffuse_reflectance(m)) > 0.0F;
}

} // namespace

void trace_particle(const RayScene& rays, const SpecularTargets& targets, const Hierarchy& emitters,
                    const ParticleStream& stream, std::uint32_t index, const CarriedByImage& by_image,
                    std::vector<Landing>& landings, ParticleEnergy& energy, std::vector<Ray>* path) {
    const auto seed = std::uint32_t(stream.key);
    const vec2 a = sobol_owen2(index, 0, seed);
    const vec2 b = stream.source->has_size ? sobol_owen2(index, 2, seed) : vec2(0.5F);
    Emission emission;
    if (!emit(*stream.source, targets.targets()[stream.target], stream.aim, emitters, rays, {a.x, a.y, b.x, b.y},
              emission)) {
        return;
    }
    if (stream.detail != nullptr) {
        emission.throughput *= (*stream.detail)(stream.source->leaves[emission.leaf], emission.origin);
    }
    LightWay way;
    way.ray = {emission.origin, emission.direction};
    way.through = emission.throughput / float(std::max(stream.count, 1U));
    way.seed = hash_combine(stream.key, index);
    if (!(max_component(way.through) > 0.0F)) {
        return;
    }
    way.unit = max_component(way.through);
    Beam beam;
    for (std::size_t k = 0; k < 4; ++k) {
        beam.p[k] = emission.d_origin[k];
        beam.d[k] = emission.d_direction[k];
    }
    beam.used = emission.d_direction[2] == vec3(0.0F) && emission.d_direction[3] == vec3(0.0F) ? 2 : 4;
    const Rgb brightness = stream.source->brightness(emission.leaf);
    const auto power = [&](const Rgb& through) { return double(luminance(through * brightness)); };
    bool imaged = false; // so far the chain is one that mirror images carry
    for (unsigned met = 0; met < kMostSurfaces; ++met) {
        const Hit hit = rays.nearest(way.ray);
        if (path != nullptr) {
            path->push_back({way.ray.origin, way.ray.direction, hit ? hit.t : way.ray.tmax});
        }
        if (!hit) {
            energy.escaped += way.bends > 0 ? power(way.through) : 0.0;
            return;
        }
        const vec3 side = hit.front ? hit.geometric_normal : -hit.geometric_normal;
        transfer(beam, way.ray.direction, hit.t, side);
        const vec3 in = way.ray.direction;
        const double arrived = power(way.through);
        WayOn how;
        if (way.bends == 0) {
            if (targets.target_of(hit.surface, hit.triangle) != stream.target) {
                // On the way to the target only clear panes and holes may lie, and those straight.
                way.through *= rays.straight_through(hit, in);
                if (!(max_component(way.through) > 0.0F)) {
                    return;
                }
                const vec3 at = hit_position(rays, hit);
                const vec3 size = glm::abs(at);
                way.ray.origin = at - side * std::max(1e-5F, 5e-7F * max_component(size));
                continue;
            }
            // The choices at the first bend are stratified over the stream; later ones are hashed.
            const Material& m = rays.material(hit.surface);
            vec3 u(0.5F);
            if (m.roughness >= kMirrorRoughness) {
                const vec2 lobe = sobol_owen2(shuffled(index, seed), 0, seed ^ kLobeStream);
                u.x = lobe.x;
                u.y = lobe.y;
            }
            if (m.transmission > 0.0F) {
                u.z = sobol_owen(shuffled(index, seed), 2, seed ^ kLobeStream);
            }
            const bool goes_on = bend_on(rays, hit, way, u, how);
            energy.emitted += arrived;
            energy.absorbed += arrived - (goes_on ? power(way.through) : 0.0);
            if (!goes_on) {
                return;
            }
            imaged = by_image && by_image(hit);
        } else {
            const bool lands = receives(rays, hit);
            if (lands && !imaged) {
                Landing landing;
                landing.surface = hit.surface;
                landing.triangle = hit.triangle;
                landing.barycentric = hit.barycentric;
                landing.throughput = way.through;
                landing.link = stream.link;
                landing.index = index;
                landing.leaf = emission.leaf;
                landing.bends = std::uint16_t(way.bends);
                landing.back = !hit.front;
                footprint(beam, side, stream.count, landing);
                landings.push_back(landing);
            }
            const bool goes_on = send_on(rays, hit, way, &how);
            const double ends = arrived - (goes_on ? power(way.through) : 0.0);
            (!lands ? energy.absorbed : imaged ? energy.imaged : energy.stored) += ends;
            if (!goes_on) {
                return;
            }
            imaged = imaged && how.straight;
        }
        if (!how.straight) {
            bend(beam, rays, hit, in, way.ray.direction, how, rays.material(hit.surface));
        }
    }
    energy.cut += power(way.through);
}

} // namespace atrium
