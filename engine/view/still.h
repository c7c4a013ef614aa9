// Stills from a solution: camera rays, mirrors and glass followed to the first matt surface, whose light is read from the
// layers, or computed at every pixel.
#pragma once

#include "engine/base/result.h"
#include "engine/base/run_context.h"
#include "engine/io/image_file.h"
#include "engine/solver/solution.h"
#include "engine/view/false_color.h"

namespace atrium {

/// A camera placed in the world.
struct ViewCamera {
    dmat4 to_world{1.0}; ///< looks along its -z, +y up
    Camera lens;
};
/// Camera of the scene by name or index in tree order; without one (or with an empty name and none in the file) a view
/// from inside the room: from a corner of the largest shown volume at eye height towards the centre.
Result<ViewCamera> find_camera(const Scene& scene, const std::string& name_or_index);
ViewCamera default_camera(const Scene& scene);

struct StillOptions {
    int width = 1280;
    int height = 720;
    int samples_per_axis = 2;    ///< anti-aliasing: n x n stratified samples a pixel
    int max_specular_depth = 12; ///< 0 = nothing is seen over mirrors and glass, but what is straight behind clear panes
    /// Of the light on what the eye sees without a mirror or a refraction between. What shines itself (surfaces that emit,
    /// the sky) belongs to the direct share. Mirrors and glass show all light, so the shares and what these show add up.
    LightShares shares;
    /// Light is computed at every sample instead of read from the layers: straight from sun, sky and lamps, and over one
    /// reflection from what the layers hold where it comes from. Contacts and small things are as sharp as the picture;
    /// what is left to chance is grain. Caustics are the layers'. Takes `final_samples` a pixel, and minutes.
    bool final_pass = false;
    int final_samples = 64; ///< a pixel, rounded up to a power of two, 4096 at most
    bool gather = true;     ///< of the final pass: reflected light is gathered; else that is the layers' too, without grain
    std::uint32_t seed = 1; ///< of the final pass
};

/// The picture in parts that add up to it, and what the first surface is that a pixel shows (the first that is not looked
/// straight through, as clear panes are).
struct StillLayers {
    Picture direct;           ///< light straight from its source on what is seen without a bend, what shines itself, the sky
    Picture diffuse;          ///< light reflected by other surfaces
    Picture caustic;          ///< light over mirrors and glass
    Picture specular;         ///< what is seen over mirrors, metals and glass: all light there
    Picture albedo;           ///< reflectance; of mirrors and glass what they send on
    Picture normal;           ///< unit in world axes, averaged over the pixel; 0 outside
    std::vector<float> depth; ///< metres along the ray, averaged over the samples that meet something; 0 outside

    /// Linear radiance, cd/m2: the sum of the first four.
    [[nodiscard]] Picture beauty() const;
    /// All seven as channels "direct.R" ... "depth.Z" of an .exr file.
    [[nodiscard]] std::vector<PictureChannel> channels() const;
};

/// Called on the calling thread whenever a whole picture is there that is worth showing, ever better ones.
using StillWatcher = std::function<void(const StillLayers&)>;

/// Deterministic for any number of threads. Stops within some milliseconds with what it has (the rest black) when the
/// context says so; a final pass then has the mean of the samples that were done.
StillLayers render_layers(const Scene& scene, const Solution& solution, const ViewCamera& camera,
                          const StillOptions& options, const RunContext& context, const StillWatcher& watcher = {});
/// The sum alone.
Picture render_still(const Scene& scene, const Solution& solution, const ViewCamera& camera, const StillOptions& options,
                     const RunContext& context);

/// The same view in the colours of a scale (display values, for .png), contours included. Luminance is what the eye meets,
/// mirrors and glass included. Illuminance is that of the first matt surface, glass looked through; metals, mirrors and what
/// lies outside have none and are grey. `options.shares` count for both; it is read from the layers always.
Picture render_false_color(const Scene& scene, const Solution& solution, const ViewCamera& camera,
                           const StillOptions& options, const FalseColor& scale, const RunContext& context);

} // namespace atrium
