// Solving for a wish: an error to be reached, or the best light in a time.
#pragma once

#include "engine/solver/gi_engine.h"

namespace atrium {

/// What is wished for instead of a quality. Without either it is one solution of options.quality.
struct SolveWish {
    double error = 0;          ///< relative rms of the irradiance as audits measure it (error_audit.h); 0 = no such wish
    bool best_in_time = false; ///< until the context's deadline: the finest light that is likely to be complete by then
    bool from_quality = false; ///< begins with options.quality instead of a draft
    bool audit = false;        ///< the error is measured even where nothing hangs on it
};

/// Begins with a draft, as a rule. For an error better ones follow until it is reached; in a time, the finest step that a
/// draft's time lets expect to be done. One wish sets everything: elements, rays, records, particles. What is begun in vain
/// does not replace what is complete; so the light is complete unless not even the draft was done in time. Audits may end 15
/// % later than the deadline, and the light is without figures if that is not enough. Errors as GiEngine::solve().
Result<std::shared_ptr<const Solution>>
solve_to_wish(GiEngine& engine, const Scene& scene, SolveOptions options, const SolveWish& wish, const RunContext& context,
              const std::function<void(std::shared_ptr<const Solution>)>& on_snapshot = {});

} // namespace atrium
