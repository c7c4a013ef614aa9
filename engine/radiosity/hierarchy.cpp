#include "engine/radiosity/hierarchy.h"

#include "engine/radiosity/patch_cells.h"

#include <algorithm>
#include <bit>

namespace atrium {
namespace {

template <class T> std::size_t bytes_of(const std::vector<T>& v) { return v.capacity() * sizeof(T); }

// Rounding may put a point of a triangle just where no part covers anything.
std::uint32_t nearest_part(const Hierarchy& h, const CellStep& step, const vec2& uv) {
    std::uint32_t best = 0;
    float nearest = std::numeric_limits<float>::infinity();
    for (std::uint32_t k = 0; k < std::uint32_t(std::popcount(unsigned(step.present))); ++k) {
        const PatchCell& cell = h.patches[step.first_cell + k];
        const vec2 d = glm::abs(uv - glm::clamp(uv, cell.low, cell.high));
        if (d.x + d.y < nearest) {
            nearest = d.x + d.y;
            best = k;
        }
    }
    return best;
}

} // namespace

std::size_t Hierarchy::memory_bytes() const {
    return bytes_of(elements) + bytes_of(harmonics) + bytes_of(faces) + bytes_of(sheets) + bytes_of(sheet_triangles) +
           bytes_of(patches) + bytes_of(steps) + bytes_of(cell_parts) + bytes_of(first_triangle) + bytes_of(on_sheet) +
           bytes_of(top) + bytes_of(room);
}

std::uint32_t Hierarchy::leaf_at(std::uint32_t surface, std::uint32_t triangle, bool back, const vec2& barycentric) const {
    if (surface >= first_triangle.size()) {
        return Element::kNone;
    }
    const std::size_t side = first_triangle[surface] + triangle;
    std::uint32_t at = top[side][back ? 1 : 0];
    if (at == Element::kNone || elements[at].leaf()) {
        return at;
    }
    const std::array<vec2, 3>& corner = sheet_triangles[on_sheet[side]].uv;
    const vec2 uv = corner[0] + (corner[1] - corner[0]) * barycentric.x + (corner[2] - corner[0]) * barycentric.y;
    for (std::uint32_t cell = elements[at].patch; steps[cell].first_child != Element::kNone;) {
        const CellStep& step = steps[cell];
        const unsigned quadrant = ((step.cut & 1U) != 0 && uv.x >= step.middle.x ? 1U : 0U) |
                                  ((step.cut & 2U) != 0 && uv.y >= step.middle.y ? 2U : 0U);
        const bool present = (step.present >> quadrant & 1U) != 0;
        const unsigned below = step.present & ((1U << quadrant) - 1U);
        const std::uint32_t k = present ? std::uint32_t(std::popcount(below)) : nearest_part(*this, step, uv);
        at = step.first_child + k;
        cell = step.first_cell + k;
    }
    return at;
}

std::vector<std::uint32_t> Hierarchy::leaves() const {
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < elements.size(); ++i) {
        if (elements[i].leaf()) {
            out.push_back(i);
        }
    }
    return out;
}

void Hierarchy::follow(std::uint32_t surface, const dmat4& motion) {
    const auto point = [&](const vec3& p) { return vec3(dvec3(motion * dvec4(dvec3(p), 1.0))); };
    const auto direction = [&](const vec3& d) { return vec3(glm::normalize(dmat3(motion) * dvec3(d))); };
    for (Sheet& s : sheets) {
        if (s.surface == surface) {
            s.origin = point(s.origin);
            s.axis_u = direction(s.axis_u);
            s.axis_v = direction(s.axis_v);
            s.normal = direction(s.normal);
        }
    }
    for (PatchCell& cell : patches) {
        if (sheets[cell.sheet].surface == surface) {
            for (vec3& corner : cell.corner) {
                corner = point(corner);
            }
        }
    }
    for (Face& f : faces) {
        if (f.surface == surface) {
            f.normal = direction(f.normal);
        }
    }
    for (Element& e : elements) {
        if (e.kind == Element::Kind::Patch && e.surface == surface) {
            e.centre = point(e.centre);
            e.normal = direction(e.normal);
        } else if (e.kind == Element::Kind::Faces) {
            const auto first = faces.begin() + e.triangle;
            if (std::all_of(first, first + e.face_count, [&](const Face& f) { return f.surface == surface; })) {
                e.centre = point(e.centre);
            }
        }
    }
}

void Hierarchy::pull_radiosity() {
    // Children always come after their parent, so one backward pass visits them first.
    for (std::size_t i = elements.size(); i-- > 0;) {
        Element& e = elements[i];
        if (!e.leaf()) {
            Rgb radiosity(0.0F);
            Rgb irradiance(0.0F);
            Rgb direct(0.0F);
            Rgb caustic(0.0F);
            for (std::uint32_t k = 0; k < e.child_count; ++k) {
                const Element& child = elements[e.first_child + k];
                radiosity += child.radiosity * child.area;
                irradiance += child.irradiance * child.area;
                direct += child.direct * child.area;
                caustic += child.caustic * child.area;
            }
            e.radiosity = radiosity / e.area;
            e.irradiance = irradiance / e.area;
            e.direct = direct / e.area;
            e.caustic = caustic / e.area;
        }
        e.power = e.area * luminance(e.radiosity);
        e.spread = 0.0F;
        for (std::uint32_t k = 0; k < e.child_count; ++k) {
            const Element& child = elements[e.first_child + k];
            e.spread = std::max(e.spread, std::abs(luminance(child.radiosity) - luminance(e.radiosity)) + child.spread);
        }
        if (e.harmonics == Element::kNone) {
            continue;
        }
        Harmonics& h = harmonics[e.harmonics];
        h.emission = {};
        if (e.kind == Element::Kind::Faces) {
            for (std::size_t s = 0; s < kShCount; ++s) {
                h.emission[s] = e.radiosity * h.projected_area[s];
            }
            continue;
        }
        for (std::uint32_t k = 0; k < e.child_count; ++k) {
            const Element& child = elements[e.first_child + k];
            if (child.kind == Element::Kind::Patch) {
                const Sh lobe = sh_clamped_cosine(child.normal, child.area);
                for (std::size_t s = 0; s < kShCount; ++s) {
                    h.emission[s] += child.radiosity * lobe[s];
                }
            } else {
                for (std::size_t s = 0; s < kShCount; ++s) {
                    h.emission[s] += harmonics[child.harmonics].emission[s];
                }
            }
        }
    }
}

SurfacePoint sample_point(const Hierarchy& hierarchy, const RayScene& rays, std::uint32_t index, vec2 u, bool by_power) {
    const Element* e = &hierarchy.elements[index];
    while (e->kind == Element::Kind::Cluster) {
        const bool shines = by_power && e->power > 0.0F;
        float total = 0.0F;
        for (std::uint32_t k = 0; k < e->child_count; ++k) {
            const Element& child = hierarchy.elements[e->first_child + k];
            total += shines ? std::max(child.power, 0.0F) : child.area;
        }
        float at = u.x * total;
        std::uint32_t chosen = e->child_count - 1;
        float weight = 0.0F;
        for (std::uint32_t k = 0; k < e->child_count; ++k) {
            const Element& child = hierarchy.elements[e->first_child + k];
            weight = shines ? std::max(child.power, 0.0F) : child.area;
            if (at < weight) {
                chosen = k;
                break;
            }
            at -= weight;
        }
        u.x = weight > 0.0F ? std::clamp(at / weight, 0.0F, 0.99999994F) : 0.5F;
        e = &hierarchy.elements[e->first_child + chosen];
    }
    if (e->kind == Element::Kind::Patch) {
        return {point_in_cell(hierarchy, hierarchy.patches[e->patch], u).position, e->normal};
    }
    const auto begin = hierarchy.faces.begin() + e->triangle;
    const auto end = begin + e->face_count;
    const float at = u.x * (end - 1)->upto;
    const auto face =
        std::min(std::upper_bound(begin, end, at, [](float value, const Face& f) { return value < f.upto; }), end - 1);
    u.x = std::clamp((at - (face->upto - face->area)) / face->area, 0.0F, 0.99999994F);
    // Square to triangle by folding keeps strata connected (Heitz 2019 is smoother; this is enough for visibility). Pulled
    // in a little, so that no sample lies on an edge shared with a neighbour.
    const vec2 v = vec2(0.002F) + (u.x + u.y > 1.0F ? vec2(1.0F) - u : u) * 0.994F;
    const std::array<vec3, 3> p = rays.triangle(face->surface, face->triangle);
    return {p[0] + (p[1] - p[0]) * v.x + (p[2] - p[0]) * v.y, face->normal};
}

} // namespace atrium
