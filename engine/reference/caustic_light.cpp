#include "engine/reference/caustic_light.h"

#include "engine/base/rng.h"
#include "engine/reference/surface_event.h"

namespace atrium {
namespace {

void follow(const LightTracer& tracer, const CausticBatch& batch, const RunContext& context,
            const LightTracer::Visit& visit) {
    for (std::uint64_t i = 0; i < batch.count && !((i & 255U) == 0 && context.should_stop()); ++i) {
        tracer.trace(batch.key, batch.first + i, true, visit);
    }
}

} // namespace

std::vector<Rgb> caustic_light_on(const DiscTree& tree, const RayScene& rays, const LightTracer& tracer,
                                  const CausticBatch& batch, const RunContext& context) {
    const std::span<const CausticDisc> discs = tree.discs();
    const double area = kPiD * double(tree.radius()) * double(tree.radius());
    std::vector<dvec3> crossed(discs.size(), dvec3(0.0)); // lumen
    std::vector<dvec3> seen(discs.size(), dvec3(0.0));    // lux
    std::vector<std::uint32_t> met;
    std::uint64_t landings = 0;
    const auto cross = [&](const CausticLeg& leg) {
        tree.crossed(leg.from, leg.direction, leg.length, met);
        for (const std::uint32_t i : met) {
            crossed[i] += dvec3(leg.flux);
        }
    };
    const auto look = [&](const CausticLeg& leg) {
        const std::uint64_t bits = hash_combine(hash_combine(batch.key, batch.first), landings++) >> 32;
        const auto i = std::size_t(bits * discs.size() >> 32);
        const vec3 from = clear_of(leg.from + leg.direction * leg.length, leg.side);
        const vec3 d = discs[i].centre - from;
        const float distance2 = glm::dot(d, d);
        const float distance = std::sqrt(distance2);
        const float cosines = -glm::dot(d, discs[i].normal) * glm::dot(d, leg.side);
        if (glm::dot(d, leg.side) > 0.0F && cosines > 0.0F && distance > 0.0F) {
            const Rgb through = rays.transmittance(Ray{from, d / distance, distance});
            seen[i] +=
                dvec3(leg.scattered * through) * double(kInvPi * cosines / (distance2 * distance2)) * double(discs.size());
        }
    };
    follow(tracer, batch, context, [&](const CausticLeg& leg) {
        if (leg.mirrored) {
            cross(leg);
        }
        if (max_component(leg.scattered) > 0.0F) {
            look(leg);
        }
    });
    std::vector<Rgb> out;
    for (std::size_t i = 0; i < discs.size(); ++i) {
        out.emplace_back((crossed[i] / area + seen[i]) / double(batch.count));
    }
    return out;
}

CausticMap::CausticMap(float radius, const LightTracer& tracer, const CausticBatch& batch, const RunContext& context)
    : radius_(radius) {
    std::vector<Photon> landed;
    follow(tracer, batch, context, [&](const CausticLeg& leg) {
        if (leg.lands) {
            landed.push_back({leg.from + leg.direction * leg.length, leg.side, leg.flux / float(batch.count)});
        }
    });
    std::size_t buckets = 1;
    while (buckets < landed.size()) {
        buckets *= 2;
    }
    starts_.assign(buckets + 1, 0);
    for (const Photon& p : landed) {
        ++starts_[bucket(cell(p.position)) + 1];
    }
    for (std::size_t i = 1; i < starts_.size(); ++i) {
        starts_[i] += starts_[i - 1];
    }
    photons_.resize(landed.size());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (const Photon& p : landed) {
        photons_[next[bucket(cell(p.position))]++] = p;
    }
}

ivec3 CausticMap::cell(const vec3& p) const { return ivec3(glm::floor(p / (2.0F * radius_))); }

std::size_t CausticMap::bucket(const ivec3& c) const {
    const std::uint64_t key = hash_combine(hash_combine(std::uint64_t(std::int64_t(c.x)), std::uint64_t(std::int64_t(c.y))),
                                           std::uint64_t(std::int64_t(c.z)));
    return std::size_t(key) & (starts_.size() - 2);
}

Rgb CausticMap::irradiance(const vec3& point, const vec3& normal) const {
    constexpr float kSameWay = 0.7071F;
    constexpr float kThin = 0.3F; // of the radius: how far off the tangent plane still counts
    if (photons_.empty()) {
        return Rgb(0.0F);
    }
    Rgb sum(0.0F);
    const ivec3 low = cell(point - vec3(radius_));
    for (int corner = 0; corner < 8; ++corner) { // cells are two radii wide: eight hold the ball
        const ivec3 c = low + ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        const std::size_t b = bucket(c);
        for (std::uint32_t i = starts_[b]; i < starts_[b + 1]; ++i) {
            const Photon& p = photons_[i];
            const vec3 d = p.position - point;
            const float height = glm::dot(d, normal);
            if (cell(p.position) == c && glm::dot(d, d) - height * height <= radius_ * radius_ &&
                std::abs(height) <= kThin * radius_ && glm::dot(p.side, normal) >= kSameWay) {
                sum += p.flux;
            }
        }
    }
    return sum / (kPi * radius_ * radius_);
}

} // namespace atrium
