#include "realtime/bounded_fifo.h"

#include <thread>

#include <gtest/gtest.h>

namespace myotact::realtime {
namespace {

TEST(BoundedFifo, KeepsOrderAndDropsWhatDoesNotFit) {
  BoundedFifo<int> fifo(3);
  for (int value = 1; value <= 5; ++value) EXPECT_EQ(fifo.push(value), value <= 3);
  EXPECT_EQ(fifo.dropped(), 2u);
  int value = 0;
  for (int expected = 1; expected <= 3; ++expected) {
    EXPECT_TRUE(fifo.pop(value));
    EXPECT_EQ(value, expected);
  }
  EXPECT_FALSE(fifo.pop(value));
  EXPECT_EQ(value, 3);
}

TEST(BoundedFifo, ThreadsPassEveryValueInOrder) {
  constexpr int kValues = 50'000;
  BoundedFifo<int> fifo(16);
  std::thread writer([&] {
    for (int value = 1; value <= kValues;) {
      if (fifo.push(value))
        ++value;
      else
        std::this_thread::yield();
    }
  });
  int wrong = 0;
  for (int expected = 1; expected <= kValues;) {
    int value = 0;
    if (!fifo.pop(value)) {
      std::this_thread::yield();
      continue;
    }
    wrong += value != expected++;
  }
  writer.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace myotact::realtime
