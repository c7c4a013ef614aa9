// Light at one point by chance, without bias: straight from its sources, and over one reflection from a lit scene.
#pragma once

#include "engine/radiosity/direct_light.h"
#include "engine/view/lit_pieces.h"
#include "engine/view/pixel_sampler.h"

namespace atrium {

/// Irradiance at a point by one sample of each kind, lux.
struct PointLight {
    Rgb direct{0.0F};  ///< sun, lamps, sky and what shines, straight and over one flat mirror
    Rgb diffuse{0.0F}; ///< what other surfaces reflect

    [[nodiscard]] Rgb sum() const { return direct + diffuse; }
};

/// Immutable; safe from any thread. Lit scene and ray scene must outlive it.
class FinalLight {
public:
    /// `rays` = the scene as it was solved. `mirror_images`: what stands out over one flat mirror is direct light; without,
    /// the caustic share of the layers holds it. `gathers`: reflected light is asked for.
    FinalLight(const Scene& scene, const RayScene& rays, const LitScene& lit, bool mirror_images, bool gathers,
               const RunContext& context);

    /// At a point clear of its surface, in engine coordinates of the lit scene, with unit normal. Numbers are the sampler's
    /// groups from `group` on (kGroups of them). What comes over mirrors and glass from what stands out is left out but for
    /// the images: it is the caustic share.
    [[nodiscard]] PointLight at(const vec3& point, const vec3& normal, const PixelSampler& sampler, std::uint32_t group,
                                int depth = 0) const;
    static constexpr std::uint32_t kGroups = 3;

private:
    [[nodiscard]] Rgb lamps(const vec3& point, const vec3& normal, const vec2& u, float pick, const MirrorSight* over) const;
    [[nodiscard]] Rgb sky_windows(const vec3& point, const vec3& normal, const vec2& u, float pick) const;
    [[nodiscard]] std::size_t windows_crossed(const vec3& point, const vec3& direction) const;
    /// One bright spot: what it emits and what it reflects, irradiance, weighed against rays of the hemisphere.
    void spot(const vec3& point, const vec3& normal, float which, const vec2& where, PointLight& out) const;
    [[nodiscard]] Rgb spot_over(const MirrorSight& over, float which, const vec2& where) const;
    void gather(const vec3& point, const vec3& normal, const vec2& u, const PixelSampler& sampler, std::uint32_t group,
                int depth, PointLight& out) const;

    const RayScene& rays_;
    const LitScene& lit_;
    vec3 to_rays_{0.0F}; ///< from the lit scene's engine coordinates to those of `rays`
    DirectLight lights_;
    PlanarMirrors mirrors_;
    LitPieces spots_;
    std::vector<bool> named_; ///< per surface of the lit scene: shines so much that particles carry it over mirrors
    bool gathers_ = true;
    float near_ = 0.0F; ///< metres: what is closer is not read from layers but looked at itself
};

} // namespace atrium
