#include "measure/fidelity/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace myotact::measure {
namespace {

std::vector<double> sampled_sine(double amplitude, double frequency_Hz, double rate_Hz, std::size_t count) {
  std::vector<double> samples(count);
  for (std::size_t i = 0; i < count; ++i) {
    samples[i] = amplitude * std::sin(2.0 * std::numbers::pi * frequency_Hz / rate_Hz * static_cast<double>(i) + 0.4);
  }
  return samples;
}

/// All of the power: density times the width of a bin.
double whole_power(const std::vector<double>& density, double rate_Hz) {
  return std::accumulate(density.begin(), density.end(), 0.0) * rate_Hz / kSegment;
}

/// Parseval: the bins of a segment hold its windowed square exactly, whatever the samples are.
TEST(Spectrum, HoldsTheWindowedPowerOfAnySignalAtAnyRate) {
  std::mt19937 random(111);
  std::normal_distribution<double> normal;
  for (const double rate_Hz : {1.0, 44.1, 1000.0, 48e3}) {
    for (const std::size_t segments : {1U, 2U, 5U, 9U}) {
      std::vector<double> samples(kSegment / 2 * (segments + 1));
      for (double& sample : samples) sample = 3.0 * normal(random) + 1.0;
      double expected = 0.0;
      for (std::size_t s = 0; s < segments; ++s) {
        double square = 0.0, window_square = 0.0;
        for (std::size_t i = 0; i < kSegment; ++i) {
          const double window = std::pow(std::sin(std::numbers::pi * static_cast<double>(i) / kSegment), 2);  // Hann
          square += std::pow(window * samples[kSegment / 2 * s + i], 2);
          window_square += window * window;
        }
        expected += square / window_square / static_cast<double>(segments);
      }
      const std::vector<double> density = power_spectrum(samples, rate_Hz);
      ASSERT_EQ(density.size(), 129u);
      EXPECT_NEAR(whole_power(density, rate_Hz), expected, 1e-9 * expected) << rate_Hz << " " << segments;
    }
  }
}

TEST(Spectrum, ASineStandsAtItsFrequencyWithHalfItsSquare) {
  std::mt19937 random(112);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int round = 0; round < 60; ++round) {
    const double rate_Hz = std::pow(10.0, 4.0 * uniform(random));
    const double frequency_Hz = rate_Hz * (0.02 + 0.46 * uniform(random)), amplitude = 0.1 + 5.0 * uniform(random);
    const std::vector<double> density =
        power_spectrum(sampled_sine(amplitude, frequency_Hz, rate_Hz, 20 * kSegment), rate_Hz);
    const auto peak = std::max_element(density.begin(), density.end()) - density.begin();
    EXPECT_NEAR(static_cast<double>(peak) * rate_Hz / kSegment, frequency_Hz, 0.5001 * rate_Hz / kSegment);
    // A window of ten periods and more sees the square's mean to a tenth of a percent.
    EXPECT_NEAR(whole_power(density, rate_Hz), 0.5 * amplitude * amplitude, 2e-3 * amplitude * amplitude);
    for (std::size_t bin = 0; bin < density.size(); ++bin) {
      if (std::abs(static_cast<double>(bin) - frequency_Hz / rate_Hz * kSegment) < 4.0) continue;
      EXPECT_LT(density[bin], 1e-4 * density[static_cast<std::size_t>(peak)]) << bin;
    }
  }
}

/// The two ends of the spectrum have no mirror image: their power counts once.
TEST(Spectrum, WhatStandsStillAndWhatAlternatesCountOnce) {
  std::vector<double> still(1024, 3.0), alternates(1024);
  for (std::size_t i = 0; i < alternates.size(); ++i) alternates[i] = i % 2 == 0 ? 3.0 : -3.0;
  const std::vector<double> low = power_spectrum(still, 500.0), high = power_spectrum(alternates, 500.0);
  EXPECT_NEAR(whole_power(low, 500.0), 9.0, 1e-9);
  EXPECT_NEAR(whole_power(high, 500.0), 9.0, 1e-9);
  for (std::size_t bin = 0; bin < low.size(); ++bin) EXPECT_NEAR(low[bin], high[low.size() - 1 - bin], 1e-9);
}

/// Samples beyond the last whole segment change nothing.
TEST(Spectrum, SquaresWithTheAmplitudeAndLeavesOutWhatFillsNoSegment) {
  std::vector<double> samples = sampled_sine(1.0, 110.0, 1000.0, 1024);
  const std::vector<double> once = power_spectrum(samples, 1000.0);
  for (double& sample : samples) sample *= -4.0;
  const std::vector<double> four = power_spectrum(samples, 1000.0);
  for (std::size_t bin = 0; bin < once.size(); ++bin) EXPECT_NEAR(four[bin], 16.0 * once[bin], 1e-12);
  samples.insert(samples.end(), 127, 1e6);
  EXPECT_EQ(power_spectrum(samples, 1000.0), four);
}

}  // namespace
}  // namespace myotact::measure
