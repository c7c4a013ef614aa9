// The truth that everything else is measured against: brute-force path tracing with its own standard error.
#pragma once

#include "engine/base/result.h"
#include "engine/base/run_context.h"
#include "engine/io/image_file.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <vector>

namespace atrium {

/// Which light transport the reference follows.
enum class Transport : std::uint8_t {
    /// What the light solution simulates in this version. Every surface scatters diffusely with `diffuse_reflectance` of its
    /// textured base colour: mirrors and metals count as diffuse reflectors, and glass reflects what `diffuse_reflectance`
    /// leaves it. Front sides reflect and emit, backs only where RaySurface::back_side says so; other backs are black.
    /// Light goes straight on through glass, holes and blended surfaces (RayScene::straight_through), unbent; a blended
    /// surface reflects and emits in proportion to its alpha. The sun is a disc of uniform radiance, the sky uniform;
    /// lamps are points.
    Diffuse
};

/// How long to go on. At least one of relative_error, paths and the context's deadline must end the run.
struct ReferenceSettings {
    Transport transport = Transport::Diffuse;
    std::uint32_t seed = 1;
    /// Standard error to reach, relative, at every point; points darker than 1 % of the mean count as that bright.
    /// 0 = no such aim.
    double relative_error = 0;
    std::uint64_t paths = 0; ///< per point or pixel, rounded up to whole rounds; 0 = no such limit
};

/// Where and how an illuminance meter stands.
struct ReferencePoint {
    dvec3 position{0.0};         ///< metres, world
    dvec3 normal{0.0, 1.0, 0.0}; ///< unit
};

struct ReferenceReading {
    Rgb irradiance{0.0F};      ///< lux
    double standard_error = 0; ///< of the illuminance (luminance of irradiance), lux
    bool on_surface = false;   ///< a surface within 1 cm faces the same way: the point was put on it
};

/// What a run was: the same figures for points and pictures.
struct ReferenceRun {
    std::uint64_t paths = 0; ///< per point or pixel
    std::uint64_t rays = 0;
    bool reached = false; ///< relative_error or paths was met; false = the deadline or a stop ended it
};

struct ReferenceReadings {
    std::vector<ReferenceReading> points; ///< in the order asked for
    ReferenceRun run;
};

/// Irradiance at points. Unbiased; the same bits for any number of threads where the clock did not end the run, and the mean
/// of whole rounds where it did. The standard error is that of 16 independent streams of paths. Stops within some
/// milliseconds; stopped before the first round is complete it is an error "stopped before the first estimate".
Result<ReferenceReadings> reference_irradiance(const Scene& scene, const std::vector<ReferencePoint>& points,
                                               const ReferenceSettings& settings, const RunContext& context);

/// A camera placed in the world, and its picture's size in pixels.
struct ReferenceView {
    dmat4 to_world{1.0}; ///< looks along its -z, +y up
    Camera lens;
    int width = 640;
    int height = 360;
};

struct ReferencePicture {
    Picture radiance;                  ///< cd/m2, box-filtered over each pixel
    std::vector<float> standard_error; ///< of each pixel's luminance, cd/m2
    ReferenceRun run;
};

/// The same for what a camera sees. Mirrors and glass look as the transport has them: in Transport::Diffuse, matt.
Result<ReferencePicture> reference_picture(const Scene& scene, const ReferenceView& view, const ReferenceSettings& settings,
                                           const RunContext& context);

} // namespace atrium
