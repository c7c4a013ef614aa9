// What GiEngine keeps of a scene; for gi_engine*.cpp and what stands beside them only.
#pragma once

#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/layers/caustic_layer.h"
#include "engine/layers/covered_points.h"
#include "engine/layers/layer_builder.h"
#include "engine/particles/particle_map.h"
#include "engine/particles/specular_targets.h"
#include "engine/radiosity/direct_light.h"
#include "engine/radiosity/indirect_gather.h"
#include "engine/radiosity/lamp_slits.h"
#include "engine/radiosity/leaf_exchange.h"
#include "engine/radiosity/light_shafts.h"
#include "engine/radiosity/mirror_light.h"
#include "engine/radiosity/point_gather.h"
#include "engine/radiosity/sight_change.h"
#include "engine/raycast/ray_scene.h"
#include "engine/raycast/scene_charts.h"
#include "engine/solver/gi_engine.h"
#include "engine/solver/insides.h"
#include "engine/solver/lamp_moves.h"
#include "engine/solver/quality.h"
#include "engine/solver/reflected_change.h"
#include "engine/solver/relight.h"

#include <algorithm>
#include <map>

namespace atrium {

struct GiEngine::Impl {
    std::unique_ptr<RayScene> rays;
    std::unique_ptr<DirectLight> punctual; ///< sun, sky, point and spot lights
    std::vector<SurfaceCharts> charts;
    DirectMaps maps; ///< direct light on charted surfaces
    Hierarchy hierarchy;
    Hierarchy emitters;                   ///< the tree in which only named emitters shine; empty when there are none
    std::unique_ptr<MirrorLight> mirrors; ///< null where there is no flat mirror, and where the paper's ways are asked for
    std::unique_ptr<FarFaces> far_lamps;  ///< of `emitters`
    std::vector<SkyWindow> slits;         ///< before `emitters`
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

    /// Light maps of surfaces that were added since all was complete.
    struct AddedMaps {
        std::vector<SurfaceCharts> charts; ///< per surface; copies of theirs in Impl::charts, the others empty
        std::unique_ptr<LiveDirectMaps> maps;
    };
    /// What updates need beyond that; null unless asked for (SolveOptions::keep_for_updates) and complete.
    struct Live {
        std::unique_ptr<LiveDirectMaps> maps; ///< null where no light comes straight from a source
        std::vector<AddedMaps> added_maps;    ///< beside these
        LayerSet layers;                      ///< as shown, without `complete`
        std::vector<dmat4> placement;         ///< per surface
        std::shared_ptr<const Solution> shown;
        Scene scene;                                     ///< what of it light depends on
        SolveOptions options;                            ///< of the solve
        bool untouched = true;                           ///< no update since
        std::shared_ptr<LeafExchange> exchange;          ///< which leaves light which; Insides may share it
        std::unique_ptr<ReflectedChange> reflected;      ///< null until something moves
        std::map<std::uint32_t, Displacement> displaced; ///< by surface: what moved since the complete solution
        LightChange owed;                                ///< what a stopped update left undone
        std::vector<std::uint8_t> new_maps;              ///< per surface: its layer does not show its light maps yet
        std::vector<std::uint8_t> rough;    ///< per surface: appended in a hurry, to be looked at again; or empty
        std::vector<std::uint8_t> lit_anew; ///< per surface: all direct light on its vertices is of this update; or empty
        QualitySettings quality;
        float light_floor = 0.0F;               ///< lux: what counts as dark
        std::vector<Box3> settled_boxes;        ///< where what had moved stood when all was exact last
        std::vector<std::uint8_t> leaf_looked;  ///< per element: its direct light was sampled again then
        bool relit = false;                     ///< lamps or colours changed since the complete solution
        bool relight_owed = false;              ///< likewise, of lamps and colours
        std::vector<std::uint8_t> new_caustics; ///< per surface: its textures do not show its landings' power; or empty
        std::shared_ptr<Relight> relight;       ///< null until lamps or colours change, and once something moves
        std::unique_ptr<LampMoves> lamps;       ///< null until a lamp moves
        std::vector<float> sky_over_mirrors;    ///< LeafSurroundings::sky; empty where no mirror or lens shows any
        double mean_radiance = 0.0;             ///< as shown
        std::weak_ptr<const Insides> insides;   ///< as told last; `shown` has none
    };
    std::unique_ptr<Live> live;
    // Surfaces go without these maps again.
    void leave(const AddedMaps& added) {
        for (std::uint32_t i = 0; i < added.charts.size(); ++i) {
            if (!added.charts[i].empty()) {
                charts[i] = {};
                maps.front[i] = maps.back[i] = nullptr;
            }
        }
    }
    CausticSettings caustic_settings;
    std::vector<CausticWish> wishes; ///< see caustic_wishes()
    Rgb sky_radiance{0.0F};          ///< cd/m2
    // Shafts of the parts of direct light: what a change reaches. In the order of direct_parts().
    std::unique_ptr<MirrorLight> mirrors_before; ///< while a moved mirror's old light is taken away
    LightShafts mirror_shafts_before;
    LightShafts lamp_shafts, emitter_shafts, mirror_shafts, sky_shafts;
    bool looks_back = false;   ///< RayScene::look_back() said so in the update at hand
    bool mirror_moved = false; ///< since the complete solution

    // To be looked at; with `live` complete. Whoever shows it keeps it.
    std::shared_ptr<const Insides> tell_insides() {
        auto out = make_insides(*rays, hierarchy, live->exchange, particles.get(), targets.get());
        live->insides = out;
        return out;
    }
    [[nodiscard]] bool nothing_direct() const { return punctual->empty() && emitters.empty(); }
    // Direct light in parts, the sharpest and cheapest first; none that the scene does not have. `settings` must outlive it.
    [[nodiscard]] std::vector<DirectPart> direct_parts(const GatherSettings& settings) const {
        std::vector<DirectPart> parts;
        const auto add = [this, &parts](DirectFunction light, const LightShafts& shafts) -> DirectPart& {
            DirectPart& part = parts.emplace_back();
            part.light = std::move(light);
            part.touched = [&shafts](const vec3& p, float radius, const Box3& box) {
                return shafts.touched(p, radius, box);
            };
            part.meets_moved = [this, &shafts](const SurfacePoint& p, std::span<const Box3> boxes, bool closely) {
                return !looks_back || shafts.meets_moved(*rays, p, boxes, closely);
            };
            return parts.back();
        };
        if (!punctual->lights().empty()) {
            add([this, &settings](const vec3& p,
                                  const vec3& n) { return still_lamps().lamps_irradiance(p, n, settings.sun_rays); },
                lamp_shafts)
                .sharp = true;
        }
        if (!emitters.empty()) {
            add([this, &settings](const vec3& p, const vec3& n) { return lamps->irradiance(p, n, settings); },
                emitter_shafts);
        }
        if (mirrors && (!punctual->lights().empty() || !emitters.empty())) {
            DirectPart& part = add(
                [this, &settings](const vec3& p, const vec3& n) {
                    return mirrors->irradiance(p, n, settings, &still_lamps(), lamps.get());
                },
                mirror_shafts);
            part.sharp = true;
            part.straight = false;
            for (const PlanarMirror& mirror : mirrors->mirrors().mirrors()) {
                Box3& box = part.over.emplace_back();
                for (const vec3& corner : mirror.corner) {
                    box.add(corner);
                }
            }
            part.touched = [this](const vec3& p, float radius, const Box3& box) {
                return mirror_shafts.touched(p, radius, box) || mirror_shafts_before.touched(p, radius, box);
            };
            part.meets_moved = [this](const SurfacePoint& p, std::span<const Box3> boxes, bool closely) {
                return !looks_back || mirror_moved || mirror_shafts.meets_moved(*rays, p, boxes, closely);
            };
        }
        if (punctual->has_sky()) {
            add([this, &settings](const vec3& p,
                                  const vec3& n) { return punctual->sky_irradiance(p, n, settings.sky_rays); },
                sky_shafts)
                .soft = true;
        }
        return parts;
    }
    // Lamps that have not moved: those that did have a part of their own (LampMoves).
    [[nodiscard]] const DirectLight& still_lamps() const { return live && live->lamps ? *live->lamps->staying : *punctual; }
    // Lamps that particles are of: those that came later send theirs when all is solved anew.
    [[nodiscard]] std::unique_ptr<DirectLight> lamps_of_particles() const {
        std::vector<PlacedLight> known = punctual->lights();
        known.resize(live && live->lamps ? std::min(known.size(), live->lamps->first_new) : known.size());
        return std::make_unique<DirectLight>(std::move(known), *rays);
    }
    // From where direct light comes, for updates.
    void find_shafts() {
        lamp_shafts = emitter_shafts = mirror_shafts = sky_shafts = {};
        lamp_shafts.add_lamps(*punctual);
        emitter_shafts.add_emitters(emitters, 32);
        sky_shafts.add_sky(punctual->sky());
        if (mirrors) {
            mirror_shafts.add_lamps(*punctual);
            mirror_shafts.add_emitters(emitters, 8);
            mirror_shafts.over_mirrors(mirrors->mirrors());
        }
    }
    [[nodiscard]] bool direct_light_touched(const vec3& point, float radius, const Box3& box) const {
        return lamp_shafts.touched(point, radius, box) || emitter_shafts.touched(point, radius, box) ||
               (mirrors && mirror_shafts.touched(point, radius, box)) || mirror_shafts_before.touched(point, radius, box) ||
               sky_shafts.touched(point, radius, box);
    }
    // Where direct_light_touched(): it is not what it was when all was complete.
    [[nodiscard]] bool direct_light_meets_moved(const SurfacePoint& p, std::span<const Box3> boxes, bool closely) const {
        const auto any = [&](const LightShafts& shafts) { return shafts.meets_moved(*rays, p, boxes, closely); };
        return !looks_back || mirror_moved || (live && live->lamps) || any(lamp_shafts) || any(emitter_shafts) ||
               (mirrors && any(mirror_shafts)) || any(sky_shafts);
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

    // Reflected light at points, of the leaves as they are now; with `live`.
    [[nodiscard]] std::unique_ptr<IndirectGather> gather_reflected() const {
        return std::make_unique<IndirectGather>(
            hierarchy, *rays, bright_leaves(hierarchy, hierarchy.room, live->quality.bright_contrast),
            [this](const Hit& hit, Rgb& light) { return mapped_light(hit, light); }, sky_radiance, mirrors.get(),
            carried_by_particles());
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
    void name_emitters(float contrast, float cover_reach, const RunContext& context) {
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
        far_lamps = std::make_unique<FarFaces>(emitters, *rays);
        slits = find_lamp_slits(*rays, emitters, context);
        direct = std::make_unique<PointGather>(emitters, *rays, punctual.get(), far_lamps.get(), slits);
        lamps = std::make_unique<PointGather>(emitters, *rays, nullptr, far_lamps.get(), slits);
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
        return mean_of_maps(e, maps.front, maps.back, e.direct, spread);
    }

    // The flat chart that a leaf lies in; null where there is none, and so no map of its light either.
    [[nodiscard]] const Chart* chart_of(const Element& e) const {
        if (e.kind != Element::Kind::Patch || charts[e.surface].empty()) {
            return nullptr;
        }
        const SurfaceCharts& surface = charts[e.surface];
        const Sheet& sheet = hierarchy.sheets[hierarchy.patches[e.patch].sheet];
        const std::uint32_t index = surface.chart_of_triangle[hierarchy.sheet_triangles[sheet.first].triangle];
        return index != SurfaceCharts::kNone && surface.charts[index].planar ? &surface.charts[index] : nullptr;
    }

    // The mean over a leaf of what maps in the place of `maps` hold.
    bool mean_of_maps(const Element& e, const std::vector<std::shared_ptr<const LightMap>>& fronts,
                      const std::vector<std::shared_ptr<const LightMap>>& backs, Rgb& out, double& spread) const {
        const Chart* on = chart_of(e);
        if (on == nullptr) {
            return false;
        }
        const Chart& chart = *on;
        const auto& map = e.back ? backs[e.surface] : fronts[e.surface];
        constexpr int kSamples = 32;
        Rgb sum(0.0F);
        double sum2 = 0.0;
        const auto element = std::uint32_t(&e - hierarchy.elements.data());
        for (std::uint32_t i = 0; map && i < kSamples; ++i) {
            const vec2 u = sobol_owen2(i, 0, std::uint32_t(e.path));
            const Rgb light = map->irradiance(place_on(chart, sample_point(hierarchy, *rays, element, u, false).position));
            sum += light;
            sum2 += double(luminance(light)) * luminance(light);
        }
        out = sum / float(kSamples);
        const double mean = luminance(out);
        spread = std::sqrt(std::max(sum2 / kSamples - mean * mean, 0.0));
        return true;
    }

    // Of a leaf without a map.
    [[nodiscard]] static unsigned samples_of(const Element& e, const QualitySettings& quality) {
        return e.kind == Element::Kind::Patch ? quality.leaf_samples * 2 : quality.leaf_samples;
    }
    // Mean direct irradiance of a leaf; returns the standard deviation of its samples.
    float light_leaf(std::uint32_t index, const QualitySettings& quality) {
        Element& e = hierarchy.elements[index];
        if (double spread = 0.0; light_from_map(e, spread)) {
            return float(spread);
        }
        const unsigned most = samples_of(e, quality);
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
    bool trace_particles(std::uint32_t count, std::uint32_t seed, bool keep_paths, const RunContext& context) {
        particles.reset();
        caustics = {};
        if (!targets) {
            return true;
        }
        ParticleSettings settings;
        settings.particles = count;
        settings.seed = seed;
        settings.keep_paths = keep_paths;
        const auto by_image = [this](const Hit& hit) { return mirrors && mirrors->carries(hit); };
        particles = std::make_unique<ParticleMap>(*rays, *targets, *punctual, emitters, by_image, settings, context);
        return particles->complete();
    }

    [[nodiscard]] ParticleScene particle_scene(const DirectLight& lights) const {
        return {*rays,     *targets, lights, emitters, [this](const Hit& hit) { return mirrors && mirrors->carries(hit); },
                &hierarchy};
    }

    // Coordinates of a point of a flat chart in chart space.
    [[nodiscard]] static vec2 place_on(const Chart& chart, const vec3& position) {
        const vec3 from_corner = position - chart.origin;
        const vec2 at(glm::dot(from_corner, chart.axis_u), glm::dot(from_corner, chart.axis_v));
        return vec2(float(chart.tile_u), float(chart.tile_v)) + at / chart.scale;
    }

    // Images of matt surfaces (matt_images.cpp). Once it is known how bright these are: particles of those that stand out;
    // false when stopped. The leaves' exchange has this light too: it is only shown in another way.
    bool trace_matt_particles(const QualitySettings& quality, std::uint32_t seed, const RunContext& context);
    // What leaves send point by point as far as their light maps tell: shadows on a panel are seen in its image.
    [[nodiscard]] MattDetail matt_detail(const std::vector<std::uint32_t>& leaves) const;
    // What the hemisphere leaves to particles of matt surfaces; empty where there are none.
    [[nodiscard]] CarriedByParticles carried_by_particles() const;
    // Images become as bright as the surfaces are now; with `live`. What of the leaves' light they show.
    MattLight brighten_images(double tolerance) const;

    // What particles brought joins the light of the leaves that they landed on.
    void light_leaves_by_particles() {
        if (!particles) {
            return;
        }
        for (Element& e : hierarchy.elements) {
            e.caustic = Rgb(0.0F);
        }
        for (const Landing& l : particles->landings()) {
            if (particles->matt(particles->links()[l.link])) {
                continue; // the exchange has it
            }
            const std::uint32_t leaf = hierarchy.leaf_at(l.surface, l.triangle, l.back, l.barycentric);
            if (leaf != Element::kNone) {
                hierarchy.elements[leaf].caustic += particles->power(l) / hierarchy.elements[leaf].area;
            }
        }
        for (std::size_t i = 0; live && i < live->sky_over_mirrors.size(); ++i) { // and the sky in mirrors and lenses
            hierarchy.elements[live->exchange->leaves()[i]].caustic += kPi * sky_radiance * live->sky_over_mirrors[i];
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

/// Fewer rays as long as it lives: what moves is looked at for the blink of an eye.
class InAHurry {
public:
    explicit InAHurry(GatherSettings& settings) : settings_(settings), before_(settings) {
        settings.rays = std::max(settings.rays / 4, 8U);
        settings.sun_rays = std::max(settings.sun_rays / 2, 8U);
        settings.sky_rays = std::max(settings.sky_rays / 3, 16U);
        settings.tolerance *= 4.0F;
        settings.max_cut /= 2;
    }
    ~InAHurry() { settings_ = before_; }
    InAHurry(const InAHurry&) = delete;
    InAHurry& operator=(const InAHurry&) = delete;

private:
    GatherSettings& settings_;
    GatherSettings before_;
};

/// Where the particles landed, for Solution::landings.
std::shared_ptr<const std::vector<SurfaceLandings>> landing_places(const RayScene& rays, const ParticleMap* particles);

/// Surfaces whose wish is another now, ascending; both as caustic_wishes() makes them.
std::vector<std::uint32_t> surfaces_with_new_wishes(std::span<const CausticWish> before, std::span<const CausticWish> now);

} // namespace atrium
