// Eye rays over mirrors, metals and glass to surfaces whose light is known from the layers.
#pragma once

#include "engine/view/eye_surface.h"
#include "engine/view/lit_scene.h"

namespace atrium {

/// What one eye ray shows, in the parts of StillLayers.
struct EyeLight {
    Rgb direct{0.0F};
    Rgb diffuse{0.0F};
    Rgb caustic{0.0F};
    Rgb specular{0.0F};
    Rgb albedo{0.0F};
    vec3 normal{0.0F};
    float depth = 0.0F;
    Rgb read{0.0F};     ///< of a final pass: what the layers have for `diffuse`, which is gathered
    bool over = false;  ///< the ray met a mirror, a metal or glass before anything that it ends at
    bool rough = false; ///< and that was rough

    [[nodiscard]] Rgb sum() const { return direct + diffuse + caustic + specular; }
    /// Tells what the first surface is; the first call counts.
    void meet(const EyeSurface& surface, float distance, const Rgb& albedo_there);
};

/// Follows both ways on at mirrors and glass as long as they matter. Immutable; safe from any thread.
class EyeTracer {
public:
    EyeTracer(const LitScene& lit, const Rgb& sky, int max_depth, const LightShares& shares)
        : lit_(lit), rays_(lit.rays()), sky_(sky), max_depth_(max_depth), shares_(shares) {}

    /// `seed` places the rays of rough surfaces.
    [[nodiscard]] EyeLight look(const Ray& ray, std::uint32_t seed) const;

    /// What a ray meets in false colour: the first surface that is not looked through.
    struct Met {
        Hit hit;             ///< none: the outside
        bool matt = false;   ///< scatters the light that arrives
        bool even = false;   ///< without a texture
        float facing = 1.0F; ///< cosine between the ray and its normal
    };
    [[nodiscard]] Met meet(Ray ray) const;
    [[nodiscard]] float illuminance(const Hit& hit) const { return luminance(lit_.irradiance(hit, shares_)); }

private:
    [[nodiscard]] Rgb beyond(const Ray& ray, int depth, float throughput, std::uint32_t seed) const;
    [[nodiscard]] Rgb over(const EyeSurface& at, int depth, float throughput, std::uint32_t seed) const;
    [[nodiscard]] Rgb on_way(const EyeSurface& at, const SpecularSample& way, int depth, float throughput,
                             std::uint32_t seed) const;

    const LitScene& lit_;
    const RayScene& rays_;
    Rgb sky_;
    int max_depth_;
    LightShares shares_;
};

} // namespace atrium
