#include "engine/session/script_player.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace atrium {
namespace {

using Clock = RunContext::Clock;
using Picture = std::shared_ptr<const Solution>;

// Signals and the time limit wake nobody: how often they are looked for.
constexpr std::chrono::milliseconds kLook{10};

double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

UpdateStatistics update_of(const Picture& picture, std::uint64_t revision) {
    return picture != nullptr && picture->revision >= revision ? picture->statistics.update : UpdateStatistics{};
}

} // namespace

struct ScriptPlayer::Impl {
    struct Frame {
        std::uint64_t revision = 0;
        bool changed = true;
        Clock::time_point posted;
        FrameReport report;
    };

    Impl(Scene first, const Picture& stored, EngineSession::SolveFunction solve, const RunContext& run)
        : context(run), stage(std::move(first)), session([this] { on_wake(); }, watched(std::move(solve))) {
        session.load(stage.scene(), revision, stored);
    }

    // ---- the session's thread ----

    /// The solve with the script's time limit and progress, and known to run while it runs.
    EngineSession::SolveFunction watched(EngineSession::SolveFunction solve) {
        return [this, solve = std::move(solve)](const Scene& scene, const SolveOptions& options, const RunContext& given,
                                                const auto& on_snapshot) {
            RunContext run = given;
            run.deadline = std::min(run.deadline, context.deadline);
            run.on_progress = [&](const Progress& progress) {
                if (given.on_progress) {
                    given.on_progress(progress);
                }
                if (context.on_progress) {
                    context.on_progress(progress);
                }
            };
            const std::shared_ptr<void> mark = mark_running();
            return solve(scene, options, run, on_snapshot);
        };
    }
    std::shared_ptr<void> mark_running() {
        const std::lock_guard lock(mutex);
        running = true;
        at_rest = false;
        return {this, [](Impl* self) {
                    const std::lock_guard unlock(self->mutex);
                    self->running = false;
                }};
    }

    void on_wake() {
        {
            const std::lock_guard lock(mutex);
            at_rest = !running;
            ++wakes;
        }
        answer_frames();
        changed.notify_all();
    }

    // ---- any thread ----

    /// Finds the frames that what is shown now includes.
    void answer_frames() {
        const SessionStatus status = session.status();
        const Picture picture = session.latest(); // as new as the status or newer
        const auto now = Clock::now();
        const std::lock_guard lock(mutex);
        for (Frame& frame : frames) {
            if (!frame.report.latency && picture != nullptr && status.shown_revision >= frame.revision) {
                frame.report.latency = seconds(now - frame.posted);
                frame.report.update = frame.changed ? update_of(picture, frame.revision) : UpdateStatistics{};
            }
        }
        if (let_go && !settled && picture != nullptr && status.shown_revision >= status.posted_revision && !status.moving &&
            !status.settling && !picture->statistics.update.degraded && (picture->final || status.refining)) {
            settled = seconds(now - *let_go);
            settled_light = picture->final ? nullptr : picture;
        }
    }

    // ---- the caller's thread ----

    void post(const std::optional<SceneEdit>& edit, bool in_gesture) {
        revision += edit ? 1 : 0; // else the scene was so already
        {
            const std::lock_guard lock(mutex);
            frames.push_back({revision, edit.has_value(), Clock::now(), {}});
        }
        if (edit) {
            session.post(*edit, revision, in_gesture);
        }
        answer_frames(); // light that need not change is there already
    }

    /// Until `done`, or until it is time to stop: then false, and nothing runs any more.
    template <class F> bool wait(const F& done) {
        std::uint64_t seen = 0;
        while (!context.should_stop()) {
            {
                const std::lock_guard lock(mutex);
                seen = wakes;
            }
            if (done()) {
                return true;
            }
            std::unique_lock lock(mutex);
            changed.wait_for(lock, kLook, [&] { return wakes != seen; });
        }
        if (done()) {
            return true;
        }
        session.cancel();
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return at_rest; });
        return false;
    }
    bool wait_until(Clock::time_point time) {
        while (!context.should_stop()) {
            const auto now = Clock::now();
            if (now >= time) {
                return true;
            }
            std::unique_lock lock(mutex);
            changed.wait_until(lock, std::min(time, now + kLook));
        }
        return false;
    }

    /// Nothing is left to solve: all is shown, or it failed.
    [[nodiscard]] bool idle() const {
        const SessionStatus::State state = session.status().state;
        return state == SessionStatus::State::Idle || state == SessionStatus::State::Failed;
    }
    /// A solve that met the time limit before its first picture has failed, too, as far as the session knows.
    [[nodiscard]] Result<bool> unless_failed(bool done) const {
        const SessionStatus status = session.status();
        if (done && status.state == SessionStatus::State::Failed) {
            if (!context.should_stop()) {
                return fail("", "", status.message);
            }
            return false;
        }
        return done;
    }
    [[nodiscard]] bool current() const {
        const SessionStatus status = session.status();
        return session.latest() != nullptr && status.shown_revision >= status.posted_revision;
    }
    Result<bool> settle() {
        return unless_failed(wait([&] { return idle(); })).map([&](bool done) {
            return done && current() && session.latest()->final; // the solve may have met the time limit
        });
    }
    Result<bool> all_shown() {
        return unless_failed(wait([&] {
            const std::lock_guard lock(mutex);
            return idle() || std::all_of(frames.begin(), frames.end(), [](const Frame& f) { return f.report.latency; });
        }));
    }

    /// Posts the positions on the clock; the hand lets go one interval after the last. False when it was stopped.
    Result<bool> drag(const ScriptDrag& drag) {
        const auto interval =
            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double, std::milli>(drag.interval_ms));
        auto due = Clock::now();
        bool on = true;
        for (std::size_t i = 0; i < drag.positions.size() && on; ++i, due += interval) {
            on = wait_until(due);
            if (on) {
                const auto edit = stage.drag_to(drag, drag.positions[i]);
                if (!edit) {
                    session.end_gesture();
                    return tl::unexpected(edit.error());
                }
                post(*edit, true);
            }
        }
        on = on && wait_until(due);
        stage.end_drag();
        session.end_gesture();
        return on;
    }

    Result<EditReport> play(const ScriptEdit& edit) {
        EditReport report;
        report.kind = edit.kind();
        report.target = std::holds_alternative<ScriptUndo>(edit.value)   ? stage.undo_target()
                        : std::holds_alternative<ScriptRedo>(edit.value) ? stage.redo_target()
                                                                         : edit.target();
        {
            const std::lock_guard lock(mutex);
            frames.clear();
            let_go.reset();
            settled.reset();
            settled_light.reset();
        }
        const std::uint64_t before = revision;
        Result<bool> going = true;
        bool waits = true;
        Clock::time_point released;
        const auto lets_go = [&] { // after the last edit is posted: what is settled before is not its light
            {
                const std::lock_guard lock(mutex);
                let_go = released;
            }
            answer_frames();
        };
        if (const auto* wanted = std::get_if<ScriptDrag>(&edit.value)) {
            going = drag(*wanted);
            waits = wanted->settle;
            released = Clock::now();
            lets_go();
        } else {
            const auto applied = stage.apply(edit);
            if (!applied) {
                return tl::unexpected(applied.error());
            }
            released = Clock::now();
            post(*applied, false);
            lets_go();
        }
        if (going) {
            const bool finished = *going;
            going = waits ? settle() : all_shown();
            if (going && *going && waits && finished) {
                report.settle = seconds(Clock::now() - released);
            }
            going = going.map([&](bool done) { return done && finished; });
        }
        if (!going) {
            return tl::unexpected(going.error());
        }
        report.stopped = !*going;
        if (revision > before) {
            report.update = update_of(session.latest(), before + 1);
        }
        const std::lock_guard lock(mutex);
        for (const Frame& frame : frames) {
            report.frames.push_back(frame.report);
        }
        report.settled = settled;
        report.settled_light = settled_light;
        return report;
    }

    const RunContext context;
    ScriptedScene stage;
    std::uint64_t revision = 1;

    // Guarded by `mutex`, which is held only to copy state in and out.
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<Frame> frames;               ///< of the edit that is being played
    std::optional<Clock::time_point> let_go; ///< of the edit that is being played
    std::optional<double> settled;
    Picture settled_light;
    std::uint64_t wakes = 0;
    bool running = false; ///< inside a solve
    bool at_rest = true;  ///< no solve since the last time that the session had news

    EngineSession session; ///< last: its thread uses all of the above
};

ScriptPlayer::ScriptPlayer(Scene scene, std::shared_ptr<const Solution> stored, EngineSession::SolveFunction solve,
                           const RunContext& context)
    : impl_(std::make_unique<Impl>(std::move(scene), stored, std::move(solve), context)) {}
ScriptPlayer::~ScriptPlayer() = default;

Result<bool> ScriptPlayer::settle() { return impl_->settle(); }
Result<EditReport> ScriptPlayer::play(const ScriptEdit& edit) { return impl_->play(edit); }

const Scene& ScriptPlayer::scene() const { return impl_->stage.scene(); }
std::shared_ptr<const Solution> ScriptPlayer::light() const { return impl_->session.latest(); }
bool ScriptPlayer::light_is_current() const { return impl_->current(); }

} // namespace atrium
