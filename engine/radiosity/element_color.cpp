#include "engine/radiosity/element_color.h"

#include "engine/base/rng.h"
#include "engine/radiosity/patch_cells.h"

namespace atrium {
namespace {

constexpr unsigned kColorSamples = 16; // of a cell whose colour varies

SurfaceColor color_of_faces(const Hierarchy& h, const RayScene& rays, const Element& e) {
    dvec3 rho(0.0), emitted(0.0);
    SurfaceColor color;
    const Face* last = nullptr; // neighbours are mostly of one surface, whose colour is mostly one
    for (std::uint32_t f = e.triangle; f < e.triangle + e.face_count; ++f) {
        const Face& face = h.faces[f];
        if (last == nullptr || last->surface != face.surface || last->back != face.back ||
            color_varies(rays, face.surface)) {
            color = color_at(rays, face.surface, face.triangle, face.back, vec2(1.0F / 3.0F));
            last = &face;
        }
        rho += dvec3(color.rho) * double(face.area);
        emitted += dvec3(color.emitted) * double(face.area);
    }
    return {Rgb(rho / double(e.area)), Rgb(emitted / double(e.area))};
}

} // namespace

SurfaceColor color_at(const RayScene& rays, std::uint32_t surface, std::uint32_t triangle, bool back,
                      const vec2& barycentric) {
    const Material& m = rays.material(surface);
    const vec4 color = rays.base_color(surface, triangle, barycentric);
    Material at_point = m;
    at_point.base_color = Rgb(color);
    const float cover = m.alpha_mode == Material::Alpha::Opaque ? 1.0F
                        : m.alpha_mode == Material::Alpha::Mask ? (color.a >= m.alpha_cutoff ? 1.0F : 0.0F)
                                                                : color.a;
    SurfaceColor out;
    out.rho = diffuse_reflectance(at_point) * cover;
    if (!back || m.double_sided) {
        out.emitted = rays.emission(surface, triangle, barycentric) * kPi;
    }
    return out;
}

bool color_varies(const RayScene& rays, std::uint32_t surface) {
    const Material& m = rays.material(surface);
    return m.base_color_texture || m.emissive_texture || !rays.surfaces()[surface].mesh->colors.empty();
}

SurfaceColor mean_color(const Hierarchy& h, const RayScene& rays, const Element& e) {
    if (e.kind != Element::Kind::Patch) {
        return color_of_faces(h, rays, e);
    }
    const PatchCell& cell = h.patches[e.patch];
    const Sheet& sheet = h.sheets[cell.sheet];
    if (!sheet.varies) {
        return color_at(rays, e.surface, h.sheet_triangles[sheet.first].triangle, e.back, vec2(1.0F / 3.0F));
    }
    SurfaceColor mean;
    for (unsigned i = 0; i < kColorSamples; ++i) {
        const CellPoint p = point_in_parts(h, cell, sobol_owen2(i, 0, 29U));
        const SurfaceColor color = color_at(rays, e.surface, p.triangle, e.back, p.barycentric);
        mean.rho += color.rho / float(kColorSamples);
        mean.emitted += color.emitted / float(kColorSamples);
    }
    return mean;
}

std::vector<std::uint32_t> leaves_of(const Hierarchy& h, std::span<const std::uint8_t> surfaces) {
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < h.elements.size(); ++i) {
        const Element& e = h.elements[i];
        bool any = false;
        if (e.leaf() && e.kind == Element::Kind::Patch) {
            any = surfaces[e.surface] != 0;
        } else if (e.leaf() && e.kind == Element::Kind::Faces) {
            for (std::uint32_t f = e.triangle; f < e.triangle + e.face_count && !any; ++f) {
                any = surfaces[h.faces[f].surface] != 0;
            }
        }
        if (any) {
            out.push_back(i);
        }
    }
    return out;
}

} // namespace atrium
