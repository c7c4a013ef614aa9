#include "engine/solver/gi_engine.h"

#include "engine/optics/specular.h"
#include "engine/radiosity/leaf_gather.h"
#include "engine/radiosity/leaf_surroundings.h"
#include "engine/radiosity/links.h"
#include "engine/solver/gi_engine_impl.h"
#include "engine/solver/memory_budget.h"
#include "engine/solver/phase_timer.h"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace atrium {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

bool limited_by_memory(const CausticLight& light) {
    return std::any_of(light.records.begin(), light.records.end(),
                       [](const CausticRecord& r) { return r.sizing == CausticRecord::Sizing::Memory; });
}

} // namespace

GiEngine::GiEngine() : impl_(std::make_unique<Impl>()) {}
GiEngine::~GiEngine() = default;
GiEngine::GiEngine(GiEngine&&) noexcept = default;
GiEngine& GiEngine::operator=(GiEngine&&) noexcept = default;

bool GiEngine::has_solution() const { return impl_->solved; }

Result<std::shared_ptr<const Solution>>
GiEngine::solve(const Scene& scene, const SolveOptions& options, const RunContext& context,
                const std::function<void(std::shared_ptr<const Solution>)>& on_snapshot) {
    if (auto shown_otherwise = follow_wishes(scene, options, context)) {
        if (on_snapshot) {
            on_snapshot(shown_otherwise);
        }
        return shown_otherwise;
    }
    if (options.hurried || options.settle) {
        return update(scene, options, context);
    }
    // What drags need of the last complete light stays until this one is complete.
    auto fresh = std::make_unique<Impl>();
    Impl& s = *fresh;
    if (!options.keep_for_updates) {
        impl_ = std::move(fresh);
    }
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
    bool out_of_links = false, out_of_texels = false;
    LoweredByMemory lowered;
    std::uint32_t wanted_particles = 0;
    double leaf_error = 0.0; // of what is gathered from leaves, relative to all light
    const auto publish = [&](LayerSet layers, bool final) {
        auto solution = std::make_shared<Solution>();
        solution->revision = options.revision;
        solution->final = final;
        solution->updatable = final && options.keep_for_updates;
        solution->mean_radiance = layers.mean_radiance;
        statistics.link_budget_reached = out_of_links || out_of_texels;
        statistics.error_estimate = std::hypot(layers.error_estimate, leaf_error);
        statistics.memory.layers = layers.memory_bytes();
        statistics.memory.caustic_textures = s.caustics.memory_bytes();
        statistics.memory.particles = s.particles ? s.particles->memory_bytes() : 0;
        statistics.particles_emitted = s.particles ? s.particles->emitted() : 0;
        statistics.particles_stored = s.particles ? s.particles->landings().size() : 0;
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
        s.tell_left_out(statistics.features);
        const bool any = s.particles && s.particles->emitted() > 0;
        const bool fewer = any && (s.particles->any_matt() || wanted_particles > s.particles->emitted());
        tell_lowered(statistics.features,
                     {lowered.links && out_of_links, lowered.texels && out_of_texels, lowered.vertices && layers.limited,
                      lowered.particles && fewer, lowered.caustic_texels && limited_by_memory(s.caustics)});
        solution->surfaces = std::move(layers.surfaces);
        solution->caustic_records = s.caustics.records;
        if (options.keep_landings) {
            solution->landings = landing_places(*s.rays, s.particles.get());
        }
        if (options.keep_insides && s.live) {
            solution->insides = s.tell_insides();
        }
        solution->statistics = statistics;
        latest = std::move(solution);
        if (on_snapshot) {
            on_snapshot(latest);
        }
    };

    timer.next("ray_scene");
    context.progress("ray_scene", 0.0);
    s.rays = std::make_unique<RayScene>(scene, context);
    if (context.should_stop()) {
        return stopped();
    }
    s.punctual = std::make_unique<DirectLight>(scene, *s.rays, context);
    // The paper follows light over mirrors by particles alone.
    s.mirrors = options.paper_mode ? nullptr : std::make_unique<MirrorLight>(*s.rays, context);
    if (s.mirrors && s.mirrors->empty()) {
        s.mirrors.reset();
    }
    statistics.triangles = s.rays->triangle_count();
    QualitySettings quality = quality_settings(options.quality, s.rays->bounds().diagonal(), options.target_error);
    set_thresholds(quality, scene.settings.thresholds);
    quality.caustics.paper = options.paper_mode;
    statistics.mode = options.paper_mode ? "paper" : "default";
    if (options.particles > 0) {
        quality.particles = options.particles;
    }
    wanted_particles = quality.particles;
    lowered = keep_within(quality, memory_budget(), s.rays->triangle_count());
    s.field = quality.field;
    s.caustic_settings = quality.caustics;
    s.wishes = caustic_wishes(scene, *s.rays);
    s.sky_radiance = scene.environment.sky_radiance;
    std::unique_ptr<LiveDirectMaps> live_maps;
    std::unique_ptr<LeafExchange> kept_exchange;
    std::vector<float> sky_over_mirrors;

    timer.next("hierarchy");
    context.progress("hierarchy", 0.03);
    HierarchySettings hierarchy_settings = quality.hierarchy;
    hierarchy_settings.seed = options.seed;
    s.hierarchy = build_hierarchy(*s.rays, hierarchy_settings, context);
    if (context.should_stop()) {
        return stopped();
    }
    statistics.time.build = seconds_since(start);
    {
        const std::vector<std::uint32_t> leaves = s.hierarchy.leaves();
        const LeafSurroundings around = look_around(s.hierarchy, *s.rays, leaves, {quality.leaf_rays, {}}, context);
        if (context.should_stop()) {
            return stopped();
        }
        mark_rooms(s.hierarchy, leaves, around);
    }
    s.name_emitters(quality.emitter_contrast, quality.maps.cover_reach, context);
    if (context.should_stop()) {
        return stopped();
    }

    for (Feature& feature : statistics.features) {
        if (feature.name == "direct_layer" && feature.used && s.nothing_direct()) {
            feature.used = false;
            feature.why = "No source stands out from what the other surfaces of its room emit: the links carry all light.";
        }
    }
    if (!s.nothing_direct()) {
        timer.next("particles");
        s.targets = std::make_unique<SpecularTargets>(*s.rays);
        if (s.targets->empty()) {
            s.targets.reset();
        }
        if (!s.trace_particles(quality.particles / 16, options.seed, false, context)) {
            return stopped();
        }
    }
    float light_floor = s.guess_floor(quality);
    timer.next("charts");
    // Where no light comes straight from a source there is nothing to map.
    s.charts = s.nothing_direct() ? std::vector<SurfaceCharts>(s.rays->surfaces().size())
                                  : chart_surfaces(*s.rays, quality.charts, context);
    if (context.should_stop()) {
        return stopped();
    }
    for (std::uint32_t i = 0; i < s.charts.size(); ++i) {
        if (shows_no_irradiance(s.rays->material(i))) {
            s.charts[i] = {};
        }
    }
    const auto direct_maps = [&](const DirectMapSettings& wanted, const FieldSettings& field, double from, double to) {
        timer.next("direct");
        DirectMapSettings settings = wanted;
        settings.light_floor = light_floor;
        s.maps = DirectMaps{};
        s.maps.front.resize(s.charts.size());
        s.maps.back.resize(s.charts.size());
        if (s.nothing_direct()) {
            s.maps.complete = true;
            return true;
        }
        auto maps = std::make_unique<LiveDirectMaps>(
            *s.rays, s.charts, s.direct_parts(field.direct),
            [&](std::uint32_t surface) { return s.rays->surfaces()[surface].back_side; }, settings, context);
        s.maps = maps->build(from, to);
        out_of_texels = s.maps.limited_tiles > 0;
        live_maps = options.keep_for_updates ? std::move(maps) : nullptr;
        return s.maps.complete;
    };
    if (!direct_maps(quality.first_maps, quality.first_field, 0.03, 0.06)) {
        return stopped();
    }
    timer.next("hierarchy");
    s.light_leaves(quality, context);
    s.light_leaves_by_particles();
    for (Element& e : s.hierarchy.elements) {
        e.radiosity = e.leaf() ? e.first_radiosity() : Rgb(0.0F);
    }
    s.hierarchy.pull_radiosity();
    if (context.should_stop()) {
        return stopped();
    }

    const auto find_floor = [&] { // what counts as dark: a twentieth of the mean irradiance
        double light = 0.0;
        double area = 0.0;
        for (const Element& e : s.hierarchy.elements) {
            if (e.leaf()) {
                light += double(e.area) * luminance(e.direct + e.caustic + e.irradiance);
                area += e.area;
            }
        }
        light_floor = area > 0.0 ? float(0.05 * light / area) : 1.0F;
    };
    find_floor();
    const auto layers = [&](const LayerSettings& wanted, const FieldSettings& field, double from, double to) {
        timer.next("layers");
        s.reflected = std::make_unique<IndirectGather>(
            s.hierarchy, *s.rays, bright_leaves(s.hierarchy, s.hierarchy.room, quality.bright_contrast),
            [&s](const Hit& hit, Rgb& light) { return s.mapped_light(hit, light); }, scene.environment.sky_radiance,
            s.mirrors.get(), s.carried_by_particles());
        CacheSettings cache_settings = field.cache;
        cache_settings.light_floor = light_floor;
        IrradianceCache cache(
            *s.rays, [&](const vec3& p, const vec3& n) { return s.reflected->irradiance(p, n, field.reflected); },
            cache_settings);
        const LightField light_field{[&](std::span<const SurfacePoint> points) { return cache.cover(points, context); },
                                     [&](const vec3& p, const vec3& n) {
                                         const FieldSample sample = cache.at(p, n);
                                         return DirectSample{sample.irradiance, sample.variance};
                                     },
                                     [&](const vec3& p, const vec3& n) { return s.direct_light(p, n, field.direct); }};
        LayerSettings settings = wanted;
        settings.light_floor = light_floor;
        const std::vector<std::uint8_t> lit = s.back_lit_surfaces();
        LayerSet set = build_layers(
            *s.rays, light_field, {s.charts, s.maps.front, s.maps.back}, settings,
            [&](std::uint32_t surface) { return lit[surface] != 0; }, context, from, to);
        statistics.records = cache.size();
        if (s.particles && set.complete) {
            timer.next("caustics");
            if (s.caustics.empty()) {
                s.caustics =
                    build_caustic_light(*s.rays, s.charts, *s.particles, quality.caustics, nullptr, s.wishes, context);
            }
            set.complete = attach_caustics(set.surfaces, *s.rays, *s.particles, s.caustics, context);
        }
        return set;
    };

    LinkSet links(s.hierarchy);
    statistics.converged = s.hierarchy.empty(); // where nothing is, nothing is left to solve
    const auto covered = [&](const SurfacePoint& p) {
        return is_covered(*s.rays, p.position, p.normal, quality.maps.cover_reach);
    };
    const auto solve_light = [&](double at) {
        timer.next("gather");
        context.progress("gather", at);
        const std::vector<std::uint32_t> leaves = s.hierarchy.leaves();
        const LeafSurroundings around = look_around(s.hierarchy, *s.rays, leaves, {quality.leaf_rays, covered}, context);
        if (context.should_stop()) {
            return;
        }
        s.light_leaves_by_particles();
        for (std::size_t i = 0; i < leaves.size(); ++i) { // the sky in mirrors and lenses
            s.hierarchy.elements[leaves[i]].caustic += kPi * scene.environment.sky_radiance * around.sky[i];
        }
        auto solved_exchange = std::make_unique<LeafExchange>(s.hierarchy, leaves, around);
        const LeafExchange& exchange = *solved_exchange;
        const SolveReport report =
            solve_radiosity(s.hierarchy, exchange, quality.solver_tolerance, quality.max_iterations, context);
        statistics.iterations += report.iterations;
        statistics.residual = report.residual;
        statistics.converged = report.converged;
        statistics.links = links.links().size();
        statistics.memory.links = links.memory_bytes() + exchange.memory_bytes();
        statistics.elements = s.hierarchy.elements.size();
        statistics.clusters =
            std::uint64_t(std::count_if(s.hierarchy.elements.begin(), s.hierarchy.elements.end(),
                                        [](const Element& e) { return e.kind == Element::Kind::Cluster; }));
        s.energy_balance(exchange, statistics);
        leaf_error = exchange.error_estimate(s.hierarchy, report) * s.reflected_share();
        find_floor();
        s.solved = true;
        kept_exchange = options.keep_for_updates ? std::move(solved_exchange) : nullptr;
        const bool any_sky = std::any_of(around.sky.begin(), around.sky.end(), [](float share) { return share > 0.0F; });
        sky_over_mirrors = options.keep_for_updates && any_sky ? around.sky : std::vector<float>{};
    };
    const auto refine_links = [&](float coarser, double at) {
        timer.next("links");
        context.progress("links", at);
        RefineSettings refine = quality.refine;
        refine.flux_threshold *= coarser;
        refine.rays = 0; // the leaves' own rays carry the light; links only tell where elements are too large
        const std::size_t old_count = s.hierarchy.elements.size();
        links.refine(s.hierarchy, *s.rays, refine, context);
        out_of_links = links.budget_reached();
        s.light_new_leaves(old_count, quality, context);
    };
    if (!s.hierarchy.empty()) {
        refine_links(quality.refine_rounds > 1 ? 4.0F : 1.0F, 0.08); // a coarse look: light has not gone round yet
        if (!context.should_stop()) {
            solve_light(0.12);
        }
        if (context.should_stop()) {
            return stopped();
        }
        if (!options.skip_first_picture) {
            LayerSettings at_once = quality.first_layers;
            at_once.look_between = false;
            LayerSet first = layers(at_once, quality.first_field, 0.14, 0.2);
            timer.stop();
            if (!first.complete) {
                return stopped();
            }
            publish(std::move(first), false);
        }
    }
    timer.next("particles");
    if (!s.trace_particles(quality.particles, options.seed, options.keep_for_updates, context)) {
        return stopped();
    }
    // The sharp light first: means of leaves over the coarse maps are off where light changes within a texel.
    if (!direct_maps(quality.maps, s.field, 0.2, 0.45)) {
        return stopped();
    }
    if (!s.hierarchy.empty()) {
        timer.next("hierarchy");
        s.light_leaves(quality, context);
        for (int round = 1; round < quality.refine_rounds && !context.should_stop(); ++round) {
            refine_links(round + 1 < quality.refine_rounds ? 2.0F : 1.0F, 0.45);
            solve_light(0.5);
        }
        if (!context.should_stop()) {
            // Rays know what stands close to a leaf, which links average away.
            timer.next("leaf_gather");
            std::size_t first_look = 0;                    // elements from here on have not been looked at
            s.hierarchy.settings.smallest_patch *= 0.125F; // links have no use for such small ones
            for (int level = 0; level < quality.leaf_levels && !context.should_stop(); ++level) {
                const std::size_t first_new = s.hierarchy.elements.size();
                const LeafGather look(s.hierarchy, *s.rays, quality.leaf_rays, first_look, covered, context);
                first_look = first_new;
                if (!look.complete() || look.split_uneven(s.hierarchy, *s.rays, quality.leaf_contrast, light_floor) == 0) {
                    break;
                }
                s.light_new_leaves(first_new, quality, context);
                for (std::size_t i = first_new; i < s.hierarchy.elements.size(); ++i) {
                    Element& e = s.hierarchy.elements[i];
                    e.irradiance = s.hierarchy.elements[e.parent].irradiance;
                    e.radiosity = e.emitted + e.rho * (e.direct + e.irradiance);
                }
            }
            solve_light(0.55);
        }
        if (context.should_stop()) {
            return stopped();
        }
    }
    s.solved = true;
    timer.next("particles");
    if (!s.trace_matt_particles(quality, options.seed, context)) {
        return stopped();
    }
    context.progress("layers", 0.6);
    LayerSettings final_layers = quality.layers;
    final_layers.keep_places = options.keep_for_updates;
    LayerSet set = layers(final_layers, quality.field, 0.6, 1.0);
    timer.stop();
    if (!set.complete) {
        return stopped();
    }
    if (options.keep_for_updates) {
        s.mirror_moved = false;
        s.live = std::make_unique<Impl::Live>();
        s.live->maps = std::move(live_maps);
        s.live->exchange = std::move(kept_exchange);
        s.live->sky_over_mirrors = std::move(sky_over_mirrors);
        s.live->layers = set;
        s.live->mean_radiance = set.mean_radiance;
        for (const RaySurface& surface : s.rays->surfaces()) {
            s.live->placement.push_back(surface.to_engine);
        }
        s.live->quality = quality;
        s.live->light_floor = light_floor;
        s.find_shafts();
    }
    publish(std::move(set), true);
    if (options.keep_for_updates) {
        auto shown = std::make_shared<Solution>(*latest);
        shown->insides.reset();
        s.live->shown = std::move(shown);
        keep_question(s, scene, options);
        if (s.live->exchange) { // while the finished picture is looked at, and not when the hand first moves
            s.live->reflected = std::make_unique<ReflectedChange>(s.hierarchy, *s.rays, s.live->layers);
        }
        impl_ = std::move(fresh);
    }
    context.progress("layers", 1.0);
    return latest;
}

SensorReading GiEngine::gather_free(const dvec3& point, const dvec3& normal) const {
    SensorReading out;
    if (impl_->live && !impl_->reflected) { // something was added
        impl_->reflected = impl_->gather_reflected();
    }
    if (!impl_->solved || !impl_->reflected) {
        return out;
    }
    FieldSettings field = impl_->field;
    field.direct.spread = 0.0F;
    for (GatherSettings* g : {&field.direct, &field.reflected.bright}) {
        g->rays *= 8; // a single sensor can afford what a picture cannot
        g->sky_rays *= 8;
        g->sun_rays *= 4;
        g->max_cut *= 4;
        g->tolerance *= 0.25F;
    }
    field.reflected.all_light = true;
    field.reflected.rays *= 8;
    field.reflected.max_rays *= 8;
    const vec3 at(point - impl_->rays->origin());
    const vec3 unit(glm::normalize(normal));
    const DirectSample direct = impl_->direct_light(at, unit, field.direct);
    const FieldSample reflected = impl_->reflected->irradiance(at, unit, field.reflected);
    out.irradiance = direct.irradiance + reflected.irradiance;
    out.standard_error = std::sqrt(direct.variance + reflected.variance);
    return out;
}

} // namespace atrium
