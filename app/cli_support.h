// What every subcommand of atrium-cli shares: exit status, messages, files, stopping, progress.
#pragma once

#include "engine/base/result.h"
#include "engine/base/run_context.h"
#include "engine/io/scene_file.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace atrium::cli {

/// Exit status of the program (CONTRACTS).
enum ExitStatus : int { kDone = 0, kWrongInput = 1, kStopped = 2, kInternal = 3 };

/// Writes "atrium-cli: message" to standard error.
void complain(const std::string& message);
/// The same for an Error; returns kWrongInput so that a subcommand can `return refuse(...)`.
int refuse(const Error& error);

/// Time since the program started, seconds.
double seconds_since_start();
/// The moment from which `--time` counts.
RunContext::Clock::time_point program_start();

/// First SIGINT or SIGTERM stops the current job (see new_stop_flag), the third ends the program at once.
void install_signal_handlers();
/// Stop flag of the job that starts now: a signal raises it. What was raised for an earlier job does not carry over, so a
/// stopped solve can still be written or drawn.
StopFlag new_stop_flag();
/// True when any job of this process was stopped by a signal.
bool interrupted();

/// Reports progress to standard error: one line that is rewritten on a terminal, else a line per phase. Null when neither
/// asked for nor on a terminal.
std::function<void(const Progress&)> progress_reporter(bool asked_for);
/// Ends the rewritten line, if one was begun.
void finish_progress();

/// Reads a scene; its warnings and errors go to standard error.
Result<LoadedScene> load(const std::string& path);

/// Writes text to a file by way of a temporary one, or to standard output for "-".
Result<void> write_text(const std::string& path, const std::string& text);
Result<std::string> read_text(const std::string& path);
/// Refuses an output path whose folder does not exist, before hours of work. An empty path and "-" are fine.
Result<void> check_output(const std::string& path);
/// Width and height of a picture from text such as 1280x720, each from 1 to 16384.
Result<std::pair<int, int>> parse_size(const std::string& text);
/// Extension with its dot, in lower case.
std::string extension_of(const std::string& path);

} // namespace atrium::cli
