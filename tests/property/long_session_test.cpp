// A long session: random edits with undo go through the job queue, and neither memory nor light tells how long it was.
// ATRIUM_EDITS=10000 makes it as long as a day: ATRIUM_EDITS=10000 property_tests --gtest_filter=LongSession.*
#include "engine/session/engine_session.h"
#include "tests/support/user_edits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <malloc.h>
#include <mutex>
#include <thread>
#include <unistd.h>

namespace atrium::test {
namespace {

using namespace std::chrono_literals;

struct Memory {
    double in_use = 0;   ///< MiB that were asked for and not given back
    double resident = 0; ///< MiB of the process: with what the allocator keeps between blocks of several threads
};

Memory memory() {
    malloc_trim(0);
    const struct mallinfo2 heap = mallinfo2(); // of all threads
    constexpr double kMiB = 1024.0 * 1024.0;
    std::ifstream statm("/proc/self/statm");
    double pages = 0.0, resident = 0.0;
    statm >> pages >> resident;
    return {double(heap.uordblks + heap.hblkhd) / kMiB, resident * double(sysconf(_SC_PAGESIZE)) / kMiB};
}

/// Every number of the light that is shown, in order.
std::vector<float> all_light(const Solution& solution) {
    std::vector<float> out;
    const auto add = [&](const Rgb& c) { out.insert(out.end(), {c.r, c.g, c.b}); };
    for (const auto& layer : solution.surfaces) {
        const auto& indices = layer->mesh->indices;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            add(irradiance_at(*layer, {indices[i], indices[i + 1], indices[i + 2]}, vec3(0.2F, 0.3F, 0.5F), false));
        }
        for (const auto* rgb : {&layer->irradiance_front, &layer->irradiance_back}) {
            for (const Rgb& c : *rgb) {
                add(c);
            }
        }
    }
    return out;
}

TEST(LongSession, LeavesNoTraceInMemoryOrLight) {
    const char* wanted = std::getenv("ATRIUM_EDITS");
    const int edits = wanted != nullptr ? std::max(std::atoi(wanted), 200) : 240;
    constexpr int kBurst = 20; // edits between two rests
    EditedRoom room;
    const Scene at_first = room.scene;
    std::mutex mutex;
    std::condition_variable woken;
    EngineSession session([&] {
        const std::lock_guard lock(mutex);
        woken.notify_all();
    });
    std::uint64_t revision = 1;
    const auto rest = [&] { // until the newest edit has its complete light
        std::unique_lock lock(mutex);
        return woken.wait_for(lock, 600s, [&] {
            const SessionStatus status = session.status();
            return status.state == SessionStatus::State::Idle && status.shown_revision == revision;
        });
    };
    session.load(room.scene, revision, nullptr);
    ASSERT_TRUE(rest());
    const std::vector<float> first_light = all_light(*session.latest());

    UserEdits user(room, 2026, all_edit_kinds());
    // Memory goes up and down with what is in the room, so it is always looked at with the first scene.
    const auto at_first_scene = [&] {
        session.load(at_first, ++revision, nullptr);
        EXPECT_TRUE(rest());
        return memory();
    };
    constexpr int kWarm = 100; // edits until pools are filled
    Memory before;
    int done = 0;
    std::size_t wrong = 0;
    while (done < edits) {
        for (int k = 0; k < kBurst && done < edits; ++k, ++done) {
            const SceneEdit edit = user.step();
            const bool in_gesture = k % 5 != 4;
            session.post(edit, ++revision, in_gesture);
            if (!in_gesture) {
                session.end_gesture();
            }
            std::this_thread::sleep_for(10ms); // so that some meet a running solve and some do not
        }
        session.end_gesture();
        session.resume(); // the last edit may be one that changes no light
        ASSERT_TRUE(rest()) << "after " << done << " edits: " << session.status().message;
        ASSERT_TRUE(session.latest()->final);
        for (const float x : all_light(*session.latest())) {
            wrong += std::isfinite(x) && x >= 0.0F ? 0 : 1;
        }
        if (done == kWarm) {
            before = at_first_scene();
            session.load(room.scene, ++revision, nullptr);
            ASSERT_TRUE(rest());
        }
        if (wanted != nullptr && done % 500 == 0) {
            std::printf("%d edits: %.1f MiB in use, %.1f resident\n", done, memory().in_use, memory().resident);
            std::fflush(stdout);
        }
    }
    EXPECT_EQ(wrong, 0U) << "light that is negative or no number";
    // Equal to the light of a program that has just been started.
    {
        GiEngine fresh;
        SolveOptions options;
        options.quality = room.scene.settings.quality;
        options.seed = room.scene.settings.seed;
        const auto anew = fresh.solve(room.scene, options, {});
        ASSERT_TRUE(anew);
        EXPECT_EQ(all_light(*session.latest()), all_light(**anew)) << "to the last bit";
    }
    // And back at the first scene it is the first light.
    const Memory after = at_first_scene();
    EXPECT_EQ(all_light(*session.latest()), first_light);
    std::printf(
        "%d edits (%zu made, the others undo and redo): the first scene takes %.2f MiB (%.0f resident) after %d of them, "
        "%.2f (%.0f) after all\n",
        done, user.applied(), before.in_use, before.resident, kWarm, after.in_use, after.resident);
    // What edits leave behind would be in use. Resident is more, and not the same twice: threads free what others allocated,
    // and whole pages become free by chance; only what grows with every edit tells there.
    constexpr double kCaches = 0.5; // MiB
    constexpr double kPools = 40.0;
    EXPECT_LT(after.in_use, 1.05 * before.in_use + kCaches);
    EXPECT_LT(after.resident, 1.05 * before.resident + kPools);
}

} // namespace
} // namespace atrium::test
