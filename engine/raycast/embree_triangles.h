// Triangles in Embree: all that stand still in one structure, what was moved in a small one beside it. For ray_scene.cpp
// alone.
#pragma once

#include "engine/raycast/ray_scene.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <embree3/rtcore.h>
#include <span>
#include <vector>

namespace atrium {

/// Nearest triangle on a ray.
struct TriangleHit {
    std::uint32_t surface = Hit::kNone;
    std::uint32_t triangle = 0;
    float t = 0.0F;
    vec2 barycentric{0.0F};
};

/// A ray between two distances.
struct RayPiece {
    vec3 origin{0.0F};
    vec3 direction{0.0F};
    float tnear = 0.0F;
    float tfar = 0.0F;
};

/// Surfaces are known by their index. Each is opaque or filters light (lets some of it through); queries are safe from any
/// thread.
class EmbreeTriangles {
public:
    EmbreeTriangles();
    ~EmbreeTriangles();
    EmbreeTriangles(const EmbreeTriangles&) = delete;
    EmbreeTriangles& operator=(const EmbreeTriangles&) = delete;

    /// One value of `filters` for each surface.
    void build(std::span<const RaySurface> surfaces, const std::vector<std::uint8_t>& filters);
    /// Some surfaces have other positions (the same number of them) or filter otherwise; no query may run. `bounds` are
    /// those of all surfaces.
    void move(std::span<const std::uint32_t> moved, std::span<const RaySurface> surfaces,
              const std::vector<std::uint8_t>& filters, std::span<const Box3> bounds);
    [[nodiscard]] bool anything_moved() const { return moved_ != nullptr; } ///< since build()

    [[nodiscard]] TriangleHit nearest(const RayPiece& ray) const {
        return nearest(still_, ray, kOpaque | kFilter, moved_reach_);
    }
    [[nodiscard]] TriangleHit nearest_filter(const RayPiece& ray) const {
        return nearest(still_filters_, ray, kFilter, moved_filter_reach_);
    }
    /// Anything opaque on the ray?
    [[nodiscard]] bool blocked(const RayPiece& ray) const {
        return blocked(still_, ray) || (!moved_reach_.empty() && meets(moved_reach_, ray) && blocked(moved_, ray));
    }
    /// Bit k is set where direction k (of at most 8) meets something opaque.
    [[nodiscard]] unsigned blocked_of_8(const vec3& from, std::span<const vec3> directions, float tnear) const;

    [[nodiscard]] std::size_t bytes() const { return bytes_; } ///< as Embree reports them

private:
    static constexpr unsigned kOpaque = 1; // stops light
    static constexpr unsigned kFilter = 2; // clear panes, cut-outs, blended surfaces: some light goes through

    // A box and a sphere around the same things, both with slack.
    struct Reach {
        Box3 box;
        vec3 centre{0.0F};
        float radius2 = -1.0F;
        [[nodiscard]] bool empty() const { return radius2 < 0.0F; }
    };

    static void fill(RTCRay& out, const RayPiece& ray, unsigned mask) {
        out.org_x = ray.origin.x;
        out.org_y = ray.origin.y;
        out.org_z = ray.origin.z;
        out.dir_x = ray.direction.x;
        out.dir_y = ray.direction.y;
        out.dir_z = ray.direction.z;
        out.tnear = ray.tnear;
        out.tfar = ray.tfar;
        out.mask = mask;
        out.time = 0.0F;
        out.id = 0;
        out.flags = 0;
    }

    static bool blocked(RTCScene where, const RayPiece& ray) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay query;
        fill(query, ray, kOpaque);
        rtcOccluded1(where, &context, &query);
        return query.tfar < 0.0F;
    }

    static TriangleHit nearest_in(RTCScene where, const RayPiece& ray, unsigned mask) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query;
        fill(query.ray, ray, mask);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(where, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            return {};
        }
        return {query.hit.geomID, query.hit.primID, query.ray.tfar, {query.hit.u, query.hit.v}};
    }

    [[nodiscard]] TriangleHit nearest(RTCScene still, const RayPiece& ray, unsigned mask, const Reach& reach) const {
        TriangleHit out = nearest_in(still, ray, mask);
        if (!reach.empty()) {
            RayPiece rest = ray;
            rest.tfar = out.surface != Hit::kNone ? out.t : ray.tfar;
            if (meets(reach, rest)) {
                const TriangleHit nearer = nearest_in(moved_, rest, mask);
                if (nearer.surface != Hit::kNone) {
                    out = nearer;
                    out.surface = moved_surfaces_[nearer.surface];
                }
            }
        }
        return out;
    }

    /// Errs on the side of true. Directions of any length.
    static bool meets(const Reach& reach, const RayPiece& ray) {
        constexpr float kLeast = 1e-18F; // of a direction's components: keeps quotients finite
        constexpr float kSlack = 1e-6F;  // of distances: more than they are rounded by
        const vec3 there = reach.centre - ray.origin;
        const float along = glm::dot(there, ray.direction);
        const float distance2 = glm::dot(there, there);
        const float length2 = glm::dot(ray.direction, ray.direction);
        if (distance2 > reach.radius2 &&
            (along < 0.0F || distance2 * length2 * (1.0F - 4.0F * kSlack) - along * along > reach.radius2 * length2)) {
            return false; // most rays end here, without a division
        }
        float first = ray.tnear;
        float last = ray.tfar;
        for (int k = 0; k < 3; ++k) {
            const float d = ray.direction[k];
            const float inverse = 1.0F / (std::abs(d) < kLeast ? std::copysign(kLeast, d) : d);
            const float a = (reach.box.min[k] - ray.origin[k]) * inverse;
            const float b = (reach.box.max[k] - ray.origin[k]) * inverse;
            first = std::max(first, std::min(a, b));
            last = std::min(last, std::max(a, b));
        }
        return first - std::abs(first) * kSlack <= last + std::abs(last) * kSlack;
    }

    void release_scenes();
    [[nodiscard]] RTCGeometry make(const RaySurface& surface, bool filters) const;
    [[nodiscard]] RTCScene new_scene() const;
    static Reach reach_of(const Box3& bounds);

    RTCDevice device_ = nullptr;
    RTCScene still_ = nullptr;
    RTCScene still_filters_ = nullptr;           // what lets light through, by itself: most rays meet none of it
    RTCScene moved_ = nullptr;                   // none until something moves
    std::vector<std::uint32_t> moved_surfaces_;  // by their number in `moved_`
    std::vector<std::uint32_t> number_in_moved_; // by surface; Hit::kNone = it stands still
    Reach moved_reach_;
    Reach moved_filter_reach_; // of what filters among it
    std::size_t triangles_ = 0;
    std::atomic<std::size_t> bytes_{0};
};

} // namespace atrium
