#include "app/program_help.h"

#include <fmt/format.h>

#include <algorithm>

namespace atrium::app {

namespace {

/// Text for troff: no character of it is a command.
std::string escaped(const std::string& text) {
    std::string out;
    bool line_start = true;
    for (const char c : text) {
        if (line_start && (c == '.' || c == '\'')) {
            out += "\\&";
        }
        line_start = c == '\n';
        switch (c) {
        case '\\': out += "\\e"; break;
        case '-': out += "\\-"; break;
        case '\'': out += "\\(aq"; break;
        case '`': out += "\\(ga"; break;
        case '^': out += "\\(ha"; break;
        case '~': out += "\\(ti"; break;
        default: out += c;
        }
    }
    return out;
}

/// The same, each line of it a paragraph.
std::string paragraphs(const std::string& text) {
    std::string out;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        if (!line.empty()) {
            out += (out.empty() ? "" : ".PP\n") + escaped(line) + "\n";
        }
        begin = end + 1;
    }
    return out;
}

std::string joined(const std::vector<std::string>& parts, const char* between) {
    return fmt::format("{}", fmt::join(parts, between));
}

void add_options(std::string& out, const std::vector<OptionHelp>& options) {
    for (const OptionHelp& option : options) {
        std::vector<std::string> names;
        for (const std::string& name : option.names) {
            names.push_back("\\fB" + escaped(name) + "\\fR");
        }
        const bool takes_value = !option.value.empty() || !option.choices.empty();
        const std::string value = option.choices.empty() ? "\\fI" + escaped(option.value) + "\\fR"
                                                         : "\\fB" + escaped(joined(option.choices, "|")) + "\\fR";
        out += ".TP\n" + joined(names, ", ") + (takes_value ? " " + value : "") + "\n" + escaped(option.text) + "\n";
    }
}

std::string synopsis(const std::string& program, const CommandHelp& command) {
    std::string out = "\\fB" + escaped(command.name.empty() ? program : program + " " + command.name) + "\\fR";
    if (!command.options.empty()) {
        out += " [\\fIOPTION\\fR]...";
    }
    for (const OptionHelp& argument : command.arguments) {
        out += " \\fI" + escaped(joined(argument.names, " ")) + "\\fR";
    }
    return out;
}

/// Options that stand in the same group in every command that has it are told once, under the group's name.
std::vector<std::string> groups_of(const ProgramHelp& help) {
    std::vector<std::string> out;
    for (const CommandHelp& command : help.commands) {
        for (const OptionHelp& option : command.options) {
            if (!option.group.empty() && std::find(out.begin(), out.end(), option.group) == out.end()) {
                out.push_back(option.group);
            }
        }
    }
    return out;
}

std::vector<OptionHelp> in_group(const std::vector<OptionHelp>& options, const std::string& group) {
    std::vector<OptionHelp> out;
    std::copy_if(options.begin(), options.end(), std::back_inserter(out),
                 [&](const OptionHelp& option) { return option.group == group; });
    return out;
}

/// Every command has --help; told once it is enough.
std::vector<OptionHelp> without_help(std::vector<OptionHelp> options) {
    std::erase_if(options, [](const OptionHelp& option) { return option.names.back() == "--help"; });
    return options;
}

std::string upper(std::string text) {
    for (char& c : text) {
        c = c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
    }
    return text;
}

/// `case` arms that complete the values of options and know which options take one.
std::string value_cases(const std::vector<OptionHelp>& options, const std::string& indent) {
    std::string out;
    for (const OptionHelp& option : options) {
        if (option.value.empty() && option.choices.empty()) {
            continue;
        }
        out += fmt::format("{}{})\n", indent, joined(option.names, "|"));
        const bool begun = !option.beginnings.empty();
        const std::vector<std::string>& words = begun ? option.beginnings : option.choices;
        out += words.empty() ? fmt::format("{}    _filedir\n", indent)
                             : fmt::format("{}    COMPREPLY=($(compgen -W '{}' -- \"$cur\"))\n", indent, joined(words, " "));
        out += begun ? fmt::format("{}    compopt -o nospace\n", indent) : "";
        out += fmt::format("{}    return ;;\n", indent);
    }
    return out;
}

std::string names_of(const std::vector<OptionHelp>& options) {
    std::vector<std::string> names;
    for (const OptionHelp& option : options) {
        names.insert(names.end(), option.names.begin(), option.names.end());
    }
    return joined(names, " ");
}

/// What is offered within one command: values, options, scene files.
std::string complete_command(const CommandHelp& command, const char* indent) {
    std::string out;
    if (const std::string cases = value_cases(command.options, std::string(indent) + "    "); !cases.empty()) {
        out += fmt::format("{}case $prev in\n{}{}esac\n", indent, cases, indent);
    }
    out += fmt::format("{0}if [[ $cur == -* ]]; then\n"
                       "{0}    COMPREPLY=($(compgen -W '{1}' -- \"$cur\"))\n"
                       "{0}    return\n{0}fi\n",
                       indent, names_of(command.options));
    if (!command.arguments.empty()) {
        out += fmt::format("{}_filedir '@(gltf|glb|atrium)'\n", indent);
    }
    return out;
}

} // namespace

std::string manual_page(const ProgramHelp& help, const std::string& version) {
    std::string out = fmt::format(".TH {} 1 \"\" \"Atrium {}\" \"User Commands\"\n", upper(escaped(help.name)), version);
    out += ".SH NAME\n" + escaped(help.name) + " \\- " + escaped(help.summary) + "\n.SH SYNOPSIS\n";
    if (help.commands.empty()) {
        out += synopsis(help.name, help.own) + "\n";
    }
    for (std::size_t i = 0; i < help.commands.size(); ++i) {
        out += (i > 0 ? ".br\n" : "") + synopsis(help.name, help.commands[i]) + "\n";
    }
    out += ".SH DESCRIPTION\n" + paragraphs(help.description);
    if (!help.own.arguments.empty()) {
        out += ".SH ARGUMENTS\n";
        add_options(out, help.own.arguments);
    }
    out += ".SH OPTIONS\n";
    add_options(out, help.own.options);
    if (!help.commands.empty()) {
        out += ".SH COMMANDS\n";
        for (const CommandHelp& command : help.commands) {
            out += ".SS " + escaped(command.name) + "\n" + paragraphs(command.text);
            add_options(out, command.arguments);
            add_options(out, without_help(in_group(command.options, "")));
            for (const std::string& group : groups_of(help)) {
                if (!in_group(command.options, group).empty()) {
                    out += ".PP\nTakes the options under " + upper(escaped(group)) + " too.\n";
                }
            }
        }
    }
    for (const std::string& group : groups_of(help)) {
        out += ".SH " + upper(escaped(group)) + "\n";
        const auto first = std::find_if(help.commands.begin(), help.commands.end(), [&](const CommandHelp& command) {
            return !in_group(command.options, group).empty();
        });
        add_options(out, in_group(first->options, group));
    }
    if (!help.exit_status.empty()) {
        out += ".SH EXIT STATUS\n";
        for (const auto& [status, meaning] : help.exit_status) {
            out += ".TP\n\\fB" + escaped(status) + "\\fR\n" + escaped(meaning) + "\n";
        }
    }
    out += ".SH SEE ALSO\n";
    for (const std::string& name : help.see_also) {
        out += ".BR " + escaped(name) + " (1),\n";
    }
    out += "the manual in /usr/share/doc/atrium/manual\n";
    return out;
}

std::string bash_completion(const ProgramHelp& help) {
    std::string function = "_" + help.name;
    std::replace(function.begin(), function.end(), '-', '_');
    std::string out = fmt::format("# bash completion for {0}, made from its option tables\n{1}() {{\n"
                                  "    local cur prev words cword\n    _init_completion || return\n",
                                  help.name, function);
    if (help.commands.empty()) {
        out += complete_command(help.own, "    ");
    } else {
        std::vector<std::string> names;
        for (const CommandHelp& command : help.commands) {
            names.push_back(command.name);
        }
        out += fmt::format("    local word command=\n"
                           "    for word in \"${{words[@]:1:cword-1}}\"; do\n"
                           "        [[ $word == -* ]] || {{ command=$word; break; }}\n    done\n"
                           "    case $command in\n"
                           "    '')\n        COMPREPLY=($(compgen -W '{} {}' -- \"$cur\")) ;;\n",
                           joined(names, " "), names_of(help.own.options));
        for (const CommandHelp& command : help.commands) {
            out += fmt::format("    {})\n{}        ;;\n", command.name, complete_command(command, "        "));
        }
        out += "    esac\n";
    }
    return out + fmt::format("}} &&\n    complete -F {} {}\n", function, help.name);
}

} // namespace atrium::app
