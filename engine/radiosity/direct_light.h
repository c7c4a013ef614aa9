// Light that does not come from surfaces: point and spot lights, the sun, the sky.
#pragma once

#include "engine/raycast/ray_scene.h"

#include <array>
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
    /// Irradiance at a point, visibility included. `sun_rays` spread over the sun's disc; a few of them suffice where these
    /// agree, so a large number costs only in penumbrae. The sky is looked for through panes with about `sky_rays` points on
    /// the glass, and past them with a third as many over the hemisphere (cosine weighted), where the gap between a ray that
    /// sees it and one that does not is halved twice. The pattern is the same at every point: no noise between neighbours.
    [[nodiscard]] DirectSample irradiance(const vec3& point, const vec3& normal, unsigned sun_rays, unsigned sky_rays) const;
    /// The two parts of irradiance(): sun, point and spot lights, whose shadows have sharp edges and which cost a few rays;
    /// and the sky, which is soft and costs many.
    [[nodiscard]] DirectSample lamps_irradiance(const vec3& point, const vec3& normal, unsigned sun_rays) const;
    [[nodiscard]] DirectSample sky_irradiance(const vec3& point, const vec3& normal, unsigned sky_rays) const;
    /// Flux of all point and spot lights, lumen.
    [[nodiscard]] double emitted_flux() const;

private:
    void add_sun(const PlacedLight& sun, const vec3& point, const vec3& normal, unsigned sun_rays, DirectSample& out) const;
    /// Sky seen past all panes: through open windows and doors, from outside.
    void add_open_sky(const vec3& point, const vec3& normal, unsigned sky_rays, DirectSample& out) const;
    /// Sky seen through glass: every pane is an area source with a closed-form form factor. A direction that crosses several
    /// panes counts for the first.
    void add_sky_through_panes(const vec3& point, const vec3& normal, unsigned sky_rays, DirectSample& out) const;

    /// What rays to points on one pane met.
    struct PaneView {
        Rgb seen{0.0F};       ///< transmittances, weighted like the form factor
        float weights = 0.0F; ///< sum of the weights
        float points = 0.0F;  ///< that lie before the receiver
        float clear = 0.0F;   ///< of them, from which sky is seen
    };
    [[nodiscard]] PaneView look_through(std::size_t pane, const vec3& point, const vec3& normal, unsigned count) const;

    const RayScene& rays_;
    std::vector<PlacedLight> lights_;
    std::vector<std::array<vec3, 3>> panes_; ///< triangles of all panes; filled only under a sky
    std::vector<vec3> pane_normals_;
    std::vector<vec3> pane_points_; ///< the first points of every pane's pattern
    Rgb sky_radiance_{0.0F};
    bool sky_ = false;
};

} // namespace atrium
