#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/reference/light_tracer.h"
#include "engine/reference/path_lights.h"
#include "engine/reference/reference.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kStreams = 16;
constexpr std::uint64_t kRound = 8192; // particles of a stream at a time

/// What a particle adds to a texel.
struct Share {
    std::size_t texel = 0;
    Rgb flux{0.0F};
};

/// A rectangle in engine coordinates, with what tells its texels.
struct Receiver {
    vec3 corner{0.0F};
    vec3 normal{0.0F};
    vec3 to_u{0.0F}; ///< dot product with a place from the corner: 0 to 1 over the rectangle
    vec3 to_v{0.0F};
    float lift = 0.0F; ///< metres that the counting plane lies over it, clear of a surface in the same plane

    /// Texel that a leg crosses from the front, or a number past the last.
    [[nodiscard]] std::size_t texel(const CausticLeg& leg, std::size_t nx, std::size_t ny) const {
        const std::size_t none = nx * ny;
        const float down = glm::dot(leg.direction, normal);
        const float height = glm::dot(leg.from - corner, normal) - lift;
        if (!(down < 0.0F) || !(height >= 0.0F) || !(height <= -down * leg.length)) {
            return none;
        }
        // Counted above the plane, placed in it.
        const vec3 at = leg.from - corner + leg.direction * ((height + lift) / -down);
        const float u = glm::dot(at, to_u) * float(nx);
        const float v = glm::dot(at, to_v) * float(ny);
        if (!(u >= 0.0F && u < float(nx) && v >= 0.0F && v < float(ny))) {
            return none;
        }
        return std::size_t(v) * nx + std::size_t(u);
    }
};

Result<Receiver> receiver_of(const ReferenceRectangle& r, const RayScene& rays) {
    Receiver out;
    const dvec3 across = glm::cross(r.u, r.v);
    const double area = glm::length(across);
    if (!(area > 0.0) || !is_finite(r.corner) || !is_finite(across) || !(glm::length(r.normal) > 0.0)) {
        return fail("", "", "the receiver is no rectangle", "Give a corner, two edges at right angles and a normal.");
    }
    out.corner = vec3(r.corner - rays.origin());
    out.normal = vec3(glm::normalize(r.normal));
    out.to_u = vec3(r.u / glm::dot(r.u, r.u));
    out.to_v = vec3(r.v / glm::dot(r.v, r.v));
    const vec3 far = glm::abs(out.corner) + vec3(glm::abs(r.u) + glm::abs(r.v));
    out.lift = std::max(2e-5F, 2e-6F * max_component(far));
    return out;
}

} // namespace

Result<ReferenceCaustics> reference_caustics(const Scene& scene, const ReferenceRectangle& rectangle, std::size_t nx,
                                             std::size_t ny, const CausticReferenceSettings& settings,
                                             const RunContext& context) {
    if (settings.particles == 0 && context.deadline == RunContext::Clock::time_point::max()) {
        return fail("", "", "nothing says when the reference is good enough", "Give a time limit or a number of particles.");
    }
    const RayScene rays(scene, context);
    if (context.should_stop()) {
        return fail("", "", "stopped before the first estimate", "Give it more time.");
    }
    const auto receiver = receiver_of(rectangle, rays);
    if (!receiver) {
        return tl::unexpected(receiver.error());
    }
    nx = std::max<std::size_t>(nx, 1);
    ny = std::max<std::size_t>(ny, 1);
    const std::size_t texels = nx * ny;
    const PathLights lights(scene, rays);
    const LightTracer tracer(rays, lights, LightTracer::Emitters::All);
    ReferenceCaustics out;
    out.width = nx;
    out.height = ny;
    std::vector<std::vector<dvec3>> sums(kStreams, std::vector<dvec3>(texels, dvec3(0.0)));
    const std::uint64_t wanted = settings.particles > 0 ? (settings.particles + kStreams - 1) / kStreams : ~0ULL;
    std::uint64_t traced = 0; // of each stream
    const std::uint64_t key = hash_combine(0xCA57ULL, settings.seed);
    while (traced < wanted) {
        const std::uint64_t count = std::min(kRound, wanted - traced);
        std::vector<std::vector<Share>> found(kStreams);
        parallel_chunks(kStreams, 1, [&](std::size_t from, std::size_t to, std::size_t) {
            for (std::size_t s = from; s < to; ++s) {
                for (std::uint64_t i = 0; i < count && !((i & 255U) == 0 && context.should_stop()); ++i) {
                    tracer.trace(hash_combine(key, s), traced + i, false, [&](const CausticLeg& leg) {
                        if (const std::size_t texel = receiver->texel(leg, nx, ny); texel < texels) {
                            found[s].push_back({texel, leg.flux});
                        }
                    });
                }
            }
        });
        if (context.should_stop()) {
            break; // some of the round is missing: the rounds before stand
        }
        for (std::size_t s = 0; s < kStreams; ++s) {
            for (const Share& share : found[s]) {
                sums[s][share.texel] += dvec3(share.flux);
            }
        }
        traced += count;
        if (settings.particles > 0) {
            context.progress("particles", double(traced) / double(wanted));
        }
    }
    if (traced == 0) {
        return fail("", "", "stopped before the first estimate", "Give it more time.");
    }
    const double area = glm::length(glm::cross(rectangle.u, rectangle.v)) / double(texels);
    for (std::size_t t = 0; t < texels; ++t) {
        dvec3 whole(0.0);
        for (const auto& stream : sums) {
            whole += stream[t];
        }
        const double scale = 1.0 / (area * double(traced));
        out.irradiance.emplace_back(whole * (scale / double(kStreams)));
        double squares = 0.0;
        for (const auto& stream : sums) {
            const double d = double(luminance(Rgb(stream[t] * scale))) - double(luminance(out.irradiance.back()));
            squares += d * d;
        }
        out.standard_error.push_back(std::sqrt(squares / (double(kStreams) * (kStreams - 1))));
    }
    out.particles = traced * kStreams;
    out.rays = rays.rays_traced();
    return out;
}

} // namespace atrium
