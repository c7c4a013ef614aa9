// What one source of direct light sends where: found once, when it is first dimmed or coloured.
#include "engine/base/rng.h"
#include "engine/solver/gi_engine_impl.h"
#include "engine/solver/relight.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::uint32_t kLeafPoints = 2; // of a leaf without a light map

bool lit(const Rgb& light) { return max_component(light) > 0.0F; }

// As while something moves: for the blink of an eye. A lamp of many small faces is all the light that there is when it is
// looked at alone, and would be gathered face by face from everywhere: from afar it is its harmonics.
GatherSettings fewer_rays(GatherSettings settings) {
    settings.rays = std::max(settings.rays / 4, 8U);
    settings.sun_rays = std::max(settings.sun_rays / 2, 8U);
    settings.sky_rays = std::max(settings.sky_rays / 3, 16U);
    settings.tolerance = 0.45F;
    settings.max_cut /= 2;
    return settings;
}

} // namespace

// False when asked to stop: then it is still to be learnt.
bool GiEngine::Relight::learn(Impl& s, Source& source, const RunContext& context) const {
    const GatherSettings settings = fewer_rays(s.field.direct);
    // The source alone, as bright as it is or, of lamps, of brightness 1.
    std::vector<PlacedLight> own_lights;
    for (const std::uint32_t i : source.lights) {
        own_lights.push_back(s.punctual->lights()[i]);
        own_lights.back().light.color = Rgb(1.0F);
        own_lights.back().light.intensity = 1.0F;
    }
    const DirectLight punctual(std::move(own_lights), *s.rays);
    Hierarchy tree;
    if (source.kind == Source::Kind::Emitter) {
        LeafFlags flags(s.emitters.elements.size(), 0);
        for (const Lamp& lamp : lamps) {
            const auto own = std::find(lamp.materials.begin(), lamp.materials.end(), source.material);
            flags[lamp.element] = own != lamp.materials.end() ? 1 : 0;
        }
        tree = only_flagged(s.emitters, flags, false);
    }
    const PointGather gather(tree, *s.rays, nullptr, nullptr, s.slits);
    const auto over = [&](const DirectSample& sample) {
        return DirectSample{per_brightness(sample.irradiance, source.base), 0.0F};
    };
    const auto straight = [&](const vec3& p, const vec3& n) {
        switch (source.kind) {
        case Source::Kind::Lamps: return punctual.lamps_irradiance(p, n, settings.sun_rays);
        case Source::Kind::Emitter: return over(gather.irradiance(p, n, settings));
        case Source::Kind::Sky: return over(s.punctual->sky_irradiance(p, n, settings.sky_rays));
        }
        return DirectSample{};
    };
    const auto by_mirrors = [&](const vec3& p, const vec3& n) {
        const bool of_lamps = source.kind == Source::Kind::Lamps;
        const DirectSample sample =
            s.mirrors->irradiance(p, n, settings, of_lamps ? &punctual : nullptr, of_lamps ? nullptr : &gather);
        return of_lamps ? sample : over(sample);
    };
    const auto both = [&](const vec3& p, const vec3& n) {
        DirectSample out = straight(p, n);
        if (mirrors_part && source.kind != Source::Kind::Sky) {
            out.irradiance += by_mirrors(p, n).irradiance;
        }
        return out;
    };
    // Parts in the order of direct_parts(). Where a source is alone in one, what is there is its own.
    std::vector<PartSource> parts;
    const auto count = [&](Source::Kind kind, bool moved) {
        return std::count_if(sources.begin(), sources.end(),
                             [&](const Source& x) { return x.kind == kind && x.moved == moved; });
    };
    const auto lamps_there = count(Source::Kind::Lamps, false), emitters_there = count(Source::Kind::Emitter, false);
    std::size_t part = 0;
    const auto add = [&](bool exists, bool in, bool alone, const DirectFunction& light) {
        if (exists && in) {
            parts.push_back({part, alone ? DirectFunction{} : light});
        }
        part += exists ? 1 : 0;
    };
    add(lamps_part, source.kind == Source::Kind::Lamps && !source.moved, lamps_there == 1, straight);
    add(emitters_part, source.kind == Source::Kind::Emitter, emitters_there == 1, straight);
    add(mirrors_part, source.kind != Source::Kind::Sky && !source.moved, lamps_there + emitters_there == 1, by_mirrors);
    add(sky_part, source.kind == Source::Kind::Sky, true, straight);
    if (source.moved) {
        const bool alone = count(Source::Kind::Lamps, true) == 1;
        parts.push_back({s.live->lamps->part, alone ? DirectFunction{} : both});
    }
    if (s.live->maps) {
        auto found = s.live->maps->light_of(parts, source.base, context);
        if (!found) {
            return false;
        }
        source.maps = std::move(*found);
    }
    const bool alone = sources.size() == 1;
    learn_vertices(s, source, both, alone);
    learn_leaves(s, source, both, alone);
    learn_caustics(s, source);
    source.known = !context.should_stop();
    return source.known;
}

void GiEngine::Relight::learn_vertices(Impl& s, Source& source, const DirectFunction& light, bool alone) const {
    source.vertices.assign(layers.size(), {});
    struct Vertex {
        std::uint32_t layer, index;
        bool back;
    };
    std::vector<Vertex> todo;
    for (std::uint32_t i = 0; i < layers.size(); ++i) {
        for (const bool back : {false, true}) {
            const std::vector<Rgb>& base = back ? layers[i]->direct_back : layers[i]->direct_front;
            const VertexPlaces& places = s.live->layers.places[i];
            std::vector<Rgb>& out = back ? source.vertices[i].back : source.vertices[i].front;
            for (std::uint32_t k = 0; k < base.size(); ++k) {
                if (!lit(base[k])) {
                    continue;
                }
                out.resize(base.size(), Rgb(0.0F));
                if (alone) {
                    out[k] = per_brightness(base[k], source.base);
                } else if (k < places.front.size() && places.shows_direct(k, back)) {
                    todo.push_back({i, k, back});
                }
            }
        }
    }
    parallel_chunks(todo.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t t = begin; t < end; ++t) {
            const auto [i, k, back] = todo[t];
            const SurfacePoint& p = (back ? s.live->layers.places[i].back : s.live->layers.places[i].front)[k];
            const Rgb most = per_brightness((back ? layers[i]->direct_back : layers[i]->direct_front)[k], source.base);
            (back ? source.vertices[i].back : source.vertices[i].front)[k] =
                glm::min(light(p.position, p.normal).irradiance, most);
        }
    });
}

void GiEngine::Relight::learn_leaves(Impl& s, Source& source, const DirectFunction& light, bool alone) const {
    source.direct.assign(leaves.size(), Rgb(0.0F));
    parallel_chunks(leaves.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const Leaf& leaf = leaves[i];
            if (!lit(leaf.direct)) {
                continue;
            }
            const Rgb most = per_brightness(leaf.direct, source.base);
            Rgb& out = source.direct[i];
            double spread = 0.0;
            if (alone) {
                out = most;
                continue;
            }
            if (s.mean_of_maps(s.hierarchy.elements[leaf.element], source.maps.front, source.maps.back, out, spread)) {
                out = glm::min(out, most);
                continue;
            }
            Rgb sum(0.0F);
            for (std::uint32_t k = 0; k < kLeafPoints; ++k) {
                const auto path = std::uint32_t(s.hierarchy.elements[leaf.element].path);
                const SurfacePoint p = sample_point(s.hierarchy, *s.rays, leaf.element, sobol_owen2(k, 0, path), false);
                sum += light(p.position, p.normal).irradiance;
            }
            out = glm::min(sum / float(kLeafPoints), most);
        }
    });
}

void GiEngine::Relight::learn_caustics(const Impl& s, Source& source) const {
    std::vector<Rgb> sum(s.hierarchy.elements.size(), Rgb(0.0F));
    bool any = false;
    if (source.kind == Source::Kind::Sky) {
        const std::vector<float>& seen = s.live->sky_over_mirrors;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            sum[s.live->exchange->leaves()[i]] = Rgb(kPi * seen[i]);
            any = any || seen[i] > 0.0F;
        }
    } else if (s.particles) {
        for (const ParticleLink& link : s.particles->links()) {
            const ParticleSource& from = s.particles->sources()[link.source];
            const bool own =
                source.kind == Source::Kind::Lamps
                    ? std::find(source.lights.begin(), source.lights.end(), link.source) != source.lights.end()
                    : !from.leaves.empty() && !from.matt() && s.rays->surfaces()[from.surface].material == source.material;
            for (std::size_t k = link.first; own && k < link.first + link.landings; ++k) {
                const Landing& l = s.particles->landings()[k];
                const std::uint32_t leaf = s.hierarchy.leaf_at(l.surface, l.triangle, l.back, l.barycentric);
                if (leaf != Element::kNone) {
                    sum[leaf] += per_brightness(s.particles->power(l), source.base) / s.hierarchy.elements[leaf].area;
                    any = true;
                }
            }
        }
    }
    source.caustic.clear();
    for (std::size_t i = 0; any && i < leaves.size(); ++i) {
        source.caustic.push_back(glm::min(sum[leaves[i].element], per_brightness(leaves[i].caustic, source.base)));
    }
}

} // namespace atrium
