#include "engine/solver/gi_engine.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/layers/layer_builder.h"
#include "engine/radiosity/direct_light.h"
#include "engine/radiosity/leaf_surroundings.h"
#include "engine/radiosity/links.h"
#include "engine/radiosity/point_gather.h"
#include "engine/radiosity/transport.h"
#include "engine/raycast/ray_scene.h"
#include "engine/solver/quality.h"

#include <algorithm>
#include <chrono>

namespace atrium {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Times the phases of one solve in order.
class PhaseTimer {
public:
    explicit PhaseTimer(Statistics& statistics) : statistics_(statistics) {}
    void next(const std::string& name) {
        stop();
        name_ = name;
        start_ = Clock::now();
    }
    void stop() {
        if (name_.empty()) {
            return;
        }
        const double seconds = seconds_since(start_);
        auto& phases = statistics_.phases;
        const auto it = std::find_if(phases.begin(), phases.end(), [&](const auto& p) { return p.name == name_; });
        if (it == phases.end()) {
            phases.push_back({name_, seconds, 0.0});
        } else {
            it->seconds += seconds;
        }
        name_.clear();
    }

private:
    Statistics& statistics_;
    std::string name_;
    Clock::time_point start_;
};

} // namespace

struct GiEngine::Impl {
    std::unique_ptr<RayScene> rays;
    std::unique_ptr<DirectLight> direct;
    Hierarchy hierarchy;
    GatherSettings gather_settings;
    bool solved = false;

    // Direct light on every leaf; leaves whose samples disagree are split first, so that sun patches find their place.
    void light_leaves(const QualitySettings& quality, const RunContext& context) {
        if (direct->empty()) {
            return;
        }
        const unsigned sky_rays = std::max(quality.layers.gather.sky_rays / 8, 16U);
        std::vector<std::uint32_t> todo = hierarchy.leaves();
        double flux = 0.0;
        for (int level = 0; level < 6 && !todo.empty() && !context.should_stop(); ++level) {
            std::vector<float> spread(todo.size());
            parallel_chunks(todo.size(), 32, [&](std::size_t begin, std::size_t end, std::size_t) {
                if (context.should_stop()) {
                    return;
                }
                for (std::size_t i = begin; i < end; ++i) {
                    spread[i] = light_leaf(todo[i], quality.leaf_samples, sky_rays);
                }
            });
            if (level == 0) {
                for (const std::uint32_t i : todo) {
                    const Element& e = hierarchy.elements[i];
                    flux += double(e.area) * luminance(e.emitted + e.rho * e.direct);
                }
            }
            std::vector<std::uint32_t> next;
            for (std::size_t i = 0; i < todo.size(); ++i) {
                const Element& e = hierarchy.elements[todo[i]];
                const double uncertain = double(e.area) * spread[i] * max_component(e.rho);
                const bool unseen =
                    level < 2 && e.radius > 10.0F * hierarchy.settings.smallest_patch; // few samples miss a sun patch
                if ((uncertain > 2.0 * quality.refine.flux_threshold * flux || unseen) && hierarchy.can_split(todo[i])) {
                    const std::uint32_t first = std::uint32_t(hierarchy.elements.size());
                    hierarchy.split(todo[i], *rays);
                    for (std::uint32_t c = first; c < hierarchy.elements.size(); ++c) {
                        next.push_back(c);
                    }
                }
            }
            todo = std::move(next);
        }
    }

    // Mean direct irradiance of a leaf; returns the standard deviation of its samples.
    float light_leaf(std::uint32_t index, unsigned samples, unsigned sky_rays) {
        Element& e = hierarchy.elements[index];
        const unsigned n = e.kind == Element::Kind::Patch ? samples * 2 : samples;
        Rgb sum(0.0F);
        double sum2 = 0.0;
        for (unsigned i = 0; i < n; ++i) {
            const SurfacePoint p = sample_point(hierarchy, *rays, index, sobol_owen2(i, 0, std::uint32_t(e.path)), false);
            const Rgb light = direct->irradiance(p.position, p.normal, 1, sky_rays).irradiance;
            sum += light;
            sum2 += double(luminance(light)) * luminance(light);
        }
        e.direct = sum / float(n);
        const double mean = luminance(e.direct);
        return float(std::sqrt(std::max(sum2 / n - mean * mean, 0.0)));
    }

    // Leaves split after light_leaves() have their parent's direct light; sample what is new.
    void light_new_leaves(std::size_t first_new, const QualitySettings& quality, const RunContext& context) {
        if (direct->empty() || context.should_stop()) {
            return;
        }
        const unsigned sky_rays = std::max(quality.layers.gather.sky_rays / 8, 16U);
        parallel_chunks(hierarchy.elements.size() - first_new, 32, [&](std::size_t begin, std::size_t end, std::size_t) {
            if (context.should_stop()) {
                return;
            }
            for (std::size_t i = begin; i < end; ++i) {
                if (hierarchy.elements[first_new + i].leaf()) {
                    light_leaf(std::uint32_t(first_new + i), quality.leaf_samples, sky_rays);
                }
            }
        });
    }

    std::vector<std::uint8_t> back_lit_surfaces() const {
        std::vector<std::uint8_t> lit(rays->surfaces().size(), 0);
        for (const Element& e : hierarchy.elements) {
            if (e.leaf() && max_component(e.direct + e.irradiance) > 0.0F) {
                if (e.kind == Element::Kind::Patch && e.back) {
                    lit[e.surface] = 1;
                } else if (e.kind == Element::Kind::Faces) {
                    for (std::uint32_t f = e.triangle; f < e.triangle + e.face_count; ++f) {
                        if (hierarchy.faces[f].back) {
                            lit[hierarchy.faces[f].surface] = 1;
                        }
                    }
                }
            }
        }
        return lit;
    }

    void energy_balance(const Transport& transport, Statistics& statistics) const {
        double emitted = 0.0, absorbed = 0.0, leaving = 0.0, direct_in = 0.0;
        for (std::size_t i = 0; i < transport.leaves().size(); ++i) {
            const Element& e = hierarchy.elements[transport.leaves()[i]];
            emitted += double(e.area) * luminance(e.emitted);
            direct_in += double(e.area) * luminance(e.direct);
            absorbed += double(e.area) * luminance((Rgb(1.0F) - e.rho) * (e.irradiance + e.direct));
            leaving += double(e.area) * luminance(e.radiosity) * std::max(1.0 - double(transport.row_sums()[i]), 0.0);
        }
        // What sun, sky and lamps bring in counts where it lands; a lamp's light that lands nowhere has escaped at once.
        const double lamps = direct->emitted_flux();
        bool from_outside = direct->has_sky();
        for (const PlacedLight& light : direct->lights()) {
            from_outside = from_outside || light.light.kind == Light::Kind::Directional;
        }
        const double lost = from_outside ? 0.0 : std::max(lamps - direct_in, 0.0);
        statistics.energy.emitted = emitted + (from_outside ? direct_in : std::max(lamps, direct_in));
        statistics.energy.absorbed = absorbed;
        statistics.energy.escaped = leaving + lost;
        statistics.energy.defect =
            statistics.energy.emitted > 0.0 ? 1.0 - (absorbed + statistics.energy.escaped) / statistics.energy.emitted : 0.0;
    }
};

GiEngine::GiEngine() : impl_(std::make_unique<Impl>()) {}
GiEngine::~GiEngine() = default;
GiEngine::GiEngine(GiEngine&&) noexcept = default;
GiEngine& GiEngine::operator=(GiEngine&&) noexcept = default;

bool GiEngine::has_solution() const { return impl_->solved; }

Result<std::shared_ptr<const Solution>>
GiEngine::solve(const Scene& scene, const SolveOptions& options, const RunContext& context,
                const std::function<void(std::shared_ptr<const Solution>)>& on_snapshot) {
    impl_ = std::make_unique<Impl>();
    Impl& s = *impl_;
    const auto start = Clock::now();
    Statistics statistics;
    statistics.features = scene_features(scene);
    statistics.threads = thread_limit();
    statistics.seed = options.seed;
    statistics.quality = quality_name(options.quality);
    PhaseTimer timer(statistics);
    std::shared_ptr<const Solution> latest;
    const auto stopped = [&]() -> Result<std::shared_ptr<const Solution>> {
        if (latest) {
            auto unfinished = std::make_shared<Solution>(*latest);
            unfinished->statistics.converged = false;
            return unfinished;
        }
        return fail("", "", "stopped before the first picture", "Give it more time, or choose draft quality");
    };
    const auto publish = [&](LayerSet layers, bool final) {
        auto solution = std::make_shared<Solution>();
        solution->revision = options.revision;
        solution->final = final;
        solution->mean_radiance = layers.mean_radiance;
        statistics.error_estimate = layers.error_estimate;
        statistics.memory.layers = layers.memory_bytes();
        statistics.memory.elements = s.hierarchy.memory_bytes();
        statistics.memory.ray_scene = s.rays->memory_bytes();
        statistics.memory.peak_rss = peak_resident_bytes();
        statistics.rays = s.rays->rays_traced();
        statistics.time.solve = seconds_since(start);
        statistics.time.total = statistics.time.solve;
        if (!latest) {
            statistics.time.first_picture = statistics.time.solve;
        }
        for (auto& phase : statistics.phases) {
            phase.share = phase.seconds / std::max(statistics.time.solve, 1e-9);
        }
        solution->surfaces = std::move(layers.surfaces);
        solution->statistics = statistics;
        latest = std::move(solution);
        if (on_snapshot) {
            on_snapshot(latest);
        }
    };

    timer.next("ray_scene");
    context.progress("ray_scene", 0.0);
    s.rays = std::make_unique<RayScene>(scene);
    s.direct = std::make_unique<DirectLight>(scene, *s.rays);
    statistics.triangles = s.rays->triangle_count();
    const QualitySettings quality = quality_settings(options.quality, s.rays->bounds().diagonal(), options.target_error);
    s.gather_settings = quality.layers.gather;

    timer.next("hierarchy");
    context.progress("hierarchy", 0.03);
    HierarchySettings hierarchy_settings = quality.hierarchy;
    hierarchy_settings.seed = options.seed;
    s.hierarchy = build_hierarchy(*s.rays, hierarchy_settings);
    statistics.time.build = seconds_since(start);
    s.light_leaves(quality, context);
    for (Element& e : s.hierarchy.elements) {
        e.radiosity = e.leaf() ? e.emitted + e.rho * e.direct : Rgb(0.0F);
    }
    s.hierarchy.pull_radiosity();
    if (context.should_stop()) {
        return stopped();
    }

    PointGather gather(s.hierarchy, *s.rays, *s.direct);
    const auto layers = [&](const LayerSettings& wanted, double from, double to) {
        timer.next("layers");
        LayerSettings settings = wanted;
        double light = 0.0;
        double area = 0.0;
        for (const Element& e : s.hierarchy.elements) {
            if (e.leaf()) {
                light += double(e.area) * luminance(e.direct + e.irradiance);
                area += e.area;
            }
        }
        settings.light_floor = area > 0.0 ? float(0.05 * light / area) : 1.0F;
        const std::vector<std::uint8_t> lit = s.back_lit_surfaces();
        return build_layers(
            *s.rays, gather, settings, [&](std::uint32_t surface) { return lit[surface] != 0; }, context, from, to);
    };

    LinkSet links(s.hierarchy);
    statistics.converged = s.hierarchy.empty();             // where nothing is, nothing is left to solve
    const double step = 0.32 / (quality.refine_rounds + 1); // of progress: one per round and one for the first picture
    for (int round = 0; round < quality.refine_rounds && !s.hierarchy.empty(); ++round) {
        const double at = 0.08 + step * (round == 0 ? 0 : round + 1);
        timer.next("links");
        context.progress("links", at);
        RefineSettings refine = quality.refine;
        if (round + 1 < quality.refine_rounds) {
            refine.flux_threshold *= 4.0F; // the first look is coarse: light has not gone round yet
        }
        const std::size_t old_count = s.hierarchy.elements.size();
        links.refine(s.hierarchy, *s.rays, refine, context);
        s.light_new_leaves(old_count, quality, context);
        if (context.should_stop()) {
            return stopped();
        }
        timer.next("gather");
        context.progress("gather", at + 0.6 * step);
        Transport transport(s.hierarchy, links.links());
        const LeafSurroundings around = look_around(s.hierarchy, *s.rays, transport.leaves(), context);
        transport.close_rows(around.enclosed);
        const SolveReport report =
            solve_radiosity(s.hierarchy, transport, quality.solver_tolerance, quality.max_iterations, context);
        darken(s.hierarchy, transport.leaves(), around);
        statistics.iterations += report.iterations;
        statistics.residual = report.residual;
        statistics.converged = report.converged;
        statistics.links = links.links().size();
        statistics.memory.links = links.memory_bytes() + transport.memory_bytes();
        statistics.elements = s.hierarchy.elements.size();
        statistics.clusters =
            std::uint64_t(std::count_if(s.hierarchy.elements.begin(), s.hierarchy.elements.end(),
                                        [](const Element& e) { return e.kind == Element::Kind::Cluster; }));
        s.energy_balance(transport, statistics);
        if (context.should_stop()) {
            return stopped();
        }
        if (round == 0) {
            s.solved = true;
            LayerSet first = layers(quality.first_layers, at + step, at + 2.0 * step);
            timer.stop();
            if (!first.complete) {
                return stopped();
            }
            publish(std::move(first), false);
        }
    }
    s.solved = true;
    context.progress("layers", 0.4);
    LayerSet set = layers(quality.layers, 0.4, 1.0);
    timer.stop();
    if (!set.complete) {
        return stopped();
    }
    publish(std::move(set), true);
    context.progress("layers", 1.0);
    return latest;
}

SensorReading GiEngine::gather_free(const dvec3& point, const dvec3& normal) const {
    SensorReading out;
    if (!impl_->solved) {
        return out;
    }
    GatherSettings settings = impl_->gather_settings;
    settings.rays *= 8; // a single sensor can afford what a picture cannot
    settings.sky_rays *= 8;
    settings.sun_rays *= 4;
    settings.max_cut *= 4;
    settings.tolerance *= 0.25F;
    const PointGather gather(impl_->hierarchy, *impl_->rays, *impl_->direct);
    const DirectSample sample =
        gather.irradiance(vec3(point - impl_->rays->origin()), vec3(glm::normalize(normal)), settings);
    out.irradiance = sample.irradiance;
    out.standard_error = std::sqrt(sample.variance);
    return out;
}

} // namespace atrium
