#include "engine/radiosity/hierarchy.h"

#include "engine/radiosity/patch_cells.h"

#include <algorithm>

namespace atrium {
namespace {

template <class T> std::size_t bytes_of(const std::vector<T>& v) { return v.capacity() * sizeof(T); }

} // namespace

std::size_t Hierarchy::memory_bytes() const {
    return bytes_of(elements) + bytes_of(harmonics) + bytes_of(faces) + bytes_of(sheets) + bytes_of(sheet_triangles) +
           bytes_of(patches) + bytes_of(cell_parts) + bytes_of(first_triangle) + bytes_of(on_sheet) + bytes_of(top);
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
    while (!elements[at].leaf()) {
        const Element& e = elements[at];
        // The nearest part: it holds the point, unless rounding put that where nothing is covered.
        float nearest = std::numeric_limits<float>::infinity();
        for (std::uint32_t k = 0; k < e.child_count; ++k) {
            const PatchCell& cell = patches[elements[e.first_child + k].patch];
            const vec2 d = uv - glm::clamp(uv, cell.low, cell.high);
            const float distance = std::abs(d.x) + std::abs(d.y);
            if (distance < nearest) {
                nearest = distance;
                at = e.first_child + k;
            }
        }
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

void Hierarchy::pull_radiosity() {
    // Children always come after their parent, so one backward pass visits them first.
    for (std::size_t i = elements.size(); i-- > 0;) {
        Element& e = elements[i];
        if (!e.leaf()) {
            Rgb radiosity(0.0F);
            Rgb irradiance(0.0F);
            Rgb direct(0.0F);
            for (std::uint32_t k = 0; k < e.child_count; ++k) {
                const Element& child = elements[e.first_child + k];
                radiosity += child.radiosity * child.area;
                irradiance += child.irradiance * child.area;
                direct += child.direct * child.area;
            }
            e.radiosity = radiosity / e.area;
            e.irradiance = irradiance / e.area;
            e.direct = direct / e.area;
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
