// Stills from a solution: camera rays, mirrors and glass followed to the first diffuse surface, whose layer is read.
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
    int samples_per_axis = 2; ///< anti-aliasing: n x n stratified samples a pixel
    int max_specular_depth = 12;
    /// Of the light on what the eye sees without a mirror or a refraction between. What shines itself (surfaces that emit,
    /// the sky) belongs to the direct share. Mirrors and glass show all light, so the shares and what these show add up.
    LightShares shares;
};
/// Linear radiance picture, cd/m2. Deterministic. Stops with what it has (rest black) when the context says so.
Picture render_still(const Scene& scene, const Solution& solution, const ViewCamera& camera, const StillOptions& options,
                     const RunContext& context);

/// The same view in the colours of a scale (display values, for .png), contours included. Luminance is what the eye meets,
/// mirrors and glass included. Illuminance is that of the first matt surface, glass looked through; metals, mirrors and what
/// lies outside have none and are grey. `options.shares` count for both.
Picture render_false_color(const Scene& scene, const Solution& solution, const ViewCamera& camera,
                           const StillOptions& options, const FalseColor& scale, const RunContext& context);

} // namespace atrium
