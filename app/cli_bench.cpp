// atrium-cli bench: what light takes and how true it is, on the scenes that ship or on others.
#include "app/cli_commands.h"
#include "app/cli_support.h"
#include "engine/base/parallel.h"
#include "engine/io/edit_script_reader.h"
#include "engine/measure/drag_measure.h"
#include "engine/measure/error_audit.h"
#include "engine/scene/daylight.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

namespace atrium::cli {

namespace {

namespace fs = std::filesystem;

const std::map<std::string, SolverSettings::Quality> kQualities = {{"draft", SolverSettings::Quality::Draft},
                                                                   {"normal", SolverSettings::Quality::Normal},
                                                                   {"fine", SolverSettings::Quality::Fine}};

struct Arguments {
    std::string suite = "all";
    std::vector<std::string> files;
    std::string out;
    std::string quality = "draft";
    std::size_t checks = 3;
    std::optional<unsigned> threads;
    std::uint32_t seed = 1;
};

/// What Granier and Drettakis measured on a Pentium III of 733 MHz (2001, table 1 and section 6).
struct Published {
    const char* scene;
    double solve; ///< seconds to convergence
    double particles;
    double octree;   ///< bytes
    double update;   ///< seconds
    double share;    ///< of particles traced in an update, at most
    double degraded; ///< seconds of a degraded frame; 0 = not told
};
constexpr Published kPublished[] = {{"cabin", 2144.0, 1.6e6, 370e3, 14.5, 0.06, 3.5},
                                    {"street", 4740.0, 0.8e6, 2.3e6, 96.0, 0.17, 0.0}};

/// The folder of the scenes that ship, beside the program or in the tree that it was built from; empty when there is none.
fs::path scenes_folder() {
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed).parent_path();
    for (const fs::path& folder : {program / "../share/atrium/scenes", program / "../../scenes", fs::path("scenes")}) {
        if (fs::is_directory(folder, failed)) {
            return fs::weakly_canonical(folder, failed);
        }
    }
    return {};
}

/// Every scene file below a folder, in order.
std::vector<std::string> scenes_in(const fs::path& folder) {
    std::vector<std::string> out;
    std::error_code failed;
    for (auto it = fs::recursive_directory_iterator(folder, failed); it != fs::recursive_directory_iterator();
         it.increment(failed)) {
        const std::string extension = it->path().extension().string();
        const bool hard = it->path().string().find("/hard/") != std::string::npos; // these are for breaking the program
        if (!hard && (extension == ".gltf" || extension == ".glb")) {
            out.push_back(it->path().string());
        }
    }
    std::sort(out.begin(), out.end());
    return out;
}

Result<Scene> open_lit(const std::string& file) {
    auto loaded = load(file);
    if (!loaded) {
        return tl::unexpected(loaded.error());
    }
    if (has_no_light(loaded->scene)) {
        if (auto added = apply(loaded->scene, add_daylight(loaded->scene)); !added) {
            return tl::unexpected(added.error());
        }
    }
    return std::move(loaded->scene);
}

/// A table as it is printed and as it is written to the folder.
class Table {
public:
    Table(std::string name, const std::vector<std::string>& columns) : name_(std::move(name)) {
        add(columns);
        text_ += "|";
        for (std::size_t i = 0; i < columns.size(); ++i) {
            text_ += "---|";
        }
        text_ += "\n";
    }
    void add(const std::vector<std::string>& cells) {
        text_ += "|";
        for (std::size_t i = 0; i < cells.size(); ++i) {
            text_ += " " + cells[i] + " |";
            csv_ += (i > 0 ? "," : "") + cells[i];
        }
        text_ += "\n";
        csv_ += "\n";
    }
    /// To standard output and, where there is a folder, to NAME.md and NAME.csv.
    Result<void> write(const std::string& folder) const {
        if (auto written = write_text("-", text_ + "\n"); !written || folder.empty()) {
            return written;
        }
        if (auto written = write_text((fs::path(folder) / (name_ + ".md")).string(), text_); !written) {
            return written;
        }
        return write_text((fs::path(folder) / (name_ + ".csv")).string(), csv_);
    }

private:
    std::string name_, text_, csv_;
};

std::string percent(double share) { return fmt::format("{:.2f} %", 100.0 * share); }
std::string bytes(double n) { return n >= 1e6 ? fmt::format("{:.1f} MB", n / 1e6) : fmt::format("{:.0f} KB", n / 1e3); }

RunContext context_of_bench() {
    RunContext context;
    context.stop = new_stop_flag();
    return context;
}

// ---- light from nothing ----

/// Time, size and measured error of every scene.
int solve_suite(const Arguments& a, const std::vector<std::string>& files) {
    Table table("solve", {"scene", "quality", "threads", "triangles", "elements", "first picture s", "solved s", "rays",
                          "particles", "caustic textures", "peak MB", "error", "low", "high", "bias"});
    for (const std::string& file : files) {
        const auto scene = open_lit(file);
        if (!scene) {
            return refuse(scene.error());
        }
        SolveOptions options;
        options.quality = kQualities.at(a.quality);
        options.seed = a.seed;
        GiEngine engine;
        const RunContext context = context_of_bench();
        const auto solved = engine.solve(*scene, options, context);
        if (!solved || !(*solved)->final) {
            return kStopped;
        }
        AuditSettings settings = audit_settings(options.quality);
        settings.seed = a.seed;
        const auto light = audited(*scene, *solved, settings, context);
        const Statistics& s = light->statistics;
        std::size_t textures = 0;
        for (const auto& surface : light->surfaces) {
            textures += surface->caustic_textures_front.size() + surface->caustic_textures_back.size();
        }
        table.add({fs::path(file).stem().string(), a.quality, fmt::format("{}", s.threads), fmt::format("{}", s.triangles),
                   fmt::format("{}", s.elements), fmt::format("{:.2f}", s.time.first_picture),
                   fmt::format("{:.2f}", s.time.solve), fmt::format("{}", s.rays), fmt::format("{}", s.particles_emitted),
                   fmt::format("{}", textures), fmt::format("{:.0f}", double(peak_resident_bytes()) / 1e6),
                   percent(s.audit.rms), percent(s.audit.low), percent(s.audit.high), percent(s.audit.bias)});
    }
    if (auto written = table.write(a.out); !written) {
        return refuse(written.error());
    }
    return kDone;
}

// ---- the table of 2001 ----

/// Scenes with a scripted drag beside them: drag.json.
std::vector<std::string> with_drags(const std::vector<std::string>& files) {
    std::vector<std::string> out;
    std::copy_if(files.begin(), files.end(), std::back_inserter(out),
                 [](const std::string& file) { return fs::exists(fs::path(file).parent_path() / "drag.json"); });
    return out;
}

struct Drag {
    NodeId node;
    ScriptDrag script;
};
Result<Drag> read_drag(const Scene& scene, const fs::path& path) {
    const auto script = read_edit_script(path);
    if (!script) {
        return tl::unexpected(script.error());
    }
    for (const ScriptEdit& edit : script->edits) {
        if (const auto* drag = std::get_if<ScriptDrag>(&edit.value)) {
            for (const NodeId id : scene.in_tree_order()) {
                if (scene.nodes.find(id)->name == drag->node) {
                    return Drag{id, *drag};
                }
            }
            return fail(path.string(), drag->node, "the scene has no node of that name", "Use a name that `info` lists.");
        }
    }
    return fail(path.string(), "", "there is no drag in it", "Add an edit of the kind `drag`.");
}

Result<void> write_frames(const Arguments& a, const std::string& name, const DragMeasurement& drag) {
    if (a.out.empty()) {
        return {};
    }
    std::string csv = "frame,seconds,rays,particles_traced,particles_share,degraded_rms,degraded_rms_where_changed,"
                      "settled_rms,settled_rms_where_changed,stayed_rms,settle_seconds,fresh_seconds,changed_share\n";
    for (std::size_t i = 0; i < drag.frames.size(); ++i) {
        const DragFrame& f = drag.frames[i];
        csv += fmt::format("{},{},{},{},{}", i, f.seconds, f.rays, f.update.particles_traced, f.update.particles_share);
        if (const auto& e = f.error) {
            csv +=
                fmt::format(",{},{},{},{},{},{},{},{}\n", e->followed.rel_rms, e->followed_where_changed, e->settled.rel_rms,
                            e->settled_where_changed, e->stayed, e->settle_seconds, e->fresh_seconds, e->changed_share);
        } else {
            csv += ",,,,,,,,\n";
        }
    }
    return write_text((fs::path(a.out) / (name + "_frames.csv")).string(), csv);
}

int paper_suite(const Arguments& a, const std::vector<std::string>& files) {
    const std::vector<std::string> dragged = with_drags(files);
    if (dragged.empty()) {
        return refuse({"", "", "no scene has a drag", "Put a drag.json beside the scene: edits of the kind `drag`."});
    }
    Table table("paper", {"scene", "whose", "solved s", "particles", "octree", "settled update s", "particles traced",
                          "share of all", "degraded frame s", "p95 s", "solved / settled", "solved / degraded"});
    Table errors("paper_errors", {"scene", "frame", "light changed on", "degraded rms", "where changed", "settled rms",
                                  "where changed", "had it stayed"});
    for (const std::string& file : dragged) {
        auto scene = open_lit(file);
        if (!scene) {
            return refuse(scene.error());
        }
        const auto drag = read_drag(*scene, fs::path(file).parent_path() / "drag.json");
        if (!drag) {
            return refuse(drag.error());
        }
        SolveOptions options;
        options.quality = kQualities.at(a.quality);
        options.seed = a.seed;
        const RunContext context = context_of_bench();
        const auto found =
            measure_drag(std::move(*scene), drag->node, drag->script.positions, options, a.checks, 4096, context);
        if (!found) {
            return context.should_stop() ? int(kStopped) : refuse(found.error());
        }
        const std::string name = fs::path(file).stem().string();
        double least = 1.0;
        double most = 0.0;
        std::uint64_t traced = 0;
        std::uint64_t octree = 0;
        for (std::size_t i = 0; i < found->frames.size(); ++i) {
            const DragFrame& f = found->frames[i];
            least = std::min(least, f.update.particles_share);
            most = std::max(most, f.update.particles_share);
            traced = std::max(traced, f.update.particles_traced);
            octree = std::max(octree, f.update.octree_bytes);
            if (const auto& e = f.error) {
                errors.add({name, fmt::format("{}", i + 1), percent(e->changed_share), percent(e->followed.rel_rms),
                            percent(e->followed_where_changed), percent(e->settled.rel_rms),
                            percent(e->settled_where_changed), percent(e->stayed)});
            }
        }
        const double settle = found->mean_of(&FrameError::settle_seconds);
        const double fresh = found->mean_of(&FrameError::fresh_seconds);
        const double frame = found->frame_seconds(0.5);
        table.add({name, fmt::format("ours, {}, {} threads", a.quality, found->solved.threads), fmt::format("{:.2f}", fresh),
                   fmt::format("{}", found->solved.particles_emitted), octree > 0 ? bytes(double(octree)) : "not built",
                   fmt::format("{:.2f}", settle), fmt::format("at most {}", traced),
                   fmt::format("{} to {}", percent(least), percent(most)), fmt::format("{:.3f}", frame),
                   fmt::format("{:.3f}", found->frame_seconds(0.95)), fmt::format("{:.0f}", fresh / settle),
                   fmt::format("{:.0f}", fresh / frame)});
        for (const Published& p : kPublished) {
            if (name == p.scene) {
                table.add({name, "2001, 733 MHz", fmt::format("{:.0f}", p.solve), fmt::format("{:.0f}", p.particles),
                           bytes(p.octree), fmt::format("{:.1f}", p.update), "", fmt::format("at most {}", percent(p.share)),
                           p.degraded > 0.0 ? fmt::format("{:.1f}", p.degraded) : "", "",
                           fmt::format("{:.0f}", p.solve / p.update),
                           p.degraded > 0.0 ? fmt::format("{:.0f}", p.solve / p.degraded) : ""});
            }
        }
        if (auto written = write_frames(a, name, *found); !written) {
            return refuse(written.error());
        }
    }
    for (const Table* t : {&table, &errors}) {
        if (auto written = t->write(a.out); !written) {
            return refuse(written.error());
        }
    }
    return kDone;
}

int run(const Arguments& a) {
    if (!a.out.empty()) {
        std::error_code failed;
        fs::create_directories(a.out, failed);
        if (failed) {
            return refuse(
                {a.out, "", "cannot be made a folder: " + failed.message(), "Choose a folder that you may write to."});
        }
    }
    if (a.threads) {
        set_thread_limit(*a.threads);
    }
    std::vector<std::string> files = a.files;
    if (files.empty()) {
        files = scenes_in(scenes_folder());
        if (files.empty()) {
            return refuse({"", "", "the scenes that ship with Atrium are not there", "Name scene files."});
        }
    }
    int status = kDone;
    if (a.suite != "paper") {
        status = solve_suite(a, files);
    }
    if (a.suite != "solve" && status == kDone) {
        status = paper_suite(a, files);
    }
    return status;
}

} // namespace

void add_bench(CLI::App& app, int& status) {
    auto a = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("bench", "Measure how fast and how true the light is");
    command->add_option("FILE", a->files, "Scenes (default: all that ship)");
    command
        ->add_option(
            "--suite", a->suite,
            "solve: every scene from nothing, with its measured error; paper: drags beside new solutions, in the table "
            "of Granier and Drettakis 2001, for scenes with a drag.json beside them; or all")
        ->check(CLI::IsMember({"all", "solve", "paper"}));
    command->add_option("-o,--output", a->out, "Folder for the tables as Markdown and CSV, and every frame of a drag");
    command->add_option("--quality", a->quality, "draft, normal or fine")->check(CLI::IsMember({"draft", "normal", "fine"}));
    command->add_option("--checks", a->checks, "Frames of a drag that are compared with a new solution")
        ->check(CLI::Range(1, 1000));
    command->add_option("--threads", a->threads, "Number of worker threads, 0 = one per core")->check(CLI::Range(0U, 1024U));
    command->add_option("--seed", a->seed, "Seed of the random numbers");
    command->callback([a, &status] { status = run(*a); });
}

} // namespace atrium::cli
