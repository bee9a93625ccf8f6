#include "realtime/periodic_loop.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "realtime/real_time_thread.h"

namespace myotact::realtime {
namespace {

constexpr std::uint64_t kPeriod_ns = 1'000'000;

TEST(PeriodicLoop, NeverWakesEarlyAndKeepsTheMeanPeriod) {
  PeriodicLoop loop(kPeriod_ns);
  const std::uint64_t start_ns = steady_now_ns();
  loop.start();
  std::uint64_t periods = 0;
  for (int tick = 0; tick < 50; ++tick) {
    const PeriodicLoop::Wake wake = loop.wait();
    periods += 1 + wake.missed;
    EXPECT_GE(wake.now_ns, start_ns + periods * kPeriod_ns);  // no drift: the deadlines are absolute
  }
}

TEST(PeriodicLoop, SkipsMissedDeadlinesInsteadOfBursting) {
  PeriodicLoop loop(kPeriod_ns);
  loop.start();
  std::this_thread::sleep_for(std::chrono::nanoseconds(5 * kPeriod_ns));
  const PeriodicLoop::Wake late = loop.wait();
  EXPECT_GE(late.missed, 3u);
  loop.wait();
  EXPECT_GE(loop.wait().now_ns - late.now_ns, kPeriod_ns);  // two deadlines that both lay ahead
}

TEST(PeriodicLoop, MakesUpForAsManyDeadlinesAsItMay) {
  PeriodicLoop loop(kPeriod_ns, 3);
  const std::uint64_t start_ns = steady_now_ns();
  loop.start();
  std::uint64_t periods = 0;
  for (int tick = 0; tick < 20; ++tick) {
    if (tick == 5) std::this_thread::sleep_for(std::chrono::nanoseconds(3 * kPeriod_ns));
    const PeriodicLoop::Wake wake = loop.wait();
    periods += 1 + wake.missed;
    EXPECT_GE(wake.now_ns, start_ns + periods * kPeriod_ns);
  }
  std::this_thread::sleep_for(std::chrono::nanoseconds(10 * kPeriod_ns));
  EXPECT_GE(loop.wait().missed, 6u);
  EXPECT_EQ(loop.wait().missed, 0u);
}

TEST(RealTimeThread, SaysWhyWhenRefused) {
  RealTimePermission permission;
  std::thread([&] { permission = make_this_thread_real_time(); }).join();
  EXPECT_EQ(permission.granted, permission.why_not.empty());
}

}  // namespace
}  // namespace myotact::realtime
