// Flat pieces through which the sky is looked for by name, and points on them for rays.
#pragma once

#include "engine/raycast/ray_scene.h"

#include <array>
#include <span>
#include <vector>

namespace atrium {

/// A pane of glass or an opening without any: a rectangle or a triangle, in engine coordinates.
struct SkyWindow {
    std::array<vec3, 4> corners{}; ///< in order around it; a triangle uses three
    unsigned corner_count = 4;
    vec3 normal{0.0F, 0.0F, 1.0F}; ///< unit; of an opening: the way out
    bool opening = false;          ///< no glass: counts only for light that crosses it against `normal`

    [[nodiscard]] std::span<const vec3> outline() const { return {corners.data(), corner_count}; }
    /// Form factor of the whole piece, unobstructed, from an element at `point`; an opening seen from outside has none.
    [[nodiscard]] float form_factor(const vec3& point, const vec3& from_normal) const;
    /// Distance at which a ray crosses it (an opening: outwards); infinite where it does not.
    [[nodiscard]] float crossing(const vec3& point, const vec3& direction) const;
};

/// The windows of all panes of a scene: their triangles, two that make a rectangle joined to one.
std::vector<SkyWindow> pane_windows(const RayScene& rays);

/// Points on a window as a receiver sees it: from the unit square, so that equal areas of the square stand for nearly equal
/// shares of the window's form factor. Rectangles by solid angle (Urena, Fajardo, King 2013), warped by the cosine at the
/// corners; triangles and what is far away by area.
class WindowPoints {
public:
    WindowPoints(const SkyWindow& window, const vec3& point, const vec3& normal);

    struct Place {
        vec3 direction{0.0F}; ///< unit, from the receiver
        float distance = 0.0F;
        float weight = 0.0F; ///< form factor over density but for a constant factor; 0 = below the receiver's horizon
    };
    [[nodiscard]] Place at(const vec2& u) const;

private:
    [[nodiscard]] vec3 on_rectangle(float u, float v) const;

    const SkyWindow& window_;
    vec3 point_;
    vec3 normal_;
    bool by_angle_ = false;
    vec3 x_{0.0F}, y_{0.0F}, z_{0.0F};                    // the rectangle's frame
    float x0_ = 0, x1_ = 0, y0_ = 0, y1_ = 0, z0_ = 0;    // the rectangle in it, seen from the receiver
    float b0_ = 0, b1_ = 0, k_ = 0, angle_ = 0;           // terms of the map; its solid angle
    std::array<float, 4> cosine_{1.0F, 1.0F, 1.0F, 1.0F}; // at (0,0), (1,0), (0,1), (1,1)
};

} // namespace atrium
