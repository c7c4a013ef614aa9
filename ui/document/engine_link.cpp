#include "ui/document/engine_link.h"

#include <QMetaObject>
#include <QTimer>

namespace atrium::ui {

EngineLink::EngineLink(Document& document, QObject* parent) : QObject(parent), document_(document) {
    session_ = std::make_unique<EngineSession>([this] {
        // Engine thread. However much news there is, one event waits in the UI's queue.
        if (!wake_queued_.exchange(true)) {
            QMetaObject::invokeMethod(
                this, [this] { on_wake(); }, Qt::QueuedConnection);
        }
    });
    connect(&document_, &Document::reset_done, this, [this] {
        error_.reset();
        shown_.reset(); // its ids belong to another document
        load_pending_ = true;
        Q_EMIT solution_changed();
        // load() usually follows at once with the stored solution; without it the scene is solved from the start.
        QTimer::singleShot(0, this, [this] {
            if (load_pending_) {
                load(nullptr);
            }
        });
    });
    connect(&document_, &Document::edited, this, &EngineLink::on_edited);
    connect(&document_, &Document::gesture_finished, this, [this] { session_->end_gesture(); });
}

EngineLink::~EngineLink() { session_.reset(); } // joins the engine thread, so that no wake comes after this

std::shared_ptr<const Solution> EngineLink::solution() const { return shown_; }

SessionStatus EngineLink::status() const { return session_->status(); }

bool EngineLink::stale() const { return !follows() || !shown_->final; }

bool EngineLink::follows() const {
    // Not by SessionStatus::shown_revision: that is of an answer which may still be on its way to this thread.
    return !load_pending_ && shown_ && shown_revision_ >= session_->status().light_revision;
}

void EngineLink::load(std::shared_ptr<const Solution> stored) {
    load_pending_ = false;
    shown_ = stored;
    shown_revision_ = document_.revision();
    error_.reset();
    session_->load(document_.scene(), document_.revision(), std::move(stored));
    Q_EMIT solution_changed();
    Q_EMIT status_changed();
}

void EngineLink::prepare() {
    session_->prepare();
    Q_EMIT status_changed();
}

std::shared_ptr<const LocalError> EngineLink::local_error() const { return error_; }

void EngineLink::cancel() { session_->cancel(); }

void EngineLink::resume() { session_->resume(); }

void EngineLink::keep_landings(bool on) {
    session_->keep_landings(on);
    Q_EMIT status_changed();
}

void EngineLink::keep_insides(bool on) {
    session_->keep_insides(on);
    on_wake(); // turned off, they are gone already
}

void EngineLink::on_edited(const SceneEdit& edit) {
    if (load_pending_) {
        load(nullptr); // takes the scene with this edit in it
        return;
    }
    session_->post(edit, document_.revision(), document_.in_gesture());
    Q_EMIT status_changed();
}

void EngineLink::on_wake() {
    wake_queued_ = false; // before reading: news that arrives from here on queues the next event
    EngineSession::Shown newest = session_->shown();
    if (load_pending_) {
        return; // still about the document before
    }
    shown_revision_ = newest.revision;
    if (newest.solution != shown_) {
        shown_ = std::move(newest.solution);
        error_ = std::move(newest.error);
        Q_EMIT solution_changed();
    }
    Q_EMIT status_changed();
}

} // namespace atrium::ui
