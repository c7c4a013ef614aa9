// Event traces on a made-up clock: each event is followed by what the scheduler then wants.
#include "engine/session/quality_scheduler.h"

#include <gtest/gtest.h>

#include <string>

namespace atrium {
namespace {

using Outcome = QualityScheduler::Outcome;
using State = QualityScheduler::State;

struct Scheduler : testing::Test {
    QualityScheduler s;
    int now_ms = 0;

    [[nodiscard]] QualityScheduler::Time now() const { return QualityScheduler::Time(std::chrono::milliseconds(now_ms)); }
    /// "start", "stop" or "-": what is to be done at this moment.
    [[nodiscard]] std::string wants() const { return s.should_start(now()) ? "start" : s.should_stop(now()) ? "stop" : "-"; }
    std::string edit(bool in_gesture = false) {
        s.on_edit(now(), true, in_gesture);
        return wants();
    }
    std::string started() {
        s.on_started();
        return wants();
    }
    std::string finished(Outcome outcome) {
        s.on_finished(outcome);
        return wants();
    }
    std::string wait(int ms) {
        now_ms += ms;
        return wants();
    }
    void SetUp() override {
        EXPECT_EQ(wants(), "-");
        s.on_load(false, false);
    }
};

TEST_F(Scheduler, ADocumentIsSolvedOnce) {
    EXPECT_EQ(wants(), "start");
    EXPECT_EQ(s.state(), State::Solving);
    EXPECT_EQ(started(), "-");
    EXPECT_EQ(wait(100000), "-");
    EXPECT_EQ(finished(Outcome::Final), "-");
    EXPECT_EQ(s.state(), State::Idle);
}

// Light that came from a file: the engine gets what it needs to follow edits, and nobody waits for that.
TEST_F(Scheduler, StoredLightIsPreparedUnlessSomethingElseIsWanted) {
    using Kind = QualityScheduler::Kind;
    s.on_prepare();
    EXPECT_FALSE(s.preparing()) << "nothing is there to be prepared";
    s.on_load(true, true);
    EXPECT_EQ(wants(), "-");
    s.on_prepare();
    EXPECT_EQ(wants(), "start");
    EXPECT_EQ(s.kind(), Kind::Full);
    EXPECT_EQ(started(), "-");
    EXPECT_TRUE(s.preparing());
    s.on_finished(Outcome::Final, true);
    EXPECT_EQ(wants(), "-");
    EXPECT_FALSE(s.preparing());
    EXPECT_EQ(s.state(), State::Idle);
    edit(true);
    EXPECT_EQ(s.kind(), Kind::Hurried) << "the first drag is followed";
}

TEST_F(Scheduler, PreparingEndsAtOnceAndLeavesCompleteLight) {
    s.on_load(true, true);
    s.on_prepare();
    started();
    s.on_cancel();
    EXPECT_EQ(wants(), "stop");
    EXPECT_EQ(finished(Outcome::Stopped), "-");
    EXPECT_EQ(s.state(), State::Idle) << "the light is complete all the same";
    // That it fails is no failure of the light either.
    s.on_prepare();
    started();
    EXPECT_EQ(finished(Outcome::Failed), "-");
    EXPECT_EQ(s.state(), State::Idle);
    // An edit has its own solve.
    s.on_prepare();
    started();
    EXPECT_EQ(edit(), "stop");
    EXPECT_EQ(finished(Outcome::Stopped), "start");
    EXPECT_FALSE(s.preparing());
    started();
    EXPECT_FALSE(s.preparing());
    EXPECT_EQ(finished(Outcome::Final), "-");
    s.on_load(true, true);
    s.on_prepare();
    EXPECT_EQ(edit(), "start");
    started();
    EXPECT_FALSE(s.preparing()) << "not begun yet: the edit's solve does it";
}

TEST_F(Scheduler, ADragThatBeginsWhilePreparingIsFollowedOnceItIsDone) {
    s.on_load(true, true);
    s.on_prepare();
    started();
    EXPECT_EQ(edit(true), "-") << "it goes on: there is light to see, and a start for updates";
    s.on_finished(Outcome::Final, true);
    EXPECT_EQ(wants(), "start");
    EXPECT_EQ(s.kind(), QualityScheduler::Kind::Hurried);
}

// The number beside complete light: nobody waits for it, and any edit of light comes before it.
TEST_F(Scheduler, TheErrorIsMeasuredOnceLightIsComplete) {
    using Kind = QualityScheduler::Kind;
    started();
    s.on_finished(Outcome::Final, true, true);
    EXPECT_EQ(wants(), "start");
    EXPECT_EQ(s.kind(), Kind::Audit);
    EXPECT_EQ(s.state(), State::Idle) << "the light is complete";
    s.on_started(Kind::Audit);
    EXPECT_EQ(wants(), "-");
    EXPECT_EQ(s.state(), State::Idle);
    EXPECT_EQ(edit(true), "stop") << "within a gesture too";
    EXPECT_EQ(finished(Outcome::Stopped), "start");
    EXPECT_EQ(s.kind(), Kind::Hurried) << "what updates start from is still there";
    s.on_started(Kind::Hurried);
    s.on_finished(Outcome::Hurried, false, true);
    s.on_gesture_end();
    s.on_started(s.kind());
    s.on_finished(Outcome::Settled, false, true);
    EXPECT_EQ(s.kind(), Kind::Full) << "not before the complete light is there";
    s.on_started(Kind::Full);
    s.on_finished(Outcome::Final, true, true);
    EXPECT_EQ(s.kind(), Kind::Audit);
    s.on_started(Kind::Audit);
    EXPECT_EQ(finished(Outcome::Audited), "-");
    EXPECT_EQ(s.state(), State::Idle);
}

TEST_F(Scheduler, TheErrorNeedNotBeKnown) {
    started();
    s.on_finished(Outcome::Final, true, true);
    s.on_started(QualityScheduler::Kind::Audit);
    s.on_cancel();
    EXPECT_EQ(wants(), "stop");
    EXPECT_EQ(finished(Outcome::Stopped), "-");
    EXPECT_EQ(s.state(), State::Idle) << "nothing is missing";
    s.on_resume();
    EXPECT_EQ(wants(), "-");
}

TEST_F(Scheduler, AStoredSolutionIsEnoughUntilAnEdit) {
    s.on_load(true, true);
    EXPECT_EQ(wants(), "-");
    EXPECT_EQ(s.state(), State::Idle);
    s.on_resume();
    EXPECT_EQ(wants(), "-") << "it is final";
    EXPECT_EQ(edit(), "start");
}

TEST_F(Scheduler, ResumeCompletesAStoredSolutionThatWasNotFinal) {
    s.on_load(true, false);
    EXPECT_EQ(wants(), "-");
    s.on_resume();
    EXPECT_EQ(wants(), "start");
}

TEST_F(Scheduler, OutsideAGestureAStaleSolveStopsAtOnce) {
    started();
    EXPECT_EQ(edit(), "stop");
    EXPECT_EQ(s.state(), State::Solving);
    EXPECT_EQ(finished(Outcome::Stopped), "start");
    EXPECT_EQ(started(), "-");
    EXPECT_EQ(finished(Outcome::Final), "-");
}

TEST_F(Scheduler, AFinalPictureOfAnOldSceneDoesNotEndTheWork) {
    started();
    edit();
    EXPECT_EQ(finished(Outcome::Final), "start");
}

TEST_F(Scheduler, WithinAGestureTheSolveRunsOnUntilRelease) {
    started();
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(edit(true), "-");
        EXPECT_EQ(wait(16), "-");
    }
    s.on_gesture_end();
    EXPECT_EQ(wants(), "stop");
    EXPECT_EQ(finished(Outcome::Stopped), "start");
}

TEST_F(Scheduler, WithinAGestureRestStopsTheStaleSolve) {
    started();
    EXPECT_EQ(edit(true), "-");
    EXPECT_EQ(wait(199), "-");
    EXPECT_EQ(edit(true), "-") << "the hand went on: the wait starts over";
    EXPECT_EQ(wait(199), "-");
    EXPECT_EQ(wait(1), "stop");
    EXPECT_EQ(finished(Outcome::Stopped), "start");
    EXPECT_EQ(started(), "-");
    EXPECT_EQ(wait(5000), "-") << "it is of the present scene now";
}

TEST_F(Scheduler, SaysAheadWhenRestEndsASolve) {
    EXPECT_EQ(s.stop_time(), QualityScheduler::Time::max());
    started();
    EXPECT_EQ(s.stop_time(), QualityScheduler::Time::max());
    wait(1000);
    edit(true);
    EXPECT_EQ(s.stop_time(), now() + QualityScheduler::kRest);
    wait(100);
    edit(true);
    EXPECT_EQ(s.stop_time(), now() + QualityScheduler::kRest) << "put off";
    s.on_gesture_end();
    EXPECT_LE(s.stop_time(), now());
}

TEST_F(Scheduler, TheFirstEditAfterAGestureStopsTheStaleSolve) {
    started();
    EXPECT_EQ(edit(true), "-");
    EXPECT_EQ(edit(false), "stop");
}

TEST_F(Scheduler, AnIdleEngineStartsWithinAGesture) {
    started();
    finished(Outcome::Final);
    EXPECT_EQ(edit(true), "start");
    EXPECT_EQ(started(), "-");
    EXPECT_EQ(edit(true), "-");
    EXPECT_EQ(finished(Outcome::Final), "start") << "on to where the hand is now";
}

TEST_F(Scheduler, EditsThatLeaveLightAloneNeitherStopNorStart) {
    started();
    s.on_edit(now(), false, false);
    EXPECT_EQ(wants(), "-");
    EXPECT_EQ(finished(Outcome::Final), "-");
    s.on_edit(now(), false, false);
    EXPECT_EQ(wants(), "-");
    EXPECT_EQ(s.state(), State::Idle);
}

TEST_F(Scheduler, CancelHoldsUntilAnEditOfLight) {
    started();
    s.on_cancel();
    EXPECT_EQ(wants(), "stop");
    EXPECT_EQ(s.state(), State::Stopped);
    EXPECT_EQ(finished(Outcome::Stopped), "-");
    EXPECT_EQ(s.state(), State::Stopped);
    s.on_edit(now(), false, false);
    EXPECT_EQ(wants(), "-") << "a new name is no reason to go on";
    EXPECT_EQ(edit(), "start");
}

TEST_F(Scheduler, CancelWithinAGestureStopsAtOnce) {
    started();
    edit(true);
    s.on_cancel();
    EXPECT_EQ(wants(), "stop");
}

TEST_F(Scheduler, ResumeStartsAgainAlsoWhileStillStopping) {
    started();
    s.on_cancel();
    s.on_resume();
    EXPECT_EQ(finished(Outcome::Stopped), "start");
    started();
    s.on_cancel();
    finished(Outcome::Stopped);
    s.on_resume();
    EXPECT_EQ(wants(), "start");
    started();
    s.on_resume();
    EXPECT_EQ(wants(), "-") << "it runs already";
}

TEST_F(Scheduler, CancelThatComesTooLateLeavesAFinishedPicture) {
    started();
    s.on_cancel();
    EXPECT_EQ(finished(Outcome::Final), "-");
    EXPECT_EQ(s.state(), State::Idle);
    s.on_cancel();
    EXPECT_EQ(s.state(), State::Idle) << "nothing to cancel";
}

TEST_F(Scheduler, CancelBeforeTheStart) {
    s.on_cancel();
    EXPECT_EQ(wants(), "-");
    EXPECT_EQ(s.state(), State::Stopped);
    s.on_resume();
    EXPECT_EQ(wants(), "start");
}

TEST_F(Scheduler, AFailureWaitsForTheNextEditOrResume) {
    started();
    EXPECT_EQ(finished(Outcome::Failed), "-");
    EXPECT_EQ(s.state(), State::Failed);
    EXPECT_EQ(edit(), "start");
    started();
    finished(Outcome::Failed);
    s.on_resume();
    EXPECT_EQ(wants(), "start");
    started();
    edit(true);
    EXPECT_EQ(finished(Outcome::Failed), "start") << "the scene is another one already";
    s.on_failure();
    EXPECT_EQ(wants(), "-");
    EXPECT_EQ(s.state(), State::Failed);
}

TEST_F(Scheduler, AnotherDocumentAbandonsTheRunningSolve) {
    started();
    s.on_load(true, true);
    EXPECT_TRUE(s.abandoned());
    EXPECT_EQ(wants(), "stop");
    EXPECT_EQ(s.state(), State::Idle);
    EXPECT_EQ(finished(Outcome::Failed), "-");
    EXPECT_EQ(s.state(), State::Idle) << "its failure is not the new document's";
    EXPECT_FALSE(s.abandoned());

    s.on_load(false, false);
    started();
    s.on_load(false, false);
    EXPECT_EQ(finished(Outcome::Final), "start") << "its picture is not the new document's";
}

TEST_F(Scheduler, ASolverThatStopsByItselfIsNotStartedOverAndOver) {
    started();
    EXPECT_EQ(finished(Outcome::Stopped), "-");
    EXPECT_EQ(s.state(), State::Idle);
    s.on_resume();
    EXPECT_EQ(wants(), "start");
}

// ---- with an engine that can update in a hurry

struct HurriedScheduler : Scheduler {
    void SetUp() override {
        Scheduler::SetUp();
        started();
        s.on_finished(Outcome::Final, true);
        EXPECT_EQ(wants(), "-");
    }
    /// The next job starts; says which kind it is.
    std::string next() {
        const auto kind = s.kind();
        s.on_started(kind);
        return kind == QualityScheduler::Kind::Hurried  ? "hurried"
               : kind == QualityScheduler::Kind::Settle ? "settle"
                                                        : "full";
    }
};

TEST_F(HurriedScheduler, LightFollowsAGestureAndSettlesOnRelease) {
    for (int i = 0; i < 50; ++i) {
        EXPECT_EQ(edit(true), "start");
        EXPECT_EQ(next(), "hurried");
        EXPECT_TRUE(s.moving());
        EXPECT_EQ(wait(30), "-");
        EXPECT_EQ(finished(Outcome::Hurried), "-") << "the hand goes on";
        EXPECT_TRUE(s.unsettled());
    }
    EXPECT_EQ(s.state(), State::Solving);
    s.on_gesture_end();
    EXPECT_FALSE(s.moving());
    EXPECT_EQ(wants(), "start");
    EXPECT_EQ(next(), "settle");
    EXPECT_TRUE(s.unsettled()) << "until it is done";
    EXPECT_EQ(finished(Outcome::Settled), "start");
    EXPECT_FALSE(s.unsettled());
    EXPECT_TRUE(s.refining());
    EXPECT_EQ(s.state(), State::Solving);
    EXPECT_EQ(next(), "full");
    EXPECT_FALSE(s.unsettled()) << "what is shown is exact";
    s.on_finished(Outcome::Final, true);
    EXPECT_FALSE(s.refining());
    EXPECT_EQ(wants(), "-");
    EXPECT_FALSE(s.unsettled());
    EXPECT_EQ(s.state(), State::Idle);
}

TEST_F(HurriedScheduler, EditsWhileAnUpdateRunsDoNotStopIt) {
    edit(true);
    next();
    EXPECT_EQ(edit(true), "-");
    EXPECT_EQ(edit(true), "-");
    EXPECT_EQ(finished(Outcome::Hurried), "start");
    EXPECT_EQ(next(), "hurried");
}

TEST_F(HurriedScheduler, AHandThatRestsGetsFullQualityAndMayGoOn) {
    edit(true);
    next();
    finished(Outcome::Hurried);
    EXPECT_EQ(s.start_time(), now() + QualityScheduler::kRest);
    EXPECT_EQ(wait(199), "-");
    EXPECT_EQ(wait(1), "start");
    EXPECT_EQ(next(), "settle");
    EXPECT_EQ(edit(true), "stop") << "at once: the hand is not to wait";
    EXPECT_EQ(finished(Outcome::Stopped), "start");
    EXPECT_EQ(next(), "hurried");
    finished(Outcome::Hurried);
    EXPECT_EQ(wait(200), "start");
    EXPECT_EQ(next(), "settle");
    EXPECT_EQ(finished(Outcome::Settled), "start") << "the hand rests";
    EXPECT_EQ(next(), "full");
    EXPECT_EQ(wait(1000), "-");
    EXPECT_EQ(edit(true), "stop") << "at once: the hand is not to wait";
    EXPECT_EQ(finished(Outcome::Stopped), "start");
    EXPECT_EQ(next(), "hurried");
    finished(Outcome::Hurried);
    s.on_gesture_end();
    EXPECT_EQ(wants(), "start");
    EXPECT_EQ(next(), "settle");
}

TEST_F(HurriedScheduler, ASingleEditIsAnsweredAtOnceAndSettled) {
    EXPECT_EQ(edit(false), "start");
    EXPECT_EQ(next(), "hurried");
    EXPECT_FALSE(s.moving()) << "no hand is at it";
    EXPECT_EQ(finished(Outcome::Hurried), "start");
    EXPECT_EQ(next(), "settle");
    EXPECT_EQ(edit(false), "stop") << "of an older scene";
    EXPECT_EQ(finished(Outcome::Stopped), "start");
    EXPECT_EQ(next(), "hurried");
    EXPECT_EQ(finished(Outcome::Hurried), "start");
    EXPECT_EQ(next(), "settle");
    EXPECT_EQ(finished(Outcome::Settled), "start");
    EXPECT_EQ(next(), "full");
    EXPECT_EQ(edit(false), "stop");
    EXPECT_EQ(finished(Outcome::Stopped), "start");
    EXPECT_EQ(next(), "hurried") << "the last complete light is still there to start from";
    EXPECT_EQ(finished(Outcome::Unfit), "start");
    EXPECT_EQ(next(), "full") << "it was no such edit";
    s.on_finished(Outcome::Final, true);
    EXPECT_EQ(wants(), "-");
}

// The last place of a hand is shown quickly even when it lets go in the middle of an update.
TEST_F(HurriedScheduler, LettingGoDuringAnUpdateFollowsOnceMore) {
    edit(true);
    next();
    EXPECT_EQ(edit(true), "-");
    s.on_gesture_end();
    EXPECT_EQ(finished(Outcome::Hurried), "start");
    EXPECT_EQ(next(), "hurried");
    EXPECT_EQ(finished(Outcome::Hurried), "start");
    EXPECT_EQ(next(), "settle");
}

TEST_F(HurriedScheduler, CancelWhileRefiningKeepsTheExactLight) {
    edit(false);
    next();
    finished(Outcome::Hurried);
    next();
    finished(Outcome::Settled);
    EXPECT_EQ(next(), "full");
    s.on_cancel();
    EXPECT_EQ(wants(), "stop");
    EXPECT_EQ(finished(Outcome::Stopped), "-");
    EXPECT_EQ(s.state(), State::Stopped);
    s.on_resume();
    EXPECT_EQ(next(), "full");
}

TEST_F(HurriedScheduler, WhatCannotBeDoneInAHurryIsSolvedAsBefore) {
    edit(true);
    EXPECT_EQ(next(), "hurried");
    EXPECT_EQ(finished(Outcome::Unfit), "start");
    EXPECT_EQ(next(), "full");
    EXPECT_EQ(edit(true), "-") << "there has to be some light while dragging";
    EXPECT_EQ(wait(200), "stop");
    EXPECT_EQ(finished(Outcome::Stopped), "start");
    EXPECT_EQ(next(), "full");
}

TEST_F(HurriedScheduler, CancelAndAnotherDocumentForgetIt) {
    edit(true);
    next();
    s.on_cancel();
    EXPECT_EQ(wants(), "stop");
    EXPECT_EQ(finished(Outcome::Stopped), "-");
    s.on_gesture_end();
    EXPECT_EQ(wants(), "-") << "cancelled";
    s.on_resume();
    EXPECT_EQ(wants(), "start");
    EXPECT_EQ(next(), "hurried");
    s.on_load(false, false);
    finished(Outcome::Stopped);
    EXPECT_EQ(wants(), "start");
    edit(true);
    EXPECT_EQ(next(), "full") << "nothing to start from yet";
}

} // namespace
} // namespace atrium
