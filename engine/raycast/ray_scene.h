// Rays against the scene's triangles. Embree is used by ray_scene.cpp (embree_triangles.h) and nowhere else.
#pragma once

#include "engine/base/result.h"
#include "engine/base/run_context.h"
#include "engine/base/units.h"
#include "engine/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace atrium {

/// One shown (node, part) as triangles in engine coordinates (world minus the scene's origin, float).
struct RaySurface {
    NodeId node;
    std::uint32_t part = 0;
    MaterialId material;                                ///< none = default material
    std::shared_ptr<const MeshData> mesh;               ///< local coordinates
    std::shared_ptr<const std::vector<vec3>> positions; ///< mesh->positions in engine coordinates, shared by parts
    std::shared_ptr<const std::vector<vec2>> domain;    ///< curved primitives: see curved_domain(); else null
    /// Vertex indices, counter-clockwise from the front. Left out are degenerate triangles, doubles of earlier ones and,
    /// where both sides count anyway, what is an earlier one turned round.
    std::vector<uvec3> triangles;
    std::shared_ptr<const std::vector<std::uint32_t>> repeated; ///< numbers of those doubles in the part; null: none
    bool pane =
        false; ///< a sheet or slab of clear glass large enough to be a window: the sky is looked for through it by name
    bool slab =
        false; ///< solid clear glass that bounds flat panes, or hardly bends: light goes straight on, as over a sheet
    float slab_thickness = 0.0F; ///< of flat panes, metres; else 0
    bool back_side = false;      ///< the back reflects: double-sided material on a mesh that bounds no solid
    dmat4 to_engine{1.0};        ///< local to engine coordinates
    dmat3 normal_matrix{1.0};    ///< inverse transpose of its linear part
    bool mirrored = false;       ///< negative determinant: winding (and so the front side) is flipped back
};

struct Ray {
    vec3 origin{0.0F};
    vec3 direction{0.0F, 0.0F, 1.0F}; ///< unit
    float tmax = std::numeric_limits<float>::infinity();
};

/// Nearest intersection.
struct Hit {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    std::uint32_t surface = kNone; ///< index into RayScene::surfaces()
    std::uint32_t triangle = 0;    ///< within the surface
    float t = 0.0F;
    vec2 barycentric{0.0F};      ///< weights of the triangle's vertices 1 and 2
    vec3 geometric_normal{0.0F}; ///< unit, on the surface's front side
    bool front = true;           ///< the ray met the front side
    explicit operator bool() const { return surface != kNone; }
};

/// Ends of a visibility segment are pulled in by this, metres: below any wall's thickness, above float rounding at 100 m. In
/// larger models it grows with the distance from the origin as rounding does, or surfaces would shade themselves.
float shadow_offset(const vec3& p);

/// What a ray without end meets.
struct SkyRay {
    Rgb through{0.0F}; ///< share of light that arrives: see RayScene::transmittance()
    /// Distance of the first pane crossed, metres; infinite where none is or nothing arrives.
    float first_pane = std::numeric_limits<float>::infinity();
};

/// A surface that RayScene::move_to() placed anew, and where it was: engine coordinates.
struct MovedSurface {
    std::uint32_t surface = 0; ///< index into RayScene::surfaces()
    Box3 before;
    Box3 after;
    bool came_or_went = false; ///< hidden or removed, or shown again: one of the two is where it does not matter
    bool absent = false;       ///< see RayScene::absent(): `after` does not matter
    bool added = false;        ///< it is new, behind all surfaces that were there; `before` is empty
    [[nodiscard]] bool shown_before() const { return came_or_went == absent; }
};

/// What RayScene::move_to() does about things that were not there.
enum class NewThings : std::uint8_t { Refuse, Append };

/// Immutable but for move_to() and recolor(); every query is safe from any thread. Coordinates are engine coordinates: see
/// origin().
class RayScene {
public:
    /// Builds from the shown nodes of `scene`, of which it keeps its own copy. Degenerate, non-finite and repeated triangles
    /// are left out and counted. When stopped, it is incomplete and must not be asked anything.
    explicit RayScene(const Scene& scene, const RunContext& context = {});
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Takes over the placements of nodes (and only these) from `scene`, while no query runs; the origin stays. What is not
    /// shown any more is put far below the scene until it is again: see absent(). Returns the surfaces that moved.
    /// References to this and to surfaces() stay valid; `positions` of what moved are new ones. Nothing is returned, and all
    /// is left as it was, when placing nodes anew does not lead to what would be built from `scene`: nodes that were not
    /// there, another order, other shapes, materials or textures, triangles that vanish or come back, another winding, other
    /// reflecting backs. Names, lights, cameras, environment and settings are not looked at.
    /// With NewThings::Append nodes that were not there, or with another shape, materials or place in the tree, are put
    /// behind all others, and so is what was stretched, whose old surfaces go; materials and textures may be more or fewer.
    /// Surfaces are then no longer in tree order; rays see what they would in a scene that is built anew.
    [[nodiscard]] std::optional<std::vector<MovedSurface>> move_to(const Scene& scene, NewThings things = NewThings::Refuse);
    /// Takes over from `scene` the base colours of matt, opaque materials and what materials emit, while no query runs.
    /// Returns the materials whose colour or emission changed. An error that says why, and all is left as it was, where they
    /// differ in anything else that light depends on. Which emit at all is not looked at.
    [[nodiscard]] Result<std::vector<MaterialId>> recolor(const Scene& scene);
    /// Makes rays as fast as in a scene that is built anew, where moves left them a little slower: takes most of the time of
    /// building, and the next move of anything is a first one again. Answers stay; no query may run.
    void settle();
    /// Makes ready for looking back at how all stood before the moves since the scene was built or settled; call it after
    /// moves, while no query runs. False where that is no longer known, after very much was moved.
    [[nodiscard]] bool look_back();

    [[nodiscard]] const std::vector<RaySurface>& surfaces() const;
    /// True for what move_to() put away: not part of bounds(), and of no effect on what is shown.
    [[nodiscard]] bool absent(std::uint32_t surface) const;
    /// World position of engine (0,0,0): the centre of the scene's bounds, rounded to whole metres.
    [[nodiscard]] dvec3 origin() const;
    [[nodiscard]] Box3 bounds() const; ///< engine coordinates
    [[nodiscard]] std::size_t triangle_count() const;
    [[nodiscard]] std::size_t dropped_triangles() const;
    [[nodiscard]] std::size_t memory_bytes() const;  ///< of Embree's structures, as Embree reports them
    [[nodiscard]] std::uint64_t rays_traced() const; ///< so far, all queries

    /// Nearest hit of surfaces that a mirror, lens or camera ray can meet (alpha cut-outs are passed through). Of opaque
    /// surfaces in one place the one that faces the ray.
    [[nodiscard]] Hit nearest(const Ray& ray) const;
    /// The ray meets something that moved, where it is now or (after look_back()) where it stood: what it sees may have
    /// changed. Far cheaper than nearest().
    [[nodiscard]] bool meets_moved(const Ray& ray) const;
    /// Something opaque that has not moved since the scene was built lies on the ray; a little at its start does not count.
    [[nodiscard]] bool still_blocks(const Ray& ray) const;
    /// nearest() as it was before the moves; needs look_back(). The hit's normal is that of before; the positions and
    /// normals that this gives for hits are always those of now.
    [[nodiscard]] Hit nearest_before(const Ray& ray) const;
    /// True when anything opaque lies strictly between two points (cut-outs pass, glass passes). Both ends are pulled in by
    /// a length proportional to the rounding error there, so that the surfaces they lie on do not count.
    [[nodiscard]] bool occluded(const vec3& from, const vec3& to) const;
    /// Share of light that goes straight from one point to the other: 0 behind opaque surfaces, 1 in the open, else the
    /// product of the transmittances of the glass panes crossed. Glass that bends or scatters light (solids but slabs,
    /// frosted glass) counts as opaque: what it sends on is engine/optics' business.
    [[nodiscard]] Rgb transmittance(const vec3& from, const vec3& to) const;
    /// The same along a ray that never ends (sun, sky).
    [[nodiscard]] Rgb transmittance_to_infinity(const vec3& from, const vec3& direction) const;
    /// The same for many directions from one point, with the first pane that each crosses: one SkyRay for each direction.
    void look_at_sky(const vec3& from, std::span<const vec3> directions, std::span<SkyRay> out) const;

    /// The same along a ray from its very origin to tmax; nothing is pulled in, so the caller keeps clear of the surfaces
    /// that the ends lie on.
    [[nodiscard]] Rgb transmittance(const Ray& ray) const;
    /// Share of light that goes straight on through the surface of a hit (0 where it is opaque): clear sheets and slabs,
    /// each face by itself, thin materials that are mostly diffuse, holes, blending.
    [[nodiscard]] Rgb straight_through(const Hit& hit, const vec3& direction) const;

    /// Material of a surface; the default material where it has none.
    [[nodiscard]] const Material& material(std::uint32_t surface) const;
    /// Base colour of the material at texture coordinates of a surface's point (linear, alpha in w), texture and vertex
    /// colours applied; `barycentric` as in Hit.
    [[nodiscard]] vec4 base_color(std::uint32_t surface, std::uint32_t triangle, const vec2& barycentric) const;
    /// Emitted radiance at that point, emissive texture applied, cd/m2.
    [[nodiscard]] Rgb emission(std::uint32_t surface, std::uint32_t triangle, const vec2& barycentric) const;

    /// Vertices of a triangle in engine coordinates, counter-clockwise seen from the front side.
    [[nodiscard]] std::array<vec3, 3> triangle(std::uint32_t surface, std::uint32_t triangle) const;
    /// Interpolated shading normal in engine coordinates, on the front side, unit.
    [[nodiscard]] vec3 shading_normal(const Hit& hit) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace atrium
