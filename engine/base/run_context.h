// What a long computation needs from its caller: may I go on, how far am I, until when.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

namespace atrium {

/// Shared stop flag. Copies refer to the same flag; every function may be called from any thread.
class StopFlag {
public:
    using Clock = std::chrono::steady_clock;

    void request_stop() const { state_->stop.store(true, std::memory_order_relaxed); }
    /// Stops at a time to come, unless another call puts it off; Clock::time_point::max() takes the request back. Once
    /// stop_requested() has said yes it is too late for either: loops have left things out, and whoever called them must
    /// hear the same answer.
    void request_stop_at(Clock::time_point time) const {
        state_->stop_at.store(time.time_since_epoch().count(), std::memory_order_relaxed);
    }
    /// For tests of stopping: every stop_requested() asks `watch` too, on any thread; true is a request to stop. Set before
    /// others know the flag; `watch` outlives their work.
    void watch(const std::function<bool()>* watch) const { state_->watch.store(watch, std::memory_order_release); }
    [[nodiscard]] bool stop_requested() const {
        if (const auto* watch = state_->watch.load(std::memory_order_acquire); watch != nullptr && (*watch)()) {
            request_stop();
        }
        if (state_->stop.load(std::memory_order_relaxed)) {
            return true;
        }
        const Clock::rep at = state_->stop_at.load(std::memory_order_relaxed);
        if (at == kNever || Clock::now().time_since_epoch().count() < at) { // the clock is read only when a time is set
            return false;
        }
        request_stop();
        return true;
    }

private:
    static constexpr Clock::rep kNever = Clock::time_point::max().time_since_epoch().count();
    struct State {
        std::atomic<bool> stop = false;
        std::atomic<Clock::rep> stop_at = kNever;
        std::atomic<const std::function<bool()>*> watch = nullptr;
    };
    std::shared_ptr<State> state_ = std::make_shared<State>();
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

/// For loops of many short steps on one thread: asks the context at every `stride`-th step and remembers a yes.
class StopCheck {
public:
    StopCheck(const RunContext& context, std::uint32_t stride) : context_(context), stride_(stride) {}
    /// Counts a step; true when the loop is to end.
    [[nodiscard]] bool operator()() {
        if (!stopped_ && ++steps_ >= stride_) {
            steps_ = 0;
            stopped_ = context_.should_stop();
        }
        return stopped_;
    }

private:
    const RunContext& context_;
    std::uint32_t stride_;
    std::uint32_t steps_ = 0;
    bool stopped_ = false;
};

/// Triangles or vertices between two questions: together a fraction of a millisecond to some milliseconds.
inline constexpr std::uint32_t kMeshStride = 1024;

} // namespace atrium
