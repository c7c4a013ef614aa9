#include "tests/bench/floor_bench.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/radiosity/indirect_gather.h"
#include "engine/radiosity/links.h"
#include "engine/radiosity/transport.h"
#include "engine/raycast/scene_charts.h"
#include "engine/solver/quality.h"
#include "tests/bench/bare_embree.h"
#include "tests/bench/bench_support.h"
#include "tests/bench/tessellated_room.h"

#include <algorithm>
#include <cstring>
#include <functional>

namespace atrium::bench {
namespace {

constexpr int kRounds = 5;                  // of each measurement in turn; the best counts
constexpr std::size_t kSegments = 1U << 17; // rays of one measurement
constexpr std::size_t kDirections = 64;     // from one point where a query takes many
constexpr float kClear = 2e-4F;             // metres that ray origins keep from their surface
constexpr std::uint32_t kPointSeed = 0xBE7C4U;

/// Least processor seconds of each of several measurements, taken in turn so that all see the same machine.
std::vector<double> least_seconds(const std::vector<std::function<void()>>& bodies) {
    std::vector<double> out(bodies.size(), std::numeric_limits<double>::infinity());
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const double before = cpu_seconds();
            bodies[i]();
            out[i] = std::min(out[i], cpu_seconds() - before);
        }
    }
    return out;
}

/// Keeps what is computed from being left out.
template <class T> void keep(T& value) { asm volatile("" : : "g"(&value) : "memory"); }

/// A room with elements, links and a solution, as the engine has it half way.
struct Room {
    Scene scene;
    RayScene rays{scene};
    QualitySettings quality = quality_settings(SolverSettings::Quality::Normal, rays.bounds().diagonal(), 0.0);
    Hierarchy hierarchy = build_hierarchy(rays, quality.hierarchy);

    explicit Room(Scene given) : scene(std::move(given)) {}
};

/// Points spread over all surfaces.
std::vector<SurfacePoint> points_on(const Room& room, std::size_t count) {
    std::vector<SurfacePoint> out;
    for (std::uint32_t i = 0; i < count; ++i) {
        SurfacePoint p = sample_point(room.hierarchy, room.rays, 0, sobol_owen2(i, 0, kPointSeed), false);
        out.push_back(p);
    }
    return out;
}

vec3 cosine_direction(const vec3& normal, const vec2& u) {
    vec3 t;
    vec3 b;
    make_frame(normal, t, b);
    const float r = std::sqrt(u.x);
    const float angle = 2.0F * kPi * u.y;
    return glm::normalize(r * std::cos(angle) * t + r * std::sin(angle) * b + std::sqrt(1.0F - u.x) * normal);
}

/// `each` cosine-weighted rays from every point, the same pattern everywhere, without end.
std::vector<BareRay> hemisphere_rays(const std::vector<SurfacePoint>& points, std::size_t each) {
    std::vector<BareRay> out;
    for (const SurfacePoint& p : points) {
        for (std::uint32_t k = 0; k < each; ++k) {
            out.push_back({p.position + p.normal * kClear, cosine_direction(p.normal, sobol_owen2(k, 2, kPointSeed)), 0.0F,
                           std::numeric_limits<float>::infinity()});
        }
    }
    return out;
}

/// From each point to one somewhere else.
std::vector<BareRay> segments_between(const std::vector<SurfacePoint>& points) {
    std::vector<BareRay> out;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const vec3& from = points[i].position;
        const vec3& to = points[hash64(i) % points.size()].position;
        const float length = glm::length(to - from);
        if (length > 4.0F * kClear) {
            out.push_back({from, (to - from) / length, kClear, length - kClear});
        }
    }
    return out;
}

void print_ray_row(const std::string& room, const char* query, const char* floor, std::size_t rays, double own,
                   double bare) {
    fmt::print("| {:<22} | {:<28} | {:<24} | {:>7.2f} | {:>7.2f} | {:>5.0f} % |\n", room, query, floor,
               double(rays) / own / 1e6, double(rays) / bare / 1e6, 100.0 * bare / own);
}

void print_rays_of(const std::string& name, Scene scene) {
    const Room room(std::move(scene));
    const BareEmbree embree(room.rays);
    const std::vector<BareRay> segments = segments_between(points_on(room, kSegments));
    const std::vector<SurfacePoint> few = points_on(room, kSegments / kDirections);
    const std::vector<BareRay> fans = hemisphere_rays(few, kDirections);
    const auto all_nearest = [&](const std::vector<BareRay>& rays) {
        for (const BareRay& r : rays) {
            Hit hit = room.rays.nearest({r.origin, r.direction, r.tfar});
            keep(hit);
        }
    };
    std::vector<vec3> directions(kDirections);
    std::vector<SkyRay> seen(kDirections);
    const std::vector<double> seconds = least_seconds({
        [&] { all_nearest(fans); },
        [&] {
            std::size_t hits = embree.nearest(fans);
            keep(hits);
        },
        [&] {
            for (const BareRay& r : segments) {
                Rgb through = room.rays.transmittance(r.origin, r.origin + r.direction * (r.tfar + kClear));
                keep(through);
            }
        },
        [&] {
            for (const BareRay& r : segments) {
                bool blocked = room.rays.occluded(r.origin, r.origin + r.direction * (r.tfar + kClear));
                keep(blocked);
            }
        },
        [&] {
            std::size_t hits = embree.occluded(segments);
            keep(hits);
        },
        [&] {
            for (std::size_t first = 0; first < fans.size(); first += kDirections) {
                for (std::size_t k = 0; k < kDirections; ++k) {
                    directions[k] = fans[first + k].direction;
                }
                room.rays.look_at_sky(fans[first].origin, directions, seen);
                keep(seen[0]);
            }
        },
        [&] {
            std::size_t hits = embree.occluded_by_8(fans);
            keep(hits);
        },
    });
    print_ray_row(name, "nearest, hemisphere", "rtcIntersect1", fans.size(), seconds[0], seconds[1]);
    print_ray_row(name, "transmittance, segments", "rtcOccluded1, opaque only", segments.size(), seconds[2], seconds[4]);
    print_ray_row(name, "occluded, segments", "rtcOccluded1, opaque only", segments.size(), seconds[3], seconds[4]);
    print_ray_row(name, "look_at_sky, hemisphere", "rtcOccluded8, opaque only", fans.size(), seconds[5], seconds[6]);
    std::fflush(stdout);
}

/// Processor seconds of `body`, the least of kRounds; `before_each` is not counted.
double least_seconds_of(const std::function<void()>& before_each, const std::function<void()>& body) {
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
        before_each();
        const double before = cpu_seconds();
        body();
        least = std::min(least, cpu_seconds() - before);
    }
    return least;
}

void print_step(const std::string& room, const std::string& step, const std::string& rate, const std::string& against) {
    fmt::print("| {:<22} | {:<26} | {:<52} | {:<52} |\n", room, step, rate, against);
    std::fflush(stdout);
}

/// Links from the root pair to the quality's threshold, with radiosities of the emitters alone and then of a solution.
LinkSet print_links(const std::string& name, Room& room, double bare_occluded_rate) {
    for (Element& e : room.hierarchy.elements) {
        e.radiosity = e.emitted;
    }
    room.hierarchy.pull_radiosity();
    LinkSet links(room.hierarchy);
    double seconds = 0.0;
    std::size_t made = 0;
    const std::uint64_t rays_before = room.rays.rays_traced();
    for (int round = 0; round < 2; ++round) {
        const double before = cpu_seconds();
        made += links.refine(room.hierarchy, room.rays, room.quality.refine, RunContext{});
        seconds += cpu_seconds() - before;
        Transport transport(room.hierarchy, links.links());
        transport.close_rows(std::vector<std::uint8_t>(transport.leaves().size(), 1));
        solve_radiosity(room.hierarchy, transport, room.quality.solver_tolerance, room.quality.max_iterations, RunContext{});
    }
    const double rays = double(room.rays.rays_traced() - rays_before);
    print_step(name, "links: refine",
               fmt::format("{:.0f} links/s ({} made, {:.1f} rays each)", double(made) / seconds, made, rays / double(made)),
               fmt::format("{:.2f} Mrays/s: {:.0f} % of rtcOccluded1", rays / seconds / 1e6,
                           100.0 * rays / seconds / bare_occluded_rate));
    return links;
}

/// One sweep against a copy of as many bytes as it cannot avoid to touch.
void print_sweep(const std::string& name, Room& room, const LinkSet& links) {
    Transport transport(room.hierarchy, links.links());
    const std::vector<Rgb> in(transport.leaves().size(), Rgb(1.0F));
    std::vector<Rgb> out;
    const Hierarchy& h = room.hierarchy;
    const std::size_t bytes = transport.memory_bytes() + h.elements.size() * sizeof(Element) +
                              h.harmonics.size() * sizeof(Harmonics) + 2 * in.size() * sizeof(Rgb);
    const std::vector<char> from(bytes / 2, 1); // a copy reads one half and writes the other
    std::vector<char> to(bytes / 2);
    const auto repeats = int(std::clamp<std::size_t>((std::size_t(256) << 20U) / bytes, 2, 200));
    const std::vector<double> seconds = least_seconds({
        [&] {
            for (int i = 0; i < repeats; ++i) {
                transport.apply(in, out);
            }
        },
        [&] {
            for (int i = 0; i < repeats; ++i) {
                std::memcpy(to.data(), from.data(), to.size());
                keep(to[0]);
            }
        },
    });
    const double total = double(bytes) * repeats;
    print_step(name, "gather: Transport::apply",
               fmt::format("{:.1f} M links/s, {:.2f} GB/s of {:.1f} MB",
                           double(links.links().size()) * repeats / seconds[0] / 1e6, total / seconds[0] / 1e9,
                           double(bytes) / 1e6),
               fmt::format("memcpy {:.2f} GB/s: {:.0f} % of it", total / seconds[1] / 1e9, 100.0 * seconds[1] / seconds[0]));
}

/// Reflected light at points, against the bare rays of as many hemispheres.
void print_hemispheres(const std::string& name, Room& room, double bare_nearest_rate) {
    const IndirectGather gather(room.hierarchy, room.rays, bright_leaves(room.hierarchy, {}, room.quality.bright_contrast));
    const std::vector<SurfacePoint> points = points_on(room, 2048);
    std::uint64_t rays = 0;
    const double seconds =
        least_seconds_of([&] { rays = room.rays.rays_traced(); },
                         [&] {
                             for (const SurfacePoint& p : points) {
                                 FieldSample sample = gather.irradiance(p.position, p.normal, room.quality.field.reflected);
                                 keep(sample);
                             }
                         });
    const auto traced = double(room.rays.rays_traced() - rays);
    print_step(
        name, "hemispheres: IndirectGather",
        fmt::format("{:.0f} points/s, {:.0f} rays each", double(points.size()) / seconds, traced / double(points.size())),
        fmt::format("{:.2f} Mrays/s: {:.0f} % of rtcIntersect1", traced / seconds / 1e6,
                    100.0 * traced / seconds / bare_nearest_rate));
}

/// Light maps of the sun and point lamps, of emitting surfaces and of the sky, each by itself.
void print_direct(const std::string& name, const Room& room, double bare_occluded_rate) {
    const DirectLight lights(room.scene, room.rays);
    const Hierarchy emitters =
        only_flagged(room.hierarchy, named_emitters(room.hierarchy, {}, room.quality.emitter_contrast), true);
    const PointGather lamps(emitters, room.rays);
    const std::vector<SurfaceCharts> charts = chart_surfaces(room.rays, room.quality.charts);
    const GatherSettings& wanted = room.quality.field.direct;
    struct Part {
        const char* name;
        bool present;
        DirectPart part;
    };
    const bool shine = std::any_of(emitters.elements.begin(), emitters.elements.end(),
                                   [](const Element& e) { return max_component(e.emitted) > 0.0F; });
    const Part parts[] = {
        {"direct: sun, point lamps",
         !lights.lights().empty(),
         {[&](const vec3& p, const vec3& n) { return lights.lamps_irradiance(p, n, wanted.sun_rays); }, false}},
        {"direct: emitting surfaces",
         shine,
         {[&](const vec3& p, const vec3& n) { return lamps.irradiance(p, n, wanted); }, false}},
        {"direct: sky",
         lights.has_sky(),
         {[&](const vec3& p, const vec3& n) { return lights.sky_irradiance(p, n, wanted.sky_rays); }, true}},
    };
    for (const Part& part : parts) {
        if (!part.present) {
            continue;
        }
        DirectMapSettings settings = room.quality.maps;
        const std::uint64_t rays_before = room.rays.rays_traced();
        const double before = cpu_seconds();
        const DirectMaps maps = build_direct_maps(
            room.rays, charts, std::span(&part.part, 1),
            [&](std::uint32_t surface) { return room.rays.surfaces()[surface].back_side; }, settings, RunContext{}, 0.0,
            1.0);
        const double seconds = cpu_seconds() - before;
        const auto rays = double(room.rays.rays_traced() - rays_before);
        print_step(name, part.name,
                   fmt::format("{:.0f} evaluations/s ({} for {} texels, {:.1f} rays each)",
                               double(maps.evaluations) / seconds, maps.evaluations, maps.samples,
                               rays / double(std::max<std::size_t>(maps.evaluations, 1))),
                   fmt::format("{:.2f} Mrays/s: {:.0f} % of rtcOccluded1", rays / seconds / 1e6,
                               100.0 * rays / seconds / bare_occluded_rate));
    }
}

void print_steps_of(const std::string& name, Scene scene) {
    Room room(std::move(scene));
    const BareEmbree embree(room.rays);
    const std::vector<BareRay> segments = segments_between(points_on(room, kSegments));
    const std::vector<BareRay> fans = hemisphere_rays(points_on(room, kSegments / kDirections), kDirections);
    const std::vector<double> bare = least_seconds({
        [&] {
            std::size_t hits = embree.occluded(segments);
            keep(hits);
        },
        [&] {
            std::size_t hits = embree.nearest(fans);
            keep(hits);
        },
    });
    const double occluded_rate = double(segments.size()) / bare[0];
    print_direct(name, room, occluded_rate);
    const LinkSet links = print_links(name, room, occluded_rate);
    print_sweep(name, room, links);
    print_hemispheres(name, room, double(fans.size()) / bare[1]);
}

/// Both rooms and, where it can be read, the scene that ships.
template <class F> void for_each_room(const std::string& shipped_scene, const std::vector<std::size_t>& sizes, F&& print) {
    set_thread_limit(1);
    for (const std::size_t triangles : sizes) {
        print(fmt::format("room of {}", triangles), tessellated_room(triangles));
    }
    if (auto shipped = read_lit_scene(shipped_scene)) {
        print("shipped scene", std::move(shipped->scene));
    }
}

} // namespace

void print_ray_floor(const std::string& shipped_scene) {
    fmt::print("| room | query | floor | Mrays/s | of the floor | share |\n|---|---|---|---|---|---|\n");
    for_each_room(shipped_scene, {1'000, 100'000}, print_rays_of);
}

void print_step_floor(const std::string& shipped_scene) {
    fmt::print("| room | step | rate | floor and share of it |\n|---|---|---|---|\n");
    for_each_room(shipped_scene, {1'000}, print_steps_of);
}

} // namespace atrium::bench
