#include "engine/solver/gi_engine.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/layers/caustic_layer.h"
#include "engine/layers/covered_points.h"
#include "engine/layers/layer_builder.h"
#include "engine/optics/specular.h"
#include "engine/particles/particle_map.h"
#include "engine/radiosity/direct_light.h"
#include "engine/radiosity/indirect_gather.h"
#include "engine/radiosity/leaf_exchange.h"
#include "engine/radiosity/leaf_gather.h"
#include "engine/radiosity/leaf_surroundings.h"
#include "engine/radiosity/links.h"
#include "engine/radiosity/mirror_light.h"
#include "engine/radiosity/point_gather.h"
#include "engine/raycast/ray_scene.h"
#include "engine/raycast/scene_charts.h"
#include "engine/solver/quality.h"

#include <algorithm>
#include <chrono>
#include <ctime>

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
        start_cpu_ = std::clock();
    }
    void stop() {
        if (name_.empty()) {
            return;
        }
        const double seconds = seconds_since(start_);
        const double cpu = double(std::clock() - start_cpu_) / CLOCKS_PER_SEC;
        auto& phases = statistics_.phases;
        const auto it = std::find_if(phases.begin(), phases.end(), [&](const auto& p) { return p.name == name_; });
        if (it == phases.end()) {
            phases.push_back({name_, seconds, 0.0, cpu});
        } else {
            it->seconds += seconds;
            it->cpu_seconds += cpu;
        }
        name_.clear();
    }

private:
    Statistics& statistics_;
    std::string name_;
    Clock::time_point start_;
    std::clock_t start_cpu_ = 0;
};

} // namespace

struct GiEngine::Impl {
    std::unique_ptr<RayScene> rays;
    std::unique_ptr<DirectLight> punctual; ///< sun, sky, point and spot lights
    std::vector<SurfaceCharts> charts;
    DirectMaps maps; ///< direct light on charted surfaces
    Hierarchy hierarchy;
    Hierarchy emitters;                   ///< the tree in which only named emitters shine; empty when there are none
    std::unique_ptr<MirrorLight> mirrors; ///< null where there is no flat mirror, and where the paper's ways are asked for
    std::unique_ptr<PointGather> lamps;   ///< named emitters alone
    std::unique_ptr<PointGather> direct;  ///< named emitters and `punctual` together
    std::unique_ptr<IndirectGather> reflected;
    std::unique_ptr<SpecularTargets> targets; ///< null where nothing is specular or no light stands out
    std::unique_ptr<ParticleMap> particles;   ///< null where there are no targets
    CausticLight caustics;
    FieldSettings field;
    double named_flux = 0.0; ///< of the named emitters, lumen
    double shut_flux = 0.0;  ///< of emitters' sides that lie on something: absorbed where they are
    bool solved = false;

    [[nodiscard]] bool nothing_direct() const { return punctual->empty() && emitters.empty(); }
    // Direct light in parts, the sharpest and cheapest first; none that the scene does not have. `settings` must outlive it.
    [[nodiscard]] std::vector<DirectPart> direct_parts(const GatherSettings& settings) const {
        std::vector<DirectPart> parts;
        if (!punctual->lights().empty()) {
            parts.push_back(DirectPart{
                [&](const vec3& p, const vec3& n) { return punctual->lamps_irradiance(p, n, settings.sun_rays); }, false});
        }
        if (!emitters.empty()) {
            parts.push_back(
                DirectPart{[&](const vec3& p, const vec3& n) { return lamps->irradiance(p, n, settings); }, false});
        }
        if (mirrors && (!punctual->lights().empty() || !emitters.empty())) {
            parts.push_back(DirectPart{[&](const vec3& p, const vec3& n) { return over_mirrors(p, n, settings); }, false});
        }
        if (punctual->has_sky()) {
            parts.push_back(DirectPart{
                [&](const vec3& p, const vec3& n) { return punctual->sky_irradiance(p, n, settings.sky_rays); }, true});
        }
        return parts;
    }
    [[nodiscard]] DirectSample direct_light(const vec3& point, const vec3& normal, const GatherSettings& settings) const {
        DirectSample out = direct->irradiance(point, normal, settings);
        if (mirrors) {
            const DirectSample over = over_mirrors(point, normal, settings);
            out.irradiance += over.irradiance;
            out.variance += over.variance;
        }
        return out;
    }
    // Direct light by mirror images in flat mirrors.
    [[nodiscard]] DirectSample over_mirrors(const vec3& point, const vec3& normal, const GatherSettings& settings) const {
        return mirrors->irradiance(point, normal, settings, punctual.get(), lamps.get());
    }

    // Direct light at a point of a charted surface, from its map.
    bool mapped_light(const Hit& hit, Rgb& irradiance) const {
        const SurfaceCharts& surface = charts[hit.surface];
        if (surface.empty() || surface.chart_of_triangle[hit.triangle] == SurfaceCharts::kNone) {
            return false;
        }
        const auto& map = hit.front ? maps.front[hit.surface] : maps.back[hit.surface];
        irradiance = map ? map->irradiance(chart_uv(surface, hit.triangle, hit.barycentric)) : Rgb(0.0F);
        return true;
    }

    // What counts as dark before anything is solved: a twentieth of the mean direct light at a few hundred points, lux.
    [[nodiscard]] float guess_floor(const QualitySettings& quality) const {
        if (hierarchy.empty() || nothing_direct()) {
            return 1e-3F;
        }
        constexpr std::uint32_t kPoints = 512;
        const double sum = parallel_sum(kPoints, 16, 0.0, [&](std::size_t i) {
            const vec2 u = sobol_owen2(std::uint32_t(i), 0, 0xF100DU);
            const SurfacePoint p = sample_point(hierarchy, *rays, 0, u, false);
            return double(luminance(direct_light(p.position, p.normal, quality.leaf_field.direct).irradiance));
        });
        return std::max(float(0.05 * sum / kPoints), 1e-6F);
    }

    // Lamps that stand out leave the hierarchy: what they send is gathered straight from them.
    // The side of a lamp that lies flat on something else shines into the gap between them, where its light ends.
    void name_emitters(float contrast, float cover_reach) {
        LeafFlags named = named_emitters(hierarchy, hierarchy.room, contrast);
        LeafFlags shut(named.size(), 0);
        parallel_chunks(named.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
            constexpr std::uint32_t kPoints = 8;
            for (std::size_t i = begin; i < end; ++i) {
                const auto path = std::uint32_t(hierarchy.elements[i].path);
                shut[i] = named[i];
                for (std::uint32_t k = 0; shut[i] != 0 && k < kPoints; ++k) {
                    const SurfacePoint p = sample_point(hierarchy, *rays, std::uint32_t(i), sobol_owen2(k, 0, path), false);
                    shut[i] = is_covered(*rays, p.position, p.normal, cover_reach) ? 1 : 0;
                }
            }
        });
        for (std::size_t i = 0; i < named.size(); ++i) {
            if (shut[i] != 0) {
                Element& e = hierarchy.elements[i];
                shut_flux += double(e.area) * luminance(e.emitted);
                e.emitted = Rgb(0.0F);
                named[i] = 0;
            }
        }
        if (std::any_of(named.begin(), named.end(), [](std::uint8_t f) { return f != 0; })) {
            emitters = only_flagged(hierarchy, named, true);
            for (std::size_t i = 0; i < named.size(); ++i) {
                if (named[i] != 0) {
                    Element& e = hierarchy.elements[i];
                    named_flux += double(e.area) * luminance(e.emitted);
                    e.emitted = Rgb(0.0F);
                }
            }
        }
        direct = std::make_unique<PointGather>(emitters, *rays, punctual.get());
        lamps = std::make_unique<PointGather>(emitters, *rays);
    }

    // Direct light on every leaf; leaves whose samples disagree are split first, so that sun patches find their place.
    void light_leaves(const QualitySettings& quality, const RunContext& context) {
        if (nothing_direct()) {
            return;
        }
        std::vector<std::uint32_t> todo = hierarchy.leaves();
        std::vector<double> flux; // of every room; last: of all
        const auto flux_around = [&](std::uint32_t leaf) -> double& {
            const bool alone = hierarchy.room.empty() || hierarchy.room[leaf] == Element::kNone;
            return alone ? flux.back() : flux[hierarchy.room[leaf]];
        };
        for (int level = 0; level < 6 && !todo.empty() && !context.should_stop(); ++level) {
            std::vector<float> spread(todo.size());
            parallel_chunks(todo.size(), 32, [&](std::size_t begin, std::size_t end, std::size_t) {
                if (context.should_stop()) {
                    return;
                }
                for (std::size_t i = begin; i < end; ++i) {
                    spread[i] = light_leaf(todo[i], quality);
                }
            });
            if (level == 0) {
                std::uint32_t rooms = 0;
                for (const std::uint32_t room : hierarchy.room) {
                    rooms = std::max(rooms, room + 1); // kNone is none
                }
                flux.assign(rooms + 1, 0.0);
                for (const std::uint32_t i : todo) {
                    const Element& e = hierarchy.elements[i];
                    const double sent = double(e.area) * luminance(e.emitted + e.rho * e.direct);
                    flux.back() += sent;
                    if (&flux_around(i) != &flux.back()) {
                        flux_around(i) += sent;
                    }
                }
            }
            std::vector<std::uint32_t> next;
            for (std::size_t i = 0; i < todo.size(); ++i) {
                const Element& e = hierarchy.elements[todo[i]];
                const double uncertain = double(e.area) * spread[i] * max_component(e.rho);
                const bool unseen =
                    level < 2 && e.radius > 10.0F * hierarchy.settings.smallest_patch; // few samples miss a sun patch
                if ((uncertain > 2.0 * quality.refine.flux_threshold * flux_around(todo[i]) || unseen) &&
                    hierarchy.can_split(todo[i])) {
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

    // Direct light of a leaf from the light map of its chart; false where it has none.
    bool light_from_map(Element& e, double& spread) const {
        if (e.kind != Element::Kind::Patch || charts[e.surface].empty()) {
            return false;
        }
        const SurfaceCharts& surface = charts[e.surface];
        const Sheet& sheet = hierarchy.sheets[hierarchy.patches[e.patch].sheet];
        const std::uint32_t index = surface.chart_of_triangle[hierarchy.sheet_triangles[sheet.first].triangle];
        if (index == SurfaceCharts::kNone || !surface.charts[index].planar) {
            return false;
        }
        const Chart& chart = surface.charts[index];
        const auto& map = e.back ? maps.back[e.surface] : maps.front[e.surface];
        constexpr int kSamples = 32;
        Rgb sum(0.0F);
        double sum2 = 0.0;
        const auto element = std::uint32_t(&e - hierarchy.elements.data());
        for (std::uint32_t i = 0; map && i < kSamples; ++i) {
            const vec2 u = sobol_owen2(i, 0, std::uint32_t(e.path));
            const vec3 from_corner = sample_point(hierarchy, *rays, element, u, false).position - chart.origin;
            const vec2 at(glm::dot(from_corner, chart.axis_u), glm::dot(from_corner, chart.axis_v));
            const Rgb light = map->irradiance(vec2(float(chart.tile_u), float(chart.tile_v)) + at / chart.scale);
            sum += light;
            sum2 += double(luminance(light)) * luminance(light);
        }
        e.direct = sum / float(kSamples);
        const double mean = luminance(e.direct);
        spread = std::sqrt(std::max(sum2 / kSamples - mean * mean, 0.0));
        return true;
    }

    // Mean direct irradiance of a leaf; returns the standard deviation of its samples.
    float light_leaf(std::uint32_t index, const QualitySettings& quality) {
        Element& e = hierarchy.elements[index];
        if (double spread = 0.0; light_from_map(e, spread)) {
            return float(spread);
        }
        const unsigned most = e.kind == Element::Kind::Patch ? quality.leaf_samples * 2 : quality.leaf_samples;
        Rgb sum(0.0F);
        double sum2 = 0.0;
        unsigned n = 0;
        for (unsigned i = 0; i < most; ++i) {
            const SurfacePoint p = sample_point(hierarchy, *rays, index, sobol_owen2(i, 0, std::uint32_t(e.path)), false);
            if (is_covered(*rays, p.position, p.normal, quality.maps.cover_reach)) {
                continue; // what shines into a gap is no light of the surface
            }
            ++n;
            const Rgb light = direct_light(p.position, p.normal, quality.leaf_field.direct).irradiance;
            sum += light;
            sum2 += double(luminance(light)) * luminance(light);
        }
        e.direct = n > 0 ? sum / float(n) : Rgb(0.0F);
        const double mean = luminance(e.direct);
        return n > 0 ? float(std::sqrt(std::max(sum2 / n - mean * mean, 0.0))) : 0.0F;
    }

    // Leaves split after light_leaves() have their parent's direct light; sample what is new.
    void light_new_leaves(std::size_t first_new, const QualitySettings& quality, const RunContext& context) {
        if (nothing_direct() || context.should_stop()) {
            return;
        }
        parallel_chunks(hierarchy.elements.size() - first_new, 32, [&](std::size_t begin, std::size_t end, std::size_t) {
            if (context.should_stop()) {
                return;
            }
            for (std::size_t i = begin; i < end; ++i) {
                if (hierarchy.elements[first_new + i].leaf()) {
                    light_leaf(std::uint32_t(first_new + i), quality);
                }
            }
        });
    }

    // Particles over mirrors and through glass, where there are both such things and light that stands out.
    bool trace_particles(std::uint32_t count, std::uint32_t seed, const RunContext& context) {
        particles.reset();
        caustics = {};
        if (!targets) {
            return true;
        }
        ParticleSettings settings;
        settings.particles = count;
        settings.seed = seed;
        const auto by_image = [this](const Hit& hit) { return mirrors && mirrors->carries(hit); };
        particles = std::make_unique<ParticleMap>(*rays, *targets, *punctual, emitters, by_image, settings, context);
        return particles->complete();
    }

    // What particles brought joins the light of the leaves that they landed on.
    void light_leaves_by_particles() {
        if (!particles) {
            return;
        }
        for (Element& e : hierarchy.elements) {
            e.caustic = Rgb(0.0F);
        }
        for (const Landing& l : particles->landings()) {
            const std::uint32_t leaf = hierarchy.leaf_at(l.surface, l.triangle, l.back, l.barycentric);
            if (leaf != Element::kNone) {
                hierarchy.elements[leaf].caustic += particles->power(l) / hierarchy.elements[leaf].area;
            }
        }
    }

    std::vector<std::uint8_t> back_lit_surfaces() const {
        std::vector<std::uint8_t> lit(rays->surfaces().size(), 0);
        for (const Element& e : hierarchy.elements) {
            if (e.leaf() && max_component(e.direct + e.caustic + e.irradiance) > 0.0F) {
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

    // What the scene might have needed and did not.
    void tell_left_out(std::vector<Feature>& features) const {
        const bool any = particles && particles->emitted() > 0;
        for (Feature& f : features) {
            if (f.name == "particles" && f.used && !any) {
                f.used = false;
                f.why = targets ? "No light that stands out reaches a surface over a mirror, metal or glass, but for flat "
                                  "mirrors, whose images the direct layer has."
                                : "No light stands out, or nothing mirrors it.";
            }
            if (f.name == "caustic_textures" && f.used && caustics.texture_count() == 0) {
                f.used = false;
                f.why = any ? "What particles bring has no finer detail than the mesh." : "There are no particles.";
            }
        }
    }

    // Of all light that falls on surfaces, that which other surfaces sent; 0 in the dark.
    [[nodiscard]] double reflected_share() const {
        const Element& root = hierarchy.elements.front();
        const double received = luminance(root.irradiance);
        const double all = received + double(luminance(root.direct + root.caustic));
        return all > 0.0 ? received / all : 0.0;
    }

    void energy_balance(const LeafExchange& exchange, Statistics& statistics) const {
        double emitted = 0.0, absorbed = 0.0, leaving = 0.0, direct_in = 0.0;
        for (std::size_t i = 0; i < exchange.leaves().size(); ++i) {
            const Element& e = hierarchy.elements[exchange.leaves()[i]];
            const double area = exchange.area()[i];
            const float stays = exchange.opacity()[i]; // what goes through glass is counted where it lands
            emitted += area * luminance(e.emitted);
            direct_in += area * stays * luminance(e.direct);
            // Particles tell for themselves what of their light went on.
            direct_in += area * luminance(e.caustic);
            absorbed += area * luminance(glm::max(Rgb(stays) - e.rho, Rgb(0.0F)) * (e.irradiance + e.direct));
            absorbed += area * luminance((Rgb(1.0F) - e.rho) * e.caustic);
            leaving += area * luminance(e.radiosity) * std::max(1.0 - double(exchange.row_sums()[i]), 0.0);
        }
        // What sun, sky and lamps bring in counts where it lands; a lamp's light that lands nowhere has escaped at once.
        const double sent = punctual->emitted_flux() + named_flux;
        bool from_outside = punctual->has_sky();
        for (const PlacedLight& light : punctual->lights()) {
            from_outside = from_outside || light.light.kind == Light::Kind::Directional;
        }
        const double lost = from_outside ? 0.0 : std::max(sent - direct_in, 0.0);
        statistics.energy.emitted = emitted + shut_flux + (from_outside ? direct_in : sent);
        statistics.energy.absorbed = absorbed + shut_flux;
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
    double leaf_error = 0.0; // of what is gathered from leaves, relative to all light
    const auto publish = [&](LayerSet layers, bool final) {
        auto solution = std::make_shared<Solution>();
        solution->revision = options.revision;
        solution->final = final;
        solution->mean_radiance = layers.mean_radiance;
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
        solution->surfaces = std::move(layers.surfaces);
        solution->caustic_records = s.caustics.records;
        solution->statistics = statistics;
        latest = std::move(solution);
        if (on_snapshot) {
            on_snapshot(latest);
        }
    };

    timer.next("ray_scene");
    context.progress("ray_scene", 0.0);
    s.rays = std::make_unique<RayScene>(scene);
    s.punctual = std::make_unique<DirectLight>(scene, *s.rays, context);
    // The paper follows light over mirrors by particles alone.
    s.mirrors = options.paper_mode ? nullptr : std::make_unique<MirrorLight>(*s.rays);
    if (s.mirrors && s.mirrors->empty()) {
        s.mirrors.reset();
    }
    statistics.triangles = s.rays->triangle_count();
    QualitySettings quality = quality_settings(options.quality, s.rays->bounds().diagonal(), options.target_error);
    quality.caustics.paper = options.paper_mode;
    statistics.mode = options.paper_mode ? "paper" : "default";
    if (options.particles > 0) {
        quality.particles = options.particles;
    }
    s.field = quality.field;

    timer.next("hierarchy");
    context.progress("hierarchy", 0.03);
    HierarchySettings hierarchy_settings = quality.hierarchy;
    hierarchy_settings.seed = options.seed;
    s.hierarchy = build_hierarchy(*s.rays, hierarchy_settings);
    statistics.time.build = seconds_since(start);
    {
        const std::vector<std::uint32_t> leaves = s.hierarchy.leaves();
        const LeafSurroundings around = look_around(s.hierarchy, *s.rays, leaves, {quality.leaf_rays, {}}, context);
        if (context.should_stop()) {
            return stopped();
        }
        mark_rooms(s.hierarchy, leaves, around);
    }
    s.name_emitters(quality.emitter_contrast, quality.maps.cover_reach);

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
        if (!s.trace_particles(quality.particles / 16, options.seed, context)) {
            return stopped();
        }
    }
    float light_floor = s.guess_floor(quality);
    timer.next("charts");
    // Where no light comes straight from a source there is nothing to map.
    s.charts =
        s.nothing_direct() ? std::vector<SurfaceCharts>(s.rays->surfaces().size()) : chart_surfaces(*s.rays, quality.charts);
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
        const std::vector<DirectPart> parts = s.direct_parts(field.direct);
        s.maps = build_direct_maps(
            *s.rays, s.charts, parts, [&](std::uint32_t surface) { return s.rays->surfaces()[surface].back_side; }, settings,
            context, from, to);
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
            s.mirrors.get());
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
                s.caustics = build_caustic_light(*s.rays, s.charts, *s.particles, quality.caustics);
            }
            attach_caustics(set.surfaces, *s.rays, *s.particles, s.caustics);
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
        const LeafExchange exchange(s.hierarchy, leaves, around);
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
    };
    const auto refine_links = [&](float coarser, double at) {
        timer.next("links");
        context.progress("links", at);
        RefineSettings refine = quality.refine;
        refine.flux_threshold *= coarser;
        refine.rays = 0; // the leaves' own rays carry the light; links only tell where elements are too large
        const std::size_t old_count = s.hierarchy.elements.size();
        links.refine(s.hierarchy, *s.rays, refine, context);
        statistics.link_budget_reached = links.budget_reached();
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
        LayerSet first = layers(quality.first_layers, quality.first_field, 0.14, 0.2);
        timer.stop();
        if (!first.complete) {
            return stopped();
        }
        publish(std::move(first), false);
    }
    timer.next("particles");
    if (!s.trace_particles(quality.particles, options.seed, context)) {
        return stopped();
    }
    // The sharp light first: means of leaves over the coarse maps are off where light changes within a texel.
    if (!direct_maps(quality.maps, quality.field, 0.2, 0.45)) {
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
    context.progress("layers", 0.6);
    LayerSet set = layers(quality.layers, quality.field, 0.6, 1.0);
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
    if (!impl_->solved || !impl_->reflected) {
        return out;
    }
    FieldSettings field = impl_->field;
    for (GatherSettings* g : {&field.direct, &field.reflected.bright}) {
        g->rays *= 8; // a single sensor can afford what a picture cannot
        g->sky_rays *= 8;
        g->sun_rays *= 4;
        g->max_cut *= 4;
        g->tolerance *= 0.25F;
    }
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
