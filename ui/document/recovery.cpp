#include "ui/document/recovery.h"

#include "engine/io/scene_file.h"
#include "ui/document/background.h"
#include "ui/document/engine_text.h"

#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSaveFile>
#include <QStandardPaths>
#include <QUuid>

#include <algorithm>

namespace atrium::ui {

namespace {

constexpr int kIntervalMs = 30000;
constexpr int kLongestMs = 120000;
constexpr int kShareOfTime = 20; ///< writing takes at most one part in so many
constexpr int kKeptDays = 14;
constexpr std::size_t kKeptFiles = 20;

/// Milliseconds until the next autosave after one that took `took`.
int next_interval(int wanted, qint64 took) {
    const bool is_usual = wanted >= 1000; // shorter ones are a test's, which means them
    return is_usual ? int(std::clamp<qint64>(took * kShareOfTime, wanted, std::max(wanted, kLongestMs))) : wanted;
}

const char* reason_name(RecoveredFile::Reason reason) {
    switch (reason) {
    case RecoveredFile::Reason::Reverted: return "reverted";
    case RecoveredFile::Reason::Discarded: return "discarded";
    case RecoveredFile::Reason::Crash: break;
    }
    return "unsaved";
}

QJsonArray camera_json(const ViewCamera& camera) {
    QJsonArray out;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            out.append(camera.to_world[column][row]);
        }
    }
    out.append(double(camera.lens.yfov));
    return out;
}

std::optional<ViewCamera> camera_of(const QJsonArray& json) {
    if (json.size() != 17) {
        return std::nullopt;
    }
    ViewCamera out;
    for (int i = 0; i < 16; ++i) {
        out.to_world[i / 4][i % 4] = json[i].toDouble();
    }
    out.lens.yfov = float(json[16].toDouble());
    const bool usable = out.lens.yfov > 0.01F && out.lens.yfov < 3.0F && std::abs(glm::determinant(out.to_world)) > 1e-6;
    return usable ? std::optional(out) : std::nullopt;
}

Result<bool> write_journal(const QString& file, const QByteArray& text) {
    QSaveFile out(file);
    if (!out.open(QIODevice::WriteOnly) || out.write(text) != text.size() || !out.commit()) {
        return fail(file.toStdString(), {}, "the recovery journal could not be written",
                    "Check the free space and the rights of that folder.");
    }
    return true;
}

} // namespace

Recovery::Recovery(Document& document, const QString& directory, QObject* parent)
    : QObject(parent), document_(document), directory_(directory), interval_ms_(kIntervalMs),
      epoch_(std::make_shared<std::atomic<std::uint64_t>>(0)) {
    QDir().mkpath(directory_);
    base_ = directory_ + QLatin1Char('/') + QUuid::createUuid().toString(QUuid::WithoutBraces);
    lock_ = std::make_unique<QLockFile>(base_ + QStringLiteral(".lock"));
    lock_->setStaleLockTime(0); // a lock is stale when its process is gone, however long it has run
    lock_->tryLock(0);
    timer_.setSingleShot(true);
    timer_.setInterval(interval_ms_);
    connect(&timer_, &QTimer::timeout, this, &Recovery::start);
    // Undo entries, not edits: a drag of a hundred mouse moves is one change worth keeping.
    connect(document_.undo_stack(), &QUndoStack::indexChanged, this, &Recovery::on_changed);
    connect(&document_, &Document::reset_done, this, &Recovery::clear);
    remove_old();
}

Recovery::~Recovery() = default;

QString Recovery::default_directory() {
    return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + QStringLiteral("/recovery");
}

void Recovery::set_limits(int interval_ms, int edits) {
    interval_ms_ = interval_ms;
    timer_.setInterval(interval_ms);
    edit_limit_ = edits;
}

std::vector<RecoveredFile> Recovery::files(bool given_up) const {
    std::vector<RecoveredFile> found;
    const QDir folder(directory_);
    // By the scenes: one that was written a moment before its journal is worth as much.
    const QStringList scenes = folder.entryList({QStringLiteral("*.atrium")}, QDir::Files);
    for (const QString& name : scenes) {
        const QString base = folder.filePath(name.chopped(7));
        const QFileInfo scene(base + QStringLiteral(".atrium"));
        if (base == base_ || scene.size() == 0) {
            continue;
        }
        QLockFile lock(base + QStringLiteral(".lock"));
        lock.setStaleLockTime(0);
        if (!lock.tryLock(0) && lock.error() == QLockFile::LockFailedError) {
            continue; // its process lives
        }
        QFile journal(base + QStringLiteral(".json"));
        const QJsonObject object =
            journal.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(journal.readAll()).object() : QJsonObject();
        const QString why = object[QLatin1StringView("reason")].toString();
        auto reason = RecoveredFile::Reason::Crash;
        for (const auto one : {RecoveredFile::Reason::Reverted, RecoveredFile::Reason::Discarded}) {
            reason = why == QLatin1StringView(reason_name(one)) ? one : reason;
        }
        if ((reason != RecoveredFile::Reason::Crash) == given_up) {
            found.push_back({scene.filePath(), journal.fileName(), object[QLatin1StringView("original")].toString(),
                             scene.lastModified(), reason, camera_of(object[QLatin1StringView("camera")].toArray())});
        }
    }
    std::sort(found.begin(), found.end(), [](const RecoveredFile& a, const RecoveredFile& b) { return a.date > b.date; });
    return found;
}

std::vector<RecoveredFile> Recovery::orphans() const { return files(false); }

std::vector<RecoveredFile> Recovery::kept() const { return files(true); }

void Recovery::discard(const RecoveredFile& file) {
    QFile::remove(file.path);
    QFile::remove(file.journal);
    QFile::remove(file.path.chopped(7) + QStringLiteral(".lock"));
}

void Recovery::remove_old() const {
    const std::vector<RecoveredFile> given_up = kept();
    const QDateTime oldest = QDateTime::currentDateTime().addDays(-kKeptDays);
    for (std::size_t i = 0; i < given_up.size(); ++i) {
        if (i >= kKeptFiles || given_up[i].date < oldest) {
            discard(given_up[i]);
        }
    }
}

void Recovery::clear() {
    ++*epoch_; // before removing: whichever of the two comes last removes
    edits_ = 0;
    again_ = false;
    written_revision_ = 0;
    timer_.stop();
    QFile::remove(path());
    QFile::remove(base_ + QStringLiteral(".json"));
}

void Recovery::on_changed() {
    if (!timer_.isActive()) {
        timer_.start(); // from the first unsaved edit on, not from the last one
    }
    if (++edits_ >= edit_limit_ && !document_.in_gesture()) {
        start();
    }
}

void Recovery::write() {
    if (!document_.undo_stack()->isClean() && written_revision_ != document_.revision()) {
        start();
    }
}

void Recovery::keep(RecoveredFile::Reason reason, std::function<void(bool)> then) {
    if (document_.undo_stack()->isClean()) {
        then(true);
        return;
    }
    keep_reason_ = reason;
    keep_then_ = std::move(then);
    if (!writing_ && written_revision_ == document_.revision()) {
        finish_keeping(true);
    } else {
        start();
    }
}

void Recovery::finish_keeping(bool there) {
    const auto then = std::move(keep_then_);
    keep_then_ = {};
    if (there) {
        const QString base = directory_ + QLatin1Char('/') + QUuid::createUuid().toString(QUuid::WithoutBraces);
        // The journal first: a scene without one would be taken for a crash, which loses nothing either.
        there = bool(write_journal(base + QStringLiteral(".json"), journal(keep_reason_))) &&
                QFile::rename(path(), base + QStringLiteral(".atrium"));
    }
    if (there) {
        clear();
        remove_old();
    }
    then(there);
}

QByteArray Recovery::journal(RecoveredFile::Reason reason) const {
    QJsonObject out;
    out[QLatin1StringView("original")] = document_.path();
    out[QLatin1StringView("version")] = QLatin1StringView(ATRIUM_VERSION);
    out[QLatin1StringView("reason")] = QLatin1StringView(reason_name(reason));
    if (view_) {
        out[QLatin1StringView("camera")] = camera_json(view_());
    }
    return QJsonDocument(out).toJson();
}

void Recovery::start() {
    if (document_.in_gesture()) {
        timer_.start(std::min(1000, interval_ms_));
        return;
    }
    if (writing_) {
        again_ = true;
        return;
    }
    timer_.stop();
    edits_ = 0;
    writing_ = true;
    const std::uint64_t epoch = *epoch_;
    QElapsedTimer clock;
    clock.start();
    run_in_background(
        this,
        [scene = document_.scene(), folder = directory_, file = path(), journal_file = base_ + QStringLiteral(".json"),
         note = journal(RecoveredFile::Reason::Crash), epoch, latest = epoch_]() -> Result<bool> {
            QDir().mkpath(folder); // somebody may have cleaned up
            if (auto done = write_journal(journal_file, note); !done) {
                return done;
            }
            if (auto done = write_scene(std::filesystem::path(file.toStdU16String()), scene); !done) {
                return tl::unexpected<Error>(done.error());
            }
            if (*latest != epoch) { // saved or replaced meanwhile
                QFile::remove(file);
                QFile::remove(journal_file);
            }
            return true;
        },
        [this, epoch, clock, revision = document_.revision()](const Result<bool>& done) {
            writing_ = false;
            if (const int next = next_interval(interval_ms_, clock.elapsed()); next != timer_.interval()) {
                timer_.setInterval(next); // starts a running timer anew: not without need
            }
            if (epoch == *epoch_ && !done) {
                timer_.start();
                Q_EMIT failed(error_message(done.error()));
            } else if (epoch == *epoch_) {
                written_revision_ = revision;
                Q_EMIT written();
            }
            if (keep_then_) {
                again_ = false;
                const bool there = bool(done) && epoch == *epoch_;
                if (there && written_revision_ != document_.revision()) {
                    start(); // edited since; what is kept is the last state
                } else {
                    finish_keeping(there);
                }
            } else if (again_) {
                again_ = false;
                start();
            }
        });
}

} // namespace atrium::ui
