#include "engine/base/ids.h"

#include <gtest/gtest.h>

#include <string>
#include <unordered_set>

namespace atrium {
namespace {

using Map = SlotMap<std::string>;
using Key = Map::Key;

TEST(Ids, DefaultIsNoneAndFindsNothing) {
    Map map;
    EXPECT_FALSE(Key{});
    map.insert("a");
    EXPECT_EQ(map.find(Key{}), nullptr);
    EXPECT_FALSE(map.erase(Key{}));
    EXPECT_FALSE(map.restore(Key{}, "x"));
    EXPECT_EQ(map.size(), 1U);
}

TEST(Ids, HandleToSomethingDeletedIsRecognised) {
    Map map;
    const Key a = map.insert("a");
    EXPECT_TRUE(map.erase(a));
    EXPECT_FALSE(map.contains(a));
    const Key b = map.insert("b");
    EXPECT_EQ(b.slot, a.slot);
    EXPECT_NE(b, a);
    EXPECT_EQ(map.find(a), nullptr);
    ASSERT_NE(map.find(b), nullptr);
    EXPECT_EQ(*map.find(b), "b");
    EXPECT_FALSE(map.erase(a));
}

TEST(Ids, NextKeyIsWhatInsertGivesAndTheLowestFreeSlot) {
    Map map;
    const Key a = map.insert("a");
    const Key b = map.insert("b");
    map.insert("c");
    map.erase(b);
    map.erase(a);
    const Key next = map.next_key();
    EXPECT_EQ(next.slot, a.slot);
    EXPECT_EQ(map.insert("d"), next);
    EXPECT_EQ(map.next_key().slot, b.slot);
}

TEST(Ids, RestoreBringsBackTheOldHandleButNotOntoATakenSlot) {
    Map map;
    const Key a = map.insert("a");
    map.erase(a);
    EXPECT_TRUE(map.restore(a, "again"));
    EXPECT_EQ(*map.find(a), "again");
    EXPECT_FALSE(map.restore(Key{a.slot, a.generation + 1}, "other"));
    EXPECT_TRUE(map.occupied(Key{a.slot, a.generation + 1}));
    EXPECT_EQ(*map.find(a), "again");
    EXPECT_EQ(map.size(), 1U);
}

TEST(Ids, GenerationsAreNeverGivenOutTwiceAfterAnUndo) {
    Map map;
    const Key first = map.insert("first");
    map.erase(first);
    const Key second = map.insert("second"); // same slot, next generation
    map.erase(second);
    ASSERT_TRUE(map.restore(first, "first")); // undo of everything
    map.erase(first);
    const Key third = map.insert("third");
    EXPECT_NE(third, second) << "a selection still holding `second` would now point at `third`";
    EXPECT_NE(third, first);
}

TEST(Ids, IterationIsInSlotOrderAndEqualityLooksAtLiveEntriesOnly) {
    Map map;
    const Key a = map.insert("a");
    const Key b = map.insert("b");
    const Key c = map.insert("c");
    map.erase(b);
    EXPECT_EQ(map.keys(), (std::vector<Key>{a, c}));

    Map same;
    ASSERT_TRUE(same.restore(c, "c"));
    ASSERT_TRUE(same.restore(a, "a"));
    EXPECT_EQ(map, same);
    *same.find(c) = "C";
    EXPECT_NE(map, same);
}

TEST(Ids, RestoreFarAheadLeavesTheSlotsBetweenFree) {
    Map map;
    ASSERT_TRUE(map.restore(Key{5, 3}, "five"));
    std::unordered_set<Key> given;
    for (int i = 0; i < 6; ++i) {
        given.insert(map.insert("x"));
    }
    EXPECT_EQ(given.size(), 6U);
    EXPECT_EQ(map.size(), 7U);
    EXPECT_EQ(*map.find(Key{5, 3}), "five");
    EXPECT_EQ(map.slot_count(), 7U);
}

} // namespace
} // namespace atrium
