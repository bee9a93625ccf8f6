#include "realtime/latest_value.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

namespace myotact::realtime {
namespace {

TEST(LatestValue, NothingPublishedMeansNothingNew) {
  LatestValue<int> channel;
  EXPECT_FALSE(channel.update());
  EXPECT_EQ(channel.front(), 0);
}

TEST(LatestValue, NewestWinsAndIsReadOnce) {
  LatestValue<int> channel;
  channel.publish(1);
  channel.publish(2);
  EXPECT_TRUE(channel.update());
  EXPECT_EQ(channel.front(), 2);
  EXPECT_FALSE(channel.update());
  EXPECT_EQ(channel.front(), 2);
}

TEST(LatestValue, ReaderKeepsItsValueWhileWriterGoesOn) {
  LatestValue<int> channel;
  channel.publish(1);
  channel.update();
  for (int value = 2; value < 10; ++value) channel.publish(value);
  EXPECT_EQ(channel.front(), 1);
  EXPECT_TRUE(channel.update());
  EXPECT_EQ(channel.front(), 9);
}

TEST(LatestValue, ThreadsNeverSeeATornOrOlderValue) {
  using Block = std::array<std::uint64_t, 64>;
  constexpr std::uint64_t kValues = 20'000;
  LatestValue<Block> channel;
  std::thread writer([&] {
    for (std::uint64_t value = 1; value <= kValues; ++value) {
      channel.back().fill(value);
      channel.publish();
    }
  });
  std::uint64_t last = 0;
  int torn = 0;
  int backwards = 0;
  while (last < kValues) {
    if (!channel.update()) {
      std::this_thread::yield();
      continue;
    }
    const Block& block = channel.front();
    for (const std::uint64_t word : block) torn += word != block[0];
    backwards += block[0] <= last;
    last = block[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backwards, 0);
}

}  // namespace
}  // namespace myotact::realtime
