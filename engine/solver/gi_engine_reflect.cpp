// Reflected light that follows the hand: what leaves send on now, and what they see otherwise than before.
#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/optics/specular.h"
#include "engine/radiosity/leaf_surroundings.h"
#include "engine/solver/gi_engine_impl.h"

#include <algorithm>

namespace atrium {
namespace {

/// How much is looked at in one update.
struct ReflectEffort {
    SightChange::Effort leaves;
    SightChange::Effort vertices;
    float least_share;         ///< of a vertex' hemisphere that what moved fills: below it the leaf's word is enough
    float whole_share;         ///< the same from which all of its light is gathered anew, as a new solution would
    std::size_t most_vertices; ///< those that see most of it
    double tolerance;
    int most_sweeps;
};
constexpr ReflectEffort kHurried{{64.0F, 1, 16}, {96.0F, 4, 96}, 0.015F, 2.0F, 4000, 0.01, 8};
constexpr ReflectEffort kExact{{256.0F, 4, 64}, {512.0F, 8, 256}, 0.002F, 0.4F, 1U << 20, 1e-4, 60};

// Changes of what matt surfaces send that their images do not show, relative.
constexpr double kHurriedImages = 0.05;
constexpr double kExactImages = 0.002;

constexpr std::size_t kMostBodies = 4; // that are looked at singly

// What moved and stands elsewhere than before; of many surfaces the bounds of all together.
std::vector<Displacement> bodies_of(const std::map<std::uint32_t, Displacement>& displaced) {
    std::vector<Displacement> out;
    Displacement all;
    for (const auto& [surface, d] : displaced) {
        out.push_back(d);
        all.before.add(d.before);
        all.now.add(d.now);
    }
    if (out.size() > kMostBodies) {
        out = {all};
    }
    return out;
}

} // namespace

// The radiosity that hemisphere rays read where they land.
Rgb GiEngine::sent_back(const Impl& s, const Hit& hit) {
    const std::uint32_t leaf = s.hierarchy.leaf_at(hit.surface, hit.triangle, !hit.front, hit.barycentric);
    if (leaf == Element::kNone) {
        return Rgb(0.0F);
    }
    const Element& e = s.hierarchy.elements[leaf];
    Rgb direct(0.0F);
    return s.mapped_light(hit, direct) ? e.emitted + e.rho * (direct + e.caustic + e.irradiance) : e.radiosity;
}

// Leaves of what moved, and of what something lay or lies on, look around anew; all others only towards where it is and was.
// `carried` = of the light that changed sight makes, per leaf, what particles bring; empty where there is none.
std::vector<Rgb> GiEngine::solve_with_new_sight(Impl& s, const SightChange& sight, bool in_a_hurry,
                                                std::vector<Rgb>& carried, const RunContext& context) {
    Impl::Live& live = *s.live;
    const ReflectEffort& effort = in_a_hurry ? kHurried : kExact;
    const float reach = live.quality.maps.cover_reach;
    const auto anew = [&](std::uint32_t leaf) {
        const Element& e = s.hierarchy.elements[leaf];
        const std::uint32_t surface = e.kind == Element::Kind::Patch ? e.surface : s.hierarchy.faces[e.triangle].surface;
        if (s.rays->absent(surface)) {
            return false;
        }
        if (live.displaced.contains(surface)) {
            return true;
        }
        return std::any_of(live.displaced.begin(), live.displaced.end(), [&](const auto& d) {
            const auto touches = [&](const Box3& box) { return distance_to(box, e.centre) <= reach + e.radius; };
            return touches(d.second.before) || touches(d.second.now);
        });
    };
    LookSettings look;
    look.rays = in_a_hurry ? std::max(live.quality.leaf_rays / 4, 16U) : live.quality.leaf_rays;
    look.covered = [&](const SurfacePoint& p) { return is_covered(*s.rays, p.position, p.normal, reach); };
    const SightChange::Rows rows = sight.rows(s.hierarchy, live.exchange->leaves(), effort.leaves, anew, look, context);
    if (context.should_stop()) {
        return {};
    }
    std::vector<Rgb> beside =
        solve_with_changed_sight(s.hierarchy, *live.exchange, rows, effort.tolerance, effort.most_sweeps, context);
    if (!rows.carried.empty()) {
        for (std::size_t i = 0; i < beside.size(); ++i) {
            carried.push_back(rows.carried_light(s.hierarchy, live.exchange->leaves(), i));
        }
    }
    return beside;
}

// Vertices that see something of what moved look for themselves; those that see much, and those on it, gather all anew,
// through a few records.
std::vector<std::vector<VertexChange>> GiEngine::look_from_vertices(Impl& s, const SightChange& sight, bool in_a_hurry,
                                                                    const RunContext& context) {
    Impl::Live& live = *s.live;
    const ReflectEffort& effort = in_a_hurry ? kHurried : kExact;
    struct Look {
        float share = 0.0F;
        std::uint32_t layer = 0;
        VertexChange change;
    };
    // Where light goes over what moved, changed sight does not know: see SightChange.
    constexpr float kWholeBesideMirrors = 0.05F;
    const bool mirrors = !in_a_hurry && std::any_of(live.displaced.begin(), live.displaced.end(),
                                                    [&](const auto& d) { return is_specular(s.rays->material(d.first)); });
    const float whole_share = mirrors ? std::min(effort.whole_share, kWholeBesideMirrors) : effort.whole_share;
    std::vector<std::vector<Look>> found(live.layers.surfaces.size());
    parallel_chunks(found.size(), 4, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            const VertexPlaces& places = live.layers.places[i];
            if (s.rays->absent(places.surface)) {
                continue;
            }
            const bool moved = live.displaced.contains(places.surface);
            for (std::uint32_t v = 0; v < places.front.size(); ++v) {
                for (const bool back : {false, true}) {
                    const std::vector<SurfacePoint>& side = places.side(back);
                    if (v >= side.size() || side[v].normal == vec3(0.0F)) {
                        continue;
                    }
                    using Kind = VertexChange::Kind;
                    if (places.covered(v, back)) {
                        if (moved || !places.was_covered(v, back)) {
                            found[i].push_back({2.0F, std::uint32_t(i), {v, back, Kind::Covered, Rgb(0.0F)}});
                        }
                        continue;
                    }
                    const float share = sight.share(side[v].position, side[v].normal);
                    if (moved || places.was_covered(v, back) || share > whole_share) {
                        found[i].push_back({2.0F, std::uint32_t(i), {v, back, Kind::Whole, Rgb(0.0F)}});
                    } else if (share > effort.least_share) {
                        found[i].push_back({share, std::uint32_t(i), {v, back, Kind::Sight, Rgb(0.0F)}});
                    }
                }
            }
        }
    });
    std::vector<Look> looks;
    for (const std::vector<Look>& of : found) {
        looks.insert(looks.end(), of.begin(), of.end());
    }
    if (looks.size() > effort.most_vertices) {
        std::vector<float> shares;
        for (const Look& l : looks) {
            shares.push_back(l.share);
        }
        std::nth_element(shares.begin(), shares.begin() + std::ptrdiff_t(effort.most_vertices - 1), shares.end(),
                         std::greater<>());
        // The share of many may be the same, as of all vertices of a large thing that moved.
        const float least = shares[effort.most_vertices - 1];
        auto room = std::ptrdiff_t(effort.most_vertices) -
                    std::count_if(shares.begin(), shares.end(), [&](float share) { return share > least; });
        std::erase_if(looks, [&](const Look& l) { return l.share < least || (l.share == least && room-- <= 0); });
    }
    const auto place_of = [&](const Look& l) -> const SurfacePoint& {
        return live.layers.places[l.layer].side(l.change.back)[l.change.vertex];
    };
    IndirectSettings gather = s.field.reflected;
    CacheSettings records = s.field.cache;
    records.light_floor = live.light_floor;
    if (in_a_hurry) {
        gather.rays = std::min(gather.rays, 32U);
        gather.max_rays = gather.rays;
        gather.bright.rays = std::max(gather.bright.rays / 4, 4U);
        records.spacing *= 2.0F;
        records.to_nearest *= 3.0F;
        records.smallest_reach = std::max(records.smallest_reach, 0.1F);
        records.contrast *= 4.0F;
    }
    std::vector<SurfacePoint> own;
    for (const Look& l : looks) {
        if (l.change.kind == VertexChange::Kind::Whole) {
            own.push_back(place_of(l));
        }
    }
    std::unique_ptr<IndirectGather> reflected;
    std::unique_ptr<IrradianceCache> cache;
    if (!own.empty()) {
        reflected = s.gather_reflected();
        cache = std::make_unique<IrradianceCache>(
            *s.rays, [&](const vec3& p, const vec3& n) { return reflected->irradiance(p, n, gather); }, records);
        if (!cache->cover(own, context)) {
            return {};
        }
    }
    parallel_chunks(looks.size(), 16, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            const SurfacePoint& p = place_of(looks[i]);
            VertexChange& change = looks[i].change;
            if (change.kind == VertexChange::Kind::Whole) {
                change.light = cache->at(p.position, p.normal).irradiance;
            } else if (change.kind == VertexChange::Kind::Sight) {
                change.light = sight.irradiance(p, effort.vertices, [&](const Hit& hit) { return sent_back(s, hit); });
            }
        }
    });
    std::vector<std::vector<VertexChange>> out(live.layers.surfaces.size());
    for (const Look& l : looks) {
        out[l.layer].push_back(l.change);
    }
    return out;
}

// Direct light on leaves: from maps that are new and, where all is to be exact, by samples where no map lies.
void GiEngine::light_leaves_again(Impl& s, const LightChange& change, const RunContext& context) {
    Impl::Live& live = *s.live;
    const std::vector<std::uint32_t>& leaves = live.exchange->leaves();
    live.leaf_looked.resize(s.hierarchy.elements.size(), 0);
    // From any of the places that its light is sampled at.
    const auto meets_moved = [&](std::uint32_t leaf) {
        const Element& e = s.hierarchy.elements[leaf];
        const bool beside = std::any_of(change.boxes.begin(), change.boxes.end(), [&](const Box3& box) {
            return distance_to(box, e.centre) <= live.quality.maps.cover_reach + e.radius;
        });
        for (unsigned k = 0, most = s.samples_of(e, live.quality); !beside && k < most; ++k) {
            const vec2 u = sobol_owen2(k, 0, std::uint32_t(e.path));
            if (s.direct_light_meets_moved(sample_point(s.hierarchy, *s.rays, leaf, u, false), change.boxes, change.exact)) {
                return true;
            }
        }
        return beside;
    };
    parallel_chunks(leaves.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            Element& e = s.hierarchy.elements[leaves[i]];
            double spread = 0.0;
            const bool mapped = e.kind == Element::Kind::Patch && !s.charts[e.surface].empty();
            if (mapped && (live.new_maps[e.surface] == 0 || s.light_from_map(e, spread))) {
                continue;
            }
            if (!change.exact) {
                continue;
            }
            const std::uint32_t surface = e.kind == Element::Kind::Patch ? e.surface : s.hierarchy.faces[e.triangle].surface;
            const bool touched =
                change.moved[surface] != 0 || std::any_of(change.boxes.begin(), change.boxes.end(), [&](const Box3& box) {
                    return s.direct_light_touched(e.centre, e.radius, box);
                });
            const bool reached = touched && (change.moved[surface] != 0 || meets_moved(leaves[i]));
            if (reached || live.leaf_looked[leaves[i]] != 0) {
                (void)s.light_leaf(leaves[i], live.quality);
                if (live.lamps) {
                    live.lamps->sampled_leaf(s, leaves[i]);
                }
                live.leaf_looked[leaves[i]] = reached ? 1 : 0;
            }
        }
    });
}

void GiEngine::reflect_change(Impl& s, bool in_a_hurry, const RunContext& context) {
    Impl::Live& live = *s.live;
    if (!live.reflected) {
        live.reflected = std::make_unique<ReflectedChange>(s.hierarchy, *s.rays, live.layers);
    }
    const std::vector<std::uint32_t>& leaves = live.exchange->leaves();
    std::unique_ptr<SightChange> sight;
    if (!live.displaced.empty() && s.rays->look_back()) {
        std::vector<std::uint8_t> moved(s.rays->surfaces().size(), 0);
        for (const auto& [surface, d] : live.displaced) {
            moved[surface] = 1;
        }
        sight =
            std::make_unique<SightChange>(s.hierarchy, *s.rays, bodies_of(live.displaced), moved, s.carried_by_particles());
    }
    std::vector<Rgb> beside, carried;
    std::vector<std::vector<VertexChange>> known;
    const ReflectEffort& effort = in_a_hurry ? kHurried : kExact;
    if (sight) {
        beside = solve_with_new_sight(s, *sight, in_a_hurry, carried, context);
    } else {
        solve_radiosity(s.hierarchy, *live.exchange, effort.tolerance, effort.most_sweeps, context);
    }
    std::vector<Rgb> beside_of_elements;
    if (!beside.empty()) {
        beside_of_elements.assign(s.hierarchy.elements.size(), Rgb(0.0F));
        for (std::size_t i = 0; i < leaves.size(); ++i) {
            beside_of_elements[leaves[i]] = beside[i];
        }
    }
    MattLight images = s.brighten_images(in_a_hurry ? kHurriedImages : kExactImages);
    for (std::size_t i = 0; i < carried.size(); ++i) {
        images.now[leaves[i]] += carried[i];
        beside_of_elements[leaves[i]] -= carried[i];
    }
    if (sight && !context.should_stop()) {
        known = look_from_vertices(s, *sight, in_a_hurry, context);
    }
    if (context.should_stop()) {
        return;
    }
    live.reflected->add_to(s.hierarchy, beside_of_elements, known, live.layers.surfaces, images);
}

} // namespace atrium
