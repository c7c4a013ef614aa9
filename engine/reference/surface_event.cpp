#include "engine/reference/surface_event.h"

#include <algorithm>

namespace atrium {

vec3 clear_of(const vec3& position, const vec3& normal) {
    const vec3 a = glm::abs(position);
    return position + normal * std::max(1e-5F, 5e-7F * max_component(a));
}

bool side_reflects(const RayScene& rays, const Hit& hit) { return hit.front || rays.surfaces()[hit.surface].back_side; }

SurfacePoint surface_point(const RayScene& rays, const Hit& hit, const vec3& direction) {
    SurfacePoint out;
    out.hit = hit;
    out.direction = direction;
    out.material = &rays.material(hit.surface);
    const Material& m = *out.material;
    const auto p = rays.triangle(hit.surface, hit.triangle);
    out.position = p[0] + (p[1] - p[0]) * hit.barycentric.x + (p[2] - p[0]) * hit.barycentric.y;
    out.side = hit.front ? hit.geometric_normal : -hit.geometric_normal;
    const vec4 color = rays.base_color(hit.surface, hit.triangle, hit.barycentric);
    out.color = Rgb(color);
    out.covered = m.alpha_mode == Material::Alpha::Blend ? std::clamp(color.a, 0.0F, 1.0F) : 1.0F;
    out.through = rays.straight_through(hit, direction);
    const bool reflects = side_reflects(rays, hit);
    if (reflects) {
        Material at_point = m;
        at_point.base_color = out.color;
        out.diffuse = diffuse_reflectance(at_point) * out.covered;
    }
    // Glass is the same from both sides; the black back of a mirror is no mirror.
    out.specular = is_specular(m) && (reflects || m.metallic < 0.5F);
    return out;
}

bool bounds_solid(const RayScene& rays, const SurfacePoint& point) {
    return classify(*point.material) == MaterialKind::DielectricSolid && !rays.surfaces()[point.hit.surface].slab;
}

SpecularSample specular_way(const RayScene& rays, const SurfacePoint& point, const vec3& u, float path) {
    if (!point.specular) {
        return {};
    }
    SpecularPoint at;
    at.material = point.material;
    at.base_color = point.color;
    at.normal = rays.shading_normal(point.hit) * (point.hit.front ? 1.0F : -1.0F);
    at.geometric = point.side;
    at.front = point.hit.front;
    at.slab = rays.surfaces()[point.hit.surface].slab;
    SpecularSample way = sample_specular(at, point.direction, u);
    way.weight *= point.covered;
    if (!point.hit.front && bounds_solid(rays, point)) {
        way.weight *= absorption(*point.material, path);
    }
    return way;
}

vec3 start_of(const SurfacePoint& point, const SpecularSample& way) {
    return clear_of(point.position, way.transmitted ? -point.side : point.side);
}

} // namespace atrium
