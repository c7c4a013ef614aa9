#include "engine/io/file_access.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace atrium {
namespace {

namespace fs = std::filesystem;

std::string system_reason() { return std::error_code(errno, std::generic_category()).message(); }

/// Closes the descriptor at the end of the scope.
struct Descriptor {
    int fd;
    explicit Descriptor(int value) : fd(value) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd >= 0) {
            ::close(fd);
        }
    }
};

bool write_all(int fd, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(fd, bytes.data(), bytes.size());
        if (n < 0) {
            if (errno == EINTR) {
                continue;
            }
            return false;
        }
        bytes = bytes.subspan(std::size_t(n));
    }
    return true;
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    if (c >= 'a' && c <= 'f') {
        return c - 'a' + 10;
    }
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// Takes away what a killed process left half written beside `target`: its name tells the process. Only what is older than
/// an hour, since on a shared folder the process may live on another machine.
void remove_stale_temporaries(const fs::path& target) {
    constexpr auto kOld = std::chrono::hours(1);
    const std::string prefix = "." + target.filename().string() + ".";
    std::error_code error;
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    std::vector<fs::path> stale;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        if (!name.starts_with(prefix) || !name.ends_with(".tmp")) {
            continue;
        }
        int process = 0;
        const char* first = name.data() + prefix.size();
        const auto parsed = std::from_chars(first, name.data() + name.size(), process);
        std::error_code ignored;
        const auto written = fs::last_write_time(it->path(), ignored);
        if (parsed.ec == std::errc{} && *parsed.ptr == '-' && process > 0 && ::kill(process, 0) != 0 && errno == ESRCH &&
            !ignored && fs::file_time_type::clock::now() - written > kOld) {
            stale.push_back(it->path());
        }
    }
    for (const fs::path& path : stale) {
        fs::remove(path, error);
    }
}

bool has_scheme(const std::string& uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string::npos && uri.find_first_of("/?#") > colon;
}

} // namespace

Result<std::vector<std::uint8_t>> read_file(const fs::path& path, std::uint64_t max_bytes) {
    // O_NONBLOCK: opening a pipe that nobody writes to must not hang.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.fd < 0) {
        return fail(path.string(), "", "cannot be opened: " + system_reason());
    }
    struct stat info {};
    if (::fstat(file.fd, &info) != 0 || !S_ISREG(info.st_mode)) {
        return fail(path.string(), "", "is not a regular file");
    }
    if (std::uint64_t(info.st_size) > max_bytes) {
        return fail(path.string(), "", "is larger than " + std::to_string(max_bytes >> 20) + " MiB");
    }
    std::vector<std::uint8_t> bytes(std::size_t(info.st_size));
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t n = ::read(file.fd, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno == EINTR) {
            continue;
        }
        if (n <= 0) {
            return fail(path.string(), "", n < 0 ? "cannot be read: " + system_reason() : "became shorter while being read");
        }
        done += std::size_t(n);
    }
    return bytes;
}

Result<PendingFile> PendingFile::prepare(const fs::path& path, std::span<const std::uint8_t> bytes) {
    std::error_code ignored;
    fs::path target = path;
    if (fs::is_symlink(path, ignored)) {
        if (fs::path real = fs::weakly_canonical(path, ignored); !real.empty()) {
            target = std::move(real);
        }
    }
    remove_stale_temporaries(target);
    static std::atomic<unsigned> counter{0};
    const fs::path temporary = target.parent_path() / ("." + target.filename().string() + "." + std::to_string(::getpid()) +
                                                       "-" + std::to_string(counter++) + ".tmp");
    const Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file.fd < 0) {
        return fail(path.string(), "", "cannot be written: " + system_reason(),
                    "Choose a folder that exists and that you may write to.");
    }
    PendingFile pending(target, temporary);
    struct stat old {};
    if (::stat(target.c_str(), &old) == 0 && S_ISREG(old.st_mode)) {
        // Best effort: a file system without modes is no reason not to save.
        [[maybe_unused]] const int unused = ::fchmod(file.fd, old.st_mode & 07777);
    }
    if (!write_all(file.fd, bytes) || ::fsync(file.fd) != 0) {
        const bool full = errno == ENOSPC || errno == EDQUOT || errno == EFBIG;
        return fail(path.string(), "", "cannot be written: " + system_reason(),
                    full ? "The file that was there before is unchanged. Free some space, or save into another folder."
                         : "The file that was there before is unchanged.");
    }
    return pending;
}

Result<void> PendingFile::commit() {
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
        return fail(target_.string(), "", "cannot be replaced: " + system_reason(),
                    "The file that was there before is unchanged.");
    }
    temporary_.clear();
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
    const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (directory.fd >= 0) {
        // Some file systems cannot sync a folder; the new content itself is on disk already.
        [[maybe_unused]] const int unused = ::fsync(directory.fd);
    }
    return {};
}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : target_(std::move(other.target_)), temporary_(std::move(other.temporary_)) {
    other.temporary_.clear();
}

PendingFile::~PendingFile() {
    if (!temporary_.empty()) {
        ::unlink(temporary_.c_str());
    }
}

Result<void> write_file_atomically(const fs::path& target, std::span<const std::uint8_t> bytes) {
    Result<PendingFile> pending = PendingFile::prepare(target, bytes);
    if (!pending) {
        return tl::unexpected(pending.error());
    }
    return pending->commit();
}

std::string percent_decode(const std::string& text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0) {
            out += char(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2]));
            i += 2;
        } else {
            out += text[i];
        }
    }
    return out;
}

std::string percent_encode(const std::string& path) {
    static constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    static constexpr char kHex[] = "0123456789ABCDEF";
    std::string out;
    for (const char c : path) {
        if (kPlain.find(c) != std::string_view::npos) {
            out += c;
        } else {
            const auto byte = static_cast<unsigned char>(c);
            out += {'%', kHex[byte >> 4], kHex[byte & 15]};
        }
    }
    return out;
}

bool is_plain_relative_path(const std::string& path) {
    if (path.empty() || path.front() == '/' || path.back() == '/' || path.find('\\') != std::string::npos ||
        path.find('\0') != std::string::npos || has_scheme(path)) {
        return false;
    }
    for (const fs::path& part : fs::path(path)) {
        if (part == ".." || part == ".") {
            return false;
        }
    }
    return true;
}

Result<fs::path> resolve_uri(const fs::path& folder, const std::string& uri) {
    if (has_scheme(uri)) {
        return fail("", "", "\"" + uri + "\" is not a file beside the scene",
                    "Only relative file names and data: are opened.");
    }
    std::string name = percent_decode(uri);
    if (name.find('\0') != std::string::npos) {
        return fail("", "", "a file name contains a zero byte");
    }
    std::error_code error;
    const fs::path base = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
    if (error) {
        return fail("", "", "the folder of the scene cannot be read: " + error.message());
    }
    // Windows programs write backslashes; on this system they would be part of a name, which nobody means.
    if (!fs::exists(base / name, error)) {
        for (char& c : name) {
            c = c == '\\' ? '/' : c;
        }
    }
    const fs::path full = fs::path(name).is_absolute() ? fs::path(name) : base / name;
    const fs::path real = fs::weakly_canonical(full, error);
    const fs::path relative = error ? fs::path("..") : real.lexically_relative(base);
    if (relative.empty() || *relative.begin() == ".." || fs::path(name).is_absolute()) {
        return fail("", "", "\"" + uri + "\" lies outside the folder of the scene and was not opened",
                    "Put the file into the scene's folder and refer to it by a relative name.");
    }
    return real;
}

bool decode_base64(std::string_view text, std::vector<std::uint8_t>& out) {
    static constexpr auto kValues = [] {
        std::array<std::int8_t, 256> values{};
        values.fill(-1);
        constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for (std::size_t i = 0; i < kAlphabet.size(); ++i) {
            values[static_cast<unsigned char>(kAlphabet[i])] = std::int8_t(i);
        }
        return values;
    }();
    while (!text.empty() && text.back() == '=') {
        text.remove_suffix(1);
    }
    out.clear();
    out.reserve(text.size() * 3 / 4);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int value = kValues[static_cast<unsigned char>(c)];
        if (value < 0) {
            return false;
        }
        bits = (bits << 6) | std::uint32_t(value);
        count += 6;
        if (count >= 8) {
            count -= 8;
            out.push_back(std::uint8_t(bits >> count));
        }
    }
    return count < 6;
}

} // namespace atrium
