// Light that does not come from surfaces: point and spot lights, the sun, the sky.
#pragma once

#include "engine/radiosity/sky_light.h"
#include "engine/raycast/mirror_sight.h"
#include "engine/scene/photometric_web.h"

#include <span>
#include <utility>
#include <vector>

namespace atrium {

/// A placed, enabled light in engine coordinates.
struct PlacedLight {
    Light light;
    NodeId node;
    vec3 position{0.0F};
    vec3 axis{0.0F, 0.0F, -1.0F}; ///< unit, the way it shines
    vec3 right{1.0F, 0.0F, 0.0F}; ///< unit, its own +x; only of those with photometry

    /// Intensity towards a unit direction from the lamp over Light::intensity. Not for directional lights.
    [[nodiscard]] float distribution(const vec3& away) const;
};

/// All but how bright they are, and names: one is the other dimmed, coloured or switched off.
bool same_but_brightness(const PlacedLight& a, const PlacedLight& b);

/// The enabled lights of a scene with the world position of engine (0,0,0), in tree order.
std::vector<PlacedLight> placed_lights(const Scene& scene, const dvec3& origin);

/// Light over the brightness of its source, channel by channel. A channel in which the source is dark counts as the mean of
/// the others: what lies between scatters and absorbs alike in all, but for coloured glass.
Rgb per_brightness(const Rgb& light, const Rgb& brightness);

/// Immutable but for set_brightness() and place(); safe from any thread.
class DirectLight {
public:
    /// Under a sky this looks for the openings that it shines through: see SkyLight.
    DirectLight(const Scene& scene, const RayScene& rays, const RunContext& context = {});
    /// These lights alone, without a sky.
    DirectLight(std::vector<PlacedLight> lights, const RayScene& rays)
        : rays_(rays), lights_(std::move(lights)), sky_(Rgb(0.0F), rays, {}) {}

    /// Takes over the intensities and colours of `lights` (the same ones as lights(), in their order) and of the sky. What
    /// is dark keeps its place. Not while anybody reads.
    void set_brightness(std::span<const PlacedLight> lights, const Rgb& sky);
    /// Takes over the lights (as many as lights(), in their order) at other places, in whatever is new about them. Not while
    /// anybody reads.
    void place(std::vector<PlacedLight> lights) { lights_ = std::move(lights); }

    [[nodiscard]] bool empty() const { return lights_.empty() && sky_.empty(); }
    [[nodiscard]] bool has_sky() const { return !sky_.empty(); }
    [[nodiscard]] const SkyLight& sky() const { return sky_; }
    [[nodiscard]] const std::vector<PlacedLight>& lights() const { return lights_; }
    /// Irradiance at a point, visibility included. `sun_rays` spread over the sun's disc; a few of them suffice where these
    /// agree, so a large number costs only in penumbrae. `sky_rays`: see SkyLight::irradiance(). The pattern is the same at
    /// every point: no noise between neighbours.
    [[nodiscard]] DirectSample irradiance(const vec3& point, const vec3& normal, unsigned sun_rays, unsigned sky_rays) const;
    /// The two parts of irradiance(): sun, point and spot lights, whose shadows have sharp edges and which cost a few rays;
    /// and the sky, which is soft and costs many.
    [[nodiscard]] DirectSample lamps_irradiance(const vec3& point, const vec3& normal, unsigned sun_rays) const;
    /// What sun, point and spot lights send over a mirror.
    [[nodiscard]] DirectSample lamps_irradiance(const MirrorSight& over, unsigned sun_rays) const {
        return lamps_irradiance(over.image(), over.image_normal(), sun_rays, &over);
    }
    [[nodiscard]] DirectSample sky_irradiance(const vec3& point, const vec3& normal, unsigned sky_rays) const;
    /// Flux of all point and spot lights, lumen.
    [[nodiscard]] double emitted_flux() const;

private:
    // With `over`, point and normal are its image.
    [[nodiscard]] DirectSample lamps_irradiance(const vec3& point, const vec3& normal, unsigned sun_rays,
                                                const MirrorSight* over) const;
    void add_sun(const PlacedLight& sun, const vec3& point, const vec3& normal, unsigned sun_rays, const MirrorSight* over,
                 DirectSample& out) const;

    const RayScene& rays_;
    std::vector<PlacedLight> lights_;
    SkyLight sky_;
};

} // namespace atrium
