#include "engine/radiosity/indirect_gather.h"

#include "engine/base/rng.h"
#include "engine/raycast/light_walk.h"

#include <algorithm>
#include <array>

namespace atrium {
namespace {

constexpr std::uint32_t kSeed = 0x51EDU;
constexpr std::uint32_t kBounceSeed = 0xB0C5U;
constexpr std::size_t kMostRays = 4096;
constexpr unsigned kUnknown = 8; // rays that are shot before their mean is believed
// Stratified directions err less than independent ones; how much less depends on the scene. A third of the variance is an
// assumption, not a measurement.
constexpr float kStratified = 0.35F;

// Cosine-weighted about +z, by the concentric map (Shirley & Chiu 1997): strata stay compact.
vec3 cosine_direction(const vec2& u) {
    const vec2 v = 2.0F * u - vec2(1.0F);
    float r = 0.0F;
    float angle = 0.0F;
    if (std::abs(v.x) > std::abs(v.y)) {
        r = v.x;
        angle = 0.25F * kPi * (v.y / v.x);
    } else if (v.y != 0.0F) {
        r = v.y;
        angle = 0.5F * kPi - 0.25F * kPi * (v.x / v.y);
    }
    return {r * std::cos(angle), r * std::sin(angle), std::sqrt(std::max(1.0F - r * r, 0.0F))};
}

std::vector<vec3> cosine_directions() {
    std::vector<vec3> out(kMostRays);
    for (std::size_t i = 0; i < kMostRays; ++i) {
        out[i] = cosine_direction(sobol_owen2(std::uint32_t(i), 0, kSeed));
    }
    return out;
}

// Numbers of a further ray that are independent of the first one's, to which the same index belongs: dimensions of their
// own, then an order of their own (Burley 2020). The first two dimensions scrambled anew would not do: strata stay strata,
// and every further direction would follow from the first.
struct FurtherSample {
    vec3 direction; ///< cosine-weighted, +z up
    float chance;   ///< decides whether there is such a ray at all
};
constexpr unsigned kMostBounces = 4;
constexpr float kGenerous = 2.0F;       // times its share of the light: the chance of a further ray
constexpr float kLeastSurvival = 0.25F; // leaves may know little of the light in narrow places

std::vector<FurtherSample> further_samples() {
    std::vector<FurtherSample> out(kMostBounces * kMostRays);
    for (std::uint32_t i = 0; i < out.size(); ++i) {
        const std::uint32_t index = i / kMostBounces, bounce = i % kMostBounces;
        const std::uint32_t seed = kBounceSeed + bounce;
        const std::uint32_t order = reverse_bits(owen_scramble_reversed(reverse_bits(index), seed * 0x85EBCA6BU));
        const vec2 u = bounce == 0 ? sobol_owen2(index, 2, kSeed) : sobol_owen2(order, 0, seed);
        out[i] = {cosine_direction(u), sobol_owen(order, 2, seed)};
    }
    return out;
}

const FurtherSample& further_sample(std::uint32_t index, unsigned bounce) {
    static const std::vector<FurtherSample> samples = further_samples();
    return samples[index * kMostBounces + bounce];
}

vec3 turned(const vec3& local, const vec3& normal) {
    vec3 t;
    vec3 b;
    make_frame(normal, t, b);
    return t * local.x + b * local.y + normal * local.z;
}

Hierarchy tree_of(const Hierarchy& solved, const LeafFlags& bright) {
    const bool any = std::any_of(bright.begin(), bright.end(), [](std::uint8_t f) { return f != 0; });
    return any ? only_flagged(solved, bright, false) : Hierarchy{};
}

} // namespace

IndirectGather::IndirectGather(const Hierarchy& solved, const RayScene& rays, LeafFlags bright, DirectAtHit direct,
                               const Rgb& sky, const MirrorLight* mirrors, CarriedByParticles carried)
    : h_(solved), rays_(rays), bright_(std::move(bright)), direct_(std::move(direct)), sky_(sky), mirrors_(mirrors),
      carried_(std::move(carried)), bright_tree_(tree_of(solved, bright_)), bright_gather_(bright_tree_, rays),
      offset_(std::clamp(1e-5F * rays.bounds().diagonal(), 1e-6F, 1e-3F)), directions_(cosine_directions()) {}

Rgb IndirectGather::along(const vec3& origin, const vec3& direction, const Sample& sample, const IndirectSettings& settings,
                          float& distance) const {
    distance = std::numeric_limits<float>::infinity();
    float travelled = 0.0F;
    Rgb sum(0.0F);
    LightWay way;
    way.ray = {origin, direction};
    way.seed = sample.index; // the same choices along one direction everywhere: neighbours err alike
    bool imaged = false;     // the way is one that mirror images carry for what stands out
    Hit over;                // what bent the ray last
    for (unsigned met = 0; met < kMostSurfaces; ++met) {
        const Hit hit = rays_.nearest(way.ray);
        if (!hit) {
            return way.bends > 0 ? sum + way.through * kPi * sky_ : sum; // seen straight it is direct light
        }
        distance = met == 0 ? hit.t : distance;
        travelled += hit.t;
        const std::uint32_t leaf = h_.leaf_at(hit.surface, hit.triangle, !hit.front, hit.barycentric);
        if (leaf != Element::kNone) {
            const Element& e = h_.elements[leaf];
            // What stands out is looked for by name, straight and over flat mirrors.
            const bool by_name = sample.bounce == 0 && bright_[leaf] != 0 &&
                                 (way.bends == 0 ? !too_near(e, origin, settings.bright.nearest) : imaged);
            const bool by_particles =
                sample.bounce == 0 && way.bends > 0 && !settings.all_light && carried_ && carried_(leaf, over, way.bends);
            if (!by_name && !by_particles) {
                sum += way.through * sent_back(hit, e, travelled, sample, settings);
            }
        }
        const unsigned bends = way.bends;
        if (!send_on(rays_, hit, way)) {
            break;
        }
        if (way.bends > bends) {
            imaged = way.bends == 1 && mirrors_ != nullptr && mirrors_->carries(hit);
            over = hit;
        }
    }
    return sum;
}

Rgb IndirectGather::sent_back(const Hit& hit, const Element& e, float travelled, const Sample& sample,
                              const IndirectSettings& settings) const {
    Rgb direct(0.0F);
    const bool known = direct_ && direct_(hit, direct);
    const unsigned most = std::min(settings.most_bounces, kMostBounces);
    if (travelled >= settings.near * e.radius || sample.bounce >= most || !(max_component(e.rho) > 0.0F)) {
        return known ? e.emitted + e.rho * (direct + e.caustic + e.irradiance) : e.radiosity;
    }
    const Rgb own = e.emitted + e.rho * ((known ? direct : e.direct) + e.caustic);
    // Where the leaf says that little would come of a further ray, beside what rays bring here, only some are shot and count
    // for more (Vorba & Krivanek 2016), as far as they differ from the leaf's word: nothing is lost on the whole, and most
    // rays go where they matter.
    const float promise = sample.weight * luminance(e.rho * e.irradiance);
    const float survival = sample.usual > 0.0F ? std::clamp(kGenerous * promise / sample.usual, kLeastSurvival, 1.0F) : 1.0F;
    const FurtherSample& further = further_sample(sample.index, sample.bounce);
    if (further.chance >= survival) {
        return own + e.rho * e.irradiance;
    }
    // The direction belongs to that of the first ray: neighbours err alike.
    const vec3 normal = hit.front ? hit.geometric_normal : -hit.geometric_normal;
    const Sample next{sample.index, sample.bounce + 1, sample.weight * luminance(e.rho) / survival, sample.usual};
    float distance = 0.0F;
    const Rgb reflected =
        along(hit_position(rays_, hit) + normal * offset_, turned(further.direction, normal), next, settings, distance);
    return own + e.rho * (e.irradiance + (reflected - e.irradiance) / survival);
}

FieldSample IndirectGather::irradiance(const vec3& point, const vec3& normal, const IndirectSettings& settings) const {
    FieldSample out;
    out.distance = std::numeric_limits<float>::infinity();
    if (h_.empty()) {
        return out;
    }
    const vec3 origin = point + normal * offset_;
    if (!bright_tree_.empty()) {
        const DirectSample bright = bright_gather_.irradiance(origin, normal, settings.bright);
        out.irradiance = bright.irradiance;
        out.variance = bright.variance;
        if (mirrors_ != nullptr) {
            const DirectSample over = mirrors_->irradiance(point, normal, settings.bright, nullptr, &bright_gather_);
            out.irradiance += over.irradiance;
            out.variance += over.variance;
        }
    }
    vec3 t;
    vec3 b;
    make_frame(normal, t, b);
    const float named = luminance(out.irradiance);
    Rgb sum(0.0F);
    double light = 0.0;
    double light2 = 0.0;
    double near = 0.0;
    std::array<float, 4> nearest; // the least few distances, in order
    nearest.fill(std::numeric_limits<float>::infinity());
    unsigned done = 0;
    unsigned wanted = std::min<unsigned>(settings.rays, kMostRays);
    for (;;) {
        for (; done < wanted; ++done) {
            const vec3& d = directions_[done];
            float distance = 0.0F;
            const float usual = done < kUnknown ? 0.0F : named + float(light / double(done));
            const Rgb radiosity =
                along(origin, t * d.x + b * d.y + normal * d.z, {done, 0, 1.0F, usual}, settings, distance);
            near += 1.0 / std::max(double(distance), 1e-6);
            for (float& least : nearest) {
                if (distance < least) {
                    std::swap(distance, least);
                }
            }
            sum += radiosity;
            const double l = luminance(radiosity);
            light += l;
            light2 += l * l;
        }
        const double n = done;
        const double mean = light / n;
        const double variance = kStratified * std::max(light2 / n - mean * mean, 0.0) / n;
        const double level = settings.tolerance * (mean + luminance(out.irradiance));
        if (done * 2 > std::min<std::size_t>(settings.max_rays, kMostRays) || variance <= level * level) {
            out.irradiance +=
                glm::max(sum / float(done), Rgb(0.0F)); // differences may be negative, few of them even on the whole
            out.variance += float(variance);
            out.distance = near > 0.0 ? float(n / near) : out.distance;
            out.nearest = nearest.back();
            return out;
        }
        wanted = 2 * done;
    }
}

} // namespace atrium
