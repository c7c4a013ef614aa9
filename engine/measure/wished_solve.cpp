#include "engine/measure/wished_solve.h"

#include "engine/measure/error_audit.h"

#include <chrono>

namespace atrium {
namespace {

using Clock = RunContext::Clock;
using Quality = SolverSettings::Quality;

constexpr double kAuditGrace = 0.15; // of the time wished for, after the deadline
constexpr double kLikely = 1.1;      // time that a step must find left over what it is expected to take

/// One step of quality, and what it takes over what a draft does, about (tests/bench/RESULTS.md).
struct Step {
    Quality quality;
    double target; ///< SolveOptions::target_error
    double cost;
    bool whole; ///< a step on the way to an error; the others are for times in between
};
constexpr Step kSteps[] = {{Quality::Draft, 0.0, 1.0, true},
                           {Quality::Normal, 0.10, 3.5, false},
                           {Quality::Normal, 0.0, 5.0, true},
                           {Quality::Fine, 0.04, 16.0, false},
                           {Quality::Fine, 0.0, 32.0, true}};
constexpr std::size_t kNoStep = std::size(kSteps);

double seconds_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

class WishedSolve {
public:
    WishedSolve(GiEngine& engine, const Scene& scene, SolveOptions options, const SolveWish& wish, const RunContext& context,
                const std::function<void(std::shared_ptr<const Solution>)>& on_snapshot)
        : engine_(engine), scene_(scene), options_(options), wish_(wish), context_(context), on_snapshot_(on_snapshot) {
        wish_.best_in_time = wish_.best_in_time && context.deadline != Clock::time_point::max();
    }

    Result<std::shared_ptr<const Solution>> run() {
        if (!(wish_.error > 0.0) && !wish_.best_in_time) {
            auto only = engine_.solve(scene_, options_, context_, on_snapshot_);
            return only ? looked_at(*only) : only;
        }
        Result<std::shared_ptr<const Solution>> best = nullptr;
        for (std::size_t step = first_step(); step != kNoStep;) {
            options_.quality = kSteps[step].quality;
            options_.target_error = kSteps[step].target;
            const Clock::time_point before = Clock::now();
            auto next = engine_.solve(scene_, options_, context_, on_snapshot_);
            const bool complete = next && (*next)->final;
            if (!complete && best && *best != nullptr) {
                break; // begun in vain
            }
            best = next ? looked_at(*next) : std::move(next);
            if (!complete || reached(**best)) {
                break;
            }
            options_.skip_first_picture = true; // better light is there
            step = next_step(step, seconds_between(before, Clock::now()) / kSteps[step].cost);
        }
        return best;
    }

private:
    [[nodiscard]] bool reached(const Solution& light) const {
        return wish_.error > 0.0 && light.statistics.audit.points > 0 && light.statistics.error_estimate <= wish_.error;
    }

    [[nodiscard]] std::size_t first_step() const {
        std::size_t step = 0;
        while (wish_.from_quality && !(kSteps[step].quality == options_.quality && kSteps[step].whole)) {
            ++step;
        }
        return step;
    }

    /// The step after `step`, where a draft takes `unit` seconds.
    [[nodiscard]] std::size_t next_step(std::size_t step, double unit) const {
        const double left = seconds_between(Clock::now(), context_.deadline);
        const auto fits = [&](std::size_t i) { return unit * kSteps[i].cost * kLikely < left; };
        if (wish_.error > 0.0) {
            for (std::size_t i = step + 1; i < kNoStep; ++i) {
                if (kSteps[i].whole) {
                    return wish_.best_in_time && !fits(i) ? kNoStep : i;
                }
            }
            return kNoStep;
        }
        std::size_t finest = kNoStep;
        for (std::size_t i = step + 1; i < kNoStep; ++i) {
            finest = fits(i) ? i : finest;
        }
        return finest;
    }

    /// Measures the error where that is wished. Light that was stopped gets a quick look.
    [[nodiscard]] std::shared_ptr<const Solution> looked_at(std::shared_ptr<const Solution> light) const {
        if (!wish_.audit && !(wish_.error > 0.0)) {
            return light;
        }
        context_.progress("audit", 1.0);
        RunContext looking;
        looking.stop = context_.stop;
        if (wish_.best_in_time) {
            const double whole = std::max(seconds_between(started_, context_.deadline), 0.0);
            looking.deadline = context_.deadline + std::chrono::duration_cast<Clock::duration>(
                                                       std::chrono::duration<double>(kAuditGrace * whole));
        }
        AuditSettings settings = audit_settings(light->final ? options_.quality : Quality::Draft);
        settings.seed = options_.seed;
        return audited(scene_, std::move(light), settings, looking);
    }

    GiEngine& engine_;
    const Scene& scene_;
    SolveOptions options_;
    SolveWish wish_;
    const RunContext& context_;
    const std::function<void(std::shared_ptr<const Solution>)>& on_snapshot_;
    Clock::time_point started_ = Clock::now();
};

} // namespace

Result<std::shared_ptr<const Solution>>
solve_to_wish(GiEngine& engine, const Scene& scene, SolveOptions options, const SolveWish& wish, const RunContext& context,
              const std::function<void(std::shared_ptr<const Solution>)>& on_snapshot) {
    return WishedSolve(engine, scene, options, wish, context, on_snapshot).run();
}

} // namespace atrium
