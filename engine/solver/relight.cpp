#include "engine/solver/relight.h"

#include "engine/optics/specular.h"
#include "engine/radiosity/element_color.h"
#include "engine/solver/gi_engine_impl.h"

#include <algorithm>
#include <map>
#include <set>

namespace atrium {
namespace {

Rgb brightness(const PlacedLight& l) { return l.light.color * l.light.intensity; }
bool lit(const Rgb& light) { return max_component(light) > 0.0F; }

} // namespace

GiEngine::Relight::Relight(Impl& s, const Scene& scene)
    : maps(s.maps), layers(s.live->layers.surfaces), mean_radiance(s.live->mean_radiance) {
    // Lamps that share a light are dimmed together, where their light is in the same part.
    std::map<std::pair<LightId, bool>, std::size_t> of_light;
    const std::vector<PlacedLight>& lights = s.punctual->lights();
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        const Node* node = scene.nodes.find(lights[i].node);
        const LightId id = node != nullptr ? node->light : LightId{};
        const bool by_itself = s.live->lamps && s.live->lamps->has(i);
        const auto known = of_light.find({id, by_itself});
        if (id && known != of_light.end() && sources[known->second].base == brightness(lights[i])) {
            sources[known->second].lights.push_back(i);
            continue;
        }
        of_light[{id, by_itself}] = sources.size();
        Source source;
        source.kind = Source::Kind::Lamps;
        source.lights = {i};
        source.moved = by_itself;
        source.base = source.now = brightness(lights[i]);
        sources.push_back(std::move(source));
    }
    std::set<MaterialId> materials;
    for (const std::uint32_t i : s.hierarchy.leaves()) {
        const Element& e = s.hierarchy.elements[i];
        leaves.push_back({i, e.rho, e.emitted, e.direct, e.caustic, e.irradiance, e.radiosity});
    }
    for (const std::uint32_t i : s.emitters.leaves()) {
        const Element& e = s.emitters.elements[i];
        if (!lit(e.radiosity)) {
            continue;
        }
        Lamp lamp{i, {}};
        const auto add = [&](std::uint32_t surface) {
            const MaterialId id = s.rays->surfaces()[surface].material;
            if (s.rays->material(surface).emits() &&
                std::find(lamp.materials.begin(), lamp.materials.end(), id) == lamp.materials.end()) {
                lamp.materials.push_back(id);
            }
        };
        if (e.kind == Element::Kind::Patch) {
            add(e.surface);
        } else {
            for (std::uint32_t f = e.triangle; f < e.triangle + e.face_count; ++f) {
                add(s.emitters.faces[f].surface);
            }
        }
        materials.insert(lamp.materials.begin(), lamp.materials.end());
        lamps.push_back(std::move(lamp));
    }
    for (const MaterialId id : materials) {
        Source source;
        source.kind = Source::Kind::Emitter;
        source.material = id;
        for (std::uint32_t i = 0; i < s.rays->surfaces().size(); ++i) {
            if (s.rays->surfaces()[i].material == id) {
                source.base = source.now = s.rays->material(i).emitted_radiance();
            }
        }
        sources.push_back(std::move(source));
    }
    lamps_part = !lights.empty();
    emitters_part = !s.emitters.empty();
    mirrors_part = s.mirrors != nullptr && (lamps_part || emitters_part);
    sky_part = s.punctual->has_sky();
    if (sky_part) {
        Source source;
        source.base = source.now = s.sky_radiance;
        sources.push_back(std::move(source));
    }
}

// A quick look: whether anything shines or is painted otherwise than the light that is kept knows.
bool GiEngine::Relight::changed(const Impl& s, const Scene& scene) {
    const std::vector<PlacedLight> now = placed_lights(scene, s.rays->origin());
    std::size_t next = 0;
    for (const PlacedLight& light : s.punctual->lights()) {
        if (lit(brightness(light))) {
            if (next == now.size() || now[next].node != light.node || !same_but_brightness(light, now[next]) ||
                brightness(light) != brightness(now[next])) {
                return true;
            }
            ++next;
        }
    }
    if (next < now.size() || scene.environment.sky_radiance != s.sky_radiance) {
        return true;
    }
    for (std::uint32_t i = 0; i < s.rays->surfaces().size(); ++i) {
        const Material* m = scene.materials.find(s.rays->surfaces()[i].material);
        if (m != nullptr && !(*m == s.rays->material(i))) {
            return true;
        }
    }
    return false;
}

// Sets Source::now and `lights`, in the order of DirectLight::lights(); says why the change is none that can be followed.
std::string GiEngine::Relight::find_change(const Impl& s, const Scene& scene, std::vector<PlacedLight>& lights) {
    const std::vector<PlacedLight> now = placed_lights(scene, s.rays->origin());
    lights = s.punctual->lights();
    std::size_t found = 0;
    for (PlacedLight& light : lights) {
        const auto at = std::find_if(now.begin(), now.end(), [&](const PlacedLight& l) { return l.node == light.node; });
        if (at == now.end()) {
            light.light.intensity = 0.0F; // switched off, hidden or deleted
            continue;
        }
        if (!same_but_brightness(light, *at)) {
            return "a lamp moved where no light is kept";
        }
        light.light = at->light;
        ++found;
    }
    if (found < now.size()) {
        return "a lamp came on";
    }
    for (std::size_t k = 0; k < sources.size(); ++k) {
        Source& source = sources[k];
        if (source.kind == Source::Kind::Sky) {
            source.now = scene.environment.sky_radiance;
        } else if (source.kind == Source::Kind::Emitter) {
            const Material* m = scene.materials.find(source.material);
            source.now = m != nullptr ? m->emitted_radiance() : source.now;
        } else {
            source.now = brightness(lights[source.lights.front()]);
            const auto other = std::find_if(source.lights.begin(), source.lights.end(),
                                            [&](std::uint32_t i) { return brightness(lights[i]) != source.now; });
            if (other != source.lights.end()) { // no longer alike: each by itself
                Source alone;
                alone.kind = Source::Kind::Lamps;
                alone.base = source.base;
                alone.moved = source.moved;
                const std::vector<std::uint32_t> all = source.lights;
                source = alone;
                source.lights = {all.front()};
                source.now = brightness(lights[all.front()]);
                for (std::size_t i = 1; i < all.size(); ++i) {
                    alone.lights = {all[i]};
                    alone.now = brightness(lights[all[i]]);
                    sources.push_back(alone);
                }
                continue;
            }
        }
        if (lit(source.now) && !lit(source.base)) {
            return "a lamp that was dark shines";
        }
    }
    if (!sky_part && lit(scene.environment.sky_radiance)) {
        return "the sky began to shine";
    }
    for (std::uint32_t i = 0; i < s.rays->surfaces().size(); ++i) {
        const MaterialId id = s.rays->surfaces()[i].material;
        const Material* m = scene.materials.find(id);
        const bool source =
            std::any_of(sources.begin(), sources.end(), [&](const Source& x) { return x.material == id && id; });
        if (m != nullptr && !source && m->emits() != s.rays->material(i).emits()) {
            return "a surface began to shine, or stopped";
        }
    }
    for (const Lamp& lamp : lamps) {
        for (const Source& x : sources) {
            const bool in = std::find(lamp.materials.begin(), lamp.materials.end(), x.material) != lamp.materials.end();
            if (lamp.materials.size() > 1 && in && x.now != x.base) {
                return "small lamps of several materials lie together";
            }
        }
    }
    return {};
}

Result<GiEngine::Relight::Change> GiEngine::Relight::follow(Impl& s, const Scene& scene, const RunContext& context) {
    const auto refuse = [](const std::string& why) { return fail("", "", why, "A whole new solution answers"); };
    Impl::Live& live = *s.live;
    if (!live.relight && !changed(s, scene)) {
        return Change{};
    }
    if (!live.relight) {
        live.relight = std::make_shared<Relight>(s, scene);
    }
    Relight& self = *live.relight;
    std::vector<Rgb> before;
    for (const Source& source : self.sources) {
        before.push_back(source.now);
    }
    std::vector<PlacedLight> lights;
    if (const std::string why = self.find_change(s, scene, lights); !why.empty()) {
        return refuse(why);
    }
    Change change;
    for (std::size_t i = 0; i < self.sources.size(); ++i) {
        change.sources += i >= before.size() || self.sources[i].now != before[i] ? 1 : 0;
    }
    live.relight_owed = live.relight_owed || change.sources > 0;
    Rgb factor;
    const bool alike = self.sources_alike(factor); // then nothing needs to be known of single ones
    for (Source& source : self.sources) {
        if (source.now != source.base && !source.known && !alike) {
            context.progress("direct", 0.1);
            if (!self.learn(s, source, context)) {
                return refuse("stopped before the light had followed");
            }
        }
    }
    const auto materials = s.rays->recolor(scene);
    if (!materials) {
        return refuse(materials.error().what);
    }
    change.materials = materials->size();
    change.any = change.sources + change.materials > 0 || live.relight_owed;
    if (!change.any) {
        return change;
    }
    live.relight_owed = true;
    s.punctual->set_brightness(lights, scene.environment.sky_radiance);
    if (live.lamps) {
        live.lamps->take_brightness(*s.punctual);
    }
    s.sky_radiance = scene.environment.sky_radiance;
    self.recolor(s, *materials);
    self.show_direct(s);
    self.light_leaves(s);
    if (s.particles) {
        std::vector<Rgb> emitted(s.rays->surfaces().size(), Rgb(1.0F));
        for (const Source& source : self.sources) {
            for (std::size_t i = 0; source.kind == Source::Kind::Emitter && i < emitted.size(); ++i) {
                if (s.rays->surfaces()[i].material == source.material) {
                    emitted[i] = per_brightness(source.now, source.base);
                }
            }
        }
        for (const std::uint32_t surface : s.particles->relight(*s.lamps_of_particles(), emitted)) {
            live.new_caustics.resize(emitted.size(), 0);
            live.new_caustics[surface] = 1;
        }
    }
    return change;
}

// Leaves of materials whose colour or emission changed.
void GiEngine::Relight::recolor(Impl& s, const std::vector<MaterialId>& materials) const {
    if (materials.empty()) {
        return;
    }
    std::vector<std::uint8_t> marks(s.rays->surfaces().size(), 0);
    for (std::size_t i = 0; i < marks.size(); ++i) {
        const MaterialId id = s.rays->surfaces()[i].material;
        marks[i] = std::find(materials.begin(), materials.end(), id) != materials.end() ? 1 : 0;
    }
    std::vector<std::uint32_t> at(s.hierarchy.elements.size(), Element::kNone); // in `leaves`
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
        at[leaves[i].element] = i;
    }
    const std::vector<std::uint32_t> touched = leaves_of(s.hierarchy, marks);
    parallel_chunks(touched.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t k = begin; k < end; ++k) {
            Element& e = s.hierarchy.elements[touched[k]];
            const Leaf& leaf = leaves[at[touched[k]]];
            const SurfaceColor color = mean_color(s.hierarchy, *s.rays, e);
            e.rho = color.rho;
            if (lit(leaf.emitted)) { // else it does not shine, or into a gap, or by name
                e.emitted = color.emitted;
            }
        }
    });
    if (lamps.empty()) {
        return;
    }
    s.named_flux = 0.0;
    for (const Lamp& lamp : lamps) {
        Element& e = s.emitters.elements[lamp.element];
        e.emitted = e.radiosity = mean_color(s.emitters, *s.rays, e).emitted;
        s.named_flux += double(e.area) * luminance(e.emitted);
    }
    s.emitters.pull_radiosity();
}

} // namespace atrium
