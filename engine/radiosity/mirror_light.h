// Light of lamps and of bright surfaces over flat mirrors, by mirror images: as exact as if it came straight.
#pragma once

#include "engine/radiosity/point_gather.h"

namespace atrium {

/// One reflection in any of the flat mirrors of a scene. What goes over two of them, or over a mirror that is not flat, is
/// left to particles. Immutable; safe from any thread. `rays` must outlive it.
class MirrorLight {
public:
    explicit MirrorLight(const RayScene& rays, const RunContext& context = {}) : rays_(rays), mirrors_(rays, context) {}

    /// There is no flat mirror.
    [[nodiscard]] bool empty() const { return mirrors_.empty(); }
    [[nodiscard]] const PlanarMirrors& mirrors() const { return mirrors_; }
    /// A chain whose only bend is at this hit is part of what irradiance() counts.
    [[nodiscard]] bool carries(const Hit& hit) const { return mirrors_.is_image_mirror(hit); }
    /// What `lamps` (not their sky) and the surfaces that shine in `surfaces` send to a point over the mirrors; either may
    /// be null.
    [[nodiscard]] DirectSample irradiance(const vec3& point, const vec3& normal, const GatherSettings& settings,
                                          const DirectLight* lamps, const PointGather* surfaces) const;

private:
    const RayScene& rays_;
    PlanarMirrors mirrors_;
};

} // namespace atrium
