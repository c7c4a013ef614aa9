#include "engine/raycast/ray_scene_impl.h"

#include <algorithm>

namespace atrium {

float shadow_offset(const vec3& p) {
    constexpr float kEndOffset = 2e-4F;
    constexpr float kRelativeOffset = 5e-7F; // about four roundings
    return std::max(kEndOffset, kRelativeOffset * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
}

RayScene::RayScene(const Scene& scene, const RunContext& context) : impl_(std::make_unique<Impl>()) {
    impl_->scene = scene;
    impl_->collect(context);
    impl_->embree.build(impl_->surfaces, impl_->filters, context);
}

RayScene::~RayScene() = default;

std::optional<std::vector<MovedSurface>> RayScene::move_to(const Scene& scene, NewThings things) {
    return impl_->move_to(scene, things);
}
Result<std::vector<MaterialId>> RayScene::recolor(const Scene& scene) { return impl_->recolor(scene); }
void RayScene::settle() {
    if (impl_->embree.anything_moved()) {
        impl_->embree.build(impl_->surfaces, impl_->filters);
    }
}

const std::vector<RaySurface>& RayScene::surfaces() const { return impl_->surfaces; }
dvec3 RayScene::origin() const { return impl_->origin; }
Box3 RayScene::bounds() const { return impl_->bounds; }
std::size_t RayScene::triangle_count() const { return impl_->triangles; }
std::size_t RayScene::dropped_triangles() const { return impl_->dropped; }
std::size_t RayScene::memory_bytes() const { return impl_->embree.bytes(); }
bool RayScene::absent(std::uint32_t surface) const { return impl_->is_absent(surface); }
const Material& RayScene::material(std::uint32_t surface) const { return *impl_->materials[surface]; }

std::uint64_t RayScene::rays_traced() const {
    std::uint64_t sum = 0;
    for (const Impl::Counter& c : impl_->counters) {
        sum += c.value.load(std::memory_order_relaxed);
    }
    return sum;
}

Hit RayScene::nearest(const Ray& ray) const { return impl_->nearest(*this, ray, false); }
Hit RayScene::nearest_before(const Ray& ray) const { return impl_->nearest(*this, ray, true); }
bool RayScene::look_back() { return impl_->embree.remember(impl_->surfaces, impl_->filters); }
bool RayScene::meets_moved(const Ray& ray) const {
    return impl_->embree.meets_moved(ray.origin, ray.direction, 0.0F, ray.tmax);
}
bool RayScene::still_blocks(const Ray& ray) const {
    impl_->count_ray();
    return impl_->embree.still_blocks(ray.origin, ray.direction, shadow_offset(ray.origin), ray.tmax);
}

bool RayScene::occluded(const vec3& from, const vec3& to) const { return max_component(transmittance(from, to)) <= 0.0F; }

Rgb RayScene::transmittance(const vec3& from, const vec3& to) const {
    const vec3 d = to - from;
    const float length = glm::length(d);
    if (!(length > 0.0F)) {
        return Rgb(1.0F);
    }
    const float most = 0.1F * length;
    return impl_->transmit(*this, from, d / length, std::min(shadow_offset(from), most),
                           length - std::min(shadow_offset(to), most));
}

Rgb RayScene::transmittance_to_infinity(const vec3& from, const vec3& direction) const {
    return impl_->transmit(*this, from, direction, shadow_offset(from), std::numeric_limits<float>::infinity());
}

void RayScene::look_at_sky(const vec3& from, std::span<const vec3> directions, std::span<SkyRay> out) const {
    ATRIUM_CHECK(directions.size() == out.size());
    const float tnear = shadow_offset(from);
    for (std::size_t first = 0; first < directions.size(); first += 8) {
        const auto some = directions.subspan(first, std::min<std::size_t>(8, directions.size() - first));
        impl_->count_rays(some.size());
        const unsigned blocked = impl_->embree.blocked_of_8(from, some, tnear);
        impl_->cross_filters_of_8(*this, from, some, blocked, tnear, out.subspan(first, some.size()));
    }
}

Rgb RayScene::transmittance(const Ray& ray) const {
    return impl_->transmit(*this, ray.origin, ray.direction, 0.0F, ray.tmax);
}

Rgb RayScene::straight_through(const Hit& hit, const vec3& direction) const {
    const bool filtering = impl_->filters[hit.surface] != 0;
    return filtering ? impl_->filter(*this, hit, direction) : Rgb(0.0F);
}

vec4 RayScene::base_color(std::uint32_t surface, std::uint32_t triangle, const vec2& barycentric) const {
    const Material& m = *impl_->materials[surface];
    vec4 color(m.base_color, m.alpha);
    if (m.base_color_texture) {
        color *= impl_->textured(m.base_color_texture, surface, triangle, barycentric);
    }
    const MeshData& mesh = *impl_->surfaces[surface].mesh;
    if (!mesh.colors.empty()) {
        color *= vec4(impl_->interpolate(mesh.colors, surface, triangle, barycentric), 1.0F);
    }
    return color;
}

Rgb RayScene::emission(std::uint32_t surface, std::uint32_t triangle, const vec2& barycentric) const {
    const Material& m = *impl_->materials[surface];
    Rgb emitted = m.emitted_radiance();
    if (m.emissive_texture && m.emits()) {
        emitted *= Rgb(impl_->textured(m.emissive_texture, surface, triangle, barycentric));
    }
    return emitted;
}

std::array<vec3, 3> RayScene::triangle(std::uint32_t surface, std::uint32_t triangle) const {
    const RaySurface& s = impl_->surfaces[surface];
    const uvec3& t = s.triangles[triangle];
    return {(*s.positions)[t.x], (*s.positions)[t.y], (*s.positions)[t.z]};
}

vec3 RayScene::shading_normal(const Hit& hit) const {
    const RaySurface& s = impl_->surfaces[hit.surface];
    if (s.mesh->normals.empty()) {
        return hit.geometric_normal;
    }
    const vec3 local = impl_->interpolate(s.mesh->normals, hit.surface, hit.triangle, hit.barycentric);
    const dvec3 n = s.normal_matrix * dvec3(local);
    const double length = glm::length(n);
    return length > 0.0 ? vec3(n / length) : hit.geometric_normal;
}

} // namespace atrium
