#include "engine/solver/lamp_moves.h"

#include "engine/radiosity/lamp_reach.h"
#include "engine/solver/gi_engine_impl.h"

#include <algorithm>

namespace atrium {
namespace {

std::vector<PlacedLight> some_of(const std::vector<PlacedLight>& all, const std::vector<std::uint32_t>& which) {
    std::vector<PlacedLight> out;
    for (const std::uint32_t i : which) {
        out.push_back(all[i]);
    }
    return out;
}

// No more light than this (lux) of any of the lamps, straight or over a flat mirror.
float most_of(const DirectLight& lamps, const MirrorLight* mirrors, const vec3& point, float radius, const vec3& normal) {
    float sum = 0.0F;
    for (const PlacedLight& lamp : lamps.lights()) {
        sum += most_light(lamp, point, radius, normal);
        if (mirrors != nullptr) {
            for (const PlanarMirror& mirror : mirrors->mirrors().mirrors()) {
                sum += most_light_over(mirror, lamp, point, radius, normal);
            }
        }
    }
    return sum;
}

double reflected(const Element& e) { return luminance(e.rho * (e.direct + e.caustic + e.irradiance)); }

} // namespace

GiEngine::LampMoves::LampMoves() = default;
GiEngine::LampMoves::~LampMoves() = default;

bool GiEngine::LampMoves::needed(const Impl& s, bool settle) {
    const LampMoves* lamps = s.live->lamps.get();
    return lamps != nullptr && (lamps->owed || (settle && !lamps->exact));
}

bool GiEngine::LampMoves::has(std::uint32_t light) const { return std::binary_search(lights.begin(), lights.end(), light); }

Rgb GiEngine::LampMoves::light_at(const Impl& s, const DirectLight& lamps, const vec3& p, const vec3& n) {
    const GatherSettings& settings = s.field.direct;
    Rgb out = lamps.lamps_irradiance(p, n, settings.sun_rays).irradiance;
    if (s.mirrors) {
        out += s.mirrors->irradiance(p, n, settings, &lamps, nullptr).irradiance;
    }
    return out;
}

// At the places where Impl::light_leaf() takes the direct light of a leaf without a map, and likewise not where something
// lies on it; of the first `most` of them.
Rgb GiEngine::LampMoves::light_of_leaf(const Impl& s, const DirectLight& lamps, std::uint32_t element, unsigned most) {
    const Element& e = s.hierarchy.elements[element];
    const QualitySettings& quality = s.live->quality;
    const GatherSettings& settings = quality.leaf_field.direct;
    std::vector<SurfacePoint> points;
    bool any = false;
    for (unsigned i = 0; i < std::min(most, s.samples_of(e, quality)); ++i) {
        points.push_back(sample_point(s.hierarchy, *s.rays, element, sobol_owen2(i, 0, std::uint32_t(e.path)), false));
        any = any || most_of(lamps, s.mirrors.get(), points.back().position, 0.0F, points.back().normal) > 0.0F;
    }
    Rgb sum(0.0F);
    unsigned n = 0;
    for (std::size_t i = 0; any && i < points.size(); ++i) {
        const SurfacePoint& p = points[i];
        if (is_covered(*s.rays, p.position, p.normal, quality.maps.cover_reach)) {
            continue;
        }
        ++n;
        sum += lamps.lamps_irradiance(p.position, p.normal, settings.sun_rays).irradiance;
        if (s.mirrors) {
            sum += s.mirrors->irradiance(p.position, p.normal, settings, &lamps, nullptr).irradiance;
        }
    }
    return n > 0 ? sum / float(n) : Rgb(0.0F);
}

std::vector<GiEngine::LampMoves::Shares> GiEngine::LampMoves::on_vertices(const Impl& s, const DirectLight& lamps,
                                                                          const RunContext& context) {
    const LayerSet& layers = s.live->layers;
    std::vector<Shares> out(layers.surfaces.size());
    parallel_chunks(out.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            const VertexPlaces& places = layers.places[i];
            for (const bool back : {false, true}) {
                const std::vector<SurfacePoint>& side = places.side(back);
                std::vector<Rgb>& light = back ? out[i].back : out[i].front;
                for (std::size_t k = 0; k < side.size() && !s.rays->absent(places.surface); ++k) {
                    if (places.shows_direct(k, back)) {
                        light.resize(side.size(), Rgb(0.0F));
                        light[k] = light_at(s, lamps, side[k].position, side[k].normal);
                    }
                }
            }
        }
    });
    return out;
}

std::vector<Rgb> GiEngine::LampMoves::on_leaves(const Impl& s, const DirectLight& lamps, const RunContext& context) {
    std::vector<Rgb> out(s.hierarchy.elements.size(), Rgb(0.0F));
    if (!s.live->exchange) {
        return out;
    }
    const std::vector<std::uint32_t>& leaves = s.live->exchange->leaves();
    parallel_chunks(leaves.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            if (s.chart_of(s.hierarchy.elements[leaves[i]]) == nullptr) {
                out[leaves[i]] = light_of_leaf(s, lamps, leaves[i], std::numeric_limits<unsigned>::max());
            }
        }
    });
    return out;
}

// Light maps without these lamps. Part 0 is that of all lamps: see Impl::direct_parts().
bool GiEngine::LampMoves::take_out(Impl& s, const std::vector<std::uint32_t>& which, const RunContext& context) {
    Impl::Live& live = *s.live;
    const DirectLight lamps(some_of(s.punctual->lights(), which), *s.rays);
    const GatherSettings& settings = s.field.direct;
    const std::size_t before = live.lamps ? live.lamps->lights.size() : 0;
    const bool alone = before + which.size() == s.punctual->lights().size();
    std::vector<LeavingLight> leaving;
    leaving.push_back({0, [&](const vec3& p, const vec3& n) { return lamps.lamps_irradiance(p, n, settings.sun_rays); }});
    if (s.mirrors) {
        leaving.push_back({s.emitters.empty() ? 1U : 2U, [&](const vec3& p, const vec3& n) {
                               return s.mirrors->irradiance(p, n, settings, &lamps, nullptr);
                           }});
    }
    for (LeavingLight& l : leaving) {
        if (alone && (l.part == 0 || s.emitters.empty())) {
            l.light = nullptr;
        }
    }
    return live.maps->take_out(leaving, context);
}

Result<std::size_t> GiEngine::LampMoves::follow(Impl& s, const Scene& scene, const RunContext& context) {
    Impl::Live& live = *s.live;
    const std::vector<PlacedLight> now = placed_lights(scene, s.rays->origin());
    std::vector<PlacedLight> placed = s.punctual->lights();
    std::vector<std::uint32_t> moved;
    const bool owed = live.lamps && live.lamps->owed;
    for (std::uint32_t i = 0; i < placed.size() && live.maps; ++i) {
        PlacedLight& lamp = placed[i];
        const auto at = std::find_if(now.begin(), now.end(), [&](const PlacedLight& l) { return l.node == lamp.node; });
        if (at != now.end() && !same_but_brightness(lamp, *at)) {
            moved.push_back(i);
            lamp = *at;
        } else if (owed && live.lamps->has(i)) { // brightness comes with the place while nothing shows either
            lamp.light.intensity = at != now.end() ? at->light.intensity : 0.0F;
            lamp.light.color = at != now.end() ? at->light.color : lamp.light.color;
        }
    }
    // What came on, or is new, moves there from nowhere.
    const std::size_t old = placed.size();
    for (const PlacedLight& lamp : now) {
        const bool known = std::any_of(placed.begin(), placed.begin() + std::ptrdiff_t(old),
                                       [&](const PlacedLight& l) { return l.node == lamp.node; });
        if (live.maps && !known) {
            moved.push_back(std::uint32_t(placed.size()));
            placed.push_back(lamp);
        }
    }
    if (moved.empty() && !owed) {
        return moved.size();
    }
    if (live.relight) { // what changes of brightness learnt holds for lamps where they were
        live.relight->settle(s);
        live.relight.reset();
    }
    // What moves is found where it still stands; nothing changes before all is known.
    context.progress("direct", 0.1);
    std::vector<std::uint32_t> all = live.lamps ? live.lamps->lights : std::vector<std::uint32_t>{};
    std::vector<std::uint32_t> leaving;
    for (const std::uint32_t i : moved) {
        if (i < old && (!live.lamps || !live.lamps->has(i))) {
            leaving.push_back(i);
        }
    }
    all.insert(all.end(), leaving.begin(), leaving.end());
    std::sort(all.begin(), all.end());
    const std::vector<std::uint32_t> sent = all; // something so far
    for (std::size_t i = old; i < placed.size(); ++i) {
        all.push_back(std::uint32_t(i));
    }
    const bool anew = !live.lamps || !live.lamps->known_;
    std::vector<Shares> shares;
    std::vector<Rgb> of_leaves;
    if (anew || !leaving.empty()) {
        const DirectLight lamps(some_of(s.punctual->lights(), anew ? sent : leaving), *s.rays);
        shares = on_vertices(s, lamps, context);
        of_leaves = on_leaves(s, lamps, context);
    }
    if (context.should_stop() || (!leaving.empty() && !take_out(s, leaving, context))) {
        return fail("", "", "stopped before the light had followed", "The next update goes on");
    }
    const bool first = !live.lamps;
    if (first) {
        live.lamps = std::make_unique<LampMoves>();
    }
    LampMoves& self = *live.lamps;
    if (anew) {
        self.shares_ = std::move(shares);
        self.of_leaves_ = std::move(of_leaves);
        self.bright_.clear();
        for (std::size_t i = 0; live.exchange && i < live.exchange->leaves().size(); ++i) {
            self.bright_.push_back(reflected(s.hierarchy.elements[live.exchange->leaves()[i]]));
        }
        self.mean_radiance_ = live.mean_radiance;
        self.known_ = true;
    } else if (!leaving.empty()) {
        const auto add = [](std::vector<Rgb>& to, const std::vector<Rgb>& more) {
            to.resize(std::max(to.size(), more.size()), Rgb(0.0F));
            for (std::size_t k = 0; k < more.size(); ++k) {
                to[k] += more[k];
            }
        };
        for (std::size_t i = 0; i < shares.size(); ++i) {
            add(self.shares_[i].front, shares[i].front);
            add(self.shares_[i].back, shares[i].back);
        }
        add(self.of_leaves_, of_leaves);
    }
    self.lights = all;
    self.owed = true;
    self.first_new = old < placed.size() ? std::min(self.first_new, old) : self.first_new;
    s.punctual->place(std::move(placed));
    std::vector<std::uint32_t> others;
    for (std::uint32_t i = 0; i < s.punctual->lights().size(); ++i) {
        if (!self.has(i)) {
            others.push_back(i);
        }
    }
    self.moving = std::make_unique<DirectLight>(some_of(s.punctual->lights(), all), *s.rays);
    self.staying = std::make_unique<DirectLight>(some_of(s.punctual->lights(), others), *s.rays);
    s.find_shafts();
    if (first) {
        DirectPart part;
        part.sharp = true;
        part.straight = s.mirrors == nullptr;
        part.light = [&s](const vec3& p, const vec3& n) {
            const DirectLight& lamps = *s.live->lamps->moving;
            DirectSample out = lamps.lamps_irradiance(p, n, s.field.direct.sun_rays);
            if (s.mirrors) {
                const DirectSample over = s.mirrors->irradiance(p, n, s.field.direct, &lamps, nullptr);
                out.irradiance += over.irradiance;
                out.variance += over.variance;
            }
            return out;
        };
        part.touched = [&s](const vec3& p, float radius, const Box3& box) {
            return s.lamp_shafts.touched(p, radius, box) || (s.mirrors && s.mirror_shafts.touched(p, radius, box)) ||
                   s.mirror_shafts_before.touched(p, radius, box);
        };
        part.most = [&s](const vec3& p, float radius, const vec3& n) {
            return most_of(*s.live->lamps->moving, s.mirrors.get(), p, radius, n);
        };
        self.part = live.maps->add_part(std::move(part), context);
    }
    return moved.size();
}

void GiEngine::LampMoves::light_vertices(Impl& s, const RunContext& context) {
    Impl::Live& live = *s.live;
    if (!known_) {
        return;
    }
    std::vector<Shares> now = on_vertices(s, *moving, context);
    if (context.should_stop()) {
        return;
    }
    parallel_chunks(now.size(), 4, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            std::shared_ptr<SurfaceLayer> layer;
            for (const bool back : {false, true}) {
                std::vector<Rgb>& share = back ? shares_[i].back : shares_[i].front;
                const std::vector<Rgb>& next = back ? now[i].back : now[i].front;
                share.resize(next.size(), Rgb(0.0F));
                for (std::size_t k = 0; k < next.size(); ++k) {
                    if (share[k] == next[k] || !live.layers.places[i].shows_direct(k, back)) {
                        continue;
                    }
                    if (!layer) {
                        layer = std::make_shared<SurfaceLayer>(*live.layers.surfaces[i]);
                    }
                    std::vector<Rgb>& light = back ? layer->direct_back : layer->direct_front;
                    light.resize(next.size(), Rgb(0.0F));
                    light[k] = glm::max(light[k] - share[k] + next[k], Rgb(0.0F));
                    share[k] = next[k];
                }
            }
            if (layer) {
                live.layers.surfaces[i] = std::move(layer);
            }
        }
    });
}

void GiEngine::LampMoves::light_leaves(Impl& s, bool settle, const RunContext& context) {
    constexpr unsigned kInAHurry = 2;
    if (!known_) {
        return;
    }
    const std::vector<std::uint32_t>& leaves = s.live->exchange->leaves();
    parallel_chunks(leaves.size(), 64, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            Element& e = s.hierarchy.elements[leaves[i]];
            if (s.chart_of(e) == nullptr) {
                const Rgb next =
                    light_of_leaf(s, *moving, leaves[i], settle ? std::numeric_limits<unsigned>::max() : kInAHurry);
                e.direct = glm::max(e.direct - of_leaves_[leaves[i]] + next, Rgb(0.0F));
                of_leaves_[leaves[i]] = next;
            }
        }
    });
}

void GiEngine::LampMoves::sampled_vertex(const Impl& s, std::uint32_t layer, std::uint32_t vertex, bool back) {
    if (!known_) {
        return;
    }
    const std::vector<SurfacePoint>& side = s.live->layers.places[layer].side(back);
    std::vector<Rgb>& share = back ? shares_[layer].back : shares_[layer].front;
    share.resize(side.size(), Rgb(0.0F));
    share[vertex] = light_at(s, *moving, side[vertex].position, side[vertex].normal);
}

void GiEngine::LampMoves::sampled_leaf(const Impl& s, std::uint32_t element) {
    if (known_) {
        of_leaves_[element] = light_of_leaf(s, *moving, element, std::numeric_limits<unsigned>::max());
    }
}

void GiEngine::LampMoves::take_brightness(const DirectLight& all) {
    std::vector<PlacedLight> in, out;
    for (std::uint32_t i = 0; i < all.lights().size(); ++i) {
        (has(i) ? in : out).push_back(all.lights()[i]);
    }
    moving->place(std::move(in));
    staying->place(std::move(out));
}

double GiEngine::LampMoves::mean_radiance(const Impl& s) const {
    double sum = 0.0, area = 0.0;
    for (std::size_t i = 0; i < bright_.size(); ++i) {
        const Element& e = s.hierarchy.elements[s.live->exchange->leaves()[i]];
        const double is = reflected(e);
        if (bright_[i] > 0.0 && is > 0.0) {
            sum += double(e.area) * std::log(is / bright_[i]);
            area += e.area;
        }
    }
    return area > 0.0 ? mean_radiance_ * std::exp(sum / area) : mean_radiance_;
}

} // namespace atrium
