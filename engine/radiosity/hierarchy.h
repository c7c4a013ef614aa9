// The element hierarchy: clusters down to surfaces, quadtrees below large triangles. One array, children contiguous.
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
    vec3 normal{0.0F}; ///< of the side, unit
};

/// One element. Radiosity B and exitance M in lumen per square metre (radiance times pi), irradiance E in lux.
struct Element {
    enum class Kind : std::uint8_t {
        Cluster, ///< inner node over other elements; emits and receives by spherical harmonics
        Faces,   ///< a few small triangles that share one radiosity; leaf; spherical harmonics
        Patch    ///< one triangle or a quarter of one; has a plane; leaf or four quarters
    };
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    Kind kind = Kind::Cluster;
    bool back = false; ///< Patch: the back side of its triangle
    std::uint16_t child_count = 0;
    std::uint32_t parent = kNone;
    std::uint32_t first_child = kNone;
    std::uint32_t harmonics = kNone; ///< index into Hierarchy::harmonics; Cluster and Faces only
    std::uint32_t surface = kNone;   ///< Patch
    std::uint32_t triangle = 0;      ///< Patch; Faces: first face in Hierarchy::faces
    std::uint32_t face_count = 0;    ///< Faces
    std::uint64_t path = 0;          ///< hash of the way from the root: seeds every random stream of this element
    vec3 centre{0.0F};
    float radius = 0.0F; ///< of a ball about centre that holds everything below
    float area = 0.0F;
    vec3 normal{0.0F};                 ///< Patch
    std::array<vec3, 3> corner;        ///< Patch, counter-clockwise about normal
    std::array<vec2, 3> barycentric{}; ///< Patch: corners in its triangle's barycentric coordinates
    Rgb rho{0.0F};                     ///< mean reflectance
    Rgb emitted{0.0F};                 ///< mean exitance M
    Rgb direct{0.0F};                  ///< mean irradiance of sun, sky, point and spot lights and named
                                       ///< emitters, see light_split.h (leaves)
    Rgb irradiance{0.0F};              ///< mean irradiance E from the other elements
    Rgb radiosity{0.0F};               ///< mean B
    float spread = 0.0F;               ///< largest deviation of luminance(B) of a Patch below from this one's
    float power = 0.0F;                ///< area * luminance(B): weight for picking sample points

    [[nodiscard]] bool leaf() const { return child_count == 0; }
};

/// Directional sums of a Cluster or Faces element.
struct Harmonics {
    Sh projected_area{}; ///< sum of area * max(0, n . d) over the faces below: visible area towards d
    ShRgb emission{};    ///< the same weighted with each face's B
    ShRgb incident{};    ///< irradiance per direction received at this level
};

/// Sizes that decide how fine the hierarchy may get, metres (derived from the scene's extent and the quality).
struct HierarchySettings {
    float smallest_patch = 0.15F; ///< edge below which a patch is not split
    float group_size = 0.1F;      ///< triangles smaller than this share Faces elements of this extent
    std::uint32_t seed = 1;       ///< enters every element's path, and through it every random stream
};

/// Elements and what belongs to them. Built once per geometry; patches are split by the refiner.
struct Hierarchy {
    std::vector<Element> elements; ///< [0] is the root cluster unless empty
    std::vector<Harmonics> harmonics;
    std::vector<Face> faces;
    HierarchySettings settings;
    std::vector<std::size_t> first_side;    ///< per surface, into top_of_side
    std::vector<std::uint32_t> top_of_side; ///< element that holds a triangle side: [first_side[s] + 2 triangle + back]

    [[nodiscard]] bool empty() const { return elements.empty(); }
    [[nodiscard]] std::size_t memory_bytes() const;
    /// True when the element is a patch that split() may divide.
    [[nodiscard]] bool can_split(std::uint32_t element) const;
    /// Appends the four quarters of a leaf patch (mid-edge subdivision); reflectance and emission are sampled anew.
    void split(std::uint32_t element, const RayScene& rays);
    /// Indices of leaves in storage order.
    [[nodiscard]] std::vector<std::uint32_t> leaves() const;
    /// Leaf that covers a point of a triangle side (barycentric as in Hit); kNone where the side is no part of the tree.
    [[nodiscard]] std::uint32_t leaf_at(std::uint32_t surface, std::uint32_t triangle, bool back,
                                        const vec2& barycentric) const;
    /// Recomputes power and spread of every element from the leaves' radiosity, and all radiosities above them.
    void pull_radiosity();
};

/// A point on an element with the side's normal, for visibility rays.
struct SurfacePoint {
    vec3 position{0.0F};
    vec3 normal{0.0F};
};
/// Point on an element from two numbers in [0,1): uniform on a patch; by power (or area where nothing shines) below a
/// cluster. Deterministic.
SurfacePoint sample_point(const Hierarchy& hierarchy, const RayScene& rays, std::uint32_t element, vec2 u, bool by_power);

/// Builds clusters and leaves from all surfaces; large triangles become patches, small ones are grouped. Emitting and other
/// surfaces are in separate subtrees of the root.
Hierarchy build_hierarchy(const RayScene& rays, const HierarchySettings& settings);

} // namespace atrium
