// Decides when to solve and when to stop. A pure class fed with events and time: no thread, no lock, no clock.
#pragma once

#include "engine/base/run_context.h"

#include <chrono>

namespace atrium {

/// One solve at a time, always of the newest scene. Outside a gesture an edit stops a stale solve at once. Within a gesture
/// light follows by hurried updates, if the engine keeps a complete solution to start from, and so it does after a single
/// edit. When the hand rests or lets go an exact update settles the light, and the full solve comes after it. Without a
/// complete solution the running solve goes on until the hand rests, so that there is light to see while dragging. Once all
/// is complete its error is measured; that is no work anybody waits for, and any edit of light ends it. Nor is preparing:
/// light that was stored is solved once more for what the engine keeps of it.
class QualityScheduler {
public:
    using Time = RunContext::Clock::time_point;
    /// Within a gesture, this long without an edit counts as rest. Long enough that the pauses of a moving hand (mouse
    /// events come every 8 to 16 ms) never trigger it, short enough to feel like an answer.
    static constexpr std::chrono::milliseconds kRest{200};

    enum class Outcome : std::uint8_t {
        Final,   ///< the solution is complete
        Hurried, ///< an update in a hurry is done: an exact one is still to come
        Settled, ///< an exact update is done: a full solve is still to come
        Unfit,   ///< the change was not one that can be done by an update
        Audited, ///< the error of the complete light is known
        Stopped, ///< it ended early
        Failed
    };
    enum class Kind : std::uint8_t { Full, Hurried, Settle, Audit };
    enum class State : std::uint8_t { Idle, Solving, Stopped, Failed };

    /// Another document. `has_picture`: it came with a solution, so nothing runs until an edit; `complete`: a final one.
    void on_load(bool has_picture, bool complete);
    /// Complete light came from a file, so that the engine keeps nothing of it: a full solve makes up for that.
    void on_prepare();
    void on_edit(Time now, bool changes_light, bool in_gesture);
    void on_gesture_end();
    void on_cancel();
    void on_resume();
    void on_started(Kind kind = Kind::Full);
    /// Reports the end of the solve that on_started() announced.
    /// `updatable`: the engine keeps what hurried updates start from. `audit`: the error of a final solution is wanted.
    void on_finished(Outcome outcome, bool updatable = false, bool audit = false);
    /// Something other than a solve went wrong; nothing starts until the next edit or resume.
    void on_failure();

    /// Nothing runs and the newest scene wants a solve, of this kind.
    [[nodiscard]] bool should_start(Time now) const { return start_time() <= now; }
    [[nodiscard]] Kind kind() const;
    /// When should_start() will become true if nothing else happens; Time::max() = never.
    [[nodiscard]] Time start_time() const;
    /// The running solve is of no more use.
    [[nodiscard]] bool should_stop(Time now) const { return stop_time() <= now; }
    /// When should_stop() will become true if nothing else happens; Time::max() = never.
    [[nodiscard]] Time stop_time() const;
    /// The running solve is of a document that is gone: its pictures must not be shown.
    [[nodiscard]] bool abandoned() const { return abandoned_; }
    [[nodiscard]] bool running() const { return running_ && !abandoned_; }
    [[nodiscard]] State state() const;
    /// The light on show follows a hand that has not let go, or has been followed by no full solve yet.
    [[nodiscard]] bool moving() const { return in_gesture_ && (unsettled_ || running_kind_ == Kind::Hurried); }
    [[nodiscard]] bool unsettled() const { return unsettled_; }
    /// The light on show is an exact update's; a full solve is to follow or runs.
    [[nodiscard]] bool refining() const { return refining_; }
    /// on_prepare() is being answered.
    [[nodiscard]] bool preparing() const { return prepare_ == Prepare::Running && running(); }

private:
    bool running_ = false;
    bool updatable_ = false; ///< hurried updates have something to start from
    bool unsettled_ = false; ///< the newest light was made in a hurry
    bool refining_ = false;  ///< the newest light is an exact update's
    enum class Prepare : std::uint8_t { No, Wanted, Running, Stopping };
    Prepare prepare_ = Prepare::No; ///< what became of on_prepare()
    Kind running_kind_ = Kind::Full;
    bool needed_ = false;    ///< a solve must start after (or instead of) the running one
    bool complete_ = false;  ///< the newest scene has its final solution
    bool cancelled_ = false; ///< until the next edit of light or resume
    bool failed_ = false;    ///< likewise
    bool abandoned_ = false;
    bool audit_due_ = false; ///< complete light whose error is not known
    bool stopping_ = false;  ///< the running solve was cancelled and has not ended yet
    bool in_gesture_ = false;
    Time last_edit_{};
};

} // namespace atrium
