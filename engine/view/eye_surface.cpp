#include "engine/view/eye_surface.h"

namespace atrium {

EyeSurface eye_surface(const RayScene& rays, const Hit& hit, const vec3& direction) {
    EyeSurface out;
    static_cast<WalkPoint&>(out) = walk_point(rays, hit, direction);
    out.hit = hit;
    out.direction = direction;
    out.through = rays.straight_through(hit, direction);
    if (hit.front || rays.surfaces()[hit.surface].back_side) {
        Material at_point = *out.material;
        at_point.base_color = out.base_color;
        out.diffuse = diffuse_reflectance(at_point) * out.cover;
        out.emitted = rays.emission(hit.surface, hit.triangle, hit.barycentric) * out.cover;
    }
    return out;
}

bool EyeSurface::culled() const {
    return !hit.front && !material->double_sided && classify(*material) != MaterialKind::DielectricSolid;
}

SpecularWays EyeSurface::ways(const vec2& u) const {
    if (!mirrors) {
        return {};
    }
    SpecularWays out = specular_ways(*this, direction, u);
    const Rgb left = left_by_solid(*this, hit) * cover;
    out.reflected.weight *= left;
    out.transmitted.weight *= left;
    return out;
}

vec3 EyeSurface::start_of(const SpecularSample& way) const {
    return off_surface(position, way.transmitted ? -geometric : geometric);
}

vec3 EyeSurface::behind() const { return off_surface(position, -geometric); }

} // namespace atrium
