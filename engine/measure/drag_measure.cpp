#include "engine/measure/drag_measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace atrium {
namespace {

constexpr double kChanged = 0.02; // of the mean: what counts as changed light

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::vector<double> read_illuminance(const Scene& scene, const Solution& solution, const std::vector<SensorPlace>& places) {
    std::vector<double> out;
    for (const SensorReading& reading : read_surfaces(scene, solution, places)) {
        out.push_back(reading.on_surface ? double(luminance(reading.irradiance)) : 0.0);
    }
    return out;
}

/// Root mean square of the difference where `changed`, over the mean of the truth there.
double rms_where(const std::vector<double>& light, const std::vector<double>& truth, const std::vector<bool>& changed) {
    double square = 0.0;
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        if (changed[i]) {
            square += (light[i] - truth[i]) * (light[i] - truth[i]);
            sum += truth[i];
            count += 1.0;
        }
    }
    return sum > 0.0 ? std::sqrt(square / count) / (sum / count) : 0.0;
}

/// What frames are compared with, and where.
struct Truth {
    std::shared_ptr<const Solution> before; ///< of the scene before the drag
    std::size_t points = 0;
    SolveOptions options;
};

Result<FrameError> frame_error(GiEngine& engine, const Scene& scene, const Solution& followed, const Truth& truth,
                               const RunContext& context) {
    FrameError out;
    SolveOptions settle = truth.options;
    settle.settle = true;
    const auto settling = Clock::now();
    const auto settled = engine.update(scene, settle, context);
    out.settle_seconds = seconds_since(settling);
    if (!settled) {
        return tl::unexpected(settled.error());
    }
    GiEngine other;
    SolveOptions anew = truth.options;
    anew.keep_for_updates = false;
    const auto solving = Clock::now();
    const auto fresh = other.solve(scene, anew, context);
    out.fresh_seconds = seconds_since(solving);
    if (!fresh) {
        return tl::unexpected(fresh.error());
    }
    if (!(*fresh)->final) {
        return fail("", "", "stopped before the light was complete", "Give it more time.");
    }
    const std::vector<SensorPlace> places = seen_places(scene, truth.points);
    out.followed = light_difference(scene, followed, **fresh, places);
    out.settled = light_difference(scene, **settled, **fresh, places);
    out.stayed = light_difference(scene, *truth.before, **fresh, places).rel_rms;
    const std::vector<double> now = read_illuminance(scene, **fresh, places);
    const std::vector<double> then = read_illuminance(scene, *truth.before, places);
    double mean = 0.0;
    for (const double e : now) {
        mean += e / double(now.size());
    }
    std::vector<bool> changed;
    for (std::size_t i = 0; i < now.size(); ++i) {
        changed.push_back(std::abs(now[i] - then[i]) > kChanged * mean);
        out.changed_share += changed.back() ? 1.0 / double(now.size()) : 0.0;
    }
    out.followed_where_changed = rms_where(read_illuminance(scene, followed, places), now, changed);
    out.settled_where_changed = rms_where(read_illuminance(scene, **settled, places), now, changed);
    return out;
}

} // namespace

double DragMeasurement::frame_seconds(double share) const {
    std::vector<double> seconds;
    for (const DragFrame& frame : frames) {
        seconds.push_back(frame.seconds);
    }
    std::sort(seconds.begin(), seconds.end());
    return seconds.empty() ? 0.0 : seconds[std::min(seconds.size() - 1, std::size_t(share * double(seconds.size())))];
}

double DragMeasurement::mean_of(double FrameError::*seconds) const {
    double sum = 0.0;
    double count = 0.0;
    for (const DragFrame& frame : frames) {
        if (frame.error) {
            sum += (*frame.error).*seconds;
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : 0.0;
}

Result<DragMeasurement> measure_drag(Scene scene, NodeId node, const std::vector<dvec3>& positions, SolveOptions options,
                                     std::size_t checks, std::size_t points, const RunContext& context) {
    if (positions.empty() || scene.nodes.find(node) == nullptr) {
        return fail("", "", "there is no drag to measure", "Name a node of the scene and at least one position.");
    }
    DragMeasurement out;
    options.keep_for_updates = true;
    GiEngine engine;
    const auto start = Clock::now();
    const auto before = engine.solve(scene, options, context);
    out.solve_seconds = seconds_since(start);
    if (!before) {
        return tl::unexpected(before.error());
    }
    if (!(*before)->final) {
        return fail("", "", "stopped before the light was complete", "Give it more time.");
    }
    out.solved = (*before)->statistics;
    checks = std::min(checks, positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        Node& moved = *scene.nodes.find(node);
        moved.transform.translation = positions[i];
        moved.visible = true;
        const auto asked = Clock::now();
        const auto followed = engine.update(scene, options, context);
        DragFrame frame;
        frame.seconds = seconds_since(asked);
        if (!followed) {
            return tl::unexpected(followed.error());
        }
        frame.rays = (*followed)->statistics.rays;
        frame.update = (*followed)->statistics.update;
        // Frames (k + 1) n / checks - 1: evenly apart, the last one among them.
        if ((i + 1) * checks / positions.size() > i * checks / positions.size()) {
            auto error = frame_error(engine, scene, **followed, {*before, points, options}, context);
            if (!error) {
                return tl::unexpected(error.error());
            }
            frame.error = std::move(*error);
        }
        out.frames.push_back(std::move(frame));
    }
    return out;
}

} // namespace atrium
