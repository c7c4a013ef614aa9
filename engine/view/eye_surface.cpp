#include "engine/view/eye_surface.h"

#include <algorithm>

namespace atrium {

vec3 off_surface(const vec3& position, const vec3& normal) {
    return position + normal * std::max(1e-5F, 5e-7F * max_component(glm::abs(position)));
}

EyeSurface eye_surface(const RayScene& rays, const Hit& hit, const vec3& direction) {
    EyeSurface out;
    out.hit = hit;
    out.direction = direction;
    out.material = &rays.material(hit.surface);
    const Material& m = *out.material;
    const auto p = rays.triangle(hit.surface, hit.triangle);
    out.position = p[0] + (p[1] - p[0]) * hit.barycentric.x + (p[2] - p[0]) * hit.barycentric.y;
    out.side = hit.front ? hit.geometric_normal : -hit.geometric_normal;
    out.normal = rays.shading_normal(hit) * (hit.front ? 1.0F : -1.0F);
    if (!(glm::dot(out.normal, direction) < 0.0F)) {
        out.normal = out.side; // bent away from the eye by interpolation
    }
    const vec4 color = rays.base_color(hit.surface, hit.triangle, hit.barycentric);
    out.color = Rgb(color);
    out.covered = m.alpha_mode == Material::Alpha::Blend ? std::clamp(color.a, 0.0F, 1.0F) : 1.0F;
    out.through = rays.straight_through(hit, direction);
    const bool reflects = hit.front || rays.surfaces()[hit.surface].back_side;
    if (reflects) {
        Material at_point = m;
        at_point.base_color = out.color;
        out.diffuse = diffuse_reflectance(at_point) * out.covered;
        out.emitted = rays.emission(hit.surface, hit.triangle, hit.barycentric) * out.covered;
    }
    // Glass is the same from both sides; the black back of a mirror is no mirror.
    out.specular = is_specular(m) && (reflects || m.metallic < 0.5F);
    return out;
}

bool EyeSurface::culled() const {
    return !hit.front && !material->double_sided && classify(*material) != MaterialKind::DielectricSolid;
}

SpecularWays EyeSurface::ways(const RayScene& rays, const vec2& u) const {
    SpecularWays out;
    if (!specular) {
        return out;
    }
    SpecularPoint at;
    at.material = material;
    at.base_color = color;
    at.normal = normal;
    at.geometric = side;
    at.front = hit.front;
    at.slab = rays.surfaces()[hit.surface].slab;
    out = specular_ways(at, direction, u);
    Rgb left(covered);
    if (!hit.front && !at.slab && classify(*material) == MaterialKind::DielectricSolid) {
        left *= absorption(*material, hit.t); // the ray has just crossed the solid
    }
    out.reflected.weight *= left;
    out.transmitted.weight *= left;
    return out;
}

vec3 EyeSurface::start_of(const SpecularSample& way) const { return off_surface(position, way.transmitted ? -side : side); }

vec3 EyeSurface::behind() const { return off_surface(position, -side); }

} // namespace atrium
