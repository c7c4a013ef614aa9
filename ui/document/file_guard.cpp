#include "ui/document/file_guard.h"

#include <QCoreApplication>
#include <QFile>
#include <QFileInfo>

#include <sys/stat.h>

namespace atrium::ui {

FileStamp FileStamp::of(const QString& path) {
    struct stat info {};
    if (::stat(QFile::encodeName(path).constData(), &info) != 0) {
        return {};
    }
    return {true, std::int64_t(info.st_size), std::int64_t(info.st_mtim.tv_sec) * 1000000000 + info.st_mtim.tv_nsec,
            std::uint64_t(info.st_ino)};
}

QString ProjectLock::file_of(const QString& project) {
    const QFileInfo info(project);
    return info.absolutePath() + QStringLiteral("/.") + info.fileName() + QStringLiteral(".lock");
}

ProjectLock::ProjectLock(const QString& project)
    : project_(QFileInfo(project).absoluteFilePath()), lock_(file_of(project_)) {
    lock_.setStaleLockTime(0); // a lock is stale when its process is gone, however long it has run
    if (!lock_.tryLock(0) && lock_.error() == QLockFile::LockFailedError) {
        QString program;
        taken_ = true;
        if (!lock_.getLockInfo(&holder_process_, &holder_host_, &program)) {
            holder_process_ = 0; // gone in this moment, or not one of ours
        }
    }
}

QString ProjectLock::holder() const {
    return holder_process_ == 0
               ? QCoreApplication::translate("ProjectLock", "another program")
               : QCoreApplication::translate("ProjectLock", "process %1 on %2").arg(holder_process_).arg(holder_host_);
}

} // namespace atrium::ui
