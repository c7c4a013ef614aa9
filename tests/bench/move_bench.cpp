// Moving objects in a ray scene: microseconds of a move, and what it costs the rays afterwards.
#include "tests/bench/bench_support.h"
#include "tests/support/rooms.h"

#include "engine/base/rng.h"
#include "engine/raycast/ray_scene.h"

#include <algorithm>
#include <chrono>
#include <numeric>

namespace {

using namespace atrium;

constexpr int kObjects = 400;
constexpr int kLaterMoves = 200;
constexpr std::uint32_t kRays = 1U << 17;
constexpr int kRounds = 7; // of each measurement in turn; the best counts
constexpr std::uint32_t kSeed = 0x3407EU;

/// A hall with spheres of about 450 triangles each.
Scene crowded_hall(std::vector<NodeId>& objects) {
    constexpr std::uint32_t kRings = 15;
    constexpr std::uint32_t kSides = 15;
    Scene scene;
    const MaterialId grey = test::add_material(scene, 0.5F);
    test::add_room(scene, 20, 4, 20, grey);
    auto mesh = std::make_shared<MeshData>();
    for (std::uint32_t i = 0; i <= kRings; ++i) { // open at its poles
        for (std::uint32_t k = 0; k < kSides; ++k) {
            const float down = kPi * (0.03F + 0.94F * float(i) / kRings);
            const float around = 2.0F * kPi * float(k) / float(kSides);
            mesh->positions.push_back(
                0.3F * vec3(std::sin(down) * std::cos(around), std::cos(down), std::sin(down) * std::sin(around)));
            if (i < kRings) {
                const std::uint32_t a = kSides * i + k;
                const std::uint32_t b = kSides * i + (k + 1) % kSides;
                mesh->indices.insert(mesh->indices.end(), {a, b, b + kSides, a, b + kSides, a + kSides});
            }
        }
    }
    mesh->parts = {{0, std::uint32_t(mesh->indices.size())}};
    Shape shape;
    shape.geometry = Mesh{mesh};
    const ShapeId id = scene.shapes.insert(shape);
    for (int i = 0; i < kObjects; ++i) {
        Node node;
        node.name = fmt::format("object {}", i);
        node.shape = id;
        node.materials = {grey};
        node.transform.translation = {0.6 + 0.98 * (i % 20), 0.4 + 0.4 * (i % 7), 0.6 + 0.98 * (i / 20)};
        scene.roots.push_back(scene.nodes.insert(node));
        objects.push_back(scene.roots.back());
    }
    return scene;
}

struct Segment {
    vec3 from{0.0F};
    vec3 to{0.0F};
};

/// Between points all over the scene, and just off its surfaces.
std::vector<Segment> segments(const RayScene& rays) {
    std::vector<Segment> out;
    const Box3 bounds = rays.bounds();
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const vec2 a = sobol_owen2(i, 0, kSeed);
        const vec2 b = sobol_owen2(i, 2, kSeed);
        const vec2 c = sobol_owen2(i, 0, kSeed + 1);
        const vec3 from = bounds.min + bounds.size() * vec3(a, b.x);
        const vec3 to = bounds.min + bounds.size() * vec3(b.y, c);
        const Hit start = rays.nearest({from, glm::normalize(to - from)});
        out.push_back({start ? from + glm::normalize(to - from) * (0.999F * start.t) : from,
                       bounds.min + bounds.size() * vec3(c.y, a)});
    }
    return out;
}

struct Rates {
    double nearest = 0.0;
    double transmittance = 0.0;
    double sky = 0.0;
};

/// Million rays a second of processor time, one thread.
Rates rates(const RayScene& rays, const std::vector<Segment>& segments) {
    float sum = 0.0F;
    const auto measure = [&](const auto& body) {
        const double before = bench::cpu_seconds();
        body();
        return double(kRays) / (bench::cpu_seconds() - before) / 1e6;
    };
    Rates out;
    out.nearest = measure([&] {
        for (const Segment& s : segments) {
            sum += rays.nearest({s.from, glm::normalize(s.to - s.from)}).t;
        }
    });
    out.transmittance = measure([&] {
        for (const Segment& s : segments) {
            sum += rays.transmittance(s.from, s.to).r;
        }
    });
    out.sky = measure([&] {
        std::vector<vec3> directions(64);
        std::vector<SkyRay> seen(64);
        for (std::uint32_t k = 0; k < 64; ++k) {
            const vec2 u = sobol_owen2(k, 0, kSeed);
            const float r = std::sqrt(1.0F - u.x * u.x);
            directions[k] = {r * std::cos(2.0F * kPi * u.y), u.x, r * std::sin(2.0F * kPi * u.y)};
        }
        for (std::size_t i = 0; i < segments.size(); i += 64) {
            rays.look_at_sky(segments[i].from, directions, seen);
            sum += seen[0].through.r;
        }
    });
    asm volatile("" : : "g"(&sum) : "memory");
    return out;
}

struct Contestant {
    std::string name;
    const RayScene* rays = nullptr;
    Rates best{};
};

void print_rates(const std::string& scene, std::vector<Contestant> all) {
    const std::vector<Segment> some = segments(*all.front().rays);
    for (int round = 0; round < kRounds; ++round) {
        for (Contestant& c : all) {
            const Rates r = rates(*c.rays, some);
            c.best = {std::max(c.best.nearest, r.nearest), std::max(c.best.transmittance, r.transmittance),
                      std::max(c.best.sky, r.sky)};
        }
    }
    const Rates& base = all.front().best;
    for (const Contestant& c : all) {
        fmt::print("| {:<12} | {:<32} | {:.2f} ({:+.1f} %) | {:.2f} ({:+.1f} %) | {:.2f} ({:+.1f} %) | {:.1f} |\n", scene,
                   c.name, c.best.nearest, 100.0 * (c.best.nearest / base.nearest - 1.0), c.best.transmittance,
                   100.0 * (c.best.transmittance / base.transmittance - 1.0), c.best.sky,
                   100.0 * (c.best.sky / base.sky - 1.0), double(c.rays->memory_bytes()) / 1e6);
    }
}

/// Wall-clock microseconds.
double timed_move(RayScene& rays, const Scene& scene) {
    const auto start = std::chrono::steady_clock::now();
    const auto moved = rays.move_to(scene);
    const double out = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    if (!moved || moved->empty()) {
        fmt::print(stderr, "a move was refused\n");
    }
    return out;
}

double part_of(std::vector<double> values, double part) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[std::size_t(part * double(values.size() - 1))];
}

void shift(Scene& scene, NodeId node, int step) {
    Transform& t = scene.nodes.find(node)->transform;
    t.translation += dvec3(0.01, 0.002, -0.005) * (step % 40 < 20 ? 1.0 : -1.0);
    t.rotation = glm::normalize(glm::angleAxis(0.05, dvec3(0.0, 1.0, 0.0)) * t.rotation);
}

void print_moves() {
    std::vector<NodeId> objects;
    Scene scene = crowded_hall(objects);
    const auto start = std::chrono::steady_clock::now();
    RayScene rays(scene);
    const double build = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    std::vector<double> first;
    std::vector<double> later;
    for (const int object : {210, 47, 388, 121, 5}) {
        for (int step = 0; step <= kLaterMoves; ++step) {
            shift(scene, objects[std::size_t(object)], step);
            (step == 0 ? first : later).push_back(timed_move(rays, scene));
        }
    }
    fmt::print("{} objects, {} triangles, built in {:.0f} us. One object moves, five in turn:\n", objects.size(),
               rays.triangle_count(), build);
    fmt::print("first moves {:.0f} us (median; {:.0f} at most), later ones {:.0f} us (p95 {:.0f}, {:.0f} at most)\n\n",
               part_of(first, 0.5), part_of(first, 1.0), part_of(later, 0.5), part_of(later, 0.95), part_of(later, 1.0));
    std::vector<double> all;
    for (const NodeId object : objects) {
        shift(scene, object, 0);
        all.push_back(timed_move(rays, scene));
    }
    fmt::print("All {} once, one after the other: median {:.0f} us, mean {:.0f}, p95 {:.0f}, {:.0f} at most\n\n", all.size(),
               part_of(all, 0.5), std::accumulate(all.begin(), all.end(), 0.0) / double(all.size()), part_of(all, 0.95),
               part_of(all, 1.0));
}

void print_rates_after_moves(const std::string& name, const Scene& original, const std::vector<NodeId>& objects) {
    for (const std::size_t count : {1U, 5U, 20U}) {
        RayScene moved(original);
        Scene scene = original;
        for (std::size_t i = 0; i < std::min(count, objects.size()); ++i) {
            for (int step = 0; step < 10; ++step) {
                shift(scene, objects[(i + 1) * objects.size() / (count + 2)], step);
                timed_move(moved, scene);
            }
        }
        RayScene settled(original);
        timed_move(settled, scene);
        settled.settle();
        const RayScene fresh(scene);
        print_rates(name, {{fmt::format("{} elsewhere, built anew", count), &fresh},
                           {fmt::format("{} moved there", count), &moved},
                           {fmt::format("{} moved there, settled", count), &settled}});
    }
}

/// Shown nodes with shapes of less than a quarter of the whole.
std::vector<NodeId> things_in(const Scene& scene) {
    std::vector<NodeId> out;
    for (const NodeId id : scene.in_tree_order()) {
        const DBox3 box = scene.world_bounds(id);
        if (scene.shown(id) && !box.empty() && box.diagonal() < 0.25 * scene.bounds().diagonal()) {
            out.push_back(id);
        }
    }
    return out;
}

} // namespace

int main() {
    fmt::print("\n## Moving objects\n\n");
    print_moves();
    fmt::print("| scene | rays | nearest, Mrays/s | transmittance | sky by 8 | MB |\n|---|---|---|---|---|---|\n");
    std::vector<NodeId> objects;
    const Scene hall = crowded_hall(objects);
    print_rates_after_moves("hall", hall, objects);
    const auto sunlit = bench::read_lit_scene(ATRIUM_SOURCE_DIR "/scenes/sunlit_room/sunlit_room.gltf");
    if (!sunlit) {
        return 1;
    }
    print_rates_after_moves("sunlit room", sunlit->scene, things_in(sunlit->scene));
    return 0;
}
