// What --help knows of a program, and the manual page and the shell completion made of it. No Qt, no CLI11.
#pragma once

#include <string>
#include <vector>

namespace atrium::app {

struct OptionHelp {
    std::vector<std::string> names;   ///< with their dashes; a positional argument has one name without
    std::string value;                ///< what stands for its value, as "SECONDS"; empty for a switch
    std::vector<std::string> choices; ///< the only values it takes, when there are few
    std::string text;
    std::string group;                     ///< heading it stands under; empty: none of its own
    std::vector<std::string> beginnings{}; ///< of its values, when the rest is to be typed, as "width="
};

struct CommandHelp {
    std::string name; ///< empty for the program itself
    std::string text; ///< first line: a summary
    std::vector<OptionHelp> arguments;
    std::vector<OptionHelp> options;
};

struct ProgramHelp {
    std::string name;
    std::string summary;     ///< half a line for the page's title
    std::string description; ///< paragraphs parted by empty lines
    CommandHelp own;         ///< options before any subcommand
    std::vector<CommandHelp> commands;
    std::vector<std::pair<std::string, std::string>> exit_status;
    std::vector<std::string> see_also; ///< names of other programs with a page in section 1
};

/// The manual page, troff with the man macros, section 1. The same help gives the same bytes: no date is in it.
std::string manual_page(const ProgramHelp& help, const std::string& version);
/// A completion for bash: options, subcommands, choices, and scene files as arguments.
std::string bash_completion(const ProgramHelp& help);

} // namespace atrium::app
