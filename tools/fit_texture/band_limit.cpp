#include "fit_texture/band_limit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace myotact::fit_texture {

namespace {

constexpr double kPeriods = 16.0;  // of the cut, to each side: steep enough for 450 of 500 Hz
constexpr double kMean_s = 0.5;

/// Blackman window of a sinc, x from -1 to 1.
double window(double x) {
  const double turn = std::numbers::pi * x;
  return 0.42 + 0.5 * std::cos(turn) + 0.08 * std::cos(2.0 * turn);
}

}  // namespace

std::vector<double> resampled(const std::vector<double>& signal, double from_Hz, double to_Hz, double cut_Hz) {
  const double reach = kPeriods * from_Hz / cut_Hz;  // samples
  const double step = from_Hz / to_Hz;
  std::vector<double> result;
  for (double centre = reach; centre + reach < static_cast<double>(signal.size()); centre += step) {
    double sum = 0.0, weights = 0.0;
    for (auto i = static_cast<std::size_t>(std::ceil(centre - reach)); static_cast<double>(i) <= centre + reach; ++i) {
      const double offset = static_cast<double>(i) - centre;
      const double angle = 2.0 * std::numbers::pi * cut_Hz / from_Hz * offset;
      const double weight = (std::abs(angle) < 1e-9 ? 1.0 : std::sin(angle) / angle) * window(offset / reach);
      sum += weight * signal[i];
      weights += weight;
    }
    result.push_back(sum / weights);
  }
  return result;
}

std::vector<double> without_push(const std::vector<double>& signal, double rate_Hz) {
  const auto half = static_cast<std::ptrdiff_t>(0.5 * kMean_s * rate_Hz);
  const auto count = static_cast<std::ptrdiff_t>(signal.size());
  std::vector<double> sums(signal.size() + 1, 0.0), result(signal.size());
  for (std::size_t i = 0; i < signal.size(); ++i) sums[i + 1] = sums[i] + signal[i];
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const std::ptrdiff_t first = std::max<std::ptrdiff_t>(0, i - half), last = std::min(count, i + half + 1);
    const double mean = (sums[static_cast<std::size_t>(last)] - sums[static_cast<std::size_t>(first)]) /
                        static_cast<double>(last - first);
    result[static_cast<std::size_t>(i)] = signal[static_cast<std::size_t>(i)] - mean;
  }
  return result;
}

}  // namespace myotact::fit_texture
