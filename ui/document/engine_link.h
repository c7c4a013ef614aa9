// Between the document and the engine's job queue: posts edits, brings solutions back to the UI thread.
#pragma once

#include "engine/session/engine_session.h"
#include "ui/document/document.h"

#include <QObject>

#include <atomic>
#include <memory>

namespace atrium::ui {

/// UI thread only. Owns the EngineSession; at most one queued event is in flight from the engine thread.
class EngineLink : public QObject {
    Q_OBJECT
public:
    explicit EngineLink(Document& document, QObject* parent = nullptr);
    ~EngineLink() override;

    [[nodiscard]] std::shared_ptr<const Solution> solution() const; ///< newest; may be null or stale
    [[nodiscard]] SessionStatus status() const;
    [[nodiscard]] bool stale() const; ///< solution() is older than the document's light, or coarse
    /// solution(), complete or made in a hurry, is of the document as it is now: no edit of light came after it.
    [[nodiscard]] bool follows() const;
    void load(std::shared_ptr<const Solution> stored); ///< after Document::reset
    /// What follows edits of stored light is made in the background (EngineSession::prepare()); after load().
    void prepare();
    /// How far off solution() is likely to be at a place; null where that is not known (yet).
    [[nodiscard]] std::shared_ptr<const LocalError> local_error() const;
    void cancel();
    void resume();
    void keep_landings(bool on); ///< solutions tell where particles landed; off at first
    void keep_insides(bool on);  ///< solutions tell their elements, links and ways of particles; off at first

Q_SIGNALS:
    void solution_changed();
    void status_changed();

private:
    void on_wake();
    void on_edited(const SceneEdit& edit);
    Document& document_;
    bool load_pending_ = true; ///< the document was replaced and the session does not have it yet
    std::atomic<bool> wake_queued_{false};
    std::shared_ptr<const Solution> shown_;
    std::uint64_t shown_revision_ = 0;        ///< of the document that shown_ is the light of
    std::shared_ptr<const LocalError> error_; ///< of shown_
    std::unique_ptr<EngineSession> session_;
};

} // namespace atrium::ui
