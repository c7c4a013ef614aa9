// Brute-force light at random points of a scene, kept between runs, and how far the engine's light is from it.
#pragma once

#include "engine/scene/scene.h"
#include "engine/solver/gi_engine.h"

#include <filesystem>
#include <string>
#include <vector>

namespace atrium::bench {

/// A place on a diffuse surface side that light can reach, with what the reference says.
struct Probe {
    SensorPlace place;
    std::string node;
    bool seen = true; ///< LitPlace::seen()
    Rgb irradiance{0.0F};
    double standard_error = 0;
};

struct Reference {
    std::vector<Probe> probes;
    double paths = 0; ///< per point
    unsigned runs = 0;
};

/// Where references come from.
struct ReferenceOptions {
    std::string cache;         ///< folder that keeps them by a hash of the scene's files; empty = none
    std::size_t points = 2000; ///< per scene
    double time = 60.0;        ///< seconds for one that is not in the cache
    bool extend = false;       ///< spend that time on cached ones as well
};

/// Reads the reference of a scene from the cache or computes it; `daylight` tells that the scene got its light from
/// add_daylight(). False, with a message, when there is none.
bool get_reference(const std::filesystem::path& file, const Scene& scene, bool daylight, const ReferenceOptions& options,
                   Reference& out);

/// Leaves out places where none of the reference's paths found light.
void drop_dark(std::vector<Probe>& probes);

/// How far readings are from the reference. A point's relative difference is (E - R) / max(R, 5 % of the mean R).
struct Row {
    std::size_t points = 0;
    std::size_t unread = 0; ///< points at which the solution has no layer: shown black, counted as such
    double rms = 0;         ///< root of its mean square, less the reference's own variance
    double rms_seen = 0;    ///< the same without gaps (LitPlace::seen())
    double rms_spread = 0;  ///< standard error of rms from the choice of points and the reference's noise
    double bias = 0;
    double p50 = 0, p95 = 0, p99 = 0;
    double noise = 0;          ///< root mean square of the reference's relative standard errors
    double reference_bias = 0; ///< standard error of the reference's mean, relative
};

/// Compares readings, one for each probe; `relative` gets each point's difference.
Row compare(const std::vector<Probe>& probes, const std::vector<SensorReading>& readings, std::vector<double>& relative);

} // namespace atrium::bench
