// atrium-cli: the engine without the editor. Subcommands are in cli_<name>.cpp.
#include "app/cli_commands.h"
#include "app/cli_support.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <exception>
#include <new>
#include <sstream>

int main(int argc, char** argv) {
    using namespace atrium::cli;
    install_signal_handlers();
    CLI::App app("Global illumination of interiors from the command line.\n"
                 "Exit status: 0 done, 1 wrong input or request, 2 stopped but wrote what it had, 3 internal error.",
                 "atrium-cli");
    app.set_version_flag("--version", "atrium-cli " ATRIUM_VERSION);
    app.require_subcommand(1);
    int status = kDone;
    try {
        add_info(app, status);
        add_check(app, status);
        add_solve(app, status);
        add_measure(app, status);
        add_render(app, status);
        add_edit(app, status);
        add_reference(app, status);
        add_compare(app, status);
        add_inspect(app, status);
        add_bench(app, status);
        add_convert(app, status);
        app.parse(argc, argv);
    } catch (const CLI::Success& success) { // --help, --version
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        std::ostringstream text;
        app.exit(error, text, text);
        complain(text.str().substr(0, text.str().find_last_not_of('\n') + 1));
        return kWrongInput;
    } catch (const std::bad_alloc&) {
        complain("out of memory. Use a smaller scene or --quality draft");
        return kInternal;
    } catch (const std::exception& error) {
        complain(std::string("internal error: ") + error.what());
        return kInternal;
    }
    return status;
}
