// Subcommands of atrium-cli. Each add_* registers one; when it was chosen, its exit status is left in `status`.
#pragma once

namespace CLI {
class App;
}

namespace atrium::cli {

void add_info(CLI::App& app, int& status);
void add_check(CLI::App& app, int& status);
void add_solve(CLI::App& app, int& status);
void add_measure(CLI::App& app, int& status);
void add_render(CLI::App& app, int& status);
void add_edit(CLI::App& app, int& status);
void add_reference(CLI::App& app, int& status);
void add_compare(CLI::App& app, int& status);
void add_inspect(CLI::App& app, int& status);
void add_bench(CLI::App& app, int& status);
void add_convert(CLI::App& app, int& status);

} // namespace atrium::cli
