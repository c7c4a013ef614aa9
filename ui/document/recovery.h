// Autosave: what is unsaved is written aside every few minutes or edits, and offered again after a crash.
#pragma once

#include "engine/view/still.h"
#include "ui/document/document.h"

#include <QDateTime>
#include <QLockFile>
#include <QObject>
#include <QTimer>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace atrium::ui {

/// A file with work that was not saved.
struct RecoveredFile {
    /// Why it is there: its process ended without being asked to, or the work was given up on purpose.
    enum class Reason : std::uint8_t { Crash, Reverted, Discarded };
    QString path;                     ///< the .atrium file with the recovered scene
    QString journal;                  ///< the small file that describes it; may be missing
    QString original;                 ///< the document's own file; empty = it had none
    QDateTime date;                   ///< of the recovered state
    Reason reason = Reason::Crash;    ///< Crash where the journal tells nothing
    std::optional<ViewCamera> camera; ///< what the view showed then
};

/// Writes `directory`/<name>.atrium (scene without solution, atomically, off the UI thread) and a journal <name>.json. A
/// lock file tells whether the process behind them still lives. UI thread only.
class Recovery : public QObject {
    Q_OBJECT
public:
    Recovery(Document& document, const QString& directory, QObject* parent = nullptr);
    ~Recovery() override; ///< keeps the files: only clear() says that nothing is lost

    static QString default_directory();
    /// Where the view stands, for the pictures of recovered work. Called on the UI thread at every autosave.
    void set_view(std::function<ViewCamera()> view) { view_ = std::move(view); }

    /// Files of dead processes, newest first. They stay until discard(), also after another crash.
    [[nodiscard]] std::vector<RecoveredFile> orphans() const;
    /// Work that was given up by keep(), newest first.
    [[nodiscard]] std::vector<RecoveredFile> kept() const;
    static void discard(const RecoveredFile& file);

    /// Defaults: 30 s after a change, 20 undo entries. Where writing takes long the interval grows to twenty times that, up
    /// to two minutes.
    void set_limits(int interval_ms, int edits);
    void clear(); ///< saved, or closed on purpose: removes this process's files
    void write(); ///< now, in the background; nothing happens where nothing is unsaved
    /// Writes what is unsaved and puts it aside for two weeks (the newest twenty), then calls `then(it is there)`. True at
    /// once where nothing is unsaved.
    void keep(RecoveredFile::Reason reason, std::function<void(bool)> then);
    [[nodiscard]] QString path() const { return base_ + QStringLiteral(".atrium"); }
    [[nodiscard]] bool busy() const { return writing_; }

Q_SIGNALS:
    void written();
    void failed(const QString& why);

private:
    [[nodiscard]] std::vector<RecoveredFile> files(bool given_up) const;
    [[nodiscard]] QByteArray journal(RecoveredFile::Reason reason) const;
    void on_changed();
    void start();
    void finish_keeping(bool there);
    void remove_old() const;

    Document& document_;
    QString directory_;
    QString base_; ///< path without extension
    std::unique_ptr<QLockFile> lock_;
    std::function<ViewCamera()> view_;
    QTimer timer_;
    int interval_ms_;
    int edit_limit_ = 20;
    int edits_ = 0;
    /// Raised by clear(). A write under way for an older one removes its own files again; shared with the worker.
    std::shared_ptr<std::atomic<std::uint64_t>> epoch_;
    bool writing_ = false;
    bool again_ = false;
    std::uint64_t written_revision_ = 0; ///< of the document, in our file; 0 = no file
    RecoveredFile::Reason keep_reason_ = RecoveredFile::Reason::Crash;
    std::function<void(bool)> keep_then_; ///< waits for the write under way
};

} // namespace atrium::ui
