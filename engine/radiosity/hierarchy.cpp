#include "engine/radiosity/hierarchy.h"

#include "engine/base/checks.h"
#include "engine/base/rng.h"

#include <algorithm>
#include <numeric>

namespace atrium {
namespace {

// Reflectance and exitance of a triangle part: textures are averaged over a fixed pattern.
constexpr std::array<vec2, 10> kPattern{vec2{1.0F / 3, 1.0F / 3}, vec2{0.1F, 0.1F},  vec2{0.8F, 0.1F},   vec2{0.1F, 0.8F},
                                        vec2{0.45F, 0.1F},        vec2{0.1F, 0.45F}, vec2{0.45F, 0.45F}, vec2{0.2F, 0.2F},
                                        vec2{0.6F, 0.2F},         vec2{0.2F, 0.6F}};

struct SurfaceColor {
    Rgb rho{0.0F};
    Rgb emitted{0.0F};
};

SurfaceColor average_color(const RayScene& rays, std::uint32_t surface, std::uint32_t triangle, bool back,
                           const std::array<vec2, 3>& corner, std::size_t samples) {
    const Material& m = rays.material(surface);
    Material at_point = m;
    SurfaceColor sum;
    for (std::size_t i = 0; i < samples; ++i) {
        const vec2 u = kPattern[i];
        const vec2 b = corner[0] + (corner[1] - corner[0]) * u.x + (corner[2] - corner[0]) * u.y;
        const vec4 color = rays.base_color(surface, triangle, b);
        at_point.base_color = Rgb(color);
        const float cover = m.alpha_mode == Material::Alpha::Opaque ? 1.0F
                            : m.alpha_mode == Material::Alpha::Mask ? (color.a >= m.alpha_cutoff ? 1.0F : 0.0F)
                                                                    : color.a;
        sum.rho += diffuse_reflectance(at_point) * cover;
        if (!back || m.double_sided) {
            sum.emitted += rays.emission(surface, triangle, b) * kPi;
        }
    }
    sum.rho /= float(samples);
    sum.emitted /= float(samples);
    return sum;
}

std::size_t color_samples(const RayScene& rays, std::uint32_t surface, std::size_t wanted) {
    const Material& m = rays.material(surface);
    const bool varies = m.base_color_texture || m.emissive_texture || !rays.surfaces()[surface].mesh->colors.empty();
    return varies ? wanted : 1;
}

/// Recursive builder over faces and patches, sorted in place.
class Builder {
public:
    Builder(const RayScene& rays, Hierarchy& out) : rays_(rays), out_(out) {}

    void run() {
        std::vector<Item> emitting;
        std::vector<Item> other;
        const auto& surfaces = rays_.surfaces();
        for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
            const bool emits = rays_.material(s).emits();
            for (std::uint32_t t = 0; t < surfaces[s].triangles.size(); ++t) {
                add_item(emits ? emitting : other, s, t, false);
                if (surfaces[s].back_side) {
                    add_item(emits ? emitting : other, s, t, true);
                }
            }
        }
        out_.first_side.resize(surfaces.size());
        std::size_t sides = 0;
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            out_.first_side[i] = sides;
            sides += 2 * surfaces[i].triangles.size();
        }
        out_.top_of_side.assign(sides, Element::kNone);
        if (emitting.empty() && other.empty()) {
            return;
        }
        out_.elements.emplace_back();
        out_.elements[0].path = hash64(out_.settings.seed);
        std::vector<std::span<Item>> parts;
        for (auto* items : {&emitting, &other}) {
            if (!items->empty()) {
                parts.emplace_back(*items);
            }
        }
        make_children(0, parts);
    }

private:
    struct Item {
        Face face;
        vec3 centroid{0.0F};
        float extent = 0.0F; ///< longest edge
        bool patch = false;
    };

    void add_item(std::vector<Item>& items, std::uint32_t s, std::uint32_t t, bool back) {
        const auto p = rays_.triangle(s, t);
        const vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
        const float length = glm::length(cross);
        Item item;
        item.face = {s, t, back, 0.5F * length, cross / length * (back ? -1.0F : 1.0F)};
        item.centroid = (p[0] + p[1] + p[2]) / 3.0F;
        const float longest = std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[1]), glm::length(p[0] - p[2])});
        item.extent = longest;
        item.patch = longest > out_.settings.group_size;
        items.push_back(item);
    }

    // Fills element `index` (already in the array) from its items.
    void build(std::uint32_t index, std::span<Item> items) {
        if (items.size() == 1 && items[0].patch) {
            make_patch(index, items[0]);
            return;
        }
        Box3 centroids;
        bool any_patch = false;
        for (const Item& item : items) {
            centroids.add(item.centroid);
            any_patch = any_patch || item.patch;
        }
        const vec3 size = centroids.size();
        const bool together = max_component(size) <= out_.settings.group_size;
        if (!any_patch && together && items.size() <= 64) {
            make_faces(index, items);
            return;
        }
        // One long triangle would make a whole branch look as large as itself: the long ones get a branch of their own.
        float longest = 0.0F;
        for (const Item& item : items) {
            longest = std::max(longest, item.extent);
        }
        if (longest > 0.5F * glm::length(size)) {
            const auto small_end = std::stable_partition(items.begin(), items.end(),
                                                         [&](const Item& item) { return item.extent < 0.35F * longest; });
            if (small_end != items.begin() && small_end != items.end()) {
                const auto at = std::size_t(small_end - items.begin());
                make_children(index, {items.first(at), items.subspan(at)});
                return;
            }
        }
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const float middle = centroids.centre()[axis];
        auto split = std::stable_partition(items.begin(), items.end(),
                                           [&](const Item& item) { return item.centroid[axis] < middle; });
        if (split == items.begin() || split == items.end()) {
            split = items.begin() + std::ptrdiff_t(items.size() / 2); // coincident centroids: by count
        }
        const auto at = std::size_t(split - items.begin());
        make_children(index, {items.first(at), items.subspan(at)});
    }

    void make_children(std::uint32_t index, const std::vector<std::span<Item>>& parts) {
        const auto first = std::uint32_t(out_.elements.size());
        out_.elements.resize(first + parts.size());
        out_.elements[index].kind = Element::Kind::Cluster;
        out_.elements[index].first_child = first;
        out_.elements[index].child_count = std::uint16_t(parts.size());
        for (std::uint32_t k = 0; k < parts.size(); ++k) {
            out_.elements[first + k].parent = index;
            out_.elements[first + k].path = hash_combine(out_.elements[index].path, k + 1);
            build(first + k, parts[k]);
        }
        finish_cluster(index);
    }

    void finish_cluster(std::uint32_t index) {
        Element& e = out_.elements[index];
        e.harmonics = std::uint32_t(out_.harmonics.size());
        Harmonics h;
        Box3 box;
        for (std::uint32_t k = 0; k < e.child_count; ++k) {
            const Element& child = out_.elements[e.first_child + k];
            e.area += child.area;
            e.rho += child.rho * child.area;
            e.emitted += child.emitted * child.area;
            box.add(child.centre - vec3(child.radius));
            box.add(child.centre + vec3(child.radius));
            const Sh part = child.kind == Element::Kind::Patch ? sh_clamped_cosine(child.normal, child.area)
                                                               : out_.harmonics[child.harmonics].projected_area;
            for (std::size_t i = 0; i < kShCount; ++i) {
                h.projected_area[i] += part[i];
            }
        }
        e.rho /= e.area;
        e.emitted /= e.area;
        e.centre = box.centre();
        for (std::uint32_t k = 0; k < e.child_count; ++k) {
            const Element& child = out_.elements[e.first_child + k];
            e.radius = std::max(e.radius, glm::length(child.centre - e.centre) + child.radius);
        }
        e.radius = std::min(e.radius, 0.5F * box.diagonal());
        out_.harmonics.push_back(h);
    }

    void make_patch(std::uint32_t index, const Item& item) {
        Element& e = out_.elements[index];
        e.kind = Element::Kind::Patch;
        e.surface = item.face.surface;
        e.triangle = item.face.triangle;
        e.back = item.face.back;
        e.normal = item.face.normal;
        e.area = item.face.area;
        e.corner = rays_.triangle(e.surface, e.triangle);
        e.barycentric = {vec2(0, 0), vec2(1, 0), vec2(0, 1)};
        if (e.back) {
            std::swap(e.corner[1], e.corner[2]);
            std::swap(e.barycentric[1], e.barycentric[2]);
        }
        e.centre = item.centroid;
        for (const vec3& p : e.corner) {
            e.radius = std::max(e.radius, glm::length(p - e.centre));
        }
        const SurfaceColor color = average_color(rays_, e.surface, e.triangle, e.back, e.barycentric,
                                                 color_samples(rays_, e.surface, kPattern.size()));
        e.rho = color.rho;
        e.emitted = color.emitted;
        note_side(index, item.face);
    }

    void note_side(std::uint32_t index, const Face& face) {
        out_.top_of_side[out_.first_side[face.surface] + 2 * std::size_t(face.triangle) + (face.back ? 1 : 0)] = index;
    }

    void make_faces(std::uint32_t index, std::span<const Item> items) {
        Element& e = out_.elements[index];
        e.kind = Element::Kind::Faces;
        e.triangle = std::uint32_t(out_.faces.size());
        e.face_count = std::uint32_t(items.size());
        e.harmonics = std::uint32_t(out_.harmonics.size());
        Harmonics h;
        Box3 box;
        for (const Item& item : items) {
            const Face& face = item.face;
            out_.faces.push_back(face);
            note_side(index, face);
            for (const vec3& p : rays_.triangle(face.surface, face.triangle)) {
                box.add(p);
            }
            const Sh part = sh_clamped_cosine(face.normal, face.area);
            for (std::size_t i = 0; i < kShCount; ++i) {
                h.projected_area[i] += part[i];
            }
            const SurfaceColor color =
                average_color(rays_, face.surface, face.triangle, face.back, {vec2(0, 0), vec2(1, 0), vec2(0, 1)}, 1);
            e.area += face.area;
            e.rho += color.rho * face.area;
            e.emitted += color.emitted * face.area;
        }
        e.rho /= e.area;
        e.emitted /= e.area;
        e.centre = box.centre();
        e.radius = 0.5F * box.diagonal();
        out_.harmonics.push_back(h);
    }

    const RayScene& rays_;
    Hierarchy& out_;
};

} // namespace

std::size_t Hierarchy::memory_bytes() const {
    return elements.capacity() * sizeof(Element) + harmonics.capacity() * sizeof(Harmonics) +
           faces.capacity() * sizeof(Face) + top_of_side.capacity() * sizeof(std::uint32_t);
}

bool Hierarchy::can_split(std::uint32_t index) const {
    const Element& e = elements[index];
    if (e.kind != Element::Kind::Patch || !e.leaf()) {
        return false;
    }
    const float longest = std::max({glm::length(e.corner[1] - e.corner[0]), glm::length(e.corner[2] - e.corner[1]),
                                    glm::length(e.corner[0] - e.corner[2])});
    return longest > 2.0F * settings.smallest_patch;
}

void Hierarchy::split(std::uint32_t index, const RayScene& rays) {
    ATRIUM_CHECK(elements[index].kind == Element::Kind::Patch && elements[index].leaf());
    const auto first = std::uint32_t(elements.size());
    elements.resize(first + 4);
    Element& parent = elements[index];
    parent.first_child = first;
    parent.child_count = 4;
    const auto& p = parent.corner;
    const auto& b = parent.barycentric;
    const std::array<vec3, 3> mid{0.5F * (p[0] + p[1]), 0.5F * (p[1] + p[2]), 0.5F * (p[2] + p[0])};
    const std::array<vec2, 3> mid_b{0.5F * (b[0] + b[1]), 0.5F * (b[1] + b[2]), 0.5F * (b[2] + b[0])};
    const std::array<std::array<vec3, 3>, 4> corners{
        {{p[0], mid[0], mid[2]}, {mid[0], p[1], mid[1]}, {mid[2], mid[1], p[2]}, {mid[0], mid[1], mid[2]}}};
    const std::array<std::array<vec2, 3>, 4> barycentrics{{{b[0], mid_b[0], mid_b[2]},
                                                           {mid_b[0], b[1], mid_b[1]},
                                                           {mid_b[2], mid_b[1], b[2]},
                                                           {mid_b[0], mid_b[1], mid_b[2]}}};
    const std::size_t samples = color_samples(rays, parent.surface, kPattern.size());
    for (std::uint32_t k = 0; k < 4; ++k) {
        Element& child = elements[first + k];
        child = parent;
        child.parent = index;
        child.first_child = Element::kNone;
        child.child_count = 0;
        child.path = hash_combine(parent.path, k + 1);
        child.corner = corners[k];
        child.barycentric = barycentrics[k];
        child.area = 0.25F * parent.area;
        child.centre = (child.corner[0] + child.corner[1] + child.corner[2]) / 3.0F;
        child.radius = 0.0F;
        for (const vec3& q : child.corner) {
            child.radius = std::max(child.radius, glm::length(q - child.centre));
        }
        if (samples > 1) {
            const SurfaceColor color =
                average_color(rays, child.surface, child.triangle, child.back, child.barycentric, samples);
            child.rho = color.rho;
            child.emitted = color.emitted;
        }
    }
}

namespace {

// Positive inside the triangle, either way round; the larger the deeper.
float depth_inside(const std::array<vec2, 3>& t, const vec2& p) {
    const auto cross = [](const vec2& a, const vec2& b, const vec2& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    const float turn = cross(t[0], t[1], t[2]) < 0.0F ? -1.0F : 1.0F;
    return turn * (turn > 0.0F ? std::min({cross(t[0], t[1], p), cross(t[1], t[2], p), cross(t[2], t[0], p)})
                               : std::max({cross(t[0], t[1], p), cross(t[1], t[2], p), cross(t[2], t[0], p)}));
}

} // namespace

std::uint32_t Hierarchy::leaf_at(std::uint32_t surface, std::uint32_t triangle, bool back, const vec2& barycentric) const {
    std::uint32_t at = top_of_side[first_side[surface] + 2 * std::size_t(triangle) + (back ? 1 : 0)];
    while (at != Element::kNone && !elements[at].leaf()) {
        const Element& e = elements[at];
        float best = -std::numeric_limits<float>::infinity();
        for (std::uint32_t k = 0; k < e.child_count; ++k) {
            const float depth = depth_inside(elements[e.first_child + k].barycentric, barycentric);
            if (depth > best) {
                best = depth;
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
    const auto on_triangle = [&](const std::array<vec3, 3>& p) {
        // Square to triangle by folding keeps strata connected (Heitz 2019 is smoother; this is enough for visibility).
        vec2 v = u;
        if (v.x + v.y > 1.0F) {
            v = vec2(1.0F) - v;
        }
        // Pulled in a little, so that no sample lies on an edge shared with a neighbour.
        v = vec2(0.002F) + v * 0.994F;
        return p[0] + (p[1] - p[0]) * v.x + (p[2] - p[0]) * v.y;
    };
    if (e->kind == Element::Kind::Patch) {
        return {on_triangle(e->corner), e->normal};
    }
    float at = u.x * e->area;
    std::uint32_t chosen = e->triangle + e->face_count - 1;
    for (std::uint32_t f = e->triangle; f < e->triangle + e->face_count; ++f) {
        const float area = hierarchy.faces[f].area;
        if (at < area) {
            chosen = f;
            u.x = at / area;
            break;
        }
        at -= area;
    }
    const Face& face = hierarchy.faces[chosen];
    return {on_triangle(rays.triangle(face.surface, face.triangle)), face.normal};
}

Hierarchy build_hierarchy(const RayScene& rays, const HierarchySettings& settings) {
    Hierarchy out;
    out.settings = settings;
    Builder(rays, out).run();
    return out;
}

} // namespace atrium
