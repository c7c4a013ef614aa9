// Irradiance at a point from the solved hierarchy: a cut through the tree of elements, closer where it matters, with
// visibility rays where the light comes from.
#pragma once

#include "engine/radiosity/direct_light.h"
#include "engine/radiosity/far_faces.h"
#include "engine/radiosity/gather_tree.h"
#include "engine/radiosity/hierarchy.h"
#include "engine/radiosity/sky_window.h"

namespace atrium {

struct GatherSettings {
    float tolerance = 0.01F; ///< error of one element of the cut relative to the point's whole irradiance
    unsigned max_cut = 400;  ///< elements in a cut at most
    unsigned rays = 96;      ///< visibility rays shared out over the cut by contribution
    unsigned sun_rays = 16;
    unsigned sky_rays = 128;
    /// Leaves whose middle is nearer than this many of their radii are left out: there their mean says too little of them.
    float nearest = 0.0F;
    /// Half of what a sample stands for, metres: beside a lamp that stands on the surface it gets the mean over that
    /// stretch, or the light of narrow lamps would fall between the samples. 0: the light at the very point.
    float spread = 0.0F;
};

/// An element is a leaf whose middle is nearer to a point than so many of its radii: see GatherSettings::nearest.
[[nodiscard]] bool too_near(const Element& element, const vec3& point, float radii);

/// Safe from any thread while the hierarchy does not change; what shines in it is looked up when this is made.
class PointGather {
public:
    /// Without `direct` it gathers from the tree alone, without `far` from every face of a group, however far away. What
    /// shines through `slits` is looked for through them: see find_lamp_slits().
    PointGather(const Hierarchy& hierarchy, const RayScene& rays, const DirectLight* direct = nullptr,
                const FarFaces* far = nullptr, std::span<const SkyWindow> slits = {})
        : h_(hierarchy), rays_(rays), direct_(direct), far_(far), tree_(hierarchy), slits_(slits) {}

    /// Irradiance on a small plane at `point` (engine coordinates) with unit `normal`, surfaces, sun, sky and lamps
    /// together.
    [[nodiscard]] DirectSample irradiance(const vec3& point, const vec3& normal, const GatherSettings& settings) const;
    /// What the surfaces alone send over a mirror.
    [[nodiscard]] DirectSample irradiance(const MirrorSight& over, const GatherSettings& settings) const;

private:
    struct Visibility {
        Rgb seen{0.0F};     ///< weighted share of an element's light that arrives
        float clear = 0.0F; ///< rays that were not blocked
        unsigned rays = 0;
    };
    // With `over`, the receiver is its image. Unless `through_slits`, what crosses a slit counts as blocked: add_slits() has
    // it.
    [[nodiscard]] Visibility visibility(std::uint32_t element, const SurfacePoint& receiver, unsigned count,
                                        const MirrorSight* over, bool through_slits) const;
    [[nodiscard]] std::size_t slit_on_way(const vec3& from, const vec3& direction, float distance) const;
    [[nodiscard]] Rgb light_from(const vec3& from, const vec3& direction) const;
    void add_slits(const SurfacePoint& p, DirectSample& out) const;
    void add_surfaces(const SurfacePoint& p, const GatherSettings& settings, const MirrorSight* over, bool through_slits,
                      DirectSample& out) const;

    const Hierarchy& h_;
    const RayScene& rays_;
    const DirectLight* direct_;
    const FarFaces* far_;
    GatherTree tree_;
    std::span<const SkyWindow> slits_;
};

} // namespace atrium
