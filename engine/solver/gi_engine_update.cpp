// Light that follows the hand: what GiEngine does while objects move.
#include "engine/optics/specular.h"
#include "engine/solver/gi_engine_impl.h"
#include "engine/solver/phase_timer.h"

#include <algorithm>
#include <chrono>
#include <tuple>

namespace atrium {
namespace {

constexpr std::size_t kMostBoxes = 8; // that are looked at singly

// Boxes that lie close together become one: every sample is tested against each. Of very many what is around all.
void join_boxes(std::vector<Box3>& boxes) {
    constexpr float kLittleMore = 1.25F; // diagonal of what is around both, over that of the larger
    for (bool joined = true; joined;) {
        joined = false;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            for (std::size_t k = i + 1; k < boxes.size();) {
                Box3 both = boxes[i];
                both.add(boxes[k]);
                if (both.diagonal() > kLittleMore * std::max(boxes[i].diagonal(), boxes[k].diagonal())) {
                    ++k;
                    continue;
                }
                boxes[i] = both;
                boxes.erase(boxes.begin() + std::ptrdiff_t(k));
                joined = true;
            }
        }
    }
    if (boxes.size() > kMostBoxes) {
        Box3 all;
        for (const Box3& b : boxes) {
            all.add(b);
        }
        boxes = {all};
    }
}

// Bounds before and after of what moved; of very many surfaces those of all together.
std::vector<Box3> boxes_of(std::span<const MovedSurface> moved) {
    std::vector<Box3> out;
    Box3 before, after;
    for (const MovedSurface& m : moved) {
        if (m.shown_before()) {
            before.add(m.before);
            out.push_back(m.before);
        }
        if (!m.absent) {
            after.add(m.after);
            out.push_back(m.after);
        }
    }
    if (out.size() > kMostBoxes) {
        out = {before, after};
        std::erase_if(out, [](const Box3& box) { return box.empty(); });
    }
    join_boxes(out);
    return out;
}

// Charts go with their surface; their coordinates and tiles stay. False where it was stretched.
bool follow(SurfaceCharts& charts, const dmat4& motion) {
    for (Chart& c : charts.charts) {
        const dvec3 u = dmat3(motion) * dvec3(c.axis_u), v = dmat3(motion) * dvec3(c.axis_v);
        constexpr double kStretch = 1e-4;
        if (c.planar && (std::abs(glm::length(u) - 1.0) > kStretch || std::abs(glm::length(v) - 1.0) > kStretch ||
                         std::abs(glm::dot(u, v)) > kStretch)) {
            return false;
        }
    }
    for (Chart& c : charts.charts) {
        if (c.planar) {
            c.origin = vec3(dvec3(motion * dvec4(dvec3(c.origin), 1.0)));
            c.axis_u = vec3(glm::normalize(dmat3(motion) * dvec3(c.axis_u)));
            c.axis_v = vec3(glm::normalize(dmat3(motion) * dvec3(c.axis_v)));
            c.normal = glm::normalize(glm::cross(c.axis_u, c.axis_v));
        }
    }
    return true;
}

void follow(std::vector<SurfacePoint>& places, const dmat4& motion) {
    const dmat3 turn = glm::transpose(glm::inverse(dmat3(motion)));
    for (SurfacePoint& p : places) {
        if (p.normal != vec3(0.0F)) {
            p.position = vec3(dvec3(motion * dvec4(dvec3(p.position), 1.0)));
            p.normal = vec3(glm::normalize(turn * dvec3(p.normal)));
        }
    }
}

} // namespace

// What lies on what now: vertices by the boxes of the change, and on what moved.
void GiEngine::cover_vertices(Impl& s, const RunContext& context) {
    Impl::Live& live = *s.live;
    const float reach = live.quality.layers.cover_reach;
    parallel_chunks(live.layers.places.size(), 4, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            VertexPlaces& places = live.layers.places[i];
            const bool moved = live.owed.moved[places.surface] != 0;
            for (const bool back : {false, true}) {
                const std::vector<SurfacePoint>& side = places.side(back);
                for (std::size_t v = 0; v < side.size(); ++v) {
                    const vec3& p = side[v].position;
                    const bool near = side[v].normal != vec3(0.0F) &&
                                      (moved || std::any_of(live.owed.boxes.begin(), live.owed.boxes.end(),
                                                            [&](const Box3& box) { return distance_to(box, p) <= reach; }));
                    if (near) {
                        const auto bit = std::uint8_t(back ? 2U * VertexPlaces::kCovered : VertexPlaces::kCovered);
                        const bool covered = is_out_of_sight(*s.rays, p, side[v].normal, reach);
                        places.state[v] = std::uint16_t(covered ? places.state[v] | bit : places.state[v] & ~bit);
                    }
                }
            }
        }
    });
}

// Direct light on the vertices that a change may reach and that no chart holds, and the light maps that are new.
void GiEngine::show_direct_light(Impl& s, const LightChange& change, const RunContext& context) {
    Impl::Live& live = *s.live;
    struct Look {
        float angle = 0.0F; ///< how large what moved looks from there
        std::uint32_t layer = 0, vertex = 0;
        bool back = false;
        bool met = false; ///< something that moved lies between it and a source, or beside it
        Rgb light{0.0F};
    };
    std::vector<std::vector<Look>> found(live.layers.surfaces.size());
    parallel_chunks(found.size(), 4, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            VertexPlaces& places = live.layers.places[i];
            if (places.surface < live.lit_anew.size() && live.lit_anew[places.surface] != 0) {
                for (std::size_t k = 0; k < places.state.size(); ++k) {
                    places.set_differs(k, false, true);
                    places.set_differs(k, true, true);
                }
                continue;
            }
            const bool moved = change.moved[places.surface] != 0;
            Box3 bounds;
            for (std::size_t k = 0; k < places.front.size(); ++k) {
                if (places.shows_direct(k, false)) {
                    bounds.add(places.front[k].position);
                }
            }
            const bool reached =
                moved || (!bounds.empty() && std::any_of(change.boxes.begin(), change.boxes.end(), [&](const Box3& box) {
                    return s.direct_light_touched(bounds.centre(), 0.5F * bounds.diagonal(), box);
                }));
            for (std::uint32_t k = 0; k < places.front.size(); ++k) {
                for (const bool back : {false, true}) {
                    if (k >= places.side(back).size() || !places.shows_direct(k, back)) {
                        continue;
                    }
                    const SurfacePoint& p = places.side(back)[k];
                    float angle = change.exact && places.stale(k, back) ? 2.0F : 0.0F;
                    bool met = moved;
                    for (const Box3& box : change.boxes) {
                        if (reached && (moved || s.direct_light_touched(p.position, 0.0F, box))) {
                            const float distance = glm::length(box.centre() - p.position);
                            angle = std::max(angle, box.diagonal() / std::max(distance, 1e-3F));
                            met = met || distance_to(box, p.position) <= live.quality.layers.cover_reach;
                        }
                    }
                    if (angle > 0.0F) {
                        found[i].push_back({angle, std::uint32_t(i), k, back, met, Rgb(0.0F)});
                    }
                }
            }
        }
    });
    std::vector<Look> looks;
    for (const std::vector<Look>& of : found) {
        looks.insert(looks.end(), of.begin(), of.end());
    }
    const auto place = [](const Look& l) { return std::tuple(l.layer, l.back, l.vertex); };
    // Of very many those from where most is seen of what moved; the others wait until the light settles.
    constexpr std::size_t kMost = 3000;
    if (!change.exact && looks.size() > kMost) {
        std::sort(looks.begin(), looks.end(), [&](const Look& a, const Look& b) {
            return a.angle != b.angle ? a.angle > b.angle : place(a) < place(b);
        });
        looks.resize(kMost);
    }
    std::sort(looks.begin(), looks.end(), [&](const Look& a, const Look& b) { return place(a) < place(b); });
    parallel_chunks(looks.size(), 16, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            Look& l = looks[i];
            const SurfacePoint& p = live.layers.places[l.layer].side(l.back)[l.vertex];
            l.met = l.met || s.direct_light_meets_moved(p, change.boxes, change.exact);
        }
    });
    // What met something when it was looked at last, and meets nothing now, gets back the light that it had.
    std::erase_if(looks, [&](const Look& l) {
        VertexPlaces& places = live.layers.places[l.layer];
        const bool differs = places.differs(l.vertex, l.back) || places.stale(l.vertex, l.back);
        places.set_differs(l.vertex, l.back, l.met);
        return !l.met && !differs;
    });
    const auto mark = [&](bool stale) {
        for (const Look& l : looks) {
            live.layers.places[l.layer].set_stale(l.vertex, l.back, stale);
        }
    };
    mark(true); // until all of them were really looked at
    parallel_chunks(looks.size(), 16, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            const SurfacePoint& p = live.layers.places[looks[i].layer].side(looks[i].back)[looks[i].vertex];
            looks[i].light = s.direct_light(p.position, p.normal, s.field.direct).irradiance;
        }
    });
    if (context.should_stop()) {
        return;
    }
    for (std::size_t i = 0; live.lamps && i < looks.size(); ++i) {
        live.lamps->sampled_vertex(s, looks[i].layer, looks[i].vertex, looks[i].back);
    }
    if (change.exact) {
        mark(false);
    }
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < live.layers.surfaces.size(); ++i) {
        const std::uint32_t surface = live.layers.places[i].surface;
        const std::size_t first = next;
        for (; next < looks.size() && looks[next].layer == i; ++next) {
        }
        if (first == next && live.new_maps[surface] == 0) {
            continue;
        }
        auto layer = std::make_shared<SurfaceLayer>(*live.layers.surfaces[i]);
        for (std::size_t k = first; k < next; ++k) {
            std::vector<Rgb>& light = looks[k].back ? layer->direct_back : layer->direct_front;
            light.resize(looks[k].back ? layer->irradiance_back.size() : layer->irradiance_front.size(), Rgb(0.0F));
            light[looks[k].vertex] = looks[k].light;
        }
        if (!s.charts[surface].empty()) {
            layer->direct_map_front = s.maps.front[surface];
            layer->direct_map_back = s.maps.back[surface];
        }
        live.layers.surfaces[i] = std::move(layer);
    }
}

std::vector<std::shared_ptr<const SurfaceLayer>> GiEngine::shown_surfaces(const Impl& s) {
    std::vector<std::shared_ptr<const SurfaceLayer>> out;
    for (std::size_t i = 0; i < s.live->layers.surfaces.size(); ++i) {
        if (!s.rays->absent(s.live->layers.places[i].surface)) {
            out.push_back(s.live->layers.surfaces[i]);
        }
    }
    return out;
}

bool GiEngine::can_update() const { return impl_->live != nullptr; }

Result<std::shared_ptr<const Solution>> GiEngine::update(const Scene& scene, const SolveOptions& options,
                                                         const RunContext& context) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto seconds_since_start = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    const auto give_up = [&](const std::string& why) {
        impl_->live.reset(); // half of it may have followed already
        return fail("", "", why, "A whole new solution answers");
    };
    Impl& s = *impl_;
    if (!s.live) {
        return fail("", "", "there is no complete light to start from", "Solve first");
    }
    if (s.hierarchy.empty()) {
        return give_up("nothing is lit");
    }
    Impl::Live& live = *s.live;
    live.untouched = false;
    const std::uint64_t rays_before = s.rays->rays_traced();
    context.progress("ray_scene", 0.0);
    live.lit_anew.clear();
    if (!live.added_maps.empty() && Relight::changed(s, scene)) {
        forget_added_maps(s);
    }
    const auto lamps_moved = LampMoves::follow(s, scene, context);
    if (!lamps_moved) {
        return tl::unexpected(lamps_moved.error());
    }
    const bool follow_lamps = LampMoves::needed(s, options.settle);
    if (follow_lamps && live.relight) {
        live.relight->settle(s);
        live.relight.reset();
    }
    const auto relit = Relight::follow(s, scene, context);
    if (!relit) {
        return context.should_stop() ? fail("", "", relit.error().what, "The next update goes on")
                                     : give_up(relit.error().what);
    }
    const auto first_new = std::uint32_t(s.rays->surfaces().size());
    const auto moved = s.rays->move_to(scene, NewThings::Append);
    if (!moved) {
        return give_up("more than places and colours changed");
    }
    s.looks_back = s.rays->look_back();
    LightChange& change = live.owed;
    const bool moves = !moved->empty() || !change.boxes.empty() || follow_lamps;
    if (moves && live.relight) {
        live.relight->settle(s);
        live.relight.reset();
    }
    if (live.lamps && relit->any && !follow_lamps) {
        live.lamps->forget();
    }
    const bool looks = moves || (options.settle && !live.displaced.empty());
    change.moved.resize(s.rays->surfaces().size(), 0);
    const std::vector<Box3> boxes = boxes_of(*moved);
    change.boxes.insert(change.boxes.end(), boxes.begin(), boxes.end());
    join_boxes(change.boxes);
    bool mirror_moved = false;
    for (const MovedSurface& m : *moved) {
        const RaySurface& surface = s.rays->surfaces()[m.surface];
        const Material& material = s.rays->material(m.surface);
        if (max_component(material.emitted_radiance()) > 0.0F || surface.pane) {
            return give_up("a shining surface or a window moved");
        }
        if (m.came_or_went && is_specular(material)) {
            return give_up("a mirror, metal or glass came or went");
        }
        if (m.added) {
            change.moved[m.surface] = 1;
            live.displaced[m.surface] = {m.before, m.after};
            continue;
        }
        const dmat4 motion = surface.to_engine * glm::inverse(live.placement[m.surface]);
        live.placement[m.surface] = surface.to_engine;
        if (!follow(s.charts[m.surface], motion)) {
            return give_up("something was stretched");
        }
        for (Impl::AddedMaps& added : live.added_maps) {
            if (m.surface < added.charts.size()) {
                (void)follow(added.charts[m.surface], motion);
            }
        }
        for (VertexPlaces& places : live.layers.places) {
            if (places.surface == m.surface) {
                follow(places.front, motion);
                follow(places.back, motion);
            }
        }
        const bool absent = s.rays->absent(m.surface); // its own light is of no use to anybody
        change.moved[m.surface] = absent ? 0 : 1;
        s.hierarchy.follow(m.surface, motion);
        live.displaced.try_emplace(m.surface, Displacement{m.before, m.after}).first->second.now = absent ? Box3{} : m.after;
        mirror_moved = mirror_moved || is_specular(material);
    }
    s.mirror_moved = s.mirror_moved || mirror_moved;
    if (mirror_moved && s.mirrors) {
        if (!s.mirrors_before) { // what it threw where it stood has to go too
            s.mirrors_before = std::move(s.mirrors);
            s.mirror_shafts_before = s.mirror_shafts;
        }
        s.mirrors = std::make_unique<MirrorLight>(*s.rays);
        s.find_shafts();
    }
    std::optional<InAHurry> fewer_rays;
    if (!options.settle) {
        fewer_rays.emplace(s.field.direct);
    }
    if (first_new < s.rays->surfaces().size()) {
        take_in(s, first_new);
    }
    auto solution = std::make_shared<Solution>(*live.shown);
    UpdateStatistics& report = solution->statistics.update;
    report = {};
    live.relit = live.relit || relit->any || *lamps_moved > 0;
    report.degraded = !options.settle || live.relit; // reflected light on vertices only follows what leaves say
    report.sources_changed = relit->sources + *lamps_moved;
    report.materials_changed = relit->materials;

    context.progress("direct", 0.1);
    PhaseTimer timer(solution->statistics);
    solution->statistics.phases.clear();
    timer.next("direct");
    const std::size_t old_maps = live.added_maps.size();
    live.new_maps.resize(s.rays->surfaces().size(), 0);
    if (options.settle && !finish_layers(s, context)) {
        return fail("", "", "stopped before the light had followed", "The next update goes on");
    }
    LightChange look_at = change;
    look_at.exact = options.settle;
    look_at.looks_back = s.looks_back;
    look_at.mirror_moved = s.mirror_moved;
    look_at.anew = follow_lamps ? live.lamps->part : LightChange::kNone;
    if (options.settle) {
        for (const auto& [surface, d] : live.displaced) {
            if (!d.before.empty()) { // it was there
                look_at.boxes.push_back(d.before);
            }
            if (!d.now.empty()) {
                look_at.boxes.push_back(d.now);
                look_at.moved[surface] = 1;
            }
        }
        look_at.boxes.insert(look_at.boxes.end(), live.settled_boxes.begin(), live.settled_boxes.end());
        join_boxes(look_at.boxes);
    }
    RepairReport repaired;
    repaired.complete = true;
    if (live.maps && looks) {
        repaired = live.maps->repair(look_at, s.maps, context);
    }
    for (std::size_t i = 0; i < old_maps && looks && repaired.complete; ++i) {
        const RepairReport also = live.added_maps[i].maps->repair(look_at, s.maps, context);
        repaired.surfaces.insert(repaired.surfaces.end(), also.surfaces.begin(), also.surfaces.end());
        repaired.complete = also.complete;
    }
    for (const std::uint32_t surface : repaired.surfaces) {
        live.new_maps[surface] = 1;
    }
    if (!repaired.complete) {
        return fail("", "", "stopped before the light had followed", "The next update goes on");
    }
    if (moves) {
        cover_vertices(s, context);
    }
    if (follow_lamps) {
        live.lamps->light_vertices(s, context);
    }
    if (s.particles && moves) {
        context.progress("particles", 0.4);
        timer.next("particles");
    }
    if (const auto traced = trace_again(s, scene, moves, report, context); !traced) {
        return context.should_stop() ? tl::unexpected(traced.error()) : give_up(traced.error().what);
    }
    if (live.exchange) {
        context.progress("gather", 0.6);
        timer.next("gather");
        if (live.relight && live.displaced.empty()) {
            if (relit->any) {
                live.relight->reflect(s, context);
            }
        } else if (looks || relit->any) {
            if (looks) {
                light_leaves_again(s, look_at, context);
            }
            if (follow_lamps) {
                live.lamps->light_leaves(s, options.settle, context);
                s.light_leaves_by_particles();
            }
            reflect_change(s, !options.settle, context);
        }
        if (context.should_stop()) {
            return fail("", "", "stopped before the light had followed", "The next update goes on");
        }
    }
    const std::vector<std::uint32_t> new_textures = surfaces_with_new_caustics(s);
    if (s.particles && (moves || !new_textures.empty())) {
        timer.next("caustics");
        const CausticReuse reuse{s.caustics, new_textures};
        CausticLight light =
            build_caustic_light(*s.rays, s.charts, *s.particles, s.caustic_settings, &reuse, s.wishes, context);
        if (context.should_stop()) {
            return fail("", "", "stopped before the light had followed", "The next update goes on");
        }
        s.caustics = std::move(light);
    }

    context.progress("layers", 0.8);
    timer.next("layers");

    show_direct_light(s, look_at, context);
    if (context.should_stop()) {
        return fail("", "", "stopped before the light had followed", "The next update goes on");
    }
    if (s.particles && (moves || !new_textures.empty()) &&
        !attach_caustics(live.layers.surfaces, *s.rays, *s.particles, s.caustics, context)) {
        return fail("", "", "stopped before the light had followed", "The next update goes on");
    }
    change = {};
    live.lit_anew.clear();
    live.relight_owed = false;
    if (follow_lamps) {
        live.lamps->owed = false;
        live.lamps->exact = options.settle;
        live.mean_radiance = live.lamps->mean_radiance(s);
    }
    live.new_caustics.clear();
    live.new_maps.clear();
    if (options.settle) {
        live.settled_boxes.clear();
        for (const auto& [surface, d] : live.displaced) {
            if (!d.now.empty()) {
                live.settled_boxes.push_back(d.now);
            }
        }
        join_boxes(live.settled_boxes);
    }
    s.mirrors_before.reset();
    s.mirror_shafts_before = {};
    solution->revision = options.revision;
    solution->final = false;
    solution->surfaces = shown_surfaces(s);
    solution->caustic_records = s.caustics.records;
    std::erase_if(solution->caustic_records,
                  [&](const CausticRecord& r) { return scene.nodes.find(r.node) == nullptr || !scene.shown(r.node); });
    solution->landings = options.keep_landings ? landing_places(*s.rays, s.particles.get()) : nullptr;
    if (options.keep_insides) {
        solution->insides = options.settle ? nullptr : live.insides.lock(); // a hand does not wait for copies
        if (!solution->insides) {
            solution->insides = s.tell_insides();
        }
    }
    solution->mean_radiance = live.relight ? live.relight->mean_radiance * live.relight->brightening(s) : live.mean_radiance;
    if ((live.relight || live.lamps) && live.exchange) {
        s.energy_balance(*live.exchange, solution->statistics);
    }
    solution->statistics.converged = false;
    timer.stop();
    solution->statistics.rays = s.rays->rays_traced() - rays_before;
    solution->statistics.time.solve = seconds_since_start();
    solution->statistics.time.total = solution->statistics.time.solve;
    return std::shared_ptr<const Solution>(solution);
}

} // namespace atrium
