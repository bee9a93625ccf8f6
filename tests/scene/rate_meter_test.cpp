#include "scene/rate_meter.h"

#include <gtest/gtest.h>

namespace myotact::scene {
namespace {

constexpr std::uint64_t kSecond_ns = 1'000'000'000;

TEST(RateMeter, TellsTheRatesOfTheLastSecondNotOfAllTime) {
  RateMeter meter(0.01);
  std::uint64_t steps = 0, ticks = 0;
  messages::RateFrame rates;
  const auto go_on = [&](std::uint64_t second, int steps_per_s) {
    for (int i = 1; i <= steps_per_s; ++i) {
      ++steps;
      ticks += 1000 / static_cast<std::uint64_t>(steps_per_s);
      const std::uint64_t now = (second * static_cast<std::uint64_t>(steps_per_s) + static_cast<std::uint64_t>(i)) *
                                kSecond_ns / static_cast<std::uint64_t>(steps_per_s);
      rates = meter.add({now, steps, ticks, 3});
    }
  };
  meter.add({0, 0, 0, 0});
  go_on(0, 100);
  EXPECT_NEAR(rates.time_factor, 1.0, 1e-9);
  EXPECT_NEAR(rates.haptic_hz, 1000.0, 1e-6);
  EXPECT_EQ(rates.missed_ticks, 3u);
  for (std::uint64_t second = 1; second < 5; ++second) go_on(second, 50);  // at half the speed, for four seconds
  EXPECT_NEAR(rates.simulation_hz, 50.0, 1e-6);
  EXPECT_NEAR(rates.time_factor, 0.5, 1e-9);
  rates = meter.add({65 * kSecond_ns, steps + 1, ticks + 60'000, 3});  // after a pause of a minute
  go_on(65, 100);
  EXPECT_NEAR(rates.time_factor, 1.0, 0.02);
}

TEST(RateMeter, TellsTheFirstSecondWhileItLasts) {
  RateMeter meter(0.01);
  meter.add({7 * kSecond_ns, 0, 0, 0});
  EXPECT_NEAR(meter.add({7 * kSecond_ns + kSecond_ns / 4, 25, 250, 0}).time_factor, 1.0, 1e-9);
}

}  // namespace
}  // namespace myotact::scene
