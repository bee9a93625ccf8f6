#include "net/clock_estimate.h"

#include <gtest/gtest.h>

namespace myotact::net {
namespace {

constexpr std::uint64_t kMs = 1'000'000;

/// A ping that leaves at `left` while the other clock is `offset` ahead.
PingTimes ping(std::uint64_t left, std::uint64_t offset, std::uint64_t there, std::uint64_t back) {
  const std::uint64_t work = 2 * kMs;
  return {left, left + there + offset, left + there + work + offset, left + there + work + back};
}

TEST(ClockEstimate, OfTwoEqualWaysIsExact) {
  ClockEstimate clock;
  EXPECT_EQ(clock.here_ns(77), 77u);
  clock.add(ping(1000 * kMs, 5000 * kMs, 3 * kMs, 3 * kMs));
  EXPECT_DOUBLE_EQ(clock.round_trip_s(), 6e-3);
  EXPECT_EQ(clock.here_ns(7000 * kMs), 2000 * kMs);
}

TEST(ClockEstimate, IsWrongByHalfTheShortestRoundTripAtMost) {
  ClockEstimate clock;
  constexpr std::uint64_t kOffset = 123456 * kMs;
  for (std::uint64_t i = 0; i < 30; ++i) {  // from 2 ms up; the way back is slower each time but one
    clock.add(ping(1000 * kMs + i * 100 * kMs, kOffset, 1 * kMs, (i == 17 ? 1 : 5 + i) * kMs));
  }
  const auto here = static_cast<double>(clock.here_ns(kOffset + 5000 * kMs));
  EXPECT_NEAR(here, 5000.0 * kMs, 1.0 * kMs);
}

TEST(ClockEstimate, ForgetsWhatIsLongAgo) {
  ClockEstimate clock;
  clock.add(ping(1000 * kMs, 0, 0, 0));
  for (std::uint64_t i = 1; i <= 64; ++i) clock.add(ping(1000 * kMs + i * 100 * kMs, 40 * kMs, kMs, kMs));
  EXPECT_EQ(clock.here_ns(9000 * kMs + 40 * kMs), 9000 * kMs);  // a clock that drifted
}

TEST(ClockEstimate, IgnoresAnswersFromBeforeTheQuestion) {
  ClockEstimate clock;
  clock.add({100, 0, 200, 150});  // the other side worked longer than the whole took
  EXPECT_EQ(clock.round_trip_s(), 0.0);
  EXPECT_EQ(clock.here_ns(5), 5u);
}

TEST(ClockEstimate, TwoUnequalWaysShiftItByHalfOfTheirDifference) {
  ClockEstimate clock;
  constexpr std::uint64_t kOffset = 5000 * kMs;
  clock.add(ping(1000 * kMs, kOffset, 1 * kMs, 9 * kMs));
  // What left there at 1003 ms of our clock is taken to have left at 1007 ms: 5 ms for each way, 2 ms of work.
  EXPECT_EQ(clock.here_ns(1003 * kMs + kOffset), 1007 * kMs);
  clock.add(ping(2000 * kMs, kOffset, 9 * kMs, 2 * kMs));  // longer: the first one counts on
  EXPECT_EQ(clock.here_ns(1003 * kMs + kOffset), 1007 * kMs);
  EXPECT_DOUBLE_EQ(clock.least_round_trip_s(), 10e-3);
}

TEST(ClockEstimate, AnotherMachinesClockMayHaveBegunAtAnyTime) {
  constexpr std::uint64_t kHalf = std::uint64_t{1} << 63;
  for (const std::uint64_t here : {5 * kMs, std::uint64_t{1} << 62}) {
    for (const std::uint64_t offset : {0 - here, kHalf, kHalf - here, kHalf + here, 0 - 3 * kMs}) {
      ClockEstimate clock;
      clock.add(ping(here, offset, 1 * kMs, 1 * kMs));
      EXPECT_EQ(clock.here_ns(here + offset + 700 * kMs), here + 700 * kMs) << here << " " << offset;
    }
  }
}

TEST(ClockEstimate, WhatCannotBeTrueIsLeftOut) {
  ClockEstimate clock;
  clock.add(ping(1000 * kMs, 40 * kMs, 2 * kMs, 2 * kMs));
  for (const std::uint64_t worked : {std::uint64_t{1} << 63, std::uint64_t{3} << 61, std::uint64_t{10} * kMs}) {
    clock.add({2000 * kMs, 2000 * kMs, 2000 * kMs + worked, 2006 * kMs});
  }
  EXPECT_DOUBLE_EQ(clock.round_trip_s(), 4e-3);
  EXPECT_EQ(clock.here_ns(1040 * kMs), 1000 * kMs);
}

TEST(ClockEstimate, TheShortestRoundTripCountsForSixtyFourPings) {
  ClockEstimate clock;
  clock.add(ping(1000 * kMs, 7 * kMs, 1 * kMs, 1 * kMs));
  for (std::uint64_t i = 1; i < 64; ++i) clock.add(ping(1000 * kMs + i * 100 * kMs, 7 * kMs, 2 * kMs, 20 * kMs));
  EXPECT_EQ(clock.here_ns(5007 * kMs), 5000 * kMs);
  EXPECT_DOUBLE_EQ(clock.least_round_trip_s(), 2e-3);
  EXPECT_DOUBLE_EQ(clock.round_trip_s(), 22e-3) << "of the newest";
}

}  // namespace
}  // namespace myotact::net
