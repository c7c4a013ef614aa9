#include "engine/reference/light_tracer.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/reference/surface_event.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr float kRouletteBelow = 0.25F;      // share of its first flux from which a particle may end
constexpr int kLongWay = 64;                 // hits from which it may end whatever it carries
constexpr std::uint64_t kTrials = 1U << 15U; // of each look at where it is worth to start
constexpr std::uint64_t kLooksAtStarts = 3;  // each with what the one before found
constexpr std::uint64_t kLooksForPlaces = 7; // until they close in on a few small discs
constexpr std::size_t kFewPlaces = 64;
constexpr float kNear = 4.0F; // radii: within, one landing is as good as another

vec3 cosine_direction(const vec3& n, float u, float v) {
    vec3 t;
    vec3 b;
    make_frame(n, t, b);
    const float sine = std::sqrt(u);
    const float angle = 2.0F * kPi * v;
    return glm::normalize((sine * std::cos(angle)) * t + (sine * std::sin(angle)) * b + std::sqrt(1.0F - u) * n);
}

} // namespace

/// Plain pseudo-random numbers: no strata, so that the scatter of particles is that of chance.
struct LightTracer::Numbers {
    std::uint64_t key = 0;
    std::uint64_t count = 0;
    float next() { return unit_float(std::uint32_t(hash64(key + 0x9E3779B97F4A7C15ULL * ++count) >> 32)); }
    vec3 next3() {
        const float a = next();
        const float b = next();
        return {a, b, next()};
    }
    double next_fine() { return double(hash64(key + 0x9E3779B97F4A7C15ULL * ++count) >> 11) * 0x1p-53; }
    dvec4 next4() {
        const double a = next_fine();
        const double b = next_fine();
        const double c = next_fine();
        return {a, b, c, next_fine()};
    }
};

LightTracer::LightTracer(const RayScene& rays, const PathLights& lights, Emitters emitters, std::span<const vec3> places,
                         float radius)
    : rays_(rays), lights_(lights), aim_(rays) {
    if (aim_.empty()) {
        return;
    }
    // Weights only say how often a source is picked. Spots may look away: what a few rays find is enough to tell.
    for (std::uint32_t i = 0; i < lights.suns().size(); ++i) {
        add({Source::Kind::Sun, i}, double(luminance(lights.suns()[i].normal_irradiance)) * double(aim_.outline()));
    }
    for (std::uint32_t i = 0; i < lights.lamps().size(); ++i) {
        const PathLights::Lamp& lamp = lights.lamps()[i];
        const Source source{Source::Kind::Lamp, i};
        double found = 0.0;
        Numbers numbers{hash64(i)};
        constexpr int kLooks = 64;
        for (int k = 0; k < kLooks; ++k) {
            found += double(luminance(from_lamp(source, numbers.next3()).flux)) / kLooks;
        }
        const double open = double(lamp.light.intensity * luminance(lamp.light.color) * aim_.solid_angle(lamp.position));
        add(source, std::max(found, 0.01 * open));
    }
    add_emitters(emitters);
    learn(places, radius);
}

void LightTracer::learn(std::span<const vec3> places, float radius) {
    if (sources_.empty()) {
        return;
    }
    const bool few = !places.empty() && places.size() <= kFewPlaces;
    const auto worth = [&](const vec3& landing) {
        float least = std::numeric_limits<float>::infinity();
        for (const vec3& place : places) {
            const vec3 d = landing - place;
            least = std::min(least, glm::dot(d, d));
        }
        return 1.0F / (least + kNear * kNear * radius * radius);
    };
    std::vector<StartGuide::Trial> trials; // of all looks
    for (std::uint64_t look = 0; look < (few ? kLooksForPlaces : kLooksAtStarts); ++look) {
        const std::size_t before = trials.size();
        trials.resize(before + kTrials);
        parallel_chunks(kTrials, 256, [&](std::size_t from, std::size_t to, std::size_t) {
            for (std::size_t i = before + from; i < before + to; ++i) {
                Numbers numbers{hash_combine(0x6E1DULL, i)};
                const StartGuide::Start at = guide_(numbers.next4());
                trials[i].at = at.at;
                trials[i].density = at.density;
                // The first place where it lands is enough: what it scatters there is light for everybody.
                follow(start(at, numbers), numbers, false, [&](const CausticLeg& leg) {
                    if (leg.lands) {
                        trials[i].use += at.density * max_component(leg.flux) *
                                         (few ? worth(leg.from + leg.direction * leg.length) : 1.0F);
                    }
                });
            }
        });
        guide_ = StartGuide(trials);
    }
}

void LightTracer::add(const Source& source, double weight) {
    if (weight > 0.0) {
        sources_.push_back(source);
        cumulative_.push_back((cumulative_.empty() ? 0.0 : cumulative_.back()) + weight);
    }
}

void LightTracer::add_emitters(Emitters emitters) {
    for (std::uint32_t s = 0; s < rays_.surfaces().size(); ++s) {
        if (!rays_.material(s).emits() || (emitters == Emitters::Small && !lights_.small(s))) {
            continue;
        }
        for (std::uint32_t t = 0; t < rays_.surfaces()[s].triangles.size(); ++t) {
            const auto p = rays_.triangle(s, t);
            const double area = 0.5 * double(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
            const float ahead = std::min(aim_.solid_angle((p[0] + p[1] + p[2]) / 3.0F), kPi);
            add({Source::Kind::Emitter, s, t}, area * double(lights_.brightness(s, t)) * double(ahead));
        }
    }
}

LightTracer::Start LightTracer::from_sun(const Source& source, const vec3& aim, Numbers& numbers) const {
    const PathLights::Sun& sun = lights_.suns()[source.index];
    const float u = numbers.next();
    const vec3 direction = -sun.sample({u, numbers.next()});
    const Aim::Origin at = aim_.of_beam(direction, aim);
    return {{at.origin, direction}, sun.normal_irradiance * (sun.weight() / at.density)};
}

LightTracer::Start LightTracer::from_lamp(const Source& source, const vec3& aim) const {
    const PathLights::Lamp& lamp = lights_.lamps()[source.index];
    const Aim::Direction to = aim_.from_point(lamp.position, aim);
    return {{lamp.position, to.direction},
            to.density > 0.0F ? lamp.light.color * (lamp.candela(to.direction) / to.density) : Rgb(0.0F)};
}

LightTracer::Start LightTracer::from_emitter(const Source& source, const vec3& aim, Numbers& numbers) const {
    const auto p = rays_.triangle(source.index, source.triangle);
    const vec3 across = glm::cross(p[1] - p[0], p[2] - p[0]);
    const float area = 0.5F * glm::length(across);
    const float root = std::sqrt(numbers.next());
    const float v = numbers.next();
    const vec2 barycentric(root * (1.0F - v), root * v);
    const vec3 position = p[0] + (p[1] - p[0]) * barycentric.x + (p[2] - p[0]) * barycentric.y;
    const Aim::Direction to = aim_.from_point(position, aim);
    const vec3 normal = across / (2.0F * area);
    const float cosine = glm::dot(to.direction, normal);
    const Material& m = rays_.material(source.index);
    if (!(to.density > 0.0F) || cosine == 0.0F || (cosine < 0.0F && !rays_.surfaces()[source.index].back_side)) {
        return {};
    }
    Rgb radiance = rays_.emission(source.index, source.triangle, barycentric);
    if (m.alpha_mode != Material::Alpha::Opaque) {
        const float alpha = rays_.base_color(source.index, source.triangle, barycentric).a;
        const bool mask = m.alpha_mode == Material::Alpha::Mask;
        radiance *= mask ? (alpha >= m.alpha_cutoff ? 1.0F : 0.0F) : std::clamp(alpha, 0.0F, 1.0F);
    }
    return {{clear_of(position, cosine > 0.0F ? normal : -normal), to.direction},
            radiance * (std::abs(cosine) * area / to.density)};
}

LightTracer::Start LightTracer::start(const StartGuide::Start& from, Numbers& numbers) const {
    const double at = from.at.x * cumulative_.back();
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), at);
    const auto index = std::min(std::size_t(found - cumulative_.begin()), sources_.size() - 1);
    const double own = cumulative_[index] - (index > 0 ? cumulative_[index - 1] : 0.0);
    const Source& source = sources_[index];
    // Not quite 1, to which a number just below it is rounded.
    const vec3 aim = glm::min(vec3(dvec3(from.at.y, from.at.z, from.at.w)), vec3(1.0F - 0x1p-24F));
    Start out = source.kind == Source::Kind::Sun    ? from_sun(source, aim, numbers)
                : source.kind == Source::Kind::Lamp ? from_lamp(source, aim)
                                                    : from_emitter(source, aim, numbers);
    out.flux *= float(cumulative_.back() / own) / from.density;
    return out;
}

void LightTracer::trace(std::uint64_t key, std::uint64_t index, bool scatter, const Visit& visit) const {
    if (sources_.empty()) {
        return;
    }
    Numbers numbers{hash_combine(key, index)};
    follow(start(guide_(numbers.next4()), numbers), numbers, scatter, visit);
}

void LightTracer::follow(const Start& begin, Numbers& numbers, bool scatter, const Visit& visit) const {
    const float first_flux = max_component(begin.flux);
    if (!(first_flux > 0.0F)) {
        return;
    }
    Ray ray = begin.ray;
    CausticLeg leg;
    leg.flux = begin.flux;
    bool bent = false;   // a mirror or glass lies behind it: what it carries is no one else's
    float within = 0.0F; // metres since the last face of a solid
    for (int hits = 1;; ++hits) {
        const Hit hit = rays_.nearest(ray);
        leg.from = ray.origin;
        leg.direction = ray.direction;
        leg.length = hit ? hit.t : std::numeric_limits<float>::infinity();
        leg.lands = false;
        leg.scattered = Rgb(0.0F);
        if (!hit) {
            if (bent) {
                visit(leg);
            }
            return;
        }
        const SurfacePoint at = surface_point(rays_, hit, ray.direction);
        within += hit.t;
        if (bent) {
            leg.lands = side_reflects(rays_, hit) && (!at.specular || max_component(at.diffuse) > 0.0F);
            leg.side = at.side;
            leg.scattered = leg.flux * at.diffuse;
            visit(leg);
        }
        SpecularSample way;
        if (at.specular) {
            way = specular_way(rays_, at, numbers.next3(), within);
        }
        within = bounds_solid(rays_, at) ? 0.0F : within;
        const float stay = bent && scatter ? max_component(at.diffuse) : 0.0F;
        const float pass = max_component(at.through);
        const float bend = max_component(way.weight);
        const float all = stay + pass + bend;
        if (!(all > 0.0F)) {
            return;
        }
        const float pick = numbers.next() * all;
        if (pick < stay) {
            leg.flux *= at.diffuse * (all / stay);
            leg.first = false;
            leg.mirrored = false;
            const float u = numbers.next();
            ray = {clear_of(at.position, at.side), cosine_direction(at.side, u, numbers.next())};
        } else if (pick < stay + pass || !(bend > 0.0F)) {
            if (!(pass > 0.0F)) {
                return;
            }
            leg.flux *= at.through * (all / pass);
            ray.origin = clear_of(at.position, ray.direction);
        } else {
            leg.flux *= way.weight * (all / bend);
            ray = {start_of(at, way), way.direction};
            bent = true;
            leg.mirrored = true;
        }
        const float left = max_component(leg.flux) / (kRouletteBelow * first_flux);
        const float survival = hits > kLongWay ? std::min(left, 0.9F) : left;
        if (survival < 1.0F) {
            if (numbers.next() >= survival) {
                return;
            }
            leg.flux /= survival;
        }
    }
}

} // namespace atrium
