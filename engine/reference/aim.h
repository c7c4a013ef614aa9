// Where mirrors and glass are, as balls that light is aimed at.
#pragma once

#include "engine/raycast/ray_scene.h"

#include <vector>

namespace atrium {

/// Balls that together hold every mirroring or refracting triangle of a scene; they may overlap. Whatever leaves a light and
/// meets such a triangle can be sampled, with a density that counts the balls in its way. Immutable; safe from any thread.
class Aim {
public:
    explicit Aim(const RayScene& rays);

    [[nodiscard]] bool empty() const { return balls_.empty(); }
    /// Sum of the solid angles of all balls, seen from a point, sr: 4 pi for each that it lies within.
    [[nodiscard]] float solid_angle(const vec3& from) const;
    /// Sum of the areas of the balls' outlines, m2.
    [[nodiscard]] float outline() const { return outline_; }

    struct Direction {
        vec3 direction{0.0F, 0.0F, 1.0F}; ///< unit
        float density = 0.0F;             ///< per steradian; 0 = nothing to aim at
    };
    /// Direction from a point into some ball, by three numbers in [0,1).
    [[nodiscard]] Direction from_point(const vec3& from, const vec3& u) const;

    struct Origin {
        vec3 origin{0.0F};    ///< outside of everything, upstream
        float density = 0.0F; ///< per square metre across the beam
    };
    /// Start of a ray of a parallel beam that crosses some ball.
    [[nodiscard]] Origin of_beam(const vec3& direction, const vec3& u) const;

private:
    struct Ball {
        vec3 centre{0.0F};
        float radius = 0.0F;
    };
    void divide(std::vector<Box3>& boxes, std::size_t begin, std::size_t end, int levels);
    [[nodiscard]] float solid_angle(const Ball& ball, const vec3& from) const;

    std::vector<Ball> balls_;
    float outline_ = 0.0F;
    vec3 centre_{0.0F};
    float reach_ = 0.0F; ///< of the scene about its centre, metres
};

} // namespace atrium
