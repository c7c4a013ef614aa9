// What a meter held at a point of a lit surface would show, and what of it came which way.
#pragma once

#include "engine/solver/solution.h"

#include <array>

namespace atrium {

/// Light at one point of a surface side; illuminance in lux, luminance in cd/m2.
struct LightReading {
    Rgb irradiance{0.0F};
    double illuminance = 0;
    double standard_error = 0; ///< of the illuminance, as `atrium-cli measure` states it; 0 = not measured yet
    double direct = 0;         ///< shares of the illuminance: straight from lamps, sun and sky,
    double diffuse = 0;        ///< from other surfaces,
    double caustic = 0;        ///< over mirrors, metals and glass
    double luminance = 0;      ///< of the surface, textures applied, seen from anywhere (matt) and with what it emits
};

/// In a triangle (first of its three indices in the layer's mesh) at barycentric weights. `back` must exist. The same
/// figures as read_surface() at that point. Any thread.
LightReading read_light(const Scene& scene, const Solution& solution, const SurfaceLayer& layer, const Material& material,
                        std::size_t first_index, const vec3& weight, bool back);

} // namespace atrium
