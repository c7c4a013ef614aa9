#include "engine/base/run_context.h"

#include <gtest/gtest.h>

namespace atrium {
namespace {

using namespace std::chrono_literals;

TEST(StopFlag, CopiesShareTheRequest) {
    const StopFlag a;
    const StopFlag b = a;
    EXPECT_FALSE(b.stop_requested());
    a.request_stop();
    EXPECT_TRUE(b.stop_requested());
    EXPECT_FALSE(StopFlag().stop_requested());
}

TEST(StopFlag, StopsAtATimeThatMayBePutOffOrTakenBack) {
    const StopFlag flag;
    const auto now = StopFlag::Clock::now();
    flag.request_stop_at(now + 1h);
    EXPECT_FALSE(flag.stop_requested());
    flag.request_stop_at(now); // nobody has asked since
    flag.request_stop_at(StopFlag::Clock::time_point::max());
    EXPECT_FALSE(flag.stop_requested());
    flag.request_stop_at(StopFlag::Clock::time_point::min());
    EXPECT_TRUE(flag.stop_requested());
    const StopFlag plain;
    plain.request_stop();
    plain.request_stop_at(StopFlag::Clock::time_point::max());
    EXPECT_TRUE(plain.stop_requested()) << "a plain request is final";
}

// A loop that was told to stop left something out; if the request could be taken back after that, its caller would take the
// rest for the whole.
TEST(StopFlag, AnAnswerIsFinal) {
    const StopFlag flag;
    flag.request_stop_at(StopFlag::Clock::now());
    ASSERT_TRUE(flag.stop_requested());
    flag.request_stop_at(StopFlag::Clock::time_point::max());
    EXPECT_TRUE(flag.stop_requested());
    flag.request_stop_at(StopFlag::Clock::now() + 1h);
    EXPECT_TRUE(flag.stop_requested());
}

TEST(StopFlag, AWatchIsAskedEachTime) {
    int asked = 0;
    const std::function<bool()> watch = [&] { return ++asked == 3; };
    const StopFlag flag;
    flag.watch(&watch);
    EXPECT_FALSE(flag.stop_requested());
    EXPECT_FALSE(flag.stop_requested());
    EXPECT_TRUE(flag.stop_requested());
    EXPECT_TRUE(flag.stop_requested());
    EXPECT_EQ(asked, 4);
}

TEST(RunContext, DeadlineAndFlagBothStop) {
    RunContext context;
    EXPECT_FALSE(context.should_stop());
    context.deadline = RunContext::Clock::now();
    EXPECT_TRUE(context.should_stop());
    EXPECT_TRUE(context.past_deadline());
    context.deadline = RunContext::Clock::time_point::max();
    context.stop.request_stop();
    EXPECT_TRUE(context.should_stop());
    EXPECT_FALSE(context.past_deadline());
}

} // namespace
} // namespace atrium
