// What a long computation needs from its caller: may I go on, how far am I, until when.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string_view>

namespace atrium {

/// Shared stop flag. Copies refer to the same flag; request_stop() may be called from any thread.
class StopFlag {
public:
    StopFlag() : flag_(std::make_shared<std::atomic<bool>>(false)) {}
    void request_stop() const { flag_->store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool stop_requested() const { return flag_->load(std::memory_order_relaxed); }

private:
    std::shared_ptr<std::atomic<bool>> flag_;
};

/// One report of progress. `phase` is a static, untranslated name such as "visibility"; fraction is of the whole job.
struct Progress {
    std::string_view phase;
    double fraction = 0; ///< 0 to 1, never falls within one job
};

/// Handed down through every long call. progress() is called on the engine thread only (never inside a parallel loop).
struct RunContext {
    using Clock = std::chrono::steady_clock;

    StopFlag stop;
    Clock::time_point deadline = Clock::time_point::max();
    std::function<void(const Progress&)> on_progress;

    /// True when the caller asked to stop or the deadline has passed. Cheap enough for every chunk of a loop.
    [[nodiscard]] bool should_stop() const { return stop.stop_requested() || past_deadline(); }
    [[nodiscard]] bool past_deadline() const { return deadline != Clock::time_point::max() && Clock::now() >= deadline; }
    void progress(std::string_view phase, double fraction) const {
        if (on_progress) {
            on_progress({phase, fraction});
        }
    }
};

} // namespace atrium
