// A drag as the engine sees it: hurried updates step by step, exact ones after it, beside whole new solutions.
#pragma once

#include "engine/measure/light_difference.h"

#include <optional>
#include <vector>

namespace atrium {

/// Light while a node is dragged, against a new solution of the same scene.
struct FrameError {
    LightDifference followed; ///< of the hurried update
    LightDifference settled;  ///< of the exact update after it
    /// The same root mean squares where the drag has changed the light by more than 2 % of the mean, over the mean there:
    /// what one looks at.
    double followed_where_changed = 0;
    double settled_where_changed = 0;
    double stayed = 0;         ///< rel_rms that the light from before the drag would have
    double changed_share = 0;  ///< of all places
    double fresh_seconds = 0;  ///< what the new solution took
    double settle_seconds = 0; ///< what the exact update took
};

struct DragFrame {
    double seconds = 0; ///< of the hurried update
    std::uint64_t rays = 0;
    UpdateStatistics update;
    std::optional<FrameError> error; ///< of the frames that were looked at
};

struct DragMeasurement {
    double solve_seconds = 0; ///< of the solution that the drag starts from, with what updates keep
    Statistics solved;        ///< of that solution
    std::vector<DragFrame> frames;
    /// Of the hurried updates' times, the one that `share` of all are below.
    [[nodiscard]] double frame_seconds(double share) const;
    /// Mean over the frames that were looked at.
    [[nodiscard]] double mean_of(double FrameError::*seconds) const;
};

/// Solves, drags `node` through `positions` (in its parent's space) and takes the error at `checks` frames spread over the
/// drag, the last one among them, each at the cost of a new solution; after each of these the light is settled. A node that
/// is hidden comes with the first position. An error where the engine refuses, when stopped, or when there is nothing to do.
Result<DragMeasurement> measure_drag(Scene scene, NodeId node, const std::vector<dvec3>& positions, SolveOptions options,
                                     std::size_t checks, std::size_t points, const RunContext& context);

} // namespace atrium
