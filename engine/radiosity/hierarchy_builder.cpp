// Makes the hierarchy of a scene: sheets, groups of small triangles, and the clusters above them.
#include "engine/base/parallel.h"
#include "engine/base/rng.h"
#include "engine/geometry/planar_regions.h"
#include "engine/radiosity/patch_cells.h"

#include <algorithm>
#include <numeric>

namespace atrium {
namespace {

// Below the distance by which visibility rays are pulled in: points of a sheet and of its triangles are the same to them.
constexpr float kSheetFlatness = 1e-4F;
constexpr float kOneSided = 0.7F; // |sum of area vectors| / area from which a group's normals belong together

class Builder {
public:
    /// Of the surfaces from `first_surface` on, as a tree of its own in `out`.
    Builder(const RayScene& rays, Hierarchy& out, const RunContext& context, std::uint32_t first_surface = 0)
        : rays_(rays), out_(out), context_(context), stop_(context, kMeshStride), first_(first_surface) {}

    void run() {
        divide_surfaces();
        if (context_.should_stop()) {
            return;
        }
        if (items_[0].empty() && items_[1].empty() && small_[0].empty() && small_[1].empty()) {
            return;
        }
        for (const std::size_t emits : {1U, 0U}) {
            group(small_[emits], items_[emits]);
        }
        if (context_.should_stop()) {
            return;
        }
        const auto root = std::uint32_t(out_.elements.size());
        const std::uint64_t path = hash64(out_.settings.seed);
        out_.elements.emplace_back();
        out_.elements[root].path = first_ == 0 ? path : hash_combine(path, first_);
        std::vector<std::span<Item>> parts;
        for (const std::size_t emits : {1U, 0U}) {
            if (!items_[emits].empty()) {
                parts.emplace_back(items_[emits]);
            }
        }
        make_children(root, parts);
    }

private:
    /// What becomes a leaf of the cluster tree: one side of a sheet, or a range of faces.
    struct Item {
        vec3 centroid{0.0F};
        float extent = 0.0F;
        std::uint32_t sheet = Element::kNone;
        bool back = false;
        std::uint32_t first = 0; ///< face, where there is no sheet
        std::uint32_t count = 0;
    };
    /// A face on its way into a group.
    struct Small {
        vec3 centroid;
        std::uint32_t face; ///< into loose_
    };

    // Planar pieces of a surface that are large enough become sheets, the other triangles loose faces.
    void divide_surfaces() {
        const auto& surfaces = rays_.surfaces();
        std::vector<PlanarRegions> pieces(surfaces.size() - first_);
        parallel_chunks(pieces.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end && !context_.should_stop(); ++i) {
                const RaySurface& surface = surfaces[first_ + i];
                pieces[i] = planar_regions(*surface.positions, surface.triangles, {kSheetFlatness}, context_);
            }
        });
        if (context_.should_stop()) {
            return;
        }
        std::size_t triangles = out_.on_sheet.size();
        for (std::size_t s = first_; s < surfaces.size(); ++s) {
            out_.first_triangle.push_back(triangles);
            triangles += surfaces[s].triangles.size();
        }
        out_.on_sheet.resize(triangles, Element::kNone);
        out_.top.resize(triangles, {Element::kNone, Element::kNone});
        for (std::uint32_t s = first_; s < surfaces.size(); ++s) {
            PlanarRegions& planar = pieces[s - first_];
            for (const PlanarRegion& region : planar.regions) {
                if (stop_()) {
                    return;
                }
                add_sheet(s, region, std::span(planar.members).subspan(region.first, region.count));
            }
            for (std::uint32_t t = 0; t < surfaces[s].triangles.size() && !stop_(); ++t) {
                if (out_.on_sheet[out_.first_triangle[s] + t] == Element::kNone) {
                    add_face(s, t, false);
                    if (surfaces[s].back_side) {
                        add_face(s, t, true);
                    }
                }
            }
            planar = {};
        }
    }

    void add_sheet(std::uint32_t s, const PlanarRegion& region, std::span<const std::uint32_t> members) {
        Sheet sheet;
        sheet.surface = s;
        sheet.normal = vec3(region.normal);
        sheet.axis_u = region.axis;
        sheet.axis_v = glm::cross(sheet.normal, sheet.axis_u);
        const vec3 centre(region.centroid);
        vec2 low(std::numeric_limits<float>::infinity()), high(-std::numeric_limits<float>::infinity());
        const auto flat = [&](const vec3& p) {
            return vec2(glm::dot(p - centre, sheet.axis_u), glm::dot(p - centre, sheet.axis_v));
        };
        for (const std::uint32_t t : members) {
            for (const vec3& p : rays_.triangle(s, t)) {
                low = glm::min(low, flat(p));
                high = glm::max(high, flat(p));
            }
        }
        const vec2 size = high - low;
        if (std::max(size.x, size.y) <= out_.settings.group_size || !(std::min(size.x, size.y) > 0.0F)) {
            return;
        }
        sheet.origin = centre + sheet.axis_u * low.x + sheet.axis_v * low.y;
        sheet.first = std::uint32_t(out_.sheet_triangles.size());
        sheet.count = std::uint32_t(members.size());
        sheet.varies = color_varies(rays_, s);
        for (const std::uint32_t t : members) {
            SheetTriangle triangle;
            triangle.triangle = t;
            const auto p = rays_.triangle(s, t);
            for (std::size_t k = 0; k < 3; ++k) {
                triangle.uv[k] = flat(p[k]) - low;
            }
            out_.on_sheet[out_.first_triangle[s] + t] = std::uint32_t(out_.sheet_triangles.size());
            out_.sheet_triangles.push_back(triangle);
        }
        Item item;
        item.centroid = centre;
        item.extent = std::max(size.x, size.y);
        item.sheet = std::uint32_t(out_.sheets.size());
        out_.sheets.push_back(sheet);
        std::vector<Item>& items = items_[rays_.material(s).emits() ? 1 : 0];
        items.push_back(item);
        if (rays_.surfaces()[s].back_side) {
            item.back = true;
            items.push_back(item);
        }
    }

    void add_face(std::uint32_t s, std::uint32_t t, bool back) {
        const auto p = rays_.triangle(s, t);
        const vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
        const float length = glm::length(cross);
        Face face;
        face.surface = s;
        face.triangle = t;
        face.back = back;
        face.area = 0.5F * length;
        face.normal = cross / length * (back ? -1.0F : 1.0F);
        small_[rays_.material(s).emits() ? 1 : 0].push_back({(p[0] + p[1] + p[2]) / 3.0F, std::uint32_t(loose_.size())});
        loose_.push_back(face);
    }

    // Halves the set until what is left is no larger than the group size; then by normals, see finish_group().
    void group(std::span<Small> set, std::vector<Item>& items) {
        if (set.empty() || context_.should_stop()) {
            return;
        }
        Box3 box;
        for (const Small& small : set) {
            box.add(small.centroid);
        }
        const vec3 size = box.size();
        if (max_component(size) <= out_.settings.group_size) {
            finish_group(set, max_component(size), 0, items);
            return;
        }
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const float middle = box.centre()[axis];
        const auto split =
            std::partition(set.begin(), set.end(), [&](const Small& small) { return small.centroid[axis] < middle; });
        const auto at = std::size_t(split - set.begin());
        group(set.first(at), items);
        group(set.subspan(at), items);
    }

    // The two sides of a thin thing see different light and must not share one radiosity; crumbs may.
    void finish_group(std::span<Small> set, float extent, int depth, std::vector<Item>& items) {
        if (extent > 0.5F * out_.settings.group_size && depth < 4 && set.size() > 1) {
            vec3 sum(0.0F);
            float area = 0.0F;
            const Face* largest = &loose_[set[0].face];
            for (const Small& small : set) {
                const Face& face = loose_[small.face];
                sum += face.normal * face.area;
                area += face.area;
                largest = face.area > largest->area ? &face : largest;
            }
            if (glm::length(sum) < kOneSided * area) {
                for (const float limit : {0.0F, kOneSided}) {
                    const auto split = std::partition(set.begin(), set.end(), [&](const Small& small) {
                        return glm::dot(loose_[small.face].normal, largest->normal) > limit;
                    });
                    if (split != set.end()) {
                        const auto at = std::size_t(split - set.begin());
                        finish_group(set.first(at), extent, depth + 1, items);
                        finish_group(set.subspan(at), extent, depth + 1, items);
                        return;
                    }
                }
            }
        }
        Item item;
        item.first = std::uint32_t(out_.faces.size());
        item.count = std::uint32_t(set.size());
        Box3 box;
        double area = 0.0;
        for (const Small& small : set) {
            Face face = loose_[small.face];
            area += double(face.area);
            face.upto = float(area);
            out_.faces.push_back(face);
            for (const vec3& p : rays_.triangle(face.surface, face.triangle)) {
                box.add(p);
            }
        }
        item.centroid = box.centre();
        item.extent = max_component(box.size());
        items.push_back(item);
    }

    // Fills element `index` (already in the array) from its items.
    void build(std::uint32_t index, std::span<Item> items) {
        if (items.size() == 1) {
            make_leaf(index, items[0]);
            return;
        }
        Box3 centroids;
        for (const Item& item : items) {
            centroids.add(item.centroid);
        }
        const vec3 size = centroids.size();
        // One long piece would make a whole branch look as large as itself: the long ones get a branch of their own.
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

    void make_leaf(std::uint32_t index, const Item& item) {
        if (item.sheet == Element::kNone) {
            make_faces(index, item);
            return;
        }
        make_sheet_patch(out_, rays_, index, item.sheet, item.back);
        const Sheet& sheet = out_.sheets[item.sheet];
        for (std::uint32_t i = 0; i < sheet.count; ++i) {
            const std::size_t triangle = out_.first_triangle[sheet.surface] + out_.sheet_triangles[sheet.first + i].triangle;
            out_.top[triangle][item.back ? 1 : 0] = index;
        }
    }

    void make_faces(std::uint32_t index, const Item& item) {
        Element& e = out_.elements[index];
        e.kind = Element::Kind::Faces;
        e.triangle = item.first;
        e.face_count = item.count;
        e.harmonics = std::uint32_t(out_.harmonics.size());
        Harmonics h;
        Box3 box;
        for (std::uint32_t f = item.first; f < item.first + item.count; ++f) {
            const Face& face = out_.faces[f];
            out_.top[out_.first_triangle[face.surface] + face.triangle][face.back ? 1 : 0] = index;
            for (const vec3& p : rays_.triangle(face.surface, face.triangle)) {
                box.add(p);
            }
            const Sh part = sh_clamped_cosine(face.normal, face.area);
            for (std::size_t i = 0; i < kShCount; ++i) {
                h.projected_area[i] += part[i];
            }
        }
        e.area = out_.faces[item.first + item.count - 1].upto;
        const SurfaceColor color = mean_color(out_, rays_, e);
        e.rho = color.rho;
        e.emitted = color.emitted;
        e.centre = box.centre();
        e.radius = 0.5F * box.diagonal();
        out_.harmonics.push_back(h);
    }

    const RayScene& rays_;
    Hierarchy& out_;
    const RunContext& context_;
    StopCheck stop_;
    std::uint32_t first_; ///< surface
    std::vector<Face> loose_;
    std::array<std::vector<Small>, 2> small_; ///< [1]: of what emits
    std::array<std::vector<Item>, 2> items_;
};

} // namespace

Hierarchy build_hierarchy(const RayScene& rays, const HierarchySettings& settings, const RunContext& context) {
    Hierarchy out;
    out.settings = settings;
    Builder(rays, out, context).run();
    return out;
}

void append_to_hierarchy(Hierarchy& h, const RayScene& rays, std::uint32_t first_surface, const HierarchySettings& sizes) {
    const HierarchySettings before = h.settings;
    h.settings.smallest_patch = sizes.smallest_patch;
    h.settings.group_size = sizes.group_size;
    h.first_appended = std::min(h.first_appended, std::uint32_t(h.elements.size()));
    const RunContext unstopped;
    Builder(rays, h, unstopped, first_surface).run();
    h.settings = before;
    if (!h.room.empty()) {
        h.room.resize(h.elements.size(), Element::kNone);
    }
}

} // namespace atrium
