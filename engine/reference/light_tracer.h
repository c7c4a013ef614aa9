// Light forwards: what lamps send over mirrors and glass, which no path from the eye finds.
#pragma once

#include "engine/reference/aim.h"
#include "engine/reference/path_lights.h"
#include "engine/reference/start_guide.h"

#include <functional>
#include <span>

namespace atrium {

/// A straight stretch of a particle's way after it was mirrored or bent: from `from` to the next surface.
struct CausticLeg {
    vec3 from{0.0F};
    vec3 direction{0.0F}; ///< unit
    float length = 0.0F;  ///< metres; infinite where it leaves the scene
    Rgb flux{0.0F};       ///< lumen, for the mean over all particles: already over the probability of this way
    bool first = true;    ///< not scattered diffusely yet
    bool mirrored = true; ///< mirrored or bent since it was last scattered diffusely
    bool lands = false;   ///< ends on a side that is not black, nor all mirror or glass
    vec3 side{0.0F};      ///< unit normal of that side
    Rgb scattered{0.0F};  ///< lumen that the side reflects diffusely of it
};

/// Random particles of suns, lamps and emitters, aimed at what mirrors and bends light. One that meets a diffuse surface
/// first ends there, for paths find its light; after that it goes on over surfaces of all kinds. Emitters are those that
/// PathLights::small() tells, or all. Most start where a first look found that they land somewhere: where little of the
/// light gets to a mirror at all, as the sun's through a window, that is many times as many. Immutable; safe from any
/// thread.
class LightTracer {
public:
    enum class Emitters : std::uint8_t { Small, All };
    /// Who asks at a few `places` alone gets most of the particles near them, the nearer the more down to `radius` (metres);
    /// many are everywhere.
    LightTracer(const RayScene& rays, const PathLights& lights, Emitters emitters, std::span<const vec3> places = {},
                float radius = 0.0F);

    /// False where nothing can make a caustic.
    [[nodiscard]] bool useful() const { return !sources_.empty(); }
    using Visit = std::function<void(const CausticLeg&)>;
    /// Follows particle `index` of the stream `key`, a pure function of both. The flux of the legs is per particle: the
    /// mean over particles is the flux of the scene. `scatter` = false ends it where it first lands.
    void trace(std::uint64_t key, std::uint64_t index, bool scatter, const Visit& visit) const;

private:
    struct Source {
        enum class Kind : std::uint8_t { Sun, Lamp, Emitter } kind = Kind::Sun;
        std::uint32_t index = 0; ///< of the sun or lamp; of the surface
        std::uint32_t triangle = 0;
    };
    struct Start {
        Ray ray;
        Rgb flux{0.0F}; ///< over its probability
    };
    struct Numbers;
    void add(const Source& source, double weight);
    void add_emitters(Emitters emitters);
    void learn(std::span<const vec3> places, float radius);
    /// `at` picks the source and where it aims.
    [[nodiscard]] Start start(const StartGuide::Start& at, Numbers& numbers) const;
    [[nodiscard]] Start from_sun(const Source& source, const vec3& aim, Numbers& numbers) const;
    [[nodiscard]] Start from_lamp(const Source& source, const vec3& aim) const;
    [[nodiscard]] Start from_emitter(const Source& source, const vec3& aim, Numbers& numbers) const;
    void follow(const Start& begin, Numbers& numbers, bool scatter, const Visit& visit) const;

    const RayScene& rays_;
    const PathLights& lights_;
    Aim aim_;
    std::vector<Source> sources_;
    std::vector<double> cumulative_; ///< weight up to and including each source
    StartGuide guide_;
};

} // namespace atrium
