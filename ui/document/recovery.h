// Autosave: what is unsaved is written aside every few minutes or edits, and offered again after a crash.
#pragma once

#include "ui/document/document.h"

#include <QDateTime>
#include <QLockFile>
#include <QObject>
#include <QTimer>

#include <atomic>
#include <memory>
#include <vector>

namespace atrium::ui {

/// A file left behind by a process that did not end properly.
struct RecoveredFile {
    QString path;     ///< the .atrium file with the recovered scene
    QString journal;  ///< the small file that describes it
    QString original; ///< the document's own file; empty = it had none
    QDateTime date;   ///< of the recovered state
};

/// Writes `directory`/<name>.atrium (scene without solution, atomically, off the UI thread) and a journal <name>.json. A
/// lock file tells whether the process behind them still lives. UI thread only.
class Recovery : public QObject {
    Q_OBJECT
public:
    Recovery(Document& document, const QString& directory, QObject* parent = nullptr);
    ~Recovery() override; ///< keeps the files: only clear() says that nothing is lost

    static QString default_directory();

    /// Files of dead processes, newest first. They stay until discard(), also after another crash.
    [[nodiscard]] std::vector<RecoveredFile> orphans() const;
    static void discard(const RecoveredFile& file);

    void set_limits(int interval_ms, int edits); ///< defaults: 30 s after a change, 20 undo entries
    void clear();                                ///< saved, or closed on purpose: removes this process's files
    [[nodiscard]] QString path() const { return base_ + QStringLiteral(".atrium"); }
    [[nodiscard]] bool busy() const { return writing_; }

Q_SIGNALS:
    void written();
    void failed(const QString& why);

private:
    void on_changed();
    void write();

    Document& document_;
    QString directory_;
    QString base_; ///< path without extension
    std::unique_ptr<QLockFile> lock_;
    QTimer timer_;
    int edit_limit_ = 20;
    int edits_ = 0;
    /// Raised by clear(). A write under way for an older one removes its own files again; shared with the worker.
    std::shared_ptr<std::atomic<std::uint64_t>> epoch_;
    bool writing_ = false;
    bool again_ = false;
};

} // namespace atrium::ui
