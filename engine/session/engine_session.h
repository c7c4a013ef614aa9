// The job queue: the editor and atrium-cli post edits, an engine thread answers with Solutions.
#pragma once

#include "engine/measure/local_error.h"
#include "engine/scene/scene_edit.h"
#include "engine/solver/gi_engine.h"
#include "engine/solver/solution.h"

#include <functional>
#include <memory>
#include <string>

namespace atrium {

/// What the engine thread is doing; a copy, taken by status() from any thread.
struct SessionStatus {
    enum class State : std::uint8_t { Idle, Solving, Stopped, Failed };
    State state = State::Idle;
    std::uint64_t posted_revision = 0; ///< newest edit in the mailbox or applied
    std::uint64_t shown_revision = 0;  ///< of latest(); lower = the picture is stale
    std::uint64_t light_revision = 0;  ///< newest posted edit that changed light; what came after it left light alone
    bool moving = false;               ///< latest() follows a hand in a hurry
    bool settling = false;             ///< latest() was made in a hurry, and better light is still to come
    bool refining = false;             ///< latest() is an exact update; the full solution is still to come
    bool preparing = false;            ///< latest() is complete; what follows edits of it is being made (prepare())
    std::string phase;                 ///< "visibility", "layers", ...; empty when idle
    double fraction = 0;               ///< 0 to 1
    double elapsed_seconds = 0;
    double remaining_seconds = -1; ///< estimate; negative = not known yet
    std::string message;           ///< of a failure
};

/// Owns the engine thread and its own copy of the scene. All public functions are safe from any thread and never block on
/// engine work (the destructor asks to stop and waits for the next stop point).
class EngineSession {
public:
    /// `wake` is called from the engine thread whenever status() or latest() has news; it must not block. The UI posts
    /// itself one queued event from it.
    explicit EngineSession(std::function<void()> wake);
    /// What GiEngine::solve does, in the form in which another solver (a test's) can stand in for it. Called on the engine
    /// thread; may throw, which counts as a failure.
    using SolveFunction = std::function<Result<std::shared_ptr<const Solution>>(
        const Scene&, const SolveOptions&, const RunContext&,
        const std::function<void(std::shared_ptr<const Solution>)>& on_snapshot)>;
    /// What audited_with_places() does: a complete solution with its error, or the same one where that was stopped.
    using AuditFunction =
        std::function<Audited(const Scene&, std::shared_ptr<const Solution>, const SolveOptions&, const RunContext&)>;
    /// Without `audit` errors are not measured.
    EngineSession(std::function<void()> wake, SolveFunction solve, AuditFunction audit = {});
    ~EngineSession();
    EngineSession(const EngineSession&) = delete;
    EngineSession& operator=(const EngineSession&) = delete;

    /// Starts over with another document. `stored` (may be null) is shown at once; with it nothing is solved until an edit.
    void load(Scene scene, std::uint64_t revision, std::shared_ptr<const Solution> stored);
    /// After load() with a complete solution: computes it once more in the background, unseen, so that the engine has what
    /// hurried updates start from, and the first drag is as fast as it was before the scene was saved. Any edit of light
    /// ends it. Does nothing where the engine has that, or is at work on the light already.
    void prepare();
    /// Posts one edit of the document, already applied there. Never blocks, never refuses; a newer placement replaces a
    /// pending one (supersedes()). While `in_gesture` light follows by hurried updates; the first edit after it (or
    /// 200 ms of rest) starts the full solution. See QualityScheduler.
    void post(const SceneEdit& edit, std::uint64_t revision, bool in_gesture);
    /// Ends a gesture: what was collected may be solved now.
    void end_gesture();
    /// Stops the running solve; the last picture stays. The next edit or resume() starts again.
    void cancel();
    /// Solves the present scene if latest() is not its final solution.
    void resume();

    /// Whether solutions tell where particles landed (SolveOptions::keep_landings). Turned on, the next one that does
    /// follows at once where the engine keeps what that needs, else after a solve.
    void keep_landings(bool on);
    /// Likewise for Solution::insides. Light that the engine did not compute itself (a stored one) is left as it is.
    void keep_insides(bool on);

    [[nodiscard]] std::shared_ptr<const Solution> latest() const; ///< may be null
    /// latest(), and how far off it is likely to be at a place: null where this session has not measured that.
    struct Shown {
        std::shared_ptr<const Solution> solution;
        std::shared_ptr<const LocalError> error;
        /// Of the scene that it is the light of; it follows all that was posted once this is not below
        /// SessionStatus::light_revision. A stored solution counts as of the scene it was loaded with.
        std::uint64_t revision = 0;
    };
    [[nodiscard]] Shown shown() const;
    [[nodiscard]] SessionStatus status() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace atrium
