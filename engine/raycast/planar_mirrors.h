// Flat mirrors of a scene: those that light is carried over by mirror images.
#pragma once

#include "engine/raycast/ray_scene.h"

#include <array>
#include <span>
#include <vector>

namespace atrium {

/// One flat piece of a mirroring surface.
struct PlanarMirror {
    dvec3 normal{0.0};           ///< unit, on the front side
    double offset = 0.0;         ///< of the plane: glm::dot(normal, p) of its points
    std::array<vec3, 4> corner;  ///< of the least rectangle along its edges that holds it, counter-clockwise from the front
    double area = 0.0;           ///< of its triangles, square metres
    bool both_sides = false;     ///< the back mirrors too
    bool fills = true;           ///< the rectangle is mirror nearly all over
    std::uint32_t surface = 0;   ///< of RayScene::surfaces()
    std::uint32_t triangles = 0; ///< how many

    /// Signed distance from the plane, positive in front.
    [[nodiscard]] double height(const vec3& point) const { return glm::dot(normal, dvec3(point)) - offset; }
    /// Mirror image of a point.
    [[nodiscard]] vec3 reflect_point(const vec3& point) const { return {dvec3(point) - 2.0 * height(point) * normal}; }
    /// Mirror image of a direction.
    [[nodiscard]] vec3 reflect_direction(const vec3& d) const {
        return {dvec3(d) - 2.0 * glm::dot(normal, dvec3(d)) * normal};
    }
};

/// Immutable; safe from any thread.
class PlanarMirrors {
public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    static constexpr std::size_t kMost = 32; ///< every point looks into every mirror that it can see

    PlanarMirrors() = default;
    /// The largest flat pieces of smooth metal. Small pieces, facets of bent mirrors and triangles that are shaded as if
    /// they were bent are left out. Some are missing when it is stopped.
    explicit PlanarMirrors(const RayScene& rays, const RunContext& context = {});

    [[nodiscard]] bool empty() const { return mirrors_.empty(); }
    [[nodiscard]] std::span<const PlanarMirror> mirrors() const { return mirrors_; }
    /// Index of the mirror that a triangle is part of, kNone where it is part of none.
    [[nodiscard]] std::uint32_t mirror_of(std::uint32_t surface, std::uint32_t triangle) const;
    /// Index of the mirror whose mirroring side was hit, or kNone.
    [[nodiscard]] std::uint32_t mirror_at(const Hit& hit) const;
    /// True where a ray met the mirroring side of a flat mirror.
    [[nodiscard]] bool is_image_mirror(const Hit& hit) const { return mirror_at(hit) != kNone; }

private:
    std::vector<PlanarMirror> mirrors_;
    std::vector<std::vector<std::uint32_t>> mirror_of_; ///< per surface: empty, or one entry per triangle
};

} // namespace atrium
