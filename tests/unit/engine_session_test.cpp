// The session with a solver of the test's own: which scenes it is asked for, when it is stopped, what is shown.
#include "engine/session/engine_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <stdexcept>

namespace atrium {
namespace {

using namespace std::chrono_literals;
using State = SessionStatus::State;
constexpr auto kPatience = 20s; // only a failing test waits that long

std::shared_ptr<const Solution> picture(std::uint64_t revision, bool final) {
    auto s = std::make_shared<Solution>();
    s->revision = revision;
    s->final = final;
    return s;
}

/// Stands in for the engine: every solve waits for the test to say how it ends.
class FakeSolver {
public:
    enum class Order { Finish, Snapshot, Throw, Fail, Null };
    struct Call {
        double x = 0; ///< where node 0 is
        std::uint64_t revision = 0;
        SolverSettings::Quality quality = SolverSettings::Quality::Normal;
        bool keep_landings = false;
        bool skip_first_picture = false;
    };

    Result<std::shared_ptr<const Solution>> solve(const Scene& scene, const SolveOptions& options, const RunContext& context,
                                                  const std::function<void(std::shared_ptr<const Solution>)>& on_snapshot) {
        std::unique_lock lock(mutex_);
        const auto keys = scene.nodes.keys();
        calls_.push_back({keys.empty() ? 0.0 : scene.nodes.find(keys[0])->transform.translation.x, options.revision,
                          options.quality, options.keep_landings, options.skip_first_picture});
        changed_.notify_all();
        std::shared_ptr<const Solution> shown;
        for (int tick = 0;; ++tick) {
            // The real solver looks at the flag every few milliseconds; so does this one.
            while (orders_.empty() && !context.should_stop()) {
                changed_.wait_for(lock, 1ms);
                lock.unlock();
                if (!silent) {
                    context.progress("gather", 0.5);
                }
                lock.lock();
            }
            if (context.should_stop()) {
                ++stopped_;
                changed_.notify_all();
                if (shown == nullptr) {
                    return fail("", "", "stopped before the first picture");
                }
                return shown;
            }
            const Order order = orders_.front();
            orders_.pop_front();
            switch (order) {
            case Order::Finish: {
                auto done = std::make_shared<Solution>(*picture(options.revision, true));
                done->statistics.particles_stored = particles;
                if (options.keep_landings) {
                    done->landings = std::make_shared<std::vector<SurfaceLandings>>();
                }
                return done;
            }
            case Order::Throw: throw std::runtime_error("out of luck");
            case Order::Fail: return fail("", "", "no light at all");
            case Order::Null: return std::shared_ptr<const Solution>();
            case Order::Snapshot:
                shown = picture(options.revision, false);
                lock.unlock();
                on_snapshot(shown);
                lock.lock();
                break;
            }
        }
    }

    std::atomic<bool> silent = false;         ///< reports no progress
    std::atomic<std::uint64_t> particles = 0; ///< in the solutions

    void order(Order order) {
        {
            const std::lock_guard lock(mutex_);
            orders_.push_back(order);
        }
        changed_.notify_all();
    }
    /// The n-th call (from 1); waits for it.
    Call call(std::size_t n) {
        std::unique_lock lock(mutex_);
        EXPECT_TRUE(changed_.wait_for(lock, kPatience, [&] { return calls_.size() >= n; })) << "no solve number " << n;
        return calls_.size() >= n ? calls_[n - 1] : Call{};
    }
    std::size_t calls() {
        const std::lock_guard lock(mutex_);
        return calls_.size();
    }
    int stopped() {
        const std::lock_guard lock(mutex_);
        return stopped_;
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Call> calls_;
    std::deque<Order> orders_;
    int stopped_ = 0;
};
using Order = FakeSolver::Order;

struct Session : testing::Test {
    FakeSolver solver;
    std::mutex mutex;
    std::condition_variable woken;
    int wakes = 0;
    std::unique_ptr<EngineSession> session;
    Scene scene;
    NodeId node;

    void SetUp() override {
        node = scene.nodes.next_key();
        Node n;
        n.name = "ball";
        n.shape = scene.shapes.insert({"ball", Sphere{}, {}});
        ASSERT_TRUE(apply(scene, {AddNode{node, n}}));
        session = std::make_unique<EngineSession>(
            [this] {
                const std::lock_guard lock(mutex);
                ++wakes;
                woken.notify_all();
            },
            [this](const Scene& s, const SolveOptions& o, const RunContext& c, const auto& snapshot) {
                return solver.solve(s, o, c, snapshot);
            });
    }
    void TearDown() override { session.reset(); }

    SessionStatus wait_for(const std::function<bool(const SessionStatus&)>& condition, const char* what) {
        std::unique_lock lock(mutex);
        // status() is asked outside the session's own locks; a wake-up follows every change of it.
        const bool done = woken.wait_for(lock, kPatience, [&] { return condition(session->status()); });
        EXPECT_TRUE(done) << "never: " << what;
        return session->status();
    }
    SessionStatus wait_for(State state) {
        return wait_for([&](const SessionStatus& s) { return s.state == state; }, "the state");
    }
    [[nodiscard]] SceneEdit move(double x) const {
        Transform t;
        t.translation.x = x;
        return {SetTransform{node, t}};
    }
    [[nodiscard]] SceneEdit rename(const char* name) const {
        Node n = *scene.nodes.find(node);
        n.name = name;
        return {SetNode{node, n}};
    }
    void solve_first() {
        session->load(scene, 1, nullptr);
        solver.order(Order::Finish);
        wait_for(State::Idle);
    }
};

TEST_F(Session, SolvesALoadedDocumentAndShowsIt) {
    EXPECT_EQ(session->latest(), nullptr);
    EXPECT_EQ(session->status().state, State::Idle);
    scene.settings.quality = SolverSettings::Quality::Draft;
    session->load(scene, 7, nullptr);
    EXPECT_EQ(session->status().state, State::Solving);
    EXPECT_EQ(solver.call(1).revision, 7U);
    EXPECT_EQ(solver.call(1).quality, SolverSettings::Quality::Draft);
    const SessionStatus running = wait_for([](const SessionStatus& s) { return s.phase == "gather"; }, "progress");
    EXPECT_DOUBLE_EQ(running.fraction, 0.5);
    EXPECT_EQ(running.shown_revision, 0U);
    solver.order(Order::Snapshot);
    wait_for([](const SessionStatus& s) { return s.shown_revision == 7; }, "the first picture");
    ASSERT_NE(session->latest(), nullptr);
    EXPECT_FALSE(session->latest()->final);
    solver.order(Order::Finish);
    const SessionStatus done = wait_for(State::Idle);
    EXPECT_TRUE(session->latest()->final);
    EXPECT_EQ(done.posted_revision, 7U);
    EXPECT_EQ(done.shown_revision, 7U);
    EXPECT_EQ(done.phase, "");
}

TEST_F(Session, LandingsAreAskedForOnceAndOnlyWhereThereAreAny) {
    solve_first();
    session->keep_landings(true);
    EXPECT_EQ(session->status().state, State::Idle) << "no particle landed";
    EXPECT_EQ(solver.calls(), 1U);
    session->keep_landings(false);
    solver.particles = 7;
    session->post(move(1), 2, false);
    solver.order(Order::Finish);
    EXPECT_FALSE(solver.call(2).keep_landings);
    wait_for([](const SessionStatus& s) { return s.state == State::Idle && s.shown_revision == 2; }, "the second light");
    EXPECT_FALSE(session->latest()->landings);
    session->keep_landings(true);
    EXPECT_TRUE(solver.call(3).keep_landings);
    EXPECT_TRUE(solver.call(3).skip_first_picture) << "what is on show is better";
    solver.order(Order::Finish);
    wait_for(State::Idle);
    EXPECT_TRUE(session->latest()->landings);
    session->keep_landings(true);
    EXPECT_EQ(session->status().state, State::Idle) << "they are there";
    EXPECT_EQ(solver.calls(), 3U);
}

TEST_F(Session, EstimatesTheRemainingTime) {
    session->load(scene, 1, nullptr);
    const SessionStatus s = wait_for([](const SessionStatus& now) { return now.remaining_seconds >= 0.0; }, "an estimate");
    EXPECT_NEAR(s.remaining_seconds, s.elapsed_seconds, 1e-9) << "half done: as long again";
    solver.order(Order::Finish);
    wait_for(State::Idle);
}

TEST_F(Session, ADragEndsOnTheRightScene) {
    solve_first();
    for (int i = 1; i <= 500; ++i) {
        session->post(move(i), std::uint64_t(1 + i), true);
        if (i % 100 == 0) {
            solver.order(Order::Finish);
        }
    }
    session->end_gesture();
    EXPECT_EQ(session->status().posted_revision, 501U);
    // However the solves fell between the edits, the last one is of the last scene.
    for (std::size_t n = 2;; ++n) {
        const FakeSolver::Call call = solver.call(n);
        EXPECT_EQ(call.x, double(call.revision) - 1.0) << "the scene is not that of its revision";
        solver.order(Order::Finish);
        if (call.revision == 501) {
            break;
        }
        ASSERT_LT(n, 520U);
    }
    const SessionStatus s = wait_for([](const SessionStatus& now) { return now.state == State::Idle; }, "rest");
    EXPECT_EQ(s.shown_revision, 501U);
    EXPECT_EQ(session->latest()->revision, 501U);
}

TEST_F(Session, WithinAGestureASolveRunsOnAndReleaseStopsIt) {
    session->load(scene, 1, nullptr);
    solver.call(1);
    session->post(move(5), 2, true);
    solver.order(Order::Snapshot); // still served: it was not stopped
    wait_for([](const SessionStatus& s) { return s.shown_revision == 1; }, "a picture while dragging");
    EXPECT_EQ(session->status().posted_revision, 2U);
    session->end_gesture();
    EXPECT_EQ(solver.call(2).x, 5.0);
    EXPECT_EQ(solver.stopped(), 1);
    solver.order(Order::Finish);
    EXPECT_EQ(wait_for(State::Idle).shown_revision, 2U);
}

TEST_F(Session, WithinAGestureRestStopsIt) {
    solver.silent = true; // also a solver in the middle of a long phase
    session->load(scene, 1, nullptr);
    solver.call(1);
    session->post(move(5), 2, true);
    EXPECT_EQ(solver.call(2).revision, 2U); // after 200 ms, without another word
    solver.order(Order::Finish);
    wait_for(State::Idle);
}

TEST_F(Session, AnEditOutsideAGestureStopsAStaleSolve) {
    session->load(scene, 1, nullptr);
    solver.call(1);
    session->post(move(2), 2, false);
    EXPECT_EQ(solver.call(2).x, 2.0);
    session->post(move(3), 3, false);
    EXPECT_EQ(solver.call(3).x, 3.0);
    EXPECT_EQ(solver.stopped(), 2);
    solver.order(Order::Finish);
    EXPECT_EQ(wait_for(State::Idle).shown_revision, 3U);
}

TEST_F(Session, EditsThatLeaveLightAloneKeepThePictureTrue) {
    solve_first();
    session->post(rename("globe"), 2, false);
    EXPECT_EQ(session->status().state, State::Idle);
    EXPECT_EQ(session->status().shown_revision, 2U);
    EXPECT_EQ(session->status().light_revision, 1U);
    EXPECT_EQ(session->shown().revision, 1U);
    session->post(move(1), 3, false);
    EXPECT_EQ(session->status().shown_revision, 1U);
    EXPECT_EQ(session->status().light_revision, 3U);
    EXPECT_EQ(session->shown().revision, 1U) << "of the scene before";
    solver.call(2);
    session->post(rename("sphere"), 4, false); // does not stop it
    solver.order(Order::Finish);
    EXPECT_EQ(wait_for(State::Idle).shown_revision, 4U);
    EXPECT_EQ(session->latest()->revision, 3U);
    EXPECT_EQ(session->shown().revision, 3U);
    EXPECT_EQ(session->status().light_revision, 3U);
    EXPECT_EQ(solver.calls(), 2U);
    EXPECT_EQ(solver.stopped(), 0);
}

TEST_F(Session, CancelKeepsTheLastPictureAndResumeGoesOn) {
    session->load(scene, 1, nullptr);
    solver.call(1);
    solver.order(Order::Snapshot);
    wait_for([](const SessionStatus& s) { return s.shown_revision == 1; }, "a picture");
    const auto shown = session->latest();
    session->cancel();
    EXPECT_EQ(session->status().state, State::Stopped);
    session->resume();
    solver.call(2);
    EXPECT_EQ(session->latest(), shown);
    session->cancel();
    session->post(move(4), 2, false);
    EXPECT_EQ(solver.call(3).x, 4.0);
    solver.order(Order::Finish);
    wait_for(State::Idle);
    session->resume(); // nothing left to do
    EXPECT_EQ(session->status().state, State::Idle);
    EXPECT_EQ(solver.calls(), 3U);
}

TEST_F(Session, AStoredSolutionIsShownAtOnceAndNotSolvedAgain) {
    const auto stored = picture(99, true);
    session->load(scene, 5, stored);
    EXPECT_EQ(session->latest(), stored);
    EXPECT_EQ(session->status().state, State::Idle);
    EXPECT_EQ(session->status().shown_revision, 5U);
    session->post(move(1), 6, false);
    EXPECT_EQ(session->status().shown_revision, 5U);
    EXPECT_EQ(solver.call(1).x, 1.0) << "the first solve is the edit's";
    solver.order(Order::Finish);
    EXPECT_EQ(wait_for(State::Idle).shown_revision, 6U);
}

TEST_F(Session, AnotherDocumentTakesOverFromARunningSolve) {
    session->load(scene, 1, nullptr);
    solver.call(1);
    Scene other = scene;
    ASSERT_TRUE(apply(other, move(42)));
    session->load(other, 1, nullptr);
    EXPECT_EQ(solver.call(2).x, 42.0);
    EXPECT_EQ(session->latest(), nullptr);
    solver.order(Order::Finish);
    wait_for(State::Idle);
}

TEST_F(Session, FailuresAreToldAndTheNextEditTriesAgain) {
    session->load(scene, 1, nullptr);
    solver.order(Order::Throw);
    EXPECT_THAT(wait_for(State::Failed).message, testing::HasSubstr("out of luck"));
    session->resume();
    solver.order(Order::Fail);
    solver.call(2);
    EXPECT_EQ(wait_for(State::Failed).message, "no light at all");
    session->post(move(1), 2, false);
    solver.order(Order::Null);
    solver.call(3);
    EXPECT_THAT(wait_for(State::Failed).message, testing::HasSubstr("no picture"));
    session->post(move(2), 3, false);
    solver.order(Order::Finish);
    const SessionStatus s = wait_for(State::Idle);
    EXPECT_EQ(s.message, "");
    EXPECT_EQ(s.shown_revision, 3U);
}

TEST_F(Session, AnEditThatDoesNotFitIsReported) {
    solve_first();
    session->post({SetTransform{NodeId{9, 9}, {}}}, 2, false);
    EXPECT_THAT(wait_for(State::Failed).message, testing::HasSubstr("no such node"));
    EXPECT_EQ(solver.calls(), 1U);
}

TEST_F(Session, MayBeDestroyedWhileSolving) {
    session->load(scene, 1, nullptr);
    solver.call(1);
    session->post(move(1), 2, true);
    session.reset();
    EXPECT_EQ(solver.stopped(), 1);
    EXPECT_GT(wakes, 0);
}

// The picture is there before the number; the number comes to the same picture, and an edit does not wait for it.
TEST_F(Session, TheErrorFollowsThePicture) {
    std::atomic<int> audits = 0;
    std::atomic<bool> let_finish = false;
    session = std::make_unique<EngineSession>(
        [this] {
            const std::lock_guard lock(mutex);
            ++wakes;
            woken.notify_all();
        },
        [this](const Scene& s, const SolveOptions& o, const RunContext& c, const auto& snapshot) {
            return solver.solve(s, o, c, snapshot);
        },
        [&](const Scene&, std::shared_ptr<const Solution> light, const SolveOptions&, const RunContext& context) -> Audited {
            ++audits;
            while (!let_finish && !context.should_stop()) {
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
            if (context.should_stop()) {
                return light;
            }
            auto out = std::make_shared<Solution>(*light);
            out->statistics.audit.points = 7;
            return Audited(out, {AuditPlace{}, AuditPlace{}});
        });
    session->load(scene, 1, nullptr);
    solver.order(Order::Finish);
    wait_for([&](const SessionStatus&) { return audits == 1; }, "an audit");
    EXPECT_EQ(wait_for(State::Idle).shown_revision, 1U) << "complete while its error is measured";
    EXPECT_EQ(session->latest()->statistics.audit.points, 0U);
    EXPECT_FALSE(session->shown().error);
    session->post(move(1), 2, false);
    solver.order(Order::Finish);
    let_finish = true; // of the second; the first was stopped
    wait_for([&](const SessionStatus&) { return session->latest()->statistics.audit.points == 7; }, "the number");
    EXPECT_EQ(audits, 2);
    ASSERT_TRUE(session->shown().error);
    EXPECT_EQ(session->shown().error->size(), 2U);
    EXPECT_EQ(session->shown().solution, session->latest());
    EXPECT_EQ(session->latest()->revision, 2U);
    EXPECT_EQ(solver.calls(), 2U);
    session.reset(); // before what its audit refers to
}

// A saved project: its light is there at once, and what follows edits of it is made unseen.
TEST_F(Session, StoredLightIsPreparedWithoutAFirstPicture) {
    const auto stored = picture(1, true);
    session->load(scene, 1, stored);
    session->prepare();
    const FakeSolver::Call call = solver.call(1);
    EXPECT_EQ(call.revision, 1U);
    EXPECT_TRUE(call.skip_first_picture);
    const SessionStatus now = wait_for([](const SessionStatus& s) { return s.preparing; }, "preparing");
    EXPECT_EQ(now.shown_revision, now.posted_revision);
    EXPECT_EQ(session->latest(), stored);
    solver.order(Order::Finish);
    wait_for(State::Idle);
    EXPECT_FALSE(session->status().preparing);
    EXPECT_TRUE(session->latest()->final);
    EXPECT_EQ(solver.calls(), 1U);
}

TEST_F(Session, MayBeDestroyedUnused) { session.reset(); }

} // namespace
} // namespace atrium
