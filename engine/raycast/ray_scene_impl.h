// What a ray scene holds, and its answers to rays; for ray_scene.cpp and ray_scene_moves.cpp beside it and nobody else.
#pragma once

#include "engine/raycast/ray_scene.h"

#include "engine/base/checks.h"
#include "engine/geometry/mesh_topology.h"
#include "engine/geometry/repeated_triangles.h"
#include "engine/geometry/surface_charts.h"
#include "engine/geometry/tessellate.h"
#include "engine/optics/specular.h"
#include "engine/raycast/embree_triangles.h"
#include "engine/raycast/slabs.h"
#include "engine/scene/texture_sampling.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <map>
#include <thread>

namespace atrium {

inline constexpr int kMaxCrossings = 64; // panes and leaves in a row; beyond it the light is taken as absorbed

inline bool lets_light_through(const Material& m) {
    return m.transmission > 0.0F || m.alpha_mode != Material::Alpha::Opaque;
}

// Light goes straight on through the glass itself, without its holes. Diffuse materials that let some light through are thin
// cloth or paper, whatever their thickness.
inline bool glass_is_straight(const Material& m, const RaySurface& s) {
    return m.transmission > 0.0F && (classify(m) == MaterialKind::Diffuse || is_clear_sheet(m) || s.slab);
}

inline bool filters_light(const Material& m, const RaySurface& s) {
    return m.alpha_mode != Material::Alpha::Opaque || glass_is_straight(m, s);
}

// Glass that is nearly air: its focus is thousands of radii away, and what it turns light by is less than the sun's radius
// up to 87 degrees of incidence. Particles would only make noise of the light that it leaves alone. What is tinted by the
// way through it is followed all the same.
inline bool hardly_bends(const Material& m) { return std::abs(m.ior - 1.0F) <= 2e-4F && absorption(m, 1e3F) == Rgb(1.0F); }

// One crossing of a glass surface without bending. Thin: both faces with their inner reflections, (1-F)/(1+F). Slab: one
// face, and half of what its inside absorbs along the bent way. The angle within a slab counts as that outside.
inline Rgb glass_transmittance(const Material& m, const RaySurface& s, const Rgb& tint, float cos_i) {
    const float ior = std::max(m.ior, 1.0F);
    const float f = fresnel_dielectric(cos_i, ior);
    if (!s.slab) {
        return tint * ((m.thickness > 0.0F ? 1.0F - f : (1.0F - f) / (1.0F + f)) * m.transmitted_share());
    }
    const float cos_t = std::sqrt(std::max(1.0F - (1.0F - cos_i * cos_i) / (ior * ior), 1e-4F));
    return tint * absorption(m, 0.5F * s.slab_thickness / cos_t) * ((1.0F - f) * m.transmitted_share());
}

struct RayScene::Impl {
    struct alignas(64) Counter {
        std::atomic<std::uint64_t> value{0};
    };
    // A shown node with a shape; its surfaces are neighbours.
    struct Placed {
        NodeId node;
        std::shared_ptr<const MeshData> mesh;
        dmat4 to_engine{1.0};
        DBox3 world;       // Scene::world_bounds
        Geometry geometry; // of its shape, which may be gone when the node comes back
        std::uint32_t first_surface = 0;
        std::uint32_t surfaces = 0;
        std::optional<Node> absent; // hidden or removed since: what it was
    };
    // Whether a mesh is a solid whose insides stay dark is told by the first node that shows it, with its size.
    struct Inside {
        std::size_t placed = 0;
        std::shared_ptr<const MeshData> mesh;
        bool small = false;
    };
    struct Changes {
        std::vector<NodeId> nodes;       // placed anew themselves, whatever they are
        std::vector<std::size_t> placed; // they and what is below them, into `placed`
        std::vector<std::size_t> gone;   // hidden or removed, into `placed`
        std::vector<NodeId> added;       // to be appended
    };
    // What a node's new placement makes of it, before anything is changed.
    struct Replaced {
        std::size_t placed = 0;
        DBox3 world;
        dmat4 to_engine{1.0};
        std::vector<RaySurface> surfaces; // none: they stay as they are
        std::vector<Box3> bounds;
        std::optional<Node> absent;
    };

    // What was found out about meshes while they are collected; nodes share them.
    struct Known {
        std::map<const MeshData*, bool> closed;
        std::map<const MeshData*, RepeatedTriangles> repeated;
    };

    Scene scene;
    std::vector<RaySurface> surfaces;
    std::vector<const Material*> materials; // per surface, into `scene`
    std::vector<std::uint8_t> filters;      // per surface: some light goes straight on through it
    std::vector<Box3> surface_bounds;
    std::vector<Placed> placed;                                 // in tree order, then what was appended; by first_surface
    std::size_t built = 0;                                      // of `placed`, in tree order
    std::vector<std::unique_ptr<const Material>> old_materials; // of absent surfaces, where `scene` has them no more
    std::vector<Inside> insides;
    std::vector<Counter> counters = std::vector<Counter>(16);
    EmbreeTriangles embree;
    dvec3 origin{0.0};
    double extent = 0.0; // diagonal of the world bounds
    Box3 bounds;
    std::size_t triangles = 0;
    std::size_t dropped = 0;
    bool any_filter = false;
    bool twins = false; // triangles of some mesh lie in one place and face apart

    void count_ray() { count_rays(1); }
    void count_rays(std::size_t rays) {
        static std::atomic<unsigned> next{0};
        thread_local const unsigned slot = next.fetch_add(1) % 16;
        counters[slot].value.fetch_add(rays, std::memory_order_relaxed);
    }

    void collect(const RunContext& context) {
        const DBox3 world = scene.bounds();
        extent = world.diagonal();
        // floor(x + 0.5), not round(): halves go the same way on both sides of zero, so a moved scene gives the same
        // numbers.
        origin = world.empty() ? dvec3(0.0) : glm::floor(world.centre() + 0.5);
        Known known;
        std::map<std::pair<ShapeId, int>, std::shared_ptr<const MeshData>> tessellated;
        for (const NodeId id : scene.in_tree_order()) {
            const Node& node = *scene.nodes.find(id);
            const Shape* shape = scene.shapes.find(node.shape);
            if (shape == nullptr || !scene.shown(id)) {
                continue;
            }
            if (context.should_stop()) {
                return;
            }
            const int segments = curve_segments(node);
            auto& mesh = tessellated[{node.shape, segments}];
            if (!mesh) {
                mesh = tessellate(shape->geometry, {segments});
            }
            add_node(id, node, *shape, mesh, known, context);
        }
        any_filter = std::find(filters.begin(), filters.end(), 1) != filters.end();
        if (twins) {
            embree.tell_fronts();
        }
        built = placed.size();
    }

    // Lenses and curved mirrors need their shape closer than what is matt: light that they focus shows every facet.
    [[nodiscard]] int curve_segments(const Node& node) const {
        constexpr int kFocusing = 128;
        const bool focuses = std::any_of(node.materials.begin(), node.materials.end(), [&](MaterialId id) {
            const Material* m = scene.materials.find(id);
            return m != nullptr && is_specular(*m);
        });
        return focuses ? kFocusing : TessellationOptions{}.segments;
    }

    void add_node(NodeId id, const Node& node, const Shape& shape, const std::shared_ptr<const MeshData>& mesh, Known& known,
                  const RunContext& context) {
        Placed place{
            id, mesh, scene.world_matrix(id), scene.world_bounds(id), shape.geometry, std::uint32_t(surfaces.size()), 0, {}};
        place.to_engine[3] -= dvec4(origin, 0.0);
        const auto positions = positions_of(*mesh, place.to_engine);
        const auto [repeated, first_time] = known.repeated.try_emplace(mesh.get());
        if (first_time) {
            repeated->second = repeated_triangles(*mesh, context);
            twins = twins || repeated->second.twins;
        }
        if (context.should_stop()) {
            return;
        }
        std::shared_ptr<const std::vector<vec2>> domain;
        if (std::vector<vec2> coordinates = curved_domain(shape.geometry, *mesh); !coordinates.empty()) {
            domain = std::make_shared<const std::vector<vec2>>(std::move(coordinates));
        }
        for (std::size_t part = 0; part < mesh->parts.size(); ++part) {
            RaySurface surface;
            surface.node = id;
            surface.part = std::uint32_t(part);
            surface.material = part < node.materials.size() ? node.materials[part] : MaterialId{};
            surface.mesh = mesh;
            surface.domain = domain;
            surface.positions = positions;
            const Material* material = scene.materials.find(surface.material);
            material = material != nullptr ? material : &default_material();
            surface.repeated =
                repeated_of(repeated->second.parts[part], material->double_sided || lets_light_through(*material));
            Box3 box;
            dropped += place_surface(surface, place.to_engine, box, context);
            if (context.should_stop()) {
                return;
            }
            if (surface.triangles.empty()) {
                continue;
            }
            bounds.add(box);
            if (material->double_sided && !lets_light_through(*material)) {
                const auto [it, first] = known.closed.try_emplace(mesh.get(), false);
                if (first) {
                    // Solids' insides stay dark and cost nothing. Whatever is as large as a room may be one, seen from
                    // inside.
                    const bool small = is_small(place.world, extent);
                    it->second = small && is_solid(*mesh, context);
                    insides.push_back({placed.size(), mesh, small});
                }
                surface.back_side = !it->second;
            }
            find_glass(surface, *material, context);
            triangles += surface.triangles.size();
            materials.push_back(material);
            filters.push_back(filters_light(*material, surface) ? 1 : 0);
            surface_bounds.push_back(box);
            surfaces.push_back(std::move(surface));
            ++place.surfaces;
        }
        placed.push_back(std::move(place));
    }

    // Triangles of a part that stand for nothing of their own: doubles; with `both_sides` also turned twins, which say no
    // more than that the surface has two sides. Null where there are none.
    static std::shared_ptr<const std::vector<std::uint32_t>> repeated_of(const RepeatedTriangles::Part& repeated,
                                                                         bool both_sides) {
        std::vector<std::uint32_t> out = repeated.same;
        if (both_sides) {
            out.insert(out.end(), repeated.turned.begin(), repeated.turned.end());
            std::sort(out.begin(), out.end());
        }
        return out.empty() ? nullptr : std::make_shared<const std::vector<std::uint32_t>>(std::move(out));
    }

    static bool is_small(const DBox3& world, double extent) { return world.diagonal() < 0.25 * extent; }
    static bool is_solid(const MeshData& mesh, const RunContext& context) {
        return is_closed(mesh, context) && signed_volume(mesh) > 0.0;
    }

    static std::shared_ptr<const std::vector<vec3>> positions_of(const MeshData& mesh, const dmat4& to_engine) {
        auto positions = std::make_shared<std::vector<vec3>>(mesh.positions.size());
        for (std::size_t i = 0; i < positions->size(); ++i) {
            (*positions)[i] = vec3(dvec3(to_engine * dvec4(dvec3(mesh.positions[i]), 1.0)));
        }
        return positions;
    }

    // Everything that follows from the placement alone; positions are there. Returns how many triangles are left out.
    static std::size_t place_surface(RaySurface& surface, const dmat4& to_engine, Box3& box,
                                     const RunContext& context = {}) {
        StopCheck stop(context, kMeshStride);
        const double determinant = glm::determinant(dmat3(to_engine));
        surface.to_engine = to_engine;
        surface.mirrored = determinant < 0.0;
        surface.normal_matrix = determinant != 0.0 ? glm::transpose(glm::inverse(dmat3(to_engine))) : dmat3(1.0);
        surface.triangles.clear();
        std::size_t left_out = 0, next_repeated = 0;
        const MeshData& mesh = *surface.mesh;
        const MeshPart& range = mesh.parts[surface.part];
        for (std::uint32_t i = range.first_index; i + 2 < range.first_index + range.index_count && !stop(); i += 3) {
            if (surface.repeated && next_repeated < surface.repeated->size() &&
                (*surface.repeated)[next_repeated] == (i - range.first_index) / 3) {
                ++next_repeated;
                ++left_out;
                continue;
            }
            uvec3 t(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
            if (surface.mirrored) {
                std::swap(t.y, t.z);
            }
            const vec3& a = (*surface.positions)[t.x];
            const vec3& b = (*surface.positions)[t.y];
            const vec3& c = (*surface.positions)[t.z];
            const vec3 area = glm::cross(b - a, c - a);
            if (!is_finite(a) || !is_finite(b) || !is_finite(c) || !(glm::dot(area, area) > 0.0F)) {
                ++left_out;
                continue;
            }
            surface.triangles.push_back(t);
            box.add(a);
            box.add(b);
            box.add(c);
        }
        return left_out;
    }

    static void find_glass(RaySurface& surface, const Material& material, const RunContext& context = {}) {
        const bool clear_solid =
            classify(material) == MaterialKind::DielectricSolid && material.roughness < kMirrorRoughness;
        surface.slab_thickness = clear_solid ? slab_thickness(surface, context) : 0.0F;
        surface.slab = surface.slab_thickness > 0.0F || (clear_solid && hardly_bends(material));
        surface.pane = is_pane(surface, material);
    }

    // Walks the tree of `now` beside what was built. Nothing when more than placements differ.
    [[nodiscard]] std::optional<Changes> find_changes(const Scene& now, NewThings things) const;
    // Where a node stands in `placed`, as what it is now; nothing where it would have to be appended. `next`: of those in
    // tree order the first that may be it; `moved`: itself or with an ancestor.
    [[nodiscard]] std::optional<std::size_t> find_placed(const Scene& now, NodeId id, std::size_t next, bool moved,
                                                         NewThings things) const;
    [[nodiscard]] bool is_same(const Scene& now, std::size_t index, bool moved, NewThings things) const;
    [[nodiscard]] bool materials_fit(const Scene& now, std::size_t index) const;
    [[nodiscard]] bool only_came_or_went(const Scene& now) const;
    void take_materials(const Scene& now);
    void append(NodeId id, std::vector<MovedSurface>& out);
    // What is not shown any more is put where it does not matter, far below all else: so all that follows what moves follows
    // this too, and when it comes back nothing has to be built.
    [[nodiscard]] Replaced put_away(std::size_t index) const;
    // A node at its new place; nothing when its triangles are not the ones it had.
    [[nodiscard]] std::optional<Replaced> replace_node(const Scene& now, std::size_t index) const;
    // Scene::bounds() of the new placements, and with it `extent`. Nothing when it makes any back reflect or stop to do so.
    [[nodiscard]] std::optional<double> new_extent(const std::vector<Replaced>& replaced,
                                                   const std::vector<DBox3>& added) const;
    std::optional<std::vector<MovedSurface>> move_to(const Scene& now, NewThings things);
    Result<std::vector<MaterialId>> recolor(const Scene& now);
    [[nodiscard]] bool is_absent(std::uint32_t surface) const {
        const auto after = std::upper_bound(placed.begin(), placed.end(), surface,
                                            [](std::uint32_t s, const Placed& p) { return s < p.first_surface; });
        return after != placed.begin() && std::prev(after)->absent.has_value();
    }

    void take_over(const Scene& now, const Changes& changes);
    std::vector<MovedSurface> take_over(std::vector<Replaced> replaced);
    void finish_move(std::span<const MovedSurface> moved, double extent_now);
    static bool is_pane(const RaySurface& surface, const Material& material) {
        constexpr std::size_t kMostTriangles = 32; // more is a curved or ornate thing, not a window
        constexpr float kLeastArea = 0.1F;         // square metres
        if (!(is_clear_sheet(material) || surface.slab) || surface.triangles.size() > kMostTriangles) {
            return false;
        }
        float area = 0.0F;
        for (const uvec3& t : surface.triangles) {
            const auto& p = *surface.positions;
            area += 0.5F * glm::length(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]));
        }
        return area >= kLeastArea;
    }

    bool blocked(const vec3& from, const vec3& direction, float tnear, float tfar) {
        count_ray();
        return embree.blocked(from, direction, tnear, tfar);
    }

    // Holes of cut-outs are passed through.
    Hit nearest(const RayScene& self, const Ray& ray, bool before) {
        float tnear = 0.0F;
        for (int crossing = 0; crossing < kMaxCrossings; ++crossing) {
            const Hit h = before ? hit_before(ray.origin, ray.direction, tnear, ray.tmax)
                                 : hit(false, ray.origin, ray.direction, tnear, ray.tmax);
            if (!h) {
                return h;
            }
            const Material& m = *materials[h.surface];
            if (m.alpha_mode != Material::Alpha::Mask ||
                self.base_color(h.surface, h.triangle, h.barycentric).a >= m.alpha_cutoff) {
                const bool dark_back = twins && !h.front && !surfaces[h.surface].back_side && filters[h.surface] == 0;
                return dark_back ? front_instead(h, ray, tnear, before) : h;
            }
            tnear = h.t + std::max(1e-5F, 1e-6F * h.t);
        }
        return {};
    }

    // Where two surfaces lie in one place and face apart, as in models that have each triangle a second time, turned round,
    // so as to be seen from both sides, a ray meets the one that faces it; which of them it would meet first is chance.
    Hit front_instead(const Hit& back, const Ray& ray, float tnear, bool before) {
        constexpr float kRounding = 1e-6F; // of distances
        const float cosine = std::max(glm::dot(back.geometric_normal, ray.direction), 0.05F);
        const float slack = kRounding * (back.t + max_component(glm::abs(ray.origin))) / cosine;
        count_ray();
        const TriangleHit met = embree.nearest_front(before, ray.origin, ray.direction, std::max(tnear, back.t - slack),
                                                     std::min(ray.tmax, back.t + slack));
        return met.surface == Hit::kNone ? back : as_hit(met, ray.direction, before);
    }

    Hit hit_before(const vec3& from, const vec3& direction, float tnear, float tfar) {
        count_ray();
        return as_hit(embree.nearest_before(from, direction, tnear, tfar), direction, true);
    }

    Hit hit(bool only_filters, const vec3& from, const vec3& direction, float tnear, float tfar) {
        count_ray();
        return as_hit(embree.nearest(only_filters, from, direction, tnear, tfar), direction);
    }

    // Surfaces may have moved since `before`: their positions then tell nothing of the normal.
    [[nodiscard]] Hit as_hit(const TriangleHit& met, const vec3& direction, bool before = false) const {
        Hit out;
        if (met.surface == Hit::kNone) {
            return out;
        }
        out.surface = met.surface;
        out.triangle = met.triangle;
        out.t = met.t;
        out.barycentric = met.barycentric;
        const uvec3& t = surfaces[out.surface].triangles[out.triangle];
        const std::vector<vec3>& p = *surfaces[out.surface].positions;
        out.geometric_normal = glm::normalize(before ? met.normal : glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]));
        out.front = glm::dot(out.geometric_normal, direction) < 0.0F;
        return out;
    }

    // What a filtering surface lets through at a hit, straight on.
    Rgb filter(const RayScene& self, const Hit& h, const vec3& direction) const {
        const Material& m = *materials[h.surface];
        const vec4 color = self.base_color(h.surface, h.triangle, h.barycentric);
        Rgb through(0.0F);
        if (glass_is_straight(m, surfaces[h.surface])) {
            const float cosine = std::abs(glm::dot(h.geometric_normal, direction));
            through = glass_transmittance(m, surfaces[h.surface], Rgb(color), cosine);
        }
        if (m.alpha_mode == Material::Alpha::Mask) {
            return color.a < m.alpha_cutoff ? Rgb(1.0F) : through;
        }
        if (m.alpha_mode == Material::Alpha::Blend) {
            return through * color.a + Rgb(1.0F - color.a);
        }
        return through;
    }

    Rgb transmit(const RayScene& self, const vec3& from, const vec3& direction, float tnear, float tfar) {
        if (blocked(from, direction, tnear, tfar)) {
            return Rgb(0.0F);
        }
        return cross_filters(self, from, direction, tnear, tfar).through;
    }

    // What filtering surfaces leave of the light on a way that nothing opaque blocks.
    SkyRay cross_filters(const RayScene& self, const vec3& from, const vec3& direction, float tnear, float tfar) {
        SkyRay out{Rgb(1.0F)};
        for (int crossing = 0; any_filter && crossing < kMaxCrossings; ++crossing) {
            const Hit h = hit(true, from, direction, tnear, tfar);
            if (!h) {
                return out;
            }
            if (surfaces[h.surface].pane) {
                out.first_pane = std::min(out.first_pane, h.t);
            }
            out.through *= filter(self, h, direction);
            if (max_component(out.through) <= 1e-4F) {
                return {};
            }
            tnear = h.t + std::max(1e-5F, 1e-6F * h.t);
        }
        return any_filter ? SkyRay{} : out;
    }

    // The same for the directions (at most 8) whose bit is not set in `blocked`; the others see nothing.
    void cross_filters_of_8(const RayScene& self, const vec3& from, std::span<const vec3> directions, unsigned blocked,
                            float tnear, std::span<SkyRay> out) {
        unsigned going = ~blocked & ((1U << directions.size()) - 1U);
        std::array<float, 8> start;
        std::array<TriangleHit, 8> hits;
        start.fill(tnear);
        for (std::size_t k = 0; k < directions.size(); ++k) {
            out[k] = (going >> k & 1U) != 0 ? SkyRay{Rgb(1.0F)} : SkyRay{};
        }
        for (int crossing = 0; any_filter && going != 0 && crossing < kMaxCrossings; ++crossing) {
            count_rays(std::size_t(std::popcount(going)));
            embree.nearest_filters_of_8(from, directions, start, going, hits);
            for (std::size_t k = 0; k < directions.size(); ++k) {
                const unsigned bit = 1U << k;
                if ((going & bit) == 0) {
                    continue;
                }
                const Hit h = as_hit(hits[k], directions[k]);
                if (!h) {
                    going &= ~bit;
                    continue;
                }
                if (surfaces[h.surface].pane) {
                    out[k].first_pane = std::min(out[k].first_pane, h.t);
                }
                out[k].through *= filter(self, h, directions[k]);
                if (max_component(out[k].through) <= 1e-4F) {
                    out[k] = {};
                    going &= ~bit;
                }
                start[k] = h.t + std::max(1e-5F, 1e-6F * h.t);
            }
        }
        for (std::size_t k = 0; any_filter && k < directions.size(); ++k) {
            out[k] = (going >> k & 1U) != 0 ? SkyRay{} : out[k];
        }
    }

    template <class V>
    V interpolate(const std::vector<V>& values, std::uint32_t surface, std::uint32_t triangle, const vec2& b) const {
        const uvec3& t = surfaces[surface].triangles[triangle];
        return values[t.x] * (1.0F - b.x - b.y) + values[t.y] * b.x + values[t.z] * b.y;
    }
    vec4 textured(const TextureRef& ref, std::uint32_t surface, std::uint32_t triangle, const vec2& b) const {
        const Texture* texture = scene.textures.find(ref.texture);
        const MeshData& mesh = *surfaces[surface].mesh;
        const std::vector<vec2>& coordinates = ref.texcoord == 1 ? mesh.texcoords1 : mesh.texcoords0;
        if (texture == nullptr || coordinates.empty()) {
            return vec4(1.0F);
        }
        return sample_texture(*texture, ref.apply(interpolate(coordinates, surface, triangle, b)));
    }
};

} // namespace atrium
