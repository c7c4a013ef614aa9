// Random sequences of edits: the light of updates beside that of new solutions, and how far two new solutions are apart.
#include "engine/measure/light_difference.h"
#include "tests/bench/bench_support.h"
#include "tests/support/user_edits.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace atrium::bench {
namespace {

using namespace test;

struct Arguments {
    int sequences = 20; ///< of each room
    int edits = 20;
    std::size_t points = 2000;
    std::string quality = "draft";
};

/// Mean and largest of what was measured after each sequence.
struct Figures {
    std::vector<double> rms, energy;
    void add(const LightDifference& d) {
        rms.push_back(100.0 * d.rel_rms);
        energy.push_back(100.0 * d.energy_rel);
    }
    [[nodiscard]] std::string text() const {
        const auto mean = [](const std::vector<double>& v) {
            double sum = 0.0;
            for (const double x : v) {
                sum += x / double(v.size());
            }
            return sum;
        };
        return fmt::format("{:.2f} ({:.2f}) | {:.3f} ({:.3f})", mean(rms), *std::max_element(rms.begin(), rms.end()),
                           mean(energy), *std::max_element(energy.begin(), energy.end()));
    }
};

int run(const Arguments& a) {
    fmt::print("Mean (largest) of {} sequences of {} edits each, % of the mean light at {} places that can be seen.\n\n"
               "| room | hurried: rms | energy | settled: rms | energy | two seeds: rms | energy | new solutions |\n"
               "|---|---|---|---|---|---|---|---|\n",
               a.sequences, a.edits, a.points);
    for (std::size_t kind = 0; kind < kRoomKinds; ++kind) {
        Figures hurried, settled, seeds;
        int refused = 0;
        for (int sequence = 0; sequence < a.sequences; ++sequence) {
            EditedRoom room{RoomKind(kind)};
            SolveOptions options;
            options.quality = qualities().at(a.quality);
            options.keep_for_updates = true;
            GiEngine engine;
            if (!engine.solve(room.scene, options, {})) {
                return 1;
            }
            UserEdits user(room, 1000 * (kind + 1) + std::uint64_t(sequence), followed_edit_kinds());
            std::shared_ptr<const Solution> followed;
            for (int i = 0; i < a.edits; ++i) {
                (void)user.step();
                auto updated = engine.update(room.scene, options, {});
                if (!updated) {
                    ++refused;
                    updated = engine.solve(room.scene, options, {});
                }
                followed = *updated;
            }
            SolveOptions settle = options;
            settle.settle = true;
            const auto exact = engine.update(room.scene, settle, {});
            const auto fresh = [&](std::uint32_t seed) {
                GiEngine other;
                SolveOptions anew = options;
                anew.keep_for_updates = false;
                anew.seed = seed;
                return *other.solve(room.scene, anew, {});
            };
            const auto truth = fresh(1);
            const auto places = seen_places(room.scene, a.points);
            if (places.empty()) {
                continue; // every lamp is off
            }
            hurried.add(light_difference(room.scene, *followed, *truth, places));
            settled.add(light_difference(room.scene, exact ? **exact : *followed, *truth, places));
            seeds.add(light_difference(room.scene, *fresh(2), *truth, places));
        }
        fmt::print("| {} | {} | {} | {} | {} of {} |\n", room_kind_name(RoomKind(kind)), hurried.text(), settled.text(),
                   seeds.text(), refused, a.sequences * a.edits);
        std::fflush(stdout);
    }
    return 0;
}

} // namespace
} // namespace atrium::bench

int main(int argc, char** argv) {
    CLI::App app{"Random sequences of edits in five rooms: updates beside new solutions."};
    atrium::bench::Arguments a;
    app.add_option("--sequences", a.sequences, "of each room")->check(CLI::PositiveNumber);
    app.add_option("--edits", a.edits, "in each")->check(CLI::PositiveNumber);
    app.add_option("--points", a.points, "where the light is compared");
    app.add_option("--quality", a.quality)->check(CLI::IsMember({"draft", "normal", "fine"}));
    CLI11_PARSE(app, argc, argv);
    return atrium::bench::run(a);
}
