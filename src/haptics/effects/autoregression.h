#pragma once

#include <array>
#include <span>
#include <vector>

#include "haptics/effects/texture_set.h"

namespace myotact::haptics {

/// Coefficients a of y_n + sum_i a_i y_{n-i} = e_n, i = 1 .. order, of the process with these reflection coefficients
/// (Levinson's recursion, "step up"). Allocates.
std::vector<double> prediction_coefficients(std::span<const double> reflection);

/// Power of the process per Hz, one-sided, of unit variance: its integral from 0 to half of the rate is 1. [1/Hz]
double spectral_density_1_Hz(std::span<const double> reflection, double frequency_Hz, double rate_Hz);

/// Share of the power at and above a frequency, 0 .. 1.
double power_above(std::span<const double> reflection, double frequency_Hz, double rate_Hz);

/// Runs a process in the normalised lattice (Gray and Markel 1975): every stage rotates a pair of numbers,
///
///   | f_(m-1) |   | c  -k | | f_m           |      k the reflection coefficient, c = sqrt(1 - k^2)
///   | g_m     | = | k   c | | g_(m-1), late |
///
/// so that nothing grows however k changes from one sample to the next, and noise of unit variance comes out with unit
/// variance and the process's spectrum. Real-time safe.
class Lattice {
 public:
  /// Next sample from noise of unit variance (or any other input).
  double next(std::span<const double> reflection, double input) noexcept;

 private:
  std::array<double, VibrationNode::kMaxOrder + 1> late_{};  // g of the last sample
};

}  // namespace myotact::haptics
