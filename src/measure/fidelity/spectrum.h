#pragma once

#include <span>
#include <vector>

namespace myotact::measure {

/// Samples of one segment of power_spectrum(): bins of rate / 256.
inline constexpr int kSegment = 256;

/// One-sided power density of a signal by averaged periodograms (Welch 1967): segments of 256 samples, a half
/// overlapping, Hann window. Entry i stands for i rate / 256, 0 .. 128, in units^2/Hz. At least 256 samples.
std::vector<double> power_spectrum(std::span<const double> samples, double rate_Hz);

}  // namespace myotact::measure
