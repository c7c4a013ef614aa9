// Bytes in and out of the file system: capped reads, atomic writes, and the rule that a scene reaches only its own folder.
#pragma once

#include "engine/base/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace atrium {

/// Whole content of a regular file (no pipe, device or folder). Fails when it is longer than `max_bytes`.
Result<std::vector<std::uint8_t>> read_file(const std::filesystem::path& path, std::uint64_t max_bytes);

/// A complete, synced temporary file beside `target`, waiting for commit(). Dropped without a trace when destroyed
/// uncommitted, so that several files can be prepared before the first old one is replaced.
class PendingFile {
public:
    /// Writes `bytes` beside `target` and syncs them. A symbolic link is followed: the file it names is replaced.
    static Result<PendingFile> prepare(const std::filesystem::path& target, std::span<const std::uint8_t> bytes);
    /// Renames over the target and syncs the folder. On failure the old file is as it was.
    Result<void> commit();

    PendingFile(PendingFile&& other) noexcept;
    PendingFile& operator=(PendingFile&&) = delete;
    PendingFile(const PendingFile&) = delete;
    ~PendingFile();

private:
    PendingFile(std::filesystem::path target, std::filesystem::path temporary)
        : target_(std::move(target)), temporary_(std::move(temporary)) {}
    std::filesystem::path target_;
    std::filesystem::path temporary_; ///< empty once committed
};

/// prepare() and commit() in one.
Result<void> write_file_atomically(const std::filesystem::path& target, std::span<const std::uint8_t> bytes);

/// "%20" to " "; a broken escape is left as it stands.
std::string percent_decode(const std::string& text);
/// Escapes what a relative URI must not hold as it is; '/' stays.
std::string percent_encode(const std::string& path);
/// True for a relative path without "..", drive, scheme or backslash: safe to append to a folder.
bool is_plain_relative_path(const std::string& path);

/// Path of the file that a URI of a scene file means. Refused when it is absolute, has a scheme, or, with links and ".."
/// resolved, lies outside `folder`; the file itself is not opened.
Result<std::filesystem::path> resolve_uri(const std::filesystem::path& folder, const std::string& uri);

/// Strict base64; false when the text is malformed.
bool decode_base64(std::string_view text, std::vector<std::uint8_t>& out);

} // namespace atrium
