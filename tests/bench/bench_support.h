// What the benchmarks share: processor time, scenes as they are solved, and one process for each measurement.
#pragma once

#include "engine/io/scene_file.h"
#include "engine/scene/daylight.h"

#include <fmt/format.h>

#include <cstdio>
#include <ctime>
#include <map>
#include <optional>
#include <string>
#include <sys/wait.h>
#include <type_traits>
#include <unistd.h>

namespace atrium::bench {

/// Processor time of all threads of this process so far, seconds. Unlike the wall clock it hardly sees what else runs.
inline double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// By the names of the command line.
inline const std::map<std::string, SolverSettings::Quality>& qualities() {
    static const std::map<std::string, SolverSettings::Quality> all = {{"draft", SolverSettings::Quality::Draft},
                                                                       {"normal", SolverSettings::Quality::Normal},
                                                                       {"fine", SolverSettings::Quality::Fine}};
    return all;
}

/// A scene that has light.
struct LitScene {
    Scene scene;
    bool daylight = false; ///< the file brought no light of its own and got the afternoon of add_daylight()
};
/// Reads one; says on stderr why it cannot.
inline std::optional<LitScene> read_lit_scene(const std::string& file) {
    auto loaded = read_scene(file);
    if (!loaded) {
        fmt::print(stderr, "{}\n", loaded.error().message());
        return std::nullopt;
    }
    LitScene out{std::move(loaded->scene)};
    out.daylight = has_no_light(out.scene);
    if (out.daylight && !apply(out.scene, add_daylight(out.scene))) {
        fmt::print(stderr, "{}: daylight cannot be added\n", file);
        return std::nullopt;
    }
    return out;
}

/// Runs `body` in a process of its own, so that its peak memory is its own and no measurement warms up the next. The caller
/// must not have used the engine: its worker threads would be missing there. Nothing when the process failed.
template <class T, class F> std::optional<T> in_own_process(F&& body) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::fflush(nullptr); // or the child would print again what is buffered
    int ends[2];
    if (pipe(ends) != 0) {
        return std::nullopt;
    }
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        const T value = body();
        std::fflush(nullptr);
        const bool written = write(ends[1], &value, sizeof(T)) == ssize_t(sizeof(T));
        _exit(written ? 0 : 1);
    }
    close(ends[1]);
    T value{};
    std::size_t have = 0;
    while (child > 0 && have < sizeof(T)) {
        const ssize_t got = read(ends[0], reinterpret_cast<char*>(&value) + have, sizeof(T) - have);
        if (got <= 0) {
            break;
        }
        have += std::size_t(got);
    }
    close(ends[0]);
    int status = 0;
    const bool ended = child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    return ended && have == sizeof(T) ? std::optional<T>(value) : std::nullopt;
}

} // namespace atrium::bench
