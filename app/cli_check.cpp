// atrium-cli check: problems only; exit status 1 when any is an error.
#include "app/cli_commands.h"
#include "app/cli_problems.h"
#include "app/cli_stats.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace atrium::cli {

std::vector<Problem> all_problems(const LoadedScene& loaded) {
    std::vector<Problem> out = loaded.problems;
    for (Problem& problem : find_problems(loaded.scene)) {
        if (std::find(out.begin(), out.end(), problem) == out.end()) {
            out.push_back(std::move(problem));
        }
    }
    if (const ImportSuggestion fix = suggest_import_fix(loaded.scene); fix.any()) {
        std::string change;
        if (fix.unit_scale != 1.0) {
            change = fmt::format("coordinates times {} would be metres", fix.unit_scale);
        }
        if (fix.z_up) {
            change += change.empty() ? "" : " and ";
            change += "+Z seems to point up";
        }
        out.push_back({Problem::Severity::Warning, {}, "units and axes", fix.why, change});
    }
    std::stable_sort(out.begin(), out.end(), [](const Problem& a, const Problem& b) { return a.severity > b.severity; });
    return out;
}

std::string problem_line(const Problem& problem) {
    return fmt::format("{}: {}", severity_name(problem.severity),
                       Error{"", problem.where, problem.what, problem.hint}.message());
}

namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
    std::string file;
    bool json = false;
};

int run(const Arguments& a) {
    auto loaded = read_scene(a.file);
    std::vector<Problem> problems;
    if (loaded) {
        problems = all_problems(*loaded);
    } else {
        const Error& e = loaded.error();
        refuse(e);
        problems.push_back({Problem::Severity::Error, {}, e.where, e.what, e.hint});
    }
    const auto errors = std::count_if(problems.begin(), problems.end(),
                                      [](const Problem& p) { return p.severity == Problem::Severity::Error; });
    std::string text;
    if (a.json) {
        const Json out = {
            {"file", a.file}, {"readable", loaded.has_value()}, {"errors", errors}, {"problems", problems_json(problems)}};
        text = out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    } else if (loaded) {
        for (const Problem& problem : problems) {
            text += problem_line(problem) + "\n";
        }
    }
    if (const auto written = write_text("-", text); !written) {
        return refuse(written.error());
    }
    return errors > 0 ? kWrongInput : kDone;
}

} // namespace

void add_check(CLI::App& app, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("check", "Problems only; exit status 1 if any is an error");
    command->add_option("FILE", a->file, "Scene: .gltf, .glb or .atrium")->required();
    command->add_flag("--json", a->json, "As one JSON object");
    command->callback([a, &status] { status = run(*a); });
}

} // namespace atrium::cli
