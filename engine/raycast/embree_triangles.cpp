#include "engine/raycast/embree_triangles.h"

#include "engine/base/checks.h"

#include <algorithm>
#include <cstdio>

namespace atrium {
namespace {

// What lies in the small structure without moving now costs every ray a little and every move a little more. Beyond this
// share of all triangles, and this many, everything is built anew as what stands still.
constexpr std::size_t kMostMovedShare = 16;
constexpr std::size_t kFewMoved = 2048;

constexpr float kBoxSlack = 1e-5F; // of its coordinates

bool anything_on(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar < 0.0F;
}

// Backs are passed through. For queries of single rays.
void keep_fronts(const RTCFilterFunctionNArguments* args) {
    const auto* ray = reinterpret_cast<const RTCRay*>(args->ray);
    const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
    if (ray->dir_x * hit->Ng_x + ray->dir_y * hit->Ng_y + ray->dir_z * hit->Ng_z >= 0.0F) {
        *args->valid = 0;
    }
}

void on_embree_error(void*, RTCError error, const char* message) {
    if (error != RTC_ERROR_CANCELLED) { // we asked it to stop
        std::fprintf(stderr, "embree: %s\n", message);
    }
}

} // namespace

EmbreeTriangles::EmbreeTriangles() {
    const FloatTrapsOff quiet;
    device_ = rtcNewDevice(nullptr);
    ATRIUM_CHECK(device_ != nullptr);
    rtcSetDeviceErrorFunction(device_, on_embree_error, nullptr);
    rtcSetDeviceMemoryMonitorFunction(
        device_,
        [](void* self, ssize_t change, bool) {
            static_cast<EmbreeTriangles*>(self)->bytes_ += std::size_t(change);
            return true;
        },
        this);
}

EmbreeTriangles::~EmbreeTriangles() {
    release_scenes();
    rtcSetDeviceMemoryMonitorFunction(device_, nullptr, nullptr);
    rtcReleaseDevice(device_);
}

void EmbreeTriangles::release_scenes() {
    for (RTCScene* scene : {&still_, &still_filters_, &moved_, &before_}) {
        if (*scene != nullptr) {
            rtcReleaseScene(*scene);
            *scene = nullptr;
        }
    }
    moved_surfaces_.clear();
    before_surfaces_.clear();
    before_reach_ = {};
    moved_reach_ = {};
    moved_filter_reach_ = {};
}

RTCScene EmbreeTriangles::new_scene() const {
    RTCScene scene = rtcNewScene(device_);
    rtcSetSceneFlags(scene, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST |
                                          (tells_fronts_ ? RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION : RTC_SCENE_FLAG_NONE)));
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    return scene;
}

RTCGeometry EmbreeTriangles::make(const RaySurface& surface, bool filters) const {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                sizeof(vec3), surface.positions->size()));
    std::copy(surface.positions->begin(), surface.positions->end(), vertices);
    auto* indices = static_cast<uvec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                sizeof(uvec3), surface.triangles.size()));
    std::copy(surface.triangles.begin(), surface.triangles.end(), indices);
    rtcSetGeometryMask(geometry, filters ? kFilter : kOpaque);
    rtcCommitGeometry(geometry);
    return geometry;
}

void EmbreeTriangles::build(std::span<const RaySurface> surfaces, const std::vector<std::uint8_t>& filters,
                            const RunContext& context) {
    const FloatTrapsOff quiet;
    release_scenes();
    rebuilt_ = false;
    still_ = new_scene();
    still_filters_ = new_scene();
    triangles_ = 0;
    for (std::size_t i = 0; i < surfaces.size() && !context.should_stop(); ++i) {
        RTCGeometry geometry = make(surfaces[i], filters[i] != 0);
        rtcAttachGeometryByID(still_, geometry, unsigned(i));
        if (filters[i] != 0) {
            rtcAttachGeometryByID(still_filters_, geometry, unsigned(i));
        }
        rtcReleaseGeometry(geometry);
        triangles_ += surfaces[i].triangles.size();
    }
    for (RTCScene scene : {still_, still_filters_}) {
        rtcSetSceneProgressMonitorFunction(
            scene, [](void* asked, double) { return !static_cast<const RunContext*>(asked)->should_stop(); },
            const_cast<RunContext*>(&context));
        if (!context.should_stop()) {
            rtcCommitScene(scene);
        }
        rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr); // the context is the caller's
    }
    number_in_moved_.assign(surfaces.size(), Hit::kNone);
    still_surfaces_ = surfaces.size();
}

void EmbreeTriangles::move(std::span<const std::uint32_t> moved, std::span<const RaySurface> surfaces,
                           const std::vector<std::uint8_t>& filters, std::span<const Box3> bounds) {
    const FloatTrapsOff quiet;
    number_in_moved_.resize(surfaces.size(), Hit::kNone);
    std::size_t at_rest = 0;
    for (const std::uint32_t surface : moved_surfaces_) {
        at_rest += surfaces[surface].triangles.size();
    }
    for (const std::uint32_t surface : moved) {
        at_rest -= number_in_moved_[surface] != Hit::kNone ? surfaces[surface].triangles.size() : 0;
    }
    if (at_rest > std::max(kFewMoved, triangles_ / kMostMovedShare)) {
        build(surfaces, filters);
        rebuilt_ = true;
        return;
    }
    if (moved_ == nullptr) {
        moved_ = new_scene();
        // Two levels: one small tree for each surface, fitted to new positions without being built again.
        rtcSetSceneFlags(moved_, rtcGetSceneFlags(moved_) | RTC_SCENE_FLAG_DYNAMIC);
        rtcSetSceneBuildQuality(moved_, RTC_BUILD_QUALITY_LOW);
    }
    for (const std::uint32_t i : moved) {
        const RaySurface& surface = surfaces[i];
        if (number_in_moved_[i] == Hit::kNone) {
            // Embree reads a geometry's mask when a ray meets one of its triangles: what has none is met no more, without a
            // commit of the scene, which would build it anew. The buffers and boxes stay where they are.
            if (i < still_surfaces_) {
                RTCGeometry left = rtcGetGeometry(still_, i);
                rtcSetGeometryMask(left, 0);
                rtcCommitGeometry(left);
            }
            number_in_moved_[i] = std::uint32_t(moved_surfaces_.size());
            moved_surfaces_.push_back(i);
            RTCGeometry geometry = make(surface, filters[i] != 0);
            rtcAttachGeometryByID(moved_, geometry, number_in_moved_[i]);
            rtcReleaseGeometry(geometry);
            continue;
        }
        RTCGeometry geometry = rtcGetGeometry(moved_, number_in_moved_[i]);
        rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
        std::copy(surface.positions->begin(), surface.positions->end(),
                  static_cast<vec3*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0)));
        rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
        rtcSetGeometryMask(geometry, filters[i] != 0 ? kFilter : kOpaque);
        rtcCommitGeometry(geometry);
    }
    rtcCommitScene(moved_);
    Box3 all;
    Box3 filtering;
    for (const std::uint32_t i : moved_surfaces_) {
        all.add(bounds[i]);
        if (filters[i] != 0) {
            filtering.add(bounds[i]);
        }
    }
    moved_reach_ = reach_of(all);
    moved_filter_reach_ = reach_of(filtering);
}

EmbreeTriangles::Reach EmbreeTriangles::reach_of(const Box3& bounds) {
    if (bounds.empty()) {
        return {};
    }
    Box3 box = bounds;
    const float slack = kBoxSlack * (1.0F + std::max(max_component(glm::abs(box.min)), max_component(glm::abs(box.max))));
    box.min -= slack;
    box.max += slack;
    const float radius = 0.5001F * box.diagonal();
    return {box, box.centre(), radius * radius};
}

// Errs on the side of true. Directions may have any length.
bool EmbreeTriangles::meets(const Reach& reach, const vec3& origin, const vec3& direction, float tnear, float tfar) {
    constexpr float kLeast = 1e-18F; // of a direction's components: keeps quotients finite
    constexpr float kSlack = 1e-6F;  // of distances: more than they are rounded by
    if (reach.empty()) {
        return false;
    }
    const vec3 there = reach.centre - origin;
    const float along = glm::dot(there, direction);
    const float distance2 = glm::dot(there, there);
    const float length2 = glm::dot(direction, direction);
    if (distance2 > reach.radius2 &&
        (along < 0.0F || distance2 * length2 * (1.0F - 4.0F * kSlack) - along * along > reach.radius2 * length2)) {
        return false; // most rays end here, without a division
    }
    float first = tnear;
    float last = tfar;
    for (int k = 0; k < 3; ++k) {
        const float d = direction[k];
        const float inverse = 1.0F / (std::abs(d) < kLeast ? std::copysign(kLeast, d) : d);
        const float a = (reach.box.min[k] - origin[k]) * inverse;
        const float b = (reach.box.max[k] - origin[k]) * inverse;
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first - std::abs(first) * kSlack <= last + std::abs(last) * kSlack;
}

void EmbreeTriangles::take_nearer_of_moved(RTCRayHit& query) const {
    const RTCRay& ray = query.ray;
    const Reach& reach = ray.mask == kFilter ? moved_filter_reach_ : moved_reach_;
    if (meets(reach, {ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, ray.tnear, ray.tfar)) {
        take_nearer_of(moved_, moved_surfaces_, query);
    }
}

void EmbreeTriangles::take_nearer_of(RTCScene scene, const std::vector<std::uint32_t>& numbers, RTCRayHit& query,
                                     RTCFilterFunctionN filter) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.filter = filter;
    RTCRayHit nearer = query;
    nearer.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    nearer.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &nearer);
    if (nearer.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
        query = nearer;
        query.hit.geomID = numbers[nearer.hit.geomID];
    }
}

bool EmbreeTriangles::remember(std::span<const RaySurface> surfaces, const std::vector<std::uint8_t>& filters) {
    const FloatTrapsOff quiet;
    if (rebuilt_) {
        return false;
    }
    if (before_surfaces_.size() == moved_surfaces_.size()) {
        return true;
    }
    if (before_ == nullptr) {
        before_ = new_scene();
    }
    Box3 all = before_reach_.empty() ? Box3{} : before_reach_.box;
    for (std::size_t k = before_surfaces_.size(); k < moved_surfaces_.size(); ++k) {
        const std::uint32_t i = moved_surfaces_[k];
        before_surfaces_.push_back(i);
        if (i >= still_surfaces_) {
            continue; // it was not there
        }
        // Its first place is in the buffers of what stands still, where its mask hides it from rays.
        const RaySurface& surface = surfaces[i];
        const auto* was =
            static_cast<const vec3*>(rtcGetGeometryBufferData(rtcGetGeometry(still_, i), RTC_BUFFER_TYPE_VERTEX, 0));
        RaySurface placed = surface;
        placed.positions = std::make_shared<const std::vector<vec3>>(was, was + surface.positions->size());
        for (const vec3& p : *placed.positions) {
            all.add(p);
        }
        RTCGeometry geometry = make(placed, filters[i] != 0);
        rtcAttachGeometryByID(before_, geometry, unsigned(k));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(before_);
    before_reach_ = reach_of(all);
    return true;
}

bool EmbreeTriangles::meets_moved(const vec3& from, const vec3& direction, float tnear, float tfar) const {
    const FloatTrapsOff quiet;
    const auto any = [&](RTCScene scene, const Reach& reach) {
        if (scene == nullptr || !meets(reach, from, direction, tnear, tfar)) {
            return false;
        }
        RTCRay query;
        fill(query, from, direction, tnear, tfar, kOpaque | kFilter);
        return anything_on(scene, query);
    };
    return any(moved_, moved_reach_) || any(before_, before_reach_);
}

bool EmbreeTriangles::still_blocks(const vec3& from, const vec3& direction, float tnear, float tfar) const {
    const FloatTrapsOff quiet;
    RTCRay query;
    fill(query, from, direction, tnear, tfar, kOpaque);
    return tnear < tfar && anything_on(still_, query);
}

TriangleHit EmbreeTriangles::nearest_before(const vec3& from, const vec3& direction, float tnear, float tfar) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const FloatTrapsOff quiet;
    RTCRayHit query;
    fill(query.ray, from, direction, tnear, tfar, kOpaque | kFilter);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(still_, &context, &query);
    if (meets(before_reach_, from, direction, tnear, query.ray.tfar)) {
        take_nearer_of(before_, before_surfaces_, query);
    }
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? TriangleHit{} : found(query);
}

TriangleHit EmbreeTriangles::nearest_front(bool before, const vec3& from, const vec3& direction, float tnear,
                                           float tfar) const {
    const FloatTrapsOff quiet;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.filter = keep_fronts;
    RTCRayHit query;
    fill(query.ray, from, direction, tnear, tfar, kOpaque);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(still_, &context, &query);
    if (before && meets(before_reach_, from, direction, tnear, query.ray.tfar)) {
        take_nearer_of(before_, before_surfaces_, query, keep_fronts);
    } else if (!before && moved_ != nullptr && meets(moved_reach_, from, direction, tnear, query.ray.tfar)) {
        take_nearer_of(moved_, moved_surfaces_, query, keep_fronts);
    }
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? TriangleHit{} : found(query);
}

bool EmbreeTriangles::blocked_by_moved(RTCRay& query) const {
    if (!meets(moved_reach_, {query.org_x, query.org_y, query.org_z}, {query.dir_x, query.dir_y, query.dir_z}, query.tnear,
               query.tfar)) {
        return false;
    }
    return anything_on(moved_, query);
}

unsigned EmbreeTriangles::blocked_of_8(const vec3& from, std::span<const vec3> directions, float tnear) const {
    const FloatTrapsOff quiet;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(32) int valid[8];
    RTCRay8 rays;
    for (std::size_t k = 0; k < 8; ++k) {
        valid[k] = k < directions.size() ? -1 : 0;
        const vec3& d = directions[std::min(k, directions.size() - 1)];
        rays.org_x[k] = from.x;
        rays.org_y[k] = from.y;
        rays.org_z[k] = from.z;
        rays.dir_x[k] = d.x;
        rays.dir_y[k] = d.y;
        rays.dir_z[k] = d.z;
        rays.tnear[k] = tnear;
        rays.tfar[k] = std::numeric_limits<float>::infinity();
        rays.time[k] = 0.0F;
        rays.mask[k] = kOpaque;
        rays.id[k] = 0;
        rays.flags[k] = 0;
    }
    rtcOccluded8(valid, still_, &context, &rays);
    if (moved_ != nullptr) {
        bool any = false;
        for (std::size_t k = 0; k < directions.size(); ++k) {
            const bool meets_moved = rays.tfar[k] >= 0.0F && meets(moved_reach_, from, directions[k], tnear, rays.tfar[k]);
            valid[k] = meets_moved ? -1 : 0;
            any = any || meets_moved;
        }
        if (any) {
            rtcOccluded8(valid, moved_, &context, &rays);
        }
    }
    unsigned out = 0;
    for (std::size_t k = 0; k < directions.size(); ++k) {
        out |= rays.tfar[k] < 0.0F ? 1U << k : 0U;
    }
    return out;
}

void EmbreeTriangles::nearest_filters_of_8(const vec3& from, std::span<const vec3> directions, std::span<const float> tnear,
                                           unsigned wanted, std::span<TriangleHit> hits) const {
    const FloatTrapsOff quiet;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(32) int valid[8];
    RTCRayHit8 rays;
    for (std::size_t k = 0; k < 8; ++k) {
        const bool asked = k < directions.size() && (wanted >> k & 1U) != 0;
        valid[k] = asked ? -1 : 0;
        const std::size_t from_k = std::min(k, directions.size() - 1);
        const vec3& d = directions[from_k];
        rays.ray.org_x[k] = from.x;
        rays.ray.org_y[k] = from.y;
        rays.ray.org_z[k] = from.z;
        rays.ray.dir_x[k] = d.x;
        rays.ray.dir_y[k] = d.y;
        rays.ray.dir_z[k] = d.z;
        rays.ray.tnear[k] = tnear[from_k];
        rays.ray.tfar[k] = std::numeric_limits<float>::infinity();
        rays.ray.time[k] = 0.0F;
        rays.ray.mask[k] = kFilter;
        rays.ray.id[k] = 0;
        rays.ray.flags[k] = 0;
        rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect8(valid, still_filters_, &context, &rays);
    for (std::size_t k = 0; k < directions.size(); ++k) {
        if (valid[k] == 0) {
            continue;
        }
        RTCRayHit one;
        fill(one.ray, from, directions[k], tnear[k], rays.ray.tfar[k], kFilter);
        one.hit.geomID = rays.hit.geomID[k];
        one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        one.hit.primID = rays.hit.primID[k];
        one.hit.u = rays.hit.u[k];
        one.hit.v = rays.hit.v[k];
        if (moved_ != nullptr) {
            take_nearer_of_moved(one);
        }
        hits[k] = one.hit.geomID == RTC_INVALID_GEOMETRY_ID
                      ? TriangleHit{}
                      : TriangleHit{one.hit.geomID, one.hit.primID, one.ray.tfar, {one.hit.u, one.hit.v}};
    }
}

} // namespace atrium
