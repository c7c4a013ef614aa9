// atrium-cli edit: plays a script of edits through the editor's own job queue and tells how fast and how true the light
// follows.
#include "app/cli_commands.h"
#include "app/cli_solving.h"
#include "app/cli_stats.h"
#include "engine/io/edit_script_reader.h"
#include "engine/measure/light_difference.h"
#include "engine/session/script_player.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace atrium::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kVerified = 4096; // places at which light is compared

struct Arguments {
    std::string file;
    std::string script;
    std::string out;
    bool verify = false;
    SolveArguments solve;
};

/// The light after an edit against a solve of the same scene from the start.
struct Verification {
    double fresh_seconds = 0;
    LightDifference difference;
    std::optional<double> settled; ///< rel_rms of the light that was settled first
};
struct Played {
    EditReport report;
    std::optional<Verification> verification;
};

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json as_json(const Played& played, bool verified) {
    const EditReport& r = played.report;
    Json frames = Json::array();
    for (const FrameReport& frame : r.frames) {
        frames.push_back({{"latency", number_or_null(frame.latency)},
                          {"degraded", frame.update.degraded},
                          {"particles_traced", frame.update.particles_traced},
                          {"links_changed", frame.update.links_changed}});
    }
    Json out = {{"kind", r.kind},
                {"node", r.target},
                {"frames", frames},
                {"settle", number_or_null(r.settle)},
                {"settled", number_or_null(r.settled)},
                {"particles_traced", r.update.particles_traced},
                {"particles_share", r.update.particles_share},
                {"links_visited", r.update.links_visited},
                {"links_changed", r.update.links_changed},
                {"octree_bytes", r.update.octree_bytes}};
    if (verified) {
        out["verify"] = nullptr;
    }
    if (const auto& v = played.verification) {
        out["verify"] = {{"fresh_seconds", v->fresh_seconds},
                         {"rel_rms", v->difference.rel_rms},
                         {"rel_max", v->difference.rel_max},
                         {"energy_rel", v->difference.energy_rel},
                         {"points", v->difference.points}};
        out["verify"]["settled_rel_rms"] = number_or_null(v->settled);
    }
    return out;
}

std::string table(const std::vector<Played>& edits) {
    std::string out = fmt::format("{:<9} {:<24} {:>7} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "edit", "node", "frames",
                                  "settle s", "fresh s", "rel rms", "rel max", "energy");
    for (const Played& p : edits) {
        const EditReport& r = p.report;
        out += fmt::format("{:<9} {:<24} {:>7} {:>10}", r.kind, r.target, r.frames.size(),
                           r.settle ? fmt::format("{:.3f}", *r.settle) : "-");
        if (const auto& v = p.verification) {
            out += fmt::format(" {:>10.3f} {:>10.3g} {:>10.3g} {:>10.3g}\n", v->fresh_seconds, v->difference.rel_rms,
                               v->difference.rel_max, v->difference.energy_rel);
        } else {
            out += fmt::format(" {0:>10} {0:>10} {0:>10} {0:>10}\n", "-");
        }
    }
    return out;
}

/// Plays a script on an opened scene; what it came to is in the members.
class Run {
public:
    Run(const Arguments& a, Solved& solved, const EditScript& script)
        : a_(a), solved_(solved), script_(script), context_(context_for(a.solve)) {}

    Result<void> play() {
        const bool stored = solved_.from_file && solved_.solution->final;
        solved_.from_file = stored;
        ScriptPlayer player(
            solved_.scene, stored ? solved_.solution : nullptr,
            [this](const Scene& scene, SolveOptions options, const RunContext& context, const auto& on_snapshot) {
                set_options(options, scene, a_.solve);
                solved_.from_file = false;
                return solved_.engine.solve(scene, options, context, on_snapshot);
            },
            context_);
        auto done = play_all(player);
        finish_progress();
        solved_.scene = player.scene();
        solved_.solution = player.light();
        light_is_current_ = player.light_is_current();
        return done;
    }
    [[nodiscard]] bool light_is_current() const { return light_is_current_; }
    [[nodiscard]] const std::vector<Played>& edits() const { return edits_; }

private:
    Result<void> play_all(ScriptPlayer& player) {
        auto on = player.settle();
        for (std::size_t i = 0; on && *on && i < script_.edits.size(); ++i) {
            auto report = player.play(script_.edits[i]);
            if (!report) {
                return fail(script_.file, script_.place(i), report.error().what, report.error().hint);
            }
            on = !report->stopped;
            const bool settled = report->settle.has_value();
            edits_.push_back({std::move(*report), {}});
            if (a_.verify && settled) {
                on = verify(player, edits_.back());
            }
        }
        if (on && *on) {
            on = player.settle(); // a last drag may not have been waited for
        }
        if (!on) {
            return fail(solved_.file, on.error().where, on.error().what, on.error().hint);
        }
        solved_.stopped = !*on;
        return {};
    }

    /// False when it was stopped.
    Result<bool> verify(const ScriptPlayer& player, Played& played) {
        SolveOptions options;
        set_options(options, player.scene(), a_.solve);
        GiEngine fresh;
        const double before = seconds_since_start();
        const auto result = fresh.solve(player.scene(), options, context_);
        if (!result || !(*result)->final) {
            if (!result && !context_.should_stop()) {
                return tl::unexpected(result.error());
            }
            return false;
        }
        const double fresh_seconds = seconds_since_start() - before;
        std::vector<SensorPlace> places = seen_places(player.scene(), kVerified);
        if (places.empty()) { // all is dark, or ought to be
            places = spread_places(player.scene(), **result, kVerified);
        }
        played.verification =
            Verification{fresh_seconds, light_difference(player.scene(), *player.light(), **result, places), {}};
        if (const auto& settled = played.report.settled_light) {
            played.verification->settled = light_difference(player.scene(), *settled, **result, places).rel_rms;
        }
        return true;
    }

    const Arguments& a_;
    Solved& solved_;
    const EditScript& script_;
    const RunContext context_;
    std::vector<Played> edits_;
    bool light_is_current_ = false;
};

int write_results(const Arguments& a, const Solved& solved, const Run& run) {
    if (!a.out.empty()) {
        WriteOptions options;
        if (run.light_is_current()) {
            options.solution = encode_solution(*solved.solution, solved.scene);
        } else {
            complain(fmt::format("{}: the project is written without light: that of its last edit was not finished", a.out));
        }
        if (auto written = write_scene(a.out, solved.scene, options); !written) {
            return refuse(written.error());
        }
    }
    if (!a.solve.stats.empty()) {
        Json out = statistics_object(solved);
        out["edits"] = Json::array();
        for (const Played& played : run.edits()) {
            out["edits"].push_back(as_json(played, a.verify));
        }
        if (auto written = write_text(a.solve.stats, as_text(out)); !written) {
            return refuse(written.error());
        }
    }
    if (a.verify && a.solve.stats != "-") {
        if (auto written = write_text("-", table(run.edits())); !written) {
            return refuse(written.error());
        }
    }
    return solved.stopped ? kStopped : kDone;
}

int run(const Arguments& a) {
    if (!a.out.empty() && extension_of(a.out) != ".atrium") {
        return refuse({a.out, "", "a solved project must end in .atrium",
                       "To write only the scene, use `atrium-cli convert` on the project."});
    }
    if (auto fine = check_output(a.out); !fine) {
        return refuse(fine.error());
    }
    const auto script = read_edit_script(a.script);
    if (!script) {
        return refuse(script.error());
    }
    auto solved = open_scene(a.file, a.solve);
    if (!solved) {
        return solved.error();
    }
    if (auto fine = rehearse(solved->scene, *script); !fine) {
        return refuse(fine.error());
    }
    Run run(a, *solved, *script);
    if (auto done = run.play(); !done) {
        return refuse(done.error());
    }
    if (solved->stopped) {
        complain(fmt::format(
            "{}: stopped {} after {} of {} edits", a.script, interrupted() ? "by a signal" : "at the time limit",
            std::count_if(run.edits().begin(), run.edits().end(), [](const Played& p) { return !p.report.stopped; }),
            script->edits.size()));
    }
    return write_results(a, *solved, run);
}

} // namespace

void add_edit(CLI::App& app, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("edit", "Play a script of edits and let the light follow, as in the editor");
    command->add_option("FILE", a->file, "Scene: .gltf, .glb or .atrium; solved first unless it holds light")->required();
    command->add_option("--script", a->script, "The edits: JSON as the manual describes it")->required();
    command->add_flag("--verify", a->verify, "Solve the scene afresh after every edit and print how far its light is apart");
    command->add_option("-o,--output", a->out, "Project to write: .atrium with the edited scene and its light");
    add_solve_options(*command, a->solve);
    command->callback([a, &status] { status = run(*a); });
}

} // namespace atrium::cli
