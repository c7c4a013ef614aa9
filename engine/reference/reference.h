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
    /// All of L(D|S)*D. Surfaces scatter diffusely with diffuse_reflectance() of their textured base colour and mirror or
    /// refract by sample_specular(); light goes straight on through clear sheets and slabs, holes and blended surfaces
    /// (RayScene::straight_through()). Front sides reflect and emit, backs only where RaySurface::back_side says so; other
    /// backs are black, but glass is the same from both sides. The sun is a disc of uniform radiance, the sky uniform;
    /// lamps are points. No eye path looks straight at sun or lamps: mirrors do not show them.
    Full
};

/// How long to go on. At least one of relative_error, paths and the context's deadline must end the run.
struct ReferenceSettings {
    Transport transport = Transport::Full;
    std::uint32_t seed = 1;
    /// What suns, lamps and small emitters send over mirrors and glass is counted in a disc of this radius about each point
    /// (in pictures about what each path of the eye comes to first), metres: such light is blurred by as much where it comes
    /// over them last, and in pictures after further bounces too. Larger discs settle sooner. 0 = a thousandth of the
    /// scene's diagonal (5 mm in a room of 5 m), three thousandths in pictures.
    float caustic_radius = 0.0F;
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

/// Irradiance at points. Unbiased but for the blur of caustics: paths find all other light, and particles traced from the
/// sources bring caustics with all that becomes of them over further bounces. The same bits for any number of threads where
/// the clock did not end the run, and the mean of whole rounds where it did. The standard error is that of 16 independent
/// streams of paths. Stops within some milliseconds; stopped before the first round is complete it is an error "stopped
/// before the first estimate".
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

/// The same for what a camera sees. Caustics are dark within their radius of outer edges.
Result<ReferencePicture> reference_picture(const Scene& scene, const ReferenceView& view, const ReferenceSettings& settings,
                                           const RunContext& context);

/// Where caustics are asked for: the front of a rectangle, real or in the air.
struct ReferenceRectangle {
    dvec3 corner{0.0};      ///< metres, world
    dvec3 u{1.0, 0.0, 0.0}; ///< its edges from there, at right angles, metres
    dvec3 v{0.0, 0.0, 1.0};
    dvec3 normal{0.0, 1.0, 0.0}; ///< towards the light that counts
};

/// At least one of particles and the context's deadline must end the run.
struct CausticReferenceSettings {
    std::uint64_t particles = 0; ///< aimed at mirrors and glass, rounded up to a multiple of 16; 0 = no such limit
    std::uint32_t seed = 1;
};

struct ReferenceCaustics {
    std::size_t width = 0; ///< texels along u
    std::size_t height = 0;
    std::vector<Rgb> irradiance;        ///< mean over each texel, lux, row by row from the corner
    std::vector<double> standard_error; ///< of its luminance, lux
    std::uint64_t particles = 0;
    std::uint64_t rays = 0;
};

/// Light that comes to a rectangle over mirrors and glass alone (LS+D) from suns, point and spot lights and emitters of any
/// size, as means over nx times ny texels, by random particles. Unbiased; the same bits for any number of threads where the
/// clock did not end the run, and the mean of whole rounds of 131,072 particles where it did. Stopped before the first round
/// is complete it is an error "stopped before the first estimate". Needs 400 bytes a texel.
Result<ReferenceCaustics> reference_caustics(const Scene& scene, const ReferenceRectangle& rectangle, std::size_t nx,
                                             std::size_t ny, const CausticReferenceSettings& settings,
                                             const RunContext& context);

} // namespace atrium
