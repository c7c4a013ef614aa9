// The manual page and the shell completion of atrium-cli, from the options that CLI11 parses.
#pragma once

#include "app/program_help.h"

namespace CLI {
class App;
}

namespace atrium::cli {

/// All that `--help` of the program and its subcommands tells.
app::ProgramHelp program_help(const CLI::App& program);

} // namespace atrium::cli
