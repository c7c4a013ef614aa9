#include "tests/bench/bare_embree.h"

#include <algorithm>
#include <embree3/rtcore.h>

namespace atrium::bench {
namespace {

constexpr unsigned kOpaque = 1;
constexpr unsigned kFilter = 2;

} // namespace

struct BareEmbree::Impl {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);

    ~Impl() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

BareEmbree::BareEmbree(const RayScene& rays) : impl_(std::make_unique<Impl>()) {
    rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_MEDIUM);
    for (std::uint32_t i = 0; i < rays.surfaces().size(); ++i) {
        const RaySurface& s = rays.surfaces()[i];
        const Material& m = rays.material(i);
        RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                    sizeof(vec3), s.positions->size()));
        std::copy(s.positions->begin(), s.positions->end(), vertices);
        auto* indices = static_cast<uvec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                    sizeof(uvec3), s.triangles.size()));
        std::copy(s.triangles.begin(), s.triangles.end(), indices);
        const bool filters = m.transmission > 0.0F || m.alpha_mode != Material::Alpha::Opaque;
        rtcSetGeometryMask(geometry, filters ? kFilter : kOpaque);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(impl_->scene, geometry, i);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(impl_->scene);
}

BareEmbree::~BareEmbree() = default;

std::size_t BareEmbree::nearest(std::span<const BareRay> rays) const {
    std::size_t hits = 0;
    for (const BareRay& r : rays) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query{};
        query.ray = {r.origin.x, r.origin.y,        r.origin.z, r.tnear, r.direction.x, r.direction.y, r.direction.z, 0.0F,
                     r.tfar,     kOpaque | kFilter, 0,          0};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(impl_->scene, &context, &query);
        hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    }
    return hits;
}

std::size_t BareEmbree::occluded(std::span<const BareRay> rays) const {
    std::size_t hits = 0;
    for (const BareRay& r : rays) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay ray = {r.origin.x, r.origin.y, r.origin.z, r.tnear, r.direction.x, r.direction.y, r.direction.z, 0.0F,
                      r.tfar,     kOpaque,    0,          0};
        rtcOccluded1(impl_->scene, &context, &ray);
        hits += ray.tfar < 0.0F ? 1 : 0;
    }
    return hits;
}

std::size_t BareEmbree::occluded_by_8(std::span<const BareRay> rays) const {
    constexpr std::size_t kWide = 8;
    std::size_t hits = 0;
    for (std::size_t first = 0; first < rays.size(); first += kWide) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        alignas(32) int valid[kWide];
        RTCRay8 packet{};
        for (std::size_t k = 0; k < kWide; ++k) {
            valid[k] = first + k < rays.size() ? -1 : 0;
            const BareRay& r = rays[std::min(first + k, rays.size() - 1)];
            packet.org_x[k] = r.origin.x;
            packet.org_y[k] = r.origin.y;
            packet.org_z[k] = r.origin.z;
            packet.dir_x[k] = r.direction.x;
            packet.dir_y[k] = r.direction.y;
            packet.dir_z[k] = r.direction.z;
            packet.tnear[k] = r.tnear;
            packet.tfar[k] = r.tfar;
            packet.mask[k] = kOpaque;
        }
        rtcOccluded8(valid, impl_->scene, &context, &packet);
        for (std::size_t k = 0; k < kWide; ++k) {
            hits += valid[k] != 0 && packet.tfar[k] < 0.0F ? 1 : 0;
        }
    }
    return hits;
}

} // namespace atrium::bench
