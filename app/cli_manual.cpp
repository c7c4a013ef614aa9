#include "app/cli_manual.h"

#include "app/cli_support.h"
#include "app/cli_thresholds.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace atrium::cli {

namespace {

/// "TEXT:{draft,normal}" -> draft, normal.
std::vector<std::string> choices_in(const std::string& type) {
    std::vector<std::string> out;
    const std::size_t open = type.find('{');
    const std::size_t close = type.find('}');
    if (open == std::string::npos || close == std::string::npos) {
        return out;
    }
    for (std::size_t begin = open + 1; begin < close;) {
        const std::size_t end = std::min(type.find(',', begin), close);
        out.push_back(type.substr(begin, end - begin));
        begin = end + 1;
    }
    return out;
}

app::OptionHelp describe(const CLI::Option& option) {
    app::OptionHelp out;
    for (const std::string& name : option.get_snames()) {
        out.names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        out.names.push_back("--" + name);
    }
    if (out.names.empty()) {
        out.names.push_back(option.get_single_name());
    } else if (option.get_items_expected_max() > 0) {
        const std::string type = option.get_type_name();
        out.choices = choices_in(type);
        out.value = type.substr(0, type.find(':'));
        out.value = out.value == "TEXT" ? "VALUE" : out.value == "FLOAT" || out.value == "UINT" ? "NUMBER" : out.value;
    }
    if (option.check_lname("threshold")) {
        out.beginnings = threshold_beginnings();
    }
    out.text = option.get_description();
    if (option.get_required() && !option.get_positional()) {
        out.text += " (required)";
    }
    out.group = option.get_group() == "Options" ? "" : option.get_group();
    return out;
}

app::CommandHelp describe(const CLI::App& app) {
    app::CommandHelp out;
    out.name = app.get_parent() == nullptr ? "" : app.get_name();
    out.text = app.get_description();
    for (const CLI::Option* option : app.get_options()) {
        if (!option->get_group().empty()) { // without a group it is not in --help either
            (option->get_positional() ? out.arguments : out.options).push_back(describe(*option));
        }
    }
    return out;
}

} // namespace

app::ProgramHelp program_help(const CLI::App& program) {
    app::ProgramHelp out;
    out.name = program.get_name();
    out.summary = "global illumination of interiors from the command line";
    out.description =
        "Solves, measures, draws and checks scenes in glTF 2.0 (.gltf, .glb) and Atrium projects (.atrium), without a "
        "display. Each command has its own options; a file is never changed in place unless it is named as the output.";
    out.own = describe(program);
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
        out.commands.push_back(describe(*command));
    }
    out.exit_status = {
        {"0", "Done."}, {"1", "Wrong input or request."}, {"2", "Stopped but wrote what it had."}, {"3", "Internal error."}};
    out.see_also = {"atrium"};
    return out;
}

} // namespace atrium::cli
