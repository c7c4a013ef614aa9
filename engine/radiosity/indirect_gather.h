// Reflected light at a point: rays over the hemisphere read the solved radiosity where they land, spots that stand out are
// gathered by name.
#pragma once

#include "engine/radiosity/irradiance_cache.h"
#include "engine/radiosity/light_split.h"
#include "engine/radiosity/mirror_light.h"
#include "engine/radiosity/point_gather.h"

#include <functional>
#include <vector>

namespace atrium {

/// How closely the hemisphere is looked at.
struct IndirectSettings {
    unsigned rays = 64;      ///< over the hemisphere, a power of two: the same directions at every point of a wall
    unsigned max_rays = 256; ///< where the light comes unevenly
    float tolerance = 0.02F; ///< relative standard error that asks for no more rays
    /// Where a ray ends nearer than this many radii of the leaf there, what the leaf reflects is not its mean: one more ray
    /// tells how much reflected light reaches the very spot. In folds and corners the mean is another place's light.
    float near = 0.0F;
    unsigned most_bounces = 4; ///< of such further rays, one after the other
    bool all_light = false;    ///< also what particles bring
    GatherSettings bright;     ///< for the spots that stand out; rays find those that its `nearest` leaves out
};

/// Direct irradiance at a point of a surface side, where it is known more closely than as the leaf's mean; false where not.
using DirectAtHit = std::function<bool(const Hit& hit, Rgb& irradiance)>;

/// Needs the hierarchy as it is after a solution, unchanged as long as this lives. Safe from any thread.
class IndirectGather {
public:
    /// `bright` flags leaves that are gathered by name and left out of the hemisphere (bright_leaves()).
    /// `sky` = radiance that rays see which leave the scene over mirrors or through lenses, cd/m2. Over the flat
    /// mirrors of `mirrors` (may be null) `bright` leaves are looked for by name too, one reflection each. What is
    /// `carried` comes to the point by particles and is no part of its irradiance.
    IndirectGather(const Hierarchy& solved, const RayScene& rays, LeafFlags bright, DirectAtHit direct = {},
                   const Rgb& sky = Rgb(0.0F), const MirrorLight* mirrors = nullptr, CarriedByParticles carried = {});
    IndirectGather(const IndirectGather&) = delete;
    IndirectGather& operator=(const IndirectGather&) = delete;

    /// Irradiance from the radiosity of all surfaces (named emitters' own light is not part of it), in lux, with the
    /// variance of its samples. Nearby points err alike, so what is shown is smooth.
    [[nodiscard]] FieldSample irradiance(const vec3& point, const vec3& normal, const IndirectSettings& settings) const;

private:
    /// One of the rays that are summed up.
    struct Sample {
        std::uint32_t index = 0; ///< of its numbers
        unsigned bounce = 0;     ///< 0 at the point that is asked for, where what stands out is gathered by name
        float weight = 1.0F;     ///< share of what it brings that counts
        float usual = 0.0F;      ///< what a ray brings, luminance, by those before it; 0 = not known yet
    };
    /// Radiosity that arrives along a ray, over mirrors and through glass; `distance` of the first hit, infinite without
    /// one.
    [[nodiscard]] Rgb along(const vec3& origin, const vec3& direction, const Sample& sample,
                            const IndirectSettings& settings, float& distance) const;
    /// Radiosity of a leaf where a ray of length `travelled` ends on it.
    [[nodiscard]] Rgb sent_back(const Hit& hit, const Element& leaf, float travelled, const Sample& sample,
                                const IndirectSettings& settings) const;

    const Hierarchy& h_;
    const RayScene& rays_;
    LeafFlags bright_;
    DirectAtHit direct_;
    Rgb sky_;
    const MirrorLight* mirrors_;
    CarriedByParticles carried_;
    Hierarchy bright_tree_; ///< empty when nothing stands out
    PointGather bright_gather_;
    float offset_ = 1e-4F;         ///< of ray origins from their surface, metres
    std::vector<vec3> directions_; ///< cosine-weighted, +z up
};

} // namespace atrium
