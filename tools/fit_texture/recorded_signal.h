#pragma once

#include <filesystem>
#include <vector>

namespace myotact::fit_texture {

/// What a recording holds: the vibration as a force on the hand, evenly sampled, and what went with it.
struct RecordedSignal {
  double rate_Hz = 0.0;
  std::vector<double> signal_N;
  std::vector<double> normal_force_N, speed_m_s;  // one a sample each, or empty: not recorded
};

/// Rates that are understood. Below, the texture's own 1000 Hz are not in the recording.
inline constexpr double kLowestRate_Hz = 1000.0, kHighestRate_Hz = 400'000.0;

/// RIFF WAVE, mono: PCM of 16, 24 or 32 bits or IEEE float of 32 or 64; full scale stands for `full_scale_N`. Throws
/// Error NoInput, or BadData naming the byte.
RecordedSignal read_wav(const std::filesystem::path& path, double full_scale_N);

/// Comma-separated columns under a line of names: `t_s` (evenly spaced), then `force_N`, or `acceleration_m_s2`, which
/// `mass_kg` turns into a force; beside them `normal_force_N` and `speed_m_s` if they were recorded; others are read
/// over. Throws Error NoInput, or BadData naming line and column; Usage when a mass is needed (0: none given).
RecordedSignal read_csv(const std::filesystem::path& path, double mass_kg);

}  // namespace myotact::fit_texture
