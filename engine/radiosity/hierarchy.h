// The element hierarchy: clusters down to surfaces, quadtrees over whatever lies in one plane. One array, children
// contiguous.
#pragma once

#include "engine/radiosity/spherical_harmonics.h"
#include "engine/raycast/ray_scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace atrium {

/// A triangle side of the ray scene as a member of a Faces element.
struct Face {
    std::uint32_t surface = 0;
    std::uint32_t triangle = 0;
    bool back = false;
    float area = 0.0F;
    float upto = 0.0F; ///< sum of the areas of its element's faces up to and including this one
    vec3 normal{0.0F}; ///< of the side, unit
};

/// One element. Radiosity B and exitance M in lumen per square metre (radiance times pi), irradiance E in lux.
struct Element {
    enum class Kind : std::uint8_t {
        Cluster, ///< inner node over other elements; emits and receives by spherical harmonics
        Faces,   ///< small triangles, any number, that share one radiosity; leaf; spherical harmonics
        Patch    ///< a cell of a sheet's quadtree; has a plane; leaf or up to four parts
    };
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    Kind kind = Kind::Cluster;
    bool back = false; ///< Patch: the back side of its sheet
    std::uint16_t child_count = 0;
    std::uint32_t parent = kNone;
    std::uint32_t first_child = kNone;
    std::uint32_t harmonics = kNone; ///< index into Hierarchy::harmonics; Cluster and Faces only
    std::uint32_t patch = kNone;     ///< Patch: index into Hierarchy::patches
    std::uint32_t surface = kNone;   ///< Patch
    std::uint32_t triangle = 0;      ///< Faces: first face in Hierarchy::faces
    std::uint32_t face_count = 0;    ///< Faces
    std::uint64_t path = 0;          ///< hash of the way from the root: seeds every random stream of this element
    vec3 centre{0.0F};               ///< Patch: centroid of what it covers
    float radius = 0.0F;             ///< of a ball about centre that holds everything below
    float area = 0.0F;               ///< of the surface, holes left out, square metres
    vec3 normal{0.0F};               ///< Patch
    Rgb rho{0.0F};                   ///< mean reflectance
    Rgb emitted{0.0F};               ///< mean exitance M
    Rgb direct{0.0F};                ///< mean irradiance of sun, sky, lamps and named
                                     ///< emitters, see light_split.h (leaves)
    Rgb caustic{0.0F};               ///< mean irradiance of named light that came over mirrors and glass (leaves)
    Rgb irradiance{0.0F};            ///< mean irradiance E from the other elements
    Rgb radiosity{0.0F};             ///< mean B
    float spread = 0.0F;             ///< largest deviation of luminance(B) of a Patch below from this one's
    float power = 0.0F;              ///< area * luminance(B): weight for picking sample points

    [[nodiscard]] bool leaf() const { return child_count == 0; }
    /// What it sends before any light has gone round: M + rho * (direct + caustic).
    [[nodiscard]] Rgb first_radiosity() const { return emitted + rho * (direct + caustic); }
};

/// A planar piece of a surface with coordinates of its own, metres from the corner of its rectangle: the ground of a
/// quadtree.
struct Sheet {
    std::uint32_t surface = 0;
    std::uint32_t first = 0; ///< into Hierarchy::sheet_triangles
    std::uint32_t count = 0;
    vec3 origin{0.0F};
    vec3 axis_u{0.0F}; ///< unit; axis_u x axis_v = normal
    vec3 axis_v{0.0F};
    vec3 normal{0.0F};   ///< of the front side
    bool varies = false; ///< reflectance or emission are not the same all over
};
struct SheetTriangle {
    std::uint32_t triangle = 0; ///< within the surface
    std::array<vec2, 3> uv;     ///< coordinates on the sheet
};

/// Where a Patch lies on its sheet and what it covers there.
struct PatchCell {
    enum class Shape : std::uint8_t {
        Rectangle, ///< covered all over
        Polygon,   ///< covered all over; the corners are no rectangle, the last two may be one point
        Partial    ///< the corners are those of the bounds of what is covered
    };
    std::array<vec3, 4> corner; ///< engine coordinates, counter-clockwise about the patch's normal
    vec2 low{0.0F};             ///< bounds of what it covers, sheet coordinates; parts are cut at their middle
    vec2 high{0.0F};
    std::uint32_t sheet = 0;
    std::uint32_t first_part = 0; ///< into Hierarchy::cell_parts; none where a rectangle has one colour
    std::uint32_t part_count = 0;
    float coverage = 1.0F;     ///< area of the element over that of the corners
    std::uint8_t quadrant = 0; ///< place in the parent: bit 0 along u, bit 1 along v
    Shape shape = Shape::Rectangle;
};
/// How to get from a cell to the part that holds a point: what leaf_at() reads, and nothing else.
struct CellStep {
    vec2 middle{0.0F};                          ///< where the cell is cut, sheet coordinates
    std::uint32_t first_child = Element::kNone; ///< element; kNone on leaves
    std::uint32_t first_cell = 0;               ///< of that child; the others follow
    std::uint8_t cut = 0;                       ///< bit 0: along u, bit 1: along v
    std::uint8_t present = 0;                   ///< bit q: there is a part in quadrant q
};
/// A triangle of the sheet as far as it lies in a cell.
struct CellPart {
    std::uint32_t triangle = 0; ///< into Hierarchy::sheet_triangles
    float upto = 0.0F;          ///< area of the cell's parts up to and including this one
};

/// Directional sums of a Cluster or Faces element.
struct Harmonics {
    Sh projected_area{}; ///< sum of area * max(0, n . d) over the faces below: visible area towards d
    ShRgb emission{};    ///< the same weighted with each face's B
    ShRgb incident{};    ///< irradiance per direction received at this level
};

/// Sizes that decide how fine the hierarchy may get, metres (derived from the scene's extent and the quality).
struct HierarchySettings {
    float smallest_patch = 0.15F; ///< patches are not split whose longer edge is below twice this
    float group_size = 0.1F;      ///< planar pieces smaller than this share Faces elements of this extent
    std::uint32_t seed = 1;       ///< enters every element's path, and through it every random stream
};

/// Elements and what belongs to them. Built once per geometry; patches are split by the refiner.
struct Hierarchy {
    std::vector<Element> elements; ///< [0] is the root cluster unless empty
    std::vector<Harmonics> harmonics;
    std::vector<Face> faces;
    std::vector<Sheet> sheets;
    std::vector<SheetTriangle> sheet_triangles;
    std::vector<PatchCell> patches;
    std::vector<CellStep> steps; ///< one per cell
    std::vector<CellPart> cell_parts;
    std::vector<std::size_t> first_triangle;       ///< per surface: where its triangles begin in the next two
    std::vector<std::uint32_t> on_sheet;           ///< per triangle: index into sheet_triangles or kNone
    std::vector<std::array<std::uint32_t, 2>> top; ///< per triangle, front and back: its Faces or topmost Patch, or kNone
    std::vector<std::uint32_t> room; ///< per element, leaves only: a number for its room, kNone where it stands alone;
                                     ///< empty where all is one room or nobody has looked (see mark_rooms())
    /// Elements from here on are of trees that append_to_hierarchy() made: the root knows nothing of them.
    std::uint32_t first_appended = Element::kNone;
    HierarchySettings settings;

    [[nodiscard]] bool empty() const { return elements.empty(); }
    [[nodiscard]] std::size_t memory_bytes() const;
    /// True when the element is a patch that split() may divide.
    [[nodiscard]] bool can_split(std::uint32_t element) const;
    /// Appends the parts of a leaf patch: the quarters of its cell, or the halves of a long one, as far as they cover
    /// anything, so one to four; their bounds are those of what they cover. Reflectance and emission are sampled anew.
    void split(std::uint32_t element, const RayScene& rays);
    /// The leaf that holds a point of a triangle side, `barycentric` as in Hit; kNone where the side is no part of the
    /// hierarchy. No search: one step for every level of a quadtree.
    [[nodiscard]] std::uint32_t leaf_at(std::uint32_t surface, std::uint32_t triangle, bool back,
                                        const vec2& barycentric) const;
    /// Indices of leaves in storage order.
    [[nodiscard]] std::vector<std::uint32_t> leaves() const;
    /// Recomputes power and spread of every element from the leaves' radiosity, and all radiosities above them.
    void pull_radiosity();
    /// Takes a rigid motion of a surface over to the patches on it and to Faces elements with no others; clusters stay.
    void follow(std::uint32_t surface, const dmat4& motion);
    /// Corners of a Patch, its cell's.
    [[nodiscard]] const std::array<vec3, 4>& corners(const Element& e) const { return patches[e.patch].corner; }
    /// Share of a Patch's corners' area that is surface.
    [[nodiscard]] float coverage(const Element& e) const { return patches[e.patch].coverage; }
};

/// A point on an element with the side's normal, for visibility rays.
struct SurfacePoint {
    vec3 position{0.0F};
    vec3 normal{0.0F};
};
/// Point on an element from two numbers in [0,1): uniform on what a patch covers; by power (or area where nothing shines)
/// below a cluster. Deterministic.
SurfacePoint sample_point(const Hierarchy& hierarchy, const RayScene& rays, std::uint32_t element, vec2 u, bool by_power);

/// Builds clusters and leaves from all surfaces. Planar pieces larger than the group size (see planar_regions()) become
/// patches, one a side, however many triangles they have; what is smaller is grouped by place and normal. Emitting and other
/// surfaces are in separate subtrees of the root. O(n log n). Of no use when stopped.
Hierarchy build_hierarchy(const RayScene& rays, const HierarchySettings& settings, const RunContext& context = {});

/// Appends a tree of its own over the surfaces from `first_surface` on, which the hierarchy does not know yet: see
/// Hierarchy::first_appended. Settings are the hierarchy's, but for the sizes. In O(n log n) of what is new.
void append_to_hierarchy(Hierarchy& hierarchy, const RayScene& rays, std::uint32_t first_surface,
                         const HierarchySettings& sizes);

} // namespace atrium
