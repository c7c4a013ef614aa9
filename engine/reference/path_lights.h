// Where light comes from, as the brute-force reference picks it: lamps, suns and emitting triangles.
#pragma once

#include "engine/raycast/ray_scene.h"
#include "engine/reference/web_reading.h"

#include <vector>

namespace atrium {

/// Lamps and emitting triangles of a scene in engine coordinates. Immutable; safe from any thread.
class PathLights {
public:
    PathLights(const Scene& scene, const RayScene& rays);

    /// A point or spot light.
    struct Lamp {
        Light light;
        vec3 position{0.0F};
        vec3 axis{0.0F, 0.0F, -1.0F}; ///< unit, the way it shines
        dmat3 from_world{1.0};        ///< turns directions into the light's own axes
        /// Luminous intensity towards a unit direction from the lamp, candela.
        [[nodiscard]] float candela(const vec3& away) const;
        /// Illuminance at x on a plane with unit normal n where nothing stands between, lux.
        [[nodiscard]] Rgb irradiance(const vec3& x, const vec3& n) const;
    };
    /// A directional light: a disc of uniform radiance, or a parallel beam.
    struct Sun {
        Rgb normal_irradiance{0.0F};       ///< lux on a surface that faces it
        vec3 towards{0.0F, 1.0F, 0.0F};    ///< unit, to the centre of the disc
        float one_minus_cos_radius = 0.0F; ///< of the disc's angular radius; 0 = parallel
        /// Direction to a point of the disc, uniform in solid angle.
        [[nodiscard]] vec3 sample(const vec2& u) const;
        /// Factor of normal_irradiance * cosine of a sampled direction: mean cosine over the disc, inverted.
        [[nodiscard]] float weight() const { return 1.0F / (1.0F - 0.5F * one_minus_cos_radius); }
    };
    /// A point of an emitting triangle.
    struct EmitterPoint {
        std::uint32_t surface = 0;
        std::uint32_t triangle = 0;
        vec2 barycentric{0.0F};
        vec3 position{0.0F};
        vec3 normal{0.0F};          ///< of the front, unit
        float area_probability = 0; ///< per square metre of this triangle
    };

    [[nodiscard]] const std::vector<Lamp>& lamps() const { return lamps_; }
    [[nodiscard]] const std::vector<Sun>& suns() const { return suns_; }
    [[nodiscard]] const Rgb& sky_radiance() const { return sky_; }
    [[nodiscard]] bool has_emitters() const { return !emitters_.empty(); }
    /// An emitting surface so small that no path finds it by chance: below the square of a tenth of the scene's
    /// diagonal.
    [[nodiscard]] bool small(std::uint32_t surface) const { return small_[surface]; }
    /// Mean luminance of a triangle's emission, cd/m2, as far as it matters for picking; 0 where it does not emit.
    [[nodiscard]] float brightness(std::uint32_t surface, std::uint32_t triangle) const {
        return area_probability(surface, triangle) * float(cumulative_.empty() ? 0.0 : cumulative_.back());
    }
    /// Picks a triangle in proportion to its power by `pick`, and a point on it by `u`, both in [0,1).
    [[nodiscard]] EmitterPoint sample_emitter(float pick, const vec2& u) const;
    /// Probability per square metre with which sample_emitter() picks points of a triangle; 0 where it does not emit.
    [[nodiscard]] float area_probability(std::uint32_t surface, std::uint32_t triangle) const {
        return density_[surface].empty() ? 0.0F : density_[surface][triangle];
    }

private:
    struct Emitter {
        std::uint32_t surface = 0;
        std::uint32_t triangle = 0;
    };
    void add_emitters();

    const RayScene& rays_;
    std::vector<Lamp> lamps_;
    std::vector<Sun> suns_;
    Rgb sky_{0.0F};
    std::vector<Emitter> emitters_;
    std::vector<bool> small_;                 ///< per surface
    std::vector<double> cumulative_;          ///< power up to and including each emitter
    std::vector<std::vector<float>> density_; ///< per surface (empty = none emits) and triangle, per square metre
};

} // namespace atrium
