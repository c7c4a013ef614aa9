// Direct light maps by themselves, part by part: samples, rays and processor time, and how far what they show is from what
// the same light is with many more rays.
#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/layers/covered_points.h"
#include "engine/optics/specular.h"
#include "engine/radiosity/leaf_surroundings.h"
#include "engine/radiosity/light_split.h"
#include "engine/radiosity/mirror_light.h"
#include "engine/raycast/scene_charts.h"
#include "engine/solver/quality.h"
#include "tests/bench/bench_support.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace atrium::bench {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::vector<std::string> files;
    std::string quality = "normal";
    std::size_t points = 2000;
    std::string cache;
    std::string only;
    bool first_picture = false;
    std::size_t worst = 0;
};

/// Time of this thread alone, seconds.
double thread_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// A part of the direct light and its cost so far; one thread.
struct Part {
    std::string name;
    DirectPart light;
    DirectFunction truth;
    std::size_t samples = 0;
    std::uint64_t rays = 0;
    double seconds = 0.0;
};

struct Point {
    std::uint32_t surface = 0;
    vec2 uv{0.0F};
    vec3 position{0.0F};
    vec3 normal{0.0F};
    bool back = false;
};

/// The sources of direct light of a scene as a solve has them.
class Bench {
public:
    Bench(const Scene& scene, const Arguments& a)
        : rays_(scene), punctual_(scene, rays_), mirrors_(rays_),
          quality_(quality_settings(qualities().at(a.quality), rays_.bounds().diagonal(), 0.0)) {
        hierarchy_ = build_hierarchy(rays_, quality_.hierarchy);
        const auto leaves = hierarchy_.leaves();
        mark_rooms(hierarchy_, leaves, look_around(hierarchy_, rays_, leaves, {quality_.leaf_rays, {}}, {}));
        const LeafFlags named = named_emitters(hierarchy_, hierarchy_.room, quality_.emitter_contrast);
        if (std::any_of(named.begin(), named.end(), [](std::uint8_t f) { return f != 0; })) {
            emitters_ = only_flagged(hierarchy_, named, true);
        }
        far_lamps_ = std::make_unique<FarFaces>(emitters_, rays_);
        lamps_ = std::make_unique<PointGather>(emitters_, rays_, nullptr, far_lamps_.get());
        lamps_closely_ = std::make_unique<PointGather>(emitters_, rays_);
        charts_ = chart_surfaces(rays_, quality_.charts);
        for (std::uint32_t i = 0; i < charts_.size(); ++i) {
            if (shows_no_irradiance(rays_.material(i))) {
                charts_[i] = {};
            }
        }
        settings_ = a.first_picture ? quality_.first_maps : quality_.maps;
        gather_ = (a.first_picture ? quality_.first_field : quality_.field).direct;
        best_ = {gather_.tolerance * 0.1F, 4000, 4096, 2048, 16384};
        pick_points(a.points);
    }

    void run(const std::string& name, const Arguments& a) {
        std::vector<Part> parts = make_parts();
        std::erase_if(parts, [&](const Part& p) { return !a.only.empty() && p.name != a.only; });
        std::vector<std::vector<float>> truth;
        std::vector<float> whole(points_.size(), 0.0F);
        for (const Part& p : parts) {
            truth.push_back(true_light(p, name, a));
            for (std::size_t i = 0; i < whole.size(); ++i) {
                whole[i] += truth.back()[i];
            }
        }
        settings_.light_floor = 0.05F * mean(whole);
        // What parts look like is judged beside the light of those before: one more at a time tells each one's own.
        std::vector<float> before(points_.size(), 0.0F);
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const std::vector<float> now = shown(parts, k + 1);
            std::vector<float> own(now.size());
            std::transform(now.begin(), now.end(), before.begin(), own.begin(), std::minus<>());
            print(name, parts[k], own, truth[k], mean(whole), a);
            print_evaluated(parts[k], truth[k], mean(whole));
            before = now;
        }
        fmt::print("| {} | all | | | | {:.2f} (cells and maps {:.2f}) | {} |\n", name, total_, total_ - in_light_,
                   errors(before, whole, mean(whole)));
        std::fflush(stdout);
    }

private:
    std::vector<Part> make_parts() {
        std::vector<Part> out;
        const auto add = [&](const char* name, const DirectFunction& now, const DirectFunction& truth, bool soft,
                             bool sharp) {
            out.push_back({name, {now, soft, sharp, {}}, truth});
        };
        if (!punctual_.lights().empty()) {
            add(
                "lamps", [this](const vec3& p, const vec3& n) { return punctual_.lamps_irradiance(p, n, gather_.sun_rays); },
                [this](const vec3& p, const vec3& n) { return punctual_.lamps_irradiance(p, n, best_.sun_rays); }, false,
                true);
        }
        if (!emitters_.empty()) {
            add(
                "emitters", [this](const vec3& p, const vec3& n) { return lamps_->irradiance(p, n, gather_); },
                [this](const vec3& p, const vec3& n) { return lamps_closely_->irradiance(p, n, best_); }, false, false);
        }
        if (!mirrors_.empty() && (!punctual_.lights().empty() || !emitters_.empty())) {
            add(
                "mirrors",
                [this](const vec3& p, const vec3& n) {
                    return mirrors_.irradiance(p, n, gather_, &punctual_, lamps_.get());
                },
                [this](const vec3& p, const vec3& n) { return mirrors_.irradiance(p, n, best_, &punctual_, lamps_.get()); },
                false, true);
        }
        if (punctual_.has_sky()) {
            add(
                "sky", [this](const vec3& p, const vec3& n) { return punctual_.sky_irradiance(p, n, gather_.sky_rays); },
                [this](const vec3& p, const vec3& n) { return punctual_.sky_irradiance(p, n, best_.sky_rays); }, true,
                false);
        }
        return out;
    }

    /// Places evenly over all charted sides that nothing lies on.
    void pick_points(std::size_t count) {
        struct Side {
            std::uint32_t surface, triangle;
            bool back;
        };
        std::vector<Side> sides;
        std::vector<double> upto;
        double total = 0.0;
        for (std::uint32_t s = 0; s < charts_.size(); ++s) {
            for (std::uint32_t t = 0; t < charts_[s].chart_of_triangle.size(); ++t) {
                const std::uint32_t chart = charts_[s].empty() ? SurfaceCharts::kNone : charts_[s].chart_of_triangle[t];
                if (chart == SurfaceCharts::kNone || !charts_[s].charts[chart].planar) {
                    continue;
                }
                const auto p = rays_.triangle(s, t);
                for (int side = 0; side < (rays_.surfaces()[s].back_side ? 2 : 1); ++side) {
                    total += 0.5 * double(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
                    sides.push_back({s, t, side == 1});
                    upto.push_back(total);
                }
            }
        }
        for (std::uint32_t i = 0; i < count && !sides.empty(); ++i) {
            const double at = (double(i) + unit_float(std::uint32_t(hash64(i) >> 32))) / double(count) * total;
            const auto found = std::lower_bound(upto.begin(), upto.end(), at) - upto.begin();
            const Side& side = sides[std::min(std::size_t(found), sides.size() - 1)];
            const vec2 u = sobol_owen2(i, 0, 0xB0B0U);
            const float r = std::sqrt(u.x);
            const vec2 b(r * (1.0F - u.y), r * u.y);
            const auto p = rays_.triangle(side.surface, side.triangle);
            const SurfaceCharts& charts = charts_[side.surface];
            const vec3 normal = charts.charts[charts.chart_of_triangle[side.triangle]].normal * (side.back ? -1.0F : 1.0F);
            const Point point{side.surface, chart_uv(charts, side.triangle, b),
                              p[0] * (1.0F - b.x - b.y) + p[1] * b.x + p[2] * b.y, normal, side.back};
            if (!is_covered(rays_, point.position, normal, quality_.maps.cover_reach)) {
                points_.push_back(point);
            }
        }
    }

    /// Kept in the cache's folder, if there is one; it goes by names, so remove it when scenes or rules change.
    std::vector<float> true_light(const Part& part, const std::string& name, const Arguments& a) const {
        const fs::path file = fs::path(a.cache) / fmt::format("{}_{}_{}.f32", name, part.name, points_.size());
        std::vector<float> out(points_.size(), 0.0F);
        if (!a.cache.empty() && fs::exists(file)) {
            std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(out.data()), std::streamsize(out.size() * 4));
            return out;
        }
        set_thread_limit(0);
        parallel_chunks(out.size(), 8, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                out[i] = luminance(part.truth(points_[i].position, points_[i].normal).irradiance);
            }
        });
        if (!a.cache.empty()) {
            fs::create_directories(a.cache);
            std::ofstream(file, std::ios::binary)
                .write(reinterpret_cast<const char*>(out.data()), std::streamsize(out.size() * 4));
        }
        return out;
    }

    /// What maps of the first parts show at the points; counts what the parts cost.
    std::vector<float> shown(std::vector<Part>& parts, std::size_t count) {
        set_thread_limit(1);
        std::vector<DirectPart> counted;
        for (std::size_t k = 0; k < count; ++k) {
            Part& part = parts[k];
            part.samples = 0;
            part.rays = 0;
            part.seconds = 0.0;
            counted.push_back(part.light);
            counted.back().light = [this, &part](const vec3& p, const vec3& n) {
                constexpr std::size_t kTimed = 16; // one call of so many: asking for the time costs as much as a ray
                const std::uint64_t rays = rays_.rays_traced();
                const bool timed = part.samples % kTimed == 0;
                const double start = timed ? thread_seconds() : 0.0;
                const DirectSample out = part.light.light(p, n);
                part.seconds += timed ? double(kTimed) * (thread_seconds() - start) : 0.0;
                part.rays += rays_.rays_traced() - rays;
                ++part.samples;
                return out;
            };
        }
        const double start = thread_seconds();
        const DirectMaps maps = build_direct_maps(
            rays_, charts_, counted, [this](std::uint32_t s) { return rays_.surfaces()[s].back_side; }, settings_, {}, 0.0,
            1.0);
        total_ = thread_seconds() - start;
        in_light_ = 0.0;
        for (const Part& p : parts) {
            in_light_ += p.seconds;
        }
        std::vector<float> out;
        for (const Point& p : points_) {
            const auto& map = p.back ? maps.back[p.surface] : maps.front[p.surface];
            out.push_back(map ? luminance(map->irradiance(p.uv)) : 0.0F);
        }
        return out;
    }

    static float mean(const std::vector<float>& values) {
        double sum = 0.0;
        for (const float v : values) {
            sum += v;
        }
        return values.empty() ? 0.0F : float(sum / double(values.size()));
    }

    /// rms | the same without the worst | p95 | p99 of differences relative to the true light or a twentieth of the mean,
    /// whichever is more, then the rms relative to the mean and the bias.
    static std::string errors(const std::vector<float>& now, const std::vector<float>& truth, float whole) {
        std::vector<double> off;
        double relative = 0.0, absolute = 0.0, bias = 0.0;
        const float level = std::max(whole, 1e-9F);
        for (std::size_t i = 0; i < now.size(); ++i) {
            const double d = double(now[i]) - truth[i];
            off.push_back(std::abs(d) / std::max(truth[i], 0.05F * level));
            relative += off.back() * off.back();
            absolute += d * d;
            bias += d;
        }
        std::sort(off.begin(), off.end());
        const auto n = double(std::max<std::size_t>(off.size(), 1));
        const auto share = [&](std::size_t of100) { return off.empty() ? 0.0 : 100.0 * off[off.size() * of100 / 100]; };
        double trimmed = 0.0; // the worst per cent are points on the very edges of things
        const std::size_t kept = off.size() - off.size() / 100;
        for (std::size_t i = 0; i < kept; ++i) {
            trimmed += off[i] * off[i];
        }
        return fmt::format("{:.2f} % | {:.2f} % | {:.2f} % | {:.2f} % | {:.2f} % | {:+.3f} %",
                           100.0 * std::sqrt(relative / n),
                           100.0 * std::sqrt(trimmed / double(std::max<std::size_t>(kept, 1))), share(95), share(99),
                           100.0 * std::sqrt(absolute / n) / level, 100.0 * bias / n / level);
    }

    void print(const std::string& name, const Part& part, const std::vector<float>& own, const std::vector<float>& truth,
               float whole, const Arguments& a) const {
        const auto samples = double(std::max<std::size_t>(part.samples, 1));
        fmt::print("| {} | {} | {} | {:.2f} M | {:.1f} | {:.2f} | {} |\n", name, part.name, part.samples,
                   1e-6 * double(part.rays), double(part.rays) / samples, part.seconds, errors(own, truth, whole));
        std::vector<std::pair<float, std::size_t>> order;
        for (std::size_t i = 0; i < own.size(); ++i) {
            order.emplace_back(-std::abs(own[i] - truth[i]) / std::max(truth[i], 0.05F * whole), i);
        }
        std::sort(order.begin(), order.end());
        for (std::size_t k = 0; k < std::min(a.worst, order.size()); ++k) {
            const Point& p = points_[order[k].second];
            const dvec3 world = dvec3(p.position) + rays_.origin();
            fmt::print("{:.3f} {:.3f} {:.3f}  normal {:.2f} {:.2f} {:.2f}: {:.3f}, truly {:.3f}\n", world.x, world.y,
                       world.z, p.normal.x, p.normal.y, p.normal.z, own[order[k].second], truth[order[k].second]);
        }
        std::fflush(stdout);
    }

    /// The same of what the samples themselves say at the points: the rest is interpolation.
    void print_evaluated(const Part& part, const std::vector<float>& truth, float whole) const {
        std::vector<float> seen;
        const std::uint64_t rays = rays_.rays_traced();
        const double start = thread_seconds();
        for (const Point& p : points_) {
            seen.push_back(luminance(part.light.light(p.position, p.normal).irradiance));
        }
        const auto n = double(std::max<std::size_t>(points_.size(), 1));
        const double us = 1e6 * (thread_seconds() - start) / n;
        fmt::print("| | ... at points | {} | | {:.1f} | {:.1f} us each | {} |\n", points_.size(),
                   double(rays_.rays_traced() - rays) / n, us, errors(seen, truth, whole));
    }

    RayScene rays_;
    DirectLight punctual_;
    MirrorLight mirrors_;
    QualitySettings quality_;
    Hierarchy hierarchy_, emitters_;
    std::unique_ptr<FarFaces> far_lamps_;
    std::unique_ptr<PointGather> lamps_, lamps_closely_;
    std::vector<SurfaceCharts> charts_;
    DirectMapSettings settings_;
    GatherSettings gather_, best_;
    std::vector<Point> points_;
    double total_ = 0.0, in_light_ = 0.0; ///< processor seconds of the last maps
};

int run(const Arguments& a) {
    fmt::print("| scene | part | samples | rays | rays / sample | cpu s | rms | without the worst 1 % | p95 | p99 | rms of "
               "the mean | bias |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& file : a.files) {
        const auto lit = read_lit_scene(file);
        if (!lit) {
            return 1;
        }
        Bench(lit->scene, a).run(fs::path(file).stem().string(), a);
    }
    return 0;
}

} // namespace
} // namespace atrium::bench

int main(int argc, char** argv) {
    CLI::App app{"Direct light maps part by part: what they cost on one thread and how far they are off."};
    atrium::bench::Arguments a;
    app.add_option("files", a.files, "scenes")->required();
    app.add_option("--quality", a.quality)->check(CLI::IsMember({"draft", "normal", "fine"}));
    app.add_option("--points", a.points, "where the light is compared");
    app.add_option("--cache", a.cache, "folder that keeps the true light");
    app.add_option("--only", a.only, "this part alone: lamps, emitters, mirrors or sky");
    app.add_flag("--first", a.first_picture, "maps of the first picture");
    app.add_option("--worst", a.worst, "this many of the points that are furthest off");
    CLI11_PARSE(app, argc, argv);
    return atrium::bench::run(a);
}
