// One path of light, backwards from where it is measured. The estimator of the reference; nothing in it is shared with the
// solver but the ray scene and the materials.
#pragma once

#include "engine/reference/path_lights.h"
#include "engine/reference/path_sampler.h"
#include "engine/reference/surface_event.h"

#include <functional>

namespace atrium {

/// Where irradiance is asked for, in engine coordinates.
struct PathVertex {
    vec3 origin{0.0F}; ///< where rays start: the point itself, kept clear of its surface by clear_of()
    vec3 normal{0.0F}; ///< unit, of the receiving plane
};

/// Unbiased estimates of irradiance and radiance by single paths. Immutable; safe from any thread.
///
/// Vertices are where light scatters diffusely; between them a path goes straight through panes and over mirrors and glass
/// by sample_specular(). At every vertex lamps, suns and one point of an emitter are looked for by name (next-event
/// estimation); one more direction is followed. Emitters are weighted between both ways (balance heuristic); the sky counts
/// where a followed ray escapes, never by name. Emitters met over mirrors and glass count in full, for nothing else finds
/// them. What suns, lamps and small emitters (PathLights::small()) send over mirrors and glass before it first meets a
/// vertex is left out: no path from here finds it, LightTracer does. Paths end by Russian roulette alone, on their
/// throughput.
class PathTracer {
public:
    PathTracer(const Scene& scene, const RayScene& rays);

    /// Irradiance, lux.
    [[nodiscard]] Rgb irradiance(PathVertex vertex, PathSampler& sampler) const;
    /// Radiance towards the eye along a camera ray, cd/m2. One looks into rooms through the backs of one-sided walls, as in
    /// the viewport. `vertex_light`, if given, is called at the first vertex and returns irradiance to add there.
    using VertexLight = std::function<Rgb(const PathVertex&)>;
    [[nodiscard]] Rgb radiance(Ray ray, PathSampler& sampler, const VertexLight& vertex_light = {}) const;
    [[nodiscard]] const PathLights& lights() const { return lights_; }

    /// True when a path of at most `bounces` bounces meets any light: of many paths, a quick test for places that light does
    /// not reach, as the insides of furniture.
    [[nodiscard]] bool finds_light(PathVertex vertex, PathSampler& sampler, unsigned bounces) const;

private:
    /// What a ray met: the light that comes straight along it, and the vertex at which it goes on.
    struct Leg {
        Rgb seen{0.0F};    ///< emission and sky, weighted, cd/m2
        Rgb scatter{0.0F}; ///< reflectance at `next` over the probability of going there; zero = the path ends
        PathVertex next;
    };
    /// `density` of the ray's direction per solid angle, for weighting emitters; 0 = nothing else looks for them.
    Leg follow(Ray ray, float density, bool from_camera, PathSampler& sampler) const;
    Rgb lamps_and_suns(const PathVertex& v, const vec2& u, float pick, bool all_lamps) const;
    Rgb emitter(const PathVertex& v, const vec2& u, float pick) const;
    [[nodiscard]] Rgb emission(const SurfacePoint& at, const vec3& start, float density) const;

    const RayScene& rays_;
    PathLights lights_;
};

} // namespace atrium
