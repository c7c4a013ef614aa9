// Things that were not there when all light was computed: what updates need of them. The rest of the light follows as it
// does when something comes from far away.
#include "engine/base/checks.h"
#include "engine/optics/specular.h"
#include "engine/solver/gi_engine_impl.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kMostLeaves = 600; // of what is added in one go, where its large pieces are divided

// Large planar pieces are divided as a first look would, without asking where light falls on them.
void divide(Hierarchy& h, const RayScene& rays, std::uint32_t first, float smallest_patch) {
    std::size_t leaves = 0;
    for (std::uint32_t i = first; i < h.elements.size(); ++i) {
        leaves += h.elements[i].leaf() ? 1 : 0;
    }
    for (std::uint32_t i = first; i < h.elements.size() && leaves < kMostLeaves; ++i) { // parts come behind all
        const Element& e = h.elements[i];
        if (e.leaf() && e.radius > smallest_patch && h.can_split(i)) {
            h.split(i, rays);
            leaves += h.elements[i].child_count - 1U;
        }
    }
}

// New leaves are in the room of the first old leaf that they see, or that one of them sees.
void find_rooms(Hierarchy& h, const std::vector<std::uint32_t>& leaves, const LeafSurroundings& around) {
    if (h.room.empty()) {
        return;
    }
    std::uint32_t any = Element::kNone;
    for (const bool all : {false, true}) {
        for (std::size_t i = 0; i < leaves.size(); ++i) {
            std::uint32_t& room = h.room[leaves[i]];
            for (std::size_t k = around.first_seen[i]; k < around.first_seen[i + 1] && room == Element::kNone; ++k) {
                room = h.room[around.seen[k].leaf];
            }
            any = any == Element::kNone ? room : any;
            room = all && room == Element::kNone ? any : room;
        }
    }
}

} // namespace

// Takes over the surfaces of the ray scene from `first` on: elements, light that falls on them straight, layers with a
// coarse mesh. It cannot be stopped half-way: no longer than what a hurried update may take.
void GiEngine::take_in(Impl& s, std::uint32_t first) {
    constexpr std::uint32_t kRays = 16; // to see how much of a leaf is open, and which room it is in
    Impl::Live& live = *s.live;
    const RunContext unstopped;
    const std::size_t count = s.rays->surfaces().size();
    s.charts.resize(count); // none: light on their vertices will do for the moment
    if (live.maps) {
        live.maps->charts_are(s.charts);
    }
    s.maps.front.resize(count);
    s.maps.back.resize(count);
    for (std::size_t i = first; i < count; ++i) {
        live.placement.push_back(s.rays->surfaces()[i].to_engine);
    }
    if (live.lamps) {
        live.lamps->forget();
    }
    s.reflected.reset(); // it knows the old leaves alone

    const auto first_element = std::uint32_t(s.hierarchy.elements.size());
    append_to_hierarchy(s.hierarchy, *s.rays, first, live.quality.hierarchy);
    divide(s.hierarchy, *s.rays, first_element, live.quality.hierarchy.smallest_patch);
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t i = first_element; i < s.hierarchy.elements.size(); ++i) {
        if (s.hierarchy.elements[i].leaf()) {
            leaves.push_back(i);
        }
    }
    const float reach = live.quality.maps.cover_reach;
    const auto covered = [&](const SurfacePoint& p) { return is_covered(*s.rays, p.position, p.normal, reach); };
    const LeafSurroundings around = look_around(s.hierarchy, *s.rays, leaves, {kRays, covered}, unstopped);
    find_rooms(s.hierarchy, leaves, around);
    if (!s.nothing_direct()) {
        parallel_chunks(leaves.size(), 16, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                (void)s.light_leaf(leaves[i], live.quality);
            }
        });
    }
    for (const std::uint32_t i : leaves) {
        s.hierarchy.elements[i].radiosity = s.hierarchy.elements[i].first_radiosity();
    }
    if (live.exchange) {
        if (live.exchange.use_count() > 1) { // somebody looks at it
            live.exchange = std::make_shared<LeafExchange>(*live.exchange);
        }
        live.exchange->append(leaves, s.hierarchy, around);
    }

    live.rough.resize(count, 0);
    std::fill(live.rough.begin() + std::ptrdiff_t(first), live.rough.end(), std::uint8_t(1));
    const std::size_t first_layer = live.layers.surfaces.size();
    LayerSet added = lay_out(s, first, std::uint32_t(count), live.quality.first_layers, unstopped);
    ATRIUM_CHECK(added.complete);
    std::move(added.surfaces.begin(), added.surfaces.end(), std::back_inserter(live.layers.surfaces));
    std::move(added.places.begin(), added.places.end(), std::back_inserter(live.layers.places));
    live.lit_anew.resize(count, 0);
    std::fill(live.lit_anew.begin() + std::ptrdiff_t(first), live.lit_anew.end(), std::uint8_t(1));
    if (live.reflected) {
        live.reflected->append(s.hierarchy, *s.rays, live.layers, first_layer);
    }
}

// Layers of the surfaces from `first` up to `last` without any reflected light: updates gather that for vertices of their
// own. Where it changes decides where vertices are, all the same, unless a first look is all that is wanted.
LayerSet GiEngine::lay_out(const Impl& s, std::uint32_t first, std::uint32_t last, LayerSettings settings,
                           const RunContext& context) {
    const bool first_look = settings.base_edge > s.live->quality.layers.base_edge;
    settings.keep_places = true;
    settings.light_floor = s.live->light_floor;
    settings.first_surface = first;
    settings.last_surface = last;
    LightField field{{},
                     [](const vec3&, const vec3&) { return DirectSample{}; },
                     [&](const vec3& p, const vec3& n) { return s.direct_light(p, n, s.field.direct); }};
    std::unique_ptr<IndirectGather> gather;
    std::unique_ptr<IrradianceCache> cache;
    if (!first_look) {
        CacheSettings records = s.field.cache;
        records.light_floor = s.live->light_floor;
        gather = s.gather_reflected();
        cache = std::make_unique<IrradianceCache>(
            *s.rays, [&](const vec3& p, const vec3& n) { return gather->irradiance(p, n, s.field.reflected); }, records);
        field.prepare = [&](std::span<const SurfacePoint> points) { return cache->cover(points, context); };
        field.reflected = [&](const vec3& p, const vec3& n) {
            const FieldSample sample = cache->at(p, n);
            return DirectSample{sample.irradiance, sample.variance};
        };
    }
    LayerSet out = build_layers(
        *s.rays, field, {s.charts, s.maps.front, s.maps.back}, settings, [](std::uint32_t) { return true; }, context, 0.0,
        0.0);
    for (std::size_t i = 0; i < out.surfaces.size() && !first_look; ++i) {
        auto layer = std::make_shared<SurfaceLayer>(*out.surfaces[i]);
        std::fill(layer->irradiance_front.begin(), layer->irradiance_front.end(), Rgb(0.0F));
        std::fill(layer->irradiance_back.begin(), layer->irradiance_back.end(), Rgb(0.0F));
        out.surfaces[i] = std::move(layer);
    }
    return out;
}

// Charts and light maps of what has none yet, as in a complete solution. False when asked to stop: nothing has changed.
bool GiEngine::map_added(Impl& s, const std::vector<std::uint8_t>& wanted, const RunContext& context) {
    Impl::Live& live = *s.live;
    if (!live.maps) {
        return true;
    }
    Impl::AddedMaps added;
    added.charts.resize(s.rays->surfaces().size());
    for (std::uint32_t i = 0; i < wanted.size(); ++i) {
        if (wanted[i] != 0 && !shows_no_irradiance(s.rays->material(i))) {
            added.charts[i] = chart_surface(*s.rays, i, live.quality.charts, context);
        }
    }
    DirectMapSettings settings = live.quality.maps;
    settings.light_floor = live.light_floor;
    std::vector<DirectPart> parts = s.direct_parts(s.field.direct);
    for (DirectPart& part : parts) {
        part.meets_moved = {}; // these maps are built with what moved in their light
    }
    added.maps = std::make_unique<LiveDirectMaps>(
        *s.rays, added.charts, std::move(parts),
        [&](std::uint32_t surface) { return s.rays->surfaces()[surface].back_side; }, settings, context);
    const DirectMaps built = context.should_stop() ? DirectMaps{} : added.maps->build(0.1, 0.2);
    if (!built.complete) {
        return false;
    }
    for (std::uint32_t i = 0; i < wanted.size(); ++i) {
        if (!added.charts[i].empty()) {
            s.charts[i] = added.charts[i];
            s.maps.front[i] = built.front[i];
            s.maps.back[i] = built.back[i];
            live.new_maps[i] = 1; // leaves are to take their means
        }
    }
    live.added_maps.push_back(std::move(added));
    return true;
}

// Lamps and colours change the light of one set of maps only: what was added goes without again, until it is settled.
void GiEngine::forget_added_maps(Impl& s) {
    Impl::Live& live = *s.live;
    std::vector<std::uint8_t> mapped(s.rays->surfaces().size(), 0);
    for (const Impl::AddedMaps& added : live.added_maps) {
        for (std::uint32_t i = 0; i < added.charts.size(); ++i) {
            if (!added.charts[i].empty()) {
                mapped[i] = live.rough[i] = 1;
            }
        }
        s.leave(added);
    }
    live.added_maps.clear();
    (void)lay_out_anew(s, mapped, live.quality.first_layers, {});
}

// New meshes for the layers of nodes of which any surface is wanted. False when asked to stop: then nothing has changed.
bool GiEngine::lay_out_anew(Impl& s, const std::vector<std::uint8_t>& wanted, const LayerSettings& settings,
                            const RunContext& context) {
    Impl::Live& live = *s.live;
    const auto surface_of = [&](std::size_t layer) { return live.layers.places[layer].surface; };
    struct Part {
        std::size_t first, last; ///< layers
        LayerSet set;
    };
    std::vector<Part> parts;
    for (std::size_t first = 0, last = 0; first < live.layers.places.size(); first = last) {
        const NodeId node = s.rays->surfaces()[surface_of(first)].node;
        bool any = false;
        for (last = first; last < live.layers.places.size() && s.rays->surfaces()[surface_of(last)].node == node; ++last) {
            any = any || (surface_of(last) < wanted.size() && wanted[surface_of(last)] != 0);
        }
        if (any) {
            parts.push_back({first, last, lay_out(s, surface_of(first), surface_of(last - 1) + 1, settings, context)});
            if (!parts.back().set.complete) {
                return false;
            }
            ATRIUM_CHECK(parts.back().set.surfaces.size() == last - first);
        }
    }
    live.lit_anew.resize(s.rays->surfaces().size(), 0);
    for (Part& part : parts) {
        for (std::size_t k = 0; k < part.set.surfaces.size(); ++k) {
            live.layers.surfaces[part.first + k] = std::move(part.set.surfaces[k]);
            live.layers.places[part.first + k] = std::move(part.set.places[k]);
            live.lit_anew[surface_of(part.first + k)] = 1;
        }
        if (live.reflected) {
            live.reflected->take_layers(s.hierarchy, *s.rays, live.layers, part.first, part.last);
        }
    }
    return true;
}

// What was added in a hurry is made again as in a complete solution, but for reflected light. False when asked to stop: it
// is left for the next time.
bool GiEngine::finish_layers(Impl& s, const RunContext& context) {
    Impl::Live& live = *s.live;
    std::vector<std::uint8_t> wanted = live.rough;
    for (std::uint32_t i = 0; i < wanted.size(); ++i) {
        wanted[i] = wanted[i] != 0 && !s.rays->absent(i) ? 1 : 0;
    }
    if (std::find(wanted.begin(), wanted.end(), 1) == wanted.end()) {
        return true;
    }
    if (!map_added(s, wanted, context)) {
        return false;
    }
    if (!lay_out_anew(s, wanted, live.quality.layers, context)) {
        if (live.maps) {
            s.leave(live.added_maps.back());
            live.added_maps.pop_back();
        }
        return false;
    }
    for (std::uint32_t i = 0; i < wanted.size(); ++i) {
        live.rough[i] = wanted[i] != 0 ? 0 : live.rough[i];
    }
    return true;
}

} // namespace atrium
