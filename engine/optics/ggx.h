// The GGX microfacet distribution: which facets are seen, how much they shade each other.
#pragma once

#include "engine/base/math.h"

namespace atrium {

/// Normal of a facet seen from `view`, in proportion to its visible area (Heitz 2018). `view` is unit, in a frame whose z is
/// the surface's normal, z >= 0; `alpha` > 0; u in [0,1). Unit, z >= 0.
vec3 ggx_visible_normal(const vec3& view, float alpha, const vec2& u);

/// Smith's Lambda of a direction at `cosine` from the normal: masked over visible area. Infinite at grazing.
float ggx_lambda(float cosine, float alpha);

/// G2/G1 of light from `cos_in` that a facet sends to `cos_out` on the same side, height-correlated: the weight of a
/// direction that ggx_visible_normal() picked, without Fresnel; in [0, 1], 0 below the horizon.
float ggx_reflected(float cos_in, float cos_out, float alpha);

/// The same for light that goes through to `cos_out` on the other side, where heights are taken as independent.
float ggx_transmitted(float cos_out, float alpha);

/// Root mean square angle between facet and surface normal, radians: a fit, within 2 % for alpha in [0.002, 1].
float ggx_rms_tilt(float alpha);

} // namespace atrium
