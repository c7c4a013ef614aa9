// Decides when to solve and when to stop. A pure class fed with events and time: no thread, no lock, no clock.
#pragma once

#include "engine/base/run_context.h"

#include <chrono>

namespace atrium {

/// One solve at a time, always of the newest scene. Outside a gesture an edit stops a stale solve at once; within a gesture
/// the solve runs on, so that there is light to see while dragging, until the hand rests or lets go.
class QualityScheduler {
public:
    using Time = RunContext::Clock::time_point;
    /// Within a gesture, this long without an edit counts as rest. Long enough that the pauses of a moving hand (mouse
    /// events come every 8 to 16 ms) never trigger it, short enough to feel like an answer.
    static constexpr std::chrono::milliseconds kRest{200};

    enum class Outcome : std::uint8_t {
        Final,   ///< the solution is complete
        Stopped, ///< it ended early
        Failed
    };
    enum class State : std::uint8_t { Idle, Solving, Stopped, Failed };

    /// Another document. `has_picture`: it came with a solution, so nothing runs until an edit; `complete`: a final one.
    void on_load(bool has_picture, bool complete);
    void on_edit(Time now, bool changes_light, bool in_gesture);
    void on_gesture_end();
    void on_cancel();
    void on_resume();
    void on_started();
    /// Reports the end of the solve that on_started() announced.
    void on_finished(Outcome outcome);
    /// Something other than a solve went wrong; nothing starts until the next edit or resume.
    void on_failure();

    /// Nothing runs and the newest scene wants a solve.
    [[nodiscard]] bool should_start() const { return !running_ && needed_ && !cancelled_ && !failed_; }
    /// The running solve is of no more use.
    [[nodiscard]] bool should_stop(Time now) const { return stop_time() <= now; }
    /// When should_stop() will become true if nothing else happens; Time::max() = never.
    [[nodiscard]] Time stop_time() const;
    /// The running solve is of a document that is gone: its pictures must not be shown.
    [[nodiscard]] bool abandoned() const { return abandoned_; }
    [[nodiscard]] bool running() const { return running_ && !abandoned_; }
    [[nodiscard]] State state() const;

private:
    bool running_ = false;
    bool needed_ = false;    ///< a solve must start after (or instead of) the running one
    bool complete_ = false;  ///< the newest scene has its final solution
    bool cancelled_ = false; ///< until the next edit of light or resume
    bool failed_ = false;    ///< likewise
    bool abandoned_ = false;
    bool stopping_ = false; ///< the running solve was cancelled and has not ended yet
    bool in_gesture_ = false;
    Time last_edit_{};
};

} // namespace atrium
