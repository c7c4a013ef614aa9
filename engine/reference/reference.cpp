#include "engine/reference/reference.h"

#include "engine/base/parallel.h"
#include "engine/reference/caustic_light.h"
#include "engine/reference/path_tracer.h"

#include <algorithm>
#include <functional>

namespace atrium {
namespace {

constexpr double kReach = 0.01; // metres: within it a point is put on the surface (CONTRACTS)

using Path = std::function<Rgb(std::size_t item, unsigned stream, PathSampler& sampler)>;
/// Called before each round, with the number of its paths per stream.
using Prepare = std::function<void(std::uint32_t paths)>;

/// Particles of a stream for each of its paths, and bounds of those in one round. A disc is small: it takes many to cross
/// it.
constexpr std::uint64_t kParticlesPerPath = 256;
constexpr std::uint64_t kLeastParticles = 1024;

constexpr float kRadiusOfPoints = 1e-3F; // of the scene's diagonal, where no radius is asked for
constexpr float kRadiusOfPictures = 3e-3F;

float caustic_radius(const ReferenceSettings& settings, const RayScene& rays, float share) {
    return settings.caustic_radius > 0.0F ? settings.caustic_radius : share * rays.bounds().diagonal();
}

/// Adds up independent streams of paths per item, in rounds.
class Estimator {
public:
    Estimator(std::size_t items, unsigned streams, Path path, Prepare prepare, const ReferenceSettings& settings)
        : items_(items), streams_(streams), path_(std::move(path)), prepare_(std::move(prepare)), settings_(settings),
          key_(hash_combine(0xA7121ULL, settings.seed)), sums_(items * streams, Rgb(0.0F)) {}

    /// False when it was stopped before every item had a first estimate.
    bool run(const RunContext& context, ReferenceRun& out);
    [[nodiscard]] Rgb mean(std::size_t item) const {
        dvec3 sum(0.0);
        for (unsigned s = 0; s < streams_; ++s) {
            sum += dvec3(sums_[item * streams_ + s]);
        }
        return Rgb(sum / (double(paths_) * streams_));
    }
    /// Of the luminance, from the spread of the streams' means.
    [[nodiscard]] double standard_error(std::size_t item) const {
        const double whole = luminance(mean(item));
        double squares = 0.0;
        for (unsigned s = 0; s < streams_; ++s) {
            const double d = double(luminance(Rgb(sums_[item * streams_ + s] / double(paths_)))) - whole;
            squares += d * d;
        }
        return std::sqrt(squares / (double(streams_) * (streams_ - 1)));
    }

private:
    [[nodiscard]] bool precise() const;
    bool round(std::uint32_t paths, const RunContext& context);

    std::size_t items_;
    unsigned streams_;
    Path path_;
    Prepare prepare_;
    ReferenceSettings settings_;
    std::uint64_t key_;
    std::vector<dvec3> sums_; ///< per item and stream
    std::uint32_t paths_ = 0; ///< per stream
};

bool Estimator::precise() const {
    double total = 0.0;
    for (std::size_t i = 0; i < items_; ++i) {
        total += luminance(mean(i));
    }
    const double floor = 0.01 * total / double(std::max<std::size_t>(items_, 1));
    for (std::size_t i = 0; i < items_; ++i) {
        if (standard_error(i) > settings_.relative_error * std::max(double(luminance(mean(i))), floor)) {
            return false;
        }
    }
    return true;
}

bool Estimator::round(std::uint32_t paths, const RunContext& context) {
    std::vector<dvec3> fresh(sums_.size(), dvec3(0.0));
    if (prepare_) {
        prepare_(paths);
    }
    parallel_chunks(sums_.size(), std::max<std::size_t>(32 / paths, 1), [&](std::size_t from, std::size_t to, std::size_t) {
        for (std::size_t w = from; w < to; ++w) {
            const std::size_t item = w / streams_;
            const std::uint64_t key = hash_combine(hash_combine(key_, item), w % streams_);
            for (std::uint32_t i = 0; i < paths; ++i) {
                if (context.should_stop()) {
                    return;
                }
                PathSampler sampler(key, paths_ + i);
                fresh[w] += dvec3(path_(item, unsigned(w % streams_), sampler));
            }
        }
    });
    if (context.should_stop()) {
        return false; // some of it is missing: the rounds before stand
    }
    for (std::size_t w = 0; w < sums_.size(); ++w) {
        sums_[w] += fresh[w];
    }
    paths_ += paths;
    return true;
}

bool Estimator::run(const RunContext& context, ReferenceRun& out) {
    if (items_ == 0) {
        out.reached = true;
        return true;
    }
    const auto begin = RunContext::Clock::now();
    // Few points get longer rounds, so that the work between two looks at the results is worth it.
    const std::size_t work = items_ * streams_;
    const auto least = std::uint32_t(std::clamp<std::size_t>(4096 / work, 1, 64));
    double fraction = 0.0;
    for (std::uint32_t rounds = 0; !out.reached; ++rounds) {
        std::uint32_t paths = std::max(least, std::min(paths_ / 8U, 64U));
        if (settings_.paths > 0) {
            const std::uint64_t wanted = (settings_.paths + streams_ - 1) / streams_;
            paths = std::uint32_t(std::min<std::uint64_t>(paths, wanted - paths_));
            fraction = std::max(fraction, double(paths_) / double(wanted));
        }
        if (context.deadline != RunContext::Clock::time_point::max()) {
            const double spent = std::chrono::duration<double>(RunContext::Clock::now() - begin).count();
            const double whole = std::chrono::duration<double>(context.deadline - begin).count();
            fraction = std::clamp(spent / std::max(whole, 1e-9), fraction, 1.0);
        }
        context.progress("paths", fraction);
        if (!round(paths, context)) {
            break;
        }
        out.reached = settings_.paths > 0 && std::uint64_t(paths_) * streams_ >= settings_.paths;
        // Not looked at after every round: an estimate that is watched all the time is caught at its luckiest.
        if (settings_.relative_error > 0.0 && paths_ >= 32 && rounds % 8 == 7) {
            out.reached = out.reached || precise();
        }
    }
    out.paths = std::uint64_t(paths_) * streams_;
    return paths_ > 0;
}

Error stopped_too_soon() {
    return {"", "", "stopped before the first estimate", "Give it more time, or ask for fewer points or pixels."};
}

Result<void> check(const ReferenceSettings& settings, const RunContext& context) {
    if (settings.paths == 0 && !(settings.relative_error > 0.0) &&
        context.deadline == RunContext::Clock::time_point::max()) {
        return fail("", "", "nothing says when the reference is good enough",
                    "Give a time limit, an error or a number of paths.");
    }
    return {};
}

/// The vertex for a point: on the nearest diffuse surface within reach that faces the same way, else in free space.
PathVertex place(const RayScene& rays, const ReferencePoint& point, bool& on_surface) {
    const vec3 n(glm::normalize(point.normal));
    const vec3 p(point.position - rays.origin());
    PathVertex vertex{p, n};
    on_surface = false;
    double best = kReach;
    Ray ray{p + n * float(kReach), -n, float(2.0 * kReach)};
    const vec3 start = ray.origin;
    for (Hit hit = rays.nearest(ray); hit; hit = rays.nearest(ray)) {
        const auto t = rays.triangle(hit.surface, hit.triangle);
        const vec3 at = t[0] + (t[1] - t[0]) * hit.barycentric.x + (t[2] - t[0]) * hit.barycentric.y;
        const vec3 side = hit.front ? hit.geometric_normal : -hit.geometric_normal;
        const double distance = glm::length(at - p);
        const bool has_light = hit.front || rays.surfaces()[hit.surface].back_side;
        if (has_light && distance < best && glm::dot(side, n) >= 0.7F && !is_specular(rays.material(hit.surface))) {
            best = distance;
            vertex.origin = clear_of(at, side);
            on_surface = true;
        }
        ray.origin = clear_of(at, ray.direction);
        ray.tmax = float(2.0 * kReach) - glm::length(ray.origin - start);
        if (!(ray.tmax > 0.0F)) {
            break;
        }
    }
    return vertex;
}

} // namespace

Result<ReferenceReadings> reference_irradiance(const Scene& scene, const std::vector<ReferencePoint>& points,
                                               const ReferenceSettings& settings, const RunContext& context) {
    if (auto fine = check(settings, context); !fine) {
        return tl::unexpected(fine.error());
    }
    const RayScene rays(scene, context);
    if (context.should_stop()) {
        return tl::unexpected(stopped_too_soon());
    }
    const PathTracer tracer(scene, rays);
    ReferenceReadings out;
    out.points.resize(points.size());
    std::vector<PathVertex> vertices(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        vertices[i] = place(rays, points[i], out.points[i].on_surface);
    }
    constexpr unsigned kStreams = 16;
    const float radius = caustic_radius(settings, rays, kRadiusOfPoints);
    std::vector<CausticDisc> discs;
    std::vector<vec3> places;
    for (const PathVertex& v : vertices) {
        discs.push_back({v.origin, v.normal});
        places.push_back(v.origin);
    }
    const LightTracer particles(rays, tracer.lights(), LightTracer::Emitters::Small, places, radius);
    const DiscTree tree(discs, radius);
    std::vector<std::vector<Rgb>> caustics(kStreams, std::vector<Rgb>(points.size(), Rgb(0.0F)));
    std::uint64_t traced = 0;
    const Prepare prepare = [&](std::uint32_t paths) {
        const std::uint64_t count = std::max(kLeastParticles, paths * kParticlesPerPath);
        parallel_chunks(kStreams, 1, [&](std::size_t from, std::size_t to, std::size_t) {
            for (std::size_t s = from; s < to && !context.should_stop(); ++s) {
                const std::uint64_t key = hash_combine(hash_combine(0xCA57ULL, settings.seed), s);
                caustics[s] = caustic_light_on(tree, rays, particles, {key, traced, count}, context);
            }
        });
        traced += count;
    };
    Estimator estimator(
        points.size(), kStreams,
        [&](std::size_t i, unsigned stream, PathSampler& sampler) {
            return tracer.irradiance(vertices[i], sampler) + caustics[stream][i];
        },
        particles.useful() ? prepare : Prepare{}, settings);
    if (!estimator.run(context, out.run)) {
        return tl::unexpected(stopped_too_soon());
    }
    out.run.rays = rays.rays_traced();
    for (std::size_t i = 0; i < points.size(); ++i) {
        out.points[i].irradiance = estimator.mean(i);
        out.points[i].standard_error = estimator.standard_error(i);
    }
    return out;
}

Result<ReferencePicture> reference_picture(const Scene& scene, const ReferenceView& view, const ReferenceSettings& settings,
                                           const RunContext& context) {
    if (auto fine = check(settings, context); !fine) {
        return tl::unexpected(fine.error());
    }
    const RayScene rays(scene, context);
    if (context.should_stop()) {
        return tl::unexpected(stopped_too_soon());
    }
    const PathTracer tracer(scene, rays);
    ReferencePicture out;
    const int width = std::max(view.width, 1);
    const int height = std::max(view.height, 1);
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    const vec3 eye(dvec3(view.to_world[3]) - rays.origin());
    const vec3 right(glm::normalize(dvec3(view.to_world[0])));
    const vec3 up(glm::normalize(dvec3(view.to_world[1])));
    const vec3 forward(-glm::normalize(dvec3(view.to_world[2])));
    const float half_height = view.lens.perspective ? std::tan(0.5F * view.lens.yfov) : view.lens.ymag;
    const float half_width = half_height * float(width) / float(height);
    constexpr unsigned kStreams = 8; // of a pixel: a first, noisy picture comes after as many paths
    const LightTracer particles(rays, tracer.lights(), LightTracer::Emitters::Small);
    const float radius = caustic_radius(settings, rays, kRadiusOfPictures);
    std::vector<CausticMap> caustics(kStreams);
    std::uint64_t traced = 0;
    const Prepare prepare = [&](std::uint32_t) {
        constexpr std::uint64_t kPhotons = 1U << 16U;
        parallel_chunks(kStreams, 1, [&](std::size_t from, std::size_t to, std::size_t) {
            for (std::size_t s = from; s < to && !context.should_stop(); ++s) {
                const std::uint64_t key = hash_combine(hash_combine(0xCA57ULL, settings.seed), s);
                caustics[s] = CausticMap(radius, particles, {key, traced, kPhotons}, context);
            }
        });
        traced += kPhotons;
    };
    Estimator estimator(
        pixels, kStreams,
        [&](std::size_t i, unsigned stream, PathSampler& sampler) {
            const vec4 u = sampler.next4();
            const float x = (2.0F * (float(i % std::size_t(width)) + u.x) / float(width) - 1.0F) * half_width;
            const float y = (1.0F - 2.0F * (float(i / std::size_t(width)) + u.y) / float(height)) * half_height;
            const Ray ray = view.lens.perspective ? Ray{eye, glm::normalize(forward + x * right + y * up)}
                                                  : Ray{eye + x * right + y * up, forward};
            return tracer.radiance(ray, sampler,
                                   [&](const PathVertex& v) { return caustics[stream].irradiance(v.origin, v.normal); });
        },
        particles.useful() ? prepare : Prepare{}, settings);
    if (!estimator.run(context, out.run)) {
        return tl::unexpected(stopped_too_soon());
    }
    out.run.rays = rays.rays_traced();
    out.radiance.width = width;
    out.radiance.height = height;
    for (std::size_t i = 0; i < pixels; ++i) {
        out.radiance.pixels.push_back(estimator.mean(i));
        out.standard_error.push_back(float(estimator.standard_error(i)));
    }
    return out;
}

} // namespace atrium
