#include "measure/fidelity/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace myotact::measure {

namespace {

constexpr std::size_t kLength = kSegment;

struct Tables {
  std::array<double, kLength> window{}, cosine{}, sine{};
  double window_power = 0.0;

  Tables() {
    for (std::size_t i = 0; i < kLength; ++i) {
      const double turn_rad = 2.0 * std::numbers::pi * static_cast<double>(i) / kSegment;
      cosine[i] = std::cos(turn_rad);
      sine[i] = std::sin(turn_rad);
      window[i] = 0.5 - 0.5 * cosine[i];
      window_power += window[i] * window[i];
    }
  }
};

}  // namespace

std::vector<double> power_spectrum(std::span<const double> samples, double rate_Hz) {
  static const Tables tables;
  std::vector<double> power(kLength / 2 + 1, 0.0);
  int segments = 0;
  for (std::size_t start = 0; start + kLength <= samples.size(); start += kLength / 2, ++segments) {
    std::array<double, kLength> windowed;
    for (std::size_t i = 0; i < kLength; ++i) windowed[i] = tables.window[i] * samples[start + i];
    for (std::size_t bin = 0; bin < power.size(); ++bin) {
      double real = 0.0, imaginary = 0.0;
      for (std::size_t i = 0; i < kLength; ++i) {
        real += windowed[i] * tables.cosine[bin * i % kLength];
        imaginary += windowed[i] * tables.sine[bin * i % kLength];
      }
      power[bin] += real * real + imaginary * imaginary;
    }
  }
  for (std::size_t bin = 0; bin < power.size(); ++bin) {
    const double sides = bin == 0 || bin + 1 == power.size() ? 1.0 : 2.0;
    power[bin] *= sides / (rate_Hz * tables.window_power * std::max(1, segments));
  }
  return power;
}

}  // namespace myotact::measure
