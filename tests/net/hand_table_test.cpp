#include "net/hand_table.h"

#include <array>
#include <memory>

#include <gtest/gtest.h>

#include "net/server_state.h"
#include "net/token_bucket.h"

// What clients share: hands, the right to be heard, the queue of what they ask for.

namespace myotact::net {
namespace {

/// A right hand, then a left one.
class HandTableTest : public ::testing::Test {
 protected:
  HandTable::Taken take(HandWish wish, std::uint64_t id) {
    return table_.take(wish, id, [this, id] { told_to_leave_.push_back(id); });
  }

  std::array<std::unique_ptr<HandChannels>, 2> channels_{std::make_unique<HandChannels>(),
                                                         std::make_unique<HandChannels>()};
  HandTable table_{{{channels_[0].get(), false}, {channels_[1].get(), true}}};
  std::vector<std::uint64_t> told_to_leave_;
};

TEST_F(HandTableTest, TheSideThatWasAskedForOrNone) {
  EXPECT_EQ(take(HandWish::Left, 1).hand, 1);
  EXPECT_EQ(take(HandWish::Left, 2).hand, -1) << "the right one is free, and not what was asked for";
  EXPECT_EQ(take(HandWish::Any, 3).hand, 0);
  const HandTable::Taken none = take(HandWish::Any, 4);
  EXPECT_EQ(none.hand, -1);
  EXPECT_FALSE(none.comes_free);
  EXPECT_TRUE(told_to_leave_.empty());
}

TEST_F(HandTableTest, AHandIsKeptForItsOwnerAsLongAsAnotherIsFree) {
  ASSERT_EQ(take(HandWish::Any, 1).hand, 0);
  table_.leave(0, 0);
  EXPECT_EQ(take(HandWish::Any, 2).hand, 1) << "the first one is kept";
  EXPECT_EQ(take(HandWish::Any, 3).hand, 0) << "there is no other";
}

TEST_F(HandTableTest, AnOwnerGetsItsOwnHandBackAndWhatItWasTold) {
  ASSERT_EQ(take(HandWish::Left, 1).hand, 1);
  table_.leave(1, 5);
  const HandTable::Taken back = take(HandWish::Any, 1);
  EXPECT_EQ(back.hand, 1) << "though the first one is free";
  EXPECT_EQ(back.stops_sent, 5u);
  table_.leave(1, 6);
  ASSERT_EQ(take(HandWish::Left, 2).stops_sent, std::nullopt) << "a new owner was told nothing";
  const HandTable::Taken late = take(HandWish::Any, 1);
  EXPECT_EQ(late.hand, 0);
  EXPECT_EQ(late.stops_sent, std::nullopt);
}

TEST_F(HandTableTest, TheConnectionThatBrokeIsToldToLeaveAndNoOther) {
  ASSERT_EQ(take(HandWish::Any, 1).hand, 0);
  ASSERT_EQ(take(HandWish::Any, 2).hand, 1);
  const HandTable::Taken back = take(HandWish::Any, 2);
  EXPECT_EQ(back.hand, -1);
  EXPECT_TRUE(back.comes_free);
  EXPECT_EQ(told_to_leave_, std::vector<std::uint64_t>{2});
  table_.leave(1, 0);
  EXPECT_EQ(take(HandWish::Any, 2).hand, 1);
}

TEST_F(HandTableTest, ClientsWithoutAnIdAreNotTakenForEachOther) {
  EXPECT_EQ(take(HandWish::Any, 0).hand, 0);
  EXPECT_EQ(take(HandWish::Any, 0).hand, 1);
  table_.leave(0, 3);
  table_.leave(1, 4);
  EXPECT_EQ(take(HandWish::Any, 0).stops_sent, std::nullopt);
  EXPECT_TRUE(told_to_leave_.empty());
}

TEST_F(HandTableTest, AHandThatIsLeftLetsGoOfEverything) {
  ASSERT_EQ(take(HandWish::Any, 1).hand, 0);
  messages::ToolState holding;
  holding.sequence = 12;
  holding.grabbed_line = 1;
  holding.contact.stiffness_N_m = 500.0;
  channels_[0]->states.publish(holding);
  table_.leave(0, 0);
  ASSERT_TRUE(channels_[0]->states.update());
  EXPECT_EQ(channels_[0]->states.front().sequence, 0u);
  EXPECT_EQ(channels_[0]->states.front().grabbed_line, -1);
  EXPECT_EQ(channels_[0]->states.front().contact.stiffness_N_m, 0.0);
  EXPECT_FALSE(channels_[1]->states.update());
}

double wait_ms(TokenBucket& bucket, std::chrono::steady_clock::time_point now) {
  return std::chrono::duration<double, std::milli>(bucket.take(now)).count();
}

TEST(TokenBucket, AfterABurstEachWaitsForItsTurn) {
  TokenBucket bucket(100.0);  // one in 10 ms; ten at once
  const auto begin = std::chrono::steady_clock::now() + std::chrono::hours(1);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(wait_ms(bucket, begin), 0.0) << i;
  EXPECT_NEAR(wait_ms(bucket, begin), 10.0, 1e-3);
  EXPECT_NEAR(wait_ms(bucket, begin), 20.0, 1e-3);
  EXPECT_NEAR(wait_ms(bucket, begin + std::chrono::milliseconds(15)), 15.0, 1e-3) << "due at 30 ms";
  EXPECT_EQ(wait_ms(bucket, begin + std::chrono::milliseconds(41)), 0.0) << "due at 40 ms";
}

TEST(TokenBucket, ALongSilenceSavesUpNoMoreThanABurst) {
  TokenBucket bucket(100.0);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 30; ++i) bucket.take(begin);
  const auto later = begin + std::chrono::hours(24);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(wait_ms(bucket, later), 0.0) << i;
  EXPECT_GT(wait_ms(bucket, later), 0.0);
}

TEST(TokenBucket, ASlowRateStillLetsOneThroughAtOnce) {
  TokenBucket bucket(0.5);
  const auto begin = std::chrono::steady_clock::now() + std::chrono::hours(1);
  EXPECT_EQ(wait_ms(bucket, begin), 0.0);
  EXPECT_NEAR(wait_ms(bucket, begin), 2000.0, 1e-3);
}

TEST(ServerState, WishesAreTakenInTheirOrderAndTheQueueHasAnEnd) {
  HandTable nobody({});
  ServerState state({}, nobody);
  int taken_in = 0;
  for (std::uint32_t i = 0; i < 300; ++i) taken_in += state.ask({i, Role::Instructor, std::to_string(i)}) ? 1 : 0;
  EXPECT_EQ(taken_in, 256);
  EXPECT_EQ(state.counters().dropped_controls, 44u);
  for (std::uint32_t i = 0; i < 256; ++i) {
    const auto request = state.take_request();
    ASSERT_TRUE(request);
    EXPECT_EQ(request->client, i);
    EXPECT_EQ(request->text, std::to_string(i));
  }
  EXPECT_FALSE(state.take_request());
  EXPECT_TRUE(state.ask({1, Role::Instructor, "again"})) << "there is room again";
}

TEST(ServerState, ALogIsNotFilledByThousandsOfBadClients) {
  HandTable nobody({});
  ServerState state({}, nobody);
  EXPECT_TRUE(state.is_new_complaint("its check sum is wrong"));
  EXPECT_FALSE(state.is_new_complaint("its check sum is wrong"));
  int told = 1;
  for (int i = 0; i < 10'000; ++i) told += state.is_new_complaint("origin " + std::to_string(i)) ? 1 : 0;
  EXPECT_EQ(told, 64);
}

}  // namespace
}  // namespace myotact::net
