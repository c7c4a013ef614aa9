#include "app/cli_support.h"

#include <fmt/format.h>

#include <atomic>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <unistd.h>

namespace atrium::cli {

namespace {

const RunContext::Clock::time_point kStart = RunContext::Clock::now();

// A handler may only touch lock-free atomics. Flags are never freed (a few per process), so a pointer read by the handler
// stays valid.
std::atomic<const StopFlag*> current_flag{nullptr};
std::atomic<int> signal_count{0};

extern "C" void on_signal(int) {
    if (signal_count.fetch_add(1) >= 2) {
        _exit(kStopped);
    }
    if (const StopFlag* flag = current_flag.load()) {
        flag->request_stop();
    }
}

bool line_open = false;

} // namespace

void complain(const std::string& message) {
    finish_progress();
    fmt::print(stderr, "atrium-cli: {}\n", message);
}

int refuse(const Error& error) {
    complain(error.message());
    return kWrongInput;
}

double seconds_since_start() { return std::chrono::duration<double>(RunContext::Clock::now() - kStart).count(); }

RunContext::Clock::time_point program_start() { return kStart; }

void install_signal_handlers() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return signal_count.load() > 0; }

StopFlag new_stop_flag() {
    static std::vector<std::unique_ptr<StopFlag>> kept;
    kept.push_back(std::make_unique<StopFlag>());
    current_flag.store(kept.back().get());
    if (interrupted()) { // a signal that came before there was anything to stop
        kept.back()->request_stop();
    }
    return *kept.back();
}

std::function<void(const Progress&)> progress_reporter(bool asked_for) {
    const bool terminal = isatty(STDERR_FILENO) != 0;
    if (!asked_for && !terminal) {
        return {};
    }
    return [terminal, phase = std::string(), percent = -1](const Progress& progress) mutable {
        const int now = int(progress.fraction * 100.0);
        if (terminal) {
            if (now != percent || progress.phase != phase) {
                fmt::print(stderr, "\r\033[K{:3d} %  {}", now, progress.phase);
                std::fflush(stderr);
                line_open = true;
            }
        } else if (progress.phase != phase || now >= percent + 10) {
            fmt::print(stderr, "progress: {:3d} % {}\n", now, progress.phase);
        } else {
            return;
        }
        phase = progress.phase;
        percent = now;
    };
}

void finish_progress() {
    if (line_open) {
        fmt::print(stderr, "\r\033[K");
        line_open = false;
    }
}

Result<LoadedScene> load(const std::string& path) {
    auto loaded = read_scene(path);
    if (loaded) {
        for (const Problem& problem : loaded->problems) {
            if (problem.severity != Problem::Severity::Note) {
                complain(fmt::format("{}: {}: {}", severity_name(problem.severity), path,
                                     Error{"", problem.where, problem.what, problem.hint}.message()));
            }
        }
    }
    return loaded;
}

Result<void> write_text(const std::string& path, const std::string& text) {
    if (path == "-") {
        if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
            return fail("", "", "cannot write to standard output");
        }
        return {};
    }
    const std::string temporary = fmt::format("{}.{}.tmp", path, getpid());
    std::error_code error;
    {
        std::ofstream out(temporary, std::ios::binary);
        out.write(text.data(), std::streamsize(text.size()));
        out.close();
        if (!out) {
            std::filesystem::remove(temporary, error);
            return fail(path, "", "cannot be written", "Check the folder's permissions and the space left on the disk.");
        }
    }
    std::filesystem::rename(temporary, path, error);
    if (error) {
        const std::string reason = error.message();
        std::filesystem::remove(temporary, error);
        return fail(path, "", "cannot be written: " + reason);
    }
    return {};
}

Result<std::string> read_text(const std::string& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        return fail(path, "", "is a folder, not a file");
    }
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        return fail(path, "", "cannot be opened", "Check the path and its permissions.");
    }
    return std::string(std::istreambuf_iterator<char>(in), {});
}

Result<void> check_output(const std::string& path) {
    if (path.empty() || path == "-") {
        return {};
    }
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::absolute(path, error).parent_path();
    if (!std::filesystem::is_directory(folder, error)) {
        return fail(path, "", "its folder does not exist", "Create it first.");
    }
    if (std::filesystem::is_directory(path, error)) {
        return fail(path, "", "is a folder, not a file");
    }
    return {};
}

Result<std::pair<int, int>> parse_size(const std::string& text) {
    std::pair<int, int> size;
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.first);
    if (width.ec == std::errc() && width.ptr != end && (*width.ptr == 'x' || *width.ptr == 'X')) {
        const auto height = std::from_chars(width.ptr + 1, end, size.second);
        if (height.ec == std::errc() && height.ptr == end && size.first >= 1 && size.second >= 1 && size.first <= 16384 &&
            size.second <= 16384) {
            return size;
        }
    }
    return fail("", "--size", "'" + text + "' is not a size", "Write it as 1280x720, each side from 1 to 16384.");
}

std::string extension_of(const std::string& path) {
    std::string out = std::filesystem::path(path).extension().string();
    for (char& c : out) {
        c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    }
    return out;
}

} // namespace atrium::cli
