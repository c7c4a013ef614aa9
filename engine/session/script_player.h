// Plays an edit script through the job queue as the editor's user would, and takes the time.
#pragma once

#include "engine/base/run_context.h"
#include "engine/scene/edit_script.h"
#include "engine/session/engine_session.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace atrium {

/// One posted edit: how long until light that includes it was shown. Edits that the mailbox merged share that picture.
struct FrameReport {
    std::optional<double> latency; ///< seconds; nothing when the script was stopped before
    UpdateStatistics update;       ///< of that picture; zero when the edit changes nothing
};

/// What came of one edit of a script.
struct EditReport {
    std::string kind;
    std::string target;              ///< as the script names it; of undo and redo what they change
    std::vector<FrameReport> frames; ///< one, or one per position of a drag
    std::optional<double> settle;    ///< seconds from the edit, or from the end of the drag, to the complete light
    std::optional<double> settled;   ///< the same to the first light that is not in a hurry
    std::shared_ptr<const Solution> settled_light; ///< null unless it came before the complete light
    UpdateStatistics update;                       ///< of the newest light at the end; zero when the edit changes no light
    bool stopped = false;                          ///< the edit, or the light after it, was not finished
};

/// Owns a session and the scene as its user sees it. One thread; the solving goes on in the session's own.
class ScriptPlayer {
public:
    /// `stored` (may be null): light of the scene that needs no solving. `context` says when to stop and gets the progress,
    /// on the session's thread.
    ScriptPlayer(Scene scene, std::shared_ptr<const Solution> stored, EngineSession::SolveFunction solve,
                 const RunContext& context);
    ~ScriptPlayer();
    ScriptPlayer(const ScriptPlayer&) = delete;
    ScriptPlayer& operator=(const ScriptPlayer&) = delete;

    /// Waits for the complete light; false when it was stopped. Errors are the light simulation's.
    Result<bool> settle();
    /// Carries out one edit and waits for the complete light, after a drag only if the script wants it. Once it was stopped,
    /// nothing solves any more. Errors say what is wrong with the edit; file and place are the caller's to add.
    Result<EditReport> play(const ScriptEdit& edit);

    [[nodiscard]] const Scene& scene() const;
    [[nodiscard]] std::shared_ptr<const Solution> light() const; ///< newest; may be null
    [[nodiscard]] bool light_is_current() const;                 ///< light() is of scene(), complete or not

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace atrium
