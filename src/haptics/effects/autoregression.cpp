#include "haptics/effects/autoregression.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace myotact::haptics {

namespace {

double white_share(std::span<const double> reflection) {
  double share = 1.0;
  for (const double k : reflection) share *= 1.0 - k * k;
  return share;
}

double density(std::span<const double> prediction, double white, double frequency_Hz, double rate_Hz) {
  const std::complex<double> late = std::polar(1.0, -2.0 * std::numbers::pi * frequency_Hz / rate_Hz);
  std::complex<double> sum = 0.0;  // Horner, from the oldest coefficient
  for (std::size_t i = prediction.size(); i-- > 0;) sum = (sum + prediction[i]) * late;
  return 2.0 * white / (rate_Hz * std::norm(1.0 + sum));
}

}  // namespace

std::vector<double> prediction_coefficients(std::span<const double> reflection) {
  std::vector<double> a;
  for (const double k : reflection) {
    std::vector<double> longer = a;
    for (std::size_t i = 0; i < a.size(); ++i) longer[i] += k * a[a.size() - 1 - i];
    longer.push_back(k);
    a = std::move(longer);
  }
  return a;
}

double spectral_density_1_Hz(std::span<const double> reflection, double frequency_Hz, double rate_Hz) {
  return density(prediction_coefficients(reflection), white_share(reflection), frequency_Hz, rate_Hz);
}

double power_above(std::span<const double> reflection, double frequency_Hz, double rate_Hz) {
  const std::vector<double> prediction = prediction_coefficients(reflection);
  const double white = white_share(reflection);
  constexpr int kParts = 2000;  // midpoint rule; the sharpest resonance that is allowed is some Hz wide
  const double width_Hz = 0.5 * rate_Hz / kParts;
  double above = 0.0, all = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double middle_Hz = (i + 0.5) * width_Hz;
    const double power = density(prediction, white, middle_Hz, rate_Hz) * width_Hz;
    all += power;
    if (middle_Hz >= frequency_Hz) above += power;
  }
  return all > 0.0 ? above / all : 0.0;
}

double Lattice::next(std::span<const double> reflection, double input) noexcept {
  double forward = input;
  // Stages beyond the order have k = 0 and only hand on, so that a change of order finds what is under way.
  for (std::size_t m = late_.size() - 1; m > reflection.size(); --m) late_[m] = late_[m - 1];
  for (std::size_t m = reflection.size(); m > 0; --m) {
    const double k = reflection[m - 1], c = std::sqrt(1.0 - k * k);
    const double late = late_[m - 1];
    late_[m] = k * forward + c * late;
    forward = c * forward - k * late;
  }
  late_[0] = forward;
  return forward;
}

}  // namespace myotact::haptics
