// Lights without a surface of their own. An area light is any shape whose material emits.
#pragma once

#include "engine/base/ids.h"
#include "engine/base/units.h"

#include <memory>
#include <string>

namespace atrium {

class PhotometricWeb;

/// A measured distribution (photometric_web.h) that lights share. Two are equal when they say the same.
struct Photometry {
    std::shared_ptr<const PhotometricWeb> web;
    explicit operator bool() const { return web != nullptr; }
    const PhotometricWeb* operator->() const { return web.get(); }
    friend bool operator==(const Photometry& a, const Photometry& b);
};

/// Point, spot or directional light as in KHR_lights_punctual; shines along the node's -z; node scale has no effect.
struct Light {
    enum class Kind : std::uint8_t { Point, Spot, Directional };
    std::string name;
    Kind kind = Kind::Point;
    Rgb color{1.0F};          ///< linear, multiplies intensity
    float intensity = 100.0F; ///< point and spot: cd, with photometry the peak's; directional: lux on a surface facing it
    float inner_cone = 0.0F;  ///< spot, radians from the axis
    float outer_cone = kPi / 4.0F;
    /// Point and spot: how intensity is spread over directions, in the place of the kind's own shape; the kind and its cones
    /// are then what programs show that know no photometry. Light is white times `color`. See light_distribution().
    Photometry photometry;
    float angular_diameter_degrees = kSunAngularDiameterDegrees; ///< directional only; 0 = parallel beam
    bool enabled = true;
    std::string extras; ///< JSON text, kept through a round trip
    friend bool operator==(const Light&, const Light&) = default;
};
using LightId = Id<Light>;

/// Luminous intensity factor of a spot at angle `cos_angle` from its axis (KHR_lights_punctual, squared falloff), in [0,1].
float spot_falloff(const Light& light, float cos_angle);

/// The photometry that shapes a light: none for one without, and for a directional light.
const PhotometricWeb* light_distribution(const Light& light);
/// Flux over peak intensity times the colour's luminance, sr: 4 pi for a point light. Not for directional lights (0).
double solid_angle_of(const Light& light);
/// Flux of a point or spot light, lumen; 0 for a directional one.
double flux_of(const Light& light);
/// Gives a point or spot light a distribution as it was measured: its peak intensity, and the kind and cones that come
/// closest. The colour stays.
void set_photometry(Light& light, std::shared_ptr<const PhotometricWeb> web);
/// Takes the distribution away; the flux stays.
void remove_photometry(Light& light);

/// What lies outside the geometry. Uniform radiance from every direction, cd/m2; zero = nothing (black).
struct Environment {
    Rgb sky_radiance{0.0F};
    friend bool operator==(const Environment&, const Environment&) = default;
};

/// Camera looks along the node's -z with +y up, as in glTF.
struct Camera {
    std::string name;
    bool perspective = true;
    float yfov = 0.9F;        ///< radians
    float ymag = 1.0F;        ///< orthographic half height, metres
    float znear = 0.02F;      ///< metres
    float zfar = 0.0F;        ///< 0 = infinite
    float exposure_ev = 0.0F; ///< offset from automatic exposure, in stops
    std::string extras;
    friend bool operator==(const Camera&, const Camera&) = default;
};
using CameraId = Id<Camera>;

} // namespace atrium
