// Scripts through the job queue with a solver of the test's own: what is posted, merged, timed and stopped.
#include "engine/session/script_player.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace atrium {
namespace {

using namespace std::chrono_literals;

/// Takes a while for every solve, and says in its figures which one it was.
struct SlowSolver {
    std::chrono::milliseconds pace{0};
    bool fails = false;
    std::atomic<int> calls = 0;
    std::atomic<double> last_x = 0;

    Result<std::shared_ptr<const Solution>> operator()(const Scene& scene, const SolveOptions& options,
                                                       const RunContext& context,
                                                       const std::function<void(std::shared_ptr<const Solution>)>& show) {
        const int number = ++calls;
        last_x = scene.nodes.find(scene.roots.front())->transform.translation.x;
        if (fails) {
            return fail("", "", "no light at all");
        }
        Solution picture;
        picture.revision = options.revision;
        picture.statistics.update.links_changed = std::uint64_t(number);
        picture.statistics.update.degraded = true;
        const auto end = std::chrono::steady_clock::now() + pace;
        while (std::chrono::steady_clock::now() < end) {
            if (context.should_stop()) {
                return fail("", "", "stopped before the first picture");
            }
            context.progress("gather", 0.5);
            std::this_thread::sleep_for(1ms);
        }
        show(std::make_shared<Solution>(picture));
        picture.final = true;
        picture.statistics.update.degraded = false;
        return std::make_shared<const Solution>(picture);
    }
};

struct ScriptPlayerTest : testing::Test {
    SlowSolver solver;
    RunContext context;
    Scene scene;

    void SetUp() override {
        add("Ball", scene.shapes.insert({"ball", Sphere{}, {}}), {});
        add("Eye", {}, scene.cameras.insert({}));
    }
    void add(const std::string& name, ShapeId shape, CameraId camera) {
        Node node;
        node.name = name;
        node.shape = shape;
        node.camera = camera;
        ASSERT_TRUE(apply(scene, {AddNode{scene.nodes.next_key(), node}}));
    }
    std::unique_ptr<ScriptPlayer> player() {
        return std::make_unique<ScriptPlayer>(
            scene, nullptr,
            [this](const Scene& s, const SolveOptions& o, const RunContext& c, const auto& show) {
                return solver(s, o, c, show);
            },
            context);
    }
    static ScriptEdit move(const char* node, double x) { return {ScriptMove{node, dvec3(x, 0, 0), {}, {}}}; }
    static ScriptEdit drag(int count, double interval_ms, bool settle = true) {
        ScriptDrag out{"Ball", {}, interval_ms, settle};
        for (int i = 1; i <= count; ++i) {
            out.positions.emplace_back(double(i), 0, 0);
        }
        return {out};
    }
};

TEST_F(ScriptPlayerTest, AnEditWaitsForTheCompleteLight) {
    const auto p = player();
    const auto first = p->settle();
    ASSERT_TRUE(first);
    EXPECT_TRUE(*first);
    solver.pace = 20ms;
    const auto report = p->play(move("Ball", 3));
    ASSERT_TRUE(report);
    EXPECT_EQ(report->kind, "move");
    EXPECT_EQ(report->target, "Ball");
    ASSERT_EQ(report->frames.size(), 1U);
    ASSERT_TRUE(report->frames[0].latency);
    EXPECT_GE(*report->frames[0].latency, 0.019);
    EXPECT_EQ(report->frames[0].update.links_changed, 2U);
    EXPECT_TRUE(report->frames[0].update.degraded) << "the first picture that includes it";
    ASSERT_TRUE(report->settle);
    EXPECT_GE(*report->settle, *report->frames[0].latency);
    EXPECT_FALSE(report->update.degraded) << "the last picture";
    EXPECT_FALSE(report->stopped);
    EXPECT_TRUE(p->light_is_current());
    EXPECT_EQ(solver.last_x, 3.0);
}

TEST_F(ScriptPlayerTest, PositionsThatWereMergedShareAPicture) {
    const auto p = player();
    ASSERT_TRUE(p->settle());
    solver.pace = 30ms;
    const auto report = p->play(drag(60, 2));
    ASSERT_TRUE(report);
    ASSERT_EQ(report->frames.size(), 60U);
    EXPECT_LT(solver.calls, 30) << "120 ms of dragging at 30 ms a solve";
    EXPECT_GE(solver.calls, 3) << "light follows while the hand moves";
    std::uint64_t before = 2;
    for (const FrameReport& frame : report->frames) {
        ASSERT_TRUE(frame.latency);
        EXPECT_GE(frame.update.links_changed, before) << "pictures come in order";
        before = frame.update.links_changed;
    }
    EXPECT_TRUE(report->settle);
    EXPECT_EQ(report->update.links_changed, std::uint64_t(solver.calls));
    EXPECT_EQ(solver.last_x, 60.0) << "where the hand let go";
    // All of it is one step back.
    const auto undone = p->play({ScriptUndo{}});
    ASSERT_TRUE(undone);
    EXPECT_EQ(undone->target, "Ball");
    EXPECT_EQ(solver.last_x, 0.0);
    EXPECT_EQ(p->scene(), scene);
}

TEST_F(ScriptPlayerTest, ADragNeedNotBeWaitedFor) {
    const auto p = player();
    ASSERT_TRUE(p->settle());
    const auto report = p->play(drag(3, 1, false));
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->settle);
    EXPECT_FALSE(report->stopped);
    for (const FrameReport& frame : report->frames) {
        EXPECT_TRUE(frame.latency);
    }
    const auto rest = p->settle();
    ASSERT_TRUE(rest);
    EXPECT_TRUE(*rest);
    EXPECT_EQ(solver.last_x, 3.0);
}

TEST_F(ScriptPlayerTest, WhatLeavesLightAloneIsShownAtOnce) {
    const auto p = player();
    ASSERT_TRUE(p->settle());
    solver.pace = 10s;
    for (const ScriptEdit& edit : {move("Eye", 1), move("Ball", 0)}) { // a camera; a place where it is already
        const auto report = p->play(edit);
        ASSERT_TRUE(report);
        ASSERT_EQ(report->frames.size(), 1U);
        EXPECT_TRUE(report->frames[0].latency);
        EXPECT_EQ(report->frames[0].update, UpdateStatistics());
        EXPECT_TRUE(report->settle);
        EXPECT_EQ(report->update, UpdateStatistics());
    }
    EXPECT_EQ(solver.calls, 1);
}

TEST_F(ScriptPlayerTest, StopsInTheMiddleOfADrag) {
    const auto p = player();
    ASSERT_TRUE(p->settle());
    solver.pace = 10s;
    std::thread signal([&] {
        while (solver.calls < 2) {
            std::this_thread::sleep_for(1ms);
        }
        context.stop.request_stop();
    });
    const auto report = p->play(drag(1000, 16));
    signal.join();
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->stopped);
    EXPECT_FALSE(report->settle);
    EXPECT_LT(report->frames.size(), 1000U);
    ASSERT_FALSE(report->frames.empty());
    EXPECT_FALSE(report->frames.back().latency);
    EXPECT_FALSE(p->light_is_current());
    EXPECT_NE(p->light(), nullptr) << "that of before";
}

TEST_F(ScriptPlayerTest, TheTimeLimitEndsASolve) {
    solver.pace = 10s;
    context.deadline = RunContext::Clock::now() + 30ms;
    const auto p = player();
    const auto done = p->settle();
    ASSERT_TRUE(done);
    EXPECT_FALSE(*done);
    EXPECT_EQ(p->light(), nullptr);
}

TEST_F(ScriptPlayerTest, TellsProgressAndFailures) {
    std::atomic<int> told = 0;
    context.on_progress = [&](const Progress& progress) { told += progress.phase == "gather" ? 1 : 0; };
    solver.pace = 5ms;
    const auto p = player();
    ASSERT_TRUE(p->settle());
    EXPECT_GT(told, 0);
    solver.fails = true;
    const auto report = p->play(move("Ball", 1));
    ASSERT_FALSE(report);
    EXPECT_THAT(report.error().message(), testing::HasSubstr("no light at all"));
    const auto wrong = p->play(move("Bell", 1));
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().message(), testing::HasSubstr("no node named 'Bell'"));
}

TEST_F(ScriptPlayerTest, StoredLightIsNotSolvedAgain) {
    auto stored = std::make_shared<Solution>();
    stored->final = true;
    ScriptPlayer p(
        scene, stored,
        [this](const Scene& s, const SolveOptions& o, const RunContext& c, const auto& show) {
            return solver(s, o, c, show);
        },
        context);
    const auto done = p.settle();
    ASSERT_TRUE(done);
    EXPECT_TRUE(*done);
    EXPECT_EQ(solver.calls, 0);
    EXPECT_EQ(p.light(), stored);
}

} // namespace
} // namespace atrium
