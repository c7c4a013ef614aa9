// What a point sees in a flat mirror: sight from its mirror image through the mirror as through a window.
#pragma once

#include "engine/raycast/planar_mirrors.h"

namespace atrium {

/// A point, its mirror image and the mirror between them. Whoever computes light with the image in the point's place and
/// asks here what is seen, instead of RayScene, has the light that comes over the mirror.
class MirrorSight {
public:
    /// How much of a cone of directions goes through the mirror's rectangle.
    enum class Cover : std::uint8_t { None, Part, Whole };
    static constexpr std::size_t kMaxCorners = 12; ///< of a clipped polygon

    /// `point` with its unit `normal` looks into a mirror of `mirrors`. Everything must outlive it.
    MirrorSight(const RayScene& rays, const PlanarMirrors& mirrors, std::uint32_t mirror, const vec3& point,
                const vec3& normal);

    /// False where the point is behind the mirror or in its plane, or the whole mirror below the point's horizon.
    [[nodiscard]] bool sees() const { return sees_; }
    /// The image of the point, and of its normal.
    [[nodiscard]] const vec3& image() const { return image_; }
    [[nodiscard]] const vec3& image_normal() const { return image_normal_; }
    /// The mirror's rectangle is mirror nearly all over.
    [[nodiscard]] bool fills() const { return fills_; }

    /// The way from the image to `to` goes through the mirror's rectangle.
    [[nodiscard]] bool crosses(const vec3& to) const;
    /// Nothing of a ball can be seen through the rectangle. May be false though nothing can.
    [[nodiscard]] bool misses(const vec3& centre, float radius) const;
    /// All of a ball lies behind the rectangle, as seen from the image.
    [[nodiscard]] bool holds(const vec3& centre, float radius) const;
    /// The cone of half angle `angle`, radians, about a unit direction from the image.
    [[nodiscard]] Cover cover(const vec3& direction, float angle) const;
    /// What of a convex polygon of at most 7 corners lies within sight through the rectangle; returns the number of corners,
    /// 0 where nothing does.
    std::size_t clip(std::span<const vec3> polygon, std::array<vec3, kMaxCorners>& out) const;

    /// Share of light that comes from a point over the mirror: what both ways leave of it (RayScene::transmittance()) and
    /// what the mirror sends on. 0 where the way misses the mirror, which costs no ray outside the rectangle.
    [[nodiscard]] Rgb transmittance(const vec3& to) const;
    /// The same for light from infinity; unit `direction` from the image towards it.
    [[nodiscard]] Rgb transmittance_to_infinity(const vec3& direction) const;

private:
    /// What is left of light over the mirror, without the way from there to its source; `at` = where the mirror is met.
    [[nodiscard]] Rgb to_mirror(const vec3& direction, vec3& at) const;

    const RayScene& rays_;
    const PlanarMirrors& mirrors_;
    std::uint32_t mirror_;
    bool sees_ = false;
    bool fills_ = true;
    vec3 point_;
    vec3 image_;
    vec3 image_normal_;
    vec3 side_{0.0F};          ///< the mirror's normal on the point's side
    float height_ = 0.0F;      ///< of the point over the mirror
    std::array<vec3, 4> edge_; ///< unit, inward normals of the planes through the image and the rectangle's edges
};

} // namespace atrium
