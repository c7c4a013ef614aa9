// The session with the real engine: what it shows after edits is what a fresh solve of the same scene gives.
#include "engine/session/engine_session.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

namespace atrium {
namespace {

using namespace std::chrono_literals;

TEST(SessionLight, ADragEndsInTheLightOfAFreshSolve) {
    Scene scene;
    scene.settings.quality = SolverSettings::Quality::Draft;
    test::add_room(scene, 4.0F, 2.5F, 3.0F, test::add_material(scene, 0.5F));
    const NodeId lamp = test::add_point_light(scene, {1.0, 2.0, 1.0}, 1000.0);

    std::mutex mutex;
    std::condition_variable woken;
    EngineSession session([&] {
        const std::lock_guard lock(mutex);
        woken.notify_all();
    });
    const auto wait_until_idle = [&] {
        std::unique_lock lock(mutex);
        return woken.wait_for(lock, 120s, [&] { return session.status().state == SessionStatus::State::Idle; });
    };
    session.load(scene, 1, nullptr);
    ASSERT_TRUE(wait_until_idle());
    ASSERT_NE(session.latest(), nullptr);
    EXPECT_TRUE(session.latest()->final);
    const double before = test::mean_irradiance(scene, *session.latest());

    for (int i = 1; i <= 30; ++i) {
        Transform t = scene.nodes.find(lamp)->transform;
        t.translation.x += 0.05;
        const SceneEdit edit{SetTransform{lamp, t}};
        ASSERT_TRUE(apply(scene, edit));
        session.post(edit, std::uint64_t(1 + i), true);
    }
    session.end_gesture();
    ASSERT_TRUE(wait_until_idle());
    const auto shown = session.latest();
    EXPECT_EQ(shown->revision, 31U);
    EXPECT_TRUE(shown->final);
    const test::Solved fresh = test::solve(scene, SolverSettings::Quality::Draft);
    ASSERT_NE(fresh.solution, nullptr);
    EXPECT_EQ(test::mean_irradiance(scene, *shown), test::mean_irradiance(scene, *fresh.solution));
    EXPECT_NE(test::mean_irradiance(scene, *shown), before) << "the lamp did move";
}

TEST(SessionLight, StopsSoonWhenItIsDestroyed) {
    Scene scene;
    scene.settings.quality = SolverSettings::Quality::Fine;
    test::add_room(scene, 4.0F, 2.5F, 3.0F, test::add_material(scene, 0.5F));
    test::add_point_light(scene, {1.0, 2.0, 1.0}, 1000.0);
    std::mutex mutex;
    std::condition_variable woken;
    auto session = std::make_unique<EngineSession>([&] {
        const std::lock_guard lock(mutex);
        woken.notify_all();
    });
    session->load(scene, 1, nullptr);
    {
        std::unique_lock lock(mutex);
        ASSERT_TRUE(woken.wait_for(lock, 60s, [&] { return !session->status().phase.empty(); }));
    }
    EXPECT_EQ(session->status().state, SessionStatus::State::Solving);
    const auto start = std::chrono::steady_clock::now();
    session.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - start, 5s);
}

} // namespace
} // namespace atrium
