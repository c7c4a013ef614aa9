// What keeps two hands off one project: a lock beside it, and a note of what the file was when it was read.
#pragma once

#include <QLockFile>
#include <QString>

#include <memory>

namespace atrium::ui {

/// What a file was at some moment: enough to tell whether somebody else has written it since. Any thread.
struct FileStamp {
    bool exists = false;
    std::int64_t size = 0;
    std::int64_t modified_ns = 0; ///< since the epoch
    std::uint64_t inode = 0;      ///< programs that save safely replace the file

    static FileStamp of(const QString& path);
    friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// Holds ".NAME.lock" beside a project while the editor has it open for writing. A lock whose process is gone (on this
/// machine, or after a restart) is taken over. UI thread only.
class ProjectLock {
public:
    /// Tries at once. Where no lock can be written (a folder without rights, a file system without locks) nothing is
    /// locked and taken() is false: what cannot be locked is not refused for it.
    explicit ProjectLock(const QString& project);

    [[nodiscard]] const QString& project() const { return project_; } ///< absolute path
    [[nodiscard]] bool taken() const { return taken_; }               ///< by another process that lives
    [[nodiscard]] QString holder() const;                             ///< of a taken one: "process 123 on HOST"
    static QString file_of(const QString& project);

private:
    QString project_;
    QLockFile lock_;
    bool taken_ = false;
    QString holder_host_;
    qint64 holder_process_ = 0;
};

} // namespace atrium::ui
