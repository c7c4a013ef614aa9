// Triangles in Embree: all that stand still in one structure, what was moved in a small one beside it. For ray_scene.cpp
// alone.
#pragma once

#include "engine/base/float_traps.h"
#include "engine/raycast/ray_scene.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <embree3/rtcore.h>
#include <span>
#include <vector>

namespace atrium {

static_assert(RTC_INVALID_GEOMETRY_ID == Hit::kNone);

/// Nearest triangle on a ray.
struct TriangleHit {
    std::uint32_t surface = Hit::kNone; ///< none: the rest means nothing
    std::uint32_t triangle = 0;
    float t = 0.0F;
    vec2 barycentric{0.0F};
    vec3 normal{0.0F}; ///< of the triangle, any length, on its front side
};

/// Surfaces are known by their index. Each is opaque or filters light (lets some of it through); queries are safe from any
/// thread.
class EmbreeTriangles {
public:
    EmbreeTriangles();
    ~EmbreeTriangles();
    EmbreeTriangles(const EmbreeTriangles&) = delete;
    EmbreeTriangles& operator=(const EmbreeTriangles&) = delete;

    /// Makes nearest_front() possible, which costs all other rays a little. Before build().
    void tell_fronts() { tells_fronts_ = true; }
    /// One value of `filters` for each surface.
    /// No query may follow when it is stopped.
    void build(std::span<const RaySurface> surfaces, const std::vector<std::uint8_t>& filters,
               const RunContext& context = {});
    /// Some surfaces have other positions (the same number of them) or filter otherwise, or are new, behind all others; no
    /// query may run. `bounds` are those of all surfaces.
    void move(std::span<const std::uint32_t> moved, std::span<const RaySurface> surfaces,
              const std::vector<std::uint8_t>& filters, std::span<const Box3> bounds);
    [[nodiscard]] bool anything_moved() const { return moved_ != nullptr; } ///< since build()
    /// Builds what moved where it stood when build() was called, as far as that was not done yet; no query may run. False
    /// where it is no longer known.
    bool remember(std::span<const RaySurface> surfaces, const std::vector<std::uint8_t>& filters);
    /// Something that moved lies on the ray where it is now or, after remember(), where it was.
    [[nodiscard]] bool meets_moved(const vec3& from, const vec3& direction, float tnear, float tfar) const;
    /// Something opaque lies on the ray that never moved.
    [[nodiscard]] bool still_blocks(const vec3& from, const vec3& direction, float tnear, float tfar) const;
    /// As nearest() before anything moved; after remember().
    [[nodiscard]] TriangleHit nearest_before(const vec3& from, const vec3& direction, float tnear, float tfar) const;

    /// Among all surfaces or among those that filter light. Call it in one place, where it is compiled in.
    [[nodiscard]] TriangleHit nearest(bool only_filters, const vec3& from, const vec3& direction, float tnear,
                                      float tfar) const {
        const FloatTrapsOff quiet;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query;
        fill(query.ray, from, direction, tnear, tfar, only_filters ? kFilter : kOpaque | kFilter);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(only_filters ? still_filters_ : still_, &context, &query);
        if (moved_ != nullptr) {
            take_nearer_of_moved(query);
        }
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            return {};
        }
        return found(query);
    }
    /// nearest() among the opaque fronts that the ray meets, now or before anything moved (needs remember()); after
    /// tell_fronts().
    [[nodiscard]] TriangleHit nearest_front(bool before, const vec3& from, const vec3& direction, float tnear,
                                            float tfar) const;
    /// Anything opaque on the ray?
    [[nodiscard]] bool blocked(const vec3& from, const vec3& direction, float tnear, float tfar) const {
        const FloatTrapsOff quiet;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay query;
        fill(query, from, direction, tnear, tfar, kOpaque);
        rtcOccluded1(still_, &context, &query);
        return query.tfar < 0.0F || (moved_ != nullptr && blocked_by_moved(query));
    }
    /// Bit k is set where direction k (of at most 8) meets something opaque.
    [[nodiscard]] unsigned blocked_of_8(const vec3& from, std::span<const vec3> directions, float tnear) const;

    /// nearest() among what filters light for the directions (at most 8) whose bit is set in `wanted`, each from its own
    /// tnear[k] on; the others' hits are left alone.
    void nearest_filters_of_8(const vec3& from, std::span<const vec3> directions, std::span<const float> tnear,
                              unsigned wanted, std::span<TriangleHit> hits) const;

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

    static void fill(RTCRay& ray, const vec3& from, const vec3& direction, float tnear, float tfar, unsigned mask) {
        ray.org_x = from.x;
        ray.org_y = from.y;
        ray.org_z = from.z;
        ray.dir_x = direction.x;
        ray.dir_y = direction.y;
        ray.dir_z = direction.z;
        ray.tnear = tnear;
        ray.tfar = tfar;
        ray.mask = mask;
        ray.time = 0.0F;
        ray.id = 0;
        ray.flags = 0;
    }

    static TriangleHit found(const RTCRayHit& query) {
        return {query.hit.geomID,
                query.hit.primID,
                query.ray.tfar,
                {query.hit.u, query.hit.v},
                {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z}};
    }

    // What was moved, after the rest was asked: apart, to stay out of the way where nothing ever was.
    void take_nearer_of_moved(RTCRayHit& query) const;
    void take_nearer_of(RTCScene scene, const std::vector<std::uint32_t>& numbers, RTCRayHit& query,
                        RTCFilterFunctionN filter = nullptr) const;
    [[nodiscard]] bool blocked_by_moved(RTCRay& query) const;

    static bool meets(const Reach& reach, const vec3& origin, const vec3& direction, float tnear, float tfar);
    static Reach reach_of(const Box3& bounds);
    void release_scenes();
    [[nodiscard]] RTCGeometry make(const RaySurface& surface, bool filters) const;
    [[nodiscard]] RTCScene new_scene() const;

    RTCDevice device_ = nullptr;
    RTCScene still_ = nullptr;
    RTCScene still_filters_ = nullptr;           // what lets light through, by itself: most rays meet none of it
    RTCScene moved_ = nullptr;                   // none until something moves
    RTCScene before_ = nullptr;                  // what moved where it was built; none until somebody looks back
    std::vector<std::uint32_t> before_surfaces_; // by their number in `before_`
    Reach before_reach_;
    bool rebuilt_ = false;                       // since then: where things stood is lost
    std::vector<std::uint32_t> moved_surfaces_;  // by their number in `moved_`
    std::vector<std::uint32_t> number_in_moved_; // by surface; Hit::kNone = it stands still
    Reach moved_reach_;
    Reach moved_filter_reach_; // of what filters among it
    std::size_t triangles_ = 0;
    bool tells_fronts_ = false;
    std::size_t still_surfaces_ = 0; // those that build() knew; later ones are in `moved_` alone
    std::atomic<std::size_t> bytes_{0};
};

} // namespace atrium
