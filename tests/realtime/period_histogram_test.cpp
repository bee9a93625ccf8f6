#include "realtime/period_histogram.h"

#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

namespace myotact::realtime {
namespace {

constexpr double kBinWidth = 0.032;  // relative, stated by summary()

TEST(PeriodHistogram, IsEmptyAtFirst) {
  const DurationSummary summary = PeriodHistogram().summary();
  EXPECT_EQ(summary.count, 0u);
  EXPECT_EQ(summary.p99_ns, 0u);
}

TEST(PeriodHistogram, PercentilesOfEqualSteps) {
  PeriodHistogram histogram;
  for (std::uint64_t duration_us = 1; duration_us <= 10'000; ++duration_us) histogram.add(duration_us * 1000);
  const DurationSummary summary = histogram.summary();
  EXPECT_EQ(summary.count, 10'000u);
  EXPECT_NEAR(static_cast<double>(summary.p50_ns), 5.0e6, kBinWidth * 5.0e6);
  EXPECT_NEAR(static_cast<double>(summary.p99_ns), 9.9e6, kBinWidth * 9.9e6);
  EXPECT_NEAR(static_cast<double>(summary.p999_ns), 9.99e6, kBinWidth * 9.99e6);
  EXPECT_EQ(summary.max_ns, 10'000'000u);
}

TEST(PeriodHistogram, OneOutlierShowsInTheMaximumOnly) {
  PeriodHistogram histogram;
  for (int tick = 0; tick < 2000; ++tick) histogram.add(40);
  histogram.add(5'000'000);
  const DurationSummary summary = histogram.summary();
  EXPECT_EQ(summary.p999_ns, 40u);
  EXPECT_EQ(summary.max_ns, 5'000'000u);
}

TEST(PeriodHistogram, TakesEveryDuration) {
  PeriodHistogram histogram;
  histogram.add(0);
  histogram.add(std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(histogram.summary().p50_ns, 0u);
  EXPECT_EQ(histogram.summary().p99_ns, std::numeric_limits<std::uint64_t>::max());
}

}  // namespace
}  // namespace myotact::realtime
