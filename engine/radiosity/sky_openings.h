// Where the sky looks into rooms through no glass: found once per scene, by looking out.
#pragma once

#include "engine/base/run_context.h"
#include "engine/radiosity/sky_window.h"

namespace atrium {

/// What a few hundred places on the surfaces of a scene see of the sky.
struct SkyOpenings {
    /// Rectangles just large enough for what is seen through them from inside: open windows and doors, roof openings, walls
    /// that are not there. A direction belongs to the first that it crosses.
    std::vector<SkyWindow> windows;
    /// Some sky is seen through neither these nor panes. False means: none of more than 100,000 rays did, and to look for
    /// it from any other place is not worth a ray.
    bool elsewhere = true;
};

/// Looks for openings. Deterministic for any number of threads. When asked to stop, what it returns is right but slow to
/// use: no windows, sky elsewhere.
SkyOpenings find_sky_openings(const RayScene& rays, const RunContext& context);

} // namespace atrium
