#include "tests/bench/accuracy_reference.h"

#include "engine/base/rng.h"
#include "engine/raycast/ray_scene.h"
#include "engine/reference/lit_places.h"
#include "engine/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <numeric>
#include <sstream>

namespace atrium::bench {
namespace {

namespace fs = std::filesystem;

// ---- places ----

/// A node's name without the comma that would end its cell.
std::string csv_name(const Scene& scene, NodeId id) {
    std::string name = scene.nodes.find(id)->name;
    std::replace(name.begin(), name.end(), ',', ';');
    return name;
}

/// Area-weighted random places; the same for the same scene and count.
std::vector<Probe> pick_probes(const Scene& scene, std::size_t count) {
    const RayScene rays(scene);
    const PathTracer tracer(scene, rays);
    std::vector<Probe> out;
    for (const LitPlace& place : lit_places(rays, tracer, count, 5U)) {
        Probe probe;
        probe.place = {place.position, place.normal};
        probe.node = csv_name(scene, place.node);
        probe.seen = place.seen();
        out.push_back(probe);
    }
    return out;
}

// ---- the reference and its cache ----

std::uint64_t hash_file(const fs::path& path, std::uint64_t hash) {
    std::ifstream in(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    for (const char c : bytes) { // FNV-1a
        hash = (hash ^ std::uint8_t(c)) * 0x100000001B3ULL;
    }
    return hash;
}

/// Of the scene file and, for .gltf, of everything that lies beside it.
std::uint64_t hash_scene(const fs::path& path) {
    std::vector<fs::path> files{path};
    if (path.extension() == ".gltf") {
        for (const auto& entry : fs::directory_iterator(path.parent_path())) {
            const std::string extension = entry.path().extension().string();
            if (extension == ".bin" || extension == ".png" || extension == ".jpg") {
                files.push_back(entry.path());
            }
        }
        std::sort(files.begin() + 1, files.end());
    }
    std::uint64_t hash = 0xCBF29CE484222325ULL;
    for (const fs::path& file : files) {
        hash = hash_file(file, hash);
    }
    return hash;
}

std::string to_csv(const Reference& reference) {
    std::string out = "x,y,z,nx,ny,nz,E_r,E_g,E_b,E,stderr,on_surface,node,paths,runs,seen\n";
    for (const Probe& p : reference.probes) {
        const dvec3& at = p.place.point;
        const dvec3& n = p.place.normal;
        out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},1,{},{},{},{}\n", at.x, at.y, at.z, n.x, n.y, n.z,
                           p.irradiance.r, p.irradiance.g, p.irradiance.b, luminance(p.irradiance), p.standard_error, p.node,
                           reference.paths, reference.runs, p.seen ? 1 : 0);
    }
    return out;
}

/// Reads a cache; false when it is absent or not one of ours.
bool read_cache(const fs::path& path, Reference& out) {
    std::ifstream in(path);
    std::string line;
    if (!in || !std::getline(in, line) || line.rfind("x,y,z,nx", 0) != 0) {
        return false;
    }
    while (std::getline(in, line)) {
        std::vector<std::string> cells;
        std::stringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');) {
            cells.push_back(cell);
        }
        if (cells.size() != 16) {
            return false;
        }
        const auto number = [&](std::size_t k) {
            double value = 0;
            std::from_chars(cells[k].data(), cells[k].data() + cells[k].size(), value);
            return value;
        };
        Probe p;
        p.place = {{number(0), number(1), number(2)}, {number(3), number(4), number(5)}};
        p.irradiance = {float(number(6)), float(number(7)), float(number(8))};
        p.standard_error = number(10);
        p.node = cells[12];
        p.seen = number(15) != 0.0;
        out.paths = number(13);
        out.runs = unsigned(number(14));
        out.probes.push_back(p);
    }
    return !out.probes.empty();
}

/// Adds one more run with a seed of its own. Runs are weighted by their paths, not by what they say of their error.
bool add_run(const Scene& scene, Reference& reference, const ReferenceOptions& a) {
    std::vector<ReferencePoint> points;
    for (const Probe& p : reference.probes) {
        points.push_back({p.place.point, p.place.normal});
    }
    ReferenceSettings settings;
    settings.seed = 1000 + reference.runs;
    RunContext context;
    context.deadline = RunContext::Clock::now() +
                       std::chrono::duration_cast<RunContext::Clock::duration>(std::chrono::duration<double>(a.time));
    const auto result = reference_irradiance(scene, points, settings, context);
    if (!result) {
        fmt::print(stderr, "{}\n", result.error().message());
        return false;
    }
    const auto fresh = double(result->run.paths);
    const double share = fresh / (fresh + reference.paths);
    for (std::size_t i = 0; i < points.size(); ++i) {
        Probe& p = reference.probes[i];
        const ReferenceReading& r = result->points[i];
        p.irradiance = p.irradiance * float(1.0 - share) + r.irradiance * float(share);
        p.standard_error = std::hypot(p.standard_error * (1.0 - share), r.standard_error * share);
    }
    reference.paths += fresh;
    ++reference.runs;
    return true;
}

} // namespace

void drop_dark(std::vector<Probe>& probes) {
    std::erase_if(probes, [](const Probe& probe) { return probe.irradiance == Rgb(0.0F); });
}

bool get_reference(const fs::path& file, const Scene& scene, bool daylight, const ReferenceOptions& a, Reference& out) {
    const fs::path cache = a.cache.empty()
                               ? fs::path()
                               : fs::path(a.cache) / fmt::format("{}-{:016x}-{}{}-diffuse.csv", file.stem().string(),
                                                                 hash_scene(file), a.points, daylight ? "-daylight" : "");
    const bool known = !cache.empty() && read_cache(cache, out);
    if (!known) {
        out = {};
        out.probes = pick_probes(scene, a.points);
        if (out.probes.empty()) {
            fmt::print(stderr, "{}: no diffuse surface that light can reach\n", file.string());
            return false;
        }
    }
    if (known && !a.extend) {
        return true;
    }
    if (!add_run(scene, out, a)) {
        return known;
    }
    if (!cache.empty()) {
        const fs::path temporary = cache.string() + ".tmp";
        std::ofstream(temporary) << to_csv(out);
        fs::rename(temporary, cache);
    }
    return true;
}

Row compare(const std::vector<Probe>& probes, const std::vector<SensorReading>& readings, std::vector<double>& relative) {
    Row row;
    double mean = 0.0;
    for (const Probe& p : probes) {
        mean += luminance(p.irradiance) / double(probes.size());
    }
    const double floor = 0.05 * mean;
    relative.assign(probes.size(), 0.0);
    std::vector<double> squares;
    std::vector<double> sizes;
    double sum = 0.0;
    double reference_sum = 0.0;
    double variance = 0.0;
    double noise2 = 0.0;
    for (std::size_t i = 0; i < probes.size(); ++i) {
        row.unread += readings[i].on_surface ? 0 : 1;
        const double r = luminance(probes[i].irradiance);
        const double e = luminance(readings[i].irradiance);
        const double scale = std::max(r, floor);
        relative[i] = scale > 0.0 ? (e - r) / scale : (e > 0.0 ? 1.0 : 0.0);
        const double noise = scale > 0.0 ? probes[i].standard_error / scale : 0.0;
        squares.push_back(relative[i] * relative[i] - noise * noise);
        sizes.push_back(std::abs(relative[i]));
        noise2 += noise * noise;
        variance += probes[i].standard_error * probes[i].standard_error;
        sum += e;
        reference_sum += r;
    }
    row.points = sizes.size();
    if (sizes.empty()) {
        return row;
    }
    const auto n = double(sizes.size());
    const double square = std::accumulate(squares.begin(), squares.end(), 0.0) / n;
    double spread = 0.0;
    for (const double s : squares) {
        spread += (s - square) * (s - square);
    }
    row.rms = std::sqrt(std::max(square, 0.0));
    double seen = 0.0;
    double seen_count = 0.0;
    for (std::size_t i = 0; i < probes.size(); ++i) {
        seen += probes[i].seen ? squares[i] : 0.0;
        seen_count += probes[i].seen ? 1.0 : 0.0;
    }
    row.rms_seen = seen_count > 0.0 ? std::sqrt(std::max(seen / seen_count, 0.0)) : 0.0;
    row.rms_spread = std::sqrt(spread) / n / (2.0 * std::max(row.rms, 1e-3));
    row.bias = reference_sum > 0.0 ? (sum - reference_sum) / reference_sum : 0.0;
    row.reference_bias = reference_sum > 0.0 ? std::sqrt(variance) / reference_sum : 0.0;
    row.noise = std::sqrt(noise2 / n);
    std::sort(sizes.begin(), sizes.end());
    const auto percentile = [&](double p) { return sizes[std::min(std::size_t(p * n), sizes.size() - 1)]; };
    row.p50 = percentile(0.50);
    row.p95 = percentile(0.95);
    row.p99 = percentile(0.99);
    return row;
}

} // namespace atrium::bench
