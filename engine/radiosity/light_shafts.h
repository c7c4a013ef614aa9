// Which points a moved object may shade or light: shafts between points and the sources of direct light.
#pragma once

#include "engine/radiosity/direct_light.h"
#include "engine/radiosity/hierarchy.h"
#include "engine/radiosity/mirror_light.h"

#include <span>
#include <vector>

namespace atrium {

/// Sources as directions with an angle and balls around what shines. A shaft is what lies between a point and a source; what
/// no box of a change touches keeps its light to the bit. Boxes that can take away next to nothing of a large source's light
/// are not looked at: this is for updates that a full solution follows. Immutable; safe from any thread.
class LightShafts {
public:
    /// Sun, point and spot lights.
    void add_lamps(const DirectLight& lights);
    /// Surfaces that shine, in at most `most` balls.
    void add_emitters(const Hierarchy& emitters, std::size_t most = 64);
    /// Windows that the sky is looked for through; sky past them counts as all round.
    void add_sky(const SkyLight& sky);
    /// From here on everything added is seen over the flat mirrors instead of straight.
    void over_mirrors(const PlanarMirrors& mirrors) { mirrors_ = mirrors.mirrors(); }

    /// A box touches a shaft of this point, or of any within `radius` of it.
    [[nodiscard]] bool touched(const vec3& point, float radius, const Box3& box) const;
    /// One of a few rays into the shafts that the boxes touch meets what moved, where it is now or where it stood
    /// (RayScene::meets_moved() after look_back(), far cheaper than to look). False: but for slivers of a source the point's
    /// light is what it was before anything moved. `normal`: unit, sources below its horizon do not count; 0: all
    /// do. `closely`: more rays.
    [[nodiscard]] bool meets_moved(const RayScene& rays, const SurfacePoint& point, std::span<const Box3> boxes,
                                   bool closely) const;
    [[nodiscard]] bool empty() const { return suns_.empty() && balls_.empty() && !all_round_; }

private:
    struct Sun {
        vec3 direction; ///< unit, towards it
        float spread;   ///< tangent of the half angle of its disc
    };
    struct Ball {
        vec3 centre;
        float radius;
    };
    class Scout;
    [[nodiscard]] bool straight(const vec3& point, float radius, const Box3& box) const;
    [[nodiscard]] bool over_mirror(const PlanarMirror& mirror, const vec3& point, float radius, const Box3& box) const;

    std::vector<Sun> suns_;
    std::vector<Ball> balls_;
    std::span<const PlanarMirror> mirrors_; ///< empty: sources are seen straight
    bool all_round_ = false;
};

/// From a point to the nearest of a box; 0 inside.
inline float distance_to(const Box3& box, const vec3& point) {
    return glm::length(glm::max(glm::max(box.min - point, point - box.max), vec3(0.0F)));
}

/// The shaft from a ball of radius `from` around a point to another ball, or along a unit direction with a growing radius,
/// touches a box: exact but for the corners of the swollen box.
bool shaft_to_ball_touches(const vec3& point, float from, const vec3& centre, float radius, const Box3& box);
bool shaft_to_sun_touches(const vec3& point, float from, const vec3& direction, float spread, const Box3& box);

} // namespace atrium
