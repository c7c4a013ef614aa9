#include "ui/document/recovery.h"

#include "engine/io/scene_file.h"
#include "ui/document/background.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSaveFile>
#include <QStandardPaths>
#include <QUuid>

#include <algorithm>

namespace atrium::ui {

namespace {
constexpr int kIntervalMs = 30000;
} // namespace

Recovery::Recovery(Document& document, const QString& directory, QObject* parent)
    : QObject(parent), document_(document), directory_(directory), epoch_(std::make_shared<std::atomic<std::uint64_t>>(0)) {
    QDir().mkpath(directory_);
    base_ = directory_ + QLatin1Char('/') + QUuid::createUuid().toString(QUuid::WithoutBraces);
    lock_ = std::make_unique<QLockFile>(base_ + QStringLiteral(".lock"));
    lock_->setStaleLockTime(0); // a lock is stale when its process is gone, however long it has run
    lock_->tryLock(0);
    timer_.setSingleShot(true);
    timer_.setInterval(kIntervalMs);
    connect(&timer_, &QTimer::timeout, this, &Recovery::write);
    // Undo entries, not edits: a drag of a hundred mouse moves is one change worth keeping.
    connect(document_.undo_stack(), &QUndoStack::indexChanged, this, &Recovery::on_changed);
    connect(&document_, &Document::reset_done, this, &Recovery::clear);
}

Recovery::~Recovery() = default;

QString Recovery::default_directory() {
    return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + QStringLiteral("/recovery");
}

void Recovery::set_limits(int interval_ms, int edits) {
    timer_.setInterval(interval_ms);
    edit_limit_ = edits;
}

std::vector<RecoveredFile> Recovery::orphans() const {
    std::vector<RecoveredFile> found;
    const QDir folder(directory_);
    const QStringList journals = folder.entryList({QStringLiteral("*.json")}, QDir::Files);
    for (const QString& name : journals) {
        const QString base = folder.filePath(name.chopped(5));
        if (base == base_) {
            continue;
        }
        QLockFile lock(base + QStringLiteral(".lock"));
        lock.setStaleLockTime(0);
        QFile journal(folder.filePath(name));
        if (!lock.tryLock(0) || !journal.open(QIODevice::ReadOnly)) {
            continue; // its process lives
        }
        const QFileInfo scene(base + QStringLiteral(".atrium"));
        if (!scene.exists() || scene.size() == 0) {
            continue;
        }
        const QJsonObject object = QJsonDocument::fromJson(journal.readAll()).object();
        found.push_back(
            {scene.filePath(), journal.fileName(), object[QLatin1StringView("original")].toString(), scene.lastModified()});
    }
    std::sort(found.begin(), found.end(), [](const RecoveredFile& a, const RecoveredFile& b) { return a.date > b.date; });
    return found;
}

void Recovery::discard(const RecoveredFile& file) {
    QFile::remove(file.path);
    QFile::remove(file.journal);
    QFile::remove(file.journal.chopped(5) + QStringLiteral(".lock"));
}

void Recovery::clear() {
    ++*epoch_; // before removing: whichever of the two comes last removes
    edits_ = 0;
    again_ = false;
    timer_.stop();
    QFile::remove(path());
    QFile::remove(base_ + QStringLiteral(".json"));
}

void Recovery::on_changed() {
    if (!timer_.isActive()) {
        timer_.start(); // from the first unsaved edit on, not from the last one
    }
    if (++edits_ >= edit_limit_ && !document_.in_gesture()) {
        write();
    }
}

void Recovery::write() {
    if (document_.in_gesture()) {
        timer_.start(1000);
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
    QJsonObject journal;
    journal[QLatin1StringView("original")] = document_.path();
    journal[QLatin1StringView("version")] = QLatin1StringView(ATRIUM_VERSION);
    const QByteArray note = QJsonDocument(journal).toJson();
    run_in_background(
        this,
        [scene = document_.scene(), file = path(), journal_file = base_ + QStringLiteral(".json"), note, epoch,
         latest = epoch_]() -> Result<bool> {
            if (auto done = write_scene(file.toStdString(), scene); !done) {
                return tl::unexpected<Error>(done.error());
            }
            QSaveFile out(journal_file);
            if (!out.open(QIODevice::WriteOnly) || out.write(note) != note.size() || !out.commit()) {
                return fail(journal_file.toStdString(), {}, "the recovery journal could not be written",
                            "Check the free space and the rights of that folder.");
            }
            if (*latest != epoch) { // saved or replaced meanwhile
                QFile::remove(file);
                QFile::remove(journal_file);
            }
            return true;
        },
        [this, epoch](const Result<bool>& done) {
            writing_ = false;
            if (epoch == *epoch_ && !done) {
                timer_.start();
                Q_EMIT failed(QString::fromStdString(done.error().message()));
            } else if (epoch == *epoch_) {
                Q_EMIT written();
            }
            if (again_) {
                again_ = false;
                write();
            }
        });
}

} // namespace atrium::ui
