// Light of the sky at a point: through panes and openings by name, past them by looking around.
#pragma once

#include "engine/radiosity/edge_grid.h"
#include "engine/radiosity/sky_openings.h"

namespace atrium {

/// Irradiance with a figure for its own uncertainty.
struct DirectSample {
    Rgb irradiance{0.0F};
    float variance = 0.0F; ///< of luminance(irradiance), lux^2, from the visibility samples
};

/// Immutable but for set_radiance(); safe from any thread. `rays` must outlive it.
class SkyLight {
public:
    /// `radiance`: of the sky, the same from everywhere, cd/m2; where it is black nothing is done. Looking for openings
    /// takes some tenths of a second and stops when asked: what is then left is right, but slower and noisier to use.
    SkyLight(const Rgb& radiance, const RayScene& rays, const RunContext& context);

    [[nodiscard]] bool empty() const { return !(max_component(radiance_) > 0.0F); }
    [[nodiscard]] const Rgb& radiance() const { return radiance_; }
    /// Another brightness of the same sky: what it shines through stays. Not from black, and not while anybody reads.
    void set_radiance(const Rgb& radiance) { radiance_ = radiance; }
    /// Openings without glass that were found.
    /// Panes, then openings.
    [[nodiscard]] std::span<const SkyWindow> windows() const { return windows_; }
    /// Some sky is seen past the windows, or may be.
    [[nodiscard]] bool elsewhere() const { return elsewhere_; }
    [[nodiscard]] std::span<const SkyWindow> openings() const { return std::span(windows_).subspan(first_opening_); }
    /// Irradiance at a point. Windows and the hemisphere past them are looked at coarsely, then closer where neighbouring
    /// rays see differently, until what that leaves uncertain is about 1 / (10 sqrt(sky_rays)) of the light, or about twice
    /// as many rays are spent on windows and four times as many past them. The pattern is the same at every point: no noise
    /// between neighbours. The variance is that of edges found; what no ray has met, such as a bar between the first 16 to a
    /// window, is not in it.
    [[nodiscard]] DirectSample irradiance(const vec3& point, const vec3& normal, unsigned sky_rays) const;

private:
    /// What rays to places on a window (of the unit square) see through it, and the places' weights.
    void look_through(std::size_t window, const WindowPoints& points, const vec3& from, EdgeGrid& grid) const;
    void look_elsewhere(const vec3& point, const vec3& normal, EdgeGrid& grid) const;
    void add_windows(const vec3& point, const vec3& normal, unsigned sky_rays, DirectSample& out) const;
    void add_elsewhere(const vec3& point, const vec3& normal, unsigned sky_rays, DirectSample& out) const;
    /// Index in windows_ of the first opening that a ray crosses, kNone where it crosses none. The one rule by which a
    /// direction is counted once, however openings lie over one another.
    [[nodiscard]] std::size_t first_opening(const vec3& point, const vec3& direction) const;
    static constexpr std::size_t kNone = ~std::size_t(0);

    const RayScene& rays_;
    Rgb radiance_;
    std::vector<SkyWindow> windows_; ///< panes, then openings
    std::size_t first_opening_ = 0;
    bool elsewhere_ = true;
};

} // namespace atrium
