// Light that does not come from surfaces: point and spot lights, the sun, the sky.
#pragma once

#include "engine/raycast/ray_scene.h"

#include <vector>

namespace atrium {

/// A placed, enabled light in engine coordinates.
struct PlacedLight {
    Light light;
    NodeId node;
    vec3 position{0.0F};
    vec3 axis{0.0F, 0.0F, -1.0F}; ///< unit, the way it shines
};

/// Irradiance with a figure for its own uncertainty.
struct DirectSample {
    Rgb irradiance{0.0F};
    float variance = 0.0F; ///< of luminance(irradiance), lux^2, from the visibility samples
};

/// Immutable; safe from any thread.
class DirectLight {
public:
    DirectLight(const Scene& scene, const RayScene& rays);

    [[nodiscard]] bool empty() const { return lights_.empty() && !sky_; }
    [[nodiscard]] bool has_sky() const { return sky_; }
    [[nodiscard]] const std::vector<PlacedLight>& lights() const { return lights_; }
    /// Irradiance at a point, visibility included. `sun_rays` spread over the sun's disc, `sky_rays` over the hemisphere
    /// (cosine weighted). The pattern of rays is the same at every point, so neighbouring points see the same error.
    [[nodiscard]] DirectSample irradiance(const vec3& point, const vec3& normal, unsigned sun_rays, unsigned sky_rays) const;
    /// Flux of all point and spot lights, lumen.
    [[nodiscard]] double emitted_flux() const;

private:
    const RayScene& rays_;
    std::vector<PlacedLight> lights_;
    Rgb sky_radiance_{0.0F};
    bool sky_ = false;
};

} // namespace atrium
